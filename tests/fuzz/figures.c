/* Files with figures of a device. The first byte says whether the input gets a right checksum,
 * which hardly any would have. */
#include "fuzz.h"
#include "store/figures_file.h"
#include "store/figures_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check_range(double value, double least, double most) {
    if (value != 0 && !(value >= least && value <= most)) {
        fuzz_fail("%g is no figure of a device", value);
    }
}

static void check_figures(const ps_figures *figures) {
    if (figures->num_engines > PS_FIGURES_ENGINES) {
        fuzz_fail("%zu engines", figures->num_engines);
    }
    check_range(figures->flops[0], 1e3, 1e18);
    check_range(figures->flops[1], 1e3, 1e18);
    check_range(figures->copied_bytes, 1e3, 1e18);
    for (size_t i = 0; i < figures->num_engines; i++) {
        for (unsigned p = 0; p < PS_FIGURES_PRECISIONS; p++) {
            check_range(figures->engines[i].scales[p], 1e-3, 1e3);
            const double scale = ps_figures_scale(figures, figures->engines[i].engine, p);
            if (!(scale > 0 && isfinite(scale))) {
                fuzz_fail("times %g", scale);
            }
        }
    }
}

void fuzz_figures(const char *argument, fuzz_bytes input) {
    (void)argument;
    const ps_device_limits limits = {.name = "d", .platform = "p", .driver = "1"};
    const bool wants_checksum = (fuzz_take(&input) & 1) != 0;
    ps_figures figures;
    ps_error error = {0};
    ps_text text = {0};
    ps_text_append_bytes(&text, (const char *)input.data, input.size);
    if (wants_checksum) {
        ps_figures_add_checksum(&text);
    }
    const pspec_status status =
        ps_figures_parse(&figures, ps_text_string(&text), text.length, &limits, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (figures.is_measured != (status == PSPEC_OK)) {
        fuzz_fail("refused, and yet measured");
    }
    check_figures(&figures);
    ps_text_free(&text);
}
