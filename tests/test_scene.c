/* Scenes: the schema and its complaints, defaults, combinations, paths, limits, and records read again. */
#include "harness.h"
#include "test_folder.h"

#include "cli/command.h"
#include "scene/options.h"
#include "scene/scene.h"

#include <sys/stat.h>

#define HEAD "scene: 1\nresults:\n"
#define POWER HEAD "  - result: power\n"

enum { SENTENCE_BYTES = 2048 };

/* The scene of a text, in the folder as scene.yaml. */
static pspec_status read_bytes(test_folder *folder, ps_scene *scene, const void *bytes, size_t num,
                               char path[TEST_PATH_BYTES], ps_error *error) {
    test_path(folder, "scene.yaml", path);
    assert_true(test_write_file(path, bytes, num));
    return ps_scene_read(scene, path, error);
}

/* The sentence must be "PATH:LINE: PART..", or "..PART.." where line is 0. */
static void refuses_bytes(test_folder *folder, const void *bytes, size_t num, int line,
                          const char *part) {
    char path[TEST_PATH_BYTES];
    char start[SENTENCE_BYTES];
    ps_scene scene;
    ps_error error = {0};
    if (read_bytes(folder, &scene, bytes, num, path, &error) == PSPEC_OK) {
        fail_msg("not refused: %s", part);
    }
    ps_scene_free(&scene);
    snprintf(start, sizeof start, "%s:%d: ", path, line);
    if (error.status != PSPEC_ERROR_INPUT ||
        (line > 0 && strncmp(error.message, start, strlen(start)) != 0) ||
        strstr(error.message, part) == NULL) {
        fail_msg("status %d, not \"%s%s\": %s", (int)error.status, line > 0 ? start : "", part,
                 error.message);
    }
}

static void refuses(void **state, const char *text, int line, const char *part) {
    refuses_bytes(*state, text, strlen(text), line, part);
}

static void must_read(void **state, ps_scene *scene, const char *text, char path[TEST_PATH_BYTES]) {
    assert_ok(read_bytes(*state, scene, text, strlen(text), path, error));
}

/* ---- what is refused --------------------------------------------------------------------- */

typedef struct refusal {
    const char *text;
    int line;
    const char *part;
} refusal;

static void refuse_all(void **state, const refusal *all, size_t num) {
    for (size_t i = 0; i < num; i++) {
        refuses(state, all[i].text, all[i].line, all[i].part);
    }
}
#define REFUSE(list) refuse_all(state, list, sizeof(list) / sizeof(list)[0])

static void files_that_are_no_scene(void **state) {
    static const refusal list[] = {
        {"# nothing\n", 1, "nothing is asked for: the file has no content"},
        {"a: [1\n", 2, "not YAML: "},
        {"a: b: c\n", 1, "not YAML: "},
        {"\tscene: 1\n", 1, "not YAML: "},
        {"scene: 1\nresults: *nobody\n", 2, "not YAML: found undefined alias"},
        {"scene: \"\xff\"\n", 1, "not YAML: "},
        {POWER "---\nscene: 1\n", 5, "a second document begins here; a scene is one"},
        {"[scene, 1]\n", 1, "a scene is a mapping with the keys scene and results"},
        {"scene\n", 1, "a scene is a mapping with the keys scene and results"},
    };
    static const char binary[] = "\x7f"
                                 "ELF\x02\x01\x01\0\0\0";
    REFUSE(list);
    refuses_bytes(*state, binary, sizeof binary, 1, "not YAML: ");
    refuses_bytes(*state, "", 0, 0, "is empty");
    refuses_bytes(*state, "scene: 1\0\n", 10, 1, "not YAML: ");
}

