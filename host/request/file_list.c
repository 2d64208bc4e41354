#include "request/file_list.h"

#include "base/memory.h"
#include "base/text.h"
#include "request/options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static pspec_status add_matches(ps_file_list *out, const char *pattern, int flags,
                                const char *shown, ps_error *error) {
    const int appends = out->found.gl_pathc > 0 ? GLOB_APPEND : 0;
    const int code = glob(pattern, flags | appends, NULL, &out->found);
    if (code == GLOB_NOSPACE) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for the names of files of %s", shown);
    }
    return code == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s: no file matches \"%s\"", shown, pattern);
}

/* A name without a pattern is taken as it is: whoever opens the file says what is wrong with it. */
pspec_status ps_file_list_add(ps_file_list *list, const char *shown, const char *item,
                              ps_error *error) {
    if (item[0] == '\0' || strcmp(item, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: %s", shown,
                       item[0] == '\0' ? "a name of a file is empty"
                                       : "standard input (-) is no file, and a set is of files");
    }
    const bool is_name = strpbrk(item, "*?[") == NULL || access(item, F_OK) == 0;
    const int flags = is_name ? GLOB_NOCHECK | GLOB_NOESCAPE : 0;
    const pspec_status status = add_matches(list, item, flags, shown, error);
    list->num = list->found.gl_pathc;
    list->paths = (const char *const *)list->found.gl_pathv;
    return status;
}

pspec_status ps_file_list_read(ps_file_list *out, const char *shown, const char *text,
                               ps_error *error) {
    pspec_status status = PSPEC_OK;
    *out = (ps_file_list){0};
    for (const char *begin = text; begin != NULL && status == PSPEC_OK;) {
        const char *const comma = strchr(begin, ',');
        ps_text item = {0};
        ps_text_append_bytes(&item, begin, comma != NULL ? (size_t)(comma - begin) : strlen(begin));
        status = ps_text_check(&item, error);
        if (status == PSPEC_OK) {
            status = ps_file_list_add(out, shown, ps_text_string(&item), error);
        }
        ps_text_free(&item);
        begin = comma != NULL ? comma + 1 : NULL;
    }
    return status;
}

void ps_file_list_free(ps_file_list *list) {
    globfree(&list->found);
    *list = (ps_file_list){0};
}

/* ---- of questions -------------------------------------------------------------------------- */

pspec_status ps_file_list_of_question(ps_file_list *out, const ps_request *request, size_t question,
                                      ps_error *error) {
    enum { BYTES = PS_SET_NAME_BYTES + 32 };
    char shown[BYTES];
    *out = (ps_file_list){.num = request->num_files, .paths = request->files};
    if (request->num_sources == 0) {
        return PSPEC_OK;
    }
    const ps_source_words *const source = &request->sources[question / request->num_counts];
    if (source->files == NULL) {
        *out = (ps_file_list){0};
        return PSPEC_OK;
    }
    snprintf(shown, sizeof shown, "%s %s", ps_option_show(request, PS_OPTION_SET).text,
             source->name);
    return ps_file_list_read(out, shown, source->files, error);
}

pspec_status ps_file_lists_make(ps_file_list **out, const ps_request *request, ps_error *error) {
    const size_t num = ps_request_num_questions(request);
    PS_TRY(PS_NEW(out, num, "lists of files", error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_file_list_of_question(&(*out)[i], request, i, error));
    }
    return PSPEC_OK;
}

void ps_file_lists_free(ps_file_list *lists, size_t num) {
    for (size_t i = 0; lists != NULL && i < num; i++) {
        ps_file_list_free(&lists[i]);
    }
    free(lists);
}
