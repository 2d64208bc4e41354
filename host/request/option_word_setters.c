/* Setters of options whose values are words, or numbers between commas and dots. */
#include "request/option_setters.h"

#include "base/text.h"
#include "samplers/morph_words.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- values that are one of a few words ---------------------------------------------------- */

static pspec_status fail_word(const ps_said *said, ps_error *error) {
    ps_text list = {0};
    for (const char *word = said->words; *word != '\0';) {
        const size_t length = strcspn(word, "|");
        ps_text_append(&list, "%s%.*s", word == said->words ? "" : ", ", (int)length, word);
        word += length + (word[length] == '|');
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%s\" is not one of %s", said->shown,
            said->text, ps_text_string(&list));
    ps_text_free(&list);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

/* Number of the value among the words, "one|two|three". */
static pspec_status find_word(const ps_said *said, int *index, ps_error *error) {
    *index = ps_text_find_word(said->text, strlen(said->text), said->words);
    return *index >= 0 ? PSPEC_OK : fail_word(said, error);
}

pspec_status ps_set_word(const ps_said *said, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    return ps_set_text(said, error);
}

ps_weights_kind ps_weights_find(const char *words, const char *value) {
    static const char *const names[] = {[PS_WEIGHTS_EQUAL] = "equal",
                                        [PS_WEIGHTS_COLUMN] = "column",
                                        [PS_WEIGHTS_OPTIMAL] = "optimal"};
    for (size_t kind = 0; kind < sizeof names / sizeof names[0]; kind++) {
        if (names[kind] != NULL && strcmp(value, names[kind]) == 0 &&
            strstr(words, names[kind]) != NULL) {
            return (ps_weights_kind)kind;
        }
    }
    return strstr(words, "FILE") != NULL ? PS_WEIGHTS_FILE : PS_WEIGHTS_GIVEN;
}

/* ---- where the name of a file stands in a value ---------------------------------------------- */

const char *ps_input_all(const char *words, const char *value) {
    (void)words;
    return value;
}

const char *ps_input_of_weights(const char *words, const char *value) {
    return ps_weights_find(words, value) == PS_WEIGHTS_FILE ? value : NULL;
}

const char *ps_input_of_named(const char *words, const char *value) {
    static const char key[] = "file=";
    const char *const found = strstr(value, key);
    (void)words;
    return found != NULL ? found + strlen(key) : NULL;
}

/* ---- settings -------------------------------------------------------------------------------- */

pspec_status ps_set_weights(const ps_said *said, ps_error *error) {
    const ps_weights_kind kind = ps_weights_find(said->words, said->text);
    if (kind == PS_WEIGHTS_GIVEN) {
        return fail_word(said, error);
    }
    said->request->weights.kind = kind;
    said->request->weights.path = kind == PS_WEIGHTS_FILE ? said->text : NULL;
    said->request->reading.weight_column = kind == PS_WEIGHTS_COLUMN;
    said->request->reading.ignore_weights = kind != PS_WEIGHTS_COLUMN; /* others replace them */
    return PSPEC_OK;
}

pspec_status ps_set_weight_sum(const ps_said *said, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->weights.sum_to_one = index == 1;
    return PSPEC_OK;
}

/* The words stand in the order of bits: x, y, both, none. */
pspec_status ps_set_plot_log(const ps_said *said, ps_error *error) {
    enum { X = 0, Y = 1, BOTH = 2 };
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->plot_axes.has_log = true;
    said->request->plot_axes.is_log_x = index == X || index == BOTH;
    said->request->plot_axes.is_log_y = index == Y || index == BOTH;
    return PSPEC_OK;
}

/* "0..2", or nothing: a part of what was said. */
static pspec_status set_interval(const ps_said *said, const char *text, size_t length,
                                 bool *is_there, double ends[2], ps_error *error) {
    enum { TEXT_BYTES = 96 };
    static const char dots[] = "..";
    char own[TEXT_BYTES];
    snprintf(own, sizeof own, "%.*s", (int)(length < sizeof own ? length : sizeof own - 1), text);
    char *const middle = strstr(own, dots);
    *is_there = length > 0;
    if (length == 0) {
        return PSPEC_OK;
    }
    if (middle == NULL || length >= sizeof own) {
        return fail_word(said, error);
    }
    *middle = '\0';
    PS_TRY(ps_parse_number(own, said->shown, -DBL_MAX, DBL_MAX, &ends[0], error));
    PS_TRY(
        ps_parse_number(middle + sizeof dots - 1, said->shown, -DBL_MAX, DBL_MAX, &ends[1], error));
    return ends[0] < ends[1] ? PSPEC_OK
                             : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                                       "%s: %s is no interval: it must end above its beginning",
                                       said->shown, text);
}