static void keys_of_the_file(void **state) {
    static const refusal list[] = {
        {"title: x\nresults: []\n", 1, "scene: is missing: a scene begins with scene: 1"},
        {"scene: 1\n", 1, "results: is missing"},
        {"scene: 2\nresults: []\n", 1, "scene: schema \"2\" is not known"},
        {"scene: [1]\nresults: []\n", 1, "scene: one value is wanted here, not a list"},
        {"scene: 1\nresult:\n  - a\n", 3, "result: unknown key; did you mean results?"},
        {"scene: 1\nscene: 1\n", 2, "scene: this key stands in line 1 already"},
        {"scene: 1\n[a]: 1\n", 2, "one value is wanted here, not a list"},
        {"scene: 1\nresults: []\n", 2, "results: a list of 1 to 256 results is wanted here"},
        {"scene: 1\nresults: power\n", 2, "results: a list of 1 to 256 results"},
        {"scene: 1\nresults:\n  - power\n", 3, "results: a result is a mapping of keys"},
        {"scene: 1\ntitle: [a]\nresults:\n  - result: power\n", 2, "title: one value is wanted"},
        {"scene: 1\ntitle: {a: b}\nresults:\n  - result: power\n", 2, "not a mapping"},
        {"scene: 1\ntitle: \"a\\0b\"\nresults:\n  - result: power\n", 2,
         "title: a byte of value 0 in a text"},
        {"scene: 1\ntitle:\nresults:\n  - result: power\n", 2, "title: no value"},
        {"scene: 1\ndefaults: 3\nresults:\n  - result: power\n", 2,
         "defaults: a mapping of keys is wanted here"},
        {"scene: 1\ndefaults: {pionts: 3}\nresults:\n  - result: power\n", 2,
         "pionts: unknown key; did you mean points?"},
        {"scene: 1\nrecord: 3\nresults:\n  - result: power\n", 2, "record: no mapping"},
    };
    REFUSE(list);
}

static void keys_of_results(void **state) {
    static const refusal list[] = {
        {HEAD "  - points: 3\n", 3, "result: is missing: power, angular, pairs, quadrature, "},
        {HEAD "  - result: powr\n", 3,
         "result: \"powr\" is no kind of result; did you mean power?"},
        {HEAD "  - result: [power]\n", 3, "result: one value is wanted here"},
        {POWER "    pints: 3\n", 4, "pints: unknown key; did you mean points?"},
        {POWER "    brdf: diffuse\n", 4, "brdf: not a key of this result; did you mean "},
        {POWER "    max-degree: 3\n", 4, "max-degree: not a key of this result"},
        {POWER "    output: a.csv\n", 4, "output: unknown key; did you mean "},
        {POWER "    device: cpu\n", 4, "device: unknown key; did you mean "},
        {HEAD "  - result: angular\n    pictures: true\n", 4, "pictures: unknown key"},
        {HEAD "  - result: truncation\n    files: a\n", 4, "files: not a key of this result"},
        {POWER "    points: 3\n    points: 4\n", 5, "points: this key stands in line 4 already"},
        {POWER "    sampler: white\n    samplers: white\n", 5, "sampler: stands in line 4 already"},
        {POWER "    plot: yes\n", 4, "plot: true or false, not \"yes\""},
        {POWER "    shells: 1\n", 4, "shells: true or false, not \"1\""},
        {POWER "    name: a/b\n", 4, "name: \"a/b\" cannot name files"},
        {POWER "    name: -a\n", 4, "name: \"-a\" cannot name files"},
        {POWER "    name: a.b\n", 4, "name: \"a.b\" cannot name files"},
        {POWER "    name: \xc3\xa4\n", 4, "cannot name files"},
        {POWER "    name: a\n  - result: pairs\n    name: a\n", 5,
         "name: \"a\" is the name of the result of line 3 already"},
        {POWER "  - result: pairs\n    name: power-1\n", 4,
         "name: \"power-1\" is the name of the result of line 3 already"},
        {POWER "    points: []\n", 4, "points: an empty list"},
        {POWER "    files: [[a], []]\n", 4, "files: an empty list"},
        {POWER "    files: []\n", 4, "files: an empty list"},
        {POWER "    points: [1, [2]]\n", 4, "points: a list in a list; only files have those"},
        {POWER "    files: [[[a]]]\n", 4, "files: one value is wanted here, not a list"},
        {POWER "    points: {a: 1}\n", 4, "points: one value is wanted here, not a mapping"},
        {POWER "    points: ''\n", 4, "points: no value"},
        {POWER "    files: '-'\n", 4, "a scene can be run again, standard input (-) cannot"},
        {POWER "    weights: '-'\n", 4, "a scene can be run again"},
        {HEAD "  - result: truncation\n    brdf: 'zonal:file=-'\n", 4, "a scene can be run again"},
    };
    REFUSE(list);
}

