#include "base/memory.h"
#include "frequencies/frequency_sample.h"
#include "spectra/spectrum_file.h"
#include "spectra/spectrum_format.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

enum { LINE_BYTES = 128 }; /* header lines are short; a longer one is none of ours */

/* A file, what is left of it, and the checksum of what was read. */
typedef struct reader {
    FILE *stream;
    const char *path;
    uint64_t rest;
    uLong checksum;
    ps_error *error;
} reader;

/* What the header says, before anything of that size is allocated. */
typedef struct header {
    uint64_t dimension, per_ring, max_frequency, num_frequencies, num_bins;
    uint64_t realizations, smallest_points, largest_points;
    size_t kind, normalization; /* places in the tables of spectrum_format.h */
    ps_bin_rule bins;
} header;

static pspec_status fail(const reader *in, const char *what) {
    return ps_fail(in->error, PSPEC_ERROR_INPUT, "\"%s\" cannot be used as a spectrum: %s",
                   in->path, what);
}

static pspec_status fail_system(const reader *in, int reason) {
    return ps_fail(in->error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", in->path,
                   reason != 0 ? strerror(reason) : "a read failed");
}

static pspec_status read_bytes(reader *in, void *bytes, size_t num_bytes) {
    if (num_bytes > in->rest) {
        return fail(in, "it is truncated");
    }
    errno = 0;
    if (fread(bytes, 1, num_bytes, in->stream) != num_bytes) {
        return ferror(in->stream) ? fail_system(in, errno) : fail(in, "it is truncated");
    }
    in->rest -= num_bytes;
    in->checksum = crc32(in->checksum, bytes, (uInt)num_bytes); /* blocks are small */
    return PSPEC_OK;
}

static pspec_status read_integer(reader *in, size_t num_bytes, uint64_t *out) {
    unsigned char bytes[sizeof *out];
    PS_TRY(read_bytes(in, bytes, num_bytes));
    *out = 0;
    for (size_t i = 0; i < num_bytes; i++) {
        *out |= (uint64_t)bytes[i] << (8 * i);
    }
    return PSPEC_OK;
}

static pspec_status read_doubles(reader *in, double *numbers, size_t num) {
    for (size_t i = 0; i < num; i++) {
        uint64_t bits = 0;
        PS_TRY(read_integer(in, sizeof bits, &bits));
        memcpy(&numbers[i], &bits, sizeof bits);
    }
    return PSPEC_OK;
}

static pspec_status read_sums(reader *in, ps_sums *sums, size_t num) {
    for (size_t i = 0; i < num; i++) {
        double numbers[PS_SPECTRUM_SUMS];
        PS_TRY(read_doubles(in, numbers, PS_SPECTRUM_SUMS));
        sums[i] = (ps_sums){numbers[0], numbers[1], numbers[2], numbers[3]};
    }
    return PSPEC_OK;
}

/* ---- header ------------------------------------------------------------------------------ */

static pspec_status read_line(reader *in, char line[LINE_BYTES]) {
    for (size_t i = 0; i < LINE_BYTES; i++) {
        PS_TRY(read_bytes(in, &line[i], 1));
        if (line[i] == '\0') {
            break;
        }
        if (line[i] == '\n') {
            line[i] = '\0';
            return PSPEC_OK;
        }
    }
    return fail(in, "its header is not one");
}

/* The value of the next line, which must have this key. */
static pspec_status read_value(reader *in, const char *key, char line[LINE_BYTES],
                               const char **value) {
    char what[LINE_BYTES];
    const size_t length = strlen(key);
    PS_TRY(read_line(in, line));
    if (strncmp(line, key, length) != 0 || strncmp(line + length, ": ", 2) != 0) {
        snprintf(what, sizeof what, "its header lacks the line \"%s\"", key);
        return fail(in, what);
    }
    *value = line + length + 2;
    return PSPEC_OK;
}

static pspec_status read_count(reader *in, const char *key, uint64_t least, uint64_t most,
                               uint64_t *out) {
    char line[LINE_BYTES];
    char what[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_value(in, key, line, &value));
    *out = 0;
    for (const char *digit = value; *digit != '\0'; digit++) {
        const uint64_t unit = (uint64_t)(*digit - '0');
        if (*digit < '0' || *digit > '9' || *out > (most - unit) / 10) {
            *out = UINT64_MAX;
            break;
        }
        *out = *out * 10 + unit;
    }
    if (value[0] == '\0' || *out < least || *out > most) {
        snprintf(what, sizeof what, "%s is not a number from %" PRIu64 " to %" PRIu64, key, least,
                 most);
        return fail(in, what);
    }
    return PSPEC_OK;
}

