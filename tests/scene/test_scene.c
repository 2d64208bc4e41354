/* Scenes that are read: defaults, paths, command lines, and records read again. */
#include "scene_text.h"

#include "cli/command.h"
#include "request/options.h"

#include <sys/stat.h>

/* ---- what is read ------------------------------------------------------------------------ */

static void defaults(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              "scene: 1\ndefaults: {seed: 3, tol: 1e-3, files: [/a, /b], max-degree: 4}\nresults:\n"
              "  - {result: power, samplers: white}\n  - {result: power, seed: 4}\n"
              "  - {result: truncation, brdf: diffuse}\n",
              path);
    assert_command(&scene, 0, 0, "pointspec power --sampler white --seed 3 --tol 1e-3");
    assert_command(&scene, 1, 0, "pointspec power --seed 4 --tol 1e-3 /a /b");
    assert_command(&scene, 2, 0, "pointspec truncation --brdf diffuse --max-degree 4");
    ps_scene_free(&scene);
    must_read(state, &scene,
              "scene: 1\ndefaults: {samplers: white}\nresults:\n"
              "  - {result: power, files: /a}\n  - {result: power, sampler: halton}\n",
              path);
    assert_command(&scene, 0, 0, "pointspec power /a");
    assert_command(&scene, 1, 0, "pointspec power --sampler halton");
    ps_scene_free(&scene);
    /* what is about the other kind of points is not taken */
    must_read(state, &scene,
              "scene: 1\ndefaults: {files: /a, realizations: 9, seed: 2, columns: xy, tol: 0.1}\n"
              "results:\n  - {result: power}\n  - {result: power, sampler: white}\n",
              path);
    assert_command(&scene, 0, 0, "pointspec power --columns xy --tol 0.1 /a");
    assert_command(&scene, 1, 0,
                   "pointspec power --sampler white --realizations 9 --seed 2 --tol 0.1");
    ps_scene_free(&scene);
}

static void names_and_switches(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              "scene: 1\ntitle: T\ndescription: D\nresults:\n  - {result: power, plot: false}\n"
              "  - {result: pairs, name: a_B-2, title: x}\n  - {result: power, pictures: true}\n",
              path);
    assert_string_equal(scene.title, "T");
    assert_string_equal(scene.description, "D");
    assert_string_equal(scene.results[0].name, "power-1");
    assert_string_equal(scene.results[1].name, "a_B-2");
    assert_string_equal(scene.results[2].name, "power-3");
    assert_false(scene.results[0].wants_plot);
    assert_true(scene.results[1].wants_plot);
    assert_true(scene.results[2].wants_pictures);
    assert_string_equal(scene.results[1].title, "x");
    assert_null(scene.results[0].title);
    ps_scene_free(&scene);
}

static void paths(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    char expected[SENTENCE_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              POWER "    files: [[a b, /c], d]\n    weights: w\n    frequencies: f\n"
                    "  - {result: check, against: s.json, samplers: white}\n"
                    "  - {result: quadrature, brdf: 'zonal:file=x.lobe', weights: [optimal, w]}\n"
                    "  - {result: quadrature, brdf: 'zonal:file=/x.lobe', weights: equal}\n"
                    "  - {result: power, files: /c, weights: optimal}\n", /* a file there */
              path);
    const char *const at = folder->path;
    snprintf(expected, sizeof expected,
             "pointspec power --weights %s/w --frequencies %s/f '%s/a b' /c", at, at, at);
    assert_command(&scene, 0, 0, expected);
    snprintf(expected, sizeof expected, "pointspec power --weights %s/w --frequencies %s/f %s/d",
             at, at, at);
    assert_command(&scene, 0, 1, expected);
    snprintf(expected, sizeof expected, "pointspec check --against %s/s.json --sampler white", at);
    assert_command(&scene, 1, 0, expected);
    snprintf(expected, sizeof expected,
             "pointspec quadrature --brdf zonal:file=%s/x.lobe --weights optimal", at);
    assert_command(&scene, 2, 0, expected);
    snprintf(expected, sizeof expected,
             "pointspec quadrature --brdf zonal:file=%s/x.lobe --weights %s/w", at, at);
    assert_command(&scene, 2, 1, expected);
    assert_command(&scene, 3, 0, "pointspec quadrature --brdf zonal:file=/x.lobe --weights equal");
    snprintf(expected, sizeof expected, "pointspec power --weights %s/optimal /c", at);
    assert_command(&scene, 4, 0, expected);
    assert_string_equal(scene.results[0].entries[0].values[0].originals[0], "a b");
    ps_scene_free(&scene);
}

/* ---- command lines ----------------------------------------------------------------------- */

enum { MOST_WORDS = 32 };

