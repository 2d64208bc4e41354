#include "answers/homogeneity/homogeneity.h"

#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "math/random/distributions.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const torus_columns[] = {"bin",     "phases",           "resultant", "z_score",
                                            "p_value", "adjusted_p_value", "worst",     "verdict"};
enum { NUM_COLUMNS = sizeof torus_columns / sizeof torus_columns[0] };

static bool is_on_sphere(const ps_frequencies *set) {
    return set->kind == PS_FREQUENCIES_DEGREES;
}

/* " up to 20 on axes 1 and 3"; axes are not named where all are meant. */
static void append_family(ps_text *out, const ps_phase_label *label, unsigned dimension) {
    const unsigned all = (1U << dimension) - 1;
    unsigned left = label->axes;
    ps_text_append(out, " up to %d", (int)label->reach);
    if (label->axes == all) {
        return;
    }
    ps_text_append(out, " on %s", (left & (left - 1)) == 0 ? "axis" : "axes");
    for (unsigned axis = 0; axis < dimension; axis++) {
        const unsigned bit = 1U << axis;
        if ((left & bit) != 0) {
            const bool is_first = left == label->axes;
            left &= ~bit;
            ps_text_append(out, "%s %u", is_first ? "" : left == 0 ? " and" : ",", axis + 1);
        }
    }
}

pspec_status ps_phase_label_write(const ps_phase_label *label, const ps_frequencies *set,
                                  ps_text *out, ps_error *error) {
    const char *const what = label->is_product ? "products" : "amplitudes";
    if (is_on_sphere(set)) {
        ps_text_append(out, "degree %d, order %d of %s, about %s", (int)label->k[0],
                       (int)label->k[1], what, label->is_turned ? "x" : "z");
        return ps_text_check(out, error);
    }
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        ps_text_append(out, "%s%d", axis == 0 ? "(" : ",", (int)label->k[axis]);
    }
    ps_text_append(out, ") of %s", what);
    if (label->is_product) {
        append_family(out, label, set->dimension);
    }
    return ps_text_check(out, error);
}

/* ---- rows -------------------------------------------------------------------------------- */

/* Tests of one ring or degree. */
typedef struct ring {
    size_t num;
    const ps_phase_test *worst;
} ring;

static size_t ring_of(const ps_homogeneity *self, const ps_frequencies *set, size_t i) {
    const int32_t *const k = self->labels[i].k;
    return is_on_sphere(set) ? (size_t)k[0]
                             : (size_t)ps_ring_of_norm2(ps_frequency_norm2(k, set->dimension));
}

/* Bonferroni: the smallest of num probabilities. */
static double joint_p_value(const ring *one) {
    return fmin(1, (double)one->num * one->worst->p_value);
}

static pspec_status add_row(ps_table *table, const ps_homogeneity *self, const ps_frequencies *set,
                            size_t number, const ring *one, ps_error *error) {
    ps_text label = {0};
    pspec_status status =
        ps_phase_label_write(&self->labels[one->worst - self->tests], set, &label, error);
    if (status == PSPEC_OK) {
        const double p_value = joint_p_value(one);
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(number),
            PS_INTEGER(one->num),
            PS_NUMBER(one->worst->resultant),
            PS_NUMBER(ps_normal_score(p_value)),
            PS_NUMBER(p_value),
            PS_NUMBER(one->worst->adjusted_p_value),
            PS_TEXT(ps_text_string(&label)),
            PS_TEXT(one->worst->differs ? "different" : "same"),
        };
        status = ps_table_add_row(table, cells, error);
    }
    ps_text_free(&label);
    return status;
}

static pspec_status add_rows(ps_table *table, const ps_homogeneity *self, const ps_frequencies *set,
                             ps_error *error) {
    size_t last = 0;
    ring *rings = NULL;
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < self->num_tests; i++) {
        const size_t number = ring_of(self, set, i);
        last = number > last ? number : last;
    }
    PS_TRY(PS_NEW(&rings, last + 1, "rings of phases", error));
    for (size_t i = 0; i < self->num_tests; i++) {
        ring *const one = &rings[ring_of(self, set, i)];
        if (one->num++ == 0 || self->tests[i].p_value < one->worst->p_value) {
            one->worst = &self->tests[i];
        }
    }
    for (size_t b = 0; status == PSPEC_OK && b <= last; b++) {
        if (rings[b].num > 0) {
            status = add_row(table, self, set, b, &rings[b], error);
        }
    }
    free(rings);
    return status;
}

/* ---- header ------------------------------------------------------------------------------ */

static double smallest_p_value(const ps_homogeneity *self) {
    double smallest = 1;
    for (size_t i = 0; i < self->num_tests; i++) {
        smallest = fmin(smallest, self->tests[i].adjusted_p_value);
    }
    return smallest;
}

pspec_status ps_verdict_add(ps_table *table, double false_alarm_rate, const char *different,
                            double smallest_p_value, bool is_different, ps_error *error) {
    const ps_meta entries[] = {
        {"false_alarm_rate", PS_NUMBER(false_alarm_rate)},
        {"different", PS_TEXT(different)},
        {"adjusted_p_value", PS_NUMBER(smallest_p_value)},
        {"verdict", PS_TEXT(is_different ? "different" : "same")},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_verdict(ps_table *table, const ps_homogeneity *self, bool on_sphere,
                                ps_error *error) {
    enum { TEXT_BYTES = 96 };
    char text[TEXT_BYTES];
    snprintf(text, sizeof text, "%zu of %zu phases", self->num_different, self->num_tests);
    PS_TRY(ps_table_add_meta(table, "invariance", PS_TEXT(on_sphere ? "rotations" : "translations"),
                             error));
    return ps_verdict_add(table, self->own.false_alarm_rate, text, smallest_p_value(self),
                          self->num_different > 0, error);
}

pspec_status ps_homogeneity_table(ps_table **out, const ps_homogeneity *self, ps_error *error) {
    const char *columns[NUM_COLUMNS];
    const ps_frequencies *const set = self->job->problem.frequencies;
    const bool on_sphere = is_on_sphere(set);
    for (size_t i = 0; i < NUM_COLUMNS; i++) {
        columns[i] = i == 0 && on_sphere ? "degree" : torus_columns[i];
    }
    PS_TRY(ps_table_create(out, "check", columns, NUM_COLUMNS, error));
    PS_TRY(ps_header_add_job(*out, &self->own, self->job, true, error));
    PS_TRY(add_verdict(*out, self, on_sphere, error));
    PS_TRY(ps_header_add_job(*out, &self->own, self->job, false, error));
    return add_rows(*out, self, set, error);
}
