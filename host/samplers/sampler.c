#include "samplers/sampler.h"

#include "base/memory.h"
#include "math/random.h"
#include "samplers/values.h"

/* Indices, and sums of an index and a 53-bit offset, stay far inside the doubles; 2^40 points of
 * the plane are 16 TiB. */
static const uint64_t MAXIMUM_POINTS = (uint64_t)1 << 40;

static pspec_status check_dimension(const ps_sampler_request *request, ps_error *error) {
    const ps_sampler *sampler = request->sampler;
    const unsigned minimum = sampler->minimum_dimension > 1 ? sampler->minimum_dimension : 1;
    if (request->dimension < minimum || request->dimension > sampler->maximum_dimension) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: dimension %u is not between %u and %u", sampler->name,
                       request->dimension, minimum, sampler->maximum_dimension);
    }
    return PSPEC_OK;
}

static pspec_status check_size(const ps_sampler_request *request, ps_error *error) {
    size_t count = 0;
    size_t num_bytes = 0;
    if (request->num_points == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: 0 points asked for, at least 1 is needed",
                       request->sampler->name);
    }
    PS_TRY(ps_sampler_limit_points(request, MAXIMUM_POINTS, error));
    if (!ps_size_multiply(request->num_points, request->dimension, &count) ||
        !ps_size_multiply(count, sizeof(double), &num_bytes)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "sampler %s: %zu points of %u coordinates exceed the address space",
                       request->sampler->name, request->num_points, request->dimension);
    }
    return PSPEC_OK;
}

pspec_status ps_sampler_check(const ps_sampler_request *request, ps_error *error) {
    PS_TRY(check_dimension(request, error));
    PS_TRY(check_size(request, error));
    return request->sampler->check != NULL ? request->sampler->check(request, error) : PSPEC_OK;
}

/* x + shift < 2, and a sum that reaches 1 loses exactly 1: the result stays in [0,1). */
static void shift_points(const ps_sampler_request *request, uint64_t realization, double *points) {
    double shift[PS_MAX_DIMENSION];
    ps_random random = ps_random_init(request->seed, PS_STREAM_SHIFT, realization);
    for (unsigned i = 0; i < request->dimension; i++) {
        shift[i] = ps_random_uniform(&random);
    }
    for (size_t j = 0; j < request->num_points; j++) {
        for (unsigned i = 0; i < request->dimension; i++) {
            const double sum = *points + shift[i];
            *points++ = sum < 1 ? sum : sum - 1;
        }
    }
}

pspec_status ps_sampler_generate(const ps_sampler_request *request, uint64_t realization,
                                 double *points, ps_error *error) {
    PS_TRY(request->sampler->generate(request, realization, points, error));
    if (request->homogenize) {
        shift_points(request, realization, points);
    }
    return PSPEC_OK;
}

const char *ps_sampler_note(const ps_sampler_request *request) {
    return request->sampler->note != NULL ? request->sampler->note(request) : NULL;
}

bool ps_sampler_has_constant_power(const ps_sampler_request *request) {
    return request->sampler->is_deterministic(request);
}
