/* Pictures of the results of a scene, made from their tables. */
#include "base/memory.h"
#include "cli/run.h"
#include "io/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* More curves than this in one picture cannot be told apart. */
enum { MOST_CURVES = 8 };

/* ---- columns ----------------------------------------------------------------------------- */

static double cell_number(ps_cell cell) {
    return cell.kind == PS_CELL_NUMBER    ? cell.number
           : cell.kind == PS_CELL_INTEGER ? (double)cell.integer
                                          : NAN;
}

/* A column as numbers, nan where there is none; of nan where the table has no such column. */
static pspec_status read_column(const ps_table *table, const char *name, double *out) {
    size_t column = 0;
    const bool is_there = ps_table_find_column(table, name, &column);
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        out[row] = is_there ? cell_number(ps_table_cell(table, row, column)) : NAN;
    }
    return PSPEC_OK;
}

/* ---- what is drawn together -------------------------------------------------------------- */

/* Questions [first, first + num) step `step`: of one picture. */
typedef struct group {
    size_t first, num;
    const ps_scene_value *value; /* of the entry that tells groups apart; NULL: there is one group */
} group;

/* Where all questions are too many for a picture there is one for each value of the key that stands first and varies. */
static group group_at(const ps_run_result *result, size_t index) {
    const ps_scene_result *const asked = result->asked;
    size_t num = result->num;
    for (size_t i = 0; i < asked->num_entries; i++) {
        const ps_scene_entry *const entry = &asked->entries[i];
        if (ps_run_varies(entry)) {
            if (result->num <= MOST_CURVES) {
                break;
            }
            num /= entry->num_values;
            return (group){index * num, num, &entry->values[index]};
        }
    }
    return (group){0, result->num, NULL};
}

static size_t count_groups(const ps_run_result *result) {
    const group first = group_at(result, 0);
    return first.num > 0 ? result->num / first.num : 0;
}

/* ---- a new picture ----------------------------------------------------------------------- */

typedef struct artist {
    const ps_run *run;
    ps_run_result *result;
    ps_error *error;
} artist;

/* The title of the result, what the group is, what the picture shows. */
static void write_title(const artist *of, const group *part, const char *what, ps_text *out) {
    const ps_scene_result *const asked = of->result->asked;
    ps_text_append(out, "%s", asked->title != NULL ? asked->title : asked->name);
    if (part->value != NULL) {
        ps_text_append(out, ", %s", part->value->originals[0]);
    }
    if (what[0] != '\0') {
        ps_text_append(out, ": %s", what);
    }
}

/* A picture is a function of what is drawn: gnuplot need not run twice for the same. */
static pspec_status find_svg(const artist *of, const ps_text *key, ps_text *svg, bool *is_found) {
    void *bytes = NULL;
    size_t num = 0;
    ps_error reason = {0};
    *is_found = false;
    if (of->run->cache != NULL && ps_cache_get(of->run->cache, key->data, key->length, &bytes, &num,
                                               is_found, &reason) == PSPEC_OK &&
        *is_found) {
        ps_text_append_bytes(svg, bytes, num);
    }
    free(bytes);
    return ps_text_check(svg, of->error);
}

static pspec_status keep_svg(const artist *of, const ps_text *key, const ps_text *svg) {
    ps_error reason = {0};
    if (of->run->cache != NULL && ps_cache_put(of->run->cache, key->data, key->length, svg->data,
                                               svg->length, &reason) != PSPEC_OK &&
        !of->run->arguments->quiet) {
        fprintf(stderr, "pointspec: the cache of results: %s\n", reason.message);
    }
    return PSPEC_OK;
}

static pspec_status add_plot(const artist *of, const char *suffix, ps_text *svg) {
    ps_run_result *const result = of->result;
    void *plots = result->plots;
    PS_TRY(ps_grow(&plots, &result->plot_capacity, result->num_plots + 1, sizeof *result->plots,
                   "pictures", of->error));
    result->plots = plots;
    ps_text name = {0};
    ps_text_append(&name, "%s%s", result->asked->name, suffix);
    if (ps_text_check(&name, of->error) != PSPEC_OK) {
        ps_text_free(&name);
        return of->error->status;
    }
    result->plots[result->num_plots++] = (ps_run_plot){name.data, svg->data};
    *svg = (ps_text){0};
    return PSPEC_OK;
}

/* One of the two kinds of plots; the other is NULL. */
typedef struct drawing {
    const ps_plot *spectra;
    const ps_line_plot *lines;
} drawing;

