/* Scenes as texts, for the tests of what is read and of what is refused. */
#ifndef TEST_SCENE_TEXT_H
#define TEST_SCENE_TEXT_H

#include "harness.h"
#include "test_folder.h"

#include "scene/scene.h"

#define HEAD "scene: 1\nresults:\n"
#define POWER HEAD "  - result: power\n"

enum { SENTENCE_BYTES = 2048 };

/* The scene of a text, in the folder as scene.yaml. */
static inline pspec_status read_bytes(test_folder *folder, ps_scene *scene, const void *bytes,
                                      size_t num, char path[TEST_PATH_BYTES], ps_error *error) {
    test_path(folder, "scene.yaml", path);
    assert_true(test_write_file(path, bytes, num));
    return ps_scene_read(scene, path, error);
}

static inline void must_read(void **state, ps_scene *scene, const char *text,
                             char path[TEST_PATH_BYTES]) {
    assert_ok(read_bytes(*state, scene, text, strlen(text), path, error));
}

static inline ps_scene_question make(const ps_scene *scene, size_t result, size_t number) {
    ps_scene_question question;
    assert_ok(ps_scene_question_make(&question, &scene->results[result], number, error));
    return question;
}

static inline void assert_command(const ps_scene *scene, size_t result, size_t number,
                                  const char *expected) {
    ps_scene_question question = make(scene, result, number);
    assert_string_equal(question.request.command_line, expected);
    ps_scene_question_free(&question);
}

#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)

#endif
