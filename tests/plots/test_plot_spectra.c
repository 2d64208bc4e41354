/* Pictures of spectra: what their axes cover, levels of noise, lines that lie on each other. */
#include "harness_plots.h"
#include "plots/plot_script.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { NUM = 6, IMAGE_SIZE = 5 };
static const double frequencies[NUM] = {0.04, 0.1, 0.2, 0.5, 1, 2};
static const double powers[NUM] = {5e-3, 0.03, 0.1, 0.6, 1, 1.1};
static const double none[NUM] = {NAN, NAN, NAN, NAN, NAN, NAN};
static const double anisotropies[NUM] = {-12, -11, -13, -12, -12, -13};

typedef struct example {
    ps_series curves[4];
    ps_panel panel;
    ps_figure plot;
} example;

static void make_example(example *out, size_t num_curves) {
    for (size_t i = 0; i < num_curves; i++) {
        out->curves[i] = (ps_series){.label = "a",
                                     .kind = i,
                                     .num = NUM,
                                     .x = frequencies,
                                     .y = powers,
                                     .error = none,
                                     .anisotropy = anisotropies,
                                     .num_realizations = 20};
    }
    out->panel = (ps_panel){NULL, num_curves, out->curves, {0}};
    out->plot = (ps_figure){.form = PS_FIGURE_SPECTRA,
                            .title = "title",
                            .num_panels = 1,
                            .panels = &out->panel,
                            .axes = {.has_log = true, .is_log_x = true, .is_log_y = true}};
}

/* Behind `at`, in a script. */
static ps_plot_span read_range(const char *at, const char *begin) {
    ps_plot_span out = {NAN, NAN};
    char *end = NULL;
    assert_non_null(at);
    out.least = strtod(at + strlen(begin), &end);
    assert_int_equal(*end, ':');
    out.most = strtod(end + 1, &end);
    assert_int_equal(*end, ']');
    return out;
}

/* The first range of this axis. */
static ps_plot_span find_range(const ps_figure *plot, const char *axis) {
    char *const script = test_script(plot);
    char begin[32];
    snprintf(begin, sizeof begin, "set %srange [", axis);
    const ps_plot_span out = read_range(strstr(script, begin), begin);
    free(script);
    return out;
}

/* That of the panel below the powers. */
static ps_plot_span find_lower_range(const ps_figure *plot) {
    static const char begin[] = "set yrange [";
    char *const script = test_script(plot);
    const char *const panel = strstr(script, "set ylabel \"anisotropy ");
    assert_non_null(panel);
    const ps_plot_span out = read_range(strstr(panel, begin), begin);
    free(script);
    return out;
}

/* All data are in sight, and axes do not go on to whole powers of ten. */
static void logarithmic_axes_keep_all_data(void **state) {
    (void)state;
    example data;
    make_example(&data, 1);
    const ps_plot_span x = find_range(&data.plot, "x");
    const ps_plot_span y = find_range(&data.plot, "y");
    assert_true(x.least < 0.04 && x.least > 0.03 && x.most > 2 && x.most < 3);
    assert_true(y.least < 5e-3 && y.least > 2e-3 && y.most > 1.1 && y.most < 3);
    data.plot.axes.is_log_x = false;
    assert_true(find_range(&data.plot, "x").least == 0);
    assert_true(find_range(&data.plot, "x").most == 2);
}

/* Numbers that rounding left do not stretch the axis; it has white noise in any case. */
static void axes_end_at_the_numerical_floor(void **state) {
    (void)state;
    const double rounded[NUM] = {1e-14, 1e-18, 3e-3, 1e-16, 0, 0.1};
    example data;
    make_example(&data, 1);
    data.curves[0].y = rounded;
    assert_true(find_range(&data.plot, "y").least < 1e-14);
    data.curves[0].floor = 1e-12;
    assert_true(find_range(&data.plot, "y").least > 2e-3);
    assert_true(find_range(&data.plot, "y").most > 1);
    assert_int_equal(test_script_count(&data.plot, "set arrow 1 from"), 1);
    data.curves[0].floor = 1; /* nothing is above it */
    const ps_plot_span y = find_range(&data.plot, "y");
    assert_true(y.least < 1 && y.most > 1);
    data.plot.axes.has_y = true;
    data.plot.axes.y[0] = 1e-3;
    data.plot.axes.y[1] = 0.5; /* white noise is not in it */
    assert_true(find_range(&data.plot, "y").most == 0.5);
    assert_int_equal(test_script_count(&data.plot, "set arrow 1 from"), 0);
}

