/* "NAME[:key=value,...]" -> sampler and values. */
#include "samplers/sampler.h"

#include "base/text.h"

#include <string.h>

enum { MAXIMUM_WORD = 64 }; /* bytes of a name or key with its NUL: no known one has half as many */

/* Copies the first length bytes of text, cut to what fits. A cut word is unknown anyway. */
static void copy_word(char word[MAXIMUM_WORD], const char *text, size_t length) {
    const size_t kept = length < MAXIMUM_WORD ? length : MAXIMUM_WORD - 1;
    memcpy(word, text, kept);
    word[kept] = '\0';
}

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

static pspec_status find_sampler(ps_sampler_request *request, const char *text, size_t length,
                                 ps_error *error) {
    char name[MAXIMUM_WORD];
    size_t distance = 0;
    const char *nearest_name = NULL;
    copy_word(name, text, length);
    request->sampler = nearest_sampler(name, &distance, &nearest_name);
    if (distance > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "unknown sampler \"%s\"; did you mean %s?", name, nearest_name);
    }
    return PSPEC_OK;
}

static void set_defaults(ps_sampler_request *request) {
    request->lift = PS_SAMPLES_TORUS;
    memset(request->values, 0, sizeof request->values);
    for (unsigned i = 0; request->sampler->parameters[i].key != NULL; i++) {
        copy_word(request->values[i], request->sampler->parameters[i].default_value,
                  strlen(request->sampler->parameters[i].default_value));
    }
}

/* ---- keys and values ------------------------------------------------------------------------- */

/* The number of the parameter lift, behind those of any sampler. */
enum { LIFT = PS_MAX_SAMPLER_PARAMETERS, NUM_KEYS };

static bool can_be_lifted(const ps_sampler *sampler) {
    return sampler->domain == PS_SAMPLES_TORUS;
}

static pspec_status fail_key(const ps_sampler *sampler, const char *key, ps_error *error) {
    if (strcmp(key, PS_LIFT_KEY) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s makes points of the sphere without " PS_LIFT_KEY
                       "=, which is for samplers of the torus",
                       sampler->name);
    }
    if (sampler->parameters[0].key == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s has no parameters%s, but \"%s\" was given", sampler->name,
                       can_be_lifted(sampler) ? " except " PS_LIFT_KEY : "", key);
    }
    const char *nearest = can_be_lifted(sampler) ? PS_LIFT_KEY : sampler->parameters[0].key;
    for (unsigned i = 0; sampler->parameters[i].key != NULL; i++) {
        const char *candidate = sampler->parameters[i].key;
        if (ps_text_distance(key, candidate) < ps_text_distance(key, nearest)) {
            nearest = candidate;
        }
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s has no parameter \"%s\"; did you mean %s?", sampler->name, key,
                   nearest);
}

static pspec_status find_key(const ps_sampler *sampler, const char *key, unsigned *i_parameter,
                             ps_error *error) {
    for (unsigned i = 0; sampler->parameters[i].key != NULL; i++) {
        if (strcmp(sampler->parameters[i].key, key) == 0) {
            *i_parameter = i;
            return PSPEC_OK;
        }
    }
    *i_parameter = LIFT;
    return can_be_lifted(sampler) && strcmp(key, PS_LIFT_KEY) == 0 ? PSPEC_OK
                                                                   : fail_key(sampler, key, error);
}

static pspec_status set_lift(ps_sampler_request *request, const char *value, ps_error *error) {
    static const char *const names[] = {[PS_SAMPLES_TORUS] = PS_LIFT_DEFAULT,
                                        [PS_SAMPLES_SPHERE] = "sphere",
                                        [PS_SAMPLES_HEMISPHERE] = "hemisphere"};
    for (int i = PS_SAMPLES_TORUS; i <= PS_SAMPLES_HEMISPHERE; i++) {
        if (strcmp(names[i], value) == 0) {
            request->lift = (ps_sampler_domain)i;
            return PSPEC_OK;
        }
    }
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "sampler %s: " PS_LIFT_KEY "=%s is not one of %s, %s, %s",
                   request->sampler->name, value, names[0], names[1], names[2]);
}

static const char *meaning_of(const ps_sampler *sampler, unsigned i_parameter) {
    return i_parameter == LIFT ? PS_LIFT_MEANING : sampler->parameters[i_parameter].meaning;
}

static pspec_status check_value(const ps_sampler *sampler, const char *key, unsigned i_parameter,
                                size_t length, ps_error *error) {
    if (length == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sampler %s: %s has no value (%s=%s)",
                       sampler->name, key, key, meaning_of(sampler, i_parameter));
    }
    if (length >= PS_MAX_SAMPLER_VALUE) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler %s: the value of %s has %zu characters, more than %d",
                       sampler->name, key, length, PS_MAX_SAMPLER_VALUE - 1);
    }
    return PSPEC_OK;
}

/* One "key=value" of the given length; is_given notes which keys have been seen. */
static pspec_status set_value(ps_sampler_request *request, const char *text, size_t length,
                              bool is_given[NUM_KEYS], ps_error *error) {
    char key[MAXIMUM_WORD];
    char value[PS_MAX_SAMPLER_VALUE];
    unsigned i_parameter = 0;
    const char *equals = memchr(text, '=', length);
    const size_t key_length = equals != NULL ? (size_t)(equals - text) : length;
    const size_t value_length = equals != NULL ? length - key_length - 1 : 0;
    copy_word(key, text, key_length);
    PS_TRY(find_key(request->sampler, key, &i_parameter, error));
    PS_TRY(check_value(request->sampler, key, i_parameter, value_length, error));
    if (is_given[i_parameter]) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "sampler %s: %s is given twice",
                       request->sampler->name, key);
    }
    is_given[i_parameter] = true;
    copy_word(value, equals + 1, value_length);
    if (i_parameter == LIFT) {
        return set_lift(request, value, error);
    }
    memcpy(request->values[i_parameter], value, value_length + 1);
    return PSPEC_OK;
}

pspec_status ps_sampler_parse(ps_sampler_request *request, const char *text, ps_error *error) {
    bool is_given[NUM_KEYS] = {false};
    const size_t name_length = strcspn(text, ":");
    PS_TRY(find_sampler(request, text, name_length, error));
    set_defaults(request);
    const char *rest = text + name_length;
    while (*rest != '\0') { /* at the colon, later at a comma */
        rest++;
        const size_t length = strcspn(rest, ",");
        PS_TRY(set_value(request, rest, length, is_given, error));
        rest += length;
    }
    return PSPEC_OK;
}