/* Of every type of option: not a number, below, above. */
static void values_out_of_range(void **state) {
    static const refusal list[] = {
        {POWER "    points: many\n", 4, "points: \"many\" is not a whole number"},
        {POWER "    points: 0\n", 4, "points: 0 is not between 1 and 10000000000"},
        {POWER "    points: 1.5\n", 4, "points: \"1.5\" is not a whole number"},
        {POWER "    points: [4, 1e11]\n", 4, "points: 1e11 is not between"},
        {POWER "    points: 8..4\n", 4, "points: \"8..4\": the first number is the larger one"},
        {POWER "    points: 8..x\n", 4, "points: \"x\" is not a whole number"},
        {POWER "    points: ..8\n", 4, "points: \"\" is not a whole number"},
        {POWER "    points: 0..8\n", 4, "points: 0 is not between"},
        {POWER "    points: 1..1e11\n", 4, "points: 17179869184 is not between"},
        {POWER "    dimension: 7\n", 4, "dimension: 7 is not between 1 and 6"},
        {POWER "    seed: -1\n", 4, "seed: -1 is not between 0 and 18446744073709551615"},
        {POWER "    seed: 18446744073709551616\n", 4, "seed: 18446744073709551616 is not between"},
        {POWER "    tol: 0\n", 4, "tol: tolerance: 0 is not above 0 and at most 1"},
        {POWER "    tol: nan\n", 4, "tol: tolerance: \"nan\" is not a finite number"},
        {POWER "    floor: -1\n", 4, "floor: -1 is not above 0"},
        {POWER "    standard-error: 2\n", 4, "standard-error: standard error: 2 is not above 0"},
        {POWER "    max-frequency: 268435457\n", 4,
         "max-frequency: max frequency: 268435457 is not"},
        {POWER "    per-ring: 1\n", 4, "per-ring: frequencies per ring: 1 is not between"},
        {POWER "    normalize: full\n", 4, "normalize: \"full\" is not one of power, effective"},
        {POWER "    precision: half\n", 4, "precision: \"half\" is not one of auto, single"},
        {POWER "    columns: abc\n", 4, "columns: \"abc\" is not one of "},
        {POWER "    input-format: abc\n", 4, "input-format: \"abc\" is not one of "},
        {POWER "    select-sets: 3..2\n", 4, "select-sets: \"3..2\": the first number"},
        {HEAD "  - result: angular\n    max-degree: 0\n", 4, "max-degree: max degree: 0 leaves no"},
        {HEAD "  - result: quadrature\n    smoothness: 2\n", 4, "smoothness: "},
        {HEAD "  - result: truncation\n    harmonics: odd\n", 4,
         "harmonics: \"odd\" is not one of"},
        {HEAD "  - result: check\n    false-alarm-rate: 1\n", 4,
         "false-alarm-rate: 1 is not below"},
        {"scene: 1\ndefaults:\n  points: 0\nresults:\n  - result: power\n", 3, "points: 0 is not"},
    };
    REFUSE(list);
}

/* ---- limits ------------------------------------------------------------------------------ */

