/* Scripts of points and maps: what gnuplot is given, and that it draws it. */
#include "plots/plot_script.h"
#include "test_folder.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { NUM = 3, MOST_PANELS = 3 };

typedef struct example {
    double x[NUM], y[NUM];
    ps_series series[MOST_PANELS];
    ps_panel panels[MOST_PANELS];
    ps_figure figure;
} example;

/* A square or a line, and both sides of the sphere, of which one has no points. */
static void make_example(example *out, ps_frame_form first) {
    for (size_t i = 0; i < NUM; i++) {
        out->x[i] = out->y[i] = (double)(i + 1) / 4;
    }
    for (size_t i = 0; i < MOST_PANELS; i++) {
        out->series[i] = (ps_series){.num = i < 2 ? NUM : 0, .x = out->x, .y = out->y};
        out->panels[i] = (ps_panel){i > 0 ? "a \"panel\"" : "",
                                    1,
                                    &out->series[i],
                                    {PS_FRAME_DISC, -1, 1, "x", "y", .is_mirrored = i == 2}};
    }
    out->panels[0].frame = (ps_frame){first, 0, 0.5, "x_1", "x_2", false};
    out->figure = (ps_figure){.form = PS_FIGURE_POINTS,
                              .title = "it's \"a\" `title`",
                              .num_panels = MOST_PANELS,
                              .panels = out->panels,
                              .num_columns = 2};
}

static char *write_script(const ps_figure *figure, const char *terminal) {
    ps_text script = {0};
    ps_error error = {0};
    assert_int_equal(ps_script_print_figure(&script, figure, terminal, &error), PSPEC_OK);
    return script.data;
}

static void asks_for_frames_and_points(void **state) {
    static const char *const parts[] = {"$data0_0 << EOD\n 0.25 0.25\n 0.5 0.5\n 0.75 0.75\nEOD\n",
                                        "$data2_0 << EOD\nEOD\n",
                                        "set xrange [0:0.5]\n",
                                        "set xtics (0, 0.5) out",
                                        "set xrange [-1.12:1.12]\n",
                                        "set xrange [1.12:-1.12]\n", /* x runs to the left */
                                        "\nplot NaN notitle, $data0_0 using ",
                                        "'+' using (cos(t)):(sin(t)) with lines linecolor rgb "
                                        "'#404040' linewidth 0.8 notitle, $data1_0 using ",
                                        "(sin(t)) with lines linecolor rgb '#404040' linewidth 0.8 "
                                        "notitle\n"}; /* without points */
    example data;
    (void)state;
    make_example(&data, PS_FRAME_SQUARE);
    char *const script = write_script(&data.figure, "svg");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (strstr(script, parts[i]) == NULL) {
            fail_msg("no \"%s\" in %s", parts[i], script);
        }
    }
    free(script);
}

/* Pixels are squares in the middle of the frame, row by row from the top, of which one alone is
 * there twice; signed ones have white in the middle of their colours. */
static void asks_for_pixels(void **state) {
    static const char *const parts[] = {
        "$data0_0 << EOD\n 0.25 0.5 0.75\n 0.25 0.5 0.75\nEOD\n", "set cbrange [-2:2]\n",
        ", 1 '#f4f2ee', 2 ", "set xrange [-0.5:2.5]\nset yrange [1.5:-1.5]\n",
        "plot $data0_0 matrix using 1:($2/2-.25):3 with image notitle\n"};
    example data;
    (void)state;
    make_example(&data, PS_FRAME_PIXELS);
    data.series[0].columns = 3;
    data.panels[0].frame.first = -2;
    data.panels[0].frame.last = 2;
    char *const script = write_script(&data.figure, "svg");
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (strstr(script, parts[i]) == NULL) {
            fail_msg("no \"%s\" in %s", parts[i], script);
        }
    }
    free(script);
}

/* One column, and one pixel, are there twice, too. */
static void single_columns_are_seen(void **state) {
    static const double values[] = {1, 2, 3};
    const ps_series series[] = {{.num = 3, .columns = 1, .y = values},
                                {.num = 1, .columns = 1, .y = values}};
    ps_panel panels[] = {{"", 1, &series[0], {.form = PS_FRAME_PIXELS, .last = 3}},
                         {"", 1, &series[1], {.form = PS_FRAME_PIXELS, .last = 3}}};
    const ps_figure figure = {
        .form = PS_FIGURE_POINTS, .num_panels = 2, .panels = panels, .num_columns = 2};
    (void)state;
    char *const script = write_script(&figure, "svg");
    assert_non_null(strstr(script, "$data0_0 << EOD\n 1 1\n 2 2\n 3 3\nEOD\n"));
    assert_non_null(strstr(script, "plot $data0_0 matrix using ($1/2-.25):2:3 with"));
    assert_non_null(strstr(script, "$data1_0 << EOD\n 1 1\n 1 1\nEOD\n"));
    assert_non_null(strstr(script, "plot $data1_0 matrix using ($1/2-.25):($2/2-.25):3 with"));
    free(script);
}

