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

/* An engine in two precisions is a pair of kinds: one colour, filled and hollow marks. The front
 * comes first, below. */
enum { MOST_SERIES = PS_FIGURES_ENGINES * 2 + 1 };

typedef struct panel {
    char labels[MOST_SERIES][64];
    ps_series series[MOST_SERIES];
    double *numbers; /* [MOST_SERIES][2][rows] */
} panel;

/* The referee has its error from its formula: it is not off from itself. */
static double error_of(const ps_bench_row *row) {
    return row->error > 0 ? row->error : row->predicted_error;
}

static size_t kind_of(const ps_bench_row *row) {
    size_t engine = 0;
    while (ps_engines[engine] != row->engine && ps_engines[engine] != NULL) {
        engine++;
    }
    return 2 * engine + (row->precision == PS_DOUBLE ? 1 : 0);
}

static void add_place(ps_series *series, double *numbers, size_t num_rows,
                      const ps_bench_row *row) {
    numbers[series->num] = row->seconds;
    numbers[num_rows + series->num] = error_of(row);
    series->x = numbers;
    series->y = numbers + num_rows;
    series->num++;
}

static int compare_seconds(const void *a, const void *b) {
    const double x = (*(const ps_bench_row *const *)a)->seconds;
    const double y = (*(const ps_bench_row *const *)b)->seconds;
    return x < y ? -1 : x > y;
}

/* Series 0 is the front, by time; then a series for every kind. */
static void fill_series(panel *out, const ps_bench_row **sorted, size_t num) {
    for (size_t i = 0; i < num; i++) {
        const ps_bench_row *row = sorted[i];
        const size_t kind = kind_of(row);
        const size_t at = kind + 1 < MOST_SERIES ? kind + 1 : MOST_SERIES - 1;
        snprintf(out->labels[at], sizeof out->labels[at], "%s, %s", row->engine->name,
                 ps_precision_name(row->precision));
        out->series[at].kind = kind;
        out->series[at].look = PS_LOOK_SIGNS;
        out->series[at].label = out->labels[at];
        add_place(&out->series[at], out->numbers + at * 2 * num, num, row);
        if (row->is_pareto) {
            add_place(&out->series[0], out->numbers, num, row);
        }
    }
}

/* Series without places go. */
static size_t pack_series(panel *out) {
    size_t num = 0;
    for (size_t i = 0; i < MOST_SERIES; i++) {
        if (out->series[i].num > 0) {
            out->series[num++] = out->series[i];
        }
    }
    return num;
}

static pspec_status make_panel(ps_panel *plot, ps_pool *memory, const ps_bench_row *rows,
                               size_t num, ps_error *error) {
    panel *out = NULL;
    const ps_bench_row **sorted = NULL;
    PS_TRY(PS_POOL_NEW(memory, &out, 1, "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &out->numbers, MOST_SERIES * 2 * num, "a picture", error));
    PS_TRY(PS_POOL_NEW(memory, &sorted, num, "a picture", error));
    for (size_t i = 0; i < num; i++) {
        sorted[i] = &rows[i];
    }
    qsort(sorted, num, sizeof *sorted, compare_seconds);
    out->series[0] = (ps_series){.label = "Pareto front", .look = PS_LOOK_FRONT};
    fill_series(out, sorted, num);
    *plot = (ps_panel){
        .title = rows[0].what->name, .num_series = pack_series(out), .series = out->series};
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
