/* The commands that make points and run scenes. */
#include "commands/points.h"
#include "commands/prefetch.h"
#include "scene/run/run.h"

/* Writes no table. */
static pspec_status sample(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                           ps_error *error) {
    (void)out;
    return request->prefetch ? ps_points_prefetch(request, hooks, error)
                             : ps_points_sample(request, hooks, error);
}

static pspec_status convert(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    (void)out;
    return ps_points_convert(request, hooks, error);
}

const ps_command ps_command_sample = {
    .name = "sample",
    .purpose = "generate point sets of the torus or the sphere",
    .usage = "sample --sampler NAME[:key=value,...] [options]",
    .description =
        "Writes realizations of a sampler of the torus [0,1)^D, or of the sphere or hemisphere, "
        "where "
        "points are unit vectors x, y, z. Realization r depends on nothing but the sampler, its "
        "parameters, N, D, the seed and r. UTK text has one point per line, coordinates with 17 "
        "digits, and a line \"#\" between two realizations; an NPY array has the shape (M, N, D), "
        "D = 3 on the sphere. --homogenize shifts points of the torus and rotates those of the "
        "sphere, at random. --plot draws the first realization: the unit square, a line, every "
        "pair of coordinates of more dimensions, both sides of the sphere. Without -o and --format "
        "the picture is all that is made, and several samplers or N are drawn side by side. Sets "
        "that "
        "take long to make, of blue noise, are kept on the disk, for this command and all others, "
        "up to --kept-sets; --prefetch only fills that store, on all processors, and goes on where "
        "it was stopped.",
    .takes = PS_COMMAND_BIT(sample),
    .samples = PS_DOMAIN_ANY,
    .examples = {"pointspec sample --sampler jittered -n 1024 -m 10 --seed 7 -o points.txt",
                 "pointspec sample --sampler sobol:scramble=owen -n 4096 -d 3 -o points.npy"},
    .formats = PS_POINT_FORMATS,
    .counted = "realizations",
    .speaker = "pointspec sample",
    .makes_points = true,
    .run = sample,
    .plan = ps_points_plan_sample,
};

const ps_command ps_command_convert = {
    .name = "convert",
    .purpose = "one format of point files into another",
    .usage = "convert [options] FILE... [-o OUT]",
    .description =
        "Reads point sets of the torus or of the sphere and writes them in another format, a block "
        "of points at a time, so that files may be larger than memory. Several files become sets "
        "of one output. What the format of the output cannot keep is refused, or said on standard "
        "error. Files compressed by gzip are read as they are. --plot draws the first set; without "
        "-o "
        "and --format the picture is all that is made, and several files are drawn side by side.",
    .takes = PS_COMMAND_BIT(convert),
    .examples = {"pointspec sample --sampler white -n 64 -m 3 | pointspec convert - -o sets.npy",
                 "pointspec sample --sampler halton -n 8 | pointspec convert --select-points 2.. "
                 "--format csv -"},
    .formats = PS_POINT_FORMATS,
    .weights = "equal|column",
    .samples = PS_DOMAIN_ANY,
    .counted = "points",
    .speaker = "pointspec convert",
    .makes_points = true,
    .run = convert,
    .plan = ps_points_plan_convert,
};

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
    .plan = ps_run_plan,
};
