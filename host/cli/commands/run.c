/* pointspec run: a scene, its results into a folder. */
#include "base/text.h"
#include "cli/command.h"
#include "cli/run_shown.h"

/* Also with --quiet: files are missing that were asked for. */
static void warn_of_pictures(const ps_run *run) {
    if (run->num_undrawn > 0) {
        fprintf(stderr, "pointspec: %zu picture%s of \"%s\" %s not drawn: %s\n", run->num_undrawn,
                run->num_undrawn == 1 ? "" : "s", run->folder,
                run->num_undrawn == 1 ? "was" : "were", run->undrawn.message);
    }
}

static pspec_status print_overview(const ps_run *run, ps_error *error) {
    ps_table *table = NULL;
    pspec_status status = ps_run_overview(&table, run, error);
    if (status == PSPEC_OK) {
        status = ps_table_write(table, "-", PS_FORMAT_CSV, error);
    }
    ps_table_destroy(table);
    return status;
}

static pspec_status run_scene(ps_run *run, ps_error *error) {
    PS_TRY(ps_run_prepare(run, error));
    PS_TRY(ps_run_answer_shown(run, error));
    PS_TRY(ps_run_write(run, error));
    warn_of_pictures(run);
    PS_TRY(print_overview(run, error));
    return ps_run_judge(run, error);
}

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_scene scene = {0};
    ps_text folder = {0};
    if (arguments->num_files != 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "one scene is run at a time, but %zu files were named",
                       arguments->num_files);
    }
    if (arguments->output != NULL) {
        ps_text_append(&folder, "%s", arguments->output);
    } else {
        ps_run_name_folder(arguments->files[0], &folder);
    }
    ps_run whole = {.hooks = ps_run_hooks_make(arguments),
                    .arguments = arguments,
                    .scene = &scene,
                    .folder = ps_text_string(&folder)};
    pspec_status status = ps_text_check(&folder, error);
    if (status == PSPEC_OK) {
        status = ps_run_read_scene(&scene, arguments, error);
    }
    if (status == PSPEC_OK) {
        status = run_scene(&whole, error);
    }
    ps_run_free(&whole);
    ps_scene_free(&scene);
    ps_text_free(&folder);
    return status;
}

static pspec_status plan(ps_planner *planner, const ps_request *arguments, ps_error *error) {
    const ps_run_hooks hooks = ps_run_hooks_make(arguments);
    return ps_run_plan(planner, arguments, &hooks, error);
}

const ps_command ps_command_run = {
    .name = "run",
    .summary = "all results that a scene file asks for, into a folder with a page that shows them",
    .usage = "run [options] SCENE.yaml",
    .description =
        "Reads a scene (docs/user/scenes.md): results of the kinds power, angular, pairs, "
        "quadrature, "
        "truncation and check, each with the options of the command of that name, where lists ask "
        "for every combination. Writes a folder (-o; else named like the scene) with a table and a "
        "summary of each result, pictures, index.html, which shows all of it, and record.json, "
        "which is a scene too: running it makes the same results and says whether they have the "
        "same bits. Answers are kept in a cache that all scenes share. Exit status 3 when a check "
        "finds another spectrum than the saved one, or a record is not repeated.",
    .takes = PS_TAKER_BIT(run),
    .makes_folder = true,
    .examples = {"printf 'scene: 1\\nresults:\\n  - {result: power, samplers: [white, jittered], "
                 "points: 64..256, realizations: 16}\\n' >scene.yaml && pointspec run scene.yaml",
                 "pointspec run scene.yaml -o again --no-skip"},
    .run = run,
    .plan = plan,
};
