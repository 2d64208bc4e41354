#include "spectra/phases/invariance.h"

#include "base/memory.h"
#include "spectra/phases/shift_products.h"
#include "spectra/phases/turn_products.h"

#include <math.h>
#include <stdlib.h>

struct ps_invariance {
    const ps_frequencies *set;
    double error;              /* of an amplitude */
    ps_shift_products *shifts; /* on the torus */
    ps_turn_products *turns;   /* on the sphere */
    size_t num_amplitudes, num_sums;
    size_t num_kept;  /* complex numbers of a set */
    size_t *places;   /* on the sphere: [num_amplitudes], which of them have a phase */
    size_t num_made;  /* complex numbers that the products of a set are */
    double *products; /* [sets at a time][num_made][2] */
    double *norms;    /* [families of shifts] */
};

static bool is_on_sphere(const ps_frequencies *set) {
    return set->kind == PS_FREQUENCIES_DEGREES;
}

/* Orders 1 .. l of every degree; order 0 has no phase. */
static size_t count_amplitudes(const ps_frequencies *set) {
    return is_on_sphere(set) ? (size_t)set->degree_step * set->num * (set->num + 1) / 2 : set->num;
}

static size_t count_sums(const ps_frequencies *set) {
    return is_on_sphere(set) ? count_amplitudes(set) : ps_shift_families_sums(set);
}

size_t ps_invariance_count(const ps_frequencies *set) {
    return count_amplitudes(set) + count_sums(set);
}

size_t ps_invariance_sets(const ps_invariance *self) {
    return self->turns != NULL ? (size_t)PS_TURN_SETS : (size_t)PS_SHIFT_SETS;
}

/* Order by order, see ps_engine.coefficients. */
static void find_places(ps_invariance *self) {
    const size_t last = (size_t)self->set->max_frequency;
    size_t at = 0;
    for (size_t i = 0; i < self->set->num; i++) {
        const size_t l = (size_t)self->set->vectors[i];
        for (size_t m = 1; m <= l; m++) {
            self->places[at++] = m * (2 * last + 1 - m) / 2 + l;
        }
    }
}

static pspec_status prepare_turns(ps_invariance *self, ps_error *error) {
    const size_t degrees = (size_t)self->set->max_frequency + 1;
    self->num_kept = self->num_made = degrees * (degrees + 1) / 2;
    PS_TRY(PS_NEW(&self->places, self->num_amplitudes, "phases", error));
    find_places(self);
    return ps_turn_products_create(&self->turns, self->set->max_frequency, error);
}

static pspec_status prepare_shifts(ps_invariance *self, ps_error *error) {
    size_t num_families = 0;
    self->num_kept = 1 + self->set->num;
    self->num_made = self->num_sums;
    PS_TRY(ps_shift_products_create(&self->shifts, self->set, error));
    ps_shift_products_families(self->shifts, &num_families);
    return PS_NEW(&self->norms, num_families, "sums of products", error);
}

static pspec_status prepare(ps_invariance *self, ps_error *error) {
    self->num_amplitudes = count_amplitudes(self->set);
    self->num_sums = count_sums(self->set);
    PS_TRY((is_on_sphere(self->set) ? prepare_turns : prepare_shifts)(self, error));
    return ps_allocate_for(&self->products, ps_invariance_sets(self) * self->num_made,
                           2 * sizeof(double), "sums of products", error);
}

pspec_status ps_invariance_create(ps_invariance **out, const ps_frequencies *set,
                                  double amplitude_error, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "phases", error));
    (*out)->set = set;
    (*out)->error = amplitude_error;
    return prepare(*out, error);
}

void ps_invariance_destroy(ps_invariance *invariance) {
    if (invariance != NULL) {
        ps_shift_products_destroy(invariance->shifts);
        ps_turn_products_destroy(invariance->turns);
        free(invariance->places);
        free(invariance->products);
        free(invariance->norms);
        free(invariance);
    }
}

/* ---- labels ------------------------------------------------------------------------------ */