/* Plain numbers where there are few decades, more of them where there is a part of one. */
static void ticks_of_short_axes(void **state) {
    (void)state;
    const double noise[NUM] = {1.1, 0.9, 0.8, 1.2, 1, 1};
    example data;
    make_example(&data, 1);
    assert_int_equal(
        test_script_count(&data.plot, "set xtics in mirror (0.05, 0.1, 0.2, 0.5, 1, 2)"), 2);
    assert_int_equal(test_script_count(&data.plot, "set format y '10^{%T}'"), 1);
    data.curves[0].y = noise;
    assert_int_equal(
        test_script_count(&data.plot, "set ytics in mirror (0.6, 0.8, 1, 1.2, 1.4, 1.6)"), 1);
}

/* The second panel of the sphere is the first one where both axes are logarithmic. */
static void the_sphere_has_one_panel_of_logarithms(void **state) {
    (void)state;
    example data;
    make_example(&data, 1);
    data.plot.on_sphere = true;
    assert_int_equal(test_script_count(&data.plot, "\nplot "), 1);
    data.plot.axes.is_log_y = false;
    assert_int_equal(test_script_count(&data.plot, "\nplot "), 2);
    data.plot.axes = (ps_plot_axes){0};
    assert_int_equal(test_script_count(&data.plot, "\nplot "), 2);
}

static const char grey[] = "NaN with lines linewidth 1.2 linecolor rgb '#707070' dashtype 2 title ";

/* Curves have the level of their own number of realizations; the key says it once. */
static void levels_of_noise(void **state) {
    (void)state;
    example data;
    char entry[128];
    make_example(&data, 3);
    snprintf(entry, sizeof entry, "%s\"pure noise\\054 \\055\\061\\063\\056\\060 dB\"", grey);
    assert_int_equal(test_script_count(&data.plot, entry), 1);
    data.curves[1].num_realizations = 1000;
    assert_int_equal(test_script_count(&data.plot,
                                       "linecolor rgb '#0072B2' dashtype 2 title \"pure noise of M "
                                       "\\075 \\062\\060\\054 "),
                     1);
    assert_int_equal(test_script_count(&data.plot,
                                       "linecolor rgb '#D55E00' dashtype 2 title \"pure noise of M "
                                       "\\075 \\061\\060\\060\\060\\054 "),
                     1);
    assert_int_equal(test_script_count(&data.plot, "pure noise"), 2);
    data.curves[0].num_realizations = data.curves[2].num_realizations = 1; /* the same every time */
    assert_int_equal(test_script_count(&data.plot, grey), 1);
    data.curves[1].num_realizations = 1;
    assert_int_equal(test_script_count(&data.plot, "pure noise"), 0);
}

/* Keys are below the frames: the page is higher by their rows of 25 pixels, and the axis has no
 * room for them. */
static void keys_stand_below(void **state) {
    (void)state;
    example data;
    make_example(&data, 4);
    data.plot.axes = (ps_plot_axes){0};
    data.curves[0].label = "a name that is so long that there is one column alone, as in files";
    assert_int_equal(test_script_count(&data.plot, " size 1000,825 "), 1);
    assert_int_equal(test_script_count(&data.plot, " maxcols 1 samplen 2 spacing 1.05 "), 1);
    data.curves[0].label = "a"; /* five entries in four columns: two rows */
    assert_int_equal(test_script_count(&data.plot, " size 1000,750 "), 1);
    assert_int_equal(test_script_count(&data.plot, "set bmargin at screen 0.18133\n"), 1);
    assert_true(find_range(&data.plot, "y").most < 1.2 * 1.06); /* the least that is shown is 1.2 */
    assert_true(find_lower_range(&data.plot).most < -11 + 0.51);
    data.plot.on_sphere = true; /* where no noise has a level */
    assert_int_equal(test_script_count(&data.plot, " size 1000,725 "), 1);
    data.panel.num_series = 1; /* no key, and no room for one */
    assert_int_equal(test_script_count(&data.plot, " size 1000,700 "), 1);
    assert_int_equal(test_script_count(&data.plot, "set key "), 0);
}

