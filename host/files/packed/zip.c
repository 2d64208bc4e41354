#include "files/packed/zip.h"

#include "base/memory.h"
#include "files/bytes.h"
#include "files/descriptor.h"
#include "files/packed/gzip.h"
#include "files/packed/npz_records.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

/* APPNOTE.TXT 6.3: sizes of records before what has no fixed size, and where their fields are; of
 * the record before a member npz_records.h has them. */
enum {
    END_BYTES = 22, /* end of central directory */
    END_ENTRIES = 10,
    END_SIZE = 12,
    END_OFFSET = 16,
    MOST_COMMENT = 65535, /* behind it */
    LOCATOR_BYTES = 20,   /* of the zip64 end, before the other end */
    LOCATOR_OFFSET = 8,
    END64_BYTES = 56,
    END64_ENTRIES = 32,
    END64_SIZE = 40,
    END64_OFFSET = 48,
    ENTRY_BYTES = 46, /* of the central directory */
    ENTRY_FLAGS = 8,
    ENTRY_METHOD = 10,
    ENTRY_CRC = 16,
    ENTRY_COMPRESSED = 20,
    ENTRY_SIZE = 24,
    ENTRY_NAME_BYTES = 28,
    ENTRY_EXTRA_BYTES = 30,
    ENTRY_COMMENT_BYTES = 32,
    ENTRY_OFFSET = 42,
    FLAG_ENCRYPTED = 1,
    DEFLATED = 8,
    MOST_DIRECTORY = 1 << 24 /* bytes: an archive of arrays has a few hundred */
};

struct ps_zip {
    int descriptor;
    const char *name;
    ps_gzip *inflater; /* NULL: the member is stored */
    uint64_t size, num_read;
    uint32_t crc, crc_read;
};

/* What the directory says of a member. */
typedef struct entry {
    const char *name; /* not ended by a NUL */
    size_t name_bytes;
    unsigned flags, method;
    uint32_t crc;
    uint64_t size, offset;
} entry;

/* The archive while it is opened. */
typedef struct archive {
    int descriptor;
    const char *name;
    uint64_t num_bytes;
    unsigned char *directory;
    uint64_t directory_offset, directory_bytes, num_entries;
    ps_error *error;
} archive;

/* ---- bytes ------------------------------------------------------------------------------- */

static uint16_t half_at(const unsigned char *bytes) {
    return (uint16_t)ps_bytes_number(bytes, sizeof(uint16_t));
}

static uint32_t word_at(const unsigned char *bytes) {
    return (uint32_t)ps_bytes_number(bytes, sizeof(uint32_t));
}

static pspec_status fail_damaged(const archive *whole, const char *what) {
    return ps_fail(whole->error, PSPEC_ERROR_INPUT, "%s: a damaged zip archive: %s", whole->name,
                   what);
}

static pspec_status read_at(const archive *whole, uint64_t offset, void *out, size_t num_bytes) {
    unsigned char *next = out;
    if (offset > whole->num_bytes || num_bytes > whole->num_bytes - offset) {
        return fail_damaged(whole, "it ends too early");
    }
    if (lseek(whole->descriptor, (off_t)offset, SEEK_SET) != (off_t)offset) {
        return ps_read_fail(whole->name, whole->error);
    }
    while (num_bytes > 0) {
        size_t count = 0;
        PS_TRY(ps_descriptor_read(whole->descriptor, whole->name, next, num_bytes, &count,
                                  whole->error));
        if (count == 0) {
            return fail_damaged(whole, "it ends too early");
        }
        next += count;
        num_bytes -= count;
    }
    return PSPEC_OK;
}

static bool begins(const unsigned char *bytes, const char *signature) {
    return memcmp(bytes, signature, 4) == 0;
}

/* ---- the directory ----------------------------------------------------------------------- */

