#include "spectra/file/spectrum_head.h"

#include "base/status.h"
#include "frequencies/frequencies.h"
#include "frequencies/frequency_sample.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

enum { NUM_NORMALIZATIONS = sizeof ps_spectrum_normalizations / sizeof(char *) };
enum { LINE_BYTES = 128 }; /* header lines are short; a longer one is none of ours */

pspec_status ps_spectrum_fail(const ps_spectrum_reader *in, const char *what) {
    return ps_fail(in->error, PSPEC_ERROR_INPUT, "\"%s\" cannot be used as a spectrum: %s",
                   in->path, what);
}

pspec_status ps_spectrum_fail_system(const ps_spectrum_reader *in, int reason) {
    return ps_fail(in->error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", in->path,
                   reason != 0 ? strerror(reason) : "a read failed");
}

static pspec_status read_bytes(ps_spectrum_reader *in, void *bytes, size_t num_bytes) {
    if (num_bytes > in->rest) {
        return ps_spectrum_fail(in, "it is truncated");
    }
    errno = 0;
    if (fread(bytes, 1, num_bytes, in->stream) != num_bytes) {
        return ferror(in->stream) ? ps_spectrum_fail_system(in, errno)
                                  : ps_spectrum_fail(in, "it is truncated");
    }
    in->rest -= num_bytes;
    in->checksum = crc32(in->checksum, bytes, (uInt)num_bytes); /* blocks are small */
    return PSPEC_OK;
}

pspec_status ps_spectrum_read_integer(ps_spectrum_reader *in, size_t num_bytes, uint64_t *out) {
    unsigned char bytes[sizeof *out];
    PS_TRY(read_bytes(in, bytes, num_bytes));
    *out = 0;
    for (size_t i = 0; i < num_bytes; i++) {
        *out |= (uint64_t)bytes[i] << (8 * i);
    }
    return PSPEC_OK;
}

pspec_status ps_spectrum_read_doubles(ps_spectrum_reader *in, double *numbers, size_t num) {
    for (size_t i = 0; i < num; i++) {
        uint64_t bits = 0;
        PS_TRY(ps_spectrum_read_integer(in, sizeof bits, &bits));
        memcpy(&numbers[i], &bits, sizeof bits);
    }
    return PSPEC_OK;
}

pspec_status ps_spectrum_read_sums(ps_spectrum_reader *in, ps_sums *sums, size_t num) {
    for (size_t i = 0; i < num; i++) {
        double numbers[PS_SPECTRUM_SUMS];
        PS_TRY(ps_spectrum_read_doubles(in, numbers, PS_SPECTRUM_SUMS));
        sums[i] = (ps_sums){numbers[0], numbers[1], numbers[2], numbers[3]};
    }
    return PSPEC_OK;
}

/* ---- header ------------------------------------------------------------------------------ */

static pspec_status read_line(ps_spectrum_reader *in, char line[LINE_BYTES]) {
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
    return ps_spectrum_fail(in, "its header is not one");
}

/* The value of the next line, which must have this key. */
static pspec_status read_value(ps_spectrum_reader *in, const char *key, char line[LINE_BYTES],
                               const char **value) {
    char what[LINE_BYTES];
    const size_t length = strlen(key);
    PS_TRY(read_line(in, line));
    if (strncmp(line, key, length) != 0 || strncmp(line + length, ": ", 2) != 0) {
        snprintf(what, sizeof what, "its header lacks the line \"%s\"", key);
        return ps_spectrum_fail(in, what);
    }
    *value = line + length + 2;
    return PSPEC_OK;
}

static pspec_status read_count(ps_spectrum_reader *in, const char *key, uint64_t least,
                               uint64_t most, uint64_t *out) {
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
        return ps_spectrum_fail(in, what);
    }
    return PSPEC_OK;
}

static pspec_status read_word(ps_spectrum_reader *in, const char *key, const char *const *words,
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
    return ps_spectrum_fail(in, what);
}

static pspec_status read_bins(ps_spectrum_reader *in, ps_spectrum_head *out) {
    char line[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_value(in, "bins", line, &value));
    const bool is_rule = ps_spectrum_bins_parse(&out->bins, value, (unsigned)out->dimension);
    return is_rule ? PSPEC_OK : ps_spectrum_fail(in, "its bins are of an unknown kind");
}

static pspec_status read_magic(ps_spectrum_reader *in, ps_spectrum_head *out) {
    static const int versions[] = {PS_SPECTRUM_VERSION, PS_SPECTRUM_OLD_VERSION};
    char magic[sizeof PS_SPECTRUM_MAGIC] = {0};
    char line[LINE_BYTES];
    char expected[16];
    if (in->rest < sizeof magic) {
        return ps_spectrum_fail(in, "it is not a spectrum file of pointspec");
    }
    PS_TRY(read_bytes(in, magic, sizeof magic));
    if (memcmp(magic, PS_SPECTRUM_MAGIC " ", sizeof magic) != 0) {
        return ps_spectrum_fail(in, "it is not a spectrum file of pointspec");
    }
    PS_TRY(read_line(in, line));
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) {
        snprintf(expected, sizeof expected, "%d", versions[i]);
        if (strcmp(line, expected) == 0) {
            out->version = versions[i];
            return PSPEC_OK;
        }
    }
    return ps_spectrum_fail(in, "it has another version of the format than this program reads");
}

pspec_status ps_spectrum_read_head(ps_spectrum_reader *in, ps_spectrum_head *out) {
    char line[LINE_BYTES];
    const char *value = NULL;
    PS_TRY(read_magic(in, out));
    PS_TRY(read_value(in, "pointspec_version", line, &value));
    PS_TRY(read_count(in, "dimension", 1, PS_MAX_DIMENSION, &out->dimension));
    PS_TRY(read_word(in, "frequencies", ps_spectrum_kinds, PS_SPECTRUM_NUM_KINDS, &out->kind));
    if (out->kind == PS_SPECTRUM_SAMPLE) {
        PS_TRY(read_count(in, "per_ring", PS_MIN_PER_RING, PS_MAX_NUM_FREQUENCIES, &out->per_ring));
    }
    PS_TRY(read_count(in, "max_frequency", 0, PS_MAX_FREQUENCY, &out->max_frequency));
    PS_TRY(read_count(in, "num_frequencies", 1, UINT32_MAX, &out->num_frequencies));
    PS_TRY(read_bins(in, out));
    PS_TRY(read_count(in, "num_bins", 0, UINT32_MAX, &out->num_bins));
    PS_TRY(read_word(in, "normalization", ps_spectrum_normalizations, NUM_NORMALIZATIONS,
                     &out->normalization));
    PS_TRY(read_count(in, "realizations", 1, PS_SPECTRUM_MOST_REALIZATIONS, &out->realizations));
    PS_TRY(read_count(in, "smallest_points", 1, SIZE_MAX / 16, &out->smallest_points));
    PS_TRY(read_count(in, "largest_points", out->smallest_points, SIZE_MAX / 16,
                      &out->largest_points));
    PS_TRY(read_line(in, line));
    return line[0] == '\0' ? PSPEC_OK
                           : ps_spectrum_fail(in, "its header does not end where it should");
}