static pspec_status read_word(reader *in, const char *key, const char *const *words,
                              size_t num_words, size_t *out) {
    char line[LINE_BYTES];
    char what[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_value(in, key, line, &value));
    for (*out = 0; *out < num_words; (*out)++) {
        if (strcmp(value, words[*out]) == 0) {
            return PSPEC_OK;
        }
    }
    snprintf(what, sizeof what, "its %s are of an unknown kind", key);
    return fail(in, what);
}

static pspec_status read_bins(reader *in, header *out) {
    char line[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_value(in, "bins", line, &value));
    const bool is_rule = ps_spectrum_bins_parse(&out->bins, value, (unsigned)out->dimension);
    return is_rule ? PSPEC_OK : fail(in, "its bins are of an unknown kind");
}

static pspec_status read_magic(reader *in) {
    char magic[sizeof PS_SPECTRUM_MAGIC] = {0};
    char line[LINE_BYTES];
    char expected[16];
    if (in->rest < sizeof magic) {
        return fail(in, "it is not a spectrum file of pointspec");
    }
    PS_TRY(read_bytes(in, magic, sizeof magic));
    if (memcmp(magic, PS_SPECTRUM_MAGIC " ", sizeof magic) != 0) {
        return fail(in, "it is not a spectrum file of pointspec");
    }
    PS_TRY(read_line(in, line));
    snprintf(expected, sizeof expected, "%d", PS_SPECTRUM_VERSION);
    return strcmp(line, expected) == 0
               ? PSPEC_OK
               : fail(in, "it has another version of the format than this program reads");
}

static pspec_status read_header(reader *in, header *out) {
    char line[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_magic(in));
    PS_TRY(read_value(in, "pointspec_version", line, &value));
    PS_TRY(read_count(in, "dimension", 1, PS_MAX_TORUS_DIMENSION, &out->dimension));
    PS_TRY(read_word(in, "frequencies", ps_spectrum_kinds, PS_SPECTRUM_NUM_KINDS, &out->kind));
    if (out->kind == PS_SPECTRUM_SAMPLE) {
        PS_TRY(read_count(in, "per_ring", PS_MIN_PER_RING, PS_MAX_NUM_FREQUENCIES, &out->per_ring));
    }
    PS_TRY(read_count(in, "max_frequency", 0, PS_MAX_FREQUENCY, &out->max_frequency));
    PS_TRY(read_count(in, "num_frequencies", 1, UINT32_MAX, &out->num_frequencies));
    PS_TRY(read_bins(in, out));
    PS_TRY(read_count(in, "num_bins", 0, UINT32_MAX, &out->num_bins));
    PS_TRY(read_word(in, "normalization", ps_spectrum_normalizations, 3, &out->normalization));
    PS_TRY(read_count(in, "realizations", 1, PS_SPECTRUM_MOST_REALIZATIONS, &out->realizations));
    PS_TRY(read_count(in, "smallest_points", 1, SIZE_MAX / 16, &out->smallest_points));
    PS_TRY(read_count(in, "largest_points", out->smallest_points, SIZE_MAX / 16,
                      &out->largest_points));
    PS_TRY(read_line(in, line));
    return line[0] == '\0' ? PSPEC_OK : fail(in, "its header does not end where it should");
}

static bool is_list(const header *head) {
    return head->kind == PS_SPECTRUM_LIST || head->kind == PS_SPECTRUM_SAMPLE;
}

/* Everything after the header has a size that follows from it: nothing is allocated that the file
 * does not have. The numbers are below 2^32, so no product overflows. */
static pspec_status check_size(const reader *in, const header *head) {
    const uint64_t sum_bytes = PS_SPECTRUM_SUMS * sizeof(double);
    const uint64_t list_bytes =
        is_list(head) ? head->num_frequencies * head->dimension * sizeof(int32_t) : 0;
    const uint64_t ring_bytes =
        head->kind == PS_SPECTRUM_SAMPLE ? head->num_bins * 2 * sizeof(uint64_t) : 0;
    const uint64_t expected = PS_SPECTRUM_TOTALS * sizeof(double) + list_bytes + ring_bytes +
                              sum_bytes * (1 + head->num_bins + head->num_frequencies) +
                              sizeof(uint32_t);
    if (in->rest != expected) {
        return fail(in, in->rest < expected ? "it is truncated"
                                            : "there is more in it than its "
                                              "header says");
    }
    return PSPEC_OK;
}

