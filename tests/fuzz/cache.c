/* Files of the cache of results. */
#include "fuzz.h"

#include "store/cache_entry.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* The first byte has flags. */
enum { WITH_CHECKSUMS = 1, ASK_FOR_STORED_KEY = 2 };

/* The key as the head has it, where it fits. */
static fuzz_bytes stored_key(fuzz_bytes file) {
    ps_cache_head head;
    if (file.size < sizeof head) {
        return (fuzz_bytes){NULL, 0};
    }
    memcpy(&head, file.data, sizeof head);
    const size_t behind = file.size - sizeof head;
    return (fuzz_bytes){file.data + sizeof head,
                        head.key_bytes < behind ? (size_t)head.key_bytes : behind};
}

/* Without right checksums hardly an input would come past them. */
static void set_checksums(uint8_t *bytes, size_t num_bytes) {
    ps_cache_head head;
    const fuzz_bytes key = stored_key((fuzz_bytes){bytes, num_bytes});
    if (num_bytes < sizeof head) {
        return;
    }
    memcpy(&head, bytes, sizeof head);
    head.key_checksum = XXH3_64bits(key.data, key.size);
    head.data_checksum = XXH3_64bits(key.data + key.size, num_bytes - sizeof head - key.size);
    head.head_checksum = XXH3_64bits(&head, offsetof(ps_cache_head, head_checksum));
    memcpy(bytes, &head, sizeof head);
}

/* What is found is what stands behind the key that was asked for. */
static void check_found(fuzz_bytes file, fuzz_bytes key, const void *data, size_t num_bytes) {
    const fuzz_bytes stored = stored_key(file);
    if (stored.size != key.size || memcmp(stored.data, key.data, key.size) != 0) {
        fuzz_fail("the result of another key");
    }
    if (sizeof(ps_cache_head) + key.size + num_bytes != file.size ||
        memcmp(data, stored.data + stored.size, num_bytes) != 0) {
        fuzz_fail("another result");
    }
}

void fuzz_cache(const char *argument, fuzz_bytes input) {
    (void)argument;
    const uint8_t flags = fuzz_take(&input);
    uint8_t *const bytes = (uint8_t *)fuzz_copy_text(input);
    const fuzz_bytes whole = {bytes, input.size};
    void *data = NULL;
    size_t num_bytes = 0;
    ps_cache_finding finding = PS_CACHE_ABSENT;
    ps_error error = {0};
    if ((flags & WITH_CHECKSUMS) != 0) {
        set_checksums(bytes, input.size);
    }
    const fuzz_bytes key = (flags & ASK_FOR_STORED_KEY) != 0
                               ? stored_key(whole)
                               : (fuzz_bytes){(const uint8_t *)"k", 1};
    fuzz_file file = fuzz_file_make(whole);
    const pspec_status status =
        ps_cache_entry_read(file.path, key.data, key.size, &data, &num_bytes, &finding, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if ((status == PSPEC_OK && finding == PS_CACHE_FOUND) != (data != NULL)) {
        fuzz_fail("data without a finding, or the other way round");
    }
    if (data != NULL) {
        check_found(whole, key, data, num_bytes);
    }
    free(data);
    fuzz_file_close(&file);
    free(bytes);
}
