#define PRECISION 64
#include "integrands/files/series.h"

#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/torus_series.h"
#include "math/neumaier.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LARGEST_FREQUENCY = 1 << 28, /* as of spectra */
    MOST_PAIR_TERMS = 400        /* of correlations, of which half a million may be asked for */
};

/* ---- from the file to a list --------------------------------------------------------------- */

/* The first component that is not 0 is positive in the one that stands for both. */
static void set_key(ps_coefficient *one, const int32_t *k, unsigned dimension) {
    unsigned axis = 0;
    while (axis < dimension && k[axis] == 0) {
        axis++;
    }
    one->is_its_own = axis == dimension;
    one->is_opposite = axis < dimension && k[axis] < 0;
    for (unsigned i = 0; i < dimension; i++) {
        one->key[i] = one->is_opposite ? -k[i] : k[i];
    }
}

static pspec_status take_rows(ps_coefficient_list *list, const ps_coefficient_file *file,
                              ps_error *error) {
    const unsigned dimension = list->num_keys;
    const unsigned columns = dimension + 2;
    PS_TRY(PS_NEW(&list->all, file->num_rows, "coefficients", error));
    for (size_t i = 0; i < file->num_rows; i++) {
        const double *const row = file->rows + i * (columns + 1);
        ps_coefficient *const one = &list->all[i];
        int32_t k[PS_MAX_DIMENSION];
        for (unsigned axis = 0; axis < dimension; axis++) {
            PS_TRY(ps_coefficient_key(list, row, axis, columns, "frequency", -LARGEST_FREQUENCY,
                                      LARGEST_FREQUENCY, &k[axis], error));
        }
        set_key(one, k, dimension);
        one->re = row[dimension];
        one->im = one->is_opposite ? -row[dimension + 1] : row[dimension + 1];
        one->line = (size_t)row[columns];
    }
    list->num = file->num_rows;
    return PSPEC_OK;
}

static pspec_status check_shape(const ps_coefficient_list *list, const ps_npy_array *array,
                                ps_error *error) {
    char shape[PS_NPY_SHAPE_BYTES];
    if (array->rank != list->num_keys) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %s; coefficients have an axis for each of the %u dimension%s",
                       list->path, ps_npy_shape(array, shape), list->num_keys,
                       list->num_keys == 1 ? "" : "s");
    }
    for (unsigned axis = 0; axis < array->rank; axis++) {
        if (array->shape[axis] % 2 == 0 || array->shape[axis] / 2 > LARGEST_FREQUENCY) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: %s; frequencies -K..K of an axis are an odd number, and K is at "
                           "most %d",
                           list->path, ps_npy_shape(array, shape), LARGEST_FREQUENCY);
        }
    }
    return PSPEC_OK;
}

/* Opposites have opposite places. Where one is 0 and the other is not, both are kept. */
static pspec_status take_array(ps_coefficient_list *list, const ps_npy_array *array,
                               ps_error *error) {
    const size_t parts = array->is_complex ? 2 : 1;
    PS_TRY(check_shape(list, array, error));
    PS_TRY(PS_NEW(&list->all, array->num, "coefficients", error));
    for (size_t i = 0; i < array->num; i++) {
        const double *const at = array->data + i * parts;
        const double *const other = array->data + (array->num - 1 - i) * parts;
        const bool is_0 =
            at[0] == 0 && other[0] == 0 && at[parts - 1] == 0 && other[parts - 1] == 0;
        if (is_0) {
            continue;
        }
        ps_coefficient *const one = &list->all[list->num++];
        int32_t k[PS_MAX_DIMENSION];
        size_t rest = i;
        for (unsigned axis = array->rank; axis-- > 0;) {
            const size_t side = array->shape[axis];
            k[axis] = (int32_t)(rest % side) - (int32_t)(side / 2);
            rest /= side;
        }
        set_key(one, k, array->rank);
        const double im = array->is_complex ? at[1] : 0;
        one->re = at[0];
        one->im = one->is_opposite ? -im : im;
    }
    return PSPEC_OK;
}

