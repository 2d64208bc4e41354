#include "base/memory.h"
#include "integrands/integrand.h"

#include <stdlib.h>
#include <string.h>

typedef struct ps_made_integrand {
    const char *text;
    ps_integrand *integrand;
} ps_made_integrand;

static ps_integrand *find(const ps_made_integrands *made, const char *text,
                          ps_integrand_place place, uint64_t most_bytes) {
    for (size_t i = 0; i < made->num; i++) {
        const ps_made_integrand *const one = &made->all[i];
        const ps_integrand_place own = one->integrand->place;
        if (strcmp(one->text, text) == 0 && own.where == place.where &&
            own.dimension == place.dimension && one->integrand->most_bytes == most_bytes) {
            return one->integrand;
        }
    }
    return NULL;
}

pspec_status ps_integrand_take(ps_integrand **out, ps_made_integrands *made,
                               const ps_given_integrands *list, const char *text,
                               ps_integrand_place place, uint64_t most_bytes, ps_error *error) {
    void *all = made->all;
    *out = find(made, text, place, most_bytes);
    if (*out != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_grow(&all, &made->capacity, made->num + 1, sizeof *made->all, "integrands", error));
    made->all = all;
    PS_TRY(ps_integrand_make(out, list, text, place, most_bytes, error));
    made->all[made->num++] = (ps_made_integrand){text, *out};
    return PSPEC_OK;
}

void ps_made_integrands_free(ps_made_integrands *made) {
    for (size_t i = 0; i < made->num; i++) {
        ps_integrand_destroy(made->all[i].integrand);
    }
    free(made->all);
    *made = (ps_made_integrands){0};
}
