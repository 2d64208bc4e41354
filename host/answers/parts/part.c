/* One part of a job, and what parts are merged to. */
#include "answers/parts/parts.h"

#include "answers/checkpoints.h"
#include "files/output_file.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* ---- one of them ----------------------------------------------------------------------------- */

/* Its numbers stand before the ending. */
static pspec_status name_checkpoint(ps_text *out, const char *path, uint64_t num_parts,
                                    uint64_t part, ps_error *error) {
    const char *const ending = ps_output_ending(path);
    ps_text_append_bytes(out, path, strlen(path) - strlen(ending)); /* which need not be of path */
    ps_text_append(out, "-part-%" PRIu64 "-of-%" PRIu64 "%s", part + 1, num_parts, ending);
    return ps_text_check(out, error);
}

pspec_status ps_part_begin(ps_part *out, const ps_kind *kind, const ps_request *request,
                           uint64_t num_realizations, uint64_t num_parts, uint64_t part,
                           const ps_answer_hooks *hooks, ps_error *error) {
    ps_request *const own = &out->request;
    *out = (ps_part){.request = *request};
    own->range = ps_parts_range(num_realizations, num_parts, part);
    own->range.first += request->range.first;
    own->range.end += request->range.first;
    own->wants_state = true;
    own->is_given[PS_OPTION_RANGE] = true;
    own->said[PS_OPTION_RANGE] = out->range;
    snprintf(out->range, sizeof out->range, "%" PRIu64 ":%" PRIu64, own->range.first,
             own->range.end);
    if (own->limits.checkpoint.path == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(name_checkpoint(&out->checkpoint, own->limits.checkpoint.path, num_parts, part, error));
    own->limits.checkpoint.path = ps_text_string(&out->checkpoint);
    return ps_answer_begin_checkpoints(own, kind, &out->key, hooks, error);
}

void ps_part_end(ps_part *part, bool is_written) {
    if (is_written) {
        ps_answer_end_checkpoints(&part->request);
    }
    ps_text_free(&part->checkpoint);
    ps_text_free(&part->key);
    *part = (ps_part){0};
}

/* ---- all of them ----------------------------------------------------------------------------- */

pspec_status ps_parts_merge(ps_answer *out, const ps_request *request,
                            const ps_table *const *tables, const char *const *names, size_t num,
                            ps_error *error) {
    const ps_parts merged = {.tables = tables,
                             .names = names,
                             .num = num,
                             .command_line = request->command_line,
                             .request = request};
    return ps_answer_merge(out, &merged, error);
}

pspec_status ps_parts_finish(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             const ps_table *const *tables, const char *const *names, size_t num,
                             const ps_answer_hooks *hooks, ps_error *error) {
    ps_request own = *request;
    ps_table_format format = PS_FORMAT_CSV;
    *out = (ps_answer){0};
    PS_TRY(ps_table_choose_format(&format, own.format, own.output, error));
    own.wants_state = own.wants_state || format == PS_FORMAT_NPZ;
    PS_TRY(ps_parts_merge(out, &own, tables, names, num, error));
    return ps_answer_write(out, kind, &own, format, hooks, error);
}
