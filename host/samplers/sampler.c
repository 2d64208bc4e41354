#include "samplers/sampler.h"

#include "base/memory.h"
#include "math/random/random.h"
#include "math/random/rotation.h"
#include "math/lift.h"
#include "samplers/pace.h"
#include "samplers/values.h"

#include <inttypes.h>
#include <stdio.h>

/* Indices, and sums of an index and a 53-bit offset, stay far inside the doubles; 2^40 points of
 * the plane are 16 TiB. */
static const uint64_t MAXIMUM_POINTS = (uint64_t)1 << 40;

/* ---- where points lie ---------------------------------------------------------------------- */

ps_sampler_domain ps_sampler_where(const ps_sampler_request *request) {
    return request->lift != PS_SAMPLES_TORUS ? request->lift : request->sampler->domain;
}

bool ps_sampler_is_on_sphere(const ps_sampler_request *request) {
    return ps_sampler_where(request) != PS_SAMPLES_TORUS;
}

bool ps_sampler_is_on_hemisphere(const ps_sampler_request *request) {
    return ps_sampler_where(request) == PS_SAMPLES_HEMISPHERE;
}

/* The request as its sampler sees it: what is lifted are points of the plane. */
static ps_sampler_request own_request(const ps_sampler_request *request) {
    enum { PLANE = 2 };
    ps_sampler_request own = *request;
    if (request->lift != PS_SAMPLES_TORUS) {
        own.lift = PS_SAMPLES_TORUS;
        own.dimension = PLANE;
    }
    return own;
}

unsigned ps_sampler_own_dimension(const ps_sampler_request *request) {
    return own_request(request).dimension;
}

size_t ps_sampler_most_points(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return own.sampler->most_points != NULL ? own.sampler->most_points(&own) : own.num_points;
}

bool ps_sampler_varies(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return own.sampler->varies != NULL && own.sampler->varies(&own);
}

double ps_sampler_numbers(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return (double)own.num_points * (ps_sampler_is_on_sphere(&own) ? 1 : own.dimension);
}

double ps_sampler_seconds(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return own.sampler->seconds != NULL
               ? own.sampler->seconds(&own)
               : ps_sampler_numbers(&own) * own.sampler->nanoseconds * PS_NANOSECOND;
}

double ps_sampler_work_bytes(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return own.sampler->work_bytes != NULL ? own.sampler->work_bytes(&own) : 0;
}

/* ---- checks -------------------------------------------------------------------------------- */

static pspec_status check_dimension(const ps_sampler_request *request, ps_error *error) {
    const ps_sampler *sampler = request->sampler;
    const unsigned minimum = sampler->minimum_dimension > 1 ? sampler->minimum_dimension : 1;
    if (ps_sampler_is_on_sphere(request)) {
        return request->dimension == PS_VECTOR_DIMENSION
                   ? PSPEC_OK
                   : ps_fail(
                         error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "sampler %s: dimension %u was given, but points of the sphere are unit "
                         "vectors of %d numbers; leave the dimension away",
                         sampler->name, request->dimension, PS_VECTOR_DIMENSION);
    }
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
    if (request->num_points < request->sampler->minimum_points) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: %zu point%s asked for, it makes %zu and more",
                       request->sampler->name, request->num_points,
                       request->num_points == 1 ? "" : "s", request->sampler->minimum_points);
    }
    if (!ps_size_multiply(ps_sampler_most_points(request), request->dimension, &count) ||
        !ps_size_multiply(count, sizeof(double), &num_bytes)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY,
                       "sampler %s: %zu points of %u coordinates exceed the address space",
                       request->sampler->name, request->num_points, request->dimension);
    }
    return request->sampler->maximum_points > 0
               ? ps_sampler_limit_points(request, request->sampler->maximum_points, error)
               : PSPEC_OK;
}

