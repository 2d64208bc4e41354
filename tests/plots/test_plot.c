/* Pictures: drawn for every terminal and shape of data, and refused with a sentence otherwise. */
#include "harness_plots.h"
#include "plots/plot.h"
#include "plots/plot_script.h"
#include "test_folder.h"

#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <cmocka.h>

enum { NUM_BINS = 20, IMAGE_SIZE = 2 * NUM_BINS + 1 };

typedef struct example {
    double frequency[NUM_BINS], power[NUM_BINS], error[NUM_BINS], anisotropy[NUM_BINS];
    double image[IMAGE_SIZE * IMAGE_SIZE];
    ps_series curves[9];
    ps_panel panel;
    ps_plot_image picture;
    ps_figure plot;
} example;

static void make_example(example *out, size_t num_curves, bool has_image, bool has_errors) {
    for (size_t i = 0; i < NUM_BINS; i++) {
        out->frequency[i] = (double)(i + 1) / 8;
        out->power[i] = 1 - exp(-out->frequency[i]);
        out->error[i] = has_errors ? 0.1 : (double)NAN;
        out->anisotropy[i] = has_errors ? -10 : i % 2 ? (double)NAN : -(double)INFINITY;
    }
    for (size_t i = 0; i < IMAGE_SIZE * IMAGE_SIZE; i++) {
        out->image[i] = (double)(i % 7) / 3;
    }
    for (size_t i = 0; i < num_curves; i++) {
        out->curves[i] = (ps_series){.label = "it's \"a_b\" {x^2} `date` \\ $c",
                                     .kind = i,
                                     .num = NUM_BINS,
                                     .x = out->frequency,
                                     .y = out->power,
                                     .error = out->error,
                                     .anisotropy = out->anisotropy,
                                     .num_realizations = has_errors ? 10 : 1};
    }
    out->picture = (ps_plot_image){.size = IMAGE_SIZE, .power = out->image, .unit = 8};
    out->panel = (ps_panel){NULL, num_curves, out->curves, {0}};
    out->plot = (ps_figure){.form = PS_FIGURE_SPECTRA,
                            .title = "it's \"a_b\"\nexit 1; `false` {",
                            .num_panels = 1,
                            .panels = &out->panel,
                            .image = has_image ? &out->picture : NULL};
}

static void draws_every_kind(void **state) {
    static const struct {
        const char *name, *start;
    } kinds[] = {{"a 'b'\n\"c\".png", "\x89PNG"}, {"b.SVG", "<?xml"}, {"c.pdf", "%PDF"}};
    if (!test_has_gnuplot()) {
        print_message("gnuplot is not installed: skipped\n");
        skip();
    }
    for (size_t i = 0; i < 3 * 4; i++) {
        example data;
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        make_example(&data, i % 4 == 3 ? 9 : 1 + i % 2, i % 4 < 2, i % 4 != 1);
        test_path(*state, kinds[i / 4].name, path);
        assert_true(ps_plot_is_supported(path));
        if (ps_figure_write(path, &data.plot, &error) != PSPEC_OK) {
            fail_msg("%s", error.message);
        }
        char *const file = test_read_file(path, NULL);
        assert_memory_equal(file, kinds[i / 4].start, strlen(kinds[i / 4].start));
        free(file);
        assert_int_equal(test_folder_count(*state, true), 1);
    }
}