/* The fields of large archives stand in a record of their own. */
static pspec_status find_end64(archive *whole, uint64_t end) {
    unsigned char locator[LOCATOR_BYTES];
    unsigned char record[END64_BYTES];
    if (end < LOCATOR_BYTES) {
        return PSPEC_OK;
    }
    PS_TRY(read_at(whole, end - LOCATOR_BYTES, locator, sizeof locator));
    if (!begins(locator, "PK\6\7")) {
        return PSPEC_OK;
    }
    PS_TRY(read_at(whole, ps_bytes_number(locator + LOCATOR_OFFSET, 8), record, sizeof record));
    if (!begins(record, "PK\6\6")) {
        return fail_damaged(whole, "its zip64 directory is not where it should be");
    }
    whole->num_entries = ps_bytes_number(record + END64_ENTRIES, 8);
    whole->directory_bytes = ps_bytes_number(record + END64_SIZE, 8);
    whole->directory_offset = ps_bytes_number(record + END64_OFFSET, 8);
    return PSPEC_OK;
}

/* The record stands at the end, before a comment that may contain anything. */
static pspec_status find_end(archive *whole, unsigned char *tail) {
    const size_t most = END_BYTES + MOST_COMMENT;
    const size_t num = whole->num_bytes < most ? (size_t)whole->num_bytes : most;
    if (num < END_BYTES) {
        return fail_damaged(whole, "it ends too early");
    }
    PS_TRY(read_at(whole, whole->num_bytes - num, tail, num));
    for (size_t at = num - END_BYTES + 1; at-- > 0;) {
        if (begins(tail + at, "PK\5\6")) {
            whole->num_entries = half_at(tail + at + END_ENTRIES);
            whole->directory_bytes = word_at(tail + at + END_SIZE);
            whole->directory_offset = word_at(tail + at + END_OFFSET);
            return find_end64(whole, whole->num_bytes - num + at);
        }
    }
    return fail_damaged(whole, "it has no directory at its end");
}

static pspec_status read_directory(archive *whole) {
    unsigned char *tail = NULL;
    PS_TRY(PS_NEW(&tail, END_BYTES + MOST_COMMENT, "the end of an archive", whole->error));
    const pspec_status status = find_end(whole, tail);
    free(tail);
    PS_TRY(status);
    if (whole->directory_bytes > MOST_DIRECTORY) {
        return fail_damaged(whole, "its directory is too large");
    }
    PS_TRY(PS_NEW(&whole->directory, (size_t)whole->directory_bytes + 1,
                  "a directory of an archive", whole->error));
    return read_at(whole, whole->directory_offset, whole->directory,
                   (size_t)whole->directory_bytes);
}

/* ---- an entry ---------------------------------------------------------------------------- */

/* Those of size, compressed size and offset that did not fit, in this order. */
static bool take_zip64(entry *out, const unsigned char *fields, size_t num_bytes,
                       const unsigned char *record) {
    uint64_t compressed = 0;
    struct {
        uint32_t here;
        uint64_t *value;
    } const wanted[] = {{word_at(record + ENTRY_SIZE), &out->size},
                        {word_at(record + ENTRY_COMPRESSED), &compressed},
                        {word_at(record + ENTRY_OFFSET), &out->offset}};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        if (wanted[i].here == PS_ZIP_NOT_HERE) {
            if (num_bytes < sizeof(uint64_t)) {
                return false;
            }
            *wanted[i].value = ps_bytes_number(fields, sizeof(uint64_t));
            fields += sizeof(uint64_t);
            num_bytes -= sizeof(uint64_t);
        }
    }
    return true;
}

static bool take_extra(entry *out, const unsigned char *record, const unsigned char *extra,
                       size_t num_bytes) {
    const size_t head = 2 * sizeof(uint16_t);
    while (num_bytes >= head) {
        const size_t size = half_at(extra + sizeof(uint16_t));
        if (size > num_bytes - head) {
            return false;
        }
        if (half_at(extra) == PS_ZIP_EXTRA_64) {
            return take_zip64(out, extra + head, size, record);
        }
        extra += head + size;
        num_bytes -= head + size;
    }
    return true;
}

