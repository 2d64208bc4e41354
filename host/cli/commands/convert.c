/* pointspec convert: point files into another format. */
#include "cli/points_shown.h"

#include "cli/command.h"

static pspec_status run(const ps_request *arguments, ps_error *error) {
    return ps_points_make_shown(ps_points_convert, "convert", "points", arguments, error);
}

const ps_command ps_command_convert = {
    .name = "convert",
    .summary = "one format of point files into another",
    .usage = "convert [options] FILE... [-o OUT]",
    .description =
        "Reads point sets of the torus or of the sphere and writes them in another format, a block "
        "of points at a time, so that files may be larger than memory. Several files become sets "
        "of one output. What the format of the output cannot keep is refused, or said on standard "
        "error. Files compressed by gzip are read as they are.",
    .takes = PS_TAKER_BIT(convert),
    .formats = PS_POINT_FORMATS,
    .weights = PS_CONVERT_WEIGHTS,
    .examples = {"pointspec sample --sampler white -n 64 -m 3 | pointspec convert - -o sets.npy",
                 "pointspec sample --sampler halton -n 8 | pointspec convert --select-points 2.. "
                 "--format csv -"},
    .run = run,
    .plan = ps_plan_table_add_convert,
};