static void refuses_what_cannot_be_drawn(void **state) {
    example data;
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    make_example(&data, 1, true, true);
    assert_false(ps_plot_is_supported("a.jpg") || ps_plot_is_supported("png"));
    assert_int_equal(ps_figure_write("a.jpg", &data.plot, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(error.message, "a.jpg: pictures end in .png, .svg or .pdf");
    data.panel.num_series = 0;
    test_path(*state, "a.png", path);
    assert_int_equal(ps_figure_write(path, &data.plot, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(test_folder_count(*state, false), 0);
}

/* Draws with PATH set to the folder of the test. */
static pspec_status draw_with_path(const test_folder *folder, ps_error *error) {
    example data;
    char path[TEST_PATH_BYTES];
    char *const kept = strdup(getenv("PATH") != NULL ? getenv("PATH") : "");
    assert_non_null(kept);
    make_example(&data, 1, true, true);
    setenv("PATH", folder->path, 1);
    const pspec_status status =
        ps_figure_write(test_path(folder, "a.png", path), &data.plot, error);
    setenv("PATH", kept, 1);
    free(kept);
    return status;
}

static void names_the_package_without_gnuplot(void **state) {
    ps_error error = {0};
    assert_int_equal(draw_with_path(*state, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, "Debian package gnuplot-nox"));
    assert_int_equal(test_folder_count(*state, false), 0);
}

/* A program of ours under the name gnuplot. */
static void make_gnuplot(const test_folder *folder, const char *script) {
    char path[TEST_PATH_BYTES];
    test_path(folder, "gnuplot", path);
    assert_true(test_write_file(path, script, strlen(script)));
    assert_int_equal(chmod(path, 0700), 0);
}

static void passes_on_what_gnuplot_says(void **state) {
    ps_error error = {0};
    make_gnuplot(*state,
                 "#!/bin/sh\necho 'line 7: no terminal' >&2\necho half a picture\nexit 3\n");
    assert_int_equal(draw_with_path(*state, &error), PSPEC_ERROR_IO);
    assert_string_equal(error.message, "gnuplot could not draw the picture: line 7: no terminal");
    assert_int_equal(test_folder_count(*state, false), 1);
}

/* Neither success without a whole picture nor a whole picture without success is enough. */
static void refuses_half_a_picture(void **state) {
    static const struct {
        const char *script, *said;
    } cases[] = {
        {"#!/bin/sh\n", "the picture is not complete"},
        {"#!/bin/sh\nprintf '\\211PNG and so on IEND\\256B`'\n", "the picture is not complete"},
        {"#!/bin/sh\nprintf '\\211PNG IEND\\256B`\\202'\nexit 1\n", "it says nothing more"},
        {"#!/bin/sh\nprintf '\\211PNG IEND\\256B`\\202'\n", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_error error = {0};
        make_gnuplot(*state, cases[i].script);
        const pspec_status status = draw_with_path(*state, &error);
        assert_int_equal(status, cases[i].said != NULL ? PSPEC_ERROR_IO : PSPEC_OK);
        if (cases[i].said != NULL) {
            assert_non_null(strstr(error.message, cases[i].said));
        }
        assert_int_equal(test_folder_count(*state, true), cases[i].said != NULL ? 1 : 2);
        assert_true(waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD);
    }
}

/* In a process of its own, since the limit cannot be lifted again by everyone. The limit is above
 * the script and below the picture. */
static int draw_beyond_limit(const char *path) {
    enum { LIMIT = 8192 };
    const struct rlimit limit = {LIMIT, LIMIT};
    example data;
    ps_error error = {0};
    make_example(&data, 2, false, true);
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) {
        return 1;
    }
    if (ps_figure_write(path, &data.plot, &error) != PSPEC_ERROR_IO) {
        return 2;
    }
    if (strstr(error.message, "cannot write ") == NULL ||
        strstr(error.message, "File too large") == NULL) {
        return 3;
    }
    return waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD ? 0 : 4;
}

/* cairo does not notice, and gnuplot ends well. */
static void a_disk_that_fills_leaves_no_picture(void **state) {
    static const char *const names[] = {"a.png", "a.svg", "a.pdf"};
    if (!test_has_gnuplot()) {
        skip();
    }
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[TEST_PATH_BYTES];
        int result = 0;
        test_path(*state, names[i], path);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            _exit(draw_beyond_limit(path));
        }
        assert_int_equal(waitpid(child, &result, 0), child);
        assert_true(WIFEXITED(result));
        assert_int_equal(WEXITSTATUS(result), 0);
        assert_int_equal(test_folder_count(*state, false), 0);
    }
}

/* One realization has an anisotropy but no level of noise. */
static void no_key_without_something_in_it(void **state) {
    example data;
    (void)state;
    make_example(&data, 1, false, true);
    assert_true(test_script_contains(&data.plot, "\nset key"));
    data.curves[0].num_realizations = 1;
    assert_false(test_script_contains(&data.plot, "\nset key"));
    assert_true(test_script_contains(&data.plot, "anisotropy"));
}

/* Six ticks at most, for the lower panel is low. */
static void ticks_of_anisotropy(void **state) {
    static const struct {
        double highest;
        const char *ticks;
    } cases[] = {{-10, "\nset ytics 0.2 "}, {-7, "\nset ytics 1 "},  {-4, "\nset ytics 2 "},
                 {2, "\nset ytics 5 "},     {25, "\nset ytics 10 "}, {200, "\nset ytics 50 "}};
    example data;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        make_example(&data, 1, false, true);
        data.anisotropy[3] = cases[i].highest;
        assert_true(test_script_contains(&data.plot, cases[i].ticks));
    }
}

static void a_single_bin_is_a_point(void **state) {
    example data;
    (void)state;
    make_example(&data, 1, false, true);
    data.plot.on_sphere = true;
    assert_false(test_script_contains(&data.plot, "with points"));
    data.curves[0].num = 1;
    assert_true(test_script_contains(&data.plot, "using 1:2 with points"));
    assert_false(test_script_contains(&data.plot, "with lines linewidth 1.6"));
}

/* A curve that is far above all others leaves the picture to them, and its label says how far it
 * goes; what was asked for holds. */
static void loud_curves(void **state) {
    (void)state;
    example data;
    double loud[NUM_BINS];
    make_example(&data, 3, false, false);
    for (size_t i = 0; i < NUM_BINS; i++) {
        loud[i] = i == 7 ? 40 : 0;
    }
    assert_false(test_script_contains(&data.plot, "\\050to "));
    data.curves[1].y = loud;
    assert_true(test_script_contains(&data.plot, "\\050to \\064\\060\\051\""));
    assert_true(test_script_contains(&data.plot, "set yrange [0:1."));
    loud[7] = 4; /* less than five times white noise */
    assert_false(test_script_contains(&data.plot, "\\050to "));
    loud[7] = 40;
    data.panel.series = &data.curves[1]; /* nothing beside it */
    data.panel.num_series = 1;
    assert_false(test_script_contains(&data.plot, "\\050to "));
    data.panel.series = data.curves;
    data.panel.num_series = 3;
    data.plot.axes = (ps_plot_axes){.has_y = true, .y = {0, 50}};
    assert_true(test_script_contains(&data.plot, "set yrange [0:50]"));
    assert_false(test_script_contains(&data.plot, "\\050to "));
    data.plot.axes = (ps_plot_axes){.has_log = true, .is_log_y = true};
    assert_true(test_script_contains(&data.plot, "set logscale y\n"));
    assert_false(test_script_contains(&data.plot, "set yrange [0:"));
}

static void axes_that_were_asked_for(void **state) {
    (void)state;
    example data;
    make_example(&data, 1, false, true);
    data.plot.axes =
        (ps_plot_axes){.has_log = true, .is_log_x = true, .has_x = true, .x = {0.25, 4}};
    assert_true(test_script_contains(&data.plot, "set logscale x\n"));
    assert_true(test_script_contains(&data.plot, "set xrange [0.25:4]\n"));
    data.plot.form = PS_FIGURE_FRAME;
    data.plot.is_log_x = data.plot.is_log_y = true;
    data.plot.axes = (ps_plot_axes){.has_log = true, .has_y = true, .y = {-1, 2}};
    assert_false(test_script_contains(&data.plot, "\nset logscale"));
    assert_true(test_script_contains(&data.plot, "set yrange [-1:2]\n"));
}

/* Formulas are typeset; in what stands behind them no character means anything. */
static void formulas(void **state) {
    (void)state;
    example data;
    make_example(&data, 2, false, true);
    data.plot.form = PS_FIGURE_FRAME;
    data.curves[0].formula = "d_l^2";
    data.curves[0].label = "a_b^c";
    assert_true(test_script_contains(&data.plot, "d\\137l\\136\\062\\175\\054 "
                                                 "a\\134\\137b\\134\\136c\""));
    data.curves[0].label = NULL;
    assert_true(test_script_contains(&data.plot, "title \"\\173\\057\\052\\061\\056\\063\\065 "
                                                 "d\\137l\\136\\062\\175\""));
}

/* In SVG nothing is put on something else: what is raised stands behind what is lowered. */
static void formulas_in_svg(void **state) {
    (void)state;
    example data;
    ps_text script = {0};
    ps_text svg = {0};
    ps_error said = {0};
    if (!test_has_gnuplot()) {
        skip();
    }
    make_example(&data, 2, false, true);
    data.plot.form = PS_FIGURE_FRAME;
    data.curves[0].formula = "d_l^2";
    assert_int_equal(ps_figure_write_script(&script, &data.plot, &said), PSPEC_OK);
    assert_int_equal(ps_plot_draw_script(&svg, &script, &said), PSPEC_OK);
    ps_text_free(&script);
    const char *const begin = strstr(ps_text_string(&svg), ">d</tspan>");
    assert_non_null(begin);
    assert_non_null(strstr(begin, "dy=\"-17.28px\">2</tspan>"));
    assert_null(strstr(begin, "dx=\"-"));
    ps_text_free(&svg);
}

/* One panel and many, some of them empty, in every format. */
static void draws_panels(void **state) {
    static const double x[] = {1e-5, 1e-4, 0, 1e-3};
    static const double y[] = {1e-3, (double)NAN, 1e-6, 1e-12};
    const ps_series series[] = {
        {.label = "it's a front", .look = PS_LOOK_FRONT, .num = 4, .x = x, .y = y},
        {.label = "a_b {x}", .look = PS_LOOK_SIGNS, .kind = 3, .num = 4, .x = x, .y = y}};
    const ps_panel panels[] = {{"first's", 2, series, {0}},
                               {"none", 0, NULL, {0}},
                               {"2", 1, series, {0}},
                               {"3", 2, series, {0}},
                               {"4", 2, series, {0}}};
    static const char *const names[] = {"panels.svg", "panels.png", "panels.pdf"};
    ps_error said = {0};
    char path[TEST_PATH_BYTES];
    ps_figure plot = {.form = PS_FIGURE_PANELS,
                      .is_log_x = true,
                      .is_log_y = true,
                      .title = "it's \"a_b\"",
                      .x_label = "x",
                      .y_label = "y",
                      .num_panels = 5,
                      .panels = panels};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && test_has_gnuplot(); i++) {
        plot.num_panels = i == 0 ? 1 : 5;
        if (ps_figure_write(test_path(*state, names[i], path), &plot, &said) != PSPEC_OK) {
            fail_msg("%s: %s", names[i], said.message);
        }
    }
    assert_int_equal(test_folder_count(*state, false), test_has_gnuplot() ? 3 : 0);
    plot.num_panels = 0;
    assert_int_equal(ps_figure_write(test_path(*state, "no.svg", path), &plot, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, "nothing to plot"));
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(draws_every_kind),
        IN_FOLDER(draws_panels),
        IN_FOLDER(refuses_what_cannot_be_drawn),
        IN_FOLDER(names_the_package_without_gnuplot),
        IN_FOLDER(passes_on_what_gnuplot_says),
        IN_FOLDER(refuses_half_a_picture),
        IN_FOLDER(a_disk_that_fills_leaves_no_picture),
        cmocka_unit_test(no_key_without_something_in_it),
        cmocka_unit_test(ticks_of_anisotropy),
        cmocka_unit_test(a_single_bin_is_a_point),
        cmocka_unit_test(loud_curves),
        cmocka_unit_test(axes_that_were_asked_for),
        cmocka_unit_test(formulas),
        cmocka_unit_test(formulas_in_svg),
    };
    return cmocka_run_group_tests_name("plot", tests, NULL, NULL);
}
