/* From the text of a value to a field of ps_request. */
#include "questions/option_setters.h"

#include "base/process/memory_limit.h"
#include "base/text.h"
#include "frequencies/frequencies.h"
#include "math/sobolev.h"
#include "samplers/morph_words.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* The size of a box and differences in it are numbers, and its inverse is, too. */
#define MOST_BOX 1e300
#define LEAST_BOX 1e-300

/* ---- setters ------------------------------------------------------------------------------- */

static void *find_field(const ps_option *option, ps_request *arguments) {
    return (char *)arguments + option->offset;
}

pspec_status ps_set_flag(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    (void)shown, (void)words, (void)value, (void)error;
    bool *const field = find_field(option, arguments);
    *field = true;
    return PSPEC_OK;
}

pspec_status ps_set_text(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    (void)shown, (void)words, (void)error;
    const char **const field = find_field(option, arguments);
    *field = value;
    return PSPEC_OK;
}

pspec_status ps_set_nothing(const ps_option *option, const char *shown, const char *words,
                            const char *value, ps_request *arguments, ps_error *error) {
    (void)shown, (void)option, (void)words, (void)value, (void)arguments, (void)error;
    return PSPEC_OK;
}

pspec_status ps_set_count(const ps_option *option, const char *shown, const char *words,
                          const char *value, ps_request *arguments, ps_error *error) {
    (void)words;
    return ps_parse_count(value, shown, option->minimum, option->maximum,
                          find_field(option, arguments), error);
}

pspec_status ps_set_size(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    (void)words;
    return ps_parse_size(value, shown, find_field(option, arguments), error);
}

/* One end of a range; an empty text leaves *out as it is. */
static pspec_status parse_end(const char *shown, const char *text, size_t length, uint64_t *out,
                              ps_error *error) {
    enum { MOST_DIGITS = 31 };
    char number[MOST_DIGITS + 1];
    snprintf(number, sizeof number, "%.*s", (int)(length < MOST_DIGITS ? length : MOST_DIGITS),
             text);
    return length == 0 ? PSPEC_OK : ps_parse_count(number, shown, 1, UINT64_MAX - 1, out, error);
}

/* "A..B", "A", "A.." or "..B" */
pspec_status ps_set_range(const ps_option *option, const char *shown, const char *words,
                          const char *value, ps_request *arguments, ps_error *error) {
    static const char dots[] = "..";
    ps_point_range *const field = find_field(option, arguments);
    ps_point_range range = {1, UINT64_MAX};
    const char *const middle = strstr(value, dots);
    const char *const last = middle != NULL ? middle + sizeof dots - 1 : value;
    const size_t first_length = middle != NULL ? (size_t)(middle - value) : strlen(value);
    if (first_length + strlen(last) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" says neither end: %s, or A, A.., ..B", shown, value, words);
    }
    PS_TRY(parse_end(shown, value, first_length, &range.first, error));
    PS_TRY(parse_end(shown, last, strlen(last), &range.last, error));
    if (range.first > range.last) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\": the first number is the larger one", shown, value);
    }
    *field = range;
    return PSPEC_OK;
}

/* A kind of result that takes fewer degrees says so itself. */
pspec_status ps_set_max_degree(const ps_option *option, const char *shown, const char *words,
                               const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    if (value[0] == '-' || strcmp(value, "0") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: %s leaves no degree, the first is 1", shown, value);
    }
    PS_TRY(ps_parse_count(value, shown, 1, INT64_MAX, &arguments->max_degree, error));
    return arguments->max_degree <= (uint64_t)PS_MAX_DEGREE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: degree %s is above %d, where the coefficients of one set take 8 GiB",
                         shown, value, (int)PS_MAX_DEGREE);
}

pspec_status ps_set_dimension(const ps_option *option, const char *shown, const char *words,
                              const char *value, ps_request *arguments, ps_error *error) {
    uint64_t count = 0;
    (void)words;
    PS_TRY(ps_parse_count(value, shown, option->minimum, option->maximum, &count, error));
    arguments->dimension = (unsigned)count;
    return PSPEC_OK;
}

pspec_status ps_set_max_frequency(const ps_option *option, const char *shown, const char *words,
                                  const char *value, ps_request *arguments, ps_error *error) {
    uint64_t count = 0;
    (void)words;
    PS_TRY(ps_parse_count(value, shown, option->minimum, option->maximum, &count, error));
    arguments->frequencies.max_frequency = (int32_t)count;
    return PSPEC_OK;
}

