/* Names of files as an option has them, "a.dat,b*.dat": a list with commas, of names and patterns. */
#ifndef PS_REQUEST_FILE_LIST_H
#define PS_REQUEST_FILE_LIST_H

#include "request/request.h"

/* {0}: none. */
typedef struct ps_file_list {
    size_t num;
    const char *const *paths;
    char **owned; /* [capacity], the paths; NULL: they are borrowed */
    size_t capacity;
} ps_file_list;

/* A pattern with *, ? or [..] stands for the files that match it, in the order of their names; a
 * name need not be that of a file, and "-" is standard input. shown: of the option, for sentences.
 * Freed by ps_file_list_free, also after an error. */
pspec_status ps_file_list_read(ps_file_list *out, const char *shown, const char *text,
                               ps_error *error) PS_MUST_CHECK;
/* One name or pattern more, in a folder, "" or with its /; a comma is a letter of it. */
pspec_status ps_file_list_add(ps_file_list *list, const char *shown, const char *folder,
                              const char *item, ps_error *error) PS_MUST_CHECK;
void ps_file_list_free(ps_file_list *list);

/* The files that a question is about: those of its set, or those of the request. None: a sampler
 * makes its points. */
pspec_status ps_file_list_of_question(ps_file_list *out, const ps_request *request, size_t question,
                                      ps_error *error) PS_MUST_CHECK;

/* One list for each question; a file is in one set and once, whatever its names are. */
pspec_status ps_file_lists_make(ps_file_list **out, const ps_request *request,
                                ps_error *error) PS_MUST_CHECK;
void ps_file_lists_free(ps_file_list *lists, size_t num);

/* Is the file a table as CSV or JSON, or one beside NPY, that the program or the library saved?
 * Standard input, pipes and what is not there are none. */
pspec_status ps_saved_result_find(bool *is_one, const char *path, ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_INPUT where it is one, with what it is of, and what variances need, in the sentence.
 */
pspec_status ps_saved_result_refuse(const char *path, ps_error *error) PS_MUST_CHECK;

#endif
