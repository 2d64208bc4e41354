/* The public library: questions, their options and patterns. */
#include "api/question.h"
#include "base/memory.h"
#include "files/decimal.h"
#include "files/temporary_file.h"
#include "request/option_text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- create ------------------------------------------------------------------------------ */

pspec_status pspec_question_create(pspec_question **out, pspec_context *context, const char *kind) {
    const ps_command *row = NULL;
    pspec_question *self = NULL;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    PS_TRY(ps_public_find(&row, ps_public_commands, kind, "kind of answer or command",
                          &context->error));
    PS_TRY(PS_NEW(&self, 1, "a question", &context->error));
    *self = (pspec_question){.context = context, .row = row, .request = ps_request_default};
    *out = self;
    return PSPEC_OK;
}

void pspec_question_reset(pspec_question *question) {
    for (size_t i = 0; question != NULL && i < question->num_sets; i++) {
        ps_text_free(&question->sets[i].name);
        ps_text_free(&question->sets[i].word);
        free(question->sets[i].kept);
        ps_pool_free(&question->sets[i].memory);
    }
    if (question != NULL) {
        question->num_sets = 0;
    }
}

void pspec_question_destroy(pspec_question *question) {
    if (question == NULL) {
        return;
    }
    ps_public_forget(question);
    pspec_question_reset(question);
    for (size_t i = 0; i < question->num_texts; i++) {
        free(question->texts[i]);
    }
    for (size_t i = 0; i < question->num_arrays; i++) {
        fclose(question->arrays[i]);
    }
    free(question->sets);
    free(question->texts);
    free(question->files);
    free(question->arrays);
    ps_text_free(&question->words);
    free(question);
}

/* ---- options ----------------------------------------------------------------------------- */

static const char files_name[] = "files";

static bool takes(const void *row, ps_option_id id) {
    return ps_public_takes(row, id);
}

/* A copy of the text that the question owns. */
static pspec_status keep_text(pspec_question *self, const char **text, ps_error *error) {
    void *texts = self->texts;
    PS_TRY(ps_grow(&texts, &self->texts_capacity, self->num_texts + 1, sizeof *self->texts,
                   "texts of options", error));
    self->texts = texts;
    char *const copy = strdup(*text);
    if (copy == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for the value of an option");
    }
    self->texts[self->num_texts++] = copy;
    *text = copy;
    return PSPEC_OK;
}

static pspec_status refuse_stream(const char *name, const char *value, ps_error *error) {
    return strcmp(value, "-") != 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: the library reads and writes files, and - is none", name);
}

static pspec_status add_file(pspec_question *self, const char *path, ps_error *error) {
    void *files = self->files;
    if (path == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is no name of a file",
                       files_name);
    }
    PS_TRY(refuse_stream(files_name, path, error));
    PS_TRY(keep_text(self, &path, error));
    ps_public_forget(self);
    PS_TRY(ps_grow(&files, &self->files_capacity, self->num_files + 1, sizeof *self->files,
                   "names of files", error));
    self->files = files;
    self->files[self->num_files++] = path;
    return PSPEC_OK;
}

/* Arrays that options write to a file, if they name one. */
static bool ask_for_array(ps_request *request, ps_option_id id) {
    const bool is_array =
        id == PS_OPTION_FULL || id == PS_OPTION_WEIGHTS_OUT || id == PS_OPTION_IMAGE_OUT;
    request->wants_array = request->wants_array || is_array;
    request->wants_errors = request->wants_errors || id == PS_OPTION_FULL;
    request->wants_coefficients = request->wants_coefficients || id == PS_OPTION_COEFFICIENTS;
    return is_array || id == PS_OPTION_COEFFICIENTS;
}

static pspec_status find_option(ps_option_id *out, const pspec_question *self, const char *name,
                                ps_error *error) {
    return name == NULL ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "an option has no name")
                        : ps_option_find(out, name, takes, self->row, self->row->name, error);
}