static pspec_status check_numbers(const ps_sampler_request *request, ps_error *error) {
    enum { WORDS = 96 };
    const ps_sampler *const sampler = request->sampler;
    for (size_t i = 0; sampler->parameters[i].key != NULL; i++) {
        const ps_sampler_range *const range = &sampler->ranges[i];
        char what[WORDS];
        double number = 0;
        uint64_t count = 0;
        snprintf(what, sizeof what, "sampler %s: %s", sampler->name, sampler->parameters[i].key);
        if (range->most > 0) {
            PS_TRY(range->is_whole
                       ? ps_parse_count(request->values[i], what, (uint64_t)range->least,
                                        (uint64_t)range->most, &count, error)
                       : ps_parse_number(request->values[i], what, range->least, range->most,
                                         &number, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_sampler_check(const ps_sampler_request *request, ps_error *error) {
    PS_TRY(check_dimension(request, error));
    PS_TRY(check_size(request, error));
    PS_TRY(check_numbers(request, error));
    const ps_sampler_request own = own_request(request);
    return own.sampler->check != NULL ? own.sampler->check(&own, error) : PSPEC_OK;
}

pspec_status ps_sampler_resolve(ps_sampler_request *request, ps_error *error) {
    const ps_sampler *sampler = request->sampler;
    if (request->dimension == 0) {
        request->dimension =
            ps_sampler_is_on_sphere(request) ? PS_VECTOR_DIMENSION : PS_DEFAULT_DIMENSION;
    }
    if (request->num_points == 0) {
        request->num_points = PS_DEFAULT_POINTS;
        if (sampler->open_points != NULL) {
            const ps_sampler_request own = own_request(request);
            PS_TRY(sampler->open_points(&own, &request->num_points, error));
        }
    }
    return ps_sampler_check(request, error);
}

/* ---- points -------------------------------------------------------------------------------- */

typedef struct shift {
    unsigned dimension;
    double by[PS_MAX_DIMENSION];
} shift;

/* x + shift < 2, and a sum that reaches 1 loses exactly 1: the result stays in [0,1). */
static void add_shift(const void *payload, size_t first, size_t end, double *points) {
    const shift *const self = payload;
    double *x = points + first * self->dimension;
    for (size_t j = first; j < end; j++) {
        for (unsigned i = 0; i < self->dimension; i++) {
            const double sum = *x + self->by[i];
            *x++ = sum < 1 ? sum : sum - 1;
        }
    }
}

static pspec_status shift_points(const ps_sampler_request *request, uint64_t realization,
                                 double *points, ps_error *error) {
    shift self = {.dimension = request->dimension};
    ps_random random = ps_random_init(request->seed, PS_STREAM_SHIFT, realization);
    for (unsigned i = 0; i < request->dimension; i++) {
        self.by[i] = ps_random_uniform(&random);
    }
    return ps_sampler_pieces(request, "sampler: points shifted", add_shift, &self, points, error);
}

static void rotate(const void *payload, size_t first, size_t end, double *points) {
    ps_rotate(payload, points + PS_VECTOR_DIMENSION * first, end - first);
}

static void fold(const void *payload, size_t first, size_t end, double *points) {
    (void)payload;
    ps_sphere_fold(end - first, points + PS_VECTOR_DIMENSION * first);
}

static void morph(const void *payload, size_t first, size_t end, double *points) {
    ps_morph_points(payload, end - first, points + PS_VECTOR_DIMENSION * first);
}

static pspec_status rotate_points(const ps_sampler_request *request, uint64_t realization,
                                  double *points, ps_error *error) {
    ps_random random = ps_random_init(request->seed, PS_STREAM_ROTATION, realization);
    const ps_rotation rotation = ps_rotation_random(&random);
    PS_TRY(ps_sampler_pieces(request, "sampler: points rotated", rotate, &rotation, points, error));
    return ps_sampler_is_on_hemisphere(request)
               ? ps_sampler_pieces(request, "sampler: points folded", fold, NULL, points, error)
               : PSPEC_OK;
}

static pspec_status homogenize_points(const ps_sampler_request *request, uint64_t realization,
                                      double *points, ps_error *error) {
    if (!request->homogenize) {
        return PSPEC_OK;
    }
    return ps_sampler_is_on_sphere(request) ? rotate_points(request, realization, points, error)
                                            : shift_points(request, realization, points, error);
}

bool ps_sampler_uses_device(const ps_sampler_request *request) {
    return request->sampler->check_device != NULL;
}

pspec_status ps_sampler_check_device(const ps_sampler_request *request, const char *selector,
                                     ps_error *error) {
    return ps_sampler_uses_device(request)
               ? request->sampler->check_device(request, selector, error)
               : PSPEC_OK;
}

pspec_status ps_sampler_make(const ps_sampler_request *request, uint64_t realization,
                             double *points, size_t *num_points, const ps_watch *watch,
                             ps_error *error) {
    ps_sampler_request own = own_request(request);
    own.watch = watch;
    *num_points = own.num_points;
    return own.sampler->generate != NULL
               ? own.sampler->generate(&own, realization, points, error)
               : own.sampler->generate_some(&own, realization, points, num_points, error);
}

pspec_status ps_sampler_place(const ps_sampler_request *request, uint64_t realization,
                              double *points, size_t num_points, const ps_watch *watch,
                              ps_error *error) {
    ps_sampler_request whole = *request;
    whole.watch = watch;
    whole.num_points = num_points;
    if (request->lift != PS_SAMPLES_TORUS) {
        PS_TRY(ps_sampler_lift(&whole, request->lift == PS_SAMPLES_HEMISPHERE, points, error));
    }
    PS_TRY(homogenize_points(&whole, realization, points, error));
    return ps_sampler_is_on_hemisphere(request) && request->morph.kind != PS_MORPH_NONE
               ? ps_sampler_pieces(&whole, "sampler: points morphed", morph, &request->morph,
                                   points, error)
               : PSPEC_OK;
}

pspec_status ps_sampler_generate(const ps_sampler_request *request, uint64_t realization,
                                 double *points, size_t *num_points, const ps_watch *watch,
                                 ps_error *error) {
    size_t num = 0;
    PS_TRY(ps_sampler_make(request, realization, points, &num, watch, error));
    if (num_points != NULL) {
        *num_points = num;
    }
    return ps_sampler_place(request, realization, points, num, watch, error);
}

pspec_status ps_sampler_fill_places(const ps_sampler_request *request, ps_sampler_places *out,
                                    ps_error *error) {
    const ps_sampler_by_index *const by_index = &request->sampler->by_index;
    *out =
        (ps_sampler_places){.numbers = {.seed = request->seed, .num_points = request->num_points}};
    const ps_sampler_request own = own_request(request);
    return by_index->fill != NULL ? by_index->fill(&own, out, error) : PSPEC_OK;
}

void ps_sampler_identify(const ps_sampler_request *request, ps_text *out) {
    const ps_sampler_request own = own_request(request);
    ps_text_append(out, "%s, version %u\npoints %zu\ndimension %u\nseed %" PRIu64 "\n",
                   own.sampler->name, own.sampler->version, own.num_points, own.dimension,
                   own.seed);
    for (size_t i = 0; own.sampler->parameters[i].key != NULL; i++) {
        ps_text_append(out, "%s=%s\n", own.sampler->parameters[i].key, own.values[i]);
    }
}

double ps_sampler_most_power(const ps_sampler_request *request) {
    const bool is_known =
        request->morph.kind == PS_MORPH_NONE && request->sampler->most_power != NULL;
    return is_known ? request->sampler->most_power(request) : 0;
}

const char *ps_sampler_note(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    return own.sampler->note != NULL ? own.sampler->note(&own) : NULL;
}

bool ps_sampler_has_constant_power(const ps_sampler_request *request) {
    const ps_sampler_request own = own_request(request);
    const bool changes_with_rotation = request->homogenize && request->morph.kind != PS_MORPH_NONE;
    return own.sampler->is_deterministic(&own) && !changes_with_rotation;
}
