/* What the pictures of a scene's results share. Private to run_*.c. */
#ifndef PS_CLI_RUN_DRAWING_H
#define PS_CLI_RUN_DRAWING_H

#include "cli/run.h"
#include "io/plot.h"

/* More curves than this in one picture cannot be told apart. */
enum { PS_MOST_CURVES = 8 };

typedef struct ps_artist {
    const ps_run *run;
    ps_run_result *result;
    ps_error *error;
} ps_artist;

/* Questions first .. first + num - 1, of one picture. */
typedef struct ps_plot_group {
    size_t first, num;
    const ps_scene_value
        *value; /* of the entry that tells groups apart; NULL: there is one group */
} ps_plot_group;

/* Where all questions are too many for a picture there is one for each value of the key that stands first and varies. */
ps_plot_group ps_plot_group_at(const ps_run_result *result, size_t index);
size_t ps_num_plot_groups(const ps_run_result *result);

/* A column as numbers, nan where there is none; of nan where the table has no such column. */
void ps_read_column(const ps_table *table, const char *name, double *out);

/* The title of the result, what the group is, what the picture shows. */
void ps_plot_title(const ps_artist *of, const ps_plot_group *part, const char *what, ps_text *out);

/* One of the two kinds of plots; the other is NULL. */
typedef struct ps_drawing {
    const ps_plot *spectra;
    const ps_line_plot *lines;
} ps_drawing;

/* Draws it, or takes it from the cache, and adds it to the result as NAME + suffix. */
pspec_status ps_draw(const ps_artist *of, const ps_drawing *what, const char *suffix) PS_MUST_CHECK;

/* Pictures of results that are lines: pair sums, rules, truncation, checks. */
pspec_status ps_draw_lines(const ps_artist *of) PS_MUST_CHECK;

#endif
