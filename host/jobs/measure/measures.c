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
     .meaning = "smallest distance of two points, over the largest that N points can have: of the "
                "densest lattice on the torus, by Fejes Toth's bound on the sphere",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_least_distance},
    {.name = "mean_distance",
     .meaning = "mean distance to the nearest neighbour, over the same",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_mean_distance},
    [PS_MEASURE_COINCIDENT_POINTS] = {.name = "coincident_points",
                                      .meaning = "points at the place of another one",
                                      .on_torus = true,
                                      .on_sphere = true,
                                      .needs = PS_MEASURE_NEEDS_NEAR,
                                      .of_set = ps_measure_coincident_points},
    {.name = "separation",
     .meaning = "smallest angle between two points",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_NEAR,
     .of_set = ps_measure_separation},
    {.name = "number_variance",
     .meaning = "variance over mean of the number of points in a ball anywhere that has 20 (in "
                "space 10, on a line 40) in the mean: 1 of independent points",
     .on_torus = true,
     .most_dimension = PS_NEAR_MOST_WINDOW_DIMENSION,
     .needs = PS_MEASURE_NEEDS_NEAR | PS_MEASURE_NEEDS_WINDOWS,
     .of_set = ps_measure_number_variance},
    {.name = "capacity_error",
     .meaning = "root mean square of N A - 1, A the areas of Voronoi cells",
     .on_torus = true,
     .least_dimension = 2,
     .most_dimension = 2,
     .needs = PS_MEASURE_NEEDS_CELLS,
     .most_points = MOST_CELLS,
     .of_set = ps_measure_capacity_error},
    {.name = "star_discrepancy",
     .meaning = "L2-star discrepancy",
     .on_torus = true,
     .needs = PS_MEASURE_NEEDS_DISCREPANCY,
     .most_points = MOST_PAIRED,
     .of_set = ps_measure_star_discrepancy},
    {.name = "periodic_discrepancy",
     .meaning = "periodic L2 discrepancy, over boxes that may cross the edges",
     .on_torus = true,
     .needs = PS_MEASURE_NEEDS_DISCREPANCY,
     .most_points = MOST_PAIRED,
     .of_set = ps_measure_periodic_discrepancy},
    {.name = "stolarsky_sum",
     .meaning = "mean distance of all ordered pairs of points, those of a point with itself among "
                "them: 4/3 minus four times the square of cap_discrepancy",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_CHORDS,
     .of_set = ps_measure_stolarsky_sum},
    {.name = "cap_discrepancy",
     .meaning = "L2 discrepancy over spherical caps",
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_CHORDS,
     .of_set = ps_measure_cap_discrepancy},
    {.name = "low_exponent",
     .meaning = "b of P ~ nu^b towards frequency 0, as power --fit has it; of a plateau missing",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_low_exponent},
    {.name = "hyperuniformity_index",
     .meaning = "power extrapolated to frequency 0, over that of the peak",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_hyperuniformity_index},
    {.name = "peak_power",
     .meaning = "power of the ring or degree with the largest one",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_peak_power},
    {.name = "effective_nyquist",
     .meaning = "half of the nu up to which the mean power is 0.1: 1/2 of a square grid (PSA "
                "prints twice that)",
     .on_torus = true,
     .on_sphere = true,
     .needs = PS_MEASURE_NEEDS_SPECTRUM,
     .of_spectrum = ps_measure_effective_nyquist},
    {.name = "oscillation",
     .meaning = "10 times the root mean square of P - 1 from where P first comes to 1 to a nu 5 "
                "further, without what few realizations make of it",
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
