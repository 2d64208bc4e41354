/* From the text of a value to a field of ps_request. */
#include "request/option_setters.h"

#include "base/counts.h"
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "frequencies/frequencies.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- setters ------------------------------------------------------------------------------- */

static void *find_field(const ps_said *said) {
    return (char *)said->request + said->option->offset;
}

pspec_status ps_set_flag(const ps_said *said, ps_error *error) {
    (void)error;
    bool *const field = find_field(said);
    *field = true;
    return PSPEC_OK;
}

pspec_status ps_set_text(const ps_said *said, ps_error *error) {
    (void)error;
    const char **const field = find_field(said);
    *field = said->text;
    return PSPEC_OK;
}

pspec_status ps_set_nothing(const ps_said *said, ps_error *error) {
    (void)said, (void)error;
    return PSPEC_OK;
}

pspec_status ps_set_count(const ps_said *said, ps_error *error) {
    return ps_parse_count(said->text, said->shown, said->option->minimum, said->option->maximum,
                          find_field(said), error);
}

/* The last list that is said is the whole. */
pspec_status ps_set_points(const ps_said *said, ps_error *error) {
    ps_counts list = {.most = PS_MAX_COUNTS, .values = said->request->counts};
    PS_TRY(ps_counts_parse(&list, said->text, said->shown, said->option->minimum,
                           said->option->maximum, error));
    said->request->num_counts = list.num;
    return PSPEC_OK;
}

pspec_status ps_set_size(const ps_said *said, ps_error *error) {
    return ps_parse_size(said->text, said->shown, find_field(said), error);
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
pspec_status ps_set_range(const ps_said *said, ps_error *error) {
    static const char dots[] = "..";
    ps_point_range *const field = find_field(said);
    ps_point_range range = {1, UINT64_MAX};
    const char *const middle = strstr(said->text, dots);
    const char *const last = middle != NULL ? middle + sizeof dots - 1 : said->text;
    const size_t first_length = middle != NULL ? (size_t)(middle - said->text) : strlen(said->text);
    if (first_length + strlen(last) == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" says neither end: %s, or A, A.., ..B", said->shown, said->text,
                       said->words);
    }
    PS_TRY(parse_end(said->shown, said->text, first_length, &range.first, error));
    PS_TRY(parse_end(said->shown, last, strlen(last), &range.last, error));
    if (range.first > range.last) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\": the first number is the larger one", said->shown, said->text);
    }
    *field = range;
    return PSPEC_OK;
}

/* A kind of answer that takes fewer degrees says so itself. */
pspec_status ps_set_max_degree(const ps_said *said, ps_error *error) {
    if (said->text[0] == '-' || strcmp(said->text, "0") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: %s leaves no degree, the first is 1", said->shown, said->text);
    }
    PS_TRY(
        ps_parse_count(said->text, said->shown, 1, INT64_MAX, &said->request->max_degree, error));
    return said->request->max_degree <= (uint64_t)PS_MAX_DEGREE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: degree %s is above %d, where the coefficients of one set take 8 GiB",
                         said->shown, said->text, (int)PS_MAX_DEGREE);
}

pspec_status ps_set_dimension(const ps_said *said, ps_error *error) {
    uint64_t count = 0;
    PS_TRY(ps_parse_count(said->text, said->shown, said->option->minimum, said->option->maximum,
                          &count, error));
    said->request->dimension = (unsigned)count;
    return PSPEC_OK;
}

pspec_status ps_set_max_frequency(const ps_said *said, ps_error *error) {
    uint64_t count = 0;
    PS_TRY(ps_parse_count(said->text, said->shown, said->option->minimum, said->option->maximum,
                          &count, error));
    said->request->frequencies.max_frequency = (int32_t)count;
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

pspec_status ps_set_positive(const ps_said *said, ps_error *error) {
    return parse_positive(said->shown, said->text, DBL_MAX, "", find_field(said), error);
}

pspec_status ps_set_share(const ps_said *said, ps_error *error) {
    return parse_positive(said->shown, said->text, 1, " and at most 1", find_field(said), error);
}

pspec_status ps_set_quarter_turn(const ps_said *said, ps_error *error) {
    const double most = 90;
    return ps_parse_number(said->text, said->shown, 0, most, find_field(said), error);
}

pspec_status ps_set_false_alarm_rate(const ps_said *said, ps_error *error) {
    PS_TRY(parse_positive(said->shown, said->text, DBL_MAX, " and below 1",
                          &said->request->false_alarm_rate, error));
    return said->request->false_alarm_rate < 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: %s is not above 0 and below 1: every check would fail", said->shown,
                         said->text);
}

/* What is not of the words is a number. */
pspec_status ps_set_fit(const ps_said *said, ps_error *error) {
    const double most = 16;
    said->request->wants_fit = true;
    said->request->fit_exponent = NAN;
    return strcmp(said->text, "auto") == 0 ? PSPEC_OK
                                           : ps_parse_number(said->text, said->shown, 0, most,
                                                             &said->request->fit_exponent, error);
}

pspec_status ps_add_text(const ps_said *said, ps_error *error) {
    const char **const texts = find_field(said);
    size_t *const num = (void *)((char *)said->request + said->option->offset_of_number);
    if (*num == said->option->maximum) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: more than %zu %ss", said->shown,
                       *num, said->option->name);
    }
    texts[(*num)++] = said->text;
    return PSPEC_OK;
}
