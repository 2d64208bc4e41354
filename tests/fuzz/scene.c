/* Scenes: what is taken asks questions that can be made, and its record asks the same. */
#include "fuzz.h"

#include "scene/scene.h"

#include <stdlib.h>
#include <string.h>

/* Enough to meet every entry at its first and other values. */
enum { MOST_MADE = 64 };

static void make(ps_scene_question *out, const ps_scene_result *result, size_t number) {
    ps_error error = {0};
    if (ps_scene_question_make(out, result, number, &error) != PSPEC_OK) {
        fuzz_fail("question %zu of %s cannot be made: %s", number, result->name, error.message);
    }
    if (strncmp(out->request.command_line, "pointspec ", strlen("pointspec ")) != 0) {
        fuzz_fail("no command line: %s", out->request.command_line);
    }
}

static bool is_same_text(const char *a, const char *b) {
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

static void compare_results(const ps_scene_result *a, const ps_scene_result *b) {
    const size_t num = ps_scene_num_questions(a);
    if (num != ps_scene_num_questions(b) || strcmp(a->name, b->name) != 0 ||
        !is_same_text(a->title, b->title) || a->wants_plot != b->wants_plot ||
        a->wants_pictures != b->wants_pictures) {
        fuzz_fail("result %s comes back as another", a->name);
    }
    const size_t step = num > MOST_MADE ? num / MOST_MADE : 1;
    for (size_t q = 0; q < num; q += step) {
        ps_scene_question one;
        ps_scene_question other;
        make(&one, a, q);
        make(&other, b, q);
        if (strcmp(one.request.command_line, other.request.command_line) != 0) {
            fuzz_fail("%s became %s", one.request.command_line, other.request.command_line);
        }
        ps_scene_question_free(&one);
        ps_scene_question_free(&other);
    }
}

static void compare(const ps_scene *a, const ps_scene *b) {
    if (a->num_results != b->num_results || a->num_results == 0 ||
        !is_same_text(a->title, b->title) || !is_same_text(a->description, b->description)) {
        fuzz_fail("another scene comes back");
    }
    for (size_t i = 0; i < a->num_results; i++) {
        compare_results(&a->results[i], &b->results[i]);
    }
}

/* As a record has it, with the folder that paths are relative to. */
static void check_record(const ps_scene *scene) {
    ps_text text = {0};
    ps_scene again;
    ps_error error = {0};
    ps_scene_print(scene, &text);
    ps_text_append(&text, ", \"record\": {\"folder\": ");
    ps_scene_print_text(scene->folder, &text);
    ps_text_append(&text, "}}\n");
    fuzz_file file = fuzz_file_make((fuzz_bytes){(const uint8_t *)text.data, text.length});
    if (ps_scene_read(&again, file.path, &error) != PSPEC_OK) {
        fuzz_fail("the record cannot be read: %s\n%s", error.message, text.data);
    }
    compare(scene, &again);
    ps_scene_free(&again);
    fuzz_file_close(&file);
    ps_text_free(&text);
}

void fuzz_scene(const char *argument, fuzz_bytes input) {
    (void)argument;
    fuzz_file file = fuzz_file_make(input);
    ps_scene scene;
    ps_error error = {0};
    const pspec_status status = ps_scene_read(&scene, file.path, &error);
    fuzz_check_error(status, &error, FUZZ_QUOTES_INPUT);
    if (status == PSPEC_OK) {
        check_record(&scene);
    } else if (status == PSPEC_ERROR_INPUT && input.size > 0 &&
               strncmp(error.message, file.path, strlen(file.path)) != 0) {
        fuzz_fail("a complaint without the file: %s", error.message);
    }
    ps_scene_free(&scene);
    fuzz_file_close(&file);
}
