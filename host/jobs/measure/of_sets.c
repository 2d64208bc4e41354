/* Measures of one set of points. */
#include "jobs/measure/measure_rows.h"
#include "math/neumaier.h"
#include "math/pi.h"
#include "samplers/optimized/cells.h"

#include <math.h>

/* ---- distances ----------------------------------------------------------------------------- */

/* Center densities of the densest lattices of 1 to 6 dimensions (Conway and Sloane, Sphere
 * Packings, Lattices and Groups, Table 1.2): balls of radius 1 in a unit of volume. */
static double center_density(unsigned dimension) {
    const double densities[] = {0.5,     0.5 / sqrt(3),   0.25 / sqrt(2),
                                1.0 / 8, 0.125 / sqrt(2), 0.125 / sqrt(3)};
    return densities[dimension - 1];
}

/* Chord (4 - csc^2(pi N / (6 (N - 2))))^(1/2), reached by N = 3, 4, 6 and 12. */
static double fejes_toth(double num) {
    const double sine = sin(PS_PI * num / (6 * (num - 2)));
    return num < 3 ? 2 : sqrt(4 - 1 / (sine * sine));
}

double ps_measure_largest_distance(size_t num, unsigned dimension, bool on_sphere) {
    return on_sphere ? fejes_toth((double)num)
                     : 2 * pow(center_density(dimension) / (double)num, 1.0 / dimension);
}

static double largest_distance(const ps_measured_set *set) {
    return ps_measure_largest_distance(set->num, set->dimension, set->on_sphere);
}

static double least_distance(const ps_measured_set *set) {
    const double *const distances = ps_near_distances(set->near);
    double least = INFINITY;
    for (size_t i = 0; i < set->num; i++) {
        least = fmin(least, distances[i]);
    }
    return isinf(least) ? (double)NAN : least; /* one point */
}

PS_MEASURE_OF_SET(least_distance) {
    (void)error;
    *value = least_distance(set) / largest_distance(set);
    return PSPEC_OK;
}

PS_MEASURE_OF_SET(mean_distance) {
    const double *const distances = ps_near_distances(set->near);
    ps_neumaier sum = {0, 0};
    (void)error;
    for (size_t i = 0; set->num > 1 && i < set->num; i++) {
        ps_neumaier_add(&sum, distances[i]);
    }
    *value = set->num > 1 ? ps_neumaier_value(&sum) / ((double)set->num * largest_distance(set))
                          : (double)NAN;
    return PSPEC_OK;
}

PS_MEASURE_OF_SET(coincident_points) {
    const double *const distances = ps_near_distances(set->near);
    (void)error;
    *value = 0;
    for (size_t i = 0; i < set->num; i++) {
        *value += distances[i] == 0;
    }
    return PSPEC_OK;
}

PS_MEASURE_OF_SET(separation) {
    (void)error;
    const double chord = least_distance(set);
    *value = 2 * asin(chord > 2 ? 1 : chord / 2); /* fmin would lose what is missing */
    return PSPEC_OK;
}

/* ---- windows -------------------------------------------------------------------------------- */

PS_MEASURE_OF_SET(number_variance) {
    (void)error;
    *value = ps_near_number_variance(set->near, NEAR_WINDOWS - 1, true);
    return PSPEC_OK;
}

/* ---- areas --------------------------------------------------------------------------------- */

static pspec_status sum_areas(const ps_power_cells *cells, double *squares, ps_error *error) {
    const double num = (double)cells->num;
    ps_neumaier sum = {0, 0};
    for (size_t i = 0; i < cells->num; i++) {
        ps_cell cell;
        ps_power_cells_clip(cells, i, NULL, 0, &cell);
        if (cell.has_no_room) {
            return ps_power_cells_fail_room(cells, i, error);
        }
        const double off = num * ps_polygon_moments(ps_cell_polygon(&cell)).area - 1;
        ps_neumaier_add(&sum, off * off);
    }
    *squares = ps_neumaier_value(&sum);
    return PSPEC_OK;
}

/* Cells need a few points to be their neighbours' neighbours once. */
PS_MEASURE_OF_SET(capacity_error) {
    ps_power_cells cells = {0};
    double squares = NAN;
    *value = NAN;
    if (set->num < PS_CELLS_LEAST_POINTS || set->num > PS_CELLS_MOST_POINTS) {
        return PSPEC_OK;
    }
    PS_TRY(ps_power_cells_create(&cells, set->num, set->points, error));
    const pspec_status status = sum_areas(&cells, &squares, error);
    ps_power_cells_destroy(&cells);
    *value = sqrt(squares / (double)set->num);
    return status;
}

/* ---- sums over pairs ----------------------------------------------------------------------- */

PS_MEASURE_OF_SET(star_discrepancy) {
    (void)error;
    *value = set->discrepancies.star;
    return PSPEC_OK;
}

PS_MEASURE_OF_SET(periodic_discrepancy) {
    (void)error;
    *value = set->discrepancies.periodic;
    return PSPEC_OK;
}

PS_MEASURE_OF_SET(stolarsky_sum) {
    (void)error;
    *value = set->mean_chord;
    return PSPEC_OK;
}

/* Stolarsky's principle: the mean distance of the sphere is 4/3. */
PS_MEASURE_OF_SET(cap_discrepancy) {
    const double mean = 4.0 / 3;
    (void)error;
    *value = sqrt(fmax(mean - set->mean_chord, 0)) / 2;
    return PSPEC_OK;
}
