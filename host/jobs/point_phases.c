#include "jobs/point_phases.h"

#include "base/text.h"
#include "files/input_file.h"

#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>

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

/* How much a file of points holds, guessed from its size and its beginning: nothing is read to its
 * end. */
typedef struct file_estimate {
    double bytes; /* once inflated; 0: not known, of a pipe */
    bool is_text, is_compressed;
    double line_bytes;      /* of text */
    double bytes_of_number; /* of what is not text */
} file_estimate;

enum { BEGINNING = 1 << 14 };

/* Bytes of the file; of a gzip file as many as texts usually come to. Arrays of an archive are
 * taken to be stored. */
static double size_of(const char *path, file_estimate *out, ps_input *input) {
    const double usual = 3; /* of text compressed by gzip */
    struct stat found;
    if (strcmp(path, "-") == 0 || stat(path, &found) != 0 || !S_ISREG(found.st_mode)) {
        return 0;
    }
    out->is_compressed = input->gzip != NULL;
    return (double)found.st_size * (out->is_compressed ? usual : 1);
}

static bool is_text(const unsigned char *bytes, size_t num) {
    for (size_t i = 0; i < num; i++) {
        const bool is_blank = bytes[i] == '\n' || bytes[i] == '\r' || bytes[i] == '\t';
        if (bytes[i] >= 0x7f || (bytes[i] < ' ' && !is_blank)) {
            return false;
        }
    }
    return true;
}

static double mean_line(const unsigned char *bytes, size_t num) {
    size_t lines = 0;
    size_t end = 0;
    for (size_t i = 0; i < num; i++) {
        if (bytes[i] == '\n') {
            lines++;
            end = i + 1;
        }
    }
    return lines > 0 ? (double)end / (double)lines : (double)num;
}

/* format: as options name it; NULL: by ending and first bytes. */
static file_estimate estimate_file(const char *path, const char *format) {
    file_estimate out = {.bytes_of_number = sizeof(double)};
    unsigned char beginning[BEGINNING];
    size_t num = 0;
    ps_input input = {0};
    if (strcmp(path, "-") == 0) { /* what is read of it is gone */
        return out;
    }
    if (ps_input_open(&input, path, NULL) == PSPEC_OK) {
        out.bytes = size_of(path, &out, &input);
        if (out.bytes > 0 &&
            ps_input_read(&input, beginning, sizeof beginning, &num, NULL) == PSPEC_OK) {
            out.is_text = is_text(beginning, num);
            out.line_bytes = mean_line(beginning, num);
        }
    }
    ps_input_close(&input);
    if (format != NULL ? strcmp(format, "rps") == 0 : ps_text_ends_in(path, ".rps")) {
        out.bytes_of_number = sizeof(float);
    }
    return out;
}

/* Points of `columns` numbers each. */
static double estimate_points(const file_estimate *estimate, unsigned columns) {
    if (estimate->bytes <= 0) {
        return 0;
    }
    return estimate->is_text
               ? estimate->bytes / (estimate->line_bytes > 0 ? estimate->line_bytes : 1)
               : estimate->bytes / (columns * estimate->bytes_of_number);
}

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
        const file_estimate file = estimate_file(paths[i], options->format);
        ps_phases_add(phases, name,
                      file.bytes * ((file.is_text ? text_byte : binary_byte) +
                                    (file.is_compressed ? inflated_byte : 0)));
        points += estimate_points(&file, columns);
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
