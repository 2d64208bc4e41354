/* The picture of variances: which rows become which series, of several tables
 * and of one. */
#include "answers/kind.h"
#include "answers/variance/variance_table.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const names[] = {"sampler", "integrand", "points",         "predicted", "lower",
                                    "upper",   "measured",  "measured_error", "white"};
enum { NUM_NAMES = sizeof names / sizeof names[0] };

/* Columns from name number `first` on: 0 has samplers, 1 integrands, 2 neither. */
static ps_table *make_table(size_t first) {
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "variance", names + first, NUM_NAMES - first, &error),
                     PSPEC_OK);
    return table;
}

/* Numbers that tell all quantities apart: of N and p the prediction is p, and so on. */
static void add_row(ps_table *table, size_t first, const char *sampler, const char *integrand,
                    double points, double predicted) {
    const ps_cell cells[NUM_NAMES] = {
        PS_TEXT(sampler),           PS_TEXT(integrand),          PS_NUMBER(points),
        PS_NUMBER(predicted),       PS_NUMBER(0.9 * predicted),  PS_NUMBER(1.1 * predicted),
        PS_NUMBER(1.5 * predicted), PS_NUMBER(0.25 * predicted), PS_NUMBER(1 / points)};
    ps_error error = {0};
    assert_int_equal(ps_table_add_row(table, cells + first, &error), PSPEC_OK);
}

/* A curve of two places in a panel: N = 16 and 64, and these predictions. */
static void assert_curve(const ps_series *line, size_t kind, const char *label, double first,
                         double second) {
    const double predicted[] = {first, second};
    const double points[] = {16, 64};
    const ps_series *const marks = line + 1;
    assert_string_equal(line->label, label);
    assert_null(marks->label);
    assert_int_equal(line->look, PS_LOOK_CURVE);
    assert_int_equal(marks->look, PS_LOOK_MARKS);
    assert_int_equal(line->kind, kind);
    assert_int_equal(marks->kind, kind);
    assert_int_equal(line->num, 2);
    assert_int_equal(marks->num, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_true(line->x[i] == points[i]);
        assert_true(line->y[i] == predicted[i]);
        assert_true(line->low[i] == 0.9 * predicted[i]);
        assert_true(line->high[i] == 1.1 * predicted[i]);
        assert_true(marks->x[i] == points[i]);
        assert_true(marks->y[i] == 1.5 * predicted[i]);
        assert_true(marks->error[i] == 0.25 * predicted[i]);
    }
}

static void assert_white(const ps_series *line, size_t num) {
    assert_int_equal(line->look, PS_LOOK_REFERENCE);
    assert_string_equal(line->label, num > 1 ? "white noise: slope -1.000" : "white noise");
    assert_int_equal(line->num, num);
    for (size_t i = 0; i < num; i++) {
        assert_true(line->y[i] == 1 / line->x[i]);
    }
}

typedef void look_at(const ps_figure *figure);

static void draw(const ps_chart_part *parts, size_t num, look_at *look) {
    const ps_chart chart = {.what = ps_kind_variance.pictures,
                            .title = "title",
                            .num_parts = num,
                            .parts = parts,
                            .num_panels = 1};
    ps_pool memory = {0};
    ps_figure figure;
    ps_error error = {0};
    assert_int_equal(ps_variance_figure(&figure, &memory, &chart, &error), PSPEC_OK);
    look(&figure);
    ps_pool_free(&memory);
}

/* ---- a table for each question, as scenes have them ------------------------------------------ */

