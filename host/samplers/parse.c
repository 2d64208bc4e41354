/* "NAME[:key=value,...]" -> sampler and values. */
#include "samplers/sampler.h"

#include "base/text.h"
#include "samplers/morph_words.h"

#include <string.h>

/* The sampler with a name or alias nearest to name; *distance is 0 when it is that very name. */
static const ps_sampler *nearest_sampler(const char *name, size_t *distance,
                                         const char **nearest_name) {
    const ps_sampler *nearest = NULL;
    *distance = SIZE_MAX;
    for (unsigned i = 0; ps_samplers[i] != NULL; i++) {
        const char *candidate = ps_samplers[i]->name;
        for (unsigned i_alias = 0; candidate != NULL;) {
            const size_t new_distance = ps_text_distance(name, candidate);
            if (new_distance < *distance) {
                *distance = new_distance;
                *nearest_name = candidate;
                nearest = ps_samplers[i];
            }
            candidate = ps_samplers[i]->aliases[i_alias++];
        }
    }
    return nearest;
}

void ps_sampler_names(ps_text *names) {
    for (size_t i = 0; ps_samplers[i] != NULL; i++) {
        ps_text_append(names, "%s%s", i > 0 ? ", " : "", ps_samplers[i]->name);
    }
}

static pspec_status find_sampler(ps_sampler_request *request, const char *name, ps_error *error) {
    size_t distance = 0;
    const char *nearest_name = NULL;
    request->sampler = nearest_sampler(name, &distance, &nearest_name);
    if (distance == 0) {
        return PSPEC_OK;
    }
    const ps_suggestion suggestion =
        ps_text_suggest(name, nearest_name, distance, "; did you mean ", "?");
    ps_text names = {0};
    ps_sampler_names(&names);
    const pspec_status status = ps_fail(
        error, PSPEC_ERROR_INVALID_ARGUMENT, "unknown sampler \"%s\"%s%s %s", name, suggestion.text,
        suggestion.text[0] != '\0' ? " There are" : "; there are", ps_text_string(&names));
    ps_text_free(&names);
    return status;
}

/* ---- the parameters of many samplers ------------------------------------------------------- */

enum { LIFT = 0, MORPH, EXPONENT, NUM_SHARED };

static const ps_parameter shared[NUM_SHARED] = {
    [LIFT] = {PS_LIFT_KEY, PS_LIFT_DEFAULT, PS_LIFT_MEANING},
    [MORPH] = {PS_MORPH_KEY, PS_MORPH_DEFAULT, PS_MORPH_MEANING},
    [EXPONENT] = {PS_EXPONENT_KEY, "", PS_EXPONENT_MEANING},
};

static const ps_parameter not_of_hemisphere[] = {{PS_LIFT_KEY, "",
                                                  "makes points of the sphere without " PS_LIFT_KEY
                                                  "=, which is for samplers of the torus"},
                                                 {NULL, NULL, NULL}};

static const ps_parameter not_of_sphere[] = {
    {PS_LIFT_KEY, "",
     "makes points of the sphere without " PS_LIFT_KEY "=, which is for samplers of the torus"},
    {PS_MORPH_KEY, "", "makes points of the whole sphere; " PS_MORPH_KEY "= is for the hemisphere"},
    {PS_EXPONENT_KEY, "", "has no lobe: " PS_EXPONENT_KEY "= belongs to " PS_MORPH_KEY "="},
    {NULL, NULL, NULL}};

/* Own parameters of the sampler, then those of all of its domain, with their numbers in shared. */
typedef struct known_keys {
    const ps_parameter *parameters[PS_MAX_SAMPLER_PARAMETERS + NUM_SHARED + 1];
    size_t num_own, first_shared; /* first_shared: the number of parameters[num_own] in shared */
} known_keys;

static known_keys list_keys(const ps_sampler *sampler) {
    known_keys known = {.first_shared = sampler->domain == PS_SAMPLES_TORUS        ? LIFT
                                        : sampler->domain == PS_SAMPLES_HEMISPHERE ? MORPH
                                                                                   : NUM_SHARED};
    size_t num = 0;
    while (sampler->parameters[num].key != NULL) {
        known.parameters[num] = &sampler->parameters[num];
        num++;
    }
    known.num_own = num;
    for (size_t i = known.first_shared; i < NUM_SHARED; i++) {
        known.parameters[num++] = &shared[i];
    }
    return known;
}

