/* Setters of what points come from: samplers, programs, and sets of files under a name. */
#include "request/option_setters.h"

#include <string.h>

/* Rows and curves are told apart by their names. A sampler may be asked for twice. */
static pspec_status check_name(const ps_said *said, const char *name, bool is_set,
                               ps_error *error) {
    const ps_request *const request = said->request;
    for (size_t i = 0; i < request->num_sources; i++) {
        if ((is_set || request->sources[i].files != NULL) &&
            strcmp(ps_request_source_name(request, i), name) == 0) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "%s %s: another set or sampler has this name", said->shown, said->text);
        }
    }
    return PSPEC_OK;
}

static pspec_status add_source(const ps_said *said, const ps_source_words *words, ps_error *error) {
    ps_request *const request = said->request;
    if (request->num_sources == said->option->maximum) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: more than %zu samplers and sets",
                       said->shown, request->num_sources);
    }
    request->sources[request->num_sources++] = *words;
    return PSPEC_OK;
}

static pspec_status check_program(const ps_said *said, const char *files, ps_error *error) {
    const char *const command = files != NULL ? ps_points_program(files) : NULL;
    return command == NULL || command[strspn(command, " \t\n")] != '\0'
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s %s: a command is wanted behind " PS_POINT_PROGRAM
                         ", as in '" PS_POINT_PROGRAM "./mine {n} {seed} {realization}'",
                         said->shown, said->text);
}

/* A program is a sampler for who asks, and prints what is read as files are. */
pspec_status ps_add_sampler(const ps_said *said, ps_error *error) {
    const bool is_program = ps_points_program(said->text) != NULL;
    const ps_source_words words = {.sampler = is_program ? NULL : said->text,
                                   .files = is_program ? said->text : NULL};
    PS_TRY(check_name(said, said->text, is_program, error));
    PS_TRY(check_program(said, words.files, error));
    return add_source(said, &words, error);
}

pspec_status ps_add_set(const ps_said *said, ps_error *error) {
    ps_source_words words = {.sampler = NULL};
    const char *const equals = strchr(said->text, '=');
    const size_t length = equals != NULL ? (size_t)(equals - said->text) : 0;
    if (length == 0 || equals[1] == '\0' || length >= sizeof words.name) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: \"%s\" is no NAME=FILES, as in bnot=b1.dat,b2.dat, with a name of 1 to "
                       "%zu bytes",
                       said->shown, said->text, sizeof words.name - 1);
    }
    memcpy(words.name, said->text, length);
    words.files = equals + 1;
    PS_TRY(check_name(said, words.name, true, error));
    PS_TRY(check_program(said, words.files, error));
    return add_source(said, &words, error);
}