/* shown: the value as the command line has it. The request is as it was where it is refused. */
static pspec_status apply(pspec_question *self, ps_option_id id, const char *value,
                          const char *shown, ps_error *error) {
    ps_request changed = self->request;
    PS_TRY(keep_text(self, &value, error));
    PS_TRY(ps_option_apply(&changed, id, ps_command_words(self->row, id), value, error));
    self->request = changed;
    ps_public_forget(self);
    ps_option_append(&self->words, id, shown != NULL ? shown : value);
    return ps_text_check(&self->words, error);
}

static pspec_status set(pspec_question *self, const char *name, const char *value,
                        ps_error *error) {
    ps_option_id id = PS_NUM_OPTIONS;
    if (name != NULL && strcmp(name, files_name) == 0) {
        return add_file(self, value, error);
    }
    if (name != NULL && strcmp(name, "state") == 0 && value == NULL) {
        self->request.wants_state = true;
        return PSPEC_OK;
    }
    PS_TRY(find_option(&id, self, name, error));
    if (value != NULL) {
        PS_TRY(id == PS_OPTION_OUTPUT ? refuse_stream(name, value, error) : PSPEC_OK);
        return apply(self, id, value, NULL, error);
    }
    const char *const words = ps_command_words(self->row, id);
    if (words == NULL) {
        return apply(self, id, "true", NULL, error);
    }
    return ask_for_array(&self->request, id)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s needs a value: %s", name, words);
}

pspec_status pspec_question_set(pspec_question *question, const char *option, const char *value) {
    return question == NULL ? PSPEC_ERROR_INVALID_ARGUMENT
                            : set(question, option, value, &question->context->error);
}

pspec_status pspec_question_set_number(pspec_question *question, const char *option, double value) {
    char text[PS_DECIMAL_BYTES];
    ps_decimal_format(text, value);
    return pspec_question_set(question, option, text);
}

/* ---- arrays of numbers ------------------------------------------------------------------- */

/* Lists are lines of text, a line for each step of the first axis. */
static void write_rows(FILE *file, const pspec_field *array) {
    const size_t num = array->type == PSPEC_C128 ? 2 * array->num : array->num;
    const size_t columns = num / array->shape[0];
    for (size_t i = 0; i < num; i++) {
        char text[PS_DECIMAL_BYTES];
        if (array->type == PSPEC_I64) {
            fprintf(file, "%" PRId64, ((const int64_t *)array->data)[i]);
        } else {
            ps_decimal_format(text, ((const double *)array->data)[i]);
            fputs(text, file);
        }
        fputc((i + 1) % columns == 0 ? '\n' : ' ', file);
    }
}

/* Numbers of integrands may have any shape. */
static void write_npy(FILE *file, const pspec_field *array) {
    static const char *const types[] = {"f8", "i8", "c16"};
    char header[PS_NPY_HEADER_BYTES];
    fwrite(header, 1, ps_npy_make_header(header, types[array->type], array->rank, array->shape),
           file);
    fwrite(array->data, array->type == PSPEC_C128 ? 2 * sizeof(double) : sizeof(double), array->num,
           file);
}

static pspec_status check_array(const pspec_field *array, const char *option, ps_error *error) {
    size_t num = 1;
    if (array == NULL || array->struct_size < sizeof *array || array->type > PSPEC_C128 ||
        array->rank < 1 || array->rank > PS_NPY_MAX_RANK || array->shape == NULL ||
        array->data == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: the array is no field of numbers with struct_size, shape and data",
                       option);
    }
    bool fits = true;
    for (unsigned axis = 0; axis < array->rank; axis++) {
        fits = fits && ps_size_multiply(num, array->shape[axis], &num);
    }
    return fits && num == array->num && num > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "%s: the array has %zu numbers, and its shape %s%zu", option, array->num,
                         fits ? "" : "more than ", fits ? num : SIZE_MAX);
}

/* The array in a file that lives as long as the question, without a name but that of its
 * descriptor, which readers of files open like any other. */
