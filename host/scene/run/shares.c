/* May several processes share the questions of a scene? */
#include "scene/run/run.h"

static pspec_status look(uint64_t *num, ps_error *why, const ps_request *arguments,
                         const ps_scene *scene) {
    const char *const uncached = ps_run_find_why_uncached(arguments, scene);
    for (size_t i = 0; i < scene->num_results; i++) {
        *num += ps_scene_num_questions(&scene->results[i]);
    }
    if (uncached != NULL) {
        return ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "%s", uncached);
    }
    return *num > 1 ? PSPEC_OK
                    : ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "the scene has one question");
}

pspec_status ps_run_look_at_shares(uint64_t *num, ps_error *why, const ps_request *arguments,
                                   ps_error *error) {
    ps_scene scene = {0};
    PS_TRY(ps_run_check_words(arguments, error));
    if (ps_request_file_comes_once(&(ps_request_file){.path = arguments->files[0]})) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "the scene \"%s\" comes once",
                arguments->files[0]);
        return PSPEC_OK;
    }
    const pspec_status status = ps_run_read_scene(&scene, arguments, error);
    if (status == PSPEC_OK) {
        (void)look(num, why, arguments, &scene);
    }
    ps_scene_free(&scene);
    return status;
}
