#include "integrands/integrand_kind.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

/* In the order of the help text. A new integrand is a file and a row here. */
const ps_integrand_kind *const ps_integrand_kinds[] = {
    &ps_integrand_ball,         &ps_integrand_box,    &ps_integrand_half_plane,
    &ps_integrand_gaussian,     &ps_integrand_wave,   &ps_integrand_constant,
    &ps_integrand_coefficients, &ps_integrand_pixels, &ps_integrand_cap,
    &ps_integrand_harmonic,     &ps_integrand_square, &ps_integrand_lobe,
    &ps_integrand_diffuse,      &ps_integrand_glossy, &ps_integrand_phong,
    &ps_integrand_zonal,        &ps_integrand_map,    NULL};

/* ---- parsing ------------------------------------------------------------------------------- */

static bool has_alias(const ps_integrand_kind *kind, const char *name) {
    const size_t length = strlen(name);
    const char *at = kind->aliases;
    while (at != NULL && *at != '\0') {
        const size_t word = strcspn(at, " ");
        if (word == length && memcmp(at, name, word) == 0) {
            return true;
        }
        at += word + strspn(at + word, " ");
    }
    return false;
}

static pspec_status fail_unknown(const char *name, ps_error *error) {
    ps_text names = {0};
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        ps_text_append(&names, "%s%s", i > 0 ? ", " : "", ps_integrand_kinds[i]->name);
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown integrand \"%s\"; there are %s", name,
            ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

static pspec_status find_kind(const ps_integrand_kind **kind, const char *name, ps_error *error) {
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        *kind = ps_integrand_kinds[i];
        if (strcmp((*kind)->name, name) == 0 || has_alias(*kind, name)) {
            return PSPEC_OK;
        }
    }
    return fail_unknown(name, error);
}

static pspec_status check_place(const ps_integrand_kind *kind, ps_integrand_place place,
                                ps_error *error) {
    static const char *const names[] = {[PS_SAMPLES_TORUS] = "the torus",
                                        [PS_SAMPLES_SPHERE] = "the sphere",
                                        [PS_SAMPLES_HEMISPHERE] = "the hemisphere"};
    if ((kind->domains & PS_INTEGRAND_ON(place.where)) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: there is none on %s, where the points are", kind->name,
                       names[place.where]);
    }
    if (place.where != PS_SAMPLES_TORUS ||
        (place.dimension >= kind->least && place.dimension <= kind->most)) {
        return PSPEC_OK;
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "integrand %s: points have %u dimensions, and it has %u to %u", kind->name,
                   place.dimension, kind->least, kind->most);
}

static pspec_status read_values(ps_integrand *self, const char *rest, ps_error *error) {
    char **texts = NULL;
    PS_TRY(ps_grammar_texts(&texts, "integrand", self->kind->name, self->kind->parameters, rest,
                            error));
    const pspec_status status = self->kind->create != NULL
                                    ? self->kind->create(self, (const char *const *)texts, error)
                                    : PSPEC_OK;
    free(texts);
    return status;
}

pspec_status ps_integrand_find(const ps_integrand_kind **kind, const char *text, ps_error *error) {
    char name[PS_GRAMMAR_WORD];
    ps_grammar_name(text, name);
    return find_kind(kind, name, error);
}

pspec_status ps_integrand_parse(ps_integrand **out, const char *text, ps_integrand_place place,
                                ps_error *error) {
    return ps_integrand_parse_within(out, text, place, 0, error);
}

