#include "base/grammar.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdint.h>
#include <string.h>

static void copy_word(char word[PS_GRAMMAR_WORD], const char *text, size_t length) {
    const size_t kept = length < PS_GRAMMAR_WORD ? length : PS_GRAMMAR_WORD - 1;
    memcpy(word, text, kept);
    word[kept] = '\0';
}

const char *ps_grammar_name(const char *text, char name[PS_GRAMMAR_WORD]) {
    const size_t length = strcspn(text, ":");
    copy_word(name, text, length);
    return text + length;
}

void ps_slice_copy(char *text, ps_slice slice) {
    memcpy(text, slice.text, slice.length);
    text[slice.length] = '\0';
}

/* "a, b, c": the keys from the given one on. */
static void list_keys(ps_text *list, const ps_grammar *grammar, size_t first) {
    for (size_t i = first; grammar->parameters[i] != NULL; i++) {
        ps_text_append(list, "%s%s", i > first ? ", " : "", grammar->parameters[i]->key);
    }
}

static pspec_status fail_without_own(const ps_grammar *grammar, const char *key, ps_error *error) {
    ps_text shared = {0};
    list_keys(&shared, grammar, 0);
    const pspec_status status =
        ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                "%s %s has no parameters%s%s, but \"%s\" was given", grammar->kind, grammar->name,
                shared.length > 0 ? " except " : "", ps_text_string(&shared), key);
    ps_text_free(&shared);
    return status;
}

static pspec_status fail_key(const ps_grammar *grammar, const char *key, ps_error *error) {
    for (const ps_parameter *other = grammar->others; other != NULL && other->key != NULL;
         other++) {
        if (strcmp(other->key, key) == 0) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s %s %s", grammar->kind,
                           grammar->name, other->meaning);
        }
    }
    if (grammar->num_own == 0) {
        return fail_without_own(grammar, key, error);
    }
    const char *nearest = grammar->parameters[0]->key;
    for (size_t i = 1; grammar->parameters[i] != NULL; i++) {
        const char *const candidate = grammar->parameters[i]->key;
        if (ps_text_distance(key, candidate) < ps_text_distance(key, nearest)) {
            nearest = candidate;
        }
    }
    return ps_fail(
        error, PSPEC_ERROR_INVALID_ARGUMENT, "%s %s has no parameter \"%s\"%s", grammar->kind,
        grammar->name, key,
        ps_text_suggest(key, nearest, ps_text_distance(key, nearest), "; did you mean ", "?").text);
}

static pspec_status find_key(const ps_grammar *grammar, const char *key, size_t *i_parameter,
                             ps_error *error) {
    for (size_t i = 0; grammar->parameters[i] != NULL; i++) {
        if (strcmp(grammar->parameters[i]->key, key) == 0) {
            *i_parameter = i;
            return PSPEC_OK;
        }
    }
    return fail_key(grammar, key, error);
}

static pspec_status check_value(const ps_grammar *grammar, const ps_parameter *parameter,
                                size_t length, ps_error *error) {
    if (length == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s %s: %s has no value (%s=%s)",
                       grammar->kind, grammar->name, parameter->key, parameter->key,
                       parameter->meaning);
    }
    if (length > grammar->most_letters) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s %s: the value of %s has %zu characters, more than %zu", grammar->kind,
                       grammar->name, parameter->key, length, grammar->most_letters);
    }
    return PSPEC_OK;
}

/* One "key=value" of the given length. */
static pspec_status set_value(const ps_grammar *grammar, const char *text, size_t length,
                              ps_slice *values, ps_error *error) {
    char key[PS_GRAMMAR_WORD];
    size_t i = 0;
    const char *const equals = memchr(text, '=', length);
    const size_t key_length = equals != NULL ? (size_t)(equals - text) : length;
    const size_t value_length = equals != NULL ? length - key_length - 1 : 0;
    copy_word(key, text, key_length);
    PS_TRY(find_key(grammar, key, &i, error));
    PS_TRY(check_value(grammar, grammar->parameters[i], value_length, error));
    if (values[i].text != NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s %s: %s is given twice",
                       grammar->kind, grammar->name, key);
    }
    values[i] = (ps_slice){equals + 1, value_length};
    return PSPEC_OK;
}

pspec_status ps_grammar_values(const ps_grammar *grammar, const char *rest, ps_slice *values,
                               ps_error *error) {
    for (size_t i = 0; grammar->parameters[i] != NULL; i++) {
        values[i] = (ps_slice){NULL, 0};
    }
    while (*rest != '\0') { /* at the colon, later at a comma */
        rest++;
        const size_t length = strcspn(rest, ",");
        PS_TRY(set_value(grammar, rest, length, values, error));
        rest += length;
    }
    return PSPEC_OK;
}

/* [num] pointers and then the letters of the values. */
static pspec_status copy_values(char ***out, const ps_parameter *const *parameters, size_t num,
                                const ps_slice *values, ps_error *error) {
    size_t num_bytes = num * sizeof(char *) + 1;
    for (size_t i = 0; i < num; i++) {
        num_bytes += values[i].length + strlen(parameters[i]->default_value) + 1;
    }
    char **texts = NULL;
    PS_TRY(ps_allocate_for(&texts, num_bytes, 1, "parameters", error));
    char *letters = (char *)(texts + num);
    for (size_t i = 0; i < num; i++) {
        const char *const preset = parameters[i]->default_value;
        ps_slice_copy(letters,
                      values[i].text != NULL ? values[i] : (ps_slice){preset, strlen(preset)});
        texts[i] = letters;
        letters += strlen(letters) + 1;
    }
    *out = texts;
    return PSPEC_OK;
}

pspec_status ps_grammar_texts(char ***texts, const char *kind, const char *name,
                              const ps_parameter *own, const char *rest, ps_error *error) {
    enum { MOST_LETTERS = 4095 }; /* of a value: a path */
    const ps_parameter *parameters[PS_MOST_OWN_PARAMETERS + 1] = {NULL};
    ps_slice values[PS_MOST_OWN_PARAMETERS];
    size_t num = 0;
    *texts = NULL;
    while (own[num].key != NULL) {
        parameters[num] = &own[num];
        num++;
    }
    const ps_grammar grammar = {.kind = kind,
                                .name = name,
                                .parameters = parameters,
                                .num_own = num,
                                .most_letters = MOST_LETTERS};
    PS_TRY(ps_grammar_values(&grammar, rest, values, error));
    return copy_values(texts, parameters, num, values, error);
}
