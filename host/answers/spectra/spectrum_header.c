#include "answers/spectra/spectrum_header.h"

#include "answers/lead.h"
#include "files/decimal.h"
#include "samplers/morph_words.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

ps_cell ps_number_or_missing(double value) {
    return isnan(value) ? PS_MISSING : PS_NUMBER(value);
}

pspec_status ps_header_add_integrand(ps_table *table, const char *text,
                                     const ps_integrand *integrand, ps_error *error) {
    const char *const note = ps_integrand_note(integrand);
    const ps_meta entries[] = {{"integrand", PS_TEXT(text)},
                               {"integral", PS_NUMBER(ps_integrand_integral(integrand))}};
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "integrand_note", PS_TEXT(note), error)
                        : PSPEC_OK;
}

pspec_status ps_header_add_box(ps_table *table, const ps_box *box, ps_error *error) {
    char text[2 * PS_MAX_DIMENSION * PS_DECIMAL_BYTES];
    size_t length = 0;
    bool is_unit = true;
    for (unsigned i = 0; i < 2 * box->num_axes; i++) {
        const double end = i % 2 == 0 ? box->low[i / 2] : box->high[i / 2];
        if (i > 0) {
            text[length++] = ',';
        }
        length += ps_decimal_format(text + length, end);
        is_unit = is_unit && end == i % 2;
    }
    return is_unit ? PSPEC_OK : ps_table_add_meta(table, "box", PS_TEXT(text), error);
}

pspec_status ps_header_add_lift(ps_table *table, const ps_point_options *options, ps_error *error) {
    if (options->lift == PS_NO_LIFT) {
        return PSPEC_OK;
    }
    const bool on_hemisphere = options->lift == PS_LIFT_TO_HEMISPHERE;
    PS_TRY(ps_table_add_meta(table, PS_LIFT_KEY, PS_TEXT(on_hemisphere ? "hemisphere" : "sphere"),
                             error));
    return on_hemisphere ? ps_table_add_meta(table, PS_MORPH_KEY,
                                             PS_TEXT(ps_morph_write(&options->morph).text), error)
                         : PSPEC_OK;
}

pspec_status ps_header_add_points(ps_table *table, const ps_points_range *points, bool with_range,
                                  ps_error *error) {
    const bool varies = points->smallest < points->largest;
    const ps_meta entries[] = {
        {"points", varies ? PS_NUMBER(points->mean) : PS_INTEGER(points->largest)},
        {"points_smallest", PS_INTEGER(points->smallest)},
        {"points_largest", PS_INTEGER(points->largest)},
    };
    return ps_table_add_metas(table, entries, with_range ? sizeof entries / sizeof entries[0] : 1,
                              error);
}

static bool is_on_sphere(const ps_frequencies *set) {
    return set->kind == PS_FREQUENCIES_DEGREES;
}

pspec_status ps_header_add_files(ps_table *table, const char *const *paths, size_t num_paths,
                                 uint64_t num_realizations, const char *are_for, ps_error *error) {
    const bool are_runs = num_paths > 0 && ps_points_program(paths[0]) != NULL;
    /* a program that prints the same in every run is run no more */
    const uint64_t num = are_runs && num_realizations < num_paths ? num_realizations : num_paths;
    char text[128];
    snprintf(text, sizeof text, "%llu %s, %llu realization%s%s", (unsigned long long)num,
             are_runs ? "runs" : "files", (unsigned long long)num_realizations,
             num_realizations == 1 ? "" : "s", are_for);
    return num > 1 ? ps_table_add_meta(table, "input", PS_TEXT(text), error) : PSPEC_OK;
}

void ps_header_put(ps_header *head, const char *key, ps_cell value) {
    if (head->status == PSPEC_OK) {
        head->status = ps_table_add_meta(head->table, key, value, head->error);
    }
}

const char *const ps_told_keys[] = {
    "seed",      "homogenize",   "merged",        "sampler", "sampler_note",
    "input",     "input_format", "input_columns", "box",     "box_changes",
    "lift",      "morph",        "empty",         "device",  "engine",
    "precision", "tolerance",    "planned_twice", "skipped", NULL};

static size_t find_key(const char *key) {
    size_t i = 0;
    while (strcmp(ps_told_keys[i], key) != 0) {
        i++;
    }
    return i;
}

/* The entries of these keys, from the first to the last. */
static void put_told(ps_header *head, const ps_measured *self, const char *first,
                     const char *last) {
    const size_t end = find_key(last);
    for (size_t key = find_key(first); key <= end; key++) {
        for (size_t i = 0; i < ps_table_num_meta(self->told); i++) {
            const char *name = NULL;
            const ps_cell value = ps_table_meta(self->told, i, &name);
            if (strcmp(name, ps_told_keys[key]) == 0) {
                ps_header_put(head, name, value);
            }
        }
    }
}

