/* Pictures of lines: columns against the degree, worst-case errors against the number of points. */
#include "base/memory.h"
#include "cli/run_drawing.h"

#include <math.h>
#include <stdlib.h>

/* ---- lines ------------------------------------------------------------------------------- */

/* Columns against each other, a line for each question of a group. */
typedef struct line_kind {
    const char *suffix, *what, *x, *y, *x_label, *y_label;
    bool is_log_x, is_log_y;
} line_kind;

typedef struct line_set {
    double *numbers[PS_MOST_CURVES];
    ps_text labels[PS_MOST_CURVES];
    ps_plot_line lines[PS_MOST_CURVES];
    size_t num;
} line_set;

static pspec_status take_line(const ps_artist *of, line_set *set, size_t number,
                              const line_kind *kind) {
    const ps_table *const table = of->result->questions[number].answer.table;
    const size_t num = ps_table_num_rows(table);
    void *memory = NULL;
    ps_text *const label = &set->labels[set->num];
    PS_TRY(ps_allocate(&memory, 2 * num, sizeof(double), "a curve", of->error));
    double *const numbers = set->numbers[set->num] = memory;
    ps_run_label(of->result, number, label);
    ps_read_column(table, kind->x, numbers);
    ps_read_column(table, kind->y, numbers + num);
    set->lines[set->num++] = (ps_plot_line){ps_text_string(label), num, numbers, numbers + num};
    return ps_text_check(label, of->error);
}

static void free_lines(line_set *set) {
    for (size_t i = 0; i < PS_MOST_CURVES; i++) {
        free(set->numbers[i]);
        ps_text_free(&set->labels[i]);
    }
}

static pspec_status draw_lines(const ps_artist *of, const ps_plot_group *part,
                               const line_kind *kind, const char *suffix) {
    line_set set = {.num = 0};
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < part->num; i++) {
        PS_TRY_OUT(status, take_line(of, &set, part->first + i, kind));
    }
    ps_plot_title(of, part, kind->what, &title);
    PS_TRY_OUT(status, ps_text_check(&title, of->error));
    const ps_line_plot plot = {.title = ps_text_string(&title),
                               .x_label = kind->x_label,
                               .y_label = kind->y_label,
                               .is_log_x = kind->is_log_x,
                               .is_log_y = kind->is_log_y,
                               .num_lines = set.num,
                               .lines = set.lines};
    status = ps_draw(of, &(ps_drawing){.lines = &plot}, suffix);
out:
    free_lines(&set);
    ps_text_free(&title);
    return status;
}

/* Ended by a row without a suffix. */
static const line_kind of_pairs[] = {
    {"-sums", "Legendre sums", "degree", "legendre_sum", "degree l", "Q(l)", false, true},
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C_l^2", false, true},
    {.suffix = NULL}};
static const line_kind of_rules[] = {
    {"-d2", "zonal part", "degree", "d2", "degree l", "d_l^2", false, true},
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C_l^2", false, true},
    {"-e2", "share of the squared error", "degree", "e2", "degree l", "e_l^2", false, true},
    {.suffix = NULL}};
static const line_kind of_truncation[] = {
    {"-error", "worst-case error", "degree", "error", "largest degree L", "E(L)", false, true},
    {"-points", "points with the same error", "degree", "equivalent_points", "largest degree L",
     "N", false, true},
    {.suffix = NULL}};
static const line_kind of_checked_rings[] = {
    {"-scores", "difference", "bin", "z_score", "ring", "in standard errors", false, false},
    {.suffix = NULL}};
static const line_kind of_checked_degrees[] = {
    {"-scores", "difference", "degree", "z_score", "degree", "in standard errors", false, false},
    {.suffix = NULL}};

static const line_kind *find_kinds(const ps_run_result *result) {
    size_t column = 0;
    const ps_result_kind *const kind = result->asked->kind;
    if (kind == &ps_result_check) {
        return ps_table_find_column(result->questions[0].answer.table, "degree", &column)
                   ? of_checked_degrees
                   : of_checked_rings;
    }
    return kind == &ps_result_pairs        ? of_pairs
           : kind == &ps_result_quadrature ? of_rules
                                           : of_truncation;
}

/* Of one group: nothing where there are too many curves, or too few degrees for one. */
static pspec_status draw_group(const ps_artist *of, const ps_plot_group *part, size_t index) {
    enum { FEWEST_ROWS = 4 };
    char suffix[64];
    const line_kind *const kinds = find_kinds(of->result);
    const ps_table *const first = of->result->questions[part->first].answer.table;
    if (part->num > PS_MOST_CURVES || ps_table_num_rows(first) < FEWEST_ROWS) {
        return PSPEC_OK;
    }
    for (size_t k = 0; kinds[k].suffix != NULL; k++) {
        snprintf(suffix, sizeof suffix, "%s-%zu", kinds[k].suffix, index + 1);
        PS_TRY(draw_lines(of, part, &kinds[k], part->value != NULL ? suffix : kinds[k].suffix));
    }
    return PSPEC_OK;
}

/* ---- convergence ------------------------------------------------------------------------- */

/* Of log y over log x, least squares; nan for fewer than two places. */
static double slope(const double *x, const double *y, size_t num) {
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double sxy = 0;
    for (size_t i = 0; i < num; i++) {
        const double u = log(x[i]);
        const double v = log(y[i]);
        sx += u;
        sy += v;
        sxx += u * u;
        sxy += u * v;
    }
    const double n = (double)num;
    return num > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : NAN;
}

