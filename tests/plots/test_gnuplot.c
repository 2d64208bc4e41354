/* gnuplot: where it is found, where its files are, and texts that it must not understand. */
#include "plots/plot.h"
#include "test_folder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { NUM = 3 };

typedef struct example {
    double x[NUM], y[NUM];
    ps_series curves[2];
    ps_panel panel;
    ps_figure plot;
} example;

static void make_example(example *out) {
    for (size_t i = 0; i < NUM; i++) {
        out->x[i] = out->y[i] = (double)(i + 1);
    }
    const ps_series curve = {
        .label = "a", .num = NUM, .x = out->x, .y = out->y, .error = out->y, .anisotropy = out->y};
    out->curves[0] = out->curves[1] = curve;
    out->panel = (ps_panel){NULL, 2, out->curves, {0}};
    out->plot = (ps_figure){
        .form = PS_FIGURE_SPECTRA,
        .title = "title",
        .num_panels = 1,
        .panels = &out->panel,
    };
}

static bool has_gnuplot(void) {
    return system("gnuplot --version >/dev/null 2>&1") == 0;
}

/* Texts that gnuplot, a shell, enhanced texts, XML or UTF-8 could misunderstand. Every one is a
 * title and a label. */
static const char *const hostile[] = {"'lead",
                                      "''",
                                      "'''a''b'",
                                      "\"\"q\" \\",
                                      "\\n \\047 \\\"",
                                      "`touch hostile`",
                                      "$(touch hostile) @PATH %d %s %",
                                      "{a}_b^c {/Symbol a} {x ~a{.8-}",
                                      "]]>",
                                      "<![CDATA[ ]]> ]]> <b> &amp; -->",
                                      "one\ntwo\ttab\x01\x1b\x7f",
                                      "\xc3\xa9 \xe2\x88\x9e \xf0\x9f\x8e\xb2 whole",
                                      "\xff\xc3 \xed\xa0\x80 \xef\xbf\xbf broken",
                                      "\"; system \"touch hostile\" #",
                                      "EOD",
                                      "glossy:n=30, 7=8=9"};

/* One that a parser of XML takes, where there is a parser. */
static void assert_is_xml(const char *path) {
    char command[2 * TEST_PATH_BYTES];
    snprintf(command, sizeof command,
             "! command -v python3 >/dev/null || python3 -c 'import sys, xml.dom.minidom as m; "
             "m.parse(sys.argv[1])' '%s'",
             path);
    assert_int_equal(system(command), 0);
}

/* What stands in the picture, where XML writes it without references. */
static void assert_shows(const char *path, const char *text) {
    char shown[TEST_PATH_BYTES];
    char *const file = test_read_file(path, NULL);
    snprintf(shown, sizeof shown, ">%s<", text);
    if (strpbrk(text, "<>&\n\xff") == NULL && strstr(file, shown) == NULL) {
        fail_msg("%s is not in %s", text, file);
    }
    free(file);
}

static void hostile_texts_are_drawn_as_they_are(void **state) {
    char path[TEST_PATH_BYTES];
    if (!has_gnuplot()) {
        skip();
    }
    test_path(*state, "a.svg", path);
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; i++) {
        example data;
        ps_error error = {0};
        make_example(&data);
        data.plot.title = data.curves[0].label = data.curves[1].label = hostile[i];
        ps_figure frame = data.plot;
        frame.form = PS_FIGURE_FRAME;
        frame.x_label = "x";
        frame.y_label = "y";
        if (ps_figure_write(path, &data.plot, &error) != PSPEC_OK) {
            fail_msg("%s: %s", hostile[i], error.message);
        }
        assert_is_xml(path);
        assert_shows(path, hostile[i]);
        if (ps_figure_write(path, &frame, &error) != PSPEC_OK) {
            fail_msg("%s: %s", hostile[i], error.message);
        }
        assert_is_xml(path);
        assert_shows(path, hostile[i]);
        assert_int_equal(access("hostile", F_OK), -1);
        assert_int_equal(test_folder_count(*state, true), 1);
    }
}

/* What is drawn needs two files; their folder is TMPDIR, and where that cannot be had the sentence
 * names it. */
static void temporary_files_are_where_tmpdir_says(void **state) {
    example data;
    char path[TEST_PATH_BYTES];
    char nowhere[TEST_PATH_BYTES];
    ps_error error = {0};
    make_example(&data);
    test_path(*state, "a.svg", path);
    test_path(*state, "nowhere", nowhere);
    setenv("TMPDIR", nowhere, 1);
    assert_int_equal(ps_figure_write(path, &data.plot, &error), PSPEC_ERROR_IO);
    assert_non_null(strstr(error.message, nowhere));
    assert_non_null(strstr(error.message, "TMPDIR"));
    assert_int_equal(mkdir(nowhere, 0700), 0);
    if (has_gnuplot()) {
        assert_int_equal(ps_figure_write(path, &data.plot, &error), PSPEC_OK);
    }
    unsetenv("TMPDIR");
    assert_int_equal(rmdir(nowhere), 0); /* nothing is left in it */
}

/* A folder, a file that nobody may run, and at last the program. */
static void gnuplot_is_a_program_in_path(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    char *const kept = strdup(getenv("PATH") != NULL ? getenv("PATH") : "");
    ps_text found = {0};
    ps_error error = {0};
    assert_non_null(kept);
    setenv("PATH", folder->path, 1);
    test_path(folder, "gnuplot", path);
    assert_int_equal(ps_plot_find_gnuplot(&found, &error), PSPEC_ERROR_IO);
    assert_int_equal(mkdir(path, 0700), 0);
    assert_int_equal(ps_plot_find_gnuplot(&found, &error), PSPEC_ERROR_IO);
    assert_int_equal(rmdir(path), 0);
    assert_true(test_write_file(path, "#!/bin/sh\n", 10));
    assert_int_equal(chmod(path, 0600), 0);
    assert_int_equal(ps_plot_find_gnuplot(&found, &error), PSPEC_ERROR_IO);
    assert_int_equal(chmod(path, 0700), 0);
    assert_int_equal(ps_plot_find_gnuplot(&found, &error), PSPEC_OK);
    assert_string_equal(ps_text_string(&found), path);
    setenv("PATH", kept, 1);
    ps_text_free(&found);
    free(kept);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(gnuplot_is_a_program_in_path),
        IN_FOLDER(temporary_files_are_where_tmpdir_says),
        IN_FOLDER(hostile_texts_are_drawn_as_they_are),
    };
    return cmocka_run_group_tests_name("gnuplot", tests, NULL, NULL);
}