/* A number above 0, up to maximum, as `most` says at the end of a sentence. */
static pspec_status parse_positive(const char *shown, const char *value, double maximum,
                                   const char *most, double *out, ps_error *error) {
    double number = 0;
    PS_TRY(ps_parse_number(value, shown, -DBL_MAX, DBL_MAX, &number, error));
    if (number <= 0 || number > maximum) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %s is not above 0%s", shown, value,
                       most);
    }
    *out = number;
    return PSPEC_OK;
}

pspec_status ps_set_tolerance(const ps_option *option, const char *shown, const char *words,
                              const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    return parse_positive(shown, value, 1, " and at most 1", &arguments->accuracy.tolerance, error);
}

pspec_status ps_set_floor(const ps_option *option, const char *shown, const char *words,
                          const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    return parse_positive(shown, value, DBL_MAX, "", &arguments->accuracy.floor, error);
}

pspec_status ps_set_standard_error(const ps_option *option, const char *shown, const char *words,
                                   const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    return parse_positive(shown, value, 1, " and at most 1", &arguments->accuracy.standard_error,
                          error);
}

pspec_status ps_set_false_alarm_rate(const ps_option *option, const char *shown, const char *words,
                                     const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    PS_TRY(
        parse_positive(shown, value, DBL_MAX, " and below 1", &arguments->false_alarm_rate, error));
    return arguments->false_alarm_rate < 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: %s is not above 0 and below 1: every check would fail", shown, value);
}

pspec_status ps_set_smoothness(const ps_option *option, const char *shown, const char *words,
                               const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    ps_error reason = {0};
    PS_TRY(ps_parse_number(value, shown, -DBL_MAX, DBL_MAX, &arguments->smoothness, error));
    const pspec_status status = ps_sobolev_check(arguments->smoothness, &reason);
    return status == PSPEC_OK ? PSPEC_OK : ps_fail(error, status, "%s: %s", shown, reason.message);
}

pspec_status ps_add_sampler(const ps_option *option, const char *shown, const char *words,
                            const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    if (arguments->num_samplers == PS_MAX_SAMPLERS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: more than %d samplers", shown,
                       PS_MAX_SAMPLERS);
    }
    arguments->samplers[arguments->num_samplers++] = value;
    return PSPEC_OK;
}

/* ---- values that are one of a few words ---------------------------------------------------- */

static pspec_status fail_word(const char *shown, const char *words, const char *value,
                              ps_error *error) {
    ps_text list = {0};
    for (const char *word = words; *word != '\0';) {
        const size_t length = strcspn(word, "|");
        ps_text_append(&list, "%s%.*s", word == words ? "" : ", ", (int)length, word);
        word += length + (word[length] == '|');
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: \"%s\" is not one of %s", shown, value,
            ps_text_string(&list));
    ps_text_free(&list);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

/* Number of value among words, "one|two|three". */
static pspec_status find_word(const char *shown, const char *words, const char *value, int *index,
                              ps_error *error) {
    *index = 0;
    for (const char *word = words; *word != '\0';) {
        const size_t length = strcspn(word, "|");
        if (strlen(value) == length && strncmp(value, word, length) == 0) {
            return PSPEC_OK;
        }
        word += length + (word[length] == '|');
        ++*index;
    }
    return fail_word(shown, words, value, error);
}

pspec_status ps_set_word(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    return ps_set_text(option, shown, words, value, arguments, error);
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

pspec_status ps_set_weights(const ps_option *option, const char *shown, const char *words,
                            const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    const ps_weights_kind kind = ps_weights_find(words, value);
    if (kind == PS_WEIGHTS_GIVEN) {
        return fail_word(shown, words, value, error);
    }
    arguments->weights.kind = kind;
    arguments->weights.path = kind == PS_WEIGHTS_FILE ? value : NULL;
    arguments->reading.weight_column = kind == PS_WEIGHTS_COLUMN;
    arguments->reading.ignore_weights = kind != PS_WEIGHTS_COLUMN; /* others replace them */
    return PSPEC_OK;
}

pspec_status ps_set_weight_sum(const ps_option *option, const char *shown, const char *words,
                               const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->weights.sum_to_one = index == 1;
    return PSPEC_OK;
}

/* The words stand in the order of bits: x, y, both, none. */
pspec_status ps_set_plot_log(const ps_option *option, const char *shown, const char *words,
                             const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    enum { X = 0, Y = 1, BOTH = 2 };
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->plot_axes.has_log = true;
    arguments->plot_axes.is_log_x = index == X || index == BOTH;
    arguments->plot_axes.is_log_y = index == Y || index == BOTH;
    return PSPEC_OK;
}

/* "0..2", or nothing. */
static pspec_status set_interval(const char *shown, const char *words, const char *text,
                                 size_t length, bool *is_there, double ends[2], ps_error *error) {
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
        return fail_word(shown, words, text, error);
    }
    *middle = '\0';
    PS_TRY(ps_parse_number(own, shown, -DBL_MAX, DBL_MAX, &ends[0], error));
    PS_TRY(ps_parse_number(middle + sizeof dots - 1, shown, -DBL_MAX, DBL_MAX, &ends[1], error));
    return ends[0] < ends[1]
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: %s is no interval: it must end above its beginning", shown, text);
}

pspec_status ps_set_plot_range(const ps_option *option, const char *shown, const char *words,
                               const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    ps_plot_axes *const axes = &arguments->plot_axes;
    const size_t length = strcspn(value, ",");
    const char *const second = value + length + (value[length] == ',');
    if (length == 0 && *second == '\0') {
        return fail_word(shown, words, value, error);
    }
    PS_TRY(set_interval(shown, words, value, length, &axes->has_x, axes->x, error));
    return set_interval(shown, words, second, strlen(second), &axes->has_y, axes->y, error);
}

pspec_status ps_set_box(const ps_option *option, const char *shown, const char *words,
                        const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    enum { NUMBER_BYTES = 64 };
    char first[NUMBER_BYTES];
    const char *const comma = strchr(value, ',');
    ps_point_options *const reading = &arguments->reading;
    if (comma == NULL || (size_t)(comma - value) >= sizeof first) {
        return fail_word(shown, words, value, error);
    }
    snprintf(first, sizeof first, "%.*s", (int)(comma - value), value);
    PS_TRY(ps_parse_number(first, shown, -MOST_BOX, MOST_BOX, &reading->box_low, error));
    PS_TRY(ps_parse_number(comma + 1, shown, -MOST_BOX, MOST_BOX, &reading->box_high, error));
    if (!(reading->box_low < reading->box_high)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: %s is no interval: X0 must be below X1", shown, value);
    }
    return reading->box_high - reading->box_low >= LEAST_BOX
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: %s is %.3g wide, and must be at least %g", shown, value,
                         reading->box_high - reading->box_low, LEAST_BOX);
}