pspec_status ps_set_plot_range(const ps_said *said, ps_error *error) {
    ps_plot_axes *const axes = &said->request->plot_axes;
    const size_t length = strcspn(said->text, ",");
    const char *const second = said->text + length + (said->text[length] == ',');
    if (length == 0 && *second == '\0') {
        return fail_word(said, error);
    }
    PS_TRY(set_interval(said, said->text, length, &axes->has_x, axes->x, error));
    return set_interval(said, second, strlen(second), &axes->has_y, axes->y, error);
}

pspec_status ps_set_rates(const ps_said *said, ps_error *error) {
    ps_request *const request = said->request;
    bool is_there = false;
    request->wants_rates = true;
    request->rates[0] = 0;
    request->rates[1] = INFINITY;
    return strcmp(said->text, "auto") == 0 ? PSPEC_OK
                                           : set_interval(said, said->text, strlen(said->text),
                                                          &is_there, request->rates, error);
}

/* "G" or "G,A,B", B a number or inf: a step. */
static pspec_status parse_bound(ps_bound *out, const ps_said *said, const char *text, size_t length,
                                ps_error *error) {
    enum { TEXT_BYTES = 96 };
    char own[TEXT_BYTES];
    double numbers[3] = {0, 0, 0};
    size_t num = 0;
    snprintf(own, sizeof own, "%.*s", (int)(length < sizeof own ? length : 0), text);
    for (char *at = own; at != NULL && num < 3; num++) {
        char *const comma = strchr(at, ',');
        if (comma != NULL) {
            *comma = '\0';
        }
        if (num == 2 && strcmp(at, "inf") == 0) {
            numbers[num] = INFINITY;
        } else {
            PS_TRY(ps_parse_number(at, said->shown, 0, DBL_MAX, &numbers[num], error));
        }
        at = comma != NULL ? comma + 1 : NULL;
        if (num == 2 && at != NULL) {
            return fail_word(said, error);
        }
    }
    *out = (ps_bound){numbers[0], numbers[1], numbers[2]};
    if (out->alpha == 0 && out->exponent > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" has the exponent %g and an alpha of 0, up to which it would "
                       "rise; alpha is above 0, and a constant is gamma alone",
                       said->shown, said->text, out->exponent);
    }
    return num != 2 ? PSPEC_OK : fail_word(said, error);
}

/* No power lies between profiles that cross. */
static pspec_status check_bounds(const ps_bounds_spec *bounds, const ps_said *said,
                                 ps_error *error) {
    const double crossed = ps_bounds_find_crossed(bounds);
    return crossed < 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: \"%s\" has the profile below, which comes first, above the other "
                         "one: %.3g and %.3g at the normalized frequency %.3g",
                         said->shown, said->text, ps_bound_power(&bounds->below, crossed),
                         ps_bound_power(&bounds->above, crossed), crossed);
}

