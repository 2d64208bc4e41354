/* Morphs as samplers and --morph name them. */
#include "samplers/morph_words.h"

#include "base/text.h"
#include "files/decimal.h"
#include "samplers/sampler.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    ps_morph_kind kind;
    bool has_exponent;
} morphs[] = {{PS_MORPH_DEFAULT, PS_MORPH_NONE, false},
              {"diffuse", PS_MORPH_DIFFUSE, false},
              {"glossy", PS_MORPH_GLOSSY, true},
              {"phong", PS_MORPH_PHONG, true}};
enum { NUM_MORPHS = sizeof morphs / sizeof morphs[0] };

static bool is_word(ps_slice slice, const char *word) {
    return slice.length == strlen(word) && strncmp(slice.text, word, slice.length) == 0;
}

static pspec_status find_morph(const ps_morph_words *words, size_t *i, ps_error *error) {
    for (*i = 0; words->kind.text != NULL && *i < NUM_MORPHS; (*i)++) {
        if (is_word(words->kind, morphs[*i].name)) {
            break;
        }
    }
    return *i < NUM_MORPHS
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s %s: " PS_MORPH_KEY "=%.*s is not one of none, diffuse, glossy, phong",
                         words->whose, words->name, (int)words->kind.length, words->kind.text);
}

pspec_status ps_morph_parse(ps_morph *out, const ps_morph_words *words, ps_error *error) {
    char text[PS_MAX_SAMPLER_VALUE];
    size_t i = 0;
    PS_TRY(find_morph(words, &i, error));
    *out = (ps_morph){morphs[i].kind, 0};
    if (morphs[i].has_exponent != (words->exponent.text != NULL)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s %s: %s", words->whose, words->name,
                       morphs[i].has_exponent ? "this " PS_MORPH_KEY "= needs " PS_EXPONENT_KEY
                                                "=, the exponent of its lobe"
                                              : PS_EXPONENT_KEY "= is the exponent of " PS_MORPH_KEY
                                                                "=glossy and " PS_MORPH_KEY
                                                                "=phong alone");
    }
    if (!morphs[i].has_exponent) {
        return PSPEC_OK;
    }
    ps_slice_copy(text, words->exponent);
    return ps_parse_number(text, "exponent " PS_EXPONENT_KEY " of the lobe", PS_LEAST_EXPONENT,
                           PS_MOST_EXPONENT, &out->exponent, error);
}

ps_morph_text ps_morph_write(const ps_morph *morph) {
    ps_morph_text out;
    snprintf(out.text, sizeof out.text, "%s",
             morph->kind == PS_MORPH_GLOSSY_SPHERE ? "glossy, sphere" : "");
    for (size_t i = 0; i < NUM_MORPHS; i++) {
        if (morphs[i].kind == morph->kind && morphs[i].has_exponent) {
            char number[PS_DECIMAL_BYTES];
            ps_decimal_format(number, morph->exponent);
            snprintf(out.text, sizeof out.text, "%s," PS_EXPONENT_KEY "=%s", morphs[i].name,
                     number);
        } else if (morphs[i].kind == morph->kind) {
            snprintf(out.text, sizeof out.text, "%s", morphs[i].name);
        }
    }
    return out;
}
