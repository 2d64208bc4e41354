/* pointspec sample: point sets to a file or standard output. */
#include "cli/command.h"
#include "cli/shown.h"
#include "commands/points.h"
#include "commands/prefetch.h"
#include "commands/verb.h"

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_shown shown = {.arguments = arguments,
                      .counted = "realizations",
                      .speaker = "pointspec sample",
                      .is_streamed = true};
    const ps_answer_hooks hooks = ps_shown_hooks(&shown);
    return arguments->prefetch ? ps_points_prefetch(arguments, &hooks, error)
                               : ps_points_sample(arguments, &hooks, error);
}

const ps_command ps_command_sample = {
    .name = "sample",
    .summary = "generate point sets of the torus or the sphere",
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
    .verb = &ps_verb_sample,
    .takes = PS_VERB_BIT(sample),
    .samples = PS_DOMAIN_ANY,
    .examples = {"pointspec sample --sampler jittered -n 1024 -m 10 --seed 7 -o points.txt",
                 "pointspec sample --sampler sobol:scramble=owen -n 4096 -d 3 -o points.npy"},
    .run = run,
};