pspec_status ps_integrand_parse_within(ps_integrand **out, const char *text,
                                       ps_integrand_place place, uint64_t most_bytes,
                                       ps_error *error) {
    char name[PS_GRAMMAR_WORD];
    const ps_integrand_kind *kind = NULL;
    ps_integrand *self = NULL;
    *out = NULL;
    const char *const rest = ps_grammar_name(text, name);
    PS_TRY(find_kind(&kind, name, error));
    PS_TRY(check_place(kind, place, error));
    PS_TRY(PS_NEW(&self, 1, "an integrand", error));
    self->kind = kind;
    self->place = place;
    self->most_bytes = most_bytes;
    const pspec_status status = read_values(self, rest, error);
    if (status != PSPEC_OK) {
        ps_integrand_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_integrand_destroy(ps_integrand *integrand) {
    if (integrand != NULL && integrand->kind->destroy != NULL) {
        integrand->kind->destroy(integrand);
    }
    free(integrand);
}

/* ---- what is known ------------------------------------------------------------------------- */

const char *ps_integrand_kernel(const ps_integrand *integrand, bool in_doubles) {
    return integrand->needs_doubles && !in_doubles ? NULL
           : integrand->kernel != NULL             ? integrand->kernel
                                                   : integrand->kind->kernel;
}

double ps_integrand_integral(const ps_integrand *integrand) {
    return integrand->kind->integral(integrand);
}

double ps_integrand_energy(const ps_integrand *integrand) {
    return integrand->kind->energy(integrand);
}

bool ps_integrand_is_predicted(const ps_integrand *integrand) {
    return !isnan(ps_integrand_energy(integrand));
}

double ps_integrand_factor(const ps_integrand *integrand) {
    static const double factors[] = {
        [PS_SAMPLES_TORUS] = 1, [PS_SAMPLES_SPHERE] = PS_FOUR_PI, [PS_SAMPLES_HEMISPHERE] = PS_PI};
    return factors[integrand->place.where];
}

pspec_status ps_integrand_powers(const ps_integrand *integrand, const int32_t *vectors, size_t num,
                                 double *powers, ps_error *error) {
    return integrand->kind->powers != NULL
               ? integrand->kind->powers(integrand, vectors, num, powers, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "integrand %s: its powers are those of its points", integrand->kind->name);
}

bool ps_integrand_has_points(const ps_integrand *integrand) {
    return integrand->kind->points != NULL;
}

pspec_status ps_integrand_make_points(const ps_integrand *integrand, ps_integrand_points *out,
                                      ps_error *error) {
    *out = (ps_integrand_points){0};
    const pspec_status status = integrand->kind->points(integrand, out, error);
    if (status != PSPEC_OK) {
        ps_integrand_points_free(out);
    }
    return status;
}

void ps_integrand_points_free(ps_integrand_points *points) {
    free(points->points);
    free(points->weights);
    *points = (ps_integrand_points){0};
}

void ps_integrand_factors(const ps_integrand *integrand, const int32_t *vectors, size_t num,
                          double *factors) {
    integrand->kind->factors(integrand, vectors, num, factors);
}

pspec_status ps_integrand_degrees(const ps_integrand *integrand, size_t max_degree, double *powers,
                                  ps_error *error) {
    return integrand->kind->zonal != NULL
               ? ps_integrand_zonal_degrees(integrand, max_degree, powers, error)
               : integrand->kind->degrees(integrand, max_degree, powers, error);
}

pspec_status ps_integrand_harmonics(const ps_integrand *integrand, size_t max_degree, double *out,
                                    ps_error *error) {
    return integrand->kind->zonal != NULL
               ? ps_integrand_zonal_coefficients(integrand, max_degree, out, error)
               : integrand->kind->coefficients(integrand, max_degree, out, error);
}

void ps_integrand_values(const ps_integrand *integrand, const double *points, size_t num,
                         double *values) {
    integrand->kind->values(integrand, points, num, values);
}

const ps_error *ps_integrand_failure(const ps_integrand *integrand) {
    return integrand->kind->failure != NULL ? integrand->kind->failure(integrand) : NULL;
}

bool ps_integrand_is_isotropic(const ps_integrand *integrand) {
    return integrand->place.where != PS_SAMPLES_TORUS ||
           (integrand->kind->is_isotropic != NULL && integrand->kind->is_isotropic(integrand));
}

double ps_integrand_reach(const ps_integrand *integrand) {
    return integrand->kind->reach != NULL ? integrand->kind->reach(integrand) : INFINITY;
}

bool ps_integrand_is_radial(const ps_integrand *integrand) {
    return integrand->kind->radial != NULL && ps_integrand_is_isotropic(integrand);
}

double ps_integrand_radial(const ps_integrand *integrand, double k) {
    return integrand->kind->radial(integrand, k);
}

double ps_integrand_whole_square(const ps_integrand *integrand) {
    return integrand->kind->whole_square(integrand);
}

double ps_integrand_steps(const ps_integrand *integrand) {
    return integrand->kind->steps != NULL ? integrand->kind->steps(integrand) : 0;
}

bool ps_integrand_image_size(const ps_integrand *integrand, size_t *width, size_t *height) {
    if (integrand->kind->image_size == NULL) {
        return false;
    }
    integrand->kind->image_size(integrand, width, height);
    return true;
}

const char *ps_integrand_note(const ps_integrand *integrand) {
    return integrand->kind->note != NULL ? integrand->kind->note(integrand) : NULL;
}
