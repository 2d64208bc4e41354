#include "integrands/brdf_kind.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* In the order of the help text. A new lobe is a file and a row here. */
const ps_brdf_kind *const ps_brdf_kinds[] = {&ps_brdf_diffuse, &ps_brdf_glossy, &ps_brdf_phong,
                                             &ps_brdf_zonal, NULL};

/* ---- parsing ------------------------------------------------------------------------------- */

static pspec_status find_kind(const ps_brdf_kind **kind, const char *name, ps_error *error) {
    size_t best = SIZE_MAX;
    for (size_t i = 0; ps_brdf_kinds[i] != NULL; i++) {
        const size_t distance = ps_text_distance(name, ps_brdf_kinds[i]->name);
        if (distance < best) {
            best = distance;
            *kind = ps_brdf_kinds[i];
        }
    }
    return best == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown BRDF \"%s\"%s", name,
                         ps_text_suggest(name, (*kind)->name, best, "; did you mean ", "?").text);
}

pspec_status ps_brdf_make(ps_brdf **out, const ps_brdf_kind *kind, const char *const *values,
                          ps_error *error) {
    ps_brdf *brdf = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&brdf, 1, "a BRDF", error));
    brdf->kind = kind;
    const pspec_status status = kind->create != NULL ? kind->create(brdf, values, error) : PSPEC_OK;
    if (status != PSPEC_OK) {
        ps_brdf_destroy(brdf);
        return status;
    }
    *out = brdf;
    return PSPEC_OK;
}

pspec_status ps_brdf_parse(ps_brdf **out, const char *text, ps_error *error) {
    char name[PS_GRAMMAR_WORD];
    const ps_brdf_kind *kind = NULL;
    *out = NULL;
    const char *const rest = ps_grammar_name(text, name);
    PS_TRY(find_kind(&kind, name, error));
    char **texts = NULL;
    PS_TRY(ps_grammar_texts(&texts, "BRDF", kind->name, kind->parameters, rest, error));
    const pspec_status status = ps_brdf_make(out, kind, (const char *const *)texts, error);
    free(texts);
    return status;
}

void ps_brdf_destroy(ps_brdf *brdf) {
    if (brdf != NULL) {
        free(brdf->nodes);
        free(brdf->values);
        free(brdf->path);
        free(brdf->densities);
        free(brdf);
    }
}

/* ---- what lobes tell ----------------------------------------------------------------------- */

double ps_brdf_norm(const ps_brdf *brdf) {
    return brdf->kind->norm(brdf);
}

double ps_brdf_energy(const ps_brdf *brdf) {
    return brdf->kind->energy(brdf);
}

double ps_brdf_density(const ps_brdf *brdf, double z) {
    return brdf->kind->density(brdf, z) / (PS_TWO_PI * brdf->kind->norm(brdf));
}

pspec_status ps_brdf_spherical(const ps_brdf *brdf, size_t max_degree, double *b, ps_error *error) {
    return brdf->kind->spherical(brdf, max_degree, b, error);
}

pspec_status ps_brdf_hemispherical(const ps_brdf *brdf, size_t max_degree, double *b,
                                   ps_error *error) {
    if (ps_brdf_is_below_horizon(brdf)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "this BRDF %s goes below the horizon, where hemispherical harmonics are not "
                       "defined; use spherical ones",
                       brdf->kind->name);
    }
    return brdf->kind->hemispherical(brdf, max_degree, b, error);
}

bool ps_brdf_is_below_horizon(const ps_brdf *brdf) {
    return brdf->kind->is_below != NULL && brdf->kind->is_below(brdf);
}

bool ps_brdf_mean_distance(const ps_brdf *brdf, double smoothness, double *d_0) {
    if (brdf->kind->mean_distance == NULL) {
        return false;
    }
    *d_0 = brdf->kind->mean_distance(brdf, smoothness);
    return true;
}

ps_morph ps_brdf_morph(const ps_brdf *brdf) {
    return brdf->kind->morph != NULL ? brdf->kind->morph(brdf) : (ps_morph){PS_MORPH_NONE, 0};
}

const char *ps_brdf_note(const ps_brdf *brdf) {
    return brdf->kind->note != NULL ? brdf->kind->note(brdf) : NULL;
}
