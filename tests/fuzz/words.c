/* What people type: samplers with their parameters, and the words of commands. */
#include "answers/spectra/question.h"
#include "base/text.h"
#include "cli/command.h"
#include "fuzz.h"
#include "integrands/lobes/brdf.h"
#include "request/options.h"
#include "samplers/sampler.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- samplers ---------------------------------------------------------------------------- */

static bool is_coordinate(const ps_sampler_request *request, double number) {
    return ps_sampler_is_on_sphere(request) ? fabs(number) <= 1 : number >= 0 && number < 1;
}

static void check_points(const ps_sampler_request *request) {
    const size_t most = ps_sampler_most_points(request);
    double *const points = fuzz_allocate(NULL, most * request->dimension, sizeof *points);
    ps_error error = {0};
    size_t num = 0;
    const pspec_status status = ps_sampler_generate(request, 0, points, &num, NULL, &error);
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    if (status == PSPEC_OK &&
        (num > most || (num != request->num_points && !ps_sampler_varies(request)))) {
        fuzz_fail("%s: %zu points for %zu", request->sampler->name, num, request->num_points);
    }
    for (size_t i = 0; status == PSPEC_OK && i < num * request->dimension; i++) {
        if (!is_coordinate(request, points[i])) {
            fuzz_fail("%s: coordinate %.17g", request->sampler->name, points[i]);
        }
    }
    free(points);
}

/* Bytes: number of points (2), dimension, both 0 where they are left open, text. */
void fuzz_sampler(const char *argument, fuzz_bytes input) {
    enum { MOST_DIMENSIONS = 8, MOST_GENERATED = 1024 };
    (void)argument;
    ps_sampler_request request = {.seed = 1};
    request.num_points = fuzz_take(&input);
    request.num_points += (size_t)fuzz_take(&input) << 8;
    request.dimension = fuzz_take(&input) % MOST_DIMENSIONS;
    char *const text = fuzz_copy_text(input);
    ps_error error = {0};
    pspec_status status = ps_sampler_parse(&request, text, &error);
    if (status == PSPEC_OK) {
        for (unsigned i = 0; request.sampler->parameters[i].key != NULL; i++) {
            if (memchr(request.values[i], '\0', PS_MAX_SAMPLER_VALUE) == NULL) {
                fuzz_fail("%s: parameter %u has no end", text, i);
            }
        }
        status = ps_sampler_resolve(&request, &error);
    }
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    const double most_seconds = 0.02; /* by the row: sanitizers take tens of times as long */
    if (status == PSPEC_OK && request.num_points <= MOST_GENERATED &&
        ps_sampler_seconds(&request) < most_seconds) {
        check_points(&request);
    }
    free(text);
}

/* ---- BRDFs ------------------------------------------------------------------------------- */

static void check_coefficients(const ps_brdf *brdf) {
    enum { LAST = 8 };
    double b[LAST + 1];
    ps_error error = {0};
    const pspec_status status = ps_brdf_spherical(brdf, LAST, b, &error);
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    for (size_t l = 0; status == PSPEC_OK && l <= LAST; l++) {
        if (!isfinite(b[l])) {
            fuzz_fail("b_%zu = %g", l, b[l]);
        }
    }
}

/* The first byte is 0: a table of a lobe follows. Else: the text of a BRDF, which finds no files.
 */
void fuzz_brdf(const char *argument, fuzz_bytes input) {
    (void)argument;
    const bool is_table = fuzz_take(&input) == 0;
    fuzz_file file = fuzz_file_make(input);
    char *const text = fuzz_copy_text(input);
    char name[4200];
    ps_brdf *brdf = NULL;
    ps_error error = {0};
    snprintf(name, sizeof name, "zonal:file=%s", file.path);
    const bool names_file = strstr(text, "file") != NULL;
    if (is_table || !names_file) {
        const pspec_status status = ps_brdf_parse(&brdf, is_table ? name : text, &error);
        fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
        if (status == PSPEC_OK) {
            check_coefficients(brdf);
        }
    }
    ps_brdf_destroy(brdf);
    free(text);
    fuzz_file_close(&file);
}

/* ---- commands ---------------------------------------------------------------------------- */

enum { MOST_WORDS = 64 };

static int split_words(char *text, size_t size, char *words[MOST_WORDS]) {
    int num_words = 0;
    char *word = text;
    for (size_t i = 0; i <= size && num_words < MOST_WORDS; i++) {
        if (i == size || text[i] == '\n' || text[i] == '\0') {
            text[i] = '\0';
            words[num_words++] = word;
            word = text + i + 1;
        }
    }
    return num_words;
}

/* The limits of the options, which everything behind the parser relies on. */
static void check_ranges(const ps_command *command, const ps_request *a, int num_words) {
    enum { MOST_DIMENSIONS = 6, MOST_PRECISION = 2 };
    const bool is_good = a->num_counts >= 1 && a->num_counts <= PS_MAX_COUNTS &&
                         a->counts[a->num_counts - 1] >= 1 && a->num_realizations >= 1 &&
                         a->dimension >= 1 && a->dimension <= MOST_DIMENSIONS &&
                         a->frequencies.max_frequency >= 0 && a->accuracy.tolerance > 0 &&
                         a->accuracy.tolerance <= 1 && a->accuracy.floor >= 0 &&
                         isfinite(a->accuracy.floor) && a->limits.constraints.precision >= -1 &&
                         a->limits.constraints.precision <= MOST_PRECISION &&
                         a->num_sources <= PS_MAX_SAMPLERS && a->num_files <= (size_t)num_words;
    if (!is_good) {
        fuzz_fail("%s: a value outside its limits", command->name);
    }
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (a->is_given[id] && !ps_command_takes(command, (ps_option_id)id)) {
            fuzz_fail("%s: option %d is not its own", command->name, id);
        }
    }
}

static void check_questions(const ps_request *arguments) {
    ps_question_list list;
    ps_error error = {0};
    const pspec_status status = ps_questions_make(&list, arguments, PS_QUESTION_POWER, &error);
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    if (status == PSPEC_OK && (list.num < 1 || list.num > PS_MAX_SAMPLERS * PS_MAX_COUNTS)) {
        fuzz_fail("%zu questions", list.num);
    }
    ps_questions_free(&list);
}

static void parse_words(const ps_command *command, int num_words, char **words) {
    ps_request arguments;
    ps_error error = {0};
    const pspec_status status = ps_arguments_parse(&arguments, command, num_words, words, &error);
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    if (status == PSPEC_OK) {
        check_ranges(command, &arguments, num_words);
        check_questions(&arguments);
    }
    ps_arguments_free(&arguments);
}

/* The first byte is the number of the command; where there is none of that number, the first word
 * is its name. */
void fuzz_arguments(const char *argument, fuzz_bytes input) {
    (void)argument;
    const unsigned number = fuzz_take(&input);
    size_t num_commands = 0;
    while (ps_commands[num_commands] != NULL) {
        num_commands++;
    }
    char *const text = fuzz_copy_text(input);
    char *words[MOST_WORDS];
    ps_error error = {0};
    const int num_words = split_words(text, input.size, words);
    if (number < num_commands) {
        parse_words(ps_commands[number], num_words, words);
    } else {
        const ps_command *const command = ps_command_find(words[0], &error);
        if (command == NULL) {
            fuzz_check_error(PSPEC_ERROR_INVALID_ARGUMENT, &error, FUZZ_QUOTES_INPUT);
        } else {
            parse_words(command, num_words - 1, words + 1);
        }
    }
    free(text);
}