/* ---- from the list to the series ---------------------------------------------------------- */

/* Where the phases of one k come from those of the one before. Every so often they are made anew,
 * so that rounding does not add up. */
static void link_phases(ps_torus_series *self) {
    enum { PHASE_STEPS = 4 }; /* 5 ns a term in its row, 20 a phase (EPYC) */
    const unsigned last = self->dimension - 1;
    for (size_t i = 0; i < self->num; i++) {
        const int32_t *const k = self->k + i * self->dimension;
        const int32_t *const before = i > 0 ? k - self->dimension : k;
        unsigned axis = 0;
        while (i > 0 && axis < last && k[axis] == before[axis]) {
            axis++;
        }
        self->first[i] = (uint8_t)axis;
        self->is_next[i] = axis == last && k[last] == before[last] + 1 && i % TORUS_SERIES_RUN != 0;
        self->steps += 1 + (self->is_next[i] != 0 ? 0 : PHASE_STEPS * (double)(last + 1 - axis));
    }
}

/* Runs, each with its k and how many there are, and one of none. */
static pspec_status fill_table(ps_torus_series *self, ps_error *error) {
    const unsigned dimension = self->dimension;
    size_t num_runs = 1;
    size_t at = 0;
    for (size_t i = 0; i < self->num; i++) {
        num_runs += self->is_next[i] == 0;
    }
    self->num_table = num_runs * (dimension + 1) + 2 * self->num;
    PS_TRY(PS_NEW(&self->table, self->num_table, "an integrand", error));
    for (size_t i = 0; i < self->num;) {
        size_t end = i + 1;
        while (end < self->num && self->is_next[end] != 0) {
            end++;
        }
        for (unsigned axis = 0; axis < dimension; axis++) {
            self->table[at++] = self->k[i * dimension + axis];
        }
        self->table[at++] = (double)(end - i);
        for (; i < end; i++) {
            self->table[at++] = self->re[i];
            self->table[at++] = self->im[i];
        }
    }
    return PSPEC_OK;
}

static pspec_status fill(ps_torus_series *self, const ps_coefficient_list *list, ps_error *error) {
    const unsigned dimension = self->dimension;
    ps_neumaier energy = {0, 0};
    PS_TRY(PS_NEW(&self->k, list->num * dimension, "frequencies", error));
    PS_TRY(PS_NEW(&self->first, list->num, "frequencies", error));
    PS_TRY(PS_NEW(&self->is_next, list->num, "frequencies", error));
    PS_TRY(PS_NEW(&self->re, list->num, "coefficients", error));
    PS_TRY(PS_NEW(&self->im, list->num, "coefficients", error));
    PS_TRY(PS_NEW(&self->squares, list->num, "coefficients", error));
    for (size_t i = 0; i < list->num; i++) {
        const ps_coefficient *const one = &list->all[i];
        if (one->is_its_own) {
            self->mean = one->re;
            continue;
        }
        memcpy(self->k + self->num * dimension, one->key, dimension * sizeof *self->k);
        self->re[self->num] = one->re;
        self->im[self->num] = one->im;
        self->squares[self->num] = one->re * one->re + one->im * one->im;
        ps_neumaier_add(&energy, 2 * self->squares[self->num]);
        for (unsigned axis = 0; axis < dimension; axis++) {
            self->reach = fmax(self->reach, fabs((double)one->key[axis]));
        }
        self->num++;
    }
    self->energy = ps_neumaier_value(&energy);
    link_phases(self);
    return fill_table(self, error);
}

static pspec_status read_list(ps_coefficient_list *list, const ps_coefficient_file *file,
                              ps_error *error) {
    PS_TRY(file->is_array ? take_array(list, &file->array, error) : take_rows(list, file, error));
    return ps_coefficients_merge(list, error);
}

