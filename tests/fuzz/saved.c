/* Saved tables of power and angular as JSON. What is taken is what the comparison counts on. */
#include "answers/check/saved_spectrum.h"
#include "fuzz.h"

#include <math.h>
#include <stdlib.h>

static void check_bins(const ps_saved_spectrum *saved) {
    const int64_t least = saved->on_sphere ? 1 : 0; /* boxes have frequencies below 1/2 */
    for (size_t b = 0; b < saved->num_bins; b++) {
        const ps_saved_bin *const bin = &saved->bins[b];
        if (bin->key < least || (b > 0 && bin->key <= saved->bins[b - 1].key)) {
            fuzz_fail("bin %zu is out of place", b);
        }
        if (!(bin->power >= 0 && isfinite(bin->power)) ||
            (saved->num_realizations > 1 && !(bin->standard_error >= 0))) {
            fuzz_fail("bin %zu has no power", b);
        }
    }
}

void fuzz_saved(const char *argument, fuzz_bytes input) {
    (void)argument;
    char *const text =
        fuzz_copy_text(input); /* without a NUL that matters: the parser knows its length */
    ps_saved_spectrum saved = {0};
    ps_error error = {0};
    const pspec_status status = ps_saved_table_parse(&saved, text, input.size, "saved", &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status == PSPEC_OK) {
        check_bins(&saved);
        if (saved.num_bins == 0 || saved.num_realizations == 0 || saved.max_frequency < 1 ||
            saved.dimension < 1 || !(saved.error >= 0) ||
            saved.smallest_points > saved.largest_points) {
            fuzz_fail("a question that nobody asks");
        }
    }
    ps_saved_spectrum_free(&saved);
    free(text);
}
