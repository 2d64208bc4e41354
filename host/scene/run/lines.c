/* Pictures of curves, in one frame or in panels: spectra, columns against the degree, worst-case
 * errors against the number of points. */
#include "base/memory.h"
#include "scene/run/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- labels ------------------------------------------------------------------------------ */

/* Values of the entries that vary, but for the number of points, that of the picture, and that of
 * the panel. */
static bool is_told(const ps_scene_result *asked, const ps_picture *what, size_t entry) {
    return entry != what->group && entry != what->points && entry != what->panel &&
           ps_run_varies(&asked->entries[entry]);
}

/* Where no entry has panels of its own, that is the one that changes fastest; the others tell
 * panels apart. */
static size_t find_fastest(const ps_scene_result *asked, const ps_picture *what) {
    size_t fastest = asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        fastest = is_told(asked, what, i) ? i : fastest;
    }
    return fastest;
}

static void append_value(const ps_scene_result *asked, size_t question, size_t entry,
                         ps_text *out) {
    ps_text_append(out, "%s%s", out->length > 0 ? ", " : "",
                   ps_scene_value_of(asked, question, entry)->label);
}

static void label_panel(const ps_scene_result *asked, const ps_picture *what, size_t question,
                        ps_text *out) {
    const size_t fastest = find_fastest(asked, what);
    if (what->panel < asked->num_entries) {
        append_value(asked, question, what->panel, out);
        return;
    }
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (i != fastest && is_told(asked, what, i)) {
            append_value(asked, question, i, out);
        }
    }
}

void ps_label_curve(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out) {
    const size_t fastest = find_fastest(asked, what);
    const bool is_chunk = what->panel == asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (is_told(asked, what, i) && (what->num_panels == 1 || !is_chunk || i == fastest)) {
            append_value(asked, question, i, out);
        }
    }
}

/* ---- numbers ----------------------------------------------------------------------------- */

typedef struct line_set {
    size_t num;
    ps_series *lines;
    ps_text *labels;
    double **numbers;
} line_set;

static void free_lines(line_set *set) {
    for (size_t i = 0; i < set->num; i++) {
        free(set->numbers[i]);
        ps_text_free(&set->labels[i]);
    }
    free(set->lines);
    free(set->labels);
    free(set->numbers);
}

static pspec_status allocate_lines(line_set *set, size_t num, ps_error *error) {
    PS_TRY(PS_NEW(&set->lines, num, "curves", error));
    PS_TRY(PS_NEW(&set->labels, num, "curves", error));
    PS_TRY(PS_NEW(&set->numbers, num, "curves", error));
    set->num = num;
    return PSPEC_OK;
}

static pspec_status begin_line(line_set *set, size_t index, size_t num, size_t num_columns,
                               ps_error *error) {
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, num, num_columns * sizeof(double), "a curve", error));
    double *const numbers = set->numbers[index] = memory;
    set->lines[index] = (ps_series){.num = num, .x = numbers, .y = numbers + num};
    return PSPEC_OK;
}

/* Are these curves drawn as spectra are, with bars and anisotropy? In panels they are lines. */
static bool has_bars(const ps_picture *what) {
    return what->num_panels == 1 &&
           (what->form == PS_PICTURE_SPECTRA || what->form == PS_PICTURE_IMAGE);
}

/* What pure noise comes to, where the table has a level of it, and what is rounding: of powers the
 * square of the error of S, of others the error itself, that of pair sums in units of W^2. */
static void take_limits(ps_series *line, const ps_table *table, bool is_power) {
    const double error = ps_cell_number(ps_table_find_meta(table, "predicted_error"));
    const double sum = ps_cell_number(ps_table_find_meta(table, "weight_sum"));
    const double level = ps_cell_number(ps_table_find_meta(table, "noise_level_db"));
    const double num = ps_cell_number(ps_table_find_meta(table, "realizations"));
    if (error > 0) {
        line->floor = is_power ? error * error : error * (isfinite(sum) ? sum * sum : 1);
    }
    line->num_realizations = isfinite(level) ? num : 1;
}

/* Columns of a line: its places, what has bars has more, and with --fit there are the profiles and
 * the curve that was fitted. */
