/* Integrands of a caller of the library: values and the integral, and nothing that tells a variance
 * ahead. Powers are 0, for no frequency is asked for their sake, and the energy is nan. */
#include "integrands/integrand_kind.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

typedef struct given {
    const ps_given_integrand *by;
    ps_error failure; /* the first one; values are nan after it, and nobody is asked again */
} given;

static void destroy(ps_integrand *self) {
    free(self->own);
}

static double integral(const ps_integrand *self) {
    return ((const given *)self->own)->by->integral;
}

static double energy(const ps_integrand *self) {
    (void)self;
    return NAN;
}

static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    (void)self, (void)vectors, (void)error;
    memset(out, 0, num * sizeof *out);
    return PSPEC_OK;
}

static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    (void)self, (void)error;
    memset(out, 0, (max_degree + 1) * sizeof *out);
    return PSPEC_OK;
}

static bool is_isotropic(const ps_integrand *self) {
    (void)self;
    return true; /* sums over boxes and over shells are the same: there are none */
}

static double reach(const ps_integrand *self) {
    (void)self;
    return 0;
}

static const ps_error *failure(const ps_integrand *self) {
    return &((const given *)self->own)->failure;
}

static pspec_status refuse(const ps_integrand *self, const double *point, double value,
                           ps_error *error) {
    ps_text text = {0};
    for (unsigned i = 0; i < self->place.dimension; i++) {
        ps_text_append(&text, "%s%.17g", i > 0 ? ", " : "", point[i]);
    }
    ps_fail(error, PSPEC_ERROR_INPUT, "integrand %s: the value at (%s) is %g, no finite number",
            ((const given *)self->own)->by->name, ps_text_string(&text), value);
    ps_text_free(&text);
    return PSPEC_ERROR_INPUT;
}

static pspec_status ask(const ps_integrand *self, const double *points, size_t num, double *out,
                        ps_error *error) {
    const ps_given_integrand *const by = ((const given *)self->own)->by;
    const unsigned dimension = self->place.dimension;
    PS_TRY(by->values(by->payload, num, dimension, points, out, error));
    for (size_t i = 0; i < num; i++) {
        if (!isfinite(out[i])) {
            return refuse(self, points + i * dimension, out[i], error);
        }
    }
    return PSPEC_OK;
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    given *const own = self->own;
    if (own->failure.status == PSPEC_OK) {
        own->failure.status = ask(self, points, num, out, &own->failure);
    }
    for (size_t i = 0; own->failure.status != PSPEC_OK && i < num; i++) {
        out[i] = NAN;
    }
}

static const ps_integrand_kind kind = {
    .name = "of the caller",
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .degrees = degrees,
    .values = values,
    .failure = failure,
    .is_isotropic = is_isotropic,
    .reach = reach,
};

const ps_given_integrand *ps_given_integrands_find(const ps_given_integrands *list,
                                                   const char *text) {
    size_t i = 0;
    while (i < list->num && strcmp(list->all[i].name, text) != 0) {
        i++;
    }
    return i < list->num ? &list->all[i] : NULL;
}

pspec_status ps_integrand_make(ps_integrand **out, const ps_given_integrands *list,
                               const char *text, ps_integrand_place place, uint64_t most_bytes,
                               ps_error *error) {
    const ps_given_integrand *const by = ps_given_integrands_find(list, text);
    given *own = NULL;
    *out = NULL;
    if (by == NULL) {
        return ps_integrand_parse_within(out, text, place, most_bytes, error);
    }
    if (!isfinite(by->integral)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: its integral is %g, and variances are about a number", text,
                       by->integral);
    }
    PS_TRY(PS_NEW(&own, 1, "an integrand", error));
    own->by = by;
    const pspec_status status = PS_NEW(out, 1, "an integrand", error);
    if (status != PSPEC_OK) {
        free(own);
        return status;
    }
    **out = (ps_integrand){.kind = &kind, .place = place, .own = own};
    return PSPEC_OK;
}
