#include "verify/bench/bench.h"

#include "base/memory.h"
#include "base/text.h"
#include "plots/plot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

pspec_status ps_bench_rows_add(ps_bench_rows *list, const ps_bench_row *rows, size_t num,
                               ps_error *error) {
    void *memory = list->rows;
    PS_TRY(ps_grow(&memory, &list->capacity, list->num + num, sizeof *rows, "rows", error));
    list->rows = memory;
    for (size_t i = 0; i < num; i++) {
        list->rows[list->num++] = rows[i];
    }
    return PSPEC_OK;
}

void ps_bench_rows_free(ps_bench_rows *rows) {
    free(rows->rows);
    *rows = (ps_bench_rows){0};
}

/* ---- panels -------------------------------------------------------------------------------- */

/* The referee has its error from its formula: it is not off from itself. */
static double error_of(const ps_bench_row *row) {
    return row->error > 0 ? row->error : row->predicted_error;
}

/* An engine in two precisions is a pair of kinds: one colour, filled and hollow marks. */
static size_t kind_of(const ps_bench_row *row) {
    size_t engine = 0;
    while (ps_engines[engine] != row->engine && ps_engines[engine] != NULL) {
        engine++;
    }
    return 2 * engine + (row->precision == PS_DOUBLE ? 1 : 0);
}

static int compare_seconds(const void *a, const void *b) {
    const double x = (*(const ps_bench_row *const *)a)->seconds;
    const double y = (*(const ps_bench_row *const *)b)->seconds;
    return x < y ? -1 : x > y;
}

/* Rows of a case by time, and the series that are made of them. */
typedef struct drawing {
    const ps_bench_row **sorted;
    size_t num, num_series;
    ps_series *series;
    ps_pool *memory;
    ps_error *error;
} drawing;

/* Of rows of a kind, or of those of the front; none without any. */
static pspec_status add_series(drawing *self, size_t kind, bool is_front) {
    double *numbers = NULL;
    const ps_bench_row *last = NULL;
    ps_text label = {0};
    PS_TRY(PS_POOL_NEW(self->memory, &numbers, 2 * self->num, "a picture", self->error));
    ps_series *const own = &self->series[self->num_series];
    *own = (ps_series){.kind = kind,
                       .look = is_front ? PS_LOOK_FRONT : PS_LOOK_SIGNS,
                       .label = "Pareto front",
                       .x = numbers,
                       .y = numbers + self->num};
    for (size_t i = 0; i < self->num; i++) {
        const ps_bench_row *const row = self->sorted[i];
        if (is_front ? row->is_pareto : kind_of(row) == kind) {
            numbers[own->num] = row->seconds;
            numbers[self->num + own->num++] = error_of(row);
            last = row;
        }
    }
    self->num_series += last != NULL;
    if (last == NULL || is_front) {
        return PSPEC_OK;
    }
    ps_text_append(&label, "%s, %s", last->engine->name, ps_precision_name(last->precision));
    return ps_text_keep(&own->label, self->memory, &label, self->error);
}

/* The front comes first, below. */
static pspec_status make_panel(ps_panel *out, ps_pool *memory, const ps_bench_row *rows, size_t num,
                               ps_error *error) {
    enum { NUM_KINDS = 2 * PS_FIGURES_ENGINES };
    drawing self = {.num = num, .memory = memory, .error = error};
    PS_TRY(PS_POOL_NEW(memory, &self.sorted, num, "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &self.series, NUM_KINDS + 1, "a picture", error));
    for (size_t i = 0; i < num; i++) {
        self.sorted[i] = &rows[i];
    }
    qsort(self.sorted, num, sizeof *self.sorted, compare_seconds);
    PS_TRY(add_series(&self, 0, true));
    for (size_t kind = 0; kind < NUM_KINDS; kind++) {
        PS_TRY(add_series(&self, kind, false));
    }
    *out = (ps_panel){
        .title = rows[0].what->name, .num_series = self.num_series, .series = self.series};
    return PSPEC_OK;
}

static size_t count_of_case(const ps_bench_rows *measured, size_t first) {
    size_t num = 1;
    while (first + num < measured->num &&
           measured->rows[first + num].what == measured->rows[first].what) {
        num++;
    }
    return num;
}

static size_t count_panels(const ps_bench_rows *measured) {
    size_t num = 0;
    for (size_t i = 0; i < measured->num; i += count_of_case(measured, i)) {
        num++;
    }
    return num;
}

static pspec_status make_figure(ps_figure *out, ps_pool *memory, const ps_bench_rows *measured,
                                const char *device, ps_error *error) {
    const size_t num = count_panels(measured);
    ps_panel *plots = NULL;
    ps_text title = {0};
    size_t at = 0;
    PS_TRY(PS_POOL_NEW(memory, &plots, num, "a picture", error));
    for (size_t i = 0; i < num; i++) {
        const size_t num_rows = count_of_case(measured, at);
        PS_TRY(make_panel(&plots[i], memory, measured->rows + at, num_rows, error));
        at += num_rows;
    }
    ps_text_append(&title, "run time against error, %s", device);
    *out = (ps_figure){.form = PS_FIGURE_PANELS,
                       .x_label = "seconds per realization",
                       .y_label = "error",
                       .is_log_x = true,
                       .is_log_y = true,
                       .num_panels = num,
                       .panels = plots};
    return ps_text_keep(&out->title, memory, &title, error);
}

pspec_status ps_bench_plot(const char *path, const ps_bench_rows *measured, const char *device,
                           ps_error *error) {
    ps_pool memory = {0};
    ps_figure figure;
    pspec_status status = make_figure(&figure, &memory, measured, device, error);
    if (status == PSPEC_OK) {
        status = ps_figure_write(path, &figure, error);
    }
    ps_pool_free(&memory);
    return status;
}
