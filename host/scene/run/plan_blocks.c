/* The plan of a scene: a block for each of its questions. */
#include "scene/run/run.h"

#include <stdio.h>

static pspec_status add_block(ps_run *run, ps_run_question *question, ps_planner *planner,
                              ps_error *error) {
    enum { JOB = 128 };
    const ps_scene_result *const result = question->asked.result;
    ps_table *const table = planner->table;
    char job[JOB];
    snprintf(job, sizeof job, "%s:%zu", result->name, question->asked.number + 1);
    PS_TRY(ps_table_add_meta(table, "job", PS_TEXT(job), error));
    PS_TRY(
        ps_table_add_meta(table, "question", PS_TEXT(question->asked.request.command_line), error));
    PS_TRY(ps_run_fetch(run, question, error));
    ps_answer_free(&question->answer);
    if (question->is_cached) {
        planner->lead = ps_plan_table_lead(job);
        return ps_plan_table_add_cached(planner, error);
    }
    if (!run->lacks_device) {
        const pspec_status status = ps_run_open_device(run, question, error);
        run->lacks_device = status == PSPEC_ERROR_NO_DEVICE;
        if (status != PSPEC_OK && !run->lacks_device) {
            return status;
        }
    }
    planner->lead = ps_plan_table_lead(job);
    planner->device = run->device;
    return result->kind->plan(planner, &question->asked.request, error);
}

/* Pictures of all results are drawn; those that are in the cache take no time. */
static pspec_status add_pictures(const ps_run *run, ps_planner *planner, ps_error *error) {
    ps_phases phases = {.host = planner->host};
    ps_pictures pictures = {0};
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < run->num_results && status == PSPEC_OK; i++) {
        status = ps_pictures_list(&pictures, run->results[i].asked, error);
    }
    ps_phases_draw(&phases, "pictures", pictures.num);
    ps_phases_say(&phases, "pictures", "%zu by gnuplot", pictures.num);
    ps_pictures_free(&pictures);
    planner->lead = ps_plan_table_lead("pictures");
    return status == PSPEC_OK ? ps_plan_table_add_phases(planner, &phases, error) : status;
}

pspec_status ps_run_plan_blocks(ps_run *run, ps_planner *planner, ps_error *error) {
    PS_TRY(ps_run_ask(run, error));
    PS_TRY(ps_run_open_cache(run, error));
    for (size_t i = 0; i < run->num_questions; i++) {
        ps_run_question *const question = &run->questions[i];
        if (add_block(run, question, planner, error) != PSPEC_OK) {
            return ps_scene_blame(run->scene, question->asked.result, error);
        }
    }
    return add_pictures(run, planner, error);
}

pspec_status ps_run_plan(ps_planner *planner, const ps_request *arguments, ps_error *error) {
    ps_scene scene = {0};
    if (arguments->num_files != 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "one scene is planned at a time, but %zu files were named",
                       arguments->num_files);
    }
    ps_run run = {.hooks = *planner->hooks, .arguments = arguments, .scene = &scene, .folder = ""};
    pspec_status status = ps_run_read_scene(&scene, arguments, error);
    if (status == PSPEC_OK) {
        status = ps_run_plan_blocks(&run, planner, error);
    }
    ps_run_free(&run);
    ps_scene_free(&scene);
    return status;
}