enum { LINE_COLUMNS = 2, BARS_COLUMNS = 4, SHAPE_COLUMNS = 7 };

static size_t count_columns(const ps_table *table, const ps_picture *what) {
    size_t column = 0;
    return !has_bars(what)                               ? LINE_COLUMNS
           : ps_table_find_column(table, "fit", &column) ? SHAPE_COLUMNS
                                                         : BARS_COLUMNS;
}

static pspec_status take_columns(const ps_artist *artist, line_set *set, size_t index,
                                 const ps_picture *what, const ps_line_kind *kind) {
    const ps_table *const table = artist->result->questions[what->curves[index]].answer.table;
    const char *const names[SHAPE_COLUMNS] = {
        kind->x, kind->y, "standard_error", "anisotropy_db", "lower", "upper", "fit"};
    const size_t num_columns = count_columns(table, what);
    const size_t num = ps_table_num_rows(table);
    PS_TRY(begin_line(set, index, num, num_columns, artist->error));
    for (size_t i = 0; i < num_columns; i++) {
        ps_table_read_column(table, names[i], set->numbers[index] + i * num);
    }
    ps_series *const line = &set->lines[index];
    take_limits(line, table, what->form != PS_PICTURE_COLUMNS);
    const double *const more = set->numbers[index] + LINE_COLUMNS * num;
    if (num_columns >= BARS_COLUMNS) {
        line->error = more;
        line->anisotropy = more + num;
    }
    if (num_columns == SHAPE_COLUMNS) {
        line->low = more + 2 * num;
        line->high = more + 3 * num;
        line->fit = more + 4 * num;
    }
    return PSPEC_OK;
}

size_t ps_question_step(const ps_scene_result *asked, size_t entry) {
    size_t step = 1;
    for (size_t i = entry + 1; i < asked->num_entries; i++) {
        step *= asked->entries[i].num_values;
    }
    return step;
}

/* Worst-case error of the questions that differ from `first` in the number of points only. */
static pspec_status take_errors(const ps_artist *artist, line_set *set, size_t index, size_t first,
                                size_t points, const ps_line_kind *kind) {
    const ps_scene_result *const asked = artist->result->asked;
    const size_t num = asked->entries[points].num_values;
    const size_t step = ps_question_step(asked, points);
    PS_TRY(begin_line(set, index, num, 2, artist->error));
    double *const x = set->numbers[index];
    for (size_t i = 0; i < num; i++) {
        const ps_table *const table = artist->result->questions[first + i * step].answer.table;
        x[i] = ps_cell_number(ps_table_find_meta(table, kind->x));
        x[num + i] = ps_cell_number(ps_table_find_meta(table, kind->y));
    }
    return PSPEC_OK;
}

/* One frame has room for more of a label than the key of many panels. */
static void label_line(const ps_artist *artist, const ps_picture *what, size_t question,
                       const ps_series *line, ps_text *out) {
    if (what->num_panels > 1 || what->form == PS_PICTURE_ERRORS) {
        ps_label_curve(artist->result->asked, what, question, out);
    } else {
        ps_run_label(artist->result, question, out);
    }
    if (what->num_panels == 1 && what->form == PS_PICTURE_ERRORS) {
        ps_series_say_slope(line, out);
    }
}

static pspec_status take_lines(const ps_artist *artist, const ps_picture *what,
                               const ps_line_kind *kind, line_set *set) {
    PS_TRY(allocate_lines(set, what->num_curves, artist->error));
    for (size_t i = 0; i < what->num_curves; i++) {
        const size_t question = what->curves[i];
        PS_TRY(what->form == PS_PICTURE_ERRORS
                   ? take_errors(artist, set, i, question, what->points, kind)
                   : take_columns(artist, set, i, what, kind));
        label_line(artist, what, question, &set->lines[i], &set->labels[i]);
        PS_TRY(ps_text_check(&set->labels[i], artist->error));
        set->lines[i].label = ps_text_string(&set->labels[i]);
    }
    return PSPEC_OK;
}

/* ---- panels ------------------------------------------------------------------------------ */