static void label_orders(const ps_invariance *self, bool is_turned, ps_phase_label *labels) {
    size_t at = 0;
    for (size_t i = 0; i < self->set->num; i++) {
        const int32_t l = self->set->vectors[i];
        for (int32_t m = 1; m <= l; m++, at++) {
            labels[at] = (ps_phase_label){.k = {l, m}, .is_turned = is_turned};
            labels[self->num_amplitudes + at] = labels[at];
            labels[self->num_amplitudes + at].is_product = true;
        }
    }
}

static void label_shifts(const ps_invariance *self, ps_phase_label *labels) {
    size_t num = 0;
    const ps_shift_family *const families = ps_shift_products_families(self->shifts, &num);
    for (size_t f = 0; f < num; f++) {
        for (size_t i = 0; i < families[f].num; i++) {
            ps_phase_label *const label = &labels[families[f].first + i];
            *label = (ps_phase_label){
                .is_product = true, .axes = families[f].axes, .reach = families[f].reach};
            ps_shift_family_shift(&families[f], i, label->k);
        }
    }
}

void ps_invariance_label(const ps_invariance *self, bool is_turned, ps_phase_label *labels) {
    const unsigned dimension = self->set->dimension;
    if (self->turns != NULL) {
        label_orders(self, is_turned, labels);
        return;
    }
    for (size_t i = 0; i < self->num_amplitudes; i++) {
        labels[i] = (ps_phase_label){0};
        for (unsigned axis = 0; axis < dimension; axis++) {
            labels[i].k[axis] = self->set->vectors[i * dimension + axis];
        }
    }
    label_shifts(self, labels + self->num_amplitudes);
}

/* ---- phases ------------------------------------------------------------------------------ */

/* A sum of products S conj S' has the error of S and S' times the root of the sum of squares. */
static double error_of_products(const ps_invariance *self, double norm) {
    return 2 * self->error * norm;
}

static void add_turns(const ps_invariance *self, const double *amplitudes, const double *products,
                      ps_phase_test *tests) {
    double sum = 0;
    for (size_t i = 0; i < 2 * self->num_kept; i++) {
        sum += 2 * amplitudes[i] * amplitudes[i]; /* of both signs of m */
    }
    const double error = error_of_products(self, sqrt(sum));
    for (size_t i = 0; i < self->num_amplitudes; i++) {
        const size_t place = self->places[i];
        ps_phase_test_add(&tests[i], amplitudes + 2 * place, self->error);
        ps_phase_test_add(&tests[self->num_amplitudes + i], products + 2 * place, error);
    }
}

static void add_shifts(const ps_invariance *self, const double *amplitudes, const double *products,
                       ps_phase_test *tests) {
    size_t num = 0;
    const ps_shift_family *family = ps_shift_products_families(self->shifts, &num);
    const double *const after_dc = amplitudes + 2;
    for (size_t i = 0; i < self->num_amplitudes; i++) {
        ps_phase_test_add(&tests[i], after_dc + 2 * i, self->error);
    }
    for (size_t f = 0; f < num; f++, family++) {
        const double error = error_of_products(self, self->norms[f]);
        for (size_t i = family->first; i < family->first + family->num; i++) {
            ps_phase_test_add(&tests[self->num_amplitudes + i], products + 2 * i, error);
        }
    }
}

void ps_invariance_add(ps_invariance *self, size_t num_sets, const double *all_amplitudes,
                       size_t first, ps_phase_test *tests) {
    const double *const amplitudes = all_amplitudes + first * 2 * self->num_kept;
    if (self->turns != NULL) {
        ps_turn_products_run(self->turns, num_sets, amplitudes, self->products);
    } else {
        ps_shift_products_run(self->shifts, num_sets, amplitudes + 2, 2 * self->num_kept,
                              self->products, self->norms);
    }
    for (size_t r = 0; r < num_sets; r++) {
        (self->turns != NULL ? add_turns : add_shifts)(self, amplitudes + r * 2 * self->num_kept,
                                                       self->products + r * 2 * self->num_made,
                                                       tests);
    }
}
