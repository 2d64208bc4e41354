/* Sets that a caller of the library has in memory, the same in a file, and questions. */
#ifndef TEST_HARNESS_GIVEN_H
#define TEST_HARNESS_GIVEN_H

#include "harness.h"

#include "answers/kind.h"
#include "harness_points.h"

#include <pthread.h>

enum { TEST_MOST_SETS = 64, TEST_LINE = 512, TEST_MOST_FILES = 4 };

/* Sets of a caller. What it shows is a copy, gone at the next call: sanitizers find who reads it
 * then. */
typedef struct test_given {
    char name[TEST_PATH_BYTES];
    unsigned dimension;
    size_t num_sets, num_points[TEST_MOST_SETS];
    bool has_weights;
    double *points[TEST_MOST_SETS], *weights[TEST_MOST_SETS];
    double *view;
    pthread_t thread;       /* which made them, and alone may ask */
    size_t next, num_calls; /* the realization that may come, and calls */
    size_t failing, other;  /* sets that fail, or have other dimensions, from 1; 0: none */
} test_given;

/* Sets of num points, each of `more` more than the one before, called FOLDER/NAME: on the torus,
 * where d = 3 unit vectors; freed by test_given_free. */
void test_given_make(test_given *self, const test_folder *folder, const char *name,
                     unsigned dimension, bool has_weights, size_t num_sets, size_t num,
                     size_t more);
void test_given_free(test_given *self);
ps_given_set test_given_set(test_given *self);
/* Writes them to a file of that name: "npy", in double precision, or "utk-text". */
void test_given_save(const test_given *self, const char *format);

/* A question of a kind, as a command line has it; the text has the words that the request borrows.
 */
typedef struct test_question {
    char text[TEST_LINE];
    const ps_kind *kind;
    ps_request request;
    const char *files[TEST_MOST_FILES];
} test_question;

/* "power files=%s max-frequency=4 rank", as printf has it. */
void test_ask(test_question *out, const char *format, ...);

#endif