/* A comma tells names of columns from what columns are. */
pspec_status ps_set_columns(const ps_option *option, const char *shown, const char *words,
                            const char *value, ps_request *arguments, ps_error *error) {
    const bool are_names = strchr(value, ',') != NULL;
    arguments->reading.columns = NULL;
    arguments->reading.column_names = are_names ? value : NULL;
    return are_names ? PSPEC_OK : ps_set_word(option, shown, words, value, arguments, error);
}

pspec_status ps_set_bins(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    return ps_bin_rule_parse(&arguments->frequencies.bins, shown, value, error);
}

/* The words stand in the order of ps_domain. */
pspec_status ps_set_domain(const ps_option *option, const char *shown, const char *words,
                           const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->reading.domain = (ps_domain)index;
    return PSPEC_OK;
}

/* The words stand in the order of ps_lift, from 1. */
pspec_status ps_set_lift(const ps_option *option, const char *shown, const char *words,
                         const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->reading.lift = (ps_lift)(index + 1);
    return PSPEC_OK;
}

pspec_status ps_set_morph(const ps_option *option, const char *shown, const char *words,
                          const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    (void)words;
    static const ps_parameter exponent = {PS_EXPONENT_KEY, "", PS_EXPONENT_MEANING};
    static const ps_parameter *const parameters[] = {&exponent, NULL};
    char name[PS_GRAMMAR_WORD];
    ps_slice given = {NULL, 0};
    const char *const rest = ps_grammar_name(value, name);
    const ps_grammar grammar = {.kind = "morph",
                                .name = name,
                                .parameters = parameters,
                                .num_own = 1,
                                .most_letters = PS_MAX_SAMPLER_VALUE - 1};
    PS_TRY(ps_grammar_values(&grammar, rest, &given, error));
    const ps_morph_words said = {shown, value, {name, strlen(name)}, given};
    arguments->reading.has_morph = true;
    return ps_morph_parse(&arguments->reading.morph, &said, error);
}

pspec_status ps_set_normalize(const ps_option *option, const char *shown, const char *words,
                              const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    static const pspec_normalization meant[] = {
        PSPEC_NORMALIZATION_POWER, PSPEC_NORMALIZATION_EFFECTIVE, PSPEC_NORMALIZATION_INTEGRAL};
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->normalization = meant[index];
    return PSPEC_OK;
}

/* The words after "auto" stand in the order of ps_precision. */
pspec_status ps_set_precision(const ps_option *option, const char *shown, const char *words,
                              const char *value, ps_request *arguments, ps_error *error) {
    (void)option;
    int index = 0;
    PS_TRY(find_word(shown, words, value, &index, error));
    arguments->limits.constraints.precision = index - 1;
    return PSPEC_OK;
}
