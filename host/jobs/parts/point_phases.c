#include "jobs/parts/point_phases.h"

#include "points/file_estimate.h"

#include <string.h>

/* ---- samplers ------------------------------------------------------------------------------ */

/* By name, and by a value of a parameter where that makes a difference. */
static const struct {
    const char *name, *value;
    ps_host_kind kind;
} costs[] = {
    {"white", NULL, PS_HOST_WHITE},
    {"regular", NULL, PS_HOST_REGULAR},
    {"jittered", NULL, PS_HOST_JITTERED},
    {"latin-hypercube", NULL, PS_HOST_LATIN},
    {"sobol", "owen", PS_HOST_OWEN},
    {"sobol", "xor", PS_HOST_NET},
    {"sobol", NULL, PS_HOST_SOBOL},
    {"larcher-pillichshammer", "owen", PS_HOST_OWEN},
    {"larcher-pillichshammer", "xor", PS_HOST_NET},
    {"larcher-pillichshammer", NULL, PS_HOST_SOBOL},
    {"halton", NULL, PS_HOST_HALTON},
    {"hammersley", NULL, PS_HOST_HALTON},
    {"white-sphere", NULL, PS_HOST_WHITE_SPHERE},
    {"white-hemisphere", NULL, PS_HOST_WHITE_SPHERE},
    {"zphi", NULL, PS_HOST_ZPHI},
    {"healpix", NULL, PS_HOST_HEALPIX},
    {"healpix-jittered", NULL, PS_HOST_HEALPIX},
    {"fibonacci", NULL, PS_HOST_FIBONACCI},
    {"fibonacci-hemisphere", NULL, PS_HOST_FIBONACCI},
    {"spiral", NULL, PS_HOST_SPIRAL},
};

static ps_host_kind kind_of(const ps_sampler_request *request) {
    for (size_t i = 0; i < sizeof costs / sizeof costs[0]; i++) {
        bool has_value = costs[i].value == NULL;
        for (size_t p = 0; p < PS_MAX_SAMPLER_PARAMETERS; p++) {
            has_value = has_value || strcmp(request->values[p], costs[i].value) == 0;
        }
        if (strcmp(costs[i].name, request->sampler->name) == 0 && has_value) {
            return costs[i].kind;
        }
    }
    return PS_HOST_WHITE_SPHERE;
}

void ps_phases_sample(ps_phases *phases, const ps_sampler_request *request, double realizations) {
    static const char name[] = "points";
    const double points = (double)request->num_points * realizations;
    const bool is_on_torus = request->sampler->domain == PS_SAMPLES_TORUS;
    const bool is_lifted = request->lift != PS_SAMPLES_TORUS;
    const unsigned axes = is_lifted ? 2 : request->dimension;
    ps_phases_add(phases, name, kind_of(request), points * (is_on_torus ? axes : 1));
    ps_phases_add(phases, name, PS_HOST_LIFT, is_lifted ? points : 0);
    ps_phases_add(phases, name, PS_HOST_MOVE, request->homogenize ? points : 0);
    ps_phases_add(phases, name, PS_HOST_MORPH, request->morph.kind != PS_MORPH_NONE ? points : 0);
    ps_phases_say(phases, name, "%.4g of %s", points, request->sampler->name);
}

/* ---- files --------------------------------------------------------------------------------- */

double ps_phases_read(ps_phases *phases, const char *const *paths, size_t num_paths,
                      const char *format, unsigned columns) {
    static const char name[] = "reading";
    double points = 0;
    double bytes = 0;
    for (size_t i = 0; i < num_paths; i++) {
        const ps_file_estimate file = ps_file_estimate_of(paths[i], format);
        ps_phases_add(phases, name, file.is_text ? PS_HOST_READ_TEXT : PS_HOST_READ_BINARY,
                      file.bytes);
        ps_phases_add(phases, name, PS_HOST_INFLATE, file.is_compressed ? file.bytes : 0);
        points += ps_file_estimate_points(&file, columns);
        bytes += file.bytes;
    }
    ps_phases_say(phases, name, "about %.4g points, %.4g bytes", points, bytes);
    return points;
}

void ps_phases_write(ps_phases *phases, const char *path, const char *format, double numbers) {
    static const char name[] = "writing";
    const char *const used = format != NULL ? format : ps_points_format_by_ending(path);
    const bool is_binary =
        strcmp(used, "npy") == 0 || strcmp(used, "rps") == 0 || strcmp(used, "utk-binary") == 0;
    ps_phases_add(phases, name, is_binary ? PS_HOST_WRITE_BINARY : PS_HOST_WRITE_TEXT, numbers);
    ps_phases_say(phases, name, "%.4g numbers as %s", numbers, used);
}
