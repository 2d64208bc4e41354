/* Making the engine of an estimator, and making it anew. */
#include "jobs/estimator_private.h"

#include "engines/error_units.h"

/* ---- rows of powers that are added later than they were launched ----------------------------- */

static pspec_status add_rows(ps_estimator *self, ps_rows *rows, ps_error *error) {
    PS_TRY(ps_rows_wait(rows, error));
    PS_TRY(ps_accumulator_add(self->accumulator, rows, self->units, error));
    if (self->options.want_c2) {
        ps_pair_sums_add(&self->c2, rows, self->slots);
    }
    return PSPEC_OK;
}

/* Patterns of late rows have gone: nobody may try again with fewer realizations. */
pspec_status ps_estimator_add_pending(ps_estimator *self, ps_error *error) {
    const bool is_late = self->pending.late != NULL;
    ps_rows rows = self->pending;
    self->pending = (ps_rows){0};
    const pspec_status status = rows.num_rows > 0 ? add_rows(self, &rows, error) : PSPEC_OK;
    return status == PSPEC_ERROR_MEMORY && is_late ? PSPEC_ERROR_DEVICE : status;
}

/* ---- the engine ------------------------------------------------------------------------------ */

/* Makes the engine anew for self->batch realizations. */
static pspec_status create_engine(ps_estimator *self, ps_error *error) {
    const ps_estimator_options *options = &self->options;
    ps_engine_destroy(options->engine, self->engine_state);
    self->engine_state = NULL;
    const ps_problem own = ps_engine_problem(options->engine, &options->problem);
    return ps_engine_create(options->engine, &self->engine_state, &own, options->precision,
                            self->batch, self->device, error);
}

void ps_estimator_halve_batch(ps_estimator *self) {
    self->batch /= 2;
    ps_log_say(&self->options.log, "memory was refused: %zu realizations at a time instead",
               self->batch);
}

pspec_status ps_estimator_make_engine(ps_estimator *self, ps_error *error) {
    PS_TRY(ps_estimator_add_pending(self, error)); /* they are the engine's */
    for (;;) {
        const pspec_status status = create_engine(self, error);
        if (status != PSPEC_ERROR_MEMORY || self->batch == 1) {
            return status;
        }
        ps_estimator_halve_batch(self);
    }
}

static pspec_status enlarge(ps_estimator *self, uint64_t num_points, ps_error *error) {
    ps_log_say(
        &self->options.log, "a pattern has %llu points, more than %llu: the engine is made anew",
        (unsigned long long)num_points, (unsigned long long)self->options.problem.num_points);
    self->options.problem.num_points = num_points;
    return ps_estimator_make_engine(self, error);
}

pspec_status ps_estimator_get_ready(ps_estimator *self, uint64_t num_points, ps_error *error) {
    if (num_points > self->options.problem.num_points) {
        return enlarge(self, num_points, error);
    }
    return self->engine_state == NULL
               ? ps_estimator_make_engine(self, error) /* refused before a reset */
               : PSPEC_OK;
}
