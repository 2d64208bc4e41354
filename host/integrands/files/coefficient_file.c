#include "integrands/files/coefficient_file.h"

#include "base/memory.h"
#include "base/text.h"
#include "points/lists/number_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool ps_fit_single(const double *numbers, size_t num) {
    const double most = 1e30; /* with room for as many as there may be */
    for (size_t i = 0; i < num; i++) {
        if (!(fabs(numbers[i]) <= most)) {
            return false;
        }
    }
    return true;
}

/* ---- reading ------------------------------------------------------------------------------- */

pspec_status ps_integrand_copy_path(const ps_integrand *integrand, const char *text, char **path,
                                    ps_error *error) {
    const char *const name = integrand->kind->name;
    if (text[0] == '\0') {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s needs its file, as in %s:file=%s.npy", name, name, name);
    }
    if (strcmp(text, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: file=-: standard input cannot be read more than once; give "
                       "a file",
                       name);
    }
    const size_t num_bytes = strlen(text) + 1;
    PS_TRY(PS_NEW(path, num_bytes, "a path", error));
    memcpy(*path, text, num_bytes);
    return PSPEC_OK;
}

/* The array, where the input is one. */
static pspec_status try_array(ps_coefficient_file *out, ps_input *input, ps_error *error) {
    if (!input->can_reopen) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is no regular file, and integrands are read more than once",
                       input->name);
    }
    PS_TRY(ps_npy_is_next(input, &out->is_array, error));
    return out->is_array ? ps_npy_read_array(&out->array, input, true, error) : PSPEC_OK;
}

pspec_status ps_coefficient_file_read(ps_coefficient_file *out, const char *path, unsigned columns,
                                      ps_error *error) {
    *out = (ps_coefficient_file){0};
    ps_input input = {0};
    pspec_status status = ps_input_open_array(&input, path, "coefficients", error);
    if (status == PSPEC_OK) {
        status = try_array(out, &input, error);
    }
    ps_input_close(&input);
    PS_TRY(status);
    return out->is_array ? PSPEC_OK
                         : ps_read_rows(path, columns, &out->rows, &out->num_rows, error);
}

void ps_coefficient_file_free(ps_coefficient_file *file) {
    ps_npy_array_free(&file->array);
    free(file->rows);
    file->rows = NULL;
}

pspec_status ps_coefficient_key(const ps_coefficient_list *list, const double *row, unsigned column,
                                unsigned num_columns, const char *name, int32_t least, int32_t most,
                                int32_t *out, ps_error *error) {
    const double value = row[column];
    if (value != floor(value) || value < least || value > most) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s, line %zu: %s %.17g is not a whole number between %d and %d", list->path,
                       (size_t)row[num_columns], name, value, (int)least, (int)most);
    }
    *out = (int32_t)value;
    return PSPEC_OK;
}

/* ---- merging ------------------------------------------------------------------------------- */

static int compare_keys(const ps_coefficient *a, const ps_coefficient *b) {
    for (unsigned i = 0; i < PS_MAX_DIMENSION; i++) {
        if (a->key[i] != b->key[i]) {
            return a->key[i] < b->key[i] ? -1 : 1;
        }
    }
    return 0;
}

static int compare(const void *left, const void *right) {
    const ps_coefficient *const a = left;
    const ps_coefficient *const b = right;
    const int by_key = compare_keys(a, b);
    if (by_key != 0) {
        return by_key;
    }
    if (a->is_opposite != b->is_opposite) {
        return a->is_opposite ? 1 : -1;
    }
    return a->line < b->line ? -1 : a->line > b->line;
}

static void show_place(ps_text *text, const ps_coefficient_list *list, const ps_coefficient *one,
                       const ps_coefficient *other) {
    ps_text_append(text, "%s", list->path);
    if (one->line > 0 && other != NULL) {
        ps_text_append(text, ", lines %zu and %zu", one->line, other->line);
    } else if (one->line > 0) {
        ps_text_append(text, ", line %zu", one->line);
    }
    ps_text_append(text, ": ");
}

static void show_key(ps_text *text, const ps_coefficient_list *list, const ps_coefficient *one) {
    if (list->on_sphere) {
        ps_text_append(text, "l = %d, m = %d", (int)one->key[0],
                       (int)(one->is_opposite ? -one->key[1] : one->key[1]));
        return;
    }
    ps_text_append(text, "k = (");
    for (unsigned i = 0; i < list->num_keys; i++) {
        ps_text_append(text, "%s%d", i > 0 ? ", " : "",
                       (int)(one->is_opposite ? -one->key[i] : one->key[i]));
    }
    ps_text_append(text, ")");
}

static pspec_status fail_text(ps_text *text, ps_error *error) {
    ps_fail(error, PSPEC_ERROR_INPUT, "%s", ps_text_string(text));
    ps_text_free(text);
    return PSPEC_ERROR_INPUT;
}

