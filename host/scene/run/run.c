/* The whole of a run, its beginning and its end. */
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

/* Before the work, while there is time to install it. Memory that is refused says nothing about
 * gnuplot. */
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
        ps_answer_warn(&run->hooks, "%s; pictures are left out where the cache has none",
                       reason.message);
    }
    ps_text_free(&path);
}

/* An integrand without its file is another function. */
static void warn_of_data(const ps_run *run) {
    if (run->scene->missing != NULL) {
        ps_answer_warn(&run->hooks,
                       "\"%s\": " PS_SCENE_NO_DATA "; what the integrand is without a file stands "
                       "in for it",
                       run->scene->missing);
    }
}

/* All that can be found out before the work: questions, folder, former run, cache. */
static pspec_status prepare(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_ask(run, error));
    if (ps_run_only_helps(run)) {
        return ps_run_open_cache(run, error);
    }
    PS_TRY(ps_run_check_inputs(run, error));
    PS_TRY(ps_run_check_folder(run, error));
    PS_TRY(ps_run_read_former(run, error));
    PS_TRY(ps_run_open_cache(run, error));
    warn_of_gnuplot(run);
    warn_of_data(run);
    return PSPEC_OK;
}

/* ---- end --------------------------------------------------------------------------------- */

static void free_result(ps_run_result *result) {
    for (size_t p = 0; p < result->num_plots; p++) {
        free(result->plots[p].svg);
        free(result->plots[p].reason);
    }
    free(result->plots);
    ps_pictures_free(&result->pictures);
    ps_table_destroy(result->table);
    ps_table_destroy(result->summary);
}

void ps_run_free(ps_run *run) {
    for (size_t i = 0; i < run->num_results; i++) {
        free_result(&run->results[i]);
    }
    ps_made_integrands_free(&run->made);
    for (size_t i = 0; i < run->num_questions; i++) {
        ps_scene_question_free(&run->questions[i].asked);
        ps_answer_free(&run->questions[i].answer);
        ps_text_free(&run->questions[i].key);
    }
    free(run->results);
    free(run->questions);
    free(run->files.all);
    ps_pool_free(&run->files.memory);
    ps_scene_free(&run->former);
    ps_cache_close(run->cache);
    if (run->owns_device) {
        ps_device_close(run->device);
    }
    ps_text_free(&run->identity);
}

/* ---- all of it --------------------------------------------------------------------------- */

void ps_run_tell_of_pictures(const ps_run *run, const char *where) {
    if (run->num_undrawn > 0) {
        ps_answer_tell_missing(&run->hooks, "%zu picture%s of \"%s\" %s not drawn: %s",
                               run->num_undrawn, run->num_undrawn == 1 ? "" : "s", where,
                               run->num_undrawn == 1 ? "was" : "were", run->undrawn.message);
    }
}

static pspec_status produce(ps_answer *out, ps_run *run, ps_error *error) {
    PS_TRY(prepare(run, error));
    PS_TRY(ps_run_answer(run, error));
    if (ps_run_only_helps(run)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_run_write(run, error));
    ps_run_end_checkpoints(run);
    ps_run_tell_of_pictures(run, run->folder);
    PS_TRY(ps_run_overview(&out->table, run, error));
    /* what it comes to is told beside the overview, not instead of it */
    return ps_run_judge(run, &out->verdict) == PSPEC_ERROR_CHECK ? PSPEC_OK : out->verdict.status;
}

pspec_status ps_run_check_words(const ps_request *arguments, ps_error *error) {
    return arguments->num_files == 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "one scene is run at a time, but %zu files were named",
                         arguments->num_files);
}

pspec_status ps_run_produce(ps_answer *out, const ps_request *arguments,
                            const ps_answer_hooks *hooks, ps_error *error) {
    ps_scene scene = {0};
    ps_text folder = {0};
    PS_TRY(ps_run_check_words(arguments, error));
    if (arguments->output != NULL) {
        ps_text_append(&folder, "%s", arguments->output);
    } else {
        ps_run_name_folder(arguments->files[0], &folder);
    }
    ps_run run = {.hooks = *hooks,
                  .arguments = arguments,
                  .scene = &scene,
                  .folder = ps_text_string(&folder)};
    pspec_status status = ps_text_check(&folder, error);
    if (status == PSPEC_OK) {
        status = ps_run_read_scene(&scene, arguments, error);
    }
    if (status == PSPEC_OK) {
        status = produce(out, &run, error);
    }
    ps_run_free(&run);
    ps_scene_free(&scene);
    ps_text_free(&folder);
    return status;
}
