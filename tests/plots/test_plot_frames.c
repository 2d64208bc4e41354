/* Frames: how their series look, where their axes end, panels of them. */
#include "harness_plots.h"
#include "plots/plot.h"
#include "plots/plot_script.h"
#include "test_folder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* A panel of a curve on its band, marks with bars, and a reference, in this order. */
enum { NUM_LOOKS = 3, NUM_COUNTS = 4 };
static const double counts[] = {16, 64, 256, 1024};
static const double variances[] = {1e-2, 1e-3, 1e-4, 1e-5};
static const double lows[] = {0, 9e-4, 9e-5, 9e-6};
static const double highs[] = {1.5e-2, 1.1e-3, 1.1e-4, 1.1e-5};
static const double errors[] = {(double)NAN, 1e-4, 2e-4, 0};

static void make_looks(ps_series series[NUM_LOOKS]) {
    const ps_series common = {.kind = 1, .num = NUM_COUNTS, .x = counts, .y = variances};
    series[0] = series[1] = series[2] = common;
    series[0].look = PS_LOOK_CURVE;
    series[0].label = "jittered";
    series[0].low = lows;
    series[0].high = highs;
    series[1].look = PS_LOOK_MARKS;
    series[1].error = errors;
    series[2].look = PS_LOOK_REFERENCE;
    series[2].label = "white";
}

/* Columns 1 and 2 are the place, 3 the error, 4 and 5 the band. Neither goes below the end of a
 * logarithmic axis, which has no 0: a hundredth of the smallest number. Only what has a label is in
 * the key. */
static void looks_of_a_frame(void **state) {
    (void)state;
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panel = {"none", NUM_LOOKS, series, {0}};
    ps_figure plot = {.form = PS_FIGURE_FRAME,
                      .title = "variance",
                      .is_log_x = true,
                      .is_log_y = true,
                      .num_panels = 1,
                      .panels = &panel};
    assert_true(test_script_contains(&plot, "\n 64 0.001 NaN 0.0009 0.0011\n"));
    assert_true(test_script_contains(&plot, "\n 64 0.001 0.0001 NaN NaN\n"));
    assert_true(test_script_contains(&plot, "\n 64 0.001\n"));
    assert_true(test_script_contains(&plot,
                                     "plot $data0_0 using 1:($4 > 1e-07 ? $4 : 1e-07):5 with "
                                     "filledcurves "));
    assert_true(test_script_contains(&plot,
                                     ", $data0_0 using 1:2 with lines linewidth 1.6 linecolor "
                                     "rgb '#D55E00' dashtype 1 title \"jittered\", "));
    assert_true(test_script_contains(&plot,
                                     ", $data0_1 using 1:($3 > 0 ? $2 : NaN):($2-$3 > 1e-07 ? "
                                     "$2-$3 : 1e-07):($2+$3) with yerrorbars "));
    assert_true(test_script_contains(&plot,
                                     ", $data0_1 using 1:2 with points pointtype 7 pointsize 0.6 "
                                     "linecolor rgb '#D55E00' notitle, "));
    assert_true(test_script_contains(&plot,
                                     ", $data0_2 using 1:2 with lines linewidth 1 linecolor rgb "
                                     "'#808080' dashtype 2 title \"white\"\n"));
    assert_true(test_script_contains(&plot, "set yrange [1e-07:*]\n")); /* of the band at 16 */
    assert_false(test_script_contains(&plot, "\nset title"));
    plot.is_log_y = false;
    assert_true(test_script_contains(&plot, "using 1:($4):5 with filledcurves "));
    assert_true(test_script_contains(&plot, ":($2-$3):($2+$3) with yerrorbars "));
    assert_false(test_script_contains(&plot, "set yrange"));
}

/* Neither numbers that rounding left nor a band that goes down to them spoil an axis, and a band
 * that stays near leaves it to gnuplot. */
static void ends_of_a_logarithmic_axis(void **state) {
    (void)state;
    const double rounding[] = {1e-2, 1e-3, 1e-4, 1e-30};
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panel = {"none", 1, series, {0}};
    ps_figure plot = {
        .form = PS_FIGURE_FRAME, .title = "", .is_log_y = true, .num_panels = 1, .panels = &panel};
    series[0].low = variances;
    assert_false(test_script_contains(&plot, "set yrange"));
    series[0].low = lows;
    assert_true(test_script_contains(&plot, "set yrange [1e-07:*]\n"));
    series[0].low = series[0].high = NULL;
    series[0].y = rounding;
    assert_true(test_script_contains(&plot, "set yrange [1e-06:*]\n"));
    series[0].floor = 5e-4; /* a hundredth of the least number above it is below it */
    assert_true(test_script_contains(&plot, "set yrange [0.0005:*]\n"));
    series[0].floor = 1; /* nothing is above it */
    assert_false(test_script_contains(&plot, "set yrange"));
    series[0].floor = 0;
    series[0].y = variances;
    assert_false(test_script_contains(&plot, "set yrange"));
}