static pspec_status fail_twice(const ps_coefficient_list *list, const ps_coefficient *one,
                               ps_error *error) {
    ps_text text = {0};
    show_place(&text, list, one, one + 1);
    ps_text_append(&text, "the coefficient at ");
    show_key(&text, list, one);
    ps_text_append(&text, " is given twice");
    return fail_text(&text, error);
}

static pspec_status fail_unreal(const ps_coefficient_list *list, const ps_coefficient *one,
                                ps_error *error) {
    ps_text text = {0};
    show_place(&text, list, one, NULL);
    ps_text_append(&text, "the coefficient at ");
    show_key(&text, list, one);
    ps_text_append(&text, " has the imaginary part %g, and that of a real function has none",
                   one->im);
    return fail_text(&text, error);
}

static pspec_status fail_apart(const ps_coefficient_list *list, const ps_coefficient *one,
                               ps_error *error) {
    ps_text text = {0};
    show_place(&text, list, one, one + 1);
    ps_text_append(&text, "the coefficients at ");
    show_key(&text, list, one);
    ps_text_append(&text, " and ");
    show_key(&text, list, one + 1);
    ps_text_append(&text,
                   " are those of no real function: by the second, the first would be %g%+gi, and "
                   "it is %g%+gi",
                   one[1].re, one[1].im, one->re, one->im);
    return fail_text(&text, error);
}

static pspec_status fail_alone(const ps_coefficient_list *list, const ps_coefficient *one,
                               ps_error *error) {
    ps_coefficient other = *one;
    ps_text text = {0};
    other.is_opposite = !one->is_opposite;
    show_place(&text, list, one, NULL);
    ps_text_append(&text, "the coefficient at ");
    show_key(&text, list, one);
    ps_text_append(&text, " is that of no real function without its opposite at ");
    show_key(&text, list, &other);
    ps_text_append(&text, ", which is not in the file");
    return fail_text(&text, error);
}

static pspec_status check_size(const ps_coefficient_list *list, const ps_coefficient *one,
                               ps_error *error) {
    if (fabs(one->re) <= PS_LARGEST_COEFFICIENT && fabs(one->im) <= PS_LARGEST_COEFFICIENT) {
        return PSPEC_OK;
    }
    ps_text text = {0};
    show_place(&text, list, one, NULL);
    ps_text_append(&text, "the coefficient at ");
    show_key(&text, list, one);
    ps_text_append(&text, " is %g%+gi, and the largest that there may be is %g", one->re, one->im,
                   PS_LARGEST_COEFFICIENT);
    return fail_text(&text, error);
}

static double size_of(double re, double im) {
    return fmax(fabs(re), fabs(im));
}

/* The one at *next, and the next, where it stands for the same; rounding: how far they may be from
 * each other. */
static pspec_status merge_one(const ps_coefficient_list *list, size_t *next, double rounding,
                              ps_coefficient *out, ps_error *error) {
    const ps_coefficient *const one = &list->all[*next];
    const bool is_pair = *next + 1 < list->num && compare_keys(one, one + 1) == 0;
    *out = *one;
    *next += is_pair ? 2 : 1;
    if (is_pair && one->is_opposite == one[1].is_opposite) {
        return fail_twice(list, one, error);
    }
    if (is_pair) {
        if (!(size_of(one->re - one[1].re, one->im - one[1].im) <= rounding)) {
            return fail_apart(list, one, error);
        }
        out->re = (one->re + one[1].re) / 2;
        out->im = (one->im + one[1].im) / 2;
    }
    if (!is_pair && !one->is_its_own && !list->is_half &&
        !(size_of(one->re, one->im) <= rounding)) {
        return fail_alone(list, one, error);
    }
    if (one->is_its_own) {
        if (!(fabs(one->im) <= rounding)) {
            return fail_unreal(list, one, error);
        }
        out->im = 0;
    }
    return PSPEC_OK;
}

pspec_status ps_coefficients_merge(ps_coefficient_list *list, ps_error *error) {
    const double relative = 1e-10; /* far more than transforms of millions of values round by */
    double largest = 0;
    size_t next = 0;
    size_t num = 0;
    for (size_t i = 0; i < list->num; i++) {
        PS_TRY(check_size(list, &list->all[i], error));
        largest = fmax(largest, size_of(list->all[i].re, list->all[i].im));
    }
    qsort(list->all, list->num, sizeof *list->all, compare);
    while (next < list->num) {
        ps_coefficient merged;
        PS_TRY(merge_one(list, &next, relative * largest, &merged, error));
        if (size_of(merged.re, merged.im) > 0) {
            list->all[num++] = merged;
        }
    }
    list->num = num;
    return PSPEC_OK;
}