/* What |S|^2 is called: on the sphere it is a sum over orders. */
static const char *name_normalization(const ps_request *arguments, const ps_measured *self) {
    const bool on_sphere = is_on_sphere(&self->spectrum->frequencies);
    if (self->are_pair_sums) {
        return "pairs: Q(l), weights 1/N unless given";
    }
    switch (arguments->normalization) {
    case PSPEC_NORMALIZATION_EFFECTIVE:
        return on_sphere ? "effective: Q(l) / sum w^2" : "effective: |S|^2 / sum w^2";
    case PSPEC_NORMALIZATION_INTEGRAL:
        return on_sphere ? "integral: mean(N) mean(Q(l) / (sum w)^2)"
                         : "integral: mean(N) mean(|S|^2 / (sum w)^2)";
    default:
        return on_sphere ? "power: N Q(l) / (sum w)^2, N of each set"
                         : "power: N |S|^2 / (sum w)^2, N of each set";
    }
}

static void put_common(ps_header *head, const ps_request *arguments, const ps_measured *first) {
    head->status = ps_lead_add_origin(head->table, arguments->command_line, head->error);
    ps_header_put(head, "normalization", PS_TEXT(name_normalization(arguments, first)));
    put_told(head, first, "seed", "merged");
}

/* Sets whose N differ by less are as good as of one N. */
static const double notable_ratio = 1.1;

/* Averages over sets of different N mix spectra, which change with N. */
static void put_different_points(ps_header *head, const ps_request *arguments,
                                 const ps_spectrum *spectrum) {
    if (!((double)spectrum->largest_points > notable_ratio * (double)spectrum->smallest_points)) {
        return;
    }
    ps_header_put(
        head, "different_points",
        PS_TEXT(arguments->normalization == PSPEC_NORMALIZATION_INTEGRAL
                    ? "every set counts by |S|^2 / W^2, as variances of integrals want it; white "
                      "noise is above 1"
                : arguments->normalization == PSPEC_NORMALIZATION_EFFECTIVE
                    ? "every set is divided by its own sum w^2; white noise is 1"
                    : "every set counts with its own N, so that white noise is 1; variances of "
                      "integrals want --normalize integral"));
}

/* A part of a job. */
static void put_range(ps_header *head, const ps_measured *self) {
    char text[96];
    snprintf(text, sizeof text, "%" PRIu64 ":%" PRIu64 " of %" PRIu64, self->range.first,
             self->range.end, self->num_all);
    if (self->range.end > 0) {
        ps_header_put(head, "range", PS_TEXT(text));
    }
}

static void put_points(ps_header *head, bool with_range, const ps_measured *self) {
    const ps_spectrum *const spectrum = self->spectrum;
    const ps_points_range range = {spectrum->mean_points, spectrum->smallest_points,
                                   spectrum->largest_points};
    head->status = head->status == PSPEC_OK
                       ? ps_header_add_points(head->table, &range, with_range, head->error)
                       : head->status;
    ps_header_put(head, "realizations", PS_INTEGER(spectrum->num_realizations));
    put_range(head, self);
    if (spectrum->num_realizations == 1) {
        ps_header_put(
            head, "standard_error",
            PS_TEXT(spectrum->frequencies.rings != NULL
                        ? "one realization: that of the choice of frequencies, none for complete "
                          "rings"
                        : "none: one realization"));
    } else if (!self->is_one_for_all && !is_on_sphere(&spectrum->frequencies)) {
        ps_header_put(head, "noise_level_db",
                      PS_NUMBER(-10 * log10((double)spectrum->num_realizations)));
    }
    ps_header_put(head, "weight_sum", PS_NUMBER(spectrum->mean_weight_sum));
}

/* Both signs, as in the table. */
static void put_subset(ps_header *head, const ps_request *arguments, const ps_frequencies *set) {
    char text[128];
    if (arguments->frequencies.per_ring == 0) {
        return;
    }
    ps_header_put(head, "per_ring", PS_INTEGER(arguments->frequencies.per_ring));
    snprintf(text, sizeof text, "%llu of %llu frequencies of the rings, both signs",
             2 * (unsigned long long)set->num,
             2 * (unsigned long long)ps_frequencies_population(set));
    ps_header_put(head, "computed", PS_TEXT(text));
}

