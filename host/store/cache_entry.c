#include "store/cache_entry.h"

#include "base/memory.h"
#include "files/descriptor.h"
#include "files/output_file.h"
#include "store/cache_trust.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

static const char magic[PS_CACHE_MAGIC_BYTES] = {'p', 's', 'r', 'e', 's', 'u', 'l', 't'};
enum { VERSION = 1 };

static uint64_t head_checksum(const ps_cache_head *head) {
    return XXH3_64bits(head, offsetof(ps_cache_head, head_checksum));
}

ps_cache_head ps_cache_head_make(const void *key, size_t key_bytes, const void *data,
                                 size_t data_bytes) {
    ps_cache_head head = {.version = VERSION,
                          .key_bytes = key_bytes,
                          .data_bytes = data_bytes,
                          .key_checksum = XXH3_64bits(key, key_bytes),
                          .data_checksum = XXH3_64bits(data, data_bytes)};
    memcpy(head.magic, magic, sizeof magic);
    head.head_checksum = head_checksum(&head);
    return head;
}

pspec_status ps_cache_entry_write(const char *path, const void *key, size_t key_bytes,
                                  const void *data, size_t data_bytes, ps_error *error) {
    const ps_cache_head head = ps_cache_head_make(key, key_bytes, data, data_bytes);
    ps_output_file *file = NULL;
    PS_TRY(ps_cache_clear_way(path, error));
    PS_TRY(ps_output_open(&file, path, error));
    const struct {
        const void *bytes;
        size_t num;
    } parts[] = {{&head, sizeof head}, {key, key_bytes}, {data, data_bytes}};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].num > 0) { /* without bytes there may be no address */
            ps_output_write(file, parts[i].bytes, 1, parts[i].num);
        }
    }
    return ps_output_commit(&file, error);
}

/* ---- reading ---- */

typedef struct entry_file {
    const char *path;
    int descriptor;
    uint64_t num_bytes;
} entry_file;

/* Fewer bytes than asked for: the file ends there. */
static pspec_status read_bytes(const entry_file *file, void *out, size_t wanted, size_t *count,
                               ps_error *error) {
    ssize_t step = 1;
    *count = 0;
    while (*count < wanted && step > 0) {
        step = read(file->descriptor, (char *)out + *count, wanted - *count);
        if (step < 0) {
            return ps_read_fail(file->path, error);
        }
        *count += (size_t)step;
    }
    return PSPEC_OK;
}

/* The lengths fill the file exactly; subtractions, since sums could overflow. */
static bool is_sound(const ps_cache_head *head, uint64_t file_bytes) {
    const uint64_t behind = file_bytes - sizeof *head;
    return memcmp(head->magic, magic, sizeof magic) == 0 && head->version == VERSION &&
           head->head_checksum == head_checksum(head) && head->key_bytes <= behind &&
           head->data_bytes == behind - head->key_bytes && (size_t)behind == behind;
}

/* room holds data_bytes for the data and then key_bytes for the key. */
static pspec_status read_into(const entry_file *file, const ps_cache_head *head, const void *key,
                              size_t key_bytes, char *room, ps_cache_finding *finding,
                              ps_error *error) {
    const size_t num_data = (size_t)head->data_bytes;
    const size_t num_key = (size_t)head->key_bytes;
    char *const stored_key = room + num_data;
    size_t count = 0;
    *finding = PS_CACHE_BROKEN;
    PS_TRY(read_bytes(file, stored_key, num_key, &count, error));
    if (count != num_key || XXH3_64bits(stored_key, num_key) != head->key_checksum) {
        return PSPEC_OK;
    }
    if (num_key != key_bytes || (num_key > 0 && memcmp(stored_key, key, num_key) != 0)) {
        *finding = PS_CACHE_OTHER_KEY;
        return PSPEC_OK;
    }
    PS_TRY(read_bytes(file, room, num_data, &count, error));
    if (count == num_data && XXH3_64bits(room, num_data) == head->data_checksum) {
        *finding = PS_CACHE_FOUND;
    }
    return PSPEC_OK;
}

static pspec_status read_file(const entry_file *file, const void *key, size_t key_bytes,
                              void **data, size_t *data_bytes, ps_cache_finding *finding,
                              ps_error *error) {
    ps_cache_head head;
    size_t count = 0;
    *finding = PS_CACHE_BROKEN;
    if (file->num_bytes < sizeof head) {
        return PSPEC_OK;
    }
    PS_TRY(read_bytes(file, &head, sizeof head, &count, error));
    if (count != sizeof head || !is_sound(&head, file->num_bytes)) {
        return PSPEC_OK;
    }
    void *room = NULL;
    PS_TRY(ps_allocate(&room, (size_t)file->num_bytes - sizeof head, 1, "a saved result", error));
    const pspec_status status = read_into(file, &head, key, key_bytes, room, finding, error);
    if (status != PSPEC_OK || *finding != PS_CACHE_FOUND) {
        free(room);
        return status;
    }
    *data = room;
    *data_bytes = (size_t)head.data_bytes;
    (void)futimens(file->descriptor,
                   NULL); /* a folder that cannot be written has no order of use */
    return PSPEC_OK;
}

pspec_status ps_cache_entry_read(const char *path, const void *key, size_t key_bytes, void **data,
                                 size_t *data_bytes, ps_cache_finding *finding, ps_error *error) {
    entry_file file = {.path = path};
    ps_cache_file_kind kind = PS_CACHE_FILE_ABSENT;
    *data = NULL;
    *data_bytes = 0;
    *finding = PS_CACHE_ABSENT;
    PS_TRY(ps_cache_file_open(path, &file.descriptor, &file.num_bytes, &kind, error));
    if (kind != PS_CACHE_FILE_OWN) {
        *finding = kind == PS_CACHE_FILE_NONE ? PS_CACHE_BROKEN : PS_CACHE_ABSENT;
        return PSPEC_OK;
    }
    const pspec_status status = read_file(&file, key, key_bytes, data, data_bytes, finding, error);
    close(file.descriptor);
    return status;
}