/* ---- arrays ------------------------------------------------------------------------------ */

static pspec_status read_list(reader *in, const header *head, ps_frequencies *out) {
    const size_t num = (size_t)head->num_frequencies * (size_t)head->dimension;
    int32_t *vectors = NULL;
    PS_TRY(PS_NEW(&vectors, num, "frequencies", in->error));
    *out = (ps_frequencies){.kind = PS_FREQUENCIES_LIST, .vectors = vectors}; /* to be freed */
    for (size_t i = 0; i < num; i++) {
        uint64_t bits = 0;
        PS_TRY(read_integer(in, sizeof(int32_t), &bits));
        const int64_t value = (int64_t)bits - (bits > INT32_MAX ? (int64_t)1 << 32 : 0);
        if (llabs((long long)value) > PS_MAX_FREQUENCY) {
            return fail(in, "a frequency in it is too large");
        }
        vectors[i] = (int32_t)value;
    }
    return ps_frequencies_list(out, (unsigned)head->dimension, (size_t)head->num_frequencies,
                               vectors, in->error);
}

/* What a list was drawn from. */
static pspec_status read_rings(reader *in, const header *head, ps_frequencies *set) {
    uint64_t sum = 0;
    PS_TRY(PS_NEW(&set->rings, head->num_bins, "rings", in->error));
    set->num_rings = (size_t)head->num_bins;
    set->per_ring = head->per_ring;
    if (set->max_frequency > (int64_t)head->max_frequency) {
        return fail(in, "its frequencies are beyond its max_frequency");
    }
    set->max_frequency = (int32_t)head->max_frequency;
    if (ps_frequencies_set_bins(set, &head->bins, NULL) != PSPEC_OK) {
        return fail(in, "its bins do not fit its max_frequency");
    }
    for (size_t i = 0; i < set->num_rings; i++) {
        ps_sampled_ring *const ring = &set->rings[i];
        PS_TRY(read_integer(in, sizeof ring->num_frequencies, &ring->num_frequencies));
        PS_TRY(read_doubles(in, &ring->mean_frequency, 1));
        if (ring->num_frequencies > UINT64_MAX / 2 - sum || !(ring->mean_frequency > 0)) {
            return fail(in, "its rings are none");
        }
        sum += ring->num_frequencies;
    }
    return PSPEC_OK;
}

/* Every ring has as many of its frequencies in the list as were to be drawn. */
static pspec_status make_bins(const reader *in, const header *head, const ps_frequencies *set,
                              ps_bins *bins) {
    ps_error inner = {0};
    const pspec_status status = ps_bins_create(bins, set, &inner);
    if (status == PSPEC_ERROR_MEMORY) {
        return ps_fail(in->error, status, "%s", inner.message);
    }
    if (status != PSPEC_OK || bins->num != head->num_bins) {
        return fail(in, "its num_bins does not fit its frequencies");
    }
    for (size_t b = 0; set->rings != NULL && b < bins->num; b++) {
        const uint64_t size = bins->bins[b].num_frequencies;
        const uint64_t num = bins->bins[b].end - bins->bins[b].begin;
        if (num != (size < set->per_ring ? size : set->per_ring) ||
            bins->bins[b].key == INT64_MAX) {
            return fail(in, "its rings do not fit its frequencies");
        }
    }
    return PSPEC_OK;
}

/* The number of a ball is known only approximately before it is enumerated: what is off by more
 * than this factor is not tried, however large the box around it. */
static pspec_status make_grid(const header *head, ps_frequencies *out) {
    return ps_frequencies_grid(out, (unsigned)head->dimension, (int32_t)head->max_frequency,
                               head->kind == PS_SPECTRUM_BALL, &head->bins, 0, NULL);
}

static pspec_status make_degrees(const header *head, ps_frequencies *out) {
    PS_TRY(ps_frequencies_degrees(out, (int64_t)head->max_frequency,
                                  head->kind == PS_SPECTRUM_EVEN_DEGREES, NULL));
    return out->dimension == head->dimension && out->max_frequency == (int64_t)head->max_frequency
               ? PSPEC_OK
               : PSPEC_ERROR_INPUT;
}