static pspec_status choose(const ps_sampler *sampler, const ps_parameter *parameter,
                           const char *const *names, ps_slice value, unsigned *choice,
                           ps_error *error) {
    char word[PS_MAX_SAMPLER_VALUE];
    ps_text list = {0};
    ps_slice_copy(word, value);
    for (unsigned i = 0; names[i] != NULL; i++) {
        if (strcmp(names[i], word) == 0) {
            *choice = i;
            ps_text_free(&list);
            return PSPEC_OK;
        }
        ps_text_append(&list, "%s%s", i > 0 ? ", " : "", names[i]);
    }
    const pspec_status status =
        ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sampler %s: %s=%s is not one of %s",
                sampler->name, parameter->key, word, ps_text_string(&list));
    ps_text_free(&list);
    return status;
}

static pspec_status set_lift(ps_sampler_request *request, ps_slice value, ps_error *error) {
    static const char *const names[] = {[PS_SAMPLES_TORUS] = PS_LIFT_DEFAULT,
                                        [PS_SAMPLES_SPHERE] = "sphere",
                                        [PS_SAMPLES_HEMISPHERE] = "hemisphere",
                                        NULL};
    unsigned choice = PS_SAMPLES_TORUS;
    if (value.text != NULL) {
        PS_TRY(choose(request->sampler, &shared[LIFT], names, value, &choice, error));
    }
    request->lift = (ps_sampler_domain)choice;
    return PSPEC_OK;
}

static pspec_status set_morph(ps_sampler_request *request, ps_slice value, ps_slice exponent,
                              ps_error *error) {
    const ps_morph_words words = {"sampler", request->sampler->name, value, exponent};
    PS_TRY(ps_morph_parse(&request->morph, &words, error));
    request->has_morph = value.text != NULL;
    return request->morph.kind == PS_MORPH_NONE || ps_sampler_is_on_hemisphere(request)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "sampler %s: " PS_MORPH_KEY
                         "=%s is for points of the hemisphere; add " PS_LIFT_KEY "=hemisphere",
                         request->sampler->name, ps_morph_write(&request->morph).text);
}

/* values: of the keys that the sampler knows. */
static pspec_status set_shared(ps_sampler_request *request, const known_keys *known,
                               const ps_slice *values, ps_error *error) {
    ps_slice all[NUM_SHARED] = {{NULL, 0}};
    for (size_t i = known->first_shared; i < NUM_SHARED; i++) {
        all[i] = values[known->num_own + i - known->first_shared];
    }
    PS_TRY(set_lift(request, all[LIFT], error));
    return set_morph(request, all[MORPH], all[EXPONENT], error);
}

pspec_status ps_sampler_parse(ps_sampler_request *request, const char *text, ps_error *error) {
    char name[PS_GRAMMAR_WORD];
    ps_slice values[PS_MAX_SAMPLER_PARAMETERS + NUM_SHARED];
    const char *const rest = ps_grammar_name(text, name);
    PS_TRY(find_sampler(request, name, error));
    const known_keys known = list_keys(request->sampler);
    const bool is_of_sphere = request->sampler->domain == PS_SAMPLES_SPHERE;
    const bool is_of_torus = request->sampler->domain == PS_SAMPLES_TORUS;
    const ps_grammar grammar = {.kind = "sampler",
                                .name = request->sampler->name,
                                .parameters = known.parameters,
                                .num_own = known.num_own,
                                .others = is_of_torus    ? NULL
                                          : is_of_sphere ? not_of_sphere
                                                         : not_of_hemisphere,
                                .most_letters = PS_MAX_SAMPLER_VALUE - 1};
    PS_TRY(ps_grammar_values(&grammar, rest, values, error));
    memset(request->values, 0, sizeof request->values);
    for (size_t i = 0; i < known.num_own; i++) {
        const char *const preset = known.parameters[i]->default_value;
        ps_slice_copy(request->values[i],
                      values[i].text != NULL ? values[i] : (ps_slice){preset, strlen(preset)});
    }
    return set_shared(request, &known, values, error);
}
