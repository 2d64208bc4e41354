/* A picture made of the rows of tables, which may come from a job or from a cache. */
#ifndef PS_ANSWERS_CHART_H
#define PS_ANSWERS_CHART_H

#include "plots/plot.h"
#include "tables/table.h"

typedef struct ps_chart_part {
    const ps_table *table;
    const char *label; /* what its rows have and those of other parts may not; "": nothing */
} ps_chart_part;

/* Takes a figure, which lasts until it returns. */
typedef pspec_status ps_take_figure(void *payload, const ps_figure *figure, ps_error *error);

typedef struct ps_chart {
    const char *title;
    ps_plot_axes axes; /* {0}: nothing was asked of them */
    size_t num_parts;
    const ps_chart_part *parts;
    ps_take_figure *take; /* called once, unless something fails before */
    void *payload;
} ps_chart;

#endif
