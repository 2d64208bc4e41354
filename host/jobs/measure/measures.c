#include "jobs/measure/measures.h"

#include "base/memory.h"
#include "base/text.h"
#include "jobs/measure/measure_rows.h"

#include <math.h>
#include <string.h>

/* Voronoi cells are made one after the other, in a microsecond each; discrepancies take the square
 * of N, half a second for 65536 points (two cores of a Zen 4). */
enum { MOST_CELLS = 1 << 20, MOST_PAIRED = 1 << 16 };

const ps_measure_row ps_measure_rows[PS_NUM_MEASURES] = {
    {.name = "least_distance",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_least_distance},
    {.name = "mean_distance",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_mean_distance},
    [PS_MEASURE_COINCIDENT_POINTS] = {.name = "coincident_points",
                                      .on_torus = true,
                                      .on_sphere = true,
                                      .needs = PS_MEASURE_NEEDS_NEAR,
                                      .of_set = ps_measure_coincident_points},
    {.name = "separation",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_separation},
    {.name = "number_variance",
     .on_torus = true,
     .most_dimension = PS_NEAR_MOST_WINDOW_DIMENSION,
     .needs = PS_MEASURE_NEEDS_NEAR | PS_MEASURE_NEEDS_WINDOWS,
     .of_set = ps_measure_number_variance},
    {.name = "capacity_error",
     .on_torus = true,
     .least_dimension = 2,
     .most_dimension = 2,
     .needs = PS_MEASURE_NEEDS_CELLS,
     .most_points = MOST_CELLS,
     .of_set = ps_measure_capacity_error},
    {.name = "star_discrepancy",
     .on_torus = true,
     .needs = PS_MEASURE_NEEDS_DISCREPANCY,
     .most_points = MOST_PAIRED,
     .of_set = ps_measure_star_discrepancy},
    {.name = "periodic_discrepancy",
     .on_torus = true,
     .needs = PS_MEASURE_NEEDS_DISCREPANCY,
     .most_points = MOST_PAIRED,
     .of_set = ps_measure_periodic_discrepancy},
    {.name = "stolarsky_sum",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_CHORDS,
     .of_set = ps_measure_stolarsky_sum},
    {.name = "cap_discrepancy",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_CHORDS,
     .of_set = ps_measure_cap_discrepancy},
    {.name = "low_exponent",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_low_exponent},
    {.name = "hyperuniformity_index",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_hyperuniformity_index},
    {.name = "peak_power",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_peak_power},
    {.name = "effective_nyquist",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_effective_nyquist},
    {.name = "oscillation",
     .on_torus = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_oscillation},
};

bool ps_measure_is_of(const ps_measure_row *measure, unsigned dimension, bool on_sphere) {
    const unsigned most = measure->most_dimension;
    return on_sphere ? measure->on_sphere
                     : measure->on_torus && dimension >= measure->least_dimension &&
                           (most == 0 || dimension <= most);
}

/* The number of the measure of that name, PS_NUM_MEASURES: there is none. */
static size_t find(const char *name, size_t length) {
    size_t i = 0;
    while (i < PS_NUM_MEASURES && (strncmp(ps_measure_rows[i].name, name, length) != 0 ||
                                   ps_measure_rows[i].name[length] != '\0')) {
        i++;
    }
    return i;
}

static pspec_status fail_name(const char *name, size_t length, ps_error *error) {
    ps_text known = {0};
    for (size_t i = 0; i < PS_NUM_MEASURES; i++) {
        ps_text_append(&known, "%s%s", i == 0 ? "" : ", ", ps_measure_rows[i].name);
    }
    pspec_status status = ps_text_check(&known, error);
    if (status == PSPEC_OK) {
        status = ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--measures: \"%.*s\" is no measure; known are %s", (int)length, name,
                         ps_text_string(&known));
    }
    ps_text_free(&known);
    return status;
}

pspec_status ps_measures_parse(ps_measure_set *out, const char *names, ps_error *error) {
    const ps_measure_set all = (UINT32_C(1) << PS_NUM_MEASURES) - 1;
    *out = names == NULL ? all : 0;
    for (const char *at = names; at != NULL && *at != '\0';) {
        const size_t length = strcspn(at, ",");
        const size_t number = find(at, length);
        if (number == PS_NUM_MEASURES) {
            return fail_name(at, length, error);
        }
        *out |= UINT32_C(1) << number;
        at += length + (at[length] == ',');
    }
    return *out != 0 ? PSPEC_OK : fail_name("", 0, error);
}
