#include "harness_public.h"

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

pspec_context *test_public_context(void) {
    pspec_context *const context = pspec_context_create();
    assert_int_equal(pspec_context_set_device(context, getenv("POINTSPEC_DEVICE")), PSPEC_OK);
    return context;
}

pspec_question *test_public_question(pspec_context *context, const char *line) {
    enum { LINE = 1024 };
    char words[LINE];
    char *rest = NULL;
    pspec_question *question = NULL;
    assert_true((size_t)snprintf(words, sizeof words, "%s", line) < sizeof words);
    char *word = strtok_r(words, " ", &rest);
    pspec_status status = pspec_question_create(&question, context, word);
    while (status == PSPEC_OK && (word = strtok_r(NULL, " ", &rest)) != NULL) {
        char *const equals = strchr(word, '=');
        if (equals != NULL) {
            *equals = '\0';
        }
        status = pspec_question_set(question, word, equals != NULL ? equals + 1 : NULL);
    }
    if (status != PSPEC_OK) {
        fail_msg("%s: %s", line, pspec_context_message(context));
    }
    return question;
}

void test_public_add(pspec_question *question, const pspec_pattern *patterns, size_t num) {
    for (size_t i = 0; i < num; i++) {
        assert_int_equal(pspec_question_add(question, 1, patterns[i].num_points,
                                            patterns[i].dimension, patterns[i].points,
                                            patterns[i].weights),
                         PSPEC_OK);
    }
}

pspec_answer *test_public_answer(pspec_context *context, pspec_question *question) {
    pspec_answer *answer = NULL;
    if (pspec_question_answer(&answer, question) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return answer;
}

void test_public_refused(pspec_context *context, pspec_status found, pspec_status expected,
                         const char *piece) {
    if (found != expected || strstr(pspec_context_message(context), piece) == NULL) {
        fail_msg("status %d instead of %d, or no \"%s\" in \"%s\"", (int)found, (int)expected,
                 piece, pspec_context_message(context));
    }
}

void test_public_refuse(pspec_context *context, pspec_question *question, pspec_status status,
                        const char *piece) {
    pspec_answer *answer = NULL;
    test_public_refused(context, pspec_question_answer(&answer, question), status, piece);
    assert_null(answer);
}

pspec_answer *test_public_ask(pspec_context *context, const char *line,
                              const pspec_pattern *patterns, size_t num) {
    pspec_question *const question = test_public_question(context, line);
    test_public_add(question, patterns, num);
    pspec_answer *const answer = test_public_answer(context, question);
    pspec_question_destroy(question);
    return answer;
}

/* ---- fields ------------------------------------------------------------------------------ */

const pspec_field *test_public_field(const pspec_answer *answer, const char *name,
                                     pspec_type type) {
    const pspec_field *const field = pspec_answer_find(answer, name);
    if (field == NULL || field->type != type) {
        fail_msg("%s %s", name, field == NULL ? "is not there" : "has another type");
    }
    return field;
}

const double *test_public_numbers(const pspec_answer *answer, const char *name) {
    return test_public_field(answer, name, PSPEC_F64)->data;
}

const char *test_public_text(const pspec_answer *answer, const char *name) {
    return *(const char *const *)test_public_field(answer, name, PSPEC_TEXT)->data;
}

static bool is_same_field(const pspec_field *a, const pspec_field *b) {
    bool is_same = strcmp(a->name, b->name) == 0 && a->group == b->group && a->type == b->type &&
                   a->num == b->num && a->rank == b->rank;
    for (unsigned axis = 0; is_same && axis < a->rank; axis++) {
        is_same = a->shape[axis] == b->shape[axis];
    }
    if (!is_same || a->group == PSPEC_ENTRY) {
        return is_same;
    }
    for (size_t i = 0; is_same && a->type == PSPEC_TEXT && i < a->num; i++) {
        is_same = strcmp(((const char *const *)a->data)[i], ((const char *const *)b->data)[i]) == 0;
    }
    const size_t bytes = a->num * (a->type == PSPEC_C128 ? 2 : 1) * sizeof(double);
    return is_same && (a->type == PSPEC_TEXT || memcmp(a->data, b->data, bytes) == 0);
}

bool test_public_same(const pspec_answer *a, const pspec_answer *b) {
    bool is_same = true;
    size_t i = 0;
    for (; is_same && i < pspec_answer_num_fields(a) &&
           pspec_answer_field(a, i)->group != PSPEC_ENTRY;
         i++) {
        is_same = i < pspec_answer_num_fields(b) &&
                  is_same_field(pspec_answer_field(a, i), pspec_answer_field(b, i));
    }
    return is_same && i > 0 && pspec_answer_field(b, i)->group == PSPEC_ENTRY;
}

/* ---- GSL --------------------------------------------------------------------------------- */

static int num_gsl_errors; /* the handler has no payload */

static void count_gsl_errors(const char *reason, const char *file, int line, int number) {
    (void)reason;
    (void)file;
    (void)line;
    (void)number;
    num_gsl_errors++;
}

void test_watch_gsl(void) {
    gsl_set_error_handler(count_gsl_errors);
}

void test_gsl_is_left_alone(void **state) {
    (void)state;
    assert_true(gsl_set_error_handler(count_gsl_errors) == count_gsl_errors);
    assert_int_equal(num_gsl_errors, 0);
}
