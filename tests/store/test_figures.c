/* Measured figures of a device: written, read, refused when anything is wrong with them; and what
 * the planner makes of them. No device is opened: planning is a function of problem, limits and
 * figures. */
#include "harness_plan.h"

#include "base/workers.h"
#include "plan/phases.h"
#include "store/figures_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static ps_device_limits some_device(void) {
    ps_device_limits limits = test_cpu();
    snprintf(limits.name, sizeof limits.name, "a device\nwith two lines");
    snprintf(limits.platform, sizeof limits.platform, "a platform");
    snprintf(limits.driver, sizeof limits.driver, "1.2");
    return limits;
}

static ps_figures some_figures(void) {
    ps_figures figures = {.is_measured = true,
                          .date = "2026-11-22T10:00:00Z",
                          .flops = {3.25e11, 1.0 / 3 * 1e12},
                          .copied_bytes = 5e10,
                          .sent_bytes = 7e9,
                          .launches = 1e5 / 3};
    ps_figures_row(&figures, "torus_nufft")->scales[PS_SINGLE] = 1.0 / 3;
    ps_figures_row(&figures, "torus_nufft")->scales[PS_DOUBLE] = 2;
    ps_figures_row(&figures, "host_direct")->scales[PS_EXTENDED] = 0.7;
    return figures;
}

/* ---- tables -------------------------------------------------------------------------------- */

static void assert_same(const ps_figures *a, const ps_figures *b) {
    assert_true(a->is_measured && b->is_measured);
    assert_string_equal(a->date, b->date);
    assert_memory_equal(a->flops, b->flops, sizeof a->flops);
    assert_true(a->copied_bytes == b->copied_bytes);
    assert_true(a->sent_bytes == b->sent_bytes && a->launches == b->launches);
    assert_int_equal(a->num_engines, b->num_engines);
    for (size_t i = 0; i < a->num_engines; i++) {
        assert_string_equal(a->engines[i].engine, b->engines[i].engine);
        assert_memory_equal(a->engines[i].scales, b->engines[i].scales,
                            sizeof a->engines[i].scales);
    }
}

/* A table of figures with one row and one entry. */
static ps_table *make_table(const char *name, int column, double number, const char *key,
                            ps_cell value) {
    static const char *const columns[] = {"name", "single", "double", "extended"};
    ps_cell cells[] = {PS_TEXT(name), PS_MISSING, PS_MISSING, PS_MISSING};
    ps_table *table = NULL;
    cells[column] = PS_NUMBER(number);
    assert_ok(ps_table_create(&table, "figures", columns, 4, error));
    assert_ok(ps_table_add_meta(table, key, value, error));
    assert_ok(ps_table_add_meta(table, "date", PS_TEXT("today"), error));
    assert_ok(ps_table_add_row(table, cells, error));
    return table;
}

static void what_no_device_can_be_is_refused(void **state) {
    (void)state;
    const struct {
        const char *name;
        int column;
        double number;
        const char *key;
        ps_cell value;
    } cases[] = {{"torus_nufft", 1, INFINITY, "launches", PS_MISSING},
                 {"torus_nufft", 1, 0, "launches", PS_MISSING},
                 {"torus_nufft", 2, -1, "launches", PS_MISSING},
                 {"torus_nufft", 3, 1e4, "launches", PS_MISSING},
                 {"torus_nufft", 1, 1e-4, "launches", PS_MISSING},
                 {"", 1, 1, "launches", PS_MISSING},
                 {"an_engine_of_a_name_that_is_too_long_to_be_kept", 1, 1, "launches", PS_MISSING},
                 {"host:white", 1, 1e4, "launches", PS_MISSING},
                 {"host:white", 2, 1, "launches", PS_MISSING},
                 {"torus_nufft", 1, 1, "launches", PS_NUMBER(0.5)},
                 {"torus_nufft", 1, 1, "flops_single", PS_NUMBER(1e2)},
                 {"torus_nufft", 1, 1, "copied_bytes", PS_NUMBER(1e19)},
                 {"torus_nufft", 1, 1, "sent_bytes", PS_TEXT("fast")},
                 {"torus_nufft", 1, 1, "date", PS_TEXT("a day of so many words that it is none")},
                 {"torus_nufft", 1, 1, "date", PS_MISSING}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_figures back = some_figures();
        ps_error said = {0};
        ps_table *const table = make_table(cases[i].name, cases[i].column, cases[i].number,
                                           cases[i].key, cases[i].value);
        assert_int_equal(ps_figures_take(&back, table, &said), PSPEC_ERROR_INPUT);
        assert_false(back.is_measured);
        assert_int_equal(back.num_engines, 0);
        assert_true(back.flops[0] == 0 && back.copied_bytes == 0);
        ps_table_destroy(table);
    }
    ps_figures back;
    ps_table *const table = make_table("torus_nufft", 1, 1e3, "launches", PS_NUMBER(1));
    assert_ok(ps_figures_take(&back, table, error));
    assert_true(back.is_measured && back.engines[0].scales[PS_SINGLE] == 1e3);
    assert_true(back.engines[0].scales[PS_DOUBLE] == 0 && back.launches == 1);
    for (int i = 0; i < PS_FIGURES_ENGINES; i++) { /* one more than find room */
        char name[16];
        snprintf(name, sizeof name, "engine%d", i);
        const ps_cell cells[] = {PS_TEXT(name), PS_NUMBER(1), PS_MISSING, PS_MISSING};
        assert_ok(ps_table_add_row(table, cells, error));
    }
    ps_error said = {0};
    assert_int_equal(ps_figures_take(&back, table, &said), PSPEC_ERROR_INPUT);
    ps_table_destroy(table);
}