static void add_line_key(ps_text *key, const ps_line_plot *plot) {
    ps_text_append(key, "%s\n%s\n%s\n%d %d\n", plot->title, plot->x_label, plot->y_label,
                   plot->is_log_x, plot->is_log_y);
    for (size_t i = 0; i < plot->num_lines; i++) {
        const ps_plot_line *const line = &plot->lines[i];
        ps_text_append(key, "%s %zu\n", line->label != NULL ? line->label : "", line->num);
        ps_text_append_bytes(key, (const char *)line->x, line->num * sizeof(double));
        ps_text_append_bytes(key, (const char *)line->y, line->num * sizeof(double));
    }
}

static void add_spectra_key(ps_text *key, const ps_plot *plot) {
    ps_text_append(key, "%s\n%d %a\n", plot->title, plot->on_sphere, plot->noise_level_db);
    for (size_t i = 0; i < plot->num_curves; i++) {
        const ps_plot_curve *const curve = &plot->curves[i];
        const size_t bytes = curve->num_bins * sizeof(double);
        ps_text_append(key, "%s %zu\n", curve->label, curve->num_bins);
        ps_text_append_bytes(key, (const char *)curve->normalized_frequency, bytes);
        ps_text_append_bytes(key, (const char *)curve->power, bytes);
        ps_text_append_bytes(key, (const char *)curve->standard_error, bytes);
        ps_text_append_bytes(key, (const char *)curve->anisotropy_db, bytes);
    }
    if (plot->image != NULL) {
        const size_t num = plot->image->size * plot->image->size;
        ps_text_append(key, "%zu %a\n", plot->image->size, plot->image->unit);
        ps_text_append_bytes(key, (const char *)plot->image->power, num * sizeof(double));
    }
}

/* Draws it, or takes it from the cache, and adds it to the result. */
static pspec_status draw(const artist *of, const drawing *what, const char *suffix) {
    ps_text key = {0};
    ps_text svg = {0};
    bool is_found = false;
    pspec_status status = PSPEC_OK;
    ps_text_append(&key, "plot\n%s", ps_text_string(&of->run->identity));
    if (what->lines != NULL) {
        add_line_key(&key, what->lines);
    } else {
        add_spectra_key(&key, what->spectra);
    }
    PS_TRY_OUT(status, ps_text_check(&key, of->error));
    PS_TRY_OUT(status, find_svg(of, &key, &svg, &is_found));
    if (!is_found) {
        PS_TRY_OUT(status, what->lines != NULL
                               ? ps_line_plot_draw_svg(&svg, what->lines, of->error)
                               : ps_plot_draw_svg(&svg, what->spectra, of->error));
        PS_TRY_OUT(status, keep_svg(of, &key, &svg));
    }
    status = add_plot(of, suffix, &svg);
out:
    ps_text_free(&key);
    ps_text_free(&svg);
    return status;
}

/* ---- lines ------------------------------------------------------------------------------- */

/* Columns against each other, a line for each question of a group. */
typedef struct line_kind {
    const char *suffix, *what, *x, *y, *x_label, *y_label;
    bool is_log_x, is_log_y;
} line_kind;

typedef struct line_set {
    double *numbers[MOST_CURVES];
    ps_text labels[MOST_CURVES];
    ps_plot_line lines[MOST_CURVES];
    size_t num;
} line_set;

static pspec_status take_line(const artist *of, line_set *set, size_t number,
                              const line_kind *kind) {
    const ps_table *const table = of->result->questions[number].answer.table;
    const size_t num = ps_table_num_rows(table);
    void *memory = NULL;
    ps_text *const label = &set->labels[set->num];
    PS_TRY(ps_allocate(&memory, 2 * num, sizeof(double), "a curve", of->error));
    double *const numbers = set->numbers[set->num] = memory;
    ps_run_label(of->result, number, label);
    PS_TRY(read_column(table, kind->x, numbers));
    PS_TRY(read_column(table, kind->y, numbers + num));
    set->lines[set->num++] = (ps_plot_line){ps_text_string(label), num, numbers, numbers + num};
    return ps_text_check(label, of->error);
}

static void free_lines(line_set *set) {
    for (size_t i = 0; i < MOST_CURVES; i++) {
        free(set->numbers[i]);
        ps_text_free(&set->labels[i]);
    }
}

static pspec_status draw_lines(const artist *of, const group *part, const line_kind *kind,
                               const char *suffix) {
    line_set set = {.num = 0};
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < part->num; i++) {
        PS_TRY_OUT(status, take_line(of, &set, part->first + i, kind));
    }
    write_title(of, part, kind->what, &title);
    PS_TRY_OUT(status, ps_text_check(&title, of->error));
    const ps_line_plot plot = {.title = ps_text_string(&title),
                               .x_label = kind->x_label,
                               .y_label = kind->y_label,
                               .is_log_x = kind->is_log_x,
                               .is_log_y = kind->is_log_y,
                               .num_lines = set.num,
                               .lines = set.lines};
    status = draw(of, &(drawing){.lines = &plot}, suffix);