static pspec_status make_lattice(const reader *in, const header *head, ps_frequencies *out) {
    const double factor = 4;
    const bool are_degrees =
        head->kind == PS_SPECTRUM_DEGREES || head->kind == PS_SPECTRUM_EVEN_DEGREES;
    const double num = (double)head->num_frequencies;
    if ((are_degrees ? make_degrees(head, out) : make_grid(head, out)) != PSPEC_OK ||
        (double)out->num > factor * num) {
        return fail(in, "its max_frequency does not fit its num_frequencies");
    }
    PS_TRY(ps_frequencies_enumerate(out, in->error));
    return out->num == head->num_frequencies
               ? PSPEC_OK
               : fail(in, "its max_frequency does not fit its num_frequencies");
}

static pspec_status read_totals(reader *in, const header *head, ps_spectrum_sums *out) {
    double totals[PS_SPECTRUM_TOTALS];
    PS_TRY(read_doubles(in, totals, PS_SPECTRUM_TOTALS));
    out->normalization = (pspec_normalization)head->normalization;
    out->reference_points = totals[0];
    out->totals = (ps_pattern_totals){.num_realizations = head->realizations,
                                      .sum_points = totals[1],
                                      .sum_weights = totals[2],
                                      .smallest_points = (size_t)head->smallest_points,
                                      .largest_points = (size_t)head->largest_points};
    out->error = totals[3];
    const bool is_possible = totals[0] > 0 && isfinite(totals[0]) && totals[1] > 0 &&
                             isfinite(totals[1]) && isfinite(totals[2]) && totals[3] >= 0;
    PS_TRY(read_sums(in, &out->totals.sample_sizes, 1));
    return is_possible ? PSPEC_OK : fail(in, "its numbers of points are none");
}

static pspec_status check_sum(reader *in) {
    uint64_t stored = 0;
    const uint64_t found = in->checksum;
    PS_TRY(read_integer(in, sizeof(uint32_t), &stored));
    return stored == found ? PSPEC_OK : fail(in, "it is damaged, its checksum is wrong");
}

static pspec_status read_body(reader *in, const header *head, ps_frequencies *set,
                              ps_spectrum_sums *out, ps_bins *bins) {
    ps_spectrum_sums totals = {0};
    PS_TRY(read_totals(in, head, &totals));
    PS_TRY(is_list(head) ? read_list(in, head, set) : make_lattice(in, head, set));
    if (head->kind == PS_SPECTRUM_SAMPLE) {
        PS_TRY(read_rings(in, head, set));
    }
    PS_TRY(make_bins(in, head, set, bins));
    PS_TRY(ps_spectrum_sums_create(out, set, bins->num, in->error));
    out->normalization = totals.normalization;
    out->reference_points = totals.reference_points;
    out->totals = totals.totals;
    out->error = totals.error;
    PS_TRY(read_sums(in, out->bins, out->num_bins));
    PS_TRY(read_sums(in, out->powers, set->num));
    return check_sum(in);
}

static pspec_status open_reader(reader *in) {
    struct stat facts;
    if (stat(in->path, &facts) != 0) {
        return fail_system(in, errno);
    }
    if (!S_ISREG(facts.st_mode)) { /* asked before opening, which may wait at a pipe */
        return fail(in, "it is not an ordinary file");
    }
    in->rest = facts.st_size > 0 ? (uint64_t)facts.st_size : 0;
    in->stream = fopen(in->path, "rb");
    return in->stream != NULL ? PSPEC_OK : fail_system(in, errno);
}

pspec_status ps_spectrum_read(ps_spectrum_sums *out, ps_bins *bins, const char *path,
                              ps_error *error) {
    reader in = {.path = path, .checksum = crc32(0, NULL, 0), .error = error};
    header head = {0};
    ps_frequencies set = {0};
    pspec_status status = PSPEC_OK;
    *out = (ps_spectrum_sums){0};
    *bins = (ps_bins){0};
    PS_TRY_OUT(status, open_reader(&in));
    PS_TRY_OUT(status, read_header(&in, &head));
    PS_TRY_OUT(status, check_size(&in, &head));
    PS_TRY_OUT(status, read_body(&in, &head, &set, out, bins));
out:
    if (in.stream != NULL) {
        fclose(in.stream);
    }
    ps_frequencies_free(&set);
    if (status != PSPEC_OK) {
        ps_spectrum_sums_free(out);
        ps_bins_free(bins);
    }
    return status;
}
