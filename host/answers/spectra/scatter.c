#include "answers/spectra/scatter.h"

#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"
#include "base/text.h"
#include "spectra/phases/phase_tests.h"
#include "spectra/spectrum.h"

#include <math.h>
#include <stdlib.h>

/* ---- rows ------------------------------------------------------------------------------------ */

/* Where a job keeps an entry of the row: a frequency of the half lattice, or the one opposite. */
typedef struct entry {
    size_t index; /* 0: S(0), else 1 + number of the frequency */
    bool is_conjugate;
} entry;

/* The box [2K+1]^d is read as [2K+1][rest]: the row is one of its columns. */
static void find_row(entry *row, const ps_frequencies_spec *asked, const ps_frequencies *set) {
    const size_t side = 2 * (size_t)set->max_frequency + 1;
    size_t rest = 1;
    size_t column = 0;
    for (unsigned axis = 1; axis < set->dimension; axis++) {
        rest *= side;
        column = column * side + (size_t)(asked->shown[axis] + set->max_frequency);
    }
    const size_t num_entries = side * rest;
    for (size_t i = 0; i < set->num; i++) {
        const size_t place = ps_spectrum_place(set, i);
        const size_t opposite = num_entries - 1 - place;
        if (place % rest == column) {
            row[place / rest] = (entry){1 + i, false};
        }
        if (opposite % rest == column) {
            row[opposite / rest] = (entry){1 + i, true};
        }
    }
}

pspec_status ps_scatter_take(ps_scatter *out, double **rows, const ps_frequencies_spec *asked,
                             const ps_power_job *job, ps_error *error) {
    const ps_frequencies *const set = job->problem.frequencies;
    const size_t side = 2 * (size_t)set->max_frequency + 1;
    const size_t num_sets = job->num_kept;
    const double *amplitudes = job->kept;
    entry *row = NULL;
    PS_TRY(PS_NEW(&row, side, "a row of frequencies", error)); /* zeros: S(0) */
    find_row(row, asked, set);
    const pspec_status status =
        ps_allocate_for(rows, num_sets * side, 2 * sizeof **rows, "coefficients", error);
    double *at = *rows;
    for (size_t r = 0; status == PSPEC_OK && r < num_sets; r++, amplitudes += 2 + 2 * set->num) {
        for (size_t j = 0; j < side; j++, at += 2) {
            at[0] = amplitudes[2 * row[j].index];
            at[1] = amplitudes[2 * row[j].index + 1] * (row[j].is_conjugate ? -1 : 1);
        }
    }
    free(row);
    *out = (ps_scatter){num_sets, asked, set->max_frequency, *rows};
    return status;
}

/* ---- the header ------------------------------------------------------------------------------ */

typedef struct facts {
    double mean[2];
    double error;   /* standard error of either part; nan of one set */
    double p_value; /* 1: too few phases to tell */
} facts;

static facts find_facts(const ps_scatter *self) {
    facts out = {.error = NAN};
    ps_phase_test phases = {0};
    const double num = (double)self->num_sets;
    const size_t stride = 2 * (2 * (size_t)self->max_frequency + 1);
    const double *const first = self->rows + 2 * (self->asked->shown[0] + self->max_frequency);
    for (size_t r = 0; r < self->num_sets; r++) {
        const double *const value = first + r * stride;
        out.mean[0] += value[0] / num;
        out.mean[1] += value[1] / num;
        ps_phase_test_add(&phases, value, 0);
    }
    double sum = 0;
    for (size_t r = 0; r < self->num_sets; r++) {
        const double *const value = first + r * stride;
        sum += (value[0] - out.mean[0]) * (value[0] - out.mean[0]) +
               (value[1] - out.mean[1]) * (value[1] - out.mean[1]);
    }
    if (self->num_sets > 1) {
        out.error = sqrt(sum / 2 / (num - 1) / num);
    }
    const double length = hypot(phases.cosines, phases.sines);
    out.p_value =
        ps_rayleigh_p_value(phases.num, phases.num > 0 ? fmin(1, length / (double)phases.num) : 0);
    return out;
}

pspec_status ps_scatter_add_header(ps_table *table, const ps_frequencies_spec *asked,
                                   const ps_power_job *job, ps_error *error) {
    ps_scatter self;
    double *rows = NULL;
    ps_text frequency = {0};
    pspec_status status = ps_scatter_take(&self, &rows, asked, job, error);
    for (unsigned axis = 0; axis < asked->num_shown; axis++) {
        ps_text_append(&frequency, "%s%d", axis > 0 ? "," : "", (int)asked->shown[axis]);
    }
    PS_TRY_OUT(status, status);
    PS_TRY_OUT(status, ps_text_check(&frequency, error));
    const facts found = find_facts(&self);
    const ps_meta entries[] = {
        {"scatter_frequency", PS_TEXT(ps_text_string(&frequency))},
        {"scatter_real", PS_NUMBER(found.mean[0])},
        {"scatter_imaginary", PS_NUMBER(found.mean[1])},
        {"scatter_error", ps_number_or_missing(found.error)},
        {"scatter_phase_p_value", PS_NUMBER(found.p_value)},
    };
    status = ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
out:
    free(rows);
    ps_text_free(&frequency);
    return status;
}
