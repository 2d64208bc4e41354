#include "base/memory.h"
#include "spectra/file/spectrum_file.h"
#include "spectra/file/spectrum_head.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>

static bool is_list(const ps_spectrum_head *head) {
    return head->kind == PS_SPECTRUM_LIST || head->kind == PS_SPECTRUM_SAMPLE;
}

/* Everything after the header has a size that follows from it: nothing is allocated that the file
 * does not have. The numbers are below 2^32, so no product overflows. */
static pspec_status check_size(const ps_spectrum_reader *in, const ps_spectrum_head *head) {
    const uint64_t sum_bytes = PS_SPECTRUM_SUMS * sizeof(double);
    const uint64_t list_bytes =
        is_list(head) ? head->num_frequencies * head->dimension * sizeof(int32_t) : 0;
    const uint64_t ring_bytes =
        head->kind == PS_SPECTRUM_SAMPLE ? head->num_bins * 2 * sizeof(uint64_t) : 0;
    const uint64_t total_bytes = head->version == PS_SPECTRUM_OLD_VERSION
                                     ? PS_SPECTRUM_OLD_TOTALS * sizeof(double)
                                     : PS_SPECTRUM_TOTALS * sizeof(double) + sum_bytes;
    const uint64_t expected = total_bytes + list_bytes + ring_bytes +
                              sum_bytes * (1 + head->num_bins + head->num_frequencies) +
                              sizeof(uint32_t);
    if (in->rest != expected) {
        return ps_spectrum_fail(in, in->rest < expected ? "it is truncated"
                                                        : "there is more in it than its "
                                                          "header says");
    }
    return PSPEC_OK;
}

/* ---- arrays ------------------------------------------------------------------------------ */

static pspec_status read_list(ps_spectrum_reader *in, const ps_spectrum_head *head,
                              ps_frequencies *out) {
    const size_t num = (size_t)head->num_frequencies * (size_t)head->dimension;
    int32_t *vectors = NULL;
    PS_TRY(PS_NEW(&vectors, num, "frequencies", in->error));
    *out = (ps_frequencies){.kind = PS_FREQUENCIES_LIST, .vectors = vectors}; /* to be freed */
    for (size_t i = 0; i < num; i++) {
        uint64_t bits = 0;
        PS_TRY(ps_spectrum_read_integer(in, sizeof(int32_t), &bits));
        const int64_t value = (int64_t)bits - (bits > INT32_MAX ? (int64_t)1 << 32 : 0);
        if (llabs((long long)value) > PS_MAX_FREQUENCY) {
            return ps_spectrum_fail(in, "a frequency in it is too large");
        }
        vectors[i] = (int32_t)value;
    }
    return ps_frequencies_list(out, (unsigned)head->dimension, (size_t)head->num_frequencies,
                               vectors, in->error);
}

/* What a list was drawn from. */
static pspec_status read_rings(ps_spectrum_reader *in, const ps_spectrum_head *head,
                               ps_frequencies *set) {
    uint64_t sum = 0;
    PS_TRY(PS_NEW(&set->rings, head->num_bins, "rings", in->error));
    set->num_rings = (size_t)head->num_bins;
    set->per_ring = head->per_ring;
    if (set->max_frequency > (int64_t)head->max_frequency) {
        return ps_spectrum_fail(in, "its frequencies are beyond its max_frequency");
    }
    set->max_frequency = (int32_t)head->max_frequency;
    if (ps_frequencies_set_bins(set, &head->bins, NULL) != PSPEC_OK) {
        return ps_spectrum_fail(in, "its bins do not fit its max_frequency");
    }
    for (size_t i = 0; i < set->num_rings; i++) {
        ps_sampled_ring *const ring = &set->rings[i];
        PS_TRY(ps_spectrum_read_integer(in, sizeof ring->num_frequencies, &ring->num_frequencies));
        PS_TRY(ps_spectrum_read_doubles(in, &ring->mean_frequency, 1));
        if (ring->num_frequencies > UINT64_MAX / 2 - sum || !(ring->mean_frequency > 0)) {
            return ps_spectrum_fail(in, "its rings are none");
        }
        sum += ring->num_frequencies;
    }
    return PSPEC_OK;
}

