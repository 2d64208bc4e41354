/* What the sampler tests share: a request from text, what is refused, and a realization in fresh
 * memory. */
#ifndef TEST_SAMPLERS_H
#define TEST_SAMPLERS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "samplers/sampler.h"

/* Parsed, not yet checked. */
static inline ps_sampler_request parse_request(const char *text, size_t num_points,
                                               unsigned dimension) {
    ps_sampler_request request = {.num_points = num_points, .dimension = dimension, .seed = 1};
    ps_error error = {0};
    if (ps_sampler_parse(&request, text, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return request;
}

static inline ps_sampler_request make_request(const char *text, size_t num_points,
                                              unsigned dimension) {
    const ps_sampler_request request = parse_request(text, num_points, dimension);
    ps_error error = {0};
    if (ps_sampler_check(&request, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return request;
}

static inline void assert_refused(const char *text, size_t num_points, unsigned dimension,
                                  const char *why) {
    ps_sampler_request request = parse_request(text, num_points, dimension);
    ps_error error = {0};
    assert_int_equal(ps_sampler_resolve(&request, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, why) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, why);
    }
}

static inline double *allocate_points(const ps_sampler_request *request) {
    double *points = malloc(request->num_points * request->dimension * sizeof *points);
    assert_non_null(points);
    return points;
}

static inline void generate_into(const ps_sampler_request *request, uint64_t realization,
                                 double *points) {
    ps_error error = {0};
    if (ps_sampler_generate(request, realization, points, NULL, NULL, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
}

/* The caller frees it. */
static inline double *generate_points(const ps_sampler_request *request, uint64_t realization) {
    double *points = allocate_points(request);
    generate_into(request, realization, points);
    return points;
}

#endif
