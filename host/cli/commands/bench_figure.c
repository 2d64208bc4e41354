/* The picture of pointspec bench. */
#include "base/text.h"
#include "cli/command.h"
#include "engines/engine.h"

#include <string.h>

static double number_of(const ps_table *table, size_t row, const char *name) {
    return ps_cell_number(ps_table_find_cell(table, row, name));
}

static const char *text_of(const ps_table *table, size_t row, const char *name) {
    return ps_cell_text(ps_table_find_cell(table, row, name));
}

/* The referee has its error from its formula: it is not off from itself. */
static double error_of(const ps_table *table, size_t row) {
    const double measured = number_of(table, row, "error");
    return measured > 0 ? measured : number_of(table, row, "predicted_error");
}

/* An engine in two precisions is a pair of kinds: one colour, filled and hollow marks. */
static size_t kind_of(const ps_table *table, size_t row) {
    const char *const precision = text_of(table, row, "precision");
    size_t engine = 0;
    while (ps_engines[engine] != NULL &&
           strcmp(ps_engines[engine]->name, text_of(table, row, "engine")) != 0) {
        engine++;
    }
    return 2 * engine + (strcmp(precision, ps_precision_name(PS_DOUBLE)) == 0 ? 1 : 0);
}

/* Rows of a case, which follow each other, and the series that are made of them. */
typedef struct drawing {
    const ps_table *table;
    size_t first, end, num_series;
    ps_series *series;
    ps_pool *memory;
    ps_error *error;
} drawing;

static pspec_status name_series(const drawing *self, ps_series *own, size_t row) {
    ps_text label = {0};
    ps_text_append(&label, "%s, %s", text_of(self->table, row, "engine"),
                   text_of(self->table, row, "precision"));
    return ps_text_keep(&own->label, self->memory, &label, self->error);
}

/* Of rows of a kind, or of those of the front, by time; none without any. */
static pspec_status add_series(drawing *self, size_t kind, bool is_front) {
    const size_t most = self->end - self->first;
    ps_series *const own = &self->series[self->num_series];
    size_t last = self->end;
    double *x = NULL;
    PS_TRY(PS_POOL_NEW(self->memory, &x, 2 * most, "a picture", self->error));
    double *const y = x + most;
    *own = (ps_series){.kind = kind,
                       .look = is_front ? PS_LOOK_FRONT : PS_LOOK_SIGNS,
                       .label = "Pareto front",
                       .x = x,
                       .y = y};
    for (size_t row = self->first; row < self->end; row++) {
        const double seconds = number_of(self->table, row, "seconds_per_realization");
        if (is_front ? number_of(self->table, row, "pareto") > 0
                     : kind_of(self->table, row) == kind) {
            size_t at = own->num++;
            for (; at > 0 && x[at - 1] > seconds; at--) {
                x[at] = x[at - 1];
                y[at] = y[at - 1];
            }
            x[at] = seconds;
            y[at] = error_of(self->table, row);
            last = row;
        }
    }
    self->num_series += own->num > 0;
    return is_front || last == self->end ? PSPEC_OK : name_series(self, own, last);
}

/* The front comes first, below. */
static pspec_status make_panel(ps_panel *out, drawing *self) {
    enum { NUM_KINDS = 2 * PS_FIGURES_ENGINES };
    self->num_series = 0;
    PS_TRY(PS_POOL_NEW(self->memory, &self->series, NUM_KINDS + 1, "a picture", self->error));
    PS_TRY(add_series(self, 0, true));
    for (size_t kind = 0; kind < NUM_KINDS; kind++) {
        PS_TRY(add_series(self, kind, false));
    }
    *out = (ps_panel){.title = text_of(self->table, self->first, "case"),
                      .num_series = self->num_series,
                      .series = self->series};
    return PSPEC_OK;
}

pspec_status ps_bench_figure(ps_figure *out, ps_pool *memory, const ps_chart *chart,
                             ps_error *error) {
    const ps_table *const table = chart->parts[0].table;
    const size_t num_rows = ps_table_num_rows(table);
    drawing self = {.table = table, .memory = memory, .error = error};
    ps_panel *panels = NULL;
    size_t num = 0;
    PS_TRY(PS_POOL_NEW(memory, &panels, num_rows, "a picture", error));
    for (; self.end < num_rows; self.first = self.end) {
        const char *const name = text_of(table, self.first, "case");
        while (self.end < num_rows && strcmp(text_of(table, self.end, "case"), name) == 0) {
            self.end++;
        }
        PS_TRY(make_panel(&panels[num++], &self));
    }
    *out = (ps_figure){.form = PS_FIGURE_PANELS,
                       .title = chart->title,
                       .x_label = "seconds per realization",
                       .y_label = "error",
                       .is_log_x = true,
                       .is_log_y = true,
                       .num_panels = num,
                       .panels = panels};
    return PSPEC_OK;
}