/* head, then a text num times, then the end. */
static void refuses_repeated(void **state, const char *head, const char *text, size_t num,
                             const char *tail, int line, const char *part) {
    ps_text all = {0};
    ps_text_append(&all, "%s", head);
    for (size_t i = 0; i < num; i++) {
        ps_text_append_bytes(&all, text, strlen(text));
    }
    ps_text_append(&all, "%s", tail);
    assert_false(all.failed);
    refuses(state, ps_text_string(&all), line, part);
    ps_text_free(&all);
}

static void limits(void **state) {
    enum { LARGEST = 1 << 23, DEEP = 100000, MOST_RESULTS = 256, MANY = 1001 };
    ps_text keys = {0};
    refuses_repeated(state, "", "#", LARGEST + 1, "\n", 0, "is larger than 8388608 bytes");
    refuses_repeated(state, "", "[", DEEP, "", 1, "nested more than 16 deep");
    refuses_repeated(state, "", "- ", DEEP, "", 1, "nested more than 16 deep");
    refuses_repeated(state, "", "{a: ", DEEP, "", 1, "nested more than 16 deep");
    refuses_repeated(state, HEAD, "  - result: power\n", MOST_RESULTS + 1, "", 3,
                     "results: a list of 1 to 256 results");
    refuses_repeated(state, POWER "    points: [1", ", 1", MANY - 1, "]\n", 4,
                     "points: 1001 values, more than 1000");
    for (int i = 0; i < MANY; i++) {
        ps_text_append(&keys, "a%d: &a%d x\n", i, i);
    }
    refuses(state, ps_text_string(&keys), MANY, "more than 1000 anchors");
    ps_text_free(&keys);
    for (int i = 0; i < MANY; i++) {
        ps_text_append(&keys, "a%d: x\n", i);
    }
    refuses(state, ps_text_string(&keys), 1, "a mapping of 1001 keys, more than 1000");
    ps_text_free(&keys);
}

static void number_of_questions(void **state) {
#define HUNDRED                                                                                    \
    "[0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,"  \
    "5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0,1,2,3,4,5,6,7,8,9,0," \
    "1,2,3,4,5,6,7,8,9]\n"
#define SQUARE "    seed: " HUNDRED "    samplers: " HUNDRED
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene, POWER SQUARE, path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 10000);
    ps_scene_free(&scene);
    refuses(state, POWER SQUARE "    points: [1, 2]\n", 3,
            "the lists of this result ask 2e+04 questions, more than 10000");
    refuses(state, POWER SQUARE "  - result: pairs\n", 6,
            "results: here the scene asks 10001 questions, more than 10000");
}

static void aliases(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    ps_text laughs = {0};
    must_read(state, &scene,
              "scene: 1\nresults:\n  - &r\n    result: power\n    samplers: &s [white, halton]\n"
              "  - result: power\n    samplers: *s\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[1]), 2);
    assert_string_equal(scene.results[1].entries[0].values[1].texts[0], "halton");
    ps_scene_free(&scene);
    refuses(state, "scene: 1\nresults: &a\n  - *a\n", 2,
            "nested more than 16 deep: an alias of what it stands in?");
    refuses(state, "&a\nscene: *a\n", 0, "an alias of what it stands in?");
    refuses(state, POWER "    files: &f [*f]\n", 4, "an alias of what it stands in?");
    refuses(state, "scene: 1\n? &k [*k]\n: 1\n", 2, "an alias of what it stands in?");
    ps_text_append(&laughs, "a0: &a0 ha\n");
    for (int i = 1; i < 10; i++) {
        ps_text_append(&laughs, "a%d: &a%d [*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d,*a%d]\n", i, i,
                       i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
    }
    refuses(state, ps_text_string(&laughs), 0, "with all aliases (*name) written out");
    ps_text_free(&laughs);
}

/* ---- what is read ------------------------------------------------------------------------ */

static ps_scene_question make(const ps_scene *scene, size_t result, size_t number) {
    ps_scene_question question;
    assert_ok(ps_scene_question_make(&question, &scene->results[result], number, error));
    return question;
}

static void assert_command(const ps_scene *scene, size_t result, size_t number,
                           const char *expected) {
    ps_scene_question question = make(scene, result, number);
    assert_string_equal(question.request.command_line, expected);
    ps_scene_question_free(&question);
}

static void combinations(void **state) {
    static const char *const expected[] = {
        "pointspec power --sampler white --points 16 --seed 5",
        "pointspec power --sampler white --points 16 --seed 6",
        "pointspec power --sampler white --points 32 --seed 5",
        "pointspec power --sampler white --points 32 --seed 6",
        "pointspec power --sampler halton --points 16 --seed 5",
    };
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              POWER "    samplers: [white, halton]\n    points: 16..32\n    seed: [5, 6]\n", path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 8);
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        assert_command(&scene, 0, i, expected[i]);
    }
    assert_string_equal(ps_scene_value_of(&scene.results[0], 7, 1)->texts[0], "32");
    ps_scene_free(&scene);
}