pspec_status ps_torus_series_read(ps_torus_series **out, const char *path, unsigned dimension,
                                  ps_error *error) {
    ps_coefficient_file file = {0};
    ps_coefficient_list list = {.path = path, .num_keys = dimension};
    pspec_status status = PSPEC_OK;
    *out = NULL;
    PS_TRY_OUT(status, ps_coefficient_file_read(&file, path, dimension + 2, error));
    PS_TRY_OUT(status, read_list(&list, &file, error));
    PS_TRY_OUT(status, PS_NEW(out, 1, "an integrand", error));
    (*out)->dimension = dimension;
    status = fill(*out, &list, error);
out:
    ps_coefficient_file_free(&file);
    free(list.all);
    if (status != PSPEC_OK) {
        ps_torus_series_destroy(*out);
        *out = NULL;
    }
    return status;
}

void ps_torus_series_destroy(ps_torus_series *series) {
    if (series != NULL) {
        free(series->k);
        free(series->first);
        free(series->is_next);
        free(series->re);
        free(series->im);
        free(series->squares);
        free(series->table);
    }
    free(series);
}

/* ---- sums ---------------------------------------------------------------------------------- */

typedef struct phase {
    double c, s;
} phase;

static phase times(phase a, phase b) {
    return (phase){a.c * b.c - a.s * b.s, a.c * b.s + a.s * b.c};
}

/* e^{2 pi i k x}, the angle reduced while it is exact. */
static phase phase_of(double k, double x) {
    const double turns = k * x;
    const double rest = fma(k, x, -turns); /* what the product lost */
    const double angle = PS_TWO_PI * ((turns - rint(turns)) + rest);
    return (phase){cos(angle), sin(angle)};
}

/* 2 sum re cos(2 pi k.x) - im sin(2 pi k.x); im NULL: zeros. */
static double sum_at(const ps_torus_series *self, const double *re, const double *im,
                     const double *x) {
    const unsigned dimension = self->dimension;
    const unsigned last = dimension - 1;
    const phase step = phase_of(1, x[last]);
    phase of_axis = {1, 0};                          /* of the last */
    phase products[PS_MAX_DIMENSION + 1] = {{1, 0}}; /* of so many axes */
    double sum = 0;
    for (size_t i = 0; i < self->num; i++) {
        const int32_t *const k = self->k + i * dimension;
        for (unsigned axis = self->first[i]; axis < last; axis++) {
            products[axis + 1] = times(products[axis], phase_of(k[axis], x[axis]));
        }
        of_axis = self->is_next[i] ? times(of_axis, step) : phase_of(k[last], x[last]);
        const phase all = times(products[last], of_axis);
        sum += re[i] * all.c - (im != NULL ? im[i] * all.s : 0);
    }
    return 2 * sum;
}

double ps_torus_series_value(const ps_torus_series *series, const double *x) {
    return series->mean + sum_at(series, series->re, series->im, x);
}

double ps_torus_series_correlation(const ps_torus_series *series, const double *x) {
    if (series->num > MOST_PAIR_TERMS) {
        return NAN;
    }
    return series->mean * series->mean + sum_at(series, series->squares, NULL, x);
}

double ps_torus_series_power(const ps_torus_series *series, const int32_t *k) {
    const unsigned dimension = series->dimension;
    ps_coefficient one = {.re = 0};
    size_t low = 0;
    size_t high = series->num;
    set_key(&one, k, dimension);
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const int32_t *const at = series->k + middle * dimension;
        unsigned axis = 0;
        while (axis < dimension && at[axis] == one.key[axis]) {
            axis++;
        }
        if (axis == dimension) {
            return series->squares[middle];
        }
        low = at[axis] < one.key[axis] ? middle + 1 : low;
        high = at[axis] < one.key[axis] ? high : middle;
    }
    return 0;
}