/* Within two decades a place has a tick that says its number; where it is asked for, there. */
static void ticks_of_few_places(void **state) {
    (void)state;
    const double points[] = {49, 64, 56, 60};
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panel = {"none", 1, series, {0}};
    ps_figure plot = {
        .form = PS_FIGURE_FRAME, .title = "", .is_log_x = true, .num_panels = 1, .panels = &panel};
    series[0].x = points;
    assert_true(test_script_contains(&plot, "set xtics in mirror (50, 60, 70)\nset xrange [42.6"));
    plot.axes = (ps_plot_axes){.has_x = true, .x = {10, 1000}};
    assert_true(
        test_script_contains(&plot, "set xtics in mirror (10, 20, 50, 100, 200, 500, 1000)\n"));
    plot.axes.x[1] = 2000;
    assert_true(
        test_script_contains(&plot, "set xtics in mirror autofreq\nset format x '10^{%T}'\n"));
}

/* All panels have the same axes: those of what is more than rounding. */
static void axes_of_panels(void **state) {
    (void)state;
    const double rounding[] = {1e-2, 1e-3, 1e-12, 1e-15};
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panels[] = {{"1", 1, series, {0}}, {"2", 1, series + 1, {0}}};
    const ps_figure plot = {.form = PS_FIGURE_PANELS,
                            .title = "",
                            .is_log_y = true,
                            .num_panels = 2,
                            .panels = panels,
                            .shares_axes = true};
    series[1].y = rounding;
    assert_true(test_script_contains(&plot, "set yrange [9.52380952e-16:0.0105]\n"));
    series[1].floor = 1e-10;
    assert_true(test_script_contains(&plot, "set yrange [9.52380952e-06:0.0105]\n"));
    assert_true(test_script_contains(&plot, "set xrange [0:1075.2]\n"));
}

/* A place that is alone has no line, and a box instead of a band. */
static void single_places_of_a_frame(void **state) {
    (void)state;
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panel = {"none", NUM_LOOKS, series, {0}};
    const ps_figure plot = {
        .form = PS_FIGURE_FRAME, .title = "", .num_panels = 1, .panels = &panel};
    for (size_t i = 0; i < NUM_LOOKS; i++) {
        series[i].num = 1;
    }
    assert_false(test_script_contains(&plot, "with lines"));
    assert_true(test_script_contains(&plot, "$data0_0 using 1:2 with points pointtype 6 "));
    assert_true(test_script_contains(&plot,
                                     "plot $data0_0 using 1:2:($1*0.985):($1*1.015):($4):5 with "
                                     "boxxyerror fillstyle "));
    assert_true(test_script_contains(&plot, "$data0_2 using 1:2 with points pointtype 1 "));
}

/* Panels with axes and a key of their own, also one in which there is nothing to see. */
static void draws_frames(void **state) {
    static const double nothing[NUM_COUNTS] = {0};
    static const char *const names[] = {"frames.svg", "frames.png", "frames.pdf"};
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_series empty = {
        .look = PS_LOOK_CURVE, .label = "a", .num = NUM_COUNTS, .x = counts, .y = nothing};
    const ps_panel panels[] = {{"the_first's", NUM_LOOKS, series, {0}},
                               {"nothing", 1, &empty, {0}},
                               {"3", 2, series, {0}},
                               {"4", NUM_LOOKS, series, {0}},
                               {"5", 1, series, {0}}};
    ps_figure plot = {.form = PS_FIGURE_FRAME,
                      .title = "it's \"a_b\"",
                      .x_label = "x",
                      .y_label = "y",
                      .is_log_x = true,
                      .is_log_y = true,
                      .panels = panels};
    for (plot.num_panels = 1; plot.num_panels <= 5; plot.num_panels++) {
        const char *const name = names[plot.num_panels % 3];
        char path[TEST_PATH_BYTES];
        ps_error said = {0};
        if (test_has_gnuplot() &&
            ps_figure_write(test_path(*state, name, path), &plot, &said) != PSPEC_OK) {
            fail_msg("%zu: %s", plot.num_panels, said.message);
        }
    }
    plot.num_panels = 4; /* two rows of two */
    assert_true(test_script_contains(&plot, "set terminal svg enhanced size 1440,1320 "));
    assert_true(test_script_contains(&plot, "set title \"the\\137first\\047s\" noenhanced"));
    assert_true(test_script_contains(&plot, "plot $data3_0 using "));
    assert_false(test_script_contains(&plot, "$data1_0 using"));
    plot.num_panels = 1;
    assert_true(test_script_contains(&plot, "set terminal svg enhanced size 1000,700 "));
}

