/* The public library: coefficients of lobes, and truncated products. */
#include "api/public_objects.h"
#include "rules/equal_error.h"
#include "rules/truncation.h"

#include <math.h>

/* How far apart the brackets of hemispherical sums may be, relative to E; as in `pointspec
 * truncation`. */
static const double BRACKET = 1e-4;
enum { MOST_DEGREE = 10000 };

static pspec_status check_degree(int32_t max_degree, ps_error *error) {
    return max_degree >= 0 && max_degree <= MOST_DEGREE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "max_degree %d is not between 0 and %d", (int)max_degree, MOST_DEGREE);
}

static pspec_status check_room(bool is_there, pspec_context *context) {
    return is_there ? PSPEC_OK
                    : ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                              "there is no room for what is computed");
}

static pspec_status parse_brdf(ps_brdf **out, pspec_context *context, const char *text) {
    return text != NULL ? ps_brdf_parse(out, text, &context->error)
                        : ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                                  "there is no name of a BRDF");
}

pspec_status pspec_brdf_coefficients(pspec_context *context, const char *brdf, int hemispherical,
                                     int32_t max_degree, double *b) {
    ps_brdf *lobe = NULL;
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    PS_TRY(check_degree(max_degree, &context->error));
    PS_TRY(check_room(b != NULL, context));
    PS_TRY(parse_brdf(&lobe, context, brdf));
    const size_t last = (size_t)max_degree;
    const pspec_status status = hemispherical != 0
                                    ? ps_brdf_hemispherical(lobe, last, b, &context->error)
                                    : ps_brdf_spherical(lobe, last, b, &context->error);
    ps_brdf_destroy(lobe);
    return status;
}

static pspec_status find_points(pspec_context *context, const ps_brdf *lobe,
                                const ps_representer *representer, size_t last,
                                const double *errors, double *points) {
    ps_equal_error equal = {.representer = representer, .morph = ps_brdf_morph(lobe)};
    for (size_t l = 0; l <= last; l++) {
        points[l] = NAN;
        if (equal.morph.kind != PS_MORPH_NONE && errors[l] > 0) {
            PS_TRY(ps_equal_error_points(&equal, errors[l], &points[l], &context->error));
        }
        PS_TRY(ps_watch_tell(&context->watch, "degrees", l + 1, last + 1, NULL, &context->error));
    }
    return PSPEC_OK;
}

pspec_status pspec_truncation(pspec_context *context, const char *brdf, double smoothness,
                              int hemispherical, int32_t max_degree, double *errors, double *bounds,
                              double *points) {
    ps_representer representer = {0};
    ps_brdf *lobe = NULL;
    size_t sh_degree = 0;
    pspec_status status = PSPEC_OK;
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    const size_t last = max_degree > 0 ? (size_t)max_degree : 0;
    PS_TRY(check_degree(max_degree, error));
    PS_TRY(check_room(errors != NULL && bounds != NULL, context));
    PS_TRY(parse_brdf(&lobe, context, brdf));
    /* twice the degrees: the last one's rest is then mostly summed, not bracketed */
    PS_TRY_OUT(status, ps_representer_create(&representer, lobe, smoothness,
                                             PS_REPRESENTER_TOLERANCE, 2 * (last + 1), error));
    PS_TRY_OUT(status, hemispherical != 0
                           ? ps_truncation_hemispherical(lobe, smoothness, last, BRACKET, errors,
                                                         bounds, &sh_degree, error)
                           : ps_truncation_spherical(&representer, last, errors, bounds, error));
    if (points != NULL) {
        PS_TRY_OUT(status, find_points(context, lobe, &representer, last, errors, points));
    }
out:
    ps_representer_destroy(&representer);
    ps_brdf_destroy(lobe);
    return status;
}