static void assert_points(void **state, const char *range, const char *first, const char *last,
                          size_t num) {
    char path[TEST_PATH_BYTES];
    char text[SENTENCE_BYTES];
    ps_scene scene;
    snprintf(text, sizeof text, POWER "    points: %s\n", range);
    must_read(state, &scene, text, path);
    const ps_scene_entry *const entry = &scene.results[0].entries[0];
    assert_int_equal(entry->num_values, num);
    assert_string_equal(entry->values[0].texts[0], first);
    assert_string_equal(entry->values[num - 1].texts[0], last);
    ps_scene_free(&scene);
}

static void ranges_of_points(void **state) {
    assert_points(state, "16..4096", "16", "4096", 9);
    assert_points(state, "16..4095", "16", "2048", 8);
    assert_points(state, "7..7", "7", "7", 1);
    assert_points(state, "1e3..4e3", "1000", "4000", 3);
    assert_points(state, "1..1e10", "1", "8589934592", 34);
    assert_points(state, "[12, 1e3]", "12", "1e3", 2);
}

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
                    "  - {result: quadrature, brdf: 'zonal:file=/x.lobe', weights: equal}\n",
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
    assert_int_equal(a->num_points, b->num_points);
    assert_int_equal(a->seed, b->seed);
    assert_int_equal(a->max_frequency, b->max_frequency);
    assert_int_equal(a->shells, b->shells);
    assert_true(a->tolerance == b->tolerance);
    assert_true(is_same_text(a->weights, b->weights) && is_same_text(a->engine, b->engine));
    assert_int_equal(a->num_samplers, b->num_samplers);
    for (size_t i = 0; i < a->num_samplers; i++) {
        assert_string_equal(a->samplers[i], b->samplers[i]);
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
              "    shells: true\n    homogenize: false\n    engine: -x\n"
              "  - {result: power, files: [-a, 'b c', --help], weights: -w}\n";
    const test_folder *const folder = *state;
    char here[TEST_PATH_BYTES];
    ps_scene scene;
    ps_command command = {.name = "power", .options = ps_result_power.options};
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
                  "  - {result: power, name: x, title: 'it''s', points: 16..64, pictures: true}\n"
                  "  - {result: quadrature, brdf: ['zonal:file=l', diffuse], weights: [w, equal]}\n"
                  "  - {result: check, against: s, samplers: white, plot: false, no-skip: true}\n",
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
    static const char *const names[] = {"gate",          "diffuse",     "glossy",
                                        "radial_mean",   "m18_figures", "sphere_samplers",
                                        "torus_samplers"};
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

#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_FOLDER(files_that_are_no_scene),
        IN_FOLDER(keys_of_the_file),
        IN_FOLDER(keys_of_results),
        IN_FOLDER(values_out_of_range),
        IN_FOLDER(limits),
        IN_FOLDER(number_of_questions),
        IN_FOLDER(aliases),
        IN_FOLDER(combinations),
        IN_FOLDER(ranges_of_points),
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