/* ---- files --------------------------------------------------------------------------------- */

static void write_some(const char *path, const char *content) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(content, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void read_note(const char *folder, const char *part) {
    const ps_device_limits limits = some_device();
    ps_figures figures = some_figures();
    assert_ok(ps_figures_read(&figures, folder, &limits, error));
    assert_false(figures.is_measured);
    assert_true(ps_figures_scale(&figures, "torus_nufft", PS_SINGLE) == 1);
    if (strstr(figures.note, part) == NULL) {
        fail_msg("not \"%s\": %s", part, figures.note);
    }
}

static void files(void **state) {
    (void)state;
    char root[] = "/tmp/test_figures.XXXXXX";
    assert_non_null(mkdtemp(root));
    ps_text folder = {0};
    ps_text path = {0};
    const ps_device_limits limits = some_device();
    ps_figures figures = some_figures();
    ps_figures back;
    ps_text_append(&folder, "%s/new/cache", root);
    assert_ok(ps_figures_path(&path, folder.data, &limits, error));
    read_note(NULL, "none were looked for");
    read_note(folder.data, "was not measured");
    assert_ok(ps_figures_write(folder.data, &figures, &limits, error));
    assert_ok(ps_figures_read(&back, folder.data, &limits, error));
    assert_same(&figures, &back);
    figures.engines[0].scales[PS_SINGLE] = 3; /* a second time replaces it */
    assert_ok(ps_figures_write(folder.data, &figures, &limits, error));
    assert_ok(ps_figures_read(&back, folder.data, &limits, error));
    assert_same(&figures, &back);
    ps_device_limits other = some_device();
    snprintf(other.driver, sizeof other.driver, "1.3");
    assert_ok(ps_figures_read(&back, folder.data, &other, error)); /* has a file of its own */
    assert_false(back.is_measured);
    write_some(path.data, "PK\003\004");
    read_note(folder.data, "was not measured"); /* and is gone */
    alarm(600);                                 /* instead of for ever */
    assert_int_equal(mkfifo(path.data, 0600), 0);
    read_note(folder.data, "was not measured");
    assert_int_equal(mkfifo(path.data, 0600), 0);
    assert_ok(ps_figures_write(folder.data, &figures, &limits, error));
    alarm(0);
    assert_ok(ps_figures_read(&back, folder.data, &limits, error));
    assert_same(&figures, &back);
    assert_int_equal(chmod(folder.data, 0777), 0); /* others could have written it */
    read_note(folder.data, "can be written by other users");
    ps_error refused = {0};
    assert_int_equal(ps_figures_write(folder.data, &figures, &limits, &refused), PSPEC_ERROR_IO);
    assert_int_equal(chmod(folder.data, 0700), 0);
    assert_int_equal(remove(path.data), 0);
    read_note(folder.data, "was not measured");
    ps_error said = {0};
    assert_int_equal(ps_figures_write("/dev/null", &figures, &limits, &said), PSPEC_ERROR_IO);
    for (size_t length = folder.length; length >= strlen(root);
         length--) { /* from the inmost out */
        if (folder.data[length] == '\0' || folder.data[length] == '/') {
            folder.data[length] = '\0';
            if (length == folder.length) {
                ps_text inner = {0};
                ps_text_append(&inner, "%s/devices", folder.data);
                assert_int_equal(rmdir(inner.data), 0);
                ps_text_free(&inner);
            }
            assert_int_equal(rmdir(folder.data), 0);
        }
    }
    ps_text_free(&folder);
    ps_text_free(&path);
}

/* ---- the planner --------------------------------------------------------------------------- */

static double seconds_of(const ps_device_limits *limits, const char *engine, int precision,
                         const char **chosen) {
    const ps_frequencies set = test_lattice(2, 32);
    const ps_problem problem = test_problem(&set, 256, 1e-3);
    ps_plan plan;
    test_make_plan(&plan, &problem, limits, &test_any_plan);
    *chosen = plan.chosen->engine->name;
    return test_candidate(&plan, engine, (ps_precision)precision)->seconds;
}

static void planner_scales_seconds(void **state) {
    (void)state;
    ps_device_limits limits = some_device();
    const char *first = NULL;
    const char *now = NULL;
    const double nufft = seconds_of(&limits, "torus_nufft", PS_SINGLE, &first);
    const double direct = seconds_of(&limits, "torus_direct", PS_SINGLE, &first);
    const double host = seconds_of(&limits, "host_direct", PS_EXTENDED, &first);
    ps_figures figures = {.is_measured = false};
    limits.figures = &figures; /* not measured: as without */
    ps_figures_row(&figures, "torus_direct")->scales[PS_SINGLE] = 1e-3;
    assert_true(seconds_of(&limits, "torus_direct", PS_SINGLE, &now) == direct);
    figures = some_figures();
    figures.launches = 0;
    assert_true(seconds_of(&limits, "torus_nufft", PS_SINGLE, &now) == nufft * (1.0 / 3));
    assert_true(seconds_of(&limits, "host_direct", PS_EXTENDED, &now) == host * 0.7);
    assert_true(seconds_of(&limits, "torus_direct", PS_SINGLE, &now) == direct);
    figures.launches = 1;
    assert_true(seconds_of(&limits, "torus_direct", PS_SINGLE, &now) > direct + 0.9);
}

/* What decides is the built-in model, so that results have the same bits on every machine of a
 * kind, measured or not. */
static void planner_does_not_choose_by_them(void **state) {
    (void)state;
    ps_device_limits limits = some_device();
    const char *builtin = NULL;
    const char *chosen = NULL;
    ps_figures figures = {.is_measured = true};
    seconds_of(&limits, "torus_direct", PS_SINGLE, &builtin);
    limits.figures = &figures;
    for (int p = PS_SINGLE; p <= PS_DOUBLE; p++) {
        ps_figures_row(&figures, "torus_nufft")->scales[p] = 1e3;
        ps_figures_row(&figures, "torus_direct")->scales[p] = 1e-3;
    }
    seconds_of(&limits, "torus_direct", PS_SINGLE, &chosen);
    assert_string_equal(chosen, builtin);
    for (int p = PS_SINGLE; p <= PS_DOUBLE; p++) {
        ps_figures_row(&figures, "torus_nufft")->scales[p] = 1e-3;
        ps_figures_row(&figures, "torus_direct")->scales[p] = 1e3;
    }
    seconds_of(&limits, "torus_direct", PS_SINGLE, &chosen);
    assert_string_equal(chosen, builtin);
}

/* ---- the host ------------------------------------------------------------------------------ */

/* Samplers that were measured, and the rest of the host's work by their geometric mean. */
static void host_figures_scale_its_work(void **state) {
    (void)state;
    ps_figures figures = {.is_measured = true};
    ps_phases phases = {.host = &figures};
    assert_true(ps_figures_host_scale(&figures, "white") == 1); /* nothing measured */
    ps_figures_host_row(&figures, "white")->scale = 4;
    ps_figures_host_row(&figures, "jittered")->scale = 1;
    assert_true(fabs(ps_figures_host_scale(&figures, "halton") - 2) < 1e-12);
    ps_phases_add(&phases, "work", 3);
    assert_true(fabs(ps_phases_seconds(&phases) - 6) < 1e-12);
    ps_phases_share(&phases, "few", 10, 1, 3);      /* by one thread */
    ps_phases_share(&phases, "many", 1e6, 1e-6, 3); /* by all */
    const double seconds = 66 + (ps_workers_most() > 1 ? 6.0 / ps_workers_most() + 3e-4 : 6);
    assert_true(fabs(ps_phases_seconds(&phases) - seconds) < 1e-12);
}

static void host_figures_come_back(void **state) {
    (void)state;
    char root[] = "/tmp/test_figures.XXXXXX";
    ps_figures figures = {.is_measured = true, .date = "2026-11-23T10:00:00Z"};
    ps_figures back;
    ps_device_limits host;
    ps_text path = {0};
    assert_non_null(mkdtemp(root));
    size_t num = 0;
    for (; ps_samplers[num] != NULL; num++) { /* all of them find room */
        ps_host_figure *const row = ps_figures_host_row(&figures, ps_samplers[num]->name);
        assert_non_null(row);
        row->scale = 1 + (double)num / 64;
    }
    ps_host_describe(&host);
    assert_ok(ps_figures_write(root, &figures, &host, error));
    assert_ok(ps_figures_read(&back, root, &host, error));
    assert_int_equal(back.num_host, num);
    for (size_t i = 0; i < num; i++) {
        assert_true(ps_figures_host_scale(&back, ps_samplers[i]->name) == 1 + (double)i / 64);
    }
    assert_ok(ps_figures_path(&path, root, &host, error));
    assert_int_equal(remove(path.data), 0);
    assert_ok(ps_figures_read(&back, root, &host, error));
    assert_false(back.is_measured);
    ps_text_free(&path);
    ps_text_append(&path, "%s/devices", root);
    assert_int_equal(rmdir(path.data), 0);
    assert_int_equal(rmdir(root), 0);
    ps_text_free(&path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_no_device_can_be_is_refused),
        cmocka_unit_test(files),
        cmocka_unit_test(planner_scales_seconds),
        cmocka_unit_test(planner_does_not_choose_by_them),
        cmocka_unit_test(host_figures_scale_its_work),
        cmocka_unit_test(host_figures_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