out:
    free_lines(&set);
    ps_text_free(&title);
    return status;
}

static const line_kind of_pairs[] = {
    {"-sums", "Legendre sums", "degree", "legendre_sum", "degree l", "Q(l)", false, true},
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C_l^2", false, true},
    {NULL}};
static const line_kind of_rules[] = {
    {"-d2", "zonal part", "degree", "d2", "degree l", "d_l^2", false, true},
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C_l^2", false, true},
    {"-e2", "share of the squared error", "degree", "e2", "degree l", "e_l^2", false, true},
    {NULL}};
static const line_kind of_truncation[] = {
    {"-error", "worst-case error", "degree", "error", "largest degree L", "E(L)", false, true},
    {"-points", "points with the same error", "degree", "equivalent_points", "largest degree L",
     "N", false, true},
    {NULL}};
static const line_kind of_checks[] = {
    {"-scores", "difference in standard errors", "bin", "z_score", "ring", "z", false, false},
    {NULL}};

static pspec_status draw_kinds(const artist *of, const line_kind *kinds) {
    char suffix[64];
    for (size_t g = 0; g < count_groups(of->result); g++) {
        const group part = group_at(of->result, g);
        for (size_t k = 0; kinds[k].suffix != NULL && part.num <= MOST_CURVES; k++) {
            if (part.value != NULL) {
                snprintf(suffix, sizeof suffix, "%s-%zu", kinds[k].suffix, g + 1);
            } else {
                snprintf(suffix, sizeof suffix, "%s", kinds[k].suffix);
            }
            PS_TRY(draw_lines(of, &part, &kinds[k], suffix));
        }
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
static pspec_status take_errors(const artist *of, line_set *set, size_t first, size_t step,
                                size_t i_points) {
    const ps_run_result *const result = of->result;
    const size_t num = result->asked->entries[i_points].num_values;
    void *memory = NULL;
    ps_text *const label = &set->labels[set->num];
    PS_TRY(ps_allocate(&memory, 2 * num, sizeof(double), "a curve", of->error));
    double *const x = set->numbers[set->num] = memory;
    for (size_t i = 0; i < num; i++) {
        const ps_table *const table = result->questions[first + i * step].answer.table;
        x[i] = cell_number(ps_run_meta(table, "points"));
        x[num + i] = cell_number(ps_run_meta(table, "worst_case_error"));
    }
    label_others(result->asked, first, i_points, label);
    ps_text_append(label, "%sslope %.3f", label->length > 0 ? ": " : "", slope(x, x + num, num));
    set->lines[set->num++] = (ps_plot_line){ps_text_string(label), num, x, x + num};
    return ps_text_check(label, of->error);
}

static pspec_status draw_errors(const artist *of, const line_set *set, size_t picture) {
    ps_text title = {0};
    char suffix[64];
    snprintf(suffix, sizeof suffix, picture > 0 ? "-convergence-%zu" : "-convergence", picture + 1);
    write_title(of, &(group){0, 0, NULL}, "worst-case error", &title);
    const ps_line_plot plot = {.title = ps_text_string(&title),
                               .x_label = "points N",
                               .y_label = "E",
                               .is_log_x = true,
                               .is_log_y = true,
                               .num_lines = set->num,
                               .lines = set->lines};
    pspec_status status = ps_text_check(&title, of->error);
    if (status == PSPEC_OK) {
        status = draw(of, &(drawing){.lines = &plot}, suffix);
    }
    ps_text_free(&title);
    return status;
}

static pspec_status draw_convergence(const artist *of) {
    const ps_scene_result *const asked = of->result->asked;
    size_t i_points = 0;
    size_t step = 1;
    size_t picture = 0;
    if (!find_points(asked, &i_points)) {
        return PSPEC_OK;
    }
    for (size_t i = i_points + 1; i < asked->num_entries; i++) {
        step *= asked->entries[i].num_values;
    }
    const size_t block = step * asked->entries[i_points].num_values;
    line_set set = {.num = 0};
    pspec_status status = PSPEC_OK;
    for (size_t q = 0; q < of->result->num && status == PSPEC_OK; q++) {
        const bool is_first_of_line = q % block < step;
        if (is_first_of_line) {
            status = take_errors(of, &set, q, step, i_points);
        }
        const bool is_last = q + 1 == of->result->num;
        if (status == PSPEC_OK && set.num > 0 && (set.num == MOST_CURVES || is_last)) {
            status = draw_errors(of, &set, picture++);
            free_lines(&set);
            set = (line_set){.num = 0};
        }
    }
    free_lines(&set);
    return status;
}

/* ---- spectra ----------------------------------------------------------------------------- */

enum { CURVE_COLUMNS = 4 };

static pspec_status take_curve(const artist *of, size_t number, ps_plot_curve *out, ps_text *label,
                               double **numbers) {
    const ps_table *const table = of->result->questions[number].answer.table;
    const bool on_torus = of->result->asked->kind == &ps_result_power;
    const size_t num = ps_table_num_rows(table);
    void *memory = NULL;
    PS_TRY(ps_allocate(&memory, num, CURVE_COLUMNS * sizeof(double), "a curve", of->error));
    double *const columns = *numbers = memory;
    PS_TRY(
        read_column(table, on_torus ? "normalized_frequency" : "normalized_degree", columns));
    PS_TRY(read_column(table, "power", columns + num));
    PS_TRY(read_column(table, "standard_error", columns + 2 * num));
    PS_TRY(read_column(table, "anisotropy_db", columns + 3 * num));
    ps_run_label(of->result, number, label);
    *out = (ps_plot_curve){ps_text_string(label), num,           columns, columns + num,
                           columns + 2 * num,     columns + 3 * num};
    return ps_text_check(label, of->error);
}

static double noise_level(const artist *of, size_t number) {
    const ps_table *const table = of->result->questions[number].answer.table;
    return cell_number(ps_run_meta(table, "noise_level_db"));
}

/* Curves of a group; with an array, the picture of one spectrum. */
static pspec_status draw_spectra(const artist *of, const group *part, const ps_plot_image *image,
                                 const char *suffix) {
    ps_plot_curve curves[MOST_CURVES];
    ps_text labels[MOST_CURVES] = {{0}};
    double *numbers[MOST_CURVES] = {NULL};
    ps_text title = {0};
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < part->num; i++) {
        PS_TRY_OUT(status, take_curve(of, part->first + i, &curves[i], &labels[i], &numbers[i]));
    }
    write_title(of, part, image != NULL ? curves[0].label : "", &title);
    PS_TRY_OUT(status, ps_text_check(&title, of->error));
    const ps_plot plot = {ps_text_string(&title),        part->num, curves, image,
                          noise_level(of, part->first),  of->result->asked->kind !=
                                                             &ps_result_power};
    status = draw(of, &(drawing){.spectra = &plot}, suffix);
out:
    for (size_t i = 0; i < MOST_CURVES; i++) {
        ps_text_free(&labels[i]);
        free(numbers[i]);
    }
    ps_text_free(&title);
    return status;
}

static pspec_status draw_groups(const artist *of) {
    char suffix[64];
    for (size_t g = 0; g < count_groups(of->result); g++) {
        const group part = group_at(of->result, g);
        snprintf(suffix, sizeof suffix, part.value != NULL ? "-%zu" : "", g + 1);
        if (part.num <= MOST_CURVES) {
            PS_TRY(draw_spectra(of, &part, NULL, suffix));
        }
    }
    return PSPEC_OK;
}

/* Of every question whose array was wanted and is there. */
static pspec_status draw_pictures(const artist *of) {
    char suffix[64];
    for (size_t q = 0; q < of->result->num; q++) {
        const ps_answer *const answer = &of->result->questions[q].answer;
        const double points = cell_number(ps_run_meta(answer->table, "points"));
        if (answer->array == NULL || !(points > 0)) {
            continue;
        }
        const ps_plot_image image = {answer->side, answer->array, sqrt(points)};
        snprintf(suffix, sizeof suffix, "-picture-%zu", q + 1);
        PS_TRY(draw_spectra(of, &(group){q, 1, NULL}, &image, suffix));
    }
    return PSPEC_OK;
}

/* Lists of frequencies have no normalized ones, and no picture. */
static bool has_bins(const ps_run_result *result) {
    size_t column = 0;
    const ps_table *const table = result->questions[0].answer.table;
    return ps_table_find_column(table, "normalized_frequency", &column) ||
           ps_table_find_column(table, "normalized_degree", &column);
}

pspec_status ps_run_make_plots(const ps_run *run, ps_run_result *result, ps_error *error) {
    const artist of = {run, result, error};
    const ps_result_kind *const kind = result->asked->kind;
    if (!result->asked->wants_plot) {
        return PSPEC_OK;
    }
    if (kind == &ps_result_power || kind == &ps_result_angular) {
        if (!has_bins(result)) {
            return PSPEC_OK;
        }
        PS_TRY(draw_groups(&of));
        return draw_pictures(&of);
    }
    if (kind == &ps_result_quadrature) {
        PS_TRY(draw_convergence(&of));
    }
    return draw_kinds(&of, kind == &ps_result_pairs        ? of_pairs
                           : kind == &ps_result_quadrature ? of_rules
                           : kind == &ps_result_truncation ? of_truncation
                                                           : of_checks);
}
