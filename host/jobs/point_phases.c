#include "jobs/point_phases.h"

#include "points/file_estimate.h"

#include <inttypes.h>
#include <string.h>

/* ---- samplers ------------------------------------------------------------------------------ */

void ps_phases_sample(ps_phases *phases, const ps_sampler_request *request, double realizations,
                      const ps_sets_options *options) {
    const ps_set_place *const place = &options->place;
    static const char name[] = "points";
    const double changed_seconds = 35e-9; /* of a point that is lifted to the sphere, or morphed */
    const int changes =
        (request->lift != PS_SAMPLES_TORUS) + (request->morph.kind != PS_MORPH_NONE);
    const double points = (double)request->num_points * realizations;
    const uint64_t num_kept = ps_sets_count_kept(request, place, (uint64_t)realizations);
    const double num_made = realizations - (double)num_kept;
    ps_phases_add_seconds(phases, name,
                          ps_sampler_seconds(request) * num_made /
                              ps_sets_makers(request, options, (uint64_t)num_made) *
                              ps_figures_host_scale(phases->host, request->sampler->name));
    ps_phases_add_seconds(phases, name, ps_set_store_seconds(request) * (double)num_kept);
    ps_phases_add(phases, name, points * changes * changed_seconds);
    if (ps_set_place_takes(place, request)) {
        ps_phases_say(phases, name, "%.4g of %s, %" PRIu64 " of %.0f sets kept", points,
                      request->sampler->name, num_kept, realizations);
    } else {
        ps_phases_say(phases, name, "%.4g of %s", points, request->sampler->name);
    }
}

/* ---- files --------------------------------------------------------------------------------- */

double ps_phases_read(ps_phases *phases, const char *const *paths, size_t num_paths,
                      const ps_point_options *options, unsigned columns) {
    static const char name[] = "reading";
    const double text_byte = 0.85e-9, binary_byte = 0.15e-9, inflated_byte = 3e-9; /* seconds */
    double points = 0;
    double bytes = 0;
    for (size_t i = 0; i < num_paths; i++) {
        if (ps_given_sets_find(&options->given, paths[i]) != NULL) {
            continue;
        }
        const ps_file_estimate file = ps_file_estimate_of(paths[i], options->format);
        ps_phases_add(phases, name,
                      file.bytes * ((file.is_text ? text_byte : binary_byte) +
                                    (file.is_compressed ? inflated_byte : 0)));
        points += ps_file_estimate_points(&file, columns);
        bytes += file.bytes;
    }
    ps_phases_say(phases, name, "about %.4g points, %.4g bytes", points, bytes);
    return points;
}

void ps_phases_write(ps_phases *phases, const char *path, const char *format, double numbers) {
    static const char name[] = "writing";
    const double text_number = 60e-9, binary_number = 6e-9; /* seconds */
    const char *const used = format != NULL ? format : ps_points_format_by_ending(path);
    const bool is_binary =
        strcmp(used, "npy") == 0 || strcmp(used, "rps") == 0 || strcmp(used, "utk-binary") == 0;
    ps_phases_add(phases, name, numbers * (is_binary ? binary_number : text_number));
    ps_phases_say(phases, name, "%.4g numbers as %s", numbers, used);
}
