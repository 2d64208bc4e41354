#include "answers/ranges/row_ranges.h"

#include "answers/arguments.h"
#include "answers/kept_rows.h"
#include "answers/ranges/ranges.h"

#include <string.h>

/* ---- the question ---------------------------------------------------------------------------- */

/* Is there an array that the answer of the job has, too? */
static bool has_array(const ps_table *table) {
    bool is_state = true;
    const char *name = NULL;
    for (size_t i = 0; i < ps_table_num_arrays(table) && is_state; i++) {
        ps_table_array(table, i, &name, &is_state);
    }
    return !is_state;
}

/* That of all realizations, whose outputs are those of who merges. */
static void widen(ps_request *request, const ps_parts *parts) {
    request->range = (ps_realization_range){0};
    request->is_given[PS_OPTION_RANGE] = false;
    request->output = request->plot = request->image_out = NULL;
    request->limits.checkpoint.path = NULL;
    request->command_line = parts->command_line;
    request->wants_state = has_array(parts->tables[0]);
    request->limits.cache_folder = parts->cache_folder;
    if (!request->is_given[PS_OPTION_DEVICE]) {
        request->limits.device = parts->device;
    }
}

/* "pointspec KIND WORDS" */
static pspec_status ask(ps_request *out, const ps_parts *parts, ps_pool *memory, ps_error *error) {
    const char *const command = ps_ranges_command(parts->tables[0]);
    char **words = NULL;
    int num = 0;
    PS_TRY(ps_command_split(&words, &num, memory, command, error));
    if (num < 2 || strcmp(words[1], parts->kind->name) != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is of no command of %s, but of \"%.200s\"",
                       parts->names[0], parts->kind->name, command);
    }
    PS_TRY(ps_arguments_parse(out, parts->kind, num - 2, words + 2, error));
    widen(out, parts);
    return PSPEC_OK;
}

/* ---- the answer ------------------------------------------------------------------------------ */

/* Parts of a machine, or of a program, whose bits are others tell of it as the answer does. */
static pspec_status finish(ps_table *table, const ps_parts *parts, ps_error *error) {
    PS_TRY(ps_ranges_tell(table, parts, error));
    return ps_ranges_compare(table, parts->tables[0], parts->names[0], NULL, error);
}

static pspec_status read_all(ps_row_tape *tape, const ps_parts *parts, const ps_request *request,
                             ps_error *error) {
    uint64_t all = 0;
    for (size_t p = 0; p < parts->num; p++) {
        const char *const names[] = {parts->names[p > 0 ? p - 1 : 0], parts->names[p]};
        PS_TRY(ps_kept_rows_read(tape, &all, parts->tables[p], names, error));
        PS_TRY(ps_kept_rows_check_inputs(request, parts->tables[p], names[1], error));
    }
    tape->is_part = tape->range.first > 0 || tape->range.end < all;
    return PSPEC_OK;
}

/* parts: in the order of their realizations */
static pspec_status answer(ps_answer *out, const ps_parts *parts, ps_row_tape *tape,
                           ps_pool *memory, ps_error *error) {
    static const ps_answer_hooks none;
    ps_request request = ps_request_default;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ask(&request, parts, memory, error));
    PS_TRY_OUT(status, read_all(tape, parts, &request, error));
    request.limits.checkpoint.tape = tape;
    PS_TRY_OUT(status, ps_answer_make(out, parts->kind, &request,
                                      parts->hooks != NULL ? parts->hooks : &none, error));
    status = finish(out->table, parts, error);
out:
    ps_arguments_free(&request);
    return status;
}

static pspec_status merge(ps_answer *out, const ps_parts *parts, ps_row_tape *tape, ps_pool *memory,
                          ps_error *error) {
    ps_parts sorted;
    PS_TRY(ps_ranges_sort(&sorted, memory, parts, error));
    return answer(out, &sorted, tape, memory, error);
}

pspec_status ps_row_ranges_merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    ps_row_tape tape = {.is_played = true};
    ps_pool memory = {0};
    const pspec_status status = merge(out, parts, &tape, &memory, error);
    ps_row_tape_free(&tape);
    ps_pool_free(&memory);
    return status;
}