pspec_status ps_set_bounds(const ps_said *said, ps_error *error) {
    static const char dots[] = "..";
    ps_request *const request = said->request;
    const char *const middle = strstr(said->text, dots);
    if (request->num_bounds == PS_MAX_SAMPLERS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: more than %d pairs of profiles",
                       said->shown, PS_MAX_SAMPLERS);
    }
    ps_bounds_spec *const bounds = &request->bounds[request->num_bounds++];
    *bounds = (ps_bounds_spec){.is_wanted = true};
    if (strcmp(said->text, "auto") == 0) {
        return PSPEC_OK;
    }
    if (middle == NULL) {
        return fail_word(said, error);
    }
    const char *const second = middle + sizeof dots - 1;
    bounds->is_given = true;
    PS_TRY(parse_bound(&bounds->below, said, said->text, (size_t)(middle - said->text), error));
    PS_TRY(parse_bound(&bounds->above, said, second, strlen(second), error));
    return check_bounds(bounds, said, error);
}

/* "type=1" */
pspec_status ps_set_select(const ps_said *said, ps_error *error) {
    const char *const value = strchr(said->text, '=');
    return value != NULL && value != said->text && value[1] != '\0'
               ? ps_set_text(said, error)
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: \"%s\" is not NAME=VALUE, as in type=1", said->shown, said->text);
}

/* A comma tells names of columns from what columns are, which may follow them: "ra,dec=lon-lat". */
pspec_status ps_set_columns(const ps_said *said, ps_error *error) {
    const bool are_names = strchr(said->text, ',') != NULL;
    const char *const meaning = are_names ? strrchr(said->text, '=') : NULL;
    ps_said word = *said;
    int index = 0;
    said->request->reading.columns = NULL;
    said->request->reading.column_names = are_names ? said->text : NULL;
    if (meaning != NULL) {
        word.text = meaning + 1;
        return find_word(&word, &index, error);
    }
    return are_names ? PSPEC_OK : ps_set_word(said, error);
}

pspec_status ps_set_bins(const ps_said *said, ps_error *error) {
    return ps_bin_rule_parse(&said->request->frequencies.bins, said->shown, said->text, error);
}

/* The words stand in the order of ps_domain. */
pspec_status ps_set_domain(const ps_said *said, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->reading.domain = (ps_domain)index;
    return PSPEC_OK;
}

/* The words stand in the order of ps_lift, from 1. */
pspec_status ps_set_lift(const ps_said *said, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->reading.lift = (ps_lift)(index + 1);
    return PSPEC_OK;
}

pspec_status ps_set_morph(const ps_said *said, ps_error *error) {
    static const ps_parameter exponent = {PS_EXPONENT_KEY, "", PS_EXPONENT_MEANING};
    static const ps_parameter *const parameters[] = {&exponent, NULL};
    char name[PS_GRAMMAR_WORD];
    ps_slice given = {NULL, 0};
    const char *const rest = ps_grammar_name(said->text, name);
    const ps_grammar grammar = {.kind = "morph",
                                .name = name,
                                .parameters = parameters,
                                .num_own = 1,
                                .most_letters = PS_MAX_SAMPLER_VALUE - 1};
    PS_TRY(ps_grammar_values(&grammar, rest, &given, error));
    const ps_morph_words morph = {said->shown, said->text, {name, strlen(name)}, given};
    said->request->reading.has_morph = true;
    return ps_morph_parse(&said->request->reading.morph, &morph, error);
}

pspec_status ps_set_normalize(const ps_said *said, ps_error *error) {
    static const pspec_normalization meant[] = {
        PSPEC_NORMALIZATION_POWER, PSPEC_NORMALIZATION_EFFECTIVE, PSPEC_NORMALIZATION_INTEGRAL};
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->normalization = meant[index];
    return PSPEC_OK;
}

/* The words after "auto" stand in the order of ps_precision. */
pspec_status ps_set_precision(const ps_said *said, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(said, &index, error));
    said->request->limits.constraints.precision = index - 1;
    return PSPEC_OK;
}
