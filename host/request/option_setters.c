/* From the text of a value to a field of ps_request. */
#include "request/option_setters.h"

#include "base/counts.h"
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "frequencies/frequencies.h"
#include "math/sobolev.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

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

/* The last list that is said is the whole. */
pspec_status ps_set_points(const ps_option *option, const char *shown, const char *words,
                           const char *value, ps_request *arguments, ps_error *error) {
    ps_counts list = {.most = PS_MAX_COUNTS, .values = arguments->counts};
    (void)words;
    PS_TRY(ps_counts_parse(&list, value, shown, option->minimum, option->maximum, error));
    arguments->num_counts = list.num;
    return PSPEC_OK;
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

pspec_status ps_add_integrand(const ps_option *option, const char *shown, const char *words,
                              const char *value, ps_request *arguments, ps_error *error) {
    (void)option, (void)words;
    if (arguments->num_integrands == PS_MAX_INTEGRANDS) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: more than %d integrands", shown,
                       PS_MAX_INTEGRANDS);
    }
    arguments->integrands[arguments->num_integrands++] = value;
    return PSPEC_OK;
}
