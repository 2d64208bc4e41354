#include "integrands/lobes/brdf.h"

#include "base/text.h"
#include "integrands/lobes/lobe.h"

#include <stdint.h>
#include <stdlib.h>

/* The nearest name is found, and suggested where it is another. */
static pspec_status find_kind(const ps_integrand_kind **kind, const char *name, ps_error *error) {
    size_t best = SIZE_MAX;
    for (size_t i = 0; ps_integrand_kinds[i] != NULL; i++) {
        const size_t distance = ps_text_distance(name, ps_integrand_kinds[i]->name);
        if (ps_integrand_kinds[i]->lobe != NULL && distance < best) {
            best = distance;
            *kind = ps_integrand_kinds[i];
        }
    }
    return best == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown BRDF \"%s\"%s", name,
                         ps_text_suggest(name, (*kind)->name, best, "; did you mean ", "?").text);
}

pspec_status ps_brdf_parse(ps_brdf **out, const char *text, ps_error *error) {
    char name[PS_GRAMMAR_WORD];
    const ps_integrand_kind *kind = NULL;
    *out = NULL;
    const char *const rest = ps_grammar_name(text, name);
    PS_TRY(find_kind(&kind, name, error));
    char **texts = NULL;
    PS_TRY(ps_grammar_texts(&texts, "BRDF", kind->name, kind->parameters, rest, error));
    const pspec_status status = ps_brdf_make(out, kind, (const char *const *)texts, error);
    free(texts);
    return status;
}
