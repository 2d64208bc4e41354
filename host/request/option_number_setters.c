/* Setters of options whose values are several numbers. */
#include "request/option_rows.h"

#include "base/text.h"
#include "math/sobolev.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The size of a box and differences in it are numbers, and its inverse is, too. */
#define MOST_BOX 1e300
#define LEAST_BOX 1e-300
/* As in meshes. */
#define MOST_CAMERA_NUMBER 1e30
/* 2^24 pixels are 1 GB of places and turns. */
#define MOST_IMAGE_SIDE 4096

/* Numbers between commas; *num: how many there are, of which the first `most` are written. */
static pspec_status parse_numbers(const ps_said *said, double *numbers, size_t most, double limit,
                                  size_t *num, ps_error *error) {
    enum { NUMBER_BYTES = 64 };
    bool is_more = true;
    *num = 0;
    for (const char *at = said->text; is_more; ++*num) {
        char own[NUMBER_BYTES];
        const size_t length = strcspn(at, ",");
        is_more = at[length] == ',';
        if (length >= sizeof own) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%.60s\" is no number",
                           said->shown, at);
        }
        snprintf(own, sizeof own, "%.*s", (int)length, at);
        if (*num < most) {
            PS_TRY(ps_parse_number(own, said->shown, -limit, limit, &numbers[*num], error));
        }
        at += length + is_more;
    }
    return PSPEC_OK;
}

pspec_status ps_set_smoothness(const ps_said *said, ps_error *error) {
    ps_request *const request = said->request;
    ps_error reason = {0};
    PS_TRY(parse_numbers(said, request->smoothness, PS_MAX_SMOOTHNESS, DBL_MAX,
                         &request->num_smoothness, error));
    if (request->num_smoothness > PS_MAX_SMOOTHNESS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %zu numbers are more than %d",
                       said->shown, request->num_smoothness, PS_MAX_SMOOTHNESS);
    }
    for (size_t i = 0; i < request->num_smoothness; i++) {
        if (ps_sobolev_check(request->smoothness[i], &reason) != PSPEC_OK) {
            return ps_fail(error, reason.status, "%s: %s", said->shown, reason.message);
        }
        for (size_t k = 0; k < i; k++) {
            if (request->smoothness[k] == request->smoothness[i]) {
                return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                               "%s: %g is there twice, and gives the same rows twice", said->shown,
                               request->smoothness[i]);
            }
        }
    }
    return PSPEC_OK;
}

static pspec_status check_interval(const ps_said *said, unsigned axis, double low, double high,
                                   ps_error *error) {
    const char first = "XYZUVW"[axis];
    if (!(low < high)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: %s is no interval: %c0 must be below %c1", said->shown, said->text,
                       first, first);
    }
    return high - low >= LEAST_BOX ? PSPEC_OK
                                   : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                             "%s: %s is %.3g wide, and must be at least %g",
                                             said->shown, said->text, high - low, LEAST_BOX);
}

/* "0,8", or "0,8,0,4": an interval for each axis. */
pspec_status ps_set_box(const ps_said *said, ps_error *error) {
    enum { MOST = 2 * PS_MAX_DIMENSION };
    double ends[MOST];
    size_t num = 0;
    ps_box *const box = &said->request->reading.box;
    PS_TRY(parse_numbers(said, ends, MOST, MOST_BOX, &num, error));
    if (num % 2 != 0 || num > MOST) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" has %zu number%s; an interval of all axes has two, X0,X1, and "
                       "the axes may have one each, X0,X1,Y0,Y1",
                       said->shown, said->text, num, num == 1 ? "" : "s");
    }
    *box = (ps_box){.num_axes = (unsigned)num / 2};
    for (unsigned i = 0; i < box->num_axes; i++) {
        box->low[i] = ends[2 * i];
        box->high[i] = ends[2 * i + 1];
        PS_TRY(check_interval(said, i, box->low[i], box->high[i], error));
    }
    return PSPEC_OK;
}