static void look_at_two_panels(const ps_figure *figure) {
    assert_int_equal(figure->form, PS_FIGURE_FRAME);
    assert_string_equal(figure->y_label, "variance: lines predicted, marks measured");
    assert_string_equal(figure->title, "title");
    assert_true(figure->is_log_x && figure->is_log_y);
    assert_int_equal(figure->num_panels, 2);
    assert_string_equal(figure->panels[0].title, "disk");
    assert_string_equal(figure->panels[1].title, "gaussian");
    assert_int_equal(figure->panels[0].num_series, 5);
    assert_curve(&figure->panels[0].series[0], 0, "jittered: slope -2.000", 1, 1. / 16);
    assert_curve(&figure->panels[0].series[2], 1, "fpo: slope -1.000", 4, 1);
    assert_white(&figure->panels[0].series[4], 2);
    assert_int_equal(figure->panels[1].num_series, 5);
    assert_curve(&figure->panels[1].series[0], 0, "jittered: slope -0.500", 2, 1);
    assert_curve(&figure->panels[1].series[2], 1, "fpo: slope -1.500", 8, 1);
    assert_white(&figure->panels[1].series[4], 2);
}

static void tables_of_several_questions(void **state) {
    (void)state;
    static const double points[] = {16, 64, 16, 64};
    static const double disk[] = {1, 1. / 16, 4, 1};
    static const double gaussian[] = {2, 1, 8, 1};
    ps_chart_part parts[4];
    for (size_t i = 0; i < 4; i++) {
        ps_table *const table = make_table(1);
        add_row(table, 1, "", "disk", points[i], disk[i]);
        add_row(table, 1, "", "gaussian", points[i], gaussian[i]);
        parts[i] = (ps_chart_part){
            .table = table, .request = &ps_request_default, .label = i < 2 ? "jittered" : "fpo"};
    }
    draw(parts, 4, look_at_two_panels);
    for (size_t i = 0; i < 4; i++) {
        ps_table_destroy((ps_table *)parts[i].table);
    }
}

/* ---- one table, as the command has it -------------------------------------------------------- */

static void the_table_of_a_command(void **state) {
    (void)state;
    ps_table *const table = make_table(0);
    add_row(table, 0, "jittered", "disk", 16, 1);
    add_row(table, 0, "jittered", "gaussian", 16, 2);
    add_row(table, 0, "jittered", "disk", 64, 1. / 16);
    add_row(table, 0, "jittered", "gaussian", 64, 1);
    add_row(table, 0, "fpo", "disk", 16, 4);
    add_row(table, 0, "fpo", "gaussian", 16, 8);
    add_row(table, 0, "fpo", "disk", 64, 1);
    add_row(table, 0, "fpo", "gaussian", 64, 1);
    draw(&(ps_chart_part){.table = table, .request = &ps_request_default, .label = ""}, 1,
         look_at_two_panels);
    ps_table_destroy(table);
}

/* ---- what is missing ------------------------------------------------------------------------- */

/* The second sampler has the first integrand alone. */
static void look_at_a_gap(const ps_figure *figure) {
    assert_int_equal(figure->num_panels, 2);
    assert_int_equal(figure->panels[0].num_series, 5);
    assert_int_equal(figure->panels[1].num_series, 3);
    assert_int_equal(figure->panels[0].series[2].kind, 1);
    assert_string_equal(figure->panels[1].series[0].label, "a, jittered");
    assert_white(&figure->panels[1].series[2], 1);
}

static void a_sampler_without_an_integrand(void **state) {
    (void)state;
    ps_table *const table = make_table(0);
    add_row(table, 0, "jittered", "disk", 16, 1);
    add_row(table, 0, "jittered", "gaussian", 16, 2);
    add_row(table, 0, "fpo", "disk", 16, 4);
    draw(&(ps_chart_part){.table = table, .request = &ps_request_default, .label = "a"}, 1,
         look_at_a_gap);
    ps_table_destroy(table);
}

/* Nothing was measured, and the integrand stands in the header. */
static void look_at_one(const ps_figure *figure) {
    assert_int_equal(figure->num_panels, 1);
    assert_string_equal(figure->panels[0].title, "disk");
    assert_int_equal(figure->panels[0].num_series, 3);
    assert_string_equal(figure->panels[0].series[0].label, "files"); /* no sampler */
    assert_true(isnan(figure->panels[0].series[1].y[0]));
    assert_string_equal(figure->y_label, "variance: rings predicted");
}

