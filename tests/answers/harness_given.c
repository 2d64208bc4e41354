#include "harness_given.h"

#include "request/option_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static pspec_status give(void *payload, uint64_t realization, pspec_pattern *out, bool *has_set,
                         ps_error *error) {
    test_given *const self = payload;
    assert_true(pthread_equal(pthread_self(), self->thread));
    assert_true(realization == self->next || realization + 1 == self->next || realization == 0);
    self->next = realization + 1;
    self->num_calls++;
    free(self->view);
    self->view = NULL;
    if (realization + 1 == self->failing) {
        return ps_fail(error, PSPEC_ERROR_CANCELLED, "the caller has gone home");
    }
    *has_set = realization < self->num_sets;
    if (!*has_set) {
        return PSPEC_OK;
    }
    const size_t num = self->num_points[realization];
    const size_t bytes = num * self->dimension * sizeof(double);
    self->view = malloc(bytes + 1);
    assert_non_null(self->view);
    memcpy(self->view, self->points[realization], bytes);
    *out = (pspec_pattern){self->dimension - (realization + 1 == self->other), num, self->view,
                           self->has_weights ? self->weights[realization] : NULL};
    return PSPEC_OK;
}

ps_given_set test_given_set(test_given *self) {
    return (ps_given_set){.name = self->name, .next = give, .payload = self};
}

static void make_point(double *point, unsigned dimension, bool on_sphere, uint64_t *state) {
    double square = 0;
    for (unsigned i = 0; i < dimension; i++) {
        point[i] = on_sphere ? test_uniform(state) - 0.5 : test_uniform(state);
        square += point[i] * point[i];
    }
    for (unsigned i = 0; on_sphere && i < dimension; i++) {
        point[i] /= sqrt(square);
    }
}

void test_given_make(test_given *self, const test_folder *folder, const char *name,
                     unsigned dimension, bool has_weights, size_t num_sets, size_t num,
                     size_t more) {
    uint64_t state = num_sets + 7;
    *self = (test_given){.dimension = dimension,
                         .num_sets = num_sets,
                         .has_weights = has_weights,
                         .thread = pthread_self()};
    test_path(folder, name, self->name);
    for (size_t r = 0; r < num_sets; r++) {
        self->num_points[r] = num + r * more;
        self->points[r] = calloc(self->num_points[r] * dimension, sizeof(double));
        self->weights[r] = calloc(self->num_points[r], sizeof(double));
        assert_non_null(self->points[r]);
        assert_non_null(self->weights[r]);
        for (size_t j = 0; j < self->num_points[r]; j++) {
            make_point(self->points[r] + j * dimension, dimension, dimension == 3, &state);
            self->weights[r][j] = 0.5 + test_uniform(&state);
        }
    }
}

void test_given_free(test_given *self) {
    for (size_t r = 0; r < self->num_sets; r++) {
        free(self->points[r]);
        free(self->weights[r]);
    }
    free(self->view);
}

void test_given_save(const test_given *self, const char *format) {
    ps_point_set sets[TEST_MOST_SETS] = {{0}};
    for (size_t r = 0; r < self->num_sets; r++) {
        sets[r] = (ps_point_set){.coordinates =
                                     self->dimension == 3 ? PS_UNIT_VECTORS : PS_TORUS_COORDINATES,
                                 .dimension = self->dimension,
                                 .num_points = self->num_points[r],
                                 .points = self->points[r],
                                 .weights = self->weights[r],
                                 .has_weights = self->has_weights};
    }
    assert_ok(test_points_write(self->name, format, sets, self->num_sets,
                                strcmp(format, "npy") == 0, NULL, error));
}

/* ---- questions ------------------------------------------------------------------------------- */

static ps_option_id find_option(const char *name) {
    int id = 0;
    while (id < PS_NUM_OPTIONS && strcmp(ps_options[id].name, name) != 0) {
        id++;
    }
    assert_true(id < PS_NUM_OPTIONS);
    return (ps_option_id)id;
}

static void take(test_question *out, char *word) {
    char *const value = strchr(word, '=');
    if (value != NULL) {
        *value = '\0';
    }
    if (strcmp(word, "files") == 0) {
        assert_true(out->request.num_files < TEST_MOST_FILES);
        out->files[out->request.num_files++] = value + 1;
        return;
    }
    const ps_option_id id = find_option(word);
    assert_ok(ps_option_apply(&out->request, id, ps_command_words(out->kind, id),
                              value != NULL ? value + 1 : "true", error));
}

void test_ask(test_question *out, const char *format, ...) {
    va_list arguments;
    size_t i = 0;
    char *rest = NULL;
    *out = (test_question){.request = ps_request_default};
    va_start(arguments, format);
    vsnprintf(out->text, sizeof out->text, format, arguments);
    va_end(arguments);
    const char *const name = strtok_r(out->text, " ", &rest);
    while (ps_kinds[i] != NULL && strcmp(ps_kinds[i]->name, name) != 0) {
        i++;
    }
    out->kind = ps_kinds[i];
    assert_non_null(out->kind);
    for (char *word = strtok_r(NULL, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        take(out, word);
    }
    out->request.files = out->files;
}
