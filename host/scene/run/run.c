/* The beginning and the end of a run. */
#include "scene/run/run.h"

#include "plots/plot.h"

#include <stdlib.h>

/* ---- begin --------------------------------------------------------------------------------- */

pspec_status ps_run_read_scene(ps_scene *out, const ps_request *arguments, ps_error *error) {
    PS_TRY(ps_scene_read(out, arguments->files[0], error));
    const bool is_repeated = out->num_digests > 0 && arguments->is_memory_of_environment;
    return arguments->limits.constraints.memory_limit > 0 && !is_repeated
               ? ps_scene_limit_memory(out, arguments->limits.constraints.memory_limit, error)
               : PSPEC_OK;
}

/* Before the work, while there is time to install it. Memory that is refused says nothing about gnuplot. */
static void warn_of_gnuplot(const ps_run *run) {
    ps_text path = {0};
    ps_error reason = {0};
    size_t num = 0;
    for (size_t i = 0; i < run->num_results; i++) {
        num += run->results[i].pictures.num;
    }
    const pspec_status status =
        num > 0 && run->hooks.warn != NULL ? ps_plot_find_gnuplot(&path, &reason) : PSPEC_OK;
    if (status != PSPEC_OK && status != PSPEC_ERROR_MEMORY) {
        ps_run_warn(run, "%s; pictures are left out where the cache has none", reason.message);
    }
    ps_text_free(&path);
}

pspec_status ps_run_prepare(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_ask(run, error));
    PS_TRY(ps_run_check_folder(run->folder, error));
    PS_TRY(ps_run_read_former(run, error));
    PS_TRY(ps_run_open_cache(run, error));
    warn_of_gnuplot(run);
    return PSPEC_OK;
}

/* ---- end --------------------------------------------------------------------------------- */

static void free_result(ps_run_result *result) {
    for (size_t q = 0; q < result->num; q++) {
        ps_scene_question_free(&result->questions[q].asked);
        ps_answer_free(&result->questions[q].answer);
    }
    for (size_t p = 0; p < result->num_plots; p++) {
        free(result->plots[p].svg);
        free(result->plots[p].reason);
    }
    free(result->questions);
    free(result->plots);
    ps_pictures_free(&result->pictures);
    ps_table_destroy(result->table);
    ps_table_destroy(result->summary);
}

void ps_run_free(ps_run *run) {
    for (size_t i = 0; i < run->num_results; i++) {
        free_result(&run->results[i]);
    }
    free(run->results);
    ps_run_files_free(&run->files);
    ps_scene_free(&run->former);
    ps_cache_close(run->cache);
    ps_device_close(run->device);
    ps_text_free(&run->identity);
}