/* "256:512" */
pspec_status ps_set_realization_range(const ps_said *said, ps_error *error) {
    enum { NUMBER_BYTES = 32 };
    char first[NUMBER_BYTES];
    ps_realization_range *const range = &said->request->range;
    const size_t length = strcspn(said->text, ":");
    if (said->text[length] == '\0' || length == 0 || length >= sizeof first) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" is not A:B, as in 256:512, the realizations 256 to 511",
                       said->shown, said->text);
    }
    snprintf(first, sizeof first, "%.*s", (int)length, said->text);
    PS_TRY(ps_parse_count(first, said->shown, 0, MOST_REALIZATIONS, &range->first, error));
    PS_TRY(ps_parse_count(said->text + length + 1, said->shown, 1, MOST_REALIZATIONS, &range->end,
                          error));
    return range->first < range->end
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: %s has no realization: A must be below B", said->shown, said->text);
}

/* "3" or "3,-4": whole numbers, as many as dimensions, not all 0. */
pspec_status ps_set_scatter(const ps_said *said, ps_error *error) {
    ps_frequencies_spec *const spec = &said->request->frequencies;
    double numbers[PS_MAX_DIMENSION];
    size_t num = 0;
    bool is_zero = true;
    PS_TRY(parse_numbers(said, numbers, PS_MAX_DIMENSION, PS_MAX_FREQUENCY, &num, error));
    if (num > PS_MAX_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: a frequency has %d numbers at most, and \"%s\" has %zu", said->shown,
                       PS_MAX_DIMENSION, said->text, num);
    }
    for (size_t i = 0; i < num; i++) {
        if (numbers[i] != floor(numbers[i])) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %g is not a whole number",
                           said->shown, numbers[i]);
        }
        is_zero = is_zero && numbers[i] == 0;
        spec->shown[i] = (int32_t)numbers[i];
    }
    spec->num_shown = (unsigned)num;
    return !is_zero ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                              "%s: S(0) is the sum of weights, and does not scatter", said->shown);
}

/* Position, target, and perhaps an angle, and perhaps a direction. */
pspec_status ps_set_camera(const ps_said *said, ps_error *error) {
    enum { ANGLE = 6 };
    const double most_angle = 170; /* a picture of a plane ends at 180 */
    ps_request *const request = said->request;
    const double *const angle = &request->camera[ANGLE];
    size_t num = 0;
    PS_TRY(parse_numbers(said, request->camera, PS_MOST_CAMERA, MOST_CAMERA_NUMBER, &num, error));
    if (num != ANGLE && num != ANGLE + 1 && num != PS_MOST_CAMERA) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" has %zu numbers; a camera has 6, X,Y,Z,X,Y,Z, or 7 with an "
                       "angle, or 10 with a direction that is up",
                       said->shown, said->text, num);
    }
    request->num_camera = (unsigned)num;
    return num == ANGLE || (*angle > 0 && *angle <= most_angle)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: a field of view of %g degrees is not above 0 and at most %g",
                         said->shown, *angle, most_angle);
}

/* "256x192" */
pspec_status ps_set_image(const ps_said *said, ps_error *error) {
    enum { DIGITS = 4, BASE = 10 };
    const char *text = said->text;
    size_t *const sides = said->request->image;
    for (int i = 0; i < 2; i++) {
        const size_t length = strspn(text, "0123456789");
        const char end = i == 0 ? 'x' : '\0';
        sides[i] = length <= DIGITS ? (size_t)strtoul(text, NULL, BASE) : 0;
        if (text[length] != end || sides[i] == 0 || sides[i] > MOST_IMAGE_SIDE) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "%s: \"%s\" is not WIDTHxHEIGHT, as in 256x192, each from 1 to %d",
                           said->shown, said->text, MOST_IMAGE_SIDE);
        }
        text += length + 1;
    }
    return PSPEC_OK;
}
