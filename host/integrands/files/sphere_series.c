#define PRECISION 64
#include "integrands/files/series.h"

#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/sphere_series.h"
#include "math/neumaier.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LARGEST_DEGREE = 1000,  /* up to there sin^m is a double where harmonics are above rounding */
    MOST_PAIR_DEGREES = 400 /* of correlations, of which half a million may be asked for */
};

static size_t index_of(size_t max_degree, size_t l, size_t m) {
    return m * (2 * max_degree + 1 - m) / 2 + l;
}

/* ---- from the file to a list --------------------------------------------------------------- */

/* F_l,-m = (-1)^m conj F_lm */
static void set_key(ps_coefficient *one, int32_t l, int32_t m, double re, double im) {
    const bool is_odd = m % 2 != 0;
    *one = (ps_coefficient){.key = {l, abs(m)}, .is_opposite = m < 0, .is_its_own = m == 0};
    one->re = m < 0 && is_odd ? -re : re;
    one->im = m < 0 && !is_odd ? -im : im;
}

/* Where all orders are 0 or more, as in an array, they say what the others are. */
static pspec_status take_rows(ps_coefficient_list *list, const ps_coefficient_file *file,
                              ps_error *error) {
    enum { DEGREE, ORDER, RE, IM, COLUMNS };
    PS_TRY(PS_NEW(&list->all, file->num_rows, "coefficients", error));
    for (size_t i = 0; i < file->num_rows; i++) {
        const double *const row = file->rows + i * (COLUMNS + 1);
        int32_t l = 0;
        int32_t m = 0;
        PS_TRY(
            ps_coefficient_key(list, row, DEGREE, COLUMNS, "degree", 0, LARGEST_DEGREE, &l, error));
        PS_TRY(ps_coefficient_key(list, row, ORDER, COLUMNS, "order", -l, l, &m, error));
        set_key(&list->all[i], l, m, row[RE], row[IM]);
        list->all[i].line = (size_t)row[COLUMNS];
        list->is_half = list->is_half && m >= 0;
    }
    list->num = file->num_rows;
    return PSPEC_OK;
}

/* The L of so many coefficients; -1: there is none. */
static int32_t degree_of(size_t num) {
    for (int32_t degree = 0; degree <= LARGEST_DEGREE; degree++) {
        if ((size_t)(degree + 1) * (size_t)(degree + 2) / 2 == num) {
            return degree;
        }
    }
    return -1;
}

/* An array holds c_lm = int F Y_lm, the conjugates of F_lm. */
static pspec_status take_array(ps_coefficient_list *list, const ps_npy_array *array,
                               ps_error *error) {
    const int32_t degree = array->rank == 1 ? degree_of(array->num) : -1;
    if (degree < 0) {
        char shape[PS_NPY_SHAPE_BYTES];
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %s; coefficients up to degree L, at most %d, are (L + 1)(L + 2)/2 on "
                       "one axis",
                       list->path, ps_npy_shape(array, shape), LARGEST_DEGREE);
    }
    PS_TRY(PS_NEW(&list->all, array->num, "coefficients", error));
    for (int32_t m = 0; m <= degree; m++) {
        for (int32_t l = m; l <= degree; l++) {
            const size_t at = index_of((size_t)degree, (size_t)l, (size_t)m);
            const double *const c = array->data + at * (array->is_complex ? 2 : 1);
            set_key(&list->all[at], l, m, c[0], array->is_complex ? -c[1] : 0);
        }
    }
    list->num = array->num;
    return PSPEC_OK;
}

static pspec_status check_even(const ps_coefficient_list *list, ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        if (list->all[i].key[0] % 2 != 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: the coefficient at l = %d, m = %d is not 0: on the hemisphere, "
                           "whose integrands are continued evenly, there are even degrees only",
                           list->path, (int)list->all[i].key[0], (int)list->all[i].key[1]);
        }
    }
    return PSPEC_OK;
}