/* What |k| is in a box that is no cube. */
static void put_rings(ps_header *head, const ps_frequencies *set) {
    char text[160];
    if (set->reach == 0) {
        return;
    }
    snprintf(text, sizeof text,
             "of |k| in cycles per edge of the cube of the same volume V: k_i V^(1/%u) / L_i, with "
             "|k_i| up to %d",
             set->dimension, (int)set->max_frequency);
    ps_header_put(head, "rings", PS_TEXT(text));
}

static void put_frequencies(ps_header *head, const ps_request *arguments,
                            const ps_frequencies *set) {
    if (is_on_sphere(set)) {
        ps_header_put(head, "domain",
                      PS_TEXT(set->degree_step > 1 ? "hemisphere, even degrees" : "sphere"));
        ps_header_put(head, "max_degree", PS_INTEGER(set->max_frequency));
        return;
    }
    ps_header_put(head, "dimension", PS_INTEGER(set->dimension));
    ps_header_put(head, "max_frequency", PS_INTEGER(ps_frequencies_reach(set)));
    put_rings(head, set);
    if (arguments->frequencies.path == NULL && set->bins.kind != PS_BINS_ROUND) {
        ps_header_put(head, "bins", PS_TEXT(ps_bin_rule_write(&set->bins).text));
    }
    put_subset(head, arguments, set);
}

static void put_self_check(ps_header *head, const ps_measured *self) {
    const bool on_sphere = is_on_sphere(&self->spectrum->frequencies);
    char text[96];
    if (isnan(self->self_check)) {
        ps_header_put(head, "self_check", PS_TEXT("none"));
        return;
    }
    if (self->are_pair_sums) {
        snprintf(text, sizeof text, "%.2g (sum |w|)^2, largest deviation of Q(l) from host_direct",
                 self->self_check);
    } else {
        snprintf(text, sizeof text, "%.2g sqrt(sum w^2), largest deviation of %s from host_direct",
                 self->self_check, on_sphere ? "sqrt(Q(l))" : "|S|");
    }
    ps_header_put(head, "self_check", PS_TEXT(text));
}

/* Rounding of coordinates in double precision is not worth a line. */
static void put_lengths(ps_header *head, const ps_measured *self) {
    const double rounding = 1e-15;
    char text[96];
    if (self->length_error > rounding) {
        snprintf(text, sizeof text, "divided by their lengths, which differ from 1 by up to %.2g",
                 self->length_error);
        ps_header_put(head, "vectors", PS_TEXT(text));
    }
}

static void put_look(ps_header *head, const ps_request *arguments, const ps_measured *self) {
    const ps_sequential_look *look = self->look;
    char text[160];
    if (look == NULL) {
        return;
    }
    snprintf(text, sizeof text, "%.3g, %s; largest %.3g, of %s %lld, %.3g with the correction",
             arguments->accuracy.standard_error,
             look->corrected <= arguments->accuracy.standard_error ? "reached" : "not reached",
             look->relative_error, is_on_sphere(&self->spectrum->frequencies) ? "degree" : "bin",
             (long long)look->bin, look->corrected);
    ps_header_put(head, "relative_standard_error", PS_TEXT(text));
}

static bool have_ranges(const ps_measured *all, size_t num) {
    size_t i = 0;
    while (i < num && all[i].spectrum->smallest_points == all[i].spectrum->largest_points) {
        i++;
    }
    return i < num;
}

static void put_question(ps_header *head, const ps_request *arguments, const ps_measured *self,
                         bool with_range) {
    put_told(head, self, "sampler", "morph");
    put_points(head, with_range, self);
    if (!self->are_pair_sums) {
        put_different_points(head, arguments, self->spectrum);
    }
    put_look(head, arguments, self);
    put_told(head, self, "empty", "empty");
    put_lengths(head, self);
    put_frequencies(head, arguments, &self->spectrum->frequencies);
    put_told(head, self, "device", "tolerance");
    ps_header_put(head, "predicted_error", PS_NUMBER(self->error));
    put_told(head, self, "planned_twice", "planned_twice");
    put_self_check(head, self);
    put_told(head, self, "skipped", "skipped");
}

pspec_status ps_header_begin(ps_table *table, const ps_request *arguments, const ps_measured *first,
                             ps_error *error) {
    ps_header head = {table, error, PSPEC_OK};
    put_common(&head, arguments, first);
    return head.status;
}

pspec_status ps_header_add(ps_table *table, const ps_request *arguments, const ps_measured *all,
                           size_t num, size_t index, ps_error *error) {
    ps_header head = {table, error, PSPEC_OK};
    put_question(&head, arguments, &all[index], have_ranges(all, num));
    return head.status;
}