/* What a shell makes of a line: words, quoted with ' and \'. Words follow each other in `out`. */
static int split(const char *line, char *out, char *words[MOST_WORDS]) {
    int num = 0;
    bool is_quoted = false;
    words[num++] = out;
    for (; *line != '\0'; line++) {
        if (*line == '\'') {
            is_quoted = !is_quoted;
        } else if (*line == ' ' && !is_quoted) {
            *out++ = '\0';
            words[num++] = out;
            assert_true(num < MOST_WORDS);
        } else {
            line += !is_quoted && *line == '\\';
            *out++ = *line;
        }
    }
    *out = '\0';
    return num;
}

static bool is_same_text(const char *a, const char *b) {
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

static void assert_same_request(const ps_request *a, const ps_request *b) {
    assert_memory_equal(a->is_given, b->is_given, sizeof a->is_given);
    assert_int_equal(a->num_counts, b->num_counts);
    assert_memory_equal(a->counts, b->counts, a->num_counts * sizeof *a->counts);
    assert_int_equal(a->seed, b->seed);
    assert_int_equal(a->frequencies.max_frequency, b->frequencies.max_frequency);
    assert_true(ps_bin_rule_is_same(&a->frequencies.bins, &b->frequencies.bins));
    assert_true(a->accuracy.tolerance == b->accuracy.tolerance);
    assert_true(a->weights.kind == b->weights.kind &&
                is_same_text(a->weights.path, b->weights.path) &&
                is_same_text(a->limits.constraints.engine, b->limits.constraints.engine));
    assert_int_equal(a->num_sources, b->num_sources);
    for (size_t i = 0; i < a->num_sources; i++) {
        assert_string_equal(ps_request_source_name(a, i), ps_request_source_name(b, i));
    }
    assert_int_equal(a->num_files, b->num_files);
    for (size_t i = 0; i < a->num_files; i++) {
        assert_string_equal(a->files[i], b->files[i]);
    }
}

/* In the current folder, where odd names stay odd. */
static void command_lines_ask_the_same(void **state) {
    static const char text[] =
        POWER "    samplers: [white, \"it's; $(odd) \\\\\"]\n    points: 1e3\n    tol: 1e-3\n"
              "    bins: relative=1/8\n    homogenize: false\n    engine: -x\n"
              "  - {result: power, files: [-a, 'b c', --help], weights: -w}\n";
    const test_folder *const folder = *state;
    char here[TEST_PATH_BYTES];
    ps_scene scene;
    ps_command command = {.name = "power", .takes = PS_COMMAND_BIT(power)};
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(folder->path), 0);
    assert_true(test_write_file("scene.yaml", text, sizeof text - 1));
    assert_ok(ps_scene_read(&scene, "scene.yaml", error));
    for (size_t i = 0; i < 3; i++) {
        ps_scene_question question = make(&scene, i / 2, i % 2);
        char bytes[SENTENCE_BYTES];
        char *words[MOST_WORDS];
        ps_request request;
        const int num = split(question.request.command_line, bytes, words);
        assert_ok(ps_arguments_parse(&request, &command, num - 2, words + 2, error));
        assert_same_request(&request, &question.request);
        ps_arguments_free(&request);
        ps_scene_question_free(&question);
    }
    ps_scene_free(&scene);
    assert_int_equal(chdir(here), 0);
}

/* ---- records ----------------------------------------------------------------------------- */

static void assert_same_scene(const ps_scene *a, const ps_scene *b) {
    assert_true(is_same_text(a->title, b->title) && is_same_text(a->description, b->description));
    assert_int_equal(a->num_results, b->num_results);
    for (size_t i = 0; i < a->num_results; i++) {
        const size_t num = ps_scene_num_questions(&a->results[i]);
        assert_int_equal(num, ps_scene_num_questions(&b->results[i]));
        assert_string_equal(a->results[i].name, b->results[i].name);
        assert_true(is_same_text(a->results[i].title, b->results[i].title));
        assert_int_equal(a->results[i].wants_plot, b->results[i].wants_plot);
        assert_int_equal(a->results[i].wants_pictures, b->results[i].wants_pictures);
        assert_int_equal(a->results[i].wants_arrays, b->results[i].wants_arrays);
        assert_int_equal(a->results[i].wants_coefficients, b->results[i].wants_coefficients);
        for (size_t q = 0; q < num; q++) {
            ps_scene_question one = make(a, i, q);
            assert_command(b, i, q, one.request.command_line);
            ps_scene_question_free(&one);
        }
    }
}

