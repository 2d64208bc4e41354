#include "jobs/variance/tails.h"

#include "base/memory.h"
#include "frequencies/frequencies.h"
#include "jobs/variance/prediction.h"

#include <math.h>
#include <stdlib.h>

/* Frequencies of a half lattice: a second of Bessel functions. Vectors are made in pieces, of which
 * each costs some kinds as much as its largest component. */
enum { MOST_FREQUENCIES = 1 << 21, MOST_CUTOFF = 1 << 12, NUM_VECTORS = 1 << 18 };

struct ps_tails {
    const ps_integrand *integrand;
    bool over_shells;
    size_t last;      /* the largest cut-off that was summed up to */
    double *beyond;   /* [last + 1]: the energy beyond each; that of 0 is all of it */
    double steepness; /* of the power law beyond the last; 0: none */
};

/* ---- the torus ----------------------------------------------------------------------------- */

typedef struct shell {
    const ps_tails *tails;
    double *energies; /* [last + 1] by cut-off */
    int32_t *vectors; /* [NUM_VECTORS][dimension] */
    double *powers;   /* [NUM_VECTORS] */
    size_t num;
} shell;

/* The least cut-off that has k. */
static size_t find_cutoff(const shell *self, const int32_t *k) {
    const unsigned dimension = self->tails->integrand->place.dimension;
    int64_t largest = 0;
    if (self->tails->over_shells) {
        return (size_t)ps_ring_of_norm2(ps_frequency_norm2(k, dimension));
    }
    for (unsigned i = 0; i < dimension; i++) {
        const int64_t size = k[i] < 0 ? -(int64_t)k[i] : k[i];
        largest = size > largest ? size : largest;
    }
    return (size_t)largest;
}

static pspec_status add_vectors(shell *self, ps_error *error) {
    const ps_tails *const tails = self->tails;
    const unsigned dimension = tails->integrand->place.dimension;
    PS_TRY(ps_integrand_powers(tails->integrand, self->vectors, self->num, self->powers, error));
    for (size_t i = 0; i < self->num; i++) {
        const size_t cutoff = find_cutoff(self, self->vectors + i * dimension);
        if (cutoff <= tails->last) { /* corners beyond the last ring are not */
            self->energies[cutoff] += 2 * self->powers[i];
        }
    }
    self->num = 0;
    return PSPEC_OK;
}

/* The next k of a face: `axis` stays, axes before it are within size - 1, those behind within size.
 * false: it was the last one. */
static bool step(int32_t *k, unsigned dimension, unsigned axis, int32_t size) {
    for (unsigned i = dimension; i-- > 0;) {
        const int32_t most = i < axis ? size - 1 : size;
        if (i == axis) {
            continue;
        }
        if (k[i] < most) {
            k[i]++;
            return true;
        }
        k[i] = -most;
    }
    return false;
}

/* All k with the largest component k_axis = size, of which the others of that size have come
 * before: the faces of all axes are half of the surface of the box. */
static pspec_status add_face(shell *self, unsigned axis, int32_t size, ps_error *error) {
    const unsigned dimension = self->tails->integrand->place.dimension;
    int32_t k[PS_MAX_DIMENSION];
    bool has_more = true;
    for (unsigned i = 0; i < dimension; i++) {
        k[i] = i == axis ? size : i < axis ? 1 - size : -size;
    }
    while (has_more) {
        for (unsigned i = 0; i < dimension; i++) {
            self->vectors[self->num * dimension + i] = k[i];
        }
        self->num++;
        has_more = step(k, dimension, axis, size);
        if (self->num == NUM_VECTORS) {
            PS_TRY(add_vectors(self, error));
        }
    }
    return PSPEC_OK;
}

static pspec_status fill_torus(const ps_tails *tails, double *energies, ps_error *error) {
    const unsigned dimension = tails->integrand->place.dimension;
    shell self = {.tails = tails, .energies = energies};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status,
               PS_NEW(&self.vectors, (size_t)NUM_VECTORS * dimension, "frequencies", error));
    PS_TRY_OUT(status, PS_NEW(&self.powers, NUM_VECTORS, "powers", error));
    for (size_t size = 1; size <= tails->last; size++) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            PS_TRY_OUT(status, add_face(&self, axis, (int32_t)size, error));
        }
    }
    PS_TRY_OUT(status, add_vectors(&self, error));
out:
    free(self.vectors);
    free(self.powers);
    return status;
}

size_t ps_tails_largest_cutoff(const ps_integrand *integrand, bool over_shells) {
    const ps_integrand_place place = integrand->place;
    const double reach = ps_prediction_reach(&integrand, 1, over_shells);
    const double half = 0.5;
    const double most =
        place.where != PS_SAMPLES_TORUS
            ? PS_MAX_DEGREE
            : fmin(half * (pow(2.0 * MOST_FREQUENCIES, 1.0 / place.dimension) - 1), MOST_CUTOFF);
    return (size_t)fmin(most, reach);
}

/* ---- both ---------------------------------------------------------------------------------- */

/* What is beyond is summed from below, as predictions have it, so that both have the same rounding.
 */
static void sum_up(ps_tails *self) {
    const double energy = ps_integrand_energy(self->integrand);
    long double sum = 0;
    self->beyond[0] = energy;
    for (size_t i = 1; i <= self->last; i++) {
        sum += self->beyond[i];
        self->beyond[i] = (double)fmaxl(energy - sum, 0);
    }
    const double least = self->beyond[self->last];
    const double octave = least > 0 ? self->beyond[self->last / 2] / least : 1;
    self->steepness =
        self->last > 1 ? log(octave) / log((double)self->last / (double)(self->last / 2)) : 0;
}

static pspec_status fill(ps_tails *self, ps_error *error) {
    self->last = ps_tails_largest_cutoff(self->integrand, self->over_shells);
    PS_TRY(PS_NEW(&self->beyond, self->last + 1, "energies", error));
    PS_TRY(self->integrand->place.where == PS_SAMPLES_TORUS
               ? fill_torus(self, self->beyond, error)
               : ps_integrand_degrees(self->integrand, self->last, self->beyond, error));
    sum_up(self);
    return PSPEC_OK;
}

pspec_status ps_tails_create(ps_tails **out, const ps_integrand *integrand, bool over_shells,
                             ps_error *error) {
    ps_tails *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "energies", error));
    self->integrand = integrand;
    self->over_shells = over_shells;
    const pspec_status status = fill(self, error);
    if (status != PSPEC_OK) {
        ps_tails_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_tails_destroy(ps_tails *tails) {
    if (tails != NULL) {
        free(tails->beyond);
    }
    free(tails);
}

double ps_tails_beyond(const ps_tails *tails, double cutoff) {
    const double last = (double)tails->last;
    return cutoff <= last ? tails->beyond[(size_t)cutoff]
                          : tails->beyond[tails->last] * pow(last / cutoff, tails->steepness);
}

double ps_tails_find(const ps_tails *tails, double energy) {
    const double least = tails->beyond[tails->last];
    const double reach = ps_prediction_reach(&tails->integrand, 1, tails->over_shells);
    if (least <= energy) {
        size_t cutoff = 1;
        while (tails->beyond[cutoff] > energy) {
            cutoff++;
        }
        return (double)cutoff;
    }
    const double law = tails->steepness > 0 && energy > 0
                           ? (double)tails->last * pow(least / energy, 1 / tails->steepness)
                           : INFINITY;
    return reach > (double)tails->last ? fmin(law, reach) : law;
}