/* Frames of the same side in both directions, whatever the page. */
static void frames_are_square(void **state) {
    example data;
    int width = 0;
    int height = 0;
    (void)state;
    for (size_t columns = 1; columns <= PS_MOST_POINT_COLUMNS; columns++) {
        make_example(&data, PS_FRAME_SQUARE);
        data.figure.num_columns = columns;
        char *const script = write_script(&data.figure, "svg");
        const char *const size = strstr(script, " enhanced size ");
        assert_non_null(size);
        assert_int_equal(sscanf(size, " enhanced size %d,%d ", &width, &height), 2);
        double ends[4];
        for (size_t i = 0; i < 4; i++) {
            static const char *const names[] = {"set lmargin at screen ", "set rmargin at screen ",
                                                "set bmargin at screen ", "set tmargin at screen "};
            const char *const found = strstr(script, names[i]);
            assert_non_null(found);
            ends[i] = strtod(found + strlen(names[i]), NULL);
        }
        const double side = (ends[1] - ends[0]) * width;
        assert_true(side > 300 && width <= 2000);
        assert_true(side / ((ends[3] - ends[2]) * height) > 0.999);
        assert_true(side / ((ends[3] - ends[2]) * height) < 1.001);
        free(script);
    }
}

/* Below black, black, (1/4)^(1/2.2) of white, white, beyond white, in the order of the rows; and
 * maps of many pixels are shown by means of blocks, of which those at the ends may be smaller. */
static void maps_are_bright(void **state) {
    enum { LARGE = 1201 };
    static const double few[] = {-1, 0, .5, 2, 3, 1};
    static double many[LARGE]; /* a block of three pixels is 1, the others are 0 */
    many[3] = 3;
    const ps_series series = {.num = 6, .columns = 3, .y = few};
    const ps_panel panel = {"", 1, &series, {.form = PS_FRAME_LIGHT, .last = 2}};
    ps_panel panels[] = {panel, panel};
    const ps_figure figure = {
        .form = PS_FIGURE_POINTS, .num_panels = 2, .panels = panels, .num_columns = 2};
    const ps_series wide = {.num = LARGE, .columns = LARGE, .y = many};
    (void)state;
    panels[1].series = &wide;
    panels[1].frame.last = 1;
    char *const script = write_script(&figure, "svg");
    assert_non_null(strstr(script, "$data0_0 << EOD\n 0 0 136\n 255 255 186\nEOD\n"));
    assert_non_null(strstr(script, "set xrange [-1:3]\nset yrange [1.5:-0.5]\n"));
    assert_non_null(strstr(script, "$data1_0 << EOD\n 0 255 0 0"));
    assert_non_null(strstr(script, "plot $data0_0 matrix using 1:2:3 with"));
    assert_non_null(strstr(script, "plot $data1_0 matrix using 1:($2/2-.25):3 with"));
    assert_non_null(strstr(script, "set xrange [-0.5:400.5]\nset yrange [100.25:-100.25]\n"));
    free(script);
}

static size_t count(const char *text, const char *part) {
    size_t num = 0;
    while ((text = strstr(text, part)) != NULL) {
        text += strlen(part);
        num++;
    }
    return num;
}

static void draws_every_kind(void **state) {
    static const struct {
        const char *name, *start;
    } kinds[] = {{"a.png", "\x89PNG"}, {"b.svg", "<?xml"}, {"c.pdf", "%PDF"}};
    if (system("gnuplot --version >/dev/null 2>&1") != 0) {
        print_message("gnuplot is not installed: skipped\n");
        skip();
    }
    for (size_t i = 0; i < 2 * sizeof kinds / sizeof kinds[0]; i++) {
        example data;
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        make_example(&data, i % 2 == 0 ? PS_FRAME_SQUARE : PS_FRAME_LINE);
        data.panels[0].frame.last = 1;
        test_path(*state, kinds[i / 2].name, path);
        if (ps_figure_write(path, &data.figure, &error) != PSPEC_OK) {
            fail_msg("%s", error.message);
        }
        char *const file = test_read_file(path, NULL);
        assert_memory_equal(file, kinds[i / 2].start, strlen(kinds[i / 2].start));
        if (strcmp(kinds[i / 2].name, "b.svg") == 0) { /* marks of all points */
            assert_int_equal(count(file, "xlink:href='#gpPt6' transform"),
                             i % 2 == 0 ? 2 * NUM : NUM);
        }
        free(file);
        assert_int_equal(test_folder_count(*state, true), 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(asks_for_frames_and_points),
        cmocka_unit_test(asks_for_pixels),
        cmocka_unit_test(single_columns_are_seen),
        cmocka_unit_test(frames_are_square),
        cmocka_unit_test(maps_are_bright),
        cmocka_unit_test_setup_teardown(draws_every_kind, test_folder_create, test_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