/* ---- from the list to the series ----------------------------------------------------------- */

static double *at_index(const ps_sphere_series *self, size_t l, size_t m) {
    return self->table + SPHERE_SERIES_NUMBERS * index_of(self->max_degree, l, m);
}

/* docs/mathematics/sphere.md has the recurrence; that of l = m goes from order to order. */
static void fill_factors(ps_sphere_series *self) {
    const size_t max_degree = self->max_degree;
    for (size_t m = 0; m <= max_degree; m++) {
        const double order = (double)m;
        at_index(self, m, m)[0] = m > 0 ? -sqrt((2 * order + 1) / (2 * order)) : 1;
        for (size_t l = m + 1; l <= max_degree; l++) {
            const double d = (double)l;
            const double below = (d - 1) * (d - 1);
            double *const own = at_index(self, l, m);
            own[0] = sqrt((4 * d * d - 1) / ((d - order) * (d + order)));
            own[1] = l > m + 1 ? sqrt((below - order * order) / (4 * below - 1)) : 0;
        }
    }
}

static pspec_status allocate(ps_sphere_series *self, size_t max_degree, ps_error *error) {
    self->max_degree = max_degree;
    self->num_table = SPHERE_SERIES_NUMBERS * ((max_degree + 1) * (max_degree + 2) / 2);
    PS_TRY(PS_NEW(&self->table, self->num_table, "an integrand", error));
    PS_TRY(PS_NEW(&self->powers, max_degree + 1, "powers", error));
    fill_factors(self);
    return PSPEC_OK;
}

static void set(ps_sphere_series *self, size_t l, size_t m, double re, double im) {
    double *const own = at_index(self, l, m);
    own[2] = re;
    own[3] = im;
    self->powers[l] += (m == 0 ? 1 : 2) * (re * re + im * im);
}

static pspec_status fill(ps_sphere_series *self, const ps_coefficient_list *list, ps_error *error) {
    size_t max_degree = 0;
    for (size_t i = 0; i < list->num; i++) {
        const size_t l = (size_t)list->all[i].key[0];
        max_degree = l > max_degree ? l : max_degree;
    }
    PS_TRY(allocate(self, max_degree, error));
    for (size_t i = 0; i < list->num; i++) {
        const ps_coefficient *const one = &list->all[i];
        set(self, (size_t)one->key[0], (size_t)one->key[1], one->re, one->im);
    }
    return PSPEC_OK;
}

pspec_status ps_sphere_series_make(ps_sphere_series **out, size_t max_degree, const double *f,
                                   ps_error *error) {
    *out = NULL;
    PS_TRY(PS_NEW(out, 1, "an integrand", error));
    const pspec_status status = allocate(*out, max_degree, error);
    for (size_t m = 0; m <= max_degree && status == PSPEC_OK; m++) {
        for (size_t l = m; l <= max_degree; l++) {
            const double *const own = f + 2 * index_of(max_degree, l, m);
            set(*out, l, m, own[0], own[1]);
        }
    }
    if (status != PSPEC_OK) {
        ps_sphere_series_destroy(*out);
        *out = NULL;
    }
    return status;
}

void ps_sphere_series_coefficients(const ps_sphere_series *series, size_t max_degree, double *out) {
    for (size_t m = 0; m <= max_degree; m++) {
        for (size_t l = m; l <= max_degree; l++) {
            const bool has = l <= series->max_degree;
            double *const f = out + 2 * index_of(max_degree, l, m);
            f[0] = has ? at_index(series, l, m)[2] : 0;
            f[1] = has ? at_index(series, l, m)[3] : 0;
        }
    }
}

static pspec_status read_list(ps_coefficient_list *list, const ps_coefficient_file *file,
                              bool only_even, ps_error *error) {
    PS_TRY(file->is_array ? take_array(list, &file->array, error) : take_rows(list, file, error));
    PS_TRY(ps_coefficients_merge(list, error));
    return only_even ? check_even(list, error) : PSPEC_OK;
}