/* Both are in the key, once for all curves, and in sight. */
static void profiles_and_fits_are_in_the_key(void **state) {
    (void)state;
    const double low[NUM] = {1e-3, 0.01, 0.05, 0.3, 0.5, 0.5};
    const double high[NUM] = {6e-3, 0.04, 0.2, 0.9, 1.3, 1.7};
    const double fit[NUM] = {5e-3, 0.03, NAN, NAN, NAN, NAN};
    example data;
    make_example(&data, 2);
    data.plot.axes = (ps_plot_axes){0};
    assert_int_equal(test_script_count(&data.plot, "profile\""), 0);
    assert_int_equal(test_script_count(&data.plot, "title \"fit near "), 0);
    for (size_t i = 0; i < 2; i++) {
        data.curves[i].low = low;
        data.curves[i].high = high;
        data.curves[i].fit = fit;
    }
    assert_int_equal(test_script_count(&data.plot,
                                       "NaN with lines linewidth 1 linecolor rgb "
                                       "'#707070' dashtype 3 title \"lower\\054 upper profile\""),
                     1);
    assert_int_equal(test_script_count(&data.plot,
                                       "NaN with lines linewidth 1 linecolor rgb '#000000' "
                                       "title \"fit near \\060\""),
                     1);
    assert_true(find_range(&data.plot, "y").most > 1.7);
    data.panel.num_series = 1; /* which the title names */
    assert_int_equal(test_script_count(&data.plot, "title \"fit near "), 1);
    data.curves[0].fit = none;
    assert_int_equal(test_script_count(&data.plot, "title \"fit near "), 0);
}

/* Rings beside which others are 0 have marks where the axis has no 0; so have anisotropies beside
 * which there are none. */
static void rings_that_stand_alone(void **state) {
    (void)state;
    const double peaks[NUM] = {0, 3, 0, 0, 0, 5};
    const double alone[NUM] = {NAN, 9, NAN, NAN, NAN, 9};
    static const char mark[] = "$data0_0 using 1:2 with linespoints pointtype 7 ";
    example data;
    make_example(&data, 1);
    assert_int_equal(test_script_count(&data.plot, "linespoints"), 0);
    data.curves[0].y = peaks;
    assert_int_equal(test_script_count(&data.plot, mark), 1);
    data.curves[0].anisotropy = alone;
    assert_int_equal(
        test_script_count(&data.plot, "$data1_1 using 1:2 with linespoints pointtype 7 "), 1);
    data.plot.axes = (ps_plot_axes){0}; /* a line goes down to 0 */
    assert_int_equal(test_script_count(&data.plot, mark), 0);
    data.plot.on_sphere = true; /* the lower panel has no 0 */
    assert_int_equal(
        test_script_count(&data.plot, "$data1_0 using 1:2 with linespoints pointtype 7 "), 1);
    data.plot = (ps_figure){.form = PS_FIGURE_FRAME,
                            .title = "",
                            .is_log_y = true,
                            .num_panels = 1,
                            .panels = &data.panel};
    data.curves[0].look = PS_LOOK_CURVE;
    assert_int_equal(test_script_count(&data.plot, " with linespoints pointtype 6 "), 1);
}

/* The axis of powers has the label of the figure, in both panels of the sphere. */
static void labels_of_powers(void **state) {
    (void)state;
    example data;
    make_example(&data, 1);
    data.plot.axes = (ps_plot_axes){0};
    data.plot.y_label = "sums";
    assert_int_equal(test_script_count(&data.plot, "set ylabel \"sums\" "), 1);
    data.plot.on_sphere = true;
    assert_int_equal(test_script_count(&data.plot, "set ylabel \"sums\" "), 2);
}

/* It stands over what is no panel of points, and loses its middle where it is too long. */
static void titles_have_their_place(void **state) {
    (void)state;
    static const double x[] = {0.5};
    const ps_series series = {.num = 1, .x = x, .y = x};
    const ps_panel points = {"the first set", 1, &series, {PS_FRAME_SQUARE, 0, 1, "x", "y", false}};
    char title[202];
    example data;
    make_example(&data, 1);
    memset(title, 'a', sizeof title);
    memcpy(title, "\xc3\xa4", 2); /* one character */
    memcpy(title + 196, " end", 5);
    assert_int_equal(test_script_count(&data.plot, "set label 1 \"title\" at screen 0.5,"), 1);
    data.plot.points = &points;
    assert_int_equal(test_script_count(&data.plot, "set label 1 \"title\" at screen 0.697,"), 1);
    data.plot.title = title; /* 90 letters have room */
    assert_int_equal(test_script_count(&data.plot, "aaaaaaaa…aaaaaaaa"), 1);
    assert_int_equal(test_script_count(&data.plot, "aaa end\" at screen"), 1);
    title[90] = '\0';
    assert_int_equal(test_script_count(&data.plot, "…"), 0);
    title[90] = 'a';
    title[91] = 'a';
    title[92] = '\0';
    assert_int_equal(test_script_count(&data.plot, "…"), 1);
}

/* Curves of noise alone, and a panel of a single number. */
static void anisotropies_have_a_range(void **state) {
    (void)state;
    const double same[NUM] = {-3, -3, -3, -3, -3, -3};
    example data;
    make_example(&data, 1);
    data.curves[0].anisotropy = same;
    data.curves[0].num_realizations = 1;
    const ps_plot_span alone = find_lower_range(&data.plot);
    assert_true(alone.least < -3 && alone.most > -3);
    data.curves[0].num_realizations = 100; /* whose level is in sight, too */
    assert_true(find_lower_range(&data.plot).least < -20);
}