/* gnuplot takes letters for wider than they are, and the longer a label, the more so. */
static void long_labels_of_a_frame(void **state) {
    (void)state;
    ps_series series[NUM_LOOKS];
    make_looks(series);
    const ps_panel panels[] = {{"1", NUM_LOOKS, series, {0}}, {"2", NUM_LOOKS, series, {0}}};
    const ps_figure plot = {
        .form = PS_FIGURE_FRAME, .title = "", .num_panels = 2, .panels = panels};
    assert_true(test_script_contains(&plot, " maxcols 4 samplen 2 spacing 1.05 width 0\n"));
    series[0].label = "best bound: slope -12.6751"; /* 26 letters */
    assert_true(test_script_contains(&plot, " maxcols 2 samplen 2 spacing 1.05 width -4.37\n"));
    ps_figure wide = plot;
    wide.num_panels = 1; /* a page of its own has room for more of them */
    assert_true(test_script_contains(&wide, " maxcols 2 samplen 2 spacing 1.05 width 0\n"));
    series[0].label = "64, glossy:n=30, fibonacci-hemisphere, 4"; /* 40 letters */
    assert_true(test_script_contains(&wide, " maxcols 2 samplen 2 spacing 1.05 width -5.87\n"));
    /* The page ends after 58 letters: the middle is left out, and what tells names apart stays. */
    series[0].label =
        "begins aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa ends";
    assert_true(test_script_contains(&plot, " maxcols 1 samplen 2 spacing 1.05 width -9.54\n"));
    assert_true(test_script_contains(&plot, " title \"begins aaaaaaaaaaaaaaaaaaaaaa…"));
    assert_true(test_script_contains(&plot, "a ends\""));
    assert_false(test_script_contains(&plot, "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"));
}

/* A panel may have axes of its own: a plane has the same unit on both. */
static void planes_of_a_frame(void **state) {
    (void)state;
    const double x[] = {1, -3};
    const double y[] = {4, 2};
    const ps_series cloud = {.look = PS_LOOK_CLOUD, .num = 2, .x = x, .y = y};
    ps_panel panels[] = {{"parts", 1, &cloud, {0}}, {"plane", 1, &cloud, {0}}};
    ps_figure plot = {.form = PS_FIGURE_FRAME,
                      .title = "",
                      .x_label = "x",
                      .y_label = "y",
                      .num_panels = 2,
                      .panels = panels};
    assert_false(test_script_contains(&plot, "set yrange"));
    panels[0].frame.x_label = "k";
    panels[1].frame = (ps_frame){PS_FRAME_PLANE, 0, 0, "real", "imaginary", false};
    assert_true(test_script_contains(&plot, "set xlabel \"k\" offset 0,0\nset ylabel \"y\" "));
    assert_true(test_script_contains(&plot, "set xlabel \"real\" offset 0,0\n"));
    assert_true(test_script_contains(&plot, "set ylabel \"imaginary\" offset 0,0\n"));
    /* 4.2 up and down in 526 pixels, so much more in 601 */
    assert_true(test_script_contains(&plot, "set xrange [-4.79885"));
    assert_true(test_script_contains(&plot, "set yrange [-4.2:4.2]\n"));
    assert_true(
        test_script_contains(&plot, "with points pointtype 7 pointsize 0.3 linecolor rgb '#b"));
}