pspec_status ps_sphere_series_read(ps_sphere_series **out, const char *path, bool only_even,
                                   ps_error *error) {
    enum { COLUMNS = 4 };
    ps_coefficient_file file = {0};
    ps_coefficient_list list = {.path = path, .on_sphere = true, .is_half = true};
    pspec_status status = PSPEC_OK;
    *out = NULL;
    PS_TRY_OUT(status, ps_coefficient_file_read(&file, path, COLUMNS, error));
    PS_TRY_OUT(status, read_list(&list, &file, only_even, error));
    PS_TRY_OUT(status, PS_NEW(out, 1, "an integrand", error));
    status = fill(*out, &list, error);
out:
    ps_coefficient_file_free(&file);
    free(list.all);
    if (status != PSPEC_OK) {
        ps_sphere_series_destroy(*out);
        *out = NULL;
    }
    return status;
}

void ps_sphere_series_destroy(ps_sphere_series *series) {
    if (series != NULL) {
        free(series->table);
        free(series->powers);
    }
    free(series);
}

/* ---- sums ------------------------------------------------------------------------------- */

/* sum_l F_lm q_l of one order; top is q_m, of which the others are made. */
static void sum_order(const ps_sphere_series *self, size_t m, double z, double top, double sum[2]) {
    const double *own = at_index(self, m, m);
    double before = 0;
    double value = top;
    sum[0] = own[2] * value;
    sum[1] = own[3] * value;
    for (size_t l = m + 1; l <= self->max_degree; l++) {
        own += SPHERE_SERIES_NUMBERS;
        const double next = own[0] * (z * value - own[1] * before);
        sum[0] += own[2] * next;
        sum[1] += own[3] * next;
        before = value;
        value = next;
    }
}

/* sum F_lm Y_lm, Y_lm = q_lm e^{i m phi} with sin^m in q_lm; at the poles e^{i phi} is 1, and only
 * m = 0 is not 0. */
double ps_sphere_series_value(const ps_sphere_series *series, const double *u) {
    const double sine = hypot(u[0], u[1]);
    const double c = sine > 0 ? u[0] / sine : 1;
    const double s = sine > 0 ? u[1] / sine : 0;
    double top = sqrt(1 / PS_FOUR_PI);
    double cos_m = 1;
    double sin_m = 0;
    double total = 0;
    for (size_t m = 0; m <= series->max_degree; m++) {
        double sum[2];
        if (m > 0) {
            const double kept = cos_m;
            top *= at_index(series, m, m)[0] * sine;
            cos_m = cos_m * c - sin_m * s;
            sin_m = kept * s + sin_m * c;
        }
        if (top == 0) {
            break;
        }
        sum_order(series, m, u[2], top, sum);
        total += (m > 0 ? 2 : 1) * (sum[0] * cos_m - sum[1] * sin_m);
    }
    return total;
}

/* P_l in the form of differences (docs/mathematics/numerics.md#legendre-sums), from the nearer
 * pole. */
double ps_sphere_series_correlation(const ps_sphere_series *series, double x) {
    if (series->max_degree > MOST_PAIR_DEGREES) {
        return NAN;
    }
    const double t = fmax(1 - fabs(x), 0);
    ps_neumaier total = {0, 0};
    double value = 1;
    double step = 0;
    for (size_t l = 0; l <= series->max_degree; l++) {
        const double d = (double)l;
        ps_neumaier_add(&total, series->powers[l] * (x < 0 && l % 2 == 1 ? -value : value));
        step = (d * step - (2 * d + 1) * (t * value)) / (d + 1);
        value += step;
    }
    return ps_neumaier_value(&total);
}

/* 2 ns a harmonic, 20 an order (EPYC). */
double ps_sphere_series_steps(const ps_sphere_series *series) {
    const double num = (double)series->max_degree + 1;
    return num * (num + 1) / 4 + 4 * num;
}