/* The entry whose values are numbers of points, if there are several. */
static bool find_points(const ps_scene_result *asked, size_t *index) {
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (asked->entries[i].option == PS_OPTION_POINTS && ps_run_varies(&asked->entries[i])) {
            *index = i;
            return true;
        }
    }
    return false;
}

/* All values but the number of points. */
static void label_others(const ps_scene_result *asked, size_t number, size_t except, ps_text *out) {
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (i != except && ps_run_varies(&asked->entries[i])) {
            ps_text_append(out, "%s%s", out->length > 0 ? ", " : "",
                           ps_scene_value_of(asked, number, i)->originals[0]);
        }
    }
}

/* Worst-case error of the questions that differ from `first` in the number of points only. */
static pspec_status take_errors(const ps_artist *of, line_set *set, size_t first, size_t step,
                                size_t i_points) {
    const ps_run_result *const result = of->result;
    const size_t num = result->asked->entries[i_points].num_values;
    void *memory = NULL;
    ps_text *const label = &set->labels[set->num];
    PS_TRY(ps_allocate(&memory, 2 * num, sizeof(double), "a curve", of->error));
    double *const x = set->numbers[set->num] = memory;
    for (size_t i = 0; i < num; i++) {
        const ps_table *const table = result->questions[first + i * step].answer.table;
        x[i] = ps_cell_number(ps_run_meta(table, "points"));
        x[num + i] = ps_cell_number(ps_run_meta(table, "worst_case_error"));
    }
    label_others(result->asked, first, i_points, label);
    ps_text_append(label, "%sslope %.3f", label->length > 0 ? ": " : "", slope(x, x + num, num));
    set->lines[set->num++] = (ps_plot_line){ps_text_string(label), num, x, x + num};
    return ps_text_check(label, of->error);
}

/* The first entry that varies, but for the number of points: it tells pictures apart where one would have too many curves. */
static size_t find_divider(const ps_scene_result *asked, size_t i_points) {
    size_t i = 0;
    while (i < asked->num_entries && (i == i_points || !ps_run_varies(&asked->entries[i]))) {
        i++;
    }
    return i;
}

static pspec_status draw_errors(const ps_artist *of, const line_set *set,
                                const ps_scene_value *value, size_t picture) {
    ps_text title = {0};
    char suffix[64];
    snprintf(suffix, sizeof suffix, "-convergence-%zu", picture + 1);
    ps_plot_title(of, &(ps_plot_group){0, 0, value}, "worst-case error", &title);
    const ps_line_plot plot = {.title = ps_text_string(&title),
                               .x_label = "points N",
                               .y_label = "E",
                               .is_log_x = true,
                               .is_log_y = true,
                               .num_lines = set->num,
                               .lines = set->lines};
    pspec_status status = ps_text_check(&title, of->error);
    if (status == PSPEC_OK) {
        status =
            ps_draw(of, &(ps_drawing){.lines = &plot}, value != NULL ? suffix : "-convergence");
    }
    ps_text_free(&title);
    return status;
}

/* Lines of the questions whose entry `divider` has the value number `index`, or of all; each begins at a question with the
 * first number of points. */
static pspec_status draw_convergence_of(const ps_artist *of, size_t i_points, size_t divider,
                                        size_t index) {
    const ps_scene_result *const asked = of->result->asked;
    const bool is_divided = divider < asked->num_entries;
    const ps_scene_value *const value = is_divided ? &asked->entries[divider].values[index] : NULL;
    line_set set = {.num = 0};
    size_t step = 1;
    pspec_status status = PSPEC_OK;
    for (size_t i = i_points + 1; i < asked->num_entries; i++) {
        step *= asked->entries[i].num_values;
    }
    for (size_t q = 0; q < of->result->num && status == PSPEC_OK; q++) {
        const bool is_here = !is_divided || ps_scene_value_of(asked, q, divider) == value;
        const bool is_first =
            ps_scene_value_of(asked, q, i_points) == &asked->entries[i_points].values[0];
        if (is_here && is_first && set.num < PS_MOST_CURVES) {
            status = take_errors(of, &set, q, step, i_points);
        }
    }
    if (status == PSPEC_OK) {
        status = draw_errors(of, &set, value, index);
    }
    free_lines(&set);
    return status;
}

static pspec_status draw_convergence(const ps_artist *of) {
    const ps_scene_result *const asked = of->result->asked;
    size_t i_points = 0;
    if (!find_points(asked, &i_points)) {
        return PSPEC_OK;
    }
    const size_t divider = find_divider(asked, i_points);
    const size_t num_lines = of->result->num / asked->entries[i_points].num_values;
    if (num_lines <= PS_MOST_CURVES || divider == asked->num_entries) {
        return draw_convergence_of(of, i_points, asked->num_entries, 0);
    }
    for (size_t i = 0; i < asked->entries[divider].num_values; i++) {
        PS_TRY(draw_convergence_of(of, i_points, divider, i));
    }
    return PSPEC_OK;
}

pspec_status ps_draw_lines(const ps_artist *of) {
    if (of->result->asked->kind == &ps_result_quadrature) {
        PS_TRY(draw_convergence(of));
    }
    for (size_t g = 0; g < ps_num_plot_groups(of->result); g++) {
        const ps_plot_group part = ps_plot_group_at(of->result, g);
        PS_TRY(draw_group(of, &part, g));
    }
    return PSPEC_OK;
}
