/* Spectrum files. The first byte: does the harness append the right checksum? Without that hardly
 * an input would come past it. What is read must come back, bit by bit, when it is written and read
 * again.
 */
#include "fuzz.h"

#include "pointspec/pointspec.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Allocated; without a checksum just a copy. */
static fuzz_bytes complete(fuzz_bytes input, bool with_checksum) {
    enum { CHECKSUM_BYTES = 4 };
    uint8_t *const bytes = fuzz_allocate(NULL, input.size + CHECKSUM_BYTES, 1);
    fuzz_bytes whole = {bytes, input.size};
    if (input.size > 0) {
        memcpy(bytes, input.data, input.size);
    }
    const unsigned long sum = crc32_z(0, bytes, input.size);
    for (unsigned i = 0; with_checksum && i < CHECKSUM_BYTES; i++) {
        bytes[whole.size++] = (uint8_t)(sum >> (8 * i));
    }
    return whole;
}

static pspec_status load(pspec_spectrum **out, pspec_context *context, const fuzz_file *file) {
    const pspec_status status = pspec_spectrum_load(out, context, file->path);
    ps_error error = {.status = status};
    strncpy(error.message, pspec_context_message(context), sizeof error.message - 1);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    return status;
}

static void compare(const pspec_spectrum *a, const pspec_spectrum *b) {
    size_t num[2] = {0};
    size_t num_bins[2] = {0};
    pspec_spectrum_frequencies(a, &num[0]);
    pspec_spectrum_frequencies(b, &num[1]);
    const pspec_bin *const bins[] = {pspec_spectrum_bins(a, &num_bins[0]),
                                     pspec_spectrum_bins(b, &num_bins[1])};
    if (num[0] != num[1] || num_bins[0] != num_bins[1] ||
        pspec_spectrum_num_realizations(a) != pspec_spectrum_num_realizations(b)) {
        fuzz_fail("another spectrum comes back");
    }
    if (num[0] > 0 &&
        memcmp(pspec_spectrum_powers(a), pspec_spectrum_powers(b), num[0] * sizeof(double)) != 0) {
        fuzz_fail("other powers come back");
    }
    for (size_t i = 0; i < num_bins[0]; i++) {
        if (memcmp(&bins[0][i].power, &bins[1][i].power, sizeof(double)) != 0) {
            fuzz_fail("another power of bin %zu comes back", i);
        }
    }
}

static void check_round_trip(pspec_context *context, const pspec_spectrum *spectrum) {
    fuzz_file copy = fuzz_file_make((fuzz_bytes){NULL, 0});
    pspec_spectrum *again = NULL;
    if (pspec_spectrum_save(spectrum, context, copy.path) != PSPEC_OK ||
        load(&again, context, &copy) != PSPEC_OK) {
        fuzz_fail("what was read cannot be written and read: %s", pspec_context_message(context));
    }
    compare(spectrum, again);
    pspec_spectrum_destroy(again);
    fuzz_file_close(&copy);
}

void fuzz_spectrum(const char *argument, fuzz_bytes input) {
    (void)argument;
    const bool with_checksum = (fuzz_take(&input) & 1) != 0;
    const fuzz_bytes whole = complete(input, with_checksum);
    fuzz_file file = fuzz_file_make(whole);
    pspec_context *const context = pspec_context_create();
    pspec_spectrum *spectrum = NULL;
    if (context != NULL && load(&spectrum, context, &file) == PSPEC_OK) {
        check_round_trip(context, spectrum);
    }
    pspec_spectrum_destroy(spectrum);
    pspec_context_destroy(context);
    fuzz_file_close(&file);
    free((void *)whole.data);
}
