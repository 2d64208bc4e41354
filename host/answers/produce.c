/* What a command that prints a kind of answer does, and a public function that answers one: refuse
 * early, compute, write. */
#include "answers/checkpoints.h"
#include "answers/kept_rows.h"
#include "answers/output_check.h"
#include "answers/picture.h"
#include "base/text.h"
#include "images/image.h"
#include "points/lists/weight_list.h"
#include "request/options.h"

#include <stddef.h>
#include <string.h>

/* ---- before ------------------------------------------------------------------------------ */

pspec_status ps_answer_check_outputs(ps_table_format *format, const ps_kind *kind,
                                     const ps_request *request, const ps_answer_hooks *hooks,
                                     ps_error *error) {
    if (kind->check_arguments != NULL) {
        PS_TRY(kind->check_arguments(request, error));
    }
    PS_TRY(ps_picture_check(request, ps_picture_is_all(request, true), hooks, error));
    PS_TRY(ps_outputs_check(request, true, error));
    PS_TRY(ps_table_choose_format(format, request->format, request->output, error));
    if (kind->has_words && *format == PS_FORMAT_NPY) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "verdicts are no numbers: .csv, .json and .npz, not .npy");
    }
    return PSPEC_OK;
}

/* ---- after ------------------------------------------------------------------------------- */

static pspec_status mark_repeated(const ps_field_row *row, void *table, ps_error *error) {
    (void)error;
    if (row->group == PS_FIELD_ENTRY && row->is_repeated) {
        ps_table_set_repeated(table, row->name);
    }
    return PSPEC_OK;
}

/* Files of arrays that options ask for; suffix stands before the ending. */
static const struct array_file {
    size_t offset; /* of the path in ps_request */
    const char *suffix, *field;
} array_files[] = {{offsetof(ps_request, full), "", "full"},
                   {offsetof(ps_request, full), ".standard_error", "full_standard_error"},
                   {offsetof(ps_request, coefficients), "", "coefficients"},
                   {offsetof(ps_request, weights_out), "", "weights"},
                   {offsetof(ps_request, image_out), "", "image"}};
enum { NUM_ARRAY_FILES = sizeof array_files / sizeof array_files[0] };

/* Weights may be lines of text, too, and an image may be PFM. */
static pspec_status write_array(const char *path, const ps_npy_array *array, ps_error *error) {
    if (strcmp(ps_output_ending(path), ".pfm") == 0) {
        return ps_image_write_pfm(path, array->shape[1], array->shape[0], array->data, error);
    }
    return array->rank == 1 && !array->is_complex ? ps_write_weights(path, array, error)
                                                  : ps_npy_write_array(path, array, error);
}

static pspec_status write_arrays(const ps_table *table, const ps_request *request,
                                 ps_error *error) {
    for (size_t i = 0; i < NUM_ARRAY_FILES; i++) {
        const struct array_file *const file = &array_files[i];
        const char *asked = NULL;
        ps_text path = {0};
        memcpy(&asked, (const char *)request + file->offset, sizeof asked);
        const ps_npy_array *const array = ps_table_find_array(table, file->field);
        if (asked == NULL || array == NULL) {
            continue;
        }
        const char *const ending = ps_output_ending(asked);
        ps_text_append_bytes(&path, asked, (size_t)(ending - asked));
        ps_text_append(&path, "%s%s", file->suffix, ending);
        pspec_status status = ps_text_check(&path, error);
        if (status == PSPEC_OK) {
            status = write_array(ps_text_string(&path), array, error);
        }
        ps_text_free(&path);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

pspec_status ps_answer_write(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             ps_table_format format, const ps_answer_hooks *hooks,
                             ps_error *error) {
    PS_TRY(write_arrays(out->table, request, error));
    PS_TRY(ps_kind_visit_fields(kind, mark_repeated, out->table, error));
    if (request->output != NULL) {
        ps_table_set_view(out->table, &request->view);
        PS_TRY(ps_table_write(out->table, request->output, format, error));
    }
    return request->plot == NULL
               ? PSPEC_OK
               : ps_picture_settle(request, ps_picture_is_all(request, true), hooks,
                                   ps_picture_draw(kind->pictures, request, out->table, error),
                                   error);
}

pspec_status ps_answer_produce(ps_answer *out, const ps_kind *kind, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error) {
    void *mine = NULL;
    void **const kept = hooks->kept != NULL && kind->renews ? hooks->kept : &mine;
    ps_table_format format = PS_FORMAT_CSV;
    ps_request own = *request;
    ps_text key = {0};
    ps_row_tape tape;
    const bool is_led_here = ps_team_is_led_here(hooks->team);
    *out = (ps_answer){0};
    PS_TRY(is_led_here ? ps_answer_check_outputs(&format, kind, request, hooks, error) : PSPEC_OK);
    own.limits.checkpoint.team = hooks->team;
    own.wants_state =
        request->wants_state || format == PS_FORMAT_NPZ || request->is_given[PS_OPTION_RANGE];
    pspec_status status = ps_kept_rows_begin(&tape, &own, kind, error);
    if (status == PSPEC_OK) {
        status = ps_answer_begin_checkpoints(&own, kind, &key, hooks, error);
    }
    if (status == PSPEC_OK) {
        status = kind->compute(kept, &own, hooks, error);
    }
    ps_answer_end(hooks);
    if (status == PSPEC_OK) { /* checkpoints are there until all have read them */
        status = ps_team_meet(hooks->team, status, error);
    }
    if (status == PSPEC_OK && is_led_here) {
        status = kind->tabulate(out, *kept, &own, error);
    }
    if (status == PSPEC_OK && is_led_here) {
        status = ps_kept_rows_add(out->table, &own, error);
    }
    if (status == PSPEC_OK && is_led_here) {
        status = ps_answer_write(out, kind, &own, format, hooks, error);
    }
    if (status == PSPEC_OK && is_led_here) {
        ps_answer_end_checkpoints(&own);
    }
    ps_text_free(&key);
    ps_row_tape_free(&tape);
    if (status != PSPEC_OK || kept == &mine) {
        kind->discard(*kept);
        *kept = NULL;
    }
    return status;
}

pspec_status ps_answer_merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    const char *const name = ps_table_command(parts->tables[0]);
    size_t i = 0;
    *out = (ps_answer){0};
    while (ps_kinds[i] != NULL && strcmp(ps_kinds[i]->name, name) != 0) {
        i++;
    }
    if (ps_kinds[i] == NULL || ps_kinds[i]->merge == NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is an answer of %s, and these are not merged",
                       parts->names[0], name);
    }
    for (size_t p = 1; p < parts->num; p++) {
        const char *const other = ps_table_command(parts->tables[p]);
        if (strcmp(other, name) != 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s is an answer of %s instead of %s",
                           parts->names[p], other, name);
        }
    }
    ps_parts own = *parts;
    own.kind = ps_kinds[i];
    PS_TRY(ps_kinds[i]->merge(out, &own, error));
    return ps_kind_visit_fields(ps_kinds[i], mark_repeated, out->table, error);
}