static void one_sampler_and_integrand(void **state) {
    (void)state;
    static const char *const few[] = {"points", "predicted", "white"};
    const ps_cell cells[] = {PS_INTEGER(16), PS_NUMBER(1), PS_NUMBER(2)};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "variance", few, 3, &error), PSPEC_OK);
    assert_int_equal(ps_table_add_meta(table, "integrand", PS_TEXT("disk"), &error), PSPEC_OK);
    assert_int_equal(ps_table_add_row(table, cells, &error), PSPEC_OK);
    draw(&(ps_chart_part){.table = table, .request = &ps_request_default, .label = ""}, 1,
         look_at_one);
    ps_table_destroy(table);
}

/* ---- bounds ---------------------------------------------------------------------------------- */

enum { BOUNDED_COLUMNS = 6, MOST_COUNTS = 3 };

/* Rows of one integrand: a sampler for each set of bounds, and a row for each of them. */
static ps_table *make_bounded(size_t num_samplers, size_t num_counts, const double *bounds) {
    static const char *const columns[] = {"sampler", "points",     "predicted",
                                          "white",   "best_bound", "worst_bound"};
    static const char *const samplers[] = {"jittered", "fpo"};
    ps_table *table = NULL;
    ps_error error = {0};
    assert_int_equal(ps_table_create(&table, "variance", columns, BOUNDED_COLUMNS, &error),
                     PSPEC_OK);
    for (size_t i = 0; i < num_samplers; i++) {
        for (size_t k = 0; k < num_counts; k++) {
            const double points = 16 << k;
            const ps_cell cells[] = {PS_TEXT(samplers[i]),  PS_NUMBER(points),
                                     PS_NUMBER(1 / points), PS_NUMBER(1 / points),
                                     PS_NUMBER(bounds[k]),  PS_NUMBER(1 / points)};
            assert_int_equal(ps_table_add_row(table, cells, &error), PSPEC_OK);
        }
    }
    return table;
}

/* Of the best bound one place is above the rounding of the variance of white noise: it would be a
 * line of a single place. */
static void look_at_a_fall(const ps_figure *figure) {
    const ps_panel *const panel = &figure->panels[0];
    assert_string_equal(figure->y_label, "variance: lines predicted, dots bounds");
    assert_int_equal(panel->num_series, 4);
    assert_string_equal(panel->series[2].label, "worst bound: slope -1.000");
}

/* Two of three places have no slope, though they are a line. */
static void look_at_a_line(const ps_figure *figure) {
    const ps_panel *const panel = &figure->panels[0];
    assert_int_equal(panel->num_series, 5);
    assert_string_equal(panel->series[2].label, "best bound");
}

static void look_at_crosses(const ps_figure *figure) {
    assert_string_equal(figure->y_label, "variance: rings predicted, crosses bounds");
    assert_int_equal(figure->panels[0].num_series, 9);
    assert_null(figure->panels[0].series[2].label); /* of two samplers */
}

static void bounds_that_are_drawn(void **state) {
    (void)state;
    static const struct {
        size_t num_samplers, num_counts;
        double bounds[MOST_COUNTS];
        look_at *look;
    } cases[] = {{1, 3, {1e-4, 3e-21, 2e-22}, look_at_a_fall},
                 {1, 3, {1e-4, 1e-10, 2e-22}, look_at_a_line},
                 {2, 1, {1e-4}, look_at_crosses}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_table *const table =
            make_bounded(cases[i].num_samplers, cases[i].num_counts, cases[i].bounds);
        draw(&(ps_chart_part){.table = table, .request = &ps_request_default, .label = ""}, 1,
             cases[i].look);
        ps_table_destroy(table);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_of_several_questions),
        cmocka_unit_test(the_table_of_a_command),
        cmocka_unit_test(a_sampler_without_an_integrand),
        cmocka_unit_test(one_sampler_and_integrand),
        cmocka_unit_test(bounds_that_are_drawn),
    };
    return cmocka_run_group_tests_name("variance_chart", tests, NULL, NULL);
}