/* Printed, put into another folder and read again: the same questions. */
static void assert_record(void **state, const char *text, size_t num_digests) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    char record[TEST_PATH_BYTES];
    ps_scene scene;
    ps_scene again;
    ps_text json = {0};
    must_read(state, &scene, text, path);
    ps_scene_print(&scene, &json);
    ps_text_append(&json, ", \"record\": {\"folder\": ");
    ps_scene_print_text(scene.folder, &json);
    ps_text_append(&json, ", \"pointspec_version\": \"1.2\", \"questions\": [{\"a\": [\"b\"]}]");
    ps_text_append(&json, ", \"digests\": [\"d0\"");
    for (size_t i = 1; i < num_digests; i++) {
        ps_text_append(&json, ", \"d%zu\"", i);
    }
    ps_text_append(&json, "]}}");
    assert_false(json.failed);
    snprintf(record, sizeof record, "%s/sub", folder->path);
    assert_int_equal(access(record, F_OK) == 0 ? 0 : mkdir(record, 0700), 0);
    snprintf(record, sizeof record, "%s/sub/record.json", folder->path);
    assert_true(test_write_file(record, json.data, json.length));
    assert_ok(ps_scene_read(&again, record, error));
    assert_same_scene(&scene, &again);
    assert_int_equal(again.num_digests, num_digests);
    assert_string_equal(again.digests[num_digests - 1], num_digests > 1 ? "d1" : "d0");
    assert_string_equal(again.recorded_version, "1.2");
    cJSON *const parsed = cJSON_Parse(json.data);
    assert_non_null(parsed);
    cJSON_Delete(parsed);
    ps_text_free(&json);
    ps_scene_free(&again);
    ps_scene_free(&scene);
    unlink(record);
    snprintf(record, sizeof record, "%s/sub", folder->path);
    rmdir(record);
}

static void records_ask_the_same(void **state) {
    assert_record(state,
                  "scene: 1\ntitle: A \"title\" \\ <&>\ndescription: |\n  two\n  lines\n"
                  "defaults: {seed: 3, files: [[a, b c], d]}\nresults:\n"
                  "  - {result: power, name: x, title: 'it''s', points: 16..64, pictures: true, "
                  "arrays: true}\n"
                  "  - {result: quadrature, brdf: ['zonal:file=l', diffuse], weights: [w, equal]}\n"
                  "  - {result: check, against: s, samplers: white, plot: false, no-skip: true}\n"
                  "  - {result: angular, samplers: zphi, arrays: coefficients}\n"
                  "  - {result: variance, samplers: zphi, integrands: [cap, square]}\n"
                  "  - {result: variance, samplers: [zphi, spiral], points: 8..32, rank: true}\n"
                  "  - {result: variance, samplers: [zphi, spiral], points: 8, rank: false}\n",
                  2);
    /* characters that YAML refuses, or folds, unless they are escaped */
    assert_record(
        state,
        "scene: 1\ntitle: \"\\x01\\t\\n\\x7f\\x80\\x9f\\N\\_\\L\\P\\uFEFF\\uFFFE\\uFFFF"
        "\\uFFFD\\U0001F600\xc3\xa4\"\nresults:\n  - {result: power, samplers: \"\\u2028\"}\n",
        1);
}

static void bytes_that_are_no_text(void **state) {
    static const struct {
        const char *text, *printed;
    } rows[] = {{"a\xff"
                 "b",
                 "\"a\\ufffdb\""},
                {"\xc3", "\"\\ufffd\""},
                {"\xc0\x80", "\"\\ufffd\\ufffd\""},
                {"\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""},
                {"\xf4\x90\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\""},
                {"\xe2\x82\xac", "\"\xe2\x82\xac\""},
                {"\"\\\n", "\"\\\"\\\\\\u000a\""}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        ps_text out = {0};
        ps_scene_print_text(rows[i].text, &out);
        assert_string_equal(ps_text_string(&out), rows[i].printed);
        ps_text_free(&out);
    }
}

/* Those that are shipped ask what can be asked. */
static void shipped_scenes(void **state) {
    static const char *const names[] = {"gate",           "diffuse",     "glossy",
                                        "radial_mean",    "m18/figures", "sphere_samplers",
                                        "torus_samplers", "m18/table2"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[SENTENCE_BYTES];
        ps_scene scene;
        snprintf(path, sizeof path, "%s/../docs/scenes/%s.yaml", TEST_SOURCE_DIR, names[i]);
        assert_ok(ps_scene_read(&scene, path, error));
        assert_same_scene(&scene, &scene);
        ps_scene_free(&scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_FOLDER(defaults),
        IN_FOLDER(names_and_switches),
        IN_FOLDER(paths),
        IN_FOLDER(command_lines_ask_the_same),
        IN_FOLDER(records_ask_the_same),
        cmocka_unit_test(bytes_that_are_no_text),
        cmocka_unit_test(shipped_scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