/* What has no slope says none. */
static void slopes(void **state) {
    (void)state;
    const double zero[NUM_COUNTS] = {0};
    const double fallen[NUM_COUNTS] = {6e-6, 2e-10, 3e-24, 0};
    ps_series series = {.num = NUM_COUNTS, .x = counts, .y = variances};
    ps_text label = {0};
    ps_series_say_slope(&series, &label);
    assert_string_equal(ps_text_string(&label), "slope -1.661"); /* 1 / log10 4 */
    ps_text_free(&label);
    ps_text_append(&label, "a");
    series.num = 1;
    ps_series_say_slope(&series, &label);
    series.num = NUM_COUNTS;
    series.floor = 1e-4; /* two places are above it: they would have any slope */
    ps_series_say_slope(&series, &label);
    series.y = fallen;
    series.floor = 0;
    ps_series_say_slope(&series, &label);
    series = (ps_series){.num = NUM_COUNTS, .x = counts, .y = zero};
    ps_series_say_slope(&series, &label);
    assert_string_equal(ps_text_string(&label), "a");
    series = (ps_series){.num = NUM_COUNTS, .x = counts, .y = variances, .floor = 1e-5};
    ps_series_say_slope(&series, &label); /* of the first three */
    assert_string_equal(ps_text_string(&label), "a: slope -1.661");
    ps_text_free(&label);
}

/* Marks of the same place have different sizes, the last one the least; what is elsewhere hides
 * nothing. */
static void marks_that_coincide(void **state) {
    (void)state;
    const double near[] = {1.05e-2};
    const double far[] = {2e-2};
    ps_series series[] = {{.look = PS_LOOK_CURVE, .num = 1, .x = counts, .y = variances},
                          {.look = PS_LOOK_MARKS, .num = 1, .x = counts, .y = near},
                          {.look = PS_LOOK_CURVE, .num = 1, .x = counts, .y = near},
                          {.look = PS_LOOK_MARKS, .num = 1, .x = counts, .y = variances},
                          {.look = PS_LOOK_CURVE, .num = 1, .x = counts, .y = far}};
    const ps_panel panel = {"none", sizeof series / sizeof series[0], series, {0}};
    const ps_figure plot = {.form = PS_FIGURE_FRAME,
                            .title = "",
                            .is_log_x = true,
                            .is_log_y = true,
                            .num_panels = 1,
                            .panels = &panel};
    assert_true(
        test_script_contains(&plot, "$data0_0 using 1:2 with points pointtype 6 pointsize 1.75"));
    assert_true(
        test_script_contains(&plot, "$data0_1 using 1:2 with points pointtype 7 pointsize 0.95"));
    assert_true(
        test_script_contains(&plot, "$data0_2 using 1:2 with points pointtype 6 pointsize 1.4 "));
    assert_true(
        test_script_contains(&plot, "$data0_3 using 1:2 with points pointtype 7 pointsize 0.6 "));
    assert_true(
        test_script_contains(&plot, "$data0_4 using 1:2 with points pointtype 6 pointsize 1.4 "));
}

/* Rows of the key end where the label of the axis begins, however many there are. */
static void keys_leave_room_for_the_axis(void **state) {
    (void)state;
    ps_series series[6];
    const ps_panel panel = {"none", 6, series, {0}};
    const ps_figure plot = {
        .form = PS_FIGURE_FRAME, .title = "", .num_panels = 1, .panels = &panel};
    make_looks(series);
    for (size_t i = 0; i < 6; i++) {
        series[i] = series[0];
        series[i].label = "a name that is so long that there is one column alone";
    }
    /* 84 and 6 rows of 25 pixels, measured in pictures, of 700 */
    assert_true(test_script_contains(&plot, "set bmargin at screen 0.3342"));
    assert_true(test_script_contains(&plot, "maxcols 1 samplen 2 spacing 1.05 "));
    series[0].formula = "d_l^2"; /* rows of 31.4 */
    assert_true(test_script_contains(&plot, "set bmargin at screen 0.38928"));
    assert_true(test_script_contains(&plot, "spacing 1.32 "));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(draws_frames, test_folder_create, test_folder_remove),
        cmocka_unit_test(looks_of_a_frame),
        cmocka_unit_test(ends_of_a_logarithmic_axis),
        cmocka_unit_test(ticks_of_few_places),
        cmocka_unit_test(axes_of_panels),
        cmocka_unit_test(single_places_of_a_frame),
        cmocka_unit_test(long_labels_of_a_frame),
        cmocka_unit_test(planes_of_a_frame),
        cmocka_unit_test(slopes),
        cmocka_unit_test(marks_that_coincide),
        cmocka_unit_test(keys_leave_room_for_the_axis),
    };
    return cmocka_run_group_tests_name("plot_frames", tests, NULL, NULL);
}