/* The entry at *at, which moves on. */
static pspec_status take_entry(const archive *whole, size_t *at, entry *out) {
    const unsigned char *const record = whole->directory + *at;
    const size_t left = (size_t)whole->directory_bytes - *at;
    if (left < ENTRY_BYTES || !begins(record, "PK\1\2")) {
        return fail_damaged(whole, "its directory ends too early");
    }
    const size_t name_bytes = half_at(record + ENTRY_NAME_BYTES);
    const size_t extra_bytes = half_at(record + ENTRY_EXTRA_BYTES);
    const size_t all =
        ENTRY_BYTES + name_bytes + extra_bytes + half_at(record + ENTRY_COMMENT_BYTES);
    *out = (entry){.name = (const char *)record + ENTRY_BYTES,
                   .name_bytes = name_bytes,
                   .flags = half_at(record + ENTRY_FLAGS),
                   .method = half_at(record + ENTRY_METHOD),
                   .crc = word_at(record + ENTRY_CRC),
                   .size = word_at(record + ENTRY_SIZE),
                   .offset = word_at(record + ENTRY_OFFSET)};
    if (all > left || !take_extra(out, record, record + ENTRY_BYTES + name_bytes, extra_bytes)) {
        return fail_damaged(whole, "its directory ends too early");
    }
    *at += all;
    return PSPEC_OK;
}

static bool is_called(const entry *one, const char *wanted) {
    static const char ending[] = ".npy";
    const size_t length = strlen(wanted);
    return one->name_bytes == length + strlen(ending) && memcmp(one->name, wanted, length) == 0 &&
           memcmp(one->name + length, ending, strlen(ending)) == 0;
}

/* ---- which member ------------------------------------------------------------------------ */

/* Names as they are would let a file write to terminals. */
static void append_name(ps_text *names, const entry *one) {
    enum { MOST_SHOWN = 40 };
    for (size_t i = 0; i < one->name_bytes && i < MOST_SHOWN; i++) {
        const char letter = one->name[i];
        ps_text_append(names, "%c", letter > ' ' && letter <= '~' ? letter : '?');
    }
}

/* Entries were taken before. */
static pspec_status fail_several(const archive *whole, const char *wanted) {
    size_t at = 0;
    entry one;
    ps_text names = {0};
    pspec_status status = PSPEC_OK;
    for (uint64_t i = 0; i < whole->num_entries && status == PSPEC_OK; i++) {
        status = take_entry(whole, &at, &one);
        ps_text_append(&names, "%s", i > 0 ? ", " : "");
        append_name(&names, &one);
    }
    if (status == PSPEC_OK) {
        status = ps_text_check(&names, whole->error);
    }
    if (status == PSPEC_OK) {
        status = ps_fail(whole->error, PSPEC_ERROR_INPUT,
                         "%s holds several arrays (%.200s), none of them called \"%s\": "
                         "numpy.savez(FILE, %s=array) calls one so",
                         whole->name, ps_text_string(&names), wanted, wanted);
    }
    ps_text_free(&names);
    return status;
}

/* The last one stands for the only one. */
static pspec_status choose(const archive *whole, const char *wanted, entry *out) {
    size_t at = 0;
    for (uint64_t i = 0; i < whole->num_entries; i++) {
        PS_TRY(take_entry(whole, &at, out));
        if (is_called(out, wanted)) {
            return PSPEC_OK;
        }
    }
    if (whole->num_entries == 0) {
        return ps_fail(whole->error, PSPEC_ERROR_INPUT, "%s is an empty zip archive", whole->name);
    }
    return whole->num_entries == 1 ? PSPEC_OK : fail_several(whole, wanted);
}

/* ---- opening ----------------------------------------------------------------------------- */

