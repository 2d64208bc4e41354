#include "files/digest.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

static void print(XXH128_hash_t hash, char out[PS_DIGEST_BYTES]) {
    snprintf(out, PS_DIGEST_BYTES, "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
}

void ps_digest_bytes(const void *bytes, size_t num_bytes, char out[PS_DIGEST_BYTES]) {
    print(XXH3_128bits(bytes, num_bytes), out);
}

static pspec_status digest_stream(FILE *file, XXH3_state_t *state, const char *path,
                                  ps_error *error) {
    unsigned char block[1 << 16];
    size_t got = 0;
    errno = 0;
    while ((got = fread(block, 1, sizeof block, file)) > 0) {
        XXH3_128bits_update(state, block, got);
    }
    return ferror(file)
               ? ps_fail(error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", path, strerror(errno))
               : PSPEC_OK;
}

pspec_status ps_digest_file(const char *path, char out[PS_DIGEST_BYTES], ps_error *error) {
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot open \"%s\": %s", path, strerror(errno));
    }
    XXH3_state_t *const state = XXH3_createState();
    pspec_status status = PSPEC_OK;
    if (state == NULL) {
        status = ps_fail(error, PSPEC_ERROR_MEMORY, "no memory to read \"%s\"", path);
    } else {
        XXH3_128bits_reset(state);
        status = digest_stream(file, state, path, error);
        print(XXH3_128bits_digest(state), out);
    }
    XXH3_freeState(state);
    fclose(file);
    return status;
}
