#include "engines/late_rows.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

pspec_status ps_late_rows_create(ps_late_rows *out, ps_device *device, ps_error *error) {
    size_t entries = 0;
    if (!ps_size_multiply(2 * out->batch, out->num, &entries)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu degrees are too many",
                       out->batch, out->num);
    }
    PS_TRY(PS_NEW(&out->rows, entries, "the powers of a batch", error));
    PS_TRY(PS_NEW(&out->numbers, PS_READINGS * 2 * out->most, "scales", error));
    for (size_t i = 0; i < PS_READINGS; i++) {
        out->parts[i].scales = out->numbers + 2 * i * out->most;
        out->parts[i].squares = out->parts[i].scales + out->most;
    }
    return ps_readings_create(device, &out->readings, out->most * out->sum_bytes,
                              "powers of a batch", error);
}

void ps_late_rows_free(ps_late_rows *late) {
    ps_readings_release(&late->readings);
    free(late->rows);
    free(late->numbers);
    *late = (ps_late_rows){0};
}

static double *rows_of(const ps_late_rows *self, uint64_t run) {
    return self->rows + run % 2 * self->batch * self->num;
}

/* Of the earliest part that is read. */
static pspec_status make_rows(ps_late_rows *self, ps_error *error) {
    const ps_late_part *const part = &self->parts[self->num_made++ % PS_READINGS];
    double *const rows = rows_of(self, part->run) + part->first * self->num;
    const void *sums = NULL;
    PS_TRY(ps_readings_take(&self->readings, &sums, error));
    for (size_t r = 0; r < part->num; r++) {
        self->make(self->engine, (const char *)sums + r * self->sum_bytes, part->scales[r],
                   part->squares[r], rows + r * self->num);
    }
    return PSPEC_OK;
}

pspec_status ps_late_rows_read(ps_late_rows *late, const ps_buffer *sums, size_t first, size_t num,
                               const double *scales, const double *squares, ps_error *error) {
    ps_late_part *const part = &late->parts[late->num_read % PS_READINGS];
    late->num_runs += first == 0 ? 1 : 0;
    PS_TRY(ps_readings_begin(&late->readings, sums, num * late->sum_bytes, error));
    late->num_read++;
    part->run = late->num_runs;
    part->first = first;
    part->num = num;
    memcpy(part->scales, scales, num * sizeof *scales);
    if (squares != NULL) {
        memcpy(part->squares, squares, num * sizeof *squares);
    }
    return late->num_read - late->num_made > 1 ? make_rows(late, error) : PSPEC_OK;
}

ps_rows ps_late_rows_give(ps_late_rows *late, size_t num_rows) {
    return (ps_rows){.num_rows = num_rows,
                     .stride = late->num,
                     .precision = PS_DOUBLE,
                     .late = late,
                     .run = late->num_runs};
}

pspec_status ps_rows_wait(ps_rows *rows, ps_error *error) {
    ps_late_rows *const late = rows->late;
    if (late == NULL) {
        return PSPEC_OK;
    }
    rows->late = NULL;
    rows->host = rows_of(late, rows->run);
    return rows->run == late->num_runs && late->num_read > late->num_made ? make_rows(late, error)
                                                                          : PSPEC_OK;
}
