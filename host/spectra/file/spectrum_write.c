#include "base/text.h"
#include "files/output_file.h"
#include "spectra/file/spectrum_file.h"
#include "spectra/file/spectrum_format.h"

#include "pointspec_version.h"

#include <inttypes.h>
#include <string.h>
#include <zlib.h>

/* A file and the checksum of what went into it. */
typedef struct writer {
    ps_output_file *file;
    uLong checksum;
} writer;

static void write_bytes(writer *out, const void *bytes, size_t num_bytes) {
    out->checksum = crc32(out->checksum, bytes, (uInt)num_bytes); /* blocks are small */
    ps_output_write(out->file, bytes, 1, num_bytes);
}

static void write_integer(writer *out, uint64_t value, size_t num_bytes) {
    unsigned char bytes[sizeof value];
    for (size_t i = 0; i < num_bytes; i++) {
        bytes[i] = (unsigned char)(value >> (8 * i));
    }
    write_bytes(out, bytes, num_bytes);
}

static void write_doubles(writer *out, const double *numbers, size_t num) {
    for (size_t i = 0; i < num; i++) {
        uint64_t bits = 0;
        memcpy(&bits, &numbers[i], sizeof bits);
        write_integer(out, bits, sizeof bits);
    }
}

static void write_sums(writer *out, const ps_sums *sums, size_t num) {
    for (size_t i = 0; i < num; i++) {
        const double numbers[PS_SPECTRUM_SUMS] = {sums[i].sum, sums[i].sum_low, sums[i].square,
                                                  sums[i].square_low};
        write_doubles(out, numbers, PS_SPECTRUM_SUMS);
    }
}

static const char *kind_of(const ps_frequencies *set) {
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        return ps_spectrum_kinds[set->degree_step > 1 ? PS_SPECTRUM_EVEN_DEGREES
                                                      : PS_SPECTRUM_DEGREES];
    }
    return ps_spectrum_kinds[set->rings != NULL                 ? PS_SPECTRUM_SAMPLE
                             : set->kind == PS_FREQUENCIES_LIST ? PS_SPECTRUM_LIST
                             : set->kind == PS_FREQUENCIES_BOX  ? PS_SPECTRUM_BOX
                                                                : PS_SPECTRUM_BALL];
}

static void describe(const ps_spectrum_sums *sums, ps_text *text) {
    const ps_frequencies *set = &sums->frequencies;
    ps_text_append(text, PS_SPECTRUM_MAGIC " %d\n", PS_SPECTRUM_VERSION);
    ps_text_append(text, "pointspec_version: " PS_VERSION "\n");
    ps_text_append(text, "dimension: %u\n", set->dimension);
    ps_text_append(text, "frequencies: %s\n", kind_of(set));
    if (set->rings != NULL) {
        ps_text_append(text, "per_ring: %" PRIu64 "\n", set->per_ring);
    }
    ps_text_append(text, "max_frequency: %" PRId32 "\n", set->max_frequency);
    ps_text_append(text, "num_frequencies: %zu\n", set->num);
    ps_text_append(text, "bins: %s\n", ps_spectrum_bins_write(&set->bins).text);
    ps_text_append(text, "num_bins: %zu\n", sums->num_bins);
    ps_text_append(text, "normalization: %s\n", ps_spectrum_normalizations[sums->normalization]);
    ps_text_append(text, "realizations: %" PRIu64 "\n", sums->totals.num_realizations);
    ps_text_append(text, "smallest_points: %zu\n", sums->totals.smallest_points);
    ps_text_append(text, "largest_points: %zu\n\n", sums->totals.largest_points);
}

static void write_all(writer *out, const ps_spectrum_sums *sums, const ps_text *header) {
    const ps_frequencies *set = &sums->frequencies;
    const double totals[PS_SPECTRUM_TOTALS] = {sums->reference_points, sums->totals.sum_weights,
                                               sums->error};
    write_bytes(out, header->data, header->length);
    write_doubles(out, totals, PS_SPECTRUM_TOTALS);
    write_sums(out, &sums->totals.points, 1);
    write_sums(out, &sums->totals.sample_sizes, 1);
    for (size_t i = 0; set->kind == PS_FREQUENCIES_LIST && i < set->num * set->dimension; i++) {
        write_integer(out, (uint32_t)set->vectors[i], sizeof set->vectors[i]);
    }
    for (size_t i = 0; i < set->num_rings; i++) {
        write_integer(out, set->rings[i].num_frequencies, sizeof set->rings[i].num_frequencies);
        write_doubles(out, &set->rings[i].mean_frequency, 1);
    }
    write_sums(out, sums->bins, sums->num_bins);
    write_sums(out, sums->powers, set->num);
    write_integer(out, out->checksum, sizeof(uint32_t));
}

pspec_status ps_spectrum_write(const ps_spectrum_sums *sums, const char *path, ps_error *error) {
    ps_text header = {0};
    writer out = {.checksum = crc32(0, NULL, 0)};
    describe(sums, &header);
    pspec_status status = ps_text_check(&header, error);
    if (status == PSPEC_OK) {
        status = ps_output_open(&out.file, path, error);
    }
    if (status == PSPEC_OK) {
        write_all(&out, sums, &header);
        status = ps_output_commit(&out.file, error);
    }
    ps_text_free(&header);
    return status;
}
