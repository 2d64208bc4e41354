/* Scenes that are refused: every complaint says file, line, key and what is wrong. */
#include "scene_text.h"

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
        {"scene: 1\nresults: *nobody\n", 2, "an alias (*nobody); what it stands for"},
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
         "result: \"powr\" is no kind of answer; did you mean power?"},
        {HEAD "  - result: [power]\n", 3, "result: one value is wanted here"},
        {POWER "    pints: 3\n", 4, "pints: unknown key; did you mean points?"},
        {POWER "    brdf: diffuse\n", 4, "brdf: not a key of this result"},
        {POWER "    max-degree: 3\n", 4, "max-degree: not a key of this result"},
        {POWER "    output: a.csv\n", 4, "output: unknown key"},
        {POWER "    device: cpu\n", 4, "device: unknown key"},
        {HEAD "  - result: pairs\n    pictures: true\n", 4, "pictures: not a key of this result"},
        {HEAD "  - result: angular\n    arrays: true\n", 4,
         "arrays: false or coefficients, not \"true\""},
        {HEAD "  - result: quadrature\n    arrays: coefficients\n", 4,
         "arrays: true or false, not \"coefficients\""},
        {HEAD "  - result: truncation\n    arrays: true\n", 4, "arrays: not a key of this result"},
        {HEAD "  - result: truncation\n    files: a\n", 4, "files: not a key of this result"},
        {HEAD "  - result: sample\n    files: a\n", 4, "files: not a key of this result"},
        {HEAD "  - result: sample\n    weights: equal\n", 4, "weights: not a key of this result"},
        {POWER "    points: 3\n    points: 4\n", 5, "points: this key stands in line 4 already"},
        {POWER "    sampler: white\n    samplers: white\n", 5, "sampler: stands in line 4 already"},
        {POWER "    plot: yes\n", 4, "plot: true or false, not \"yes\""},
        {POWER "    homogenize: 1\n", 4, "homogenize: true or false, not \"1\""},
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
        {HEAD "  - result: variance\n    integrand: [[disk], box]\n", 4,
         "integrand: one value is wanted here, not a list"},
        {HEAD "  - result: variance\n    rank: true\n    samplers: [[white], zphi]\n", 5,
         "samplers: one value is wanted here, not a list"},
        {HEAD "  - result: power\n    rank: true\n", 4, "rank: not a key of this result"},
        {HEAD "  - result: variance\n    integrands: []\n", 4, "integrands: an empty list"},
        {HEAD "  - result: variance\n    integrand: box\n    integrands: disk\n", 5,
         "integrand: stands in line 4 already"},
        {HEAD "  - result: variance\n    integrands: [a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, "
              "a, a]\n",
         4, "more than 16 integrands"},
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
        {POWER "    points: ..8\n", 4, "points: \"..8\": a range has two ends, as 16..256 has"},
        {POWER "    points: 64,,128\n", 4,
         "points: \"64,,128\": a number is missing beside a comma"},
        {POWER "    points: [16..64,\n      64,100]\n", 5, "points: 64 stands there twice"},
        {POWER "    points: 0..8\n", 4, "points: 0 is not between"},
        {POWER "    points: 1..1e11\n", 4, "points: 1e11 is not between"},
        {POWER "    dimension: 7\n", 4, "dimension: 7 is not between 1 and 6"},
        {POWER "    seed: -1\n", 4, "seed: -1 is not between 0 and 18446744073709551615"},
        {POWER "    seed: 18446744073709551616\n", 4, "seed: 18446744073709551616 is not between"},
        {POWER "    tol: 0\n", 4, "tol: 0 is not above 0 and at most 1"},
        {POWER "    tol: nan\n", 4, "tol: \"nan\" is not a finite number"},
        {POWER "    floor: -1\n", 4, "floor: -1 is not above 0"},
        {POWER "    standard-error: 2\n", 4, "standard-error: 2 is not above 0"},
        {POWER "    max-frequency: 268435457\n", 4, "max-frequency: 268435457 is not"},
        {POWER "    per-ring: 1\n", 4, "per-ring: 1 is not between"},
        {POWER "    normalize: full\n", 4,
         "normalize: \"full\" is not one of power, effective, integral"},
        {POWER "    precision: half\n", 4, "precision: \"half\" is not one of auto, single"},
        {POWER "    columns: abc\n", 4, "columns: \"abc\" is not one of "},
        {POWER "    input-format: abc\n", 4, "input-format: \"abc\" is not one of "},
        {POWER "    select-sets: 3..2\n", 4, "select-sets: \"3..2\": the first number"},
        {HEAD "  - result: angular\n    max-degree: 0\n", 4, "max-degree: 0 leaves no"},
        {HEAD "  - result: quadrature\n    smoothness: 2\n", 4, "smoothness: "},
        {HEAD "  - result: truncation\n    harmonics: odd\n", 4,
         "harmonics: \"odd\" is not one of"},
        {HEAD "  - result: check\n    false-alarm-rate: 1\n", 4,
         "false-alarm-rate: 1 is not above 0 and below 1"},
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
    refuses_repeated(state, POWER "    seed: [1", ", 1", MANY - 1, "]\n", 4,
                     "seed: 1001 values, more than 1000");
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

/* Of lists, of scalars, of keys, and of what they stand in. Anchors alone say nothing. */
static void aliases(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              "scene: 1\nresults:\n  - &r\n    result: power\n    samplers: &s [white, halton]\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 2);
    ps_scene_free(&scene);
    refuses(state,
            "scene: 1\nresults:\n  - result: power\n    samplers: &s [white, halton]\n"
            "  - result: power\n    samplers: *s\n",
            6, "an alias (*s); what it stands for is to be written out");
    refuses(state, "scene: 1\nresults: &a\n  - *a\n", 3, "an alias (*a)");
    refuses(state, "&a\nscene: *a\n", 2, "an alias (*a)");
    refuses(state, POWER "    files: &f [*f]\n", 4, "an alias (*f)");
    refuses(state, "scene: 1\n? &k [*k]\n: 1\n", 2, "an alias (*k)");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_FOLDER(files_that_are_no_scene),
        IN_FOLDER(keys_of_the_file),
        IN_FOLDER(keys_of_results),
        IN_FOLDER(values_out_of_range),
        IN_FOLDER(limits),
        IN_FOLDER(number_of_questions),
        IN_FOLDER(aliases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
