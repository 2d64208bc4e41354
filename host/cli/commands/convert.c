/* pointspec convert: point files into another format. */
#include "cli/command.h"
#include "cli/shown.h"
#include "commands/points.h"
#include "commands/verb.h"

static pspec_status run(const ps_request *arguments, ps_error *error) {
    ps_shown shown = {.arguments = arguments,
                      .counted = "points",
                      .speaker = "pointspec convert",
                      .is_streamed = true};
    const ps_answer_hooks hooks = ps_shown_hooks(&shown);
    return ps_points_convert(arguments, &hooks, error);
}

const ps_command ps_command_convert = {
    .name = "convert",
    .summary = "one format of point files into another",
    .usage = "convert [options] FILE... [-o OUT]",
    .description =
        "Reads point sets of the torus or of the sphere and writes them in another format, a block "
        "of points at a time, so that files may be larger than memory. Several files become sets "
        "of one output. What the format of the output cannot keep is refused, or said on standard "
        "error. Files compressed by gzip are read as they are. --plot draws the first set; without "
        "-o "
        "and --format the picture is all that is made, and several files are drawn side by side.",
    .verb = &ps_verb_convert,
    .takes = PS_VERB_BIT(convert),
    .examples = {"pointspec sample --sampler white -n 64 -m 3 | pointspec convert - -o sets.npy",
                 "pointspec sample --sampler halton -n 8 | pointspec convert --select-points 2.. "
                 "--format csv -"},
    .run = run,
};