/* Curves of one panel are told apart; those with the same label look the same in all panels. */
static void number_kinds(const line_set *set, bool is_frame) {
    size_t num_kinds = 0;
    for (size_t i = 0; i < set->num; i++) {
        size_t same = 0;
        while (same < i && (is_frame || strcmp(set->lines[same].label, set->lines[i].label) != 0)) {
            same++;
        }
        set->lines[i].kind = same < i ? set->lines[same].kind : num_kinds++;
    }
}

static pspec_status fill_panels(const ps_artist *artist, const ps_picture *what, ps_panel *panels,
                                ps_text *titles, const ps_series *series) {
    for (size_t i = 0, begin = 0; i < what->num_panels; begin = what->ends[i++]) {
        label_panel(artist->result->asked, what, what->curves[begin], &titles[i]);
        PS_TRY(ps_text_check(&titles[i], artist->error));
        panels[i] = (ps_panel){ps_text_string(&titles[i]), what->ends[i] - begin, series + begin};
    }
    return PSPEC_OK;
}

/* figure: all but its panels. */
static pspec_status draw_panels(const ps_artist *artist, const ps_picture *what, ps_figure *figure,
                                const line_set *set) {
    void *panels = NULL;
    void *titles = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status,
               ps_allocate(&panels, what->num_panels, sizeof(ps_panel), "panels", artist->error));
    PS_TRY_OUT(status,
               ps_allocate(&titles, what->num_panels, sizeof(ps_text), "panels", artist->error));
    number_kinds(set, what->num_panels == 1);
    PS_TRY_OUT(status, fill_panels(artist, what, panels, titles, set->lines));
    figure->num_panels = what->num_panels;
    figure->panels = panels;
    status = ps_draw(artist, figure, what);
out:
    for (size_t i = 0; titles != NULL && i < what->num_panels; i++) {
        ps_text_free((ps_text *)titles + i);
    }
    free(panels);
    free(titles);
    return status;
}

/* ---- all --------------------------------------------------------------------------------- */

static ps_line_kind find_axes(const ps_artist *artist, const ps_picture *what) {
    size_t column = 0;
    if (what->lines == NULL) {
        return *artist->result->asked->kind->spectrum;
    }
    ps_line_kind kind = *what->lines;
    if (what->form == PS_PICTURE_COLUMNS &&
        !ps_table_find_column(artist->result->questions[0].answer.table, kind.x, &column)) {
        kind.x = kind.x_label = "degree"; /* what was checked is of the sphere */
    }
    return kind;
}

/* Nothing where there are too few degrees for a line. */
static bool has_lines(const ps_artist *artist, const ps_picture *what) {
    enum { FEWEST_ROWS = 4 };
    const ps_table *const first = artist->result->questions[what->curves[0]].answer.table;
    return what->form != PS_PICTURE_COLUMNS || ps_table_num_rows(first) >= FEWEST_ROWS;
}

pspec_status ps_draw_curves(const ps_artist *artist, const ps_picture *what,
                            const ps_plot_image *image) {
    line_set set = {0};
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    const ps_line_kind kind = find_axes(artist, what);
    if (!has_lines(artist, what)) {
        return PSPEC_OK;
    }
    PS_TRY_OUT(status, take_lines(artist, what, &kind, &set));
    ps_plot_title(artist, what, image != NULL ? set.lines[0].label : kind.what, &title);
    PS_TRY_OUT(status, ps_text_check(&title, artist->error));
    ps_figure figure = {.form = has_bars(what)          ? PS_FIGURE_SPECTRA
                                : what->num_panels == 1 ? PS_FIGURE_FRAME
                                                        : PS_FIGURE_PANELS,
                        .title = ps_text_string(&title),
                        .x_label = kind.x_label,
                        .y_label = kind.y_label,
                        .is_log_x = kind.is_log_x && !has_bars(what),
                        .is_log_y = kind.is_log_y && !has_bars(what),
                        .axes = artist->result->asked->axes,
                        .image = image,
                        .on_sphere = artist->result->asked->kind->samples == PS_DOMAIN_SPHERE};
    status = draw_panels(artist, what, &figure, &set);
out:
    free_lines(&set);
    ps_text_free(&title);
    return status;
}