/* Every ring has as many of its frequencies in the list as were to be drawn. */
static pspec_status make_bins(const ps_spectrum_reader *in, const ps_spectrum_head *head,
                              const ps_frequencies *set, ps_bins *bins) {
    ps_error inner = {0};
    const pspec_status status = ps_bins_create(bins, set, &inner);
    if (status == PSPEC_ERROR_MEMORY) {
        return ps_fail(in->error, status, "%s", inner.message);
    }
    if (status != PSPEC_OK || bins->num != head->num_bins) {
        return ps_spectrum_fail(in, "its num_bins does not fit its frequencies");
    }
    for (size_t b = 0; set->rings != NULL && b < bins->num; b++) {
        const uint64_t size = bins->bins[b].num_frequencies;
        const uint64_t num = bins->bins[b].end - bins->bins[b].begin;
        if (num != (size < set->per_ring ? size : set->per_ring) ||
            bins->bins[b].key == INT64_MAX) {
            return ps_spectrum_fail(in, "its rings do not fit its frequencies");
        }
    }
    return PSPEC_OK;
}

/* The number of a ball is known only approximately before it is enumerated: what is off by more
 * than this factor is not tried, however large the box around it. */
static pspec_status make_grid(const ps_spectrum_head *head, ps_frequencies *out) {
    return ps_frequencies_grid(out, (unsigned)head->dimension, (int32_t)head->max_frequency,
                               head->kind == PS_SPECTRUM_BALL, &head->bins, 0, NULL);
}

static pspec_status make_degrees(const ps_spectrum_head *head, ps_frequencies *out) {
    PS_TRY(ps_frequencies_degrees(out, (int64_t)head->max_frequency,
                                  head->kind == PS_SPECTRUM_EVEN_DEGREES, NULL));
    return out->dimension == head->dimension && out->max_frequency == (int64_t)head->max_frequency
               ? PSPEC_OK
               : PSPEC_ERROR_INPUT;
}

static pspec_status make_lattice(const ps_spectrum_reader *in, const ps_spectrum_head *head,
                                 ps_frequencies *out) {
    const double factor = 4;
    const bool are_degrees =
        head->kind == PS_SPECTRUM_DEGREES || head->kind == PS_SPECTRUM_EVEN_DEGREES;
    const double num = (double)head->num_frequencies;
    if ((are_degrees ? make_degrees(head, out) : make_grid(head, out)) != PSPEC_OK ||
        (double)out->num > factor * num) {
        return ps_spectrum_fail(in, "its max_frequency does not fit its num_frequencies");
    }
    PS_TRY(ps_frequencies_enumerate(out, in->error));
    return out->num == head->num_frequencies
               ? PSPEC_OK
               : ps_spectrum_fail(in, "its max_frequency does not fit its num_frequencies");
}

static bool has_one_size(const ps_spectrum_head *head) {
    return head->smallest_points == head->largest_points;
}

/* The sum of squares is known only where all N are one. */
static pspec_status read_old_totals(ps_spectrum_reader *in, const ps_spectrum_head *head,
                                    ps_spectrum_sums *out) {
    double totals[PS_SPECTRUM_OLD_TOTALS];
    PS_TRY(ps_spectrum_read_doubles(in, totals, PS_SPECTRUM_OLD_TOTALS));
    out->reference_points = totals[0];
    if (has_one_size(head)) {
        const double num = (double)head->realizations;
        const ps_sums ones = {.sum = num, .square = num};
        ps_sums_merge(&out->totals.points, &ones, (double)head->largest_points);
    } else {
        out->totals.points = PS_SUMS_MEAN_ONLY;
        out->totals.points.sum = totals[1];
    }
    out->totals.sum_weights = totals[2];
    out->error = totals[3];
    return PSPEC_OK;
}

static pspec_status read_totals(ps_spectrum_reader *in, ps_spectrum_sums *out) {
    double totals[PS_SPECTRUM_TOTALS];
    PS_TRY(ps_spectrum_read_doubles(in, totals, PS_SPECTRUM_TOTALS));
    out->reference_points = totals[0];
    out->totals.sum_weights = totals[1];
    out->error = totals[2];
    return ps_spectrum_read_sums(in, &out->totals.points, 1);
}