/* Of lines that lie on each other the lower ones are wider; marks blank nothing out. */
static void lines_that_coincide(void **state) {
    (void)state;
    double other[NUM];
    example data;
    make_example(&data, 3);
    const ps_script_panel panel = {.panel = data.panel, .y.is_log = true};
    assert_true(ps_script_line_width(&panel, 0) > 1 + ps_script_line_width(&panel, 1));
    assert_true(ps_script_line_width(&panel, 1) > 1 + ps_script_line_width(&panel, 2));
    for (size_t i = 0; i < NUM; i++) {
        other[i] = powers[i] * (i == 0 ? 1 : 1.1); /* near at one place */
    }
    data.curves[0].y = other;
    assert_true(ps_script_line_width(&panel, 0) == ps_script_line_width(&panel, 2));
    data.curves[1].look = PS_LOOK_MARKS;
    assert_true(ps_script_line_width(&panel, 1) == ps_script_line_width(&panel, 2));
    assert_int_equal(test_script_count(&data.plot, "\nset pointintervalbox 0.01\n"), 2);
}

/* White noise is the middle of the colours, wherever the scale ends. */
static void white_noise_is_neutral(void **state) {
    (void)state;
    double image[IMAGE_SIZE * IMAGE_SIZE] = {[3] = 100};
    ps_plot_image picture = {.size = IMAGE_SIZE, .power = image, .unit = 2};
    double own = 0;
    ps_error error = {0};
    example data;
    make_example(&data, 1);
    data.plot.image = &picture;
    assert_int_equal(test_script_count(&data.plot, "0.321928 '#f4f2ee', "), 1); /* log2(1.25) */
    assert_int_equal(test_script_count(&data.plot, "set cbrange [0:1.80735]"), 1);
    assert_int_equal(test_script_count(&data.plot, "'1' 0.321928"), 1);
    image[3] = 0;
    assert_int_equal(test_script_count(&data.plot, "0.321928 '#f4f2ee', "), 1);
    assert_int_equal(test_script_count(&data.plot, "set cbrange [0:0.436"), 1); /* 2 */
    assert_int_equal(test_script_count(&data.plot, "'1' 0.321928"), 1);
    picture.maximum = 100; /* that of another image */
    assert_int_equal(test_script_count(&data.plot, "set cbrange [0:1.80735]"), 1);
    assert_int_equal(ps_plot_find_maximum(&own, &picture, &error), PSPEC_OK);
    assert_true(own == 2);
}

/* Points stand to the left of all else, and leave nothing of their axes behind. */
static void points_beside_spectra(void **state) {
    (void)state;
    static const double x[] = {0, 0.25, 0.5};
    static const ps_frame_form forms[] = {PS_FRAME_SQUARE, PS_FRAME_LINE, PS_FRAME_DISC};
    const ps_series series = {.num = 3, .x = x, .y = x};
    ps_panel points = {"the first set", 1, &series, {0}};
    example data;
    make_example(&data, 1);
    data.plot.points = &points;
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        points.frame = (ps_frame){forms[i], 0, 1, "x", "y", false};
        assert_int_equal(test_script_count(&data.plot, "$data2_0 << EOD\n 0 0\n"),
                         1); /* 0 is no gap */
        assert_int_equal(test_script_count(&data.plot, ", $data2_0 using "), 1);
        assert_int_equal(test_script_count(&data.plot, "set terminal svg enhanced size 1650,725 "),
                         1);
        assert_int_equal(test_script_count(&data.plot, "\nreset\nset pointintervalbox "), 3);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(logarithmic_axes_keep_all_data),
        cmocka_unit_test(axes_end_at_the_numerical_floor),
        cmocka_unit_test(ticks_of_short_axes),
        cmocka_unit_test(the_sphere_has_one_panel_of_logarithms),
        cmocka_unit_test(levels_of_noise),
        cmocka_unit_test(keys_stand_below),
        cmocka_unit_test(profiles_and_fits_are_in_the_key),
        cmocka_unit_test(rings_that_stand_alone),
        cmocka_unit_test(labels_of_powers),
        cmocka_unit_test(titles_have_their_place),
        cmocka_unit_test(anisotropies_have_a_range),
        cmocka_unit_test(lines_that_coincide),
        cmocka_unit_test(white_noise_is_neutral),
        cmocka_unit_test(points_beside_spectra),
    };
    return cmocka_run_group_tests_name("plot_spectra", tests, NULL, NULL);
}