static pspec_status write_array(pspec_question *self, ps_option_id id, const pspec_field *array,
                                ps_error *error) {
    void *files = self->arrays;
    FILE *file = NULL;
    PS_TRY(ps_grow(&files, &self->arrays_capacity, self->num_arrays + 1, sizeof *self->arrays,
                   "arrays of options", error));
    self->arrays = files;
    PS_TRY(ps_temporary_open(&file, error));
    self->arrays[self->num_arrays++] = file;
    if (id == PS_OPTION_INTEGRAND) {
        write_npy(file, array);
    } else {
        write_rows(file, array);
    }
    return fflush(file) == 0 && !ferror(file)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO,
                         "%s: the array cannot be written to a temporary file",
                         ps_options[id].name);
}

static pspec_status set_array(pspec_question *self, const char *option, const pspec_field *array,
                              ps_error *error) {
    ps_option_id id = PS_NUM_OPTIONS;
    ps_text before = {0};
    ps_text value = {0};
    ps_text shown = {0};
    PS_TRY(find_option(&id, self, option, error));
    if (ps_options[id].input == NULL || id == PS_OPTION_AGAINST) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s takes no array of numbers", option);
    }
    PS_TRY(check_array(array, option, error));
    PS_TRY(write_array(self, id, array, error));
    if (ps_options[id].input == ps_input_of_named) {
        ps_text_append(&before, "%s:file=", array->name != NULL ? array->name : "");
    }
    ps_text_append(&value, "%s/proc/self/fd/%d", ps_text_string(&before),
                   fileno(self->arrays[self->num_arrays - 1]));
    ps_text_append(&shown, "%s" PS_CALLER_POINTS, ps_text_string(&before));
    pspec_status status = ps_text_check(before.failed || shown.failed ? &shown : &value, error);
    if (status == PSPEC_OK) {
        status = apply(self, id, ps_text_string(&value), ps_text_string(&shown), error);
    }
    ps_text_free(&before);
    ps_text_free(&value);
    ps_text_free(&shown);
    return status;
}

pspec_status pspec_question_set_array(pspec_question *question, const char *option,
                                      const pspec_field *array) {
    return question == NULL ? PSPEC_ERROR_INVALID_ARGUMENT
                            : set_array(question, option, array, &question->context->error);
}

/* ---- integrands -------------------------------------------------------------------------- */

static pspec_status ask_values(void *payload, size_t num, unsigned dimension, const double *points,
                               double *values, ps_error *error) {
    const ps_caller_integrand *const self = payload;
    const int status = self->values(num, dimension, points, values, self->payload);
    return status == 0 ? PSPEC_OK
                       : ps_fail(error, PSPEC_ERROR_INPUT,
                                 "the function of an integrand gave no values (%d)", status);
}

static pspec_status add_integrand(pspec_question *self, const char *name, double integral,
                                  const ps_caller_integrand *integrand, ps_error *error) {
    ps_option_id id = PS_NUM_OPTIONS;
    const size_t i = self->num_integrands;
    const char *word = name;
    PS_TRY(find_option(&id, self, ps_options[PS_OPTION_INTEGRAND].name, error));
    if (name == NULL || name[0] == '\0' || integrand->values == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "an integrand has a name and a function of its values");
    }
    PS_TRY(apply(self, id, name, NULL, error)); /* refuses too many */
    PS_TRY(keep_text(self, &word, error));
    self->integrands[i] = *integrand;
    self->given[i] = (ps_given_integrand){
        .name = word, .integral = integral, .values = ask_values, .payload = &self->integrands[i]};
    self->num_integrands++;
    self->request.integrands_given = (ps_given_integrands){self->given, self->num_integrands};
    return PSPEC_OK;
}

pspec_status pspec_question_integrand(pspec_question *question, const char *name, double integral,
                                      pspec_values values, void *payload) {
    const ps_caller_integrand integrand = {values, payload};
    return question == NULL
               ? PSPEC_ERROR_INVALID_ARGUMENT
               : add_integrand(question, name, integral, &integrand, &question->context->error);
}
