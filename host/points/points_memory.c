/* Sets that a caller of the library has in memory, or makes (ps_given_set): rows are copied from
 * its views to where points stay. */
#include "base/memory.h"
#include "points/points_format.h"

#include <stdint.h>
#include <string.h>

enum { VECTOR_NUMBERS = 3 };

typedef struct memory_state {
    pspec_pattern view;
    uint64_t call, realization; /* of the view; call 0: there is none yet */
} memory_state;

/* Has every set what the first one has? What is not there, or in no space, is refused. */
static pspec_status check_view(const ps_point_reader *reader, ps_error *error) {
    const pspec_pattern *const view = &((const memory_state *)reader->state)->view;
    const char *const name = reader->input.name;
    const unsigned long long set = (unsigned long long)reader->num_sets + 1;
    const unsigned most =
        reader->options.domain == PS_DOMAIN_SPHERE ? VECTOR_NUMBERS : PS_MAX_DIMENSION;
    const bool has_weights = view->weights != NULL;
    if (view->num_points == 0 || view->points == NULL) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: set %llu has no points", name, set);
    }
    if (view->num_points < reader->rows_in_set) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: set %llu has %zu points, and had more before",
                       name, set, view->num_points);
    }
    if (view->dimension == 0 || view->dimension > most) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: set %llu has dimension %u, not 1 to %u", name,
                       set, view->dimension, most);
    }
    return reader->columns == 0 || (reader->columns == view->dimension + has_weights &&
                                    reader->options.weight_column == has_weights)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: set %llu has dimension %u%s, and the first one has %u%s", name, set,
                         view->dimension, has_weights ? " and weights" : "",
                         reader->columns - reader->options.weight_column,
                         reader->options.weight_column ? " and weights" : "");
}

/* Makes the view one of the set that the reader is in: another reader may have asked since. */
static pspec_status ask(ps_point_reader *reader, bool *has_set, ps_error *error) {
    ps_given_set *const given = reader->given;
    memory_state *const state = reader->state;
    const uint64_t realization = reader->num_sets;
    *has_set = given->most == 0 || realization < given->most;
    if (!*has_set ||
        (state->call > 0 && state->call == given->num_calls && state->realization == realization)) {
        return PSPEC_OK;
    }
    state->view = (pspec_pattern){0};
    state->call = ++given->num_calls;
    state->realization = realization;
    PS_TRY(given->next(given->payload, realization, &state->view, has_set, error));
    return *has_set ? check_view(reader, error) : PSPEC_OK;
}

/* Weights are apart here, and in the columns of a file the last one. */
static pspec_status open_memory(ps_point_reader *reader, ps_error *error) {
    bool has_set = false;
    PS_TRY(ps_allocate(&reader->state, 1, sizeof(memory_state), "a reader of given sets", error));
    PS_TRY(ask(reader, &has_set, error));
    const pspec_pattern *const view = &((const memory_state *)reader->state)->view;
    const bool has_weights = view->weights != NULL;
    if (!has_set) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s holds no points", reader->input.name);
    }
    if (reader->options.weight_column && !has_weights) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s: --weights column, and set 1 has no weights",
                       reader->input.name);
    }
    reader->options.weight_column = has_weights;
    reader->columns = view->dimension + has_weights;
    reader->rows_per_set = view->num_points;
    return PSPEC_OK;
}

static void copy_rows(const ps_point_reader *reader, ps_rows_read *out) {
    const pspec_pattern *const view = &((const memory_state *)reader->state)->view;
    const unsigned dimension = view->dimension;
    const double *const points = view->points + reader->rows_in_set * dimension;
    if (view->weights == NULL) {
        memcpy(out->rows, points, out->num * dimension * sizeof *points);
        return;
    }
    for (size_t j = 0; j < out->num; j++) {
        double *const row = out->rows + j * reader->columns;
        memcpy(row, points + j * dimension, dimension * sizeof *points);
        row[dimension] = view->weights[reader->rows_in_set + j];
    }
}

/* Whether another set follows is asked when its turn comes, for that ends the view of this one. */
static pspec_status read_memory(ps_point_reader *reader, ps_rows_read *out, ps_error *error) {
    bool has_set = false;
    PS_TRY(ask(reader, &has_set, error));
    if (!has_set) {
        out->end = PS_END_OF_INPUT;
        return PSPEC_OK;
    }
    reader->rows_per_set = ((const memory_state *)reader->state)->view.num_points;
    const size_t left = reader->rows_per_set - reader->rows_in_set;
    out->num = left < out->capacity ? left : out->capacity;
    out->end = out->num == left ? PS_END_OF_SET : PS_MORE_ROWS;
    if (out->rows == NULL) { /* as points_read.c asks where they may stay */
        const pspec_pattern *const view = &((const memory_state *)reader->state)->view;
        out->rows = (double *)(uintptr_t)(view->points + reader->rows_in_set * view->dimension);
    } else {
        copy_rows(reader, out);
    }
    return PSPEC_OK;
}

const ps_point_format ps_format_memory = {
    .name = "memory", .open = open_memory, .read = read_memory};
