/* Kernels of the device that belong to no engine: averages over realizations. */
#include "verify/stress.h"

#include "base/memory.h"
#include "engines/host/host_direct.h"
#include "engines/engine.h"
#include "jobs/estimator.h"
#include "verify/stress_shapes.h"

#include <math.h>
#include <stdlib.h>

/* ---- averages ------------------------------------------------------------------------------ */

/* More realizations than a block of sums holds, and rings with one member and with many. */
enum { REALIZATIONS = 100, POINTS = 24, REACH = 9 };

typedef struct averages {
    ps_frequencies set;
    pspec_pattern patterns[REALIZATIONS];
    ps_estimator *estimator;
    ps_spectrum spectrum;
    double *powers; /* [realization][frequency] of the referee */
} averages;

static void free_averages(averages *self) {
    ps_spectrum_free(&self->spectrum);
    ps_estimator_destroy(self->estimator);
    ps_frequencies_free(&self->set);
    for (size_t r = 0; r < REALIZATIONS; r++) {
        ps_stress_pattern_free(&self->patterns[r]);
    }
    free(self->powers);
}

static pspec_status make_averages(averages *self, ps_error *error) {
    PS_TRY(ps_frequencies_lattice(&self->set, 2, REACH, true, error));
    PS_TRY(ps_frequencies_enumerate(&self->set, error));
    PS_TRY(PS_NEW(&self->powers, REALIZATIONS * self->set.num, "powers", error));
    for (size_t r = 0; r < REALIZATIONS; r++) {
        PS_TRY(ps_stress_shape_make(&ps_torus_shapes[0], 2, POINTS, r, &self->patterns[r], error));
        for (size_t i = 0; i < self->set.num; i++) {
            long double re = 0;
            long double im = 0;
            ps_host_sum(&self->patterns[r], self->set.vectors + 2 * i, &re, &im);
            self->powers[r * self->set.num + i] = (double)(re * re + im * im) / POINTS;
        }
    }
    return PSPEC_OK;
}

static pspec_status run_estimator(averages *self, ps_device *device, ps_precision precision,
                                  double *bound, ps_error *error) {
    const ps_estimator_options options = {.problem = {.frequencies = &self->set,
                                                      .num_points = POINTS,
                                                      .num_realizations = REALIZATIONS,
                                                      .tolerance = 1},
                                          .engine = &ps_torus_direct,
                                          .precision = precision,
                                          .batch = REALIZATIONS,
                                          .normalization = PSPEC_NORMALIZATION_EFFECTIVE};
    PS_TRY(ps_estimator_create(&self->estimator, &options, device, error));
    PS_TRY(ps_estimator_add(self->estimator, self->patterns, REALIZATIONS, error));
    PS_TRY(ps_estimator_settle(self->estimator, error));
    *bound = ps_estimator_accuracy(self->estimator).error;
    return ps_estimator_spectrum(self->estimator, &self->spectrum, error);
}

/* Mean and standard error of a ring from the referee's powers. */
static ps_mean average_ring(const averages *self, int64_t ring) {
    double sum = 0;
    double squares = 0;
    for (size_t r = 0; r < REALIZATIONS; r++) {
        double power = 0;
        double num = 0;
        for (size_t i = 0; i < self->set.num; i++) {
            if (ps_ring_of_norm2(ps_frequency_norm2(self->set.vectors + 2 * i, 2)) == ring) {
                power += self->powers[r * self->set.num + i];
                num += 1;
            }
        }
        sum += power / num;
        squares += power / num * power / num;
    }
    const double mean = sum / REALIZATIONS;
    const double variance = (squares - sum * mean) / (REALIZATIONS - 1);
    return (ps_mean){mean, sqrt(variance / REALIZATIONS)};
}

/* Roots of mean powers are off by no more than S is, in the mean over all of them. Standard errors
 * are lengths of vectors of M ring powers over M: an error e of S, which is one of 2 e sqrt(P) of a
 * power, is less than that in them. */
static double compare_rings(const averages *self) {
    double sum = 0;
    double num = 0;
    for (size_t b = 0; b < self->spectrum.num_bins; b++) {
        const ps_spectrum_bin *bin = &self->spectrum.bins[b];
        const ps_mean truth = average_ring(self, bin->key);
        const double off = sqrt(bin->power) - sqrt(truth.mean);
        const double other = (bin->standard_error - truth.standard_error) / (2 * sqrt(truth.mean));
        sum += (double)bin->count * (off * off + other * other);
        num += (double)bin->count;
    }
    return sqrt(sum / num);
}

static pspec_status measure_averages(ps_device *device, ps_precision precision, double *found,
                                     double *bound, ps_error *error) {
    averages self = {0};
    pspec_status status = make_averages(&self, error);
    if (status == PSPEC_OK) {
        status = run_estimator(&self, device, precision, bound, error);
    }
    if (status == PSPEC_OK) {
        *found = compare_rings(&self);
    }
    free_averages(&self);
    return status;
}

const ps_stress_probe ps_probe_averages = {.engine = "averages",
                                           .needs_device = true,
                                           .has_precision = {true, true, false},
                                           .measure = measure_averages};
