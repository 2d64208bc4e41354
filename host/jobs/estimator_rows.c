/* Rows of powers that an estimator adds later than they were launched. */
#include "jobs/estimator_private.h"

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