static pspec_status start_member(ps_zip *zip, const archive *whole, const entry *one) {
    unsigned char local[PS_ZIP_LOCAL_BYTES];
    if ((one->flags & FLAG_ENCRYPTED) != 0 ||
        (one->method != PS_ZIP_STORED && one->method != DEFLATED)) {
        return ps_fail(whole->error, PSPEC_ERROR_INPUT,
                       "%s: its member is encrypted, or compressed otherwise than by deflate; "
                       "numpy.savez and savez_compressed write archives that can be read",
                       whole->name);
    }
    PS_TRY(read_at(whole, one->offset, local, sizeof local));
    const uint64_t start = one->offset + PS_ZIP_LOCAL_BYTES +
                           half_at(local + PS_ZIP_LOCAL_NAME_BYTES) +
                           half_at(local + PS_ZIP_LOCAL_EXTRA_BYTES);
    if (!begins(local, "PK\3\4")) {
        return fail_damaged(whole, "a member is not where its directory says");
    }
    PS_TRY(read_at(whole, start, local, 0)); /* goes there */
    zip->size = one->size;
    zip->crc = one->crc;
    return one->method == PS_ZIP_STORED
               ? PSPEC_OK
               : ps_gzip_create(&zip->inflater, PS_GZIP_RAW, whole->descriptor, whole->name, NULL,
                                0, whole->error);
}

static pspec_status open_member(ps_zip *zip, archive *whole, const char *wanted) {
    entry one = {0};
    const off_t end = lseek(whole->descriptor, 0, SEEK_END);
    if (end < 0) {
        return ps_read_fail(whole->name, whole->error);
    }
    whole->num_bytes = (uint64_t)end;
    PS_TRY(read_directory(whole));
    PS_TRY(choose(whole, wanted, &one));
    return start_member(zip, whole, &one);
}

pspec_status ps_zip_open(ps_zip **out, int descriptor, const char *name, const char *wanted,
                         ps_error *error) {
    archive whole = {.descriptor = descriptor, .name = name, .error = error};
    PS_TRY(PS_NEW(out, 1, "an archive", error));
    (*out)->descriptor = descriptor;
    (*out)->name = name;
    (*out)->crc_read = (uint32_t)crc32(0, NULL, 0);
    const pspec_status status = open_member(*out, &whole, wanted);
    free(whole.directory);
    return status;
}

void ps_zip_destroy(ps_zip *zip) {
    if (zip != NULL) {
        ps_gzip_destroy(zip->inflater);
        free(zip);
    }
}

/* ---- reading ----------------------------------------------------------------------------- */

static pspec_status fail_size(const ps_zip *zip, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s: a damaged zip archive: a member has other bytes than its directory says",
                   zip->name);
}

static pspec_status read_some(ps_zip *zip, void *out, size_t max_bytes, size_t *count,
                              ps_error *error) {
    const uint64_t left = zip->size - zip->num_read;
    if (zip->inflater != NULL) {
        return ps_gzip_read(zip->inflater, out, max_bytes, count, error);
    }
    *count = 0;
    return left == 0
               ? PSPEC_OK
               : ps_descriptor_read(zip->descriptor, zip->name, out,
                                    left < max_bytes ? (size_t)left : max_bytes, count, error);
}

pspec_status ps_zip_read(ps_zip *zip, void *out, size_t max_bytes, size_t *count, ps_error *error) {
    const size_t most_at_once = (size_t)1 << 30; /* zlib counts in unsigned int */
    PS_TRY(read_some(zip, out, max_bytes < most_at_once ? max_bytes : most_at_once, count, error));
    if (*count > zip->size - zip->num_read) {
        return fail_size(zip, error);
    }
    zip->num_read += *count;
    zip->crc_read = (uint32_t)crc32(zip->crc_read, out, (uInt)*count);
    return *count > 0 || (zip->num_read == zip->size && zip->crc_read == zip->crc)
               ? PSPEC_OK
               : fail_size(zip, error);
}
