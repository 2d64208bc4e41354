#include "answers/output_check.h"

#include "base/text.h"
#include "files/output_file.h"
#include "request/options.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What stands under a name. What is not there yet is no failure: *exists is false. */
static pspec_status look_up(const char *path, struct stat *facts, bool *exists, ps_error *error) {
    *exists = stat(path, facts) == 0;
    return *exists || errno == ENOENT
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO, "cannot read %s: %s", path, strerror(errno));
}

/* The same file, whatever the two names are; files that do not exist yet are compared by name. */
static pspec_status compare_files(const char *a, const char *b, bool *are_same, ps_error *error) {
    struct stat first;
    struct stat second;
    bool has_first = false;
    bool has_second = false;
    PS_TRY(look_up(a, &first, &has_first, error));
    PS_TRY(look_up(b, &second, &has_second, error));
    *are_same = has_first && has_second
                    ? first.st_dev == second.st_dev && first.st_ino == second.st_ino &&
                          S_ISREG(first.st_mode)
                    : strcmp(a, b) == 0;
    return PSPEC_OK;
}

static pspec_status check_pair(void *file, const ps_request_file *other, ps_error *error) {
    const ps_request_file *const output = file;
    bool are_same = false;
    if (strcmp(output->path, "-") == 0 || strcmp(other->path, "-") == 0) {
        return PSPEC_OK;
    }
    PS_TRY(compare_files(output->path, other->path, &are_same, error));
    return are_same ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                              "%s \"%s\" and %s \"%s\" are the same file", output->option.text,
                              output->path, other->option.text, other->path)
                    : PSPEC_OK;
}

static pspec_status compare_with_standard_output(void *payload, const ps_request_file *input,
                                                 ps_error *error) {
    const struct stat *const output = payload;
    struct stat facts;
    bool is_known = false;
    if (strcmp(input->path, "-") == 0) {
        is_known = fstat(STDIN_FILENO, &facts) == 0;
    } else {
        PS_TRY(look_up(input->path, &facts, &is_known, error));
    }
    return is_known && facts.st_dev == output->st_dev && facts.st_ino == output->st_ino
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s \"%s\" is also the standard output", input->option.text, input->path)
               : PSPEC_OK;
}

/* "convert a >>a" would read what it writes, without an end. */
static pspec_status check_standard_output(const ps_request *arguments, ps_error *error) {
    struct stat output;
    return fstat(STDOUT_FILENO, &output) == 0 && S_ISREG(output.st_mode)
               ? ps_request_visit_inputs(arguments, compare_with_standard_output, &output, error)
               : PSPEC_OK;
}

static bool is_stream(const char *path) {
    return path != NULL && strcmp(path, "-") == 0;
}

/* A missing folder or a lacking permission shows when the temporary file is made. */
static pspec_status check_folder(const char *path, ps_error *error) {
    ps_output_file *file = NULL;
    struct stat facts;
    bool exists = false;
    PS_TRY(look_up(path, &facts, &exists, error));
    if (exists && !S_ISREG(facts.st_mode) && !S_ISDIR(facts.st_mode)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_output_open(&file, path, error));
    ps_output_discard(&file);
    return PSPEC_OK;
}

/* "a/b.npy" -> "a/b" and the ending given. */
static void replace_ending(ps_text *out, const char *path, const char *ending) {
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    ps_text_append_bytes(out, path, dot != NULL ? (size_t)(dot - path) : strlen(path));
    ps_text_append(out, "%s", ending);
}

/* The table goes there too, unless it has a file. */
static pspec_status check_stream(const ps_request_file *output, const ps_request *arguments,
                                 ps_error *error) {
    return arguments->output == NULL || is_stream(arguments->output)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s - and the table would both go to standard output; -o FILE keeps them "
                         "apart",
                         output->option.text)
               : PSPEC_OK;
}

static pspec_status check_all(ps_request_file *outputs, size_t num, const ps_request *arguments,
                              ps_error *error) {
    for (size_t i = 0; i < num; i++) {
        if (outputs[i].path != arguments->output && is_stream(outputs[i].path)) {
            PS_TRY(check_stream(&outputs[i], arguments, error));
        }
        if (is_stream(outputs[i].path)) {
            continue;
        }
        for (size_t j = i + 1; j < num; j++) {
            PS_TRY(check_pair(&outputs[i], &outputs[j], error));
        }
        PS_TRY(ps_request_visit_inputs(arguments, check_pair, &outputs[i], error));
        PS_TRY(check_folder(outputs[i].path, error));
    }
    return PSPEC_OK;
}

pspec_status ps_outputs_check(const ps_request *arguments, bool is_table, ps_error *error) {
    ps_text sidecar = {0};         /* names of the columns beside a table in NPY */
    ps_text standard_errors = {0}; /* beside the array of --full */
    const bool is_npy = is_table && arguments->output != NULL && !is_stream(arguments->output) &&
                        (arguments->format != NULL ? strcmp(arguments->format, "npy") == 0
                                                   : ps_text_ends_in(arguments->output, ".npy"));
    ps_request_file outputs[PS_NUM_OPTIONS + 2];
    size_t num = ps_request_outputs(outputs, arguments);
    if (is_npy) {
        replace_ending(&sidecar, arguments->output, ".json");
        outputs[num++] = (ps_request_file){{"the column names"}, ps_text_string(&sidecar)};
    }
    if (arguments->full != NULL) {
        replace_ending(&standard_errors, arguments->full, ".standard_error.npy");
        outputs[num++] =
            (ps_request_file){{"the standard errors"}, ps_text_string(&standard_errors)};
    }
    pspec_status status = ps_text_check(&sidecar, error);
    if (status == PSPEC_OK) {
        status = ps_text_check(&standard_errors, error);
    }
    if (status == PSPEC_OK && is_stream(arguments->output)) {
        status = check_standard_output(arguments, error);
    }
    if (status == PSPEC_OK) {
        status = check_all(outputs, num, arguments, error);
    }
    ps_text_free(&sidecar);
    ps_text_free(&standard_errors);
    return status;
}