static pspec_status read_any_totals(ps_spectrum_reader *in, const ps_spectrum_head *head,
                                    ps_spectrum_sums *out) {
    const ps_pattern_totals *const totals = &out->totals;
    out->normalization = (pspec_normalization)head->normalization;
    PS_TRY(head->version == PS_SPECTRUM_OLD_VERSION ? read_old_totals(in, head, out)
                                                    : read_totals(in, out));
    out->totals.num_realizations = head->realizations;
    out->totals.smallest_points = (size_t)head->smallest_points;
    out->totals.largest_points = (size_t)head->largest_points;
    PS_TRY(ps_spectrum_read_sums(in, &out->totals.sample_sizes, 1));
    const bool is_possible = out->reference_points > 0 && isfinite(out->reference_points) &&
                             totals->points.sum > 0 && isfinite(totals->points.sum) &&
                             isfinite(totals->sum_weights) && out->error >= 0;
    return is_possible ? PSPEC_OK : ps_spectrum_fail(in, "its numbers of points are none");
}

static pspec_status check_sum(ps_spectrum_reader *in) {
    uint64_t stored = 0;
    const uint64_t found = in->checksum;
    PS_TRY(ps_spectrum_read_integer(in, sizeof(uint32_t), &stored));
    return stored == found ? PSPEC_OK
                           : ps_spectrum_fail(in, "it is damaged, its checksum is wrong");
}

static void rescale(ps_sums *sums, size_t num, double factor) {
    for (size_t i = 0; i < num; i++) {
        ps_sums scaled = {0};
        ps_sums_merge(&scaled, &sums[i], factor);
        sums[i] = scaled;
    }
}

/* N_ref |S|^2 / W^2 of version 2 are the powers of today where all sets have one N, else those of
 * integrals. */
static void take_old_powers(ps_spectrum_sums *out, const ps_spectrum_head *head) {
    if (out->normalization != PSPEC_NORMALIZATION_POWER) {
        return;
    }
    if (!has_one_size(head)) {
        out->normalization = PSPEC_NORMALIZATION_INTEGRAL;
        return;
    }
    const double factor = (double)head->largest_points / out->reference_points;
    if (factor != 1) {
        rescale(out->bins, out->num_bins, factor);
        rescale(out->powers, out->frequencies.num, factor);
    }
    out->reference_points = 1;
}

static pspec_status read_body(ps_spectrum_reader *in, const ps_spectrum_head *head,
                              ps_frequencies *set, ps_spectrum_sums *out, ps_bins *bins) {
    ps_spectrum_sums totals = {0};
    PS_TRY(read_any_totals(in, head, &totals));
    PS_TRY(is_list(head) ? read_list(in, head, set) : make_lattice(in, head, set));
    if (head->kind == PS_SPECTRUM_SAMPLE) {
        PS_TRY(read_rings(in, head, set));
    }
    PS_TRY(make_bins(in, head, set, bins));
    PS_TRY(ps_spectrum_sums_create(out, set, bins->num, true, false, NULL, in->error));
    out->normalization = totals.normalization;
    out->reference_points = totals.reference_points;
    out->totals = totals.totals;
    out->error = totals.error;
    PS_TRY(ps_spectrum_read_sums(in, out->bins, out->num_bins));
    PS_TRY(ps_spectrum_read_sums(in, out->powers, set->num));
    if (head->version == PS_SPECTRUM_OLD_VERSION) {
        take_old_powers(out, head);
    }
    return check_sum(in);
}

static pspec_status open_reader(ps_spectrum_reader *in) {
    struct stat facts;
    if (stat(in->path, &facts) != 0) {
        return ps_spectrum_fail_system(in, errno);
    }
    if (!S_ISREG(facts.st_mode)) { /* asked before opening, which may wait at a pipe */
        return ps_spectrum_fail(in, "it is not an ordinary file");
    }
    in->rest = facts.st_size > 0 ? (uint64_t)facts.st_size : 0;
    in->stream = fopen(in->path, "rb");
    return in->stream != NULL ? PSPEC_OK : ps_spectrum_fail_system(in, errno);
}

pspec_status ps_spectrum_read(ps_spectrum_sums *out, ps_bins *bins, const char *path,
                              ps_error *error) {
    ps_spectrum_reader in = {.path = path, .checksum = crc32(0, NULL, 0), .error = error};
    ps_spectrum_head head = {0};
    ps_frequencies set = {0};
    pspec_status status = PSPEC_OK;
    *out = (ps_spectrum_sums){0};
    *bins = (ps_bins){0};
    PS_TRY_OUT(status, open_reader(&in));
    PS_TRY_OUT(status, ps_spectrum_read_head(&in, &head));
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
