/* pointspec run: what a scene asks for (scene/run). */
#include "scene/run/run.h"

const ps_command ps_command_run = {
    .name = "run",
    .purpose = "all results that a scene file asks for, into a folder with a page that shows them",
    .usage = "run [options] SCENE.yaml",
    .description =
        "Reads a scene (docs/user/scenes.md): results of the kinds " PS_KINDS_IN_SENTENCE
        "and points of samplers (sample), each with the options of the command of that name, where "
        "lists ask for every combination. Writes a folder (-o; else named like the scene) with a "
        "table and a "
        "summary of each result, pictures, index.html, which shows all of it, and record.json, "
        "which is a scene too: running it makes the same results and says whether they have the "
        "same bits. Answers are kept in a cache that all scenes share. Exit status 3 when a check "
        "finds another spectrum than the saved one or sets that are not homogeneous, or a record "
        "is not repeated.",
    .takes = PS_COMMAND_BIT(run),
    .makes_folder = true,
    .examples = {"printf 'scene: 1\\nresults:\\n  - {result: power, samplers: [white, jittered], "
                 "points: 64..256, realizations: 16}\\n' >scene.yaml && pointspec run scene.yaml",
                 "pointspec run scene.yaml -o again --no-skip"},
    .counted = "realizations",
    .run = ps_run_produce,
    .look_at_shares = ps_run_look_at_shares,
    .plan = ps_run_plan,
};
