/* Fixtures of the public library's tests. */
#ifndef TESTS_HARNESS_PUBLIC_H
#define TESTS_HARNESS_PUBLIC_H

#include "harness_estimator.h"

enum { TEST_NUM_POINTS = 30 };

/* With the device of the tests. */
pspec_context *test_public_context(void);

/* A question as "power max-frequency=4 hemisphere files=a.txt": a kind, and its options. */
pspec_question *test_public_question(pspec_context *context, const char *line);
void test_public_add(pspec_question *question, const pspec_pattern *patterns, size_t num);
/* The answer, which is there, or the status, and a piece of the sentence. */
pspec_answer *test_public_answer(pspec_context *context, pspec_question *question);
void test_public_refuse(pspec_context *context, pspec_question *question, pspec_status status,
                        const char *piece);
/* The same of a question that is made for it, and patterns. */
pspec_answer *test_public_ask(pspec_context *context, const char *line,
                              const pspec_pattern *patterns, size_t num);
void test_public_refused(pspec_context *context, pspec_status found, pspec_status expected,
                         const char *piece);

/* The field, which is there and has this type; the only text of one. */
const pspec_field *test_public_field(const pspec_answer *answer, const char *name, pspec_type type);
const double *test_public_numbers(const pspec_answer *answer, const char *name);
const char *test_public_text(const pspec_answer *answer, const char *name);
/* All columns, and arrays, have the same bits; entries are not looked at. */
bool test_public_same(const pspec_answer *a, const pspec_answer *b);

/* Installs an error handler of GSL's that counts. At the end of a program, as a test: it is still
 * there, after everything that the library did, and nobody called it. */
void test_watch_gsl(void);
void test_gsl_is_left_alone(void **state);

#endif
