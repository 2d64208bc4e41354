/* Lists in scenes: which of them ask several questions, and which are one value of a question. */
#include "scene_text.h"

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
    assert_points(state, "[12, 1e3]", "12", "1000", 2);
    assert_points(state, "64,128,1e3", "64", "1000", 3);
    assert_points(state, "16..64,100", "16", "100", 4);
    assert_points(state, "[16..64, \"100,200..400\"]", "16", "400", 6);
}

/* One spectrum serves all integrands: a list of them is one value, and asks one question. */
static void lists_of_integrands(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              "scene: 1\ndefaults: {integrand: cap}\nresults:\n"
              "  - {result: variance, samplers: [white, jittered], integrands: [disk, "
              "'gaussian:sigma=0.1'], seed: 3}\n"
              "  - {result: variance, sampler: zphi}\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 2);
    assert_command(&scene, 0, 1,
                   "pointspec variance --sampler jittered --integrand disk --integrand "
                   "gaussian:sigma=0.1 --seed 3");
    assert_command(&scene, 1, 0, "pointspec variance --sampler zphi --integrand cap");
    ps_scene_free(&scene);
}

/* What compares samplers or numbers of points asks all of them in one question, wherever its key
 * stands; a flag that is off does not. */
static void keys_that_join(void **state) {
    char path[TEST_PATH_BYTES];
    ps_scene scene;
    must_read(state, &scene,
              "scene: 1\ndefaults: {samplers: [white, jittered], points: [16..64, 100]}\nresults:\n"
              "  - {result: variance, integrand: disk, seed: [3, 4], rates: auto}\n"
              "  - {result: variance, rank: true, samplers: [zphi, spiral], points: 8}\n"
              "  - {result: variance, rank: false}\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 2);
    assert_command(&scene, 0, 1,
                   "pointspec variance --integrand disk --seed 4 --rates auto --sampler white "
                   "--sampler jittered --points 16,32,64,100");
    assert_int_equal(ps_scene_num_questions(&scene.results[1]), 1);
    assert_command(&scene, 1, 0,
                   "pointspec variance --rank --sampler zphi --sampler spiral --points 8");
    assert_int_equal(ps_scene_num_questions(&scene.results[2]), 8);
    ps_scene_free(&scene);
    must_read(state, &scene,
              "scene: 1\ndefaults: {rates: 16..64, rank: true}\nresults:\n"
              "  - {result: power, samplers: [white, jittered]}\n"
              "  - {result: variance, samplers: [white, jittered]}\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 2);
    assert_int_equal(ps_scene_num_questions(&scene.results[1]), 1);
    ps_scene_free(&scene);
    must_read(state, &scene,
              "scene: 1\ndefaults: {rank: true}\nresults:\n"
              "  - {result: variance, samplers: [white, jittered], rank: false}\n",
              path);
    assert_int_equal(ps_scene_num_questions(&scene.results[0]), 2);
    ps_scene_free(&scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        IN_FOLDER(combinations),
        IN_FOLDER(ranges_of_points),
        IN_FOLDER(lists_of_integrands),
        IN_FOLDER(keys_that_join),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
