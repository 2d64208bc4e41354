#include "files/packed/gzip.h"

#include "base/memory.h"
#include "files/descriptor.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    COMPRESSED_BYTES = 1 << 18, /* of one read, not less than the buffer of ps_input */
    GZIP_ONLY = 16,             /* added to the window bits: no zlib streams, no raw deflate */
    MOST_AT_ONCE = 1 << 30      /* zlib counts in unsigned int */
};

struct ps_gzip {
    ps_gzip_kind kind;
    int descriptor;
    const char *name;
    z_stream stream;
    bool is_between_members; /* the input may end here */
    unsigned char compressed[COMPRESSED_BYTES];
};

static const char *kind_name(const ps_gzip *gzip) {
    return gzip->kind == PS_GZIP_RAW ? "deflated" : "gzip";
}

static pspec_status fail_zlib(const ps_gzip *gzip, int code, ps_error *error) {
    const char *const message = gzip->stream.msg;
    if (code == Z_MEM_ERROR) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory to decompress %s", gzip->name);
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: its %s data are damaged: %s", gzip->name,
                   kind_name(gzip), message != NULL ? message : "zlib does not say how");
}

pspec_status ps_gzip_create(ps_gzip **out, ps_gzip_kind kind, int descriptor, const char *name,
                            const unsigned char *start, size_t num_bytes, ps_error *error) {
    ps_gzip *gzip = NULL;
    PS_TRY(PS_NEW(&gzip, 1, "decompression", error));
    gzip->kind = kind;
    gzip->descriptor = descriptor;
    gzip->name = name;
    const int code =
        inflateInit2(&gzip->stream, kind == PS_GZIP_RAW ? -MAX_WBITS : MAX_WBITS + GZIP_ONLY);
    if (code != Z_OK) {
        free(gzip);
        return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for decompression");
    }
    if (num_bytes > 0) {
        memcpy(gzip->compressed, start, num_bytes);
    }
    gzip->stream.next_in = gzip->compressed;
    gzip->stream.avail_in = (uInt)num_bytes;
    *out = gzip;
    return PSPEC_OK;
}

void ps_gzip_destroy(ps_gzip *gzip) {
    if (gzip != NULL) {
        inflateEnd(&gzip->stream);
        free(gzip);
    }
}

static pspec_status refill(ps_gzip *gzip, bool *is_at_end, ps_error *error) {
    size_t count = 0;
    PS_TRY(ps_descriptor_read(gzip->descriptor, gzip->name, gzip->compressed, COMPRESSED_BYTES,
                              &count, error));
    gzip->stream.next_in = gzip->compressed;
    gzip->stream.avail_in = (uInt)count;
    *is_at_end = count == 0;
    if (*is_at_end && !gzip->is_between_members) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is truncated: its %s data go on", gzip->name,
                       kind_name(gzip));
    }
    return PSPEC_OK;
}

/* One call of zlib. A finished member may be followed by another. Without input it still may have
 * output that found no room before. */
static pspec_status inflate_step(ps_gzip *gzip, ps_error *error) {
    if (gzip->is_between_members && gzip->stream.avail_in == 0) {
        return PSPEC_OK;
    }
    if (gzip->is_between_members) {
        inflateReset(&gzip->stream);
        gzip->is_between_members = false;
    }
    const int code = inflate(&gzip->stream, Z_NO_FLUSH);
    gzip->is_between_members = code == Z_STREAM_END;
    return code == Z_OK || code == Z_STREAM_END || code == Z_BUF_ERROR
               ? PSPEC_OK
               : fail_zlib(gzip, code, error);
}

pspec_status ps_gzip_read(ps_gzip *gzip, void *out, size_t max_bytes, size_t *count,
                          ps_error *error) {
    const uInt room = (uInt)(max_bytes < MOST_AT_ONCE ? max_bytes : MOST_AT_ONCE);
    bool is_at_end = false;
    gzip->stream.next_out = out;
    gzip->stream.avail_out = room;
    while (!is_at_end && !(gzip->kind == PS_GZIP_RAW && gzip->is_between_members)) {
        PS_TRY(inflate_step(gzip, error));
        if (gzip->stream.avail_out < room) {
            break;
        }
        if (gzip->stream.avail_in == 0) {
            PS_TRY(refill(gzip, &is_at_end, error));
        }
    }
    *count = room - gzip->stream.avail_out;
    return PSPEC_OK;
}
