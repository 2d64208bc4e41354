/* Which files a request reads, and which it writes. */
#include "request/file_list.h"
#include "request/options.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* The texts of the option in the request; *num is 0 where it was not given. */
static const char *const *find_texts(size_t *num, const ps_request *request,
                                     const ps_option *option) {
    const char *const fields = (const char *)request;
    const char *const *const texts = (const void *)(fields + option->offset);
    *num = texts[0] != NULL;
    if (option->offset_of_number > 0) {
        memcpy(num, fields + option->offset_of_number, sizeof *num);
    }
    return texts;
}

pspec_status ps_input_keep(ps_text *out, ps_option_input *find, const char *path, ps_error *error) {
    ps_text_append_bytes(out, path, strcspn(path, find == ps_input_of_named ? "," : ""));
    return ps_text_check(out, error);
}

static pspec_status visit_option(const ps_request *request, ps_option_id id,
                                 ps_request_visit_input *visit, void *payload, ps_error *error) {
    const ps_option *const option = &ps_options[id];
    size_t num = 0;
    const char *const *const texts = find_texts(&num, request, option);
    for (size_t i = 0; i < num; i++) {
        const char *const path = option->input(option->metavar, texts[i]);
        ps_text own = {0};
        if (path == NULL) {
            continue;
        }
        pspec_status status = ps_input_keep(&own, option->input, path, error);
        if (status == PSPEC_OK) {
            const ps_request_file input = {ps_option_show(request, id), ps_text_string(&own)};
            status = visit(payload, &input, error);
        }
        ps_text_free(&own);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

static void add_output(ps_request_file *out, size_t *num, const ps_request *request,
                       ps_option_id id) {
    size_t has_text = 0;
    if (ps_options[id].is_output) {
        const char *const *const text = find_texts(&has_text, request, &ps_options[id]);
        out[*num] = (ps_request_file){ps_option_show(request, id), text[0]};
        *num += has_text;
    }
}

size_t ps_request_outputs(ps_request_file out[PS_NUM_OPTIONS], const ps_request *request) {
    size_t num = 0;
    add_output(out, &num, request, PS_OPTION_OUTPUT);
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (id != PS_OPTION_OUTPUT) {
            add_output(out, &num, request, (ps_option_id)id);
        }
    }
    return num;
}

static pspec_status visit_list(const ps_file_list *list, const ps_given_sets *given,
                               const char *shown, ps_request_visit_input *visit, void *payload,
                               ps_error *error) {
    for (size_t i = 0; i < list->num; i++) {
        ps_request_file input = {.path = list->paths[i]};
        snprintf(input.option.text, sizeof input.option.text, "%s", shown);
        if (ps_given_sets_find(given, input.path) == NULL) {
            PS_TRY(visit(payload, &input, error));
        }
    }
    return PSPEC_OK;
}

/* Files of sets, and those without an option. */
static pspec_status visit_points(const ps_request *request, ps_request_visit_input *visit,
                                 void *payload, ps_error *error) {
    const ps_shown_option set = ps_option_show(request, PS_OPTION_SET);
    const ps_file_list alone = {.num = request->num_files, .paths = request->files};
    for (size_t i = 0; i < request->num_sources; i++) {
        ps_file_list list;
        pspec_status status =
            ps_file_list_of_question(&list, request, i * request->num_counts, error);
        if (status == PSPEC_OK) {
            status = visit_list(&list, &request->reading.given, set.text, visit, payload, error);
        }
        ps_file_list_free(&list);
        PS_TRY(status);
    }
    return visit_list(&alone, &request->reading.given, "the input", visit, payload, error);
}

pspec_status ps_request_visit_option_inputs(const ps_request *request,
                                            ps_request_visit_input *visit, void *payload,
                                            ps_error *error) {
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        if (ps_options[id].input != NULL) {
            PS_TRY(visit_option(request, (ps_option_id)id, visit, payload, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_request_visit_inputs(const ps_request *request, ps_request_visit_input *visit,
                                     void *payload, ps_error *error) {
    PS_TRY(ps_request_visit_option_inputs(request, visit, payload, error));
    return visit_points(request, visit, payload, error);
}

bool ps_request_file_comes_once(const ps_request_file *input) {
    struct stat facts;
    return strcmp(input->path, "-") == 0 || ps_points_program(input->path) != NULL ||
           (stat(input->path, &facts) == 0 && !S_ISREG(facts.st_mode));
}
