#include "cli/power_table.h"

#include "pointspec_version.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ps_cell number_or_missing(double value) {
    return isnan(value) ? PS_MISSING : PS_NUMBER(value);
}

/* ---- header ------------------------------------------------------------------------------ */

typedef struct header {
    ps_table *table;
    ps_error *error;
    pspec_status status; /* the first failure; later entries do nothing */
} header;

static void put(header *to, const char *key, ps_cell value) {
    if (to->status == PSPEC_OK) {
        to->status = ps_table_add_meta(to->table, key, value, to->error);
    }
}

static void put_common(header *to, const ps_arguments *arguments) {
    put(to, "pointspec_version", PS_TEXT(PS_VERSION));
    put(to, "schema", PS_INTEGER(1));
    put(to, "command", PS_TEXT(arguments->command_line));
    put(to, "normalization",
        PS_TEXT(arguments->effective ? "effective: |S|^2 / sum w^2"
                                     : "power: N |S|^2 / (sum w)^2"));
    if (arguments->num_samplers > 0 || arguments->per_ring > 0) {
        put(to, "seed", PS_INTEGER(arguments->seed));
    }
    if (arguments->num_samplers > 0) {
        put(to, "homogenize", PS_TEXT(arguments->homogenize ? "yes" : "no"));
    }
}

static void put_points(header *to, const ps_spectrum *spectrum, const ps_needs *needs) {
    char range[96];
    if (spectrum->smallest_points == spectrum->largest_points) {
        put(to, "points", PS_INTEGER(spectrum->largest_points));
    } else {
        snprintf(range, sizeof range, "mean %.17g, from %zu to %zu", spectrum->mean_points,
                 spectrum->smallest_points, spectrum->largest_points);
        put(to, "points", PS_TEXT(range));
    }
    put(to, "realizations", PS_INTEGER(spectrum->num_realizations));
    if (spectrum->num_realizations == 1) {
        put(to, "standard_error",
            PS_TEXT(spectrum->frequencies.rings != NULL
                        ? "one realization: that of the choice of frequencies, none for complete "
                          "rings"
                        : "none: one realization"));
    } else if (!needs->one_realization) {
        put(to, "noise_level_db", PS_NUMBER(-10 * log10((double)spectrum->num_realizations)));
    }
    put(to, "weight_sum", PS_NUMBER(spectrum->mean_weight_sum));
}

/* Both signs, as in the table. */
static void put_subset(header *to, const ps_arguments *arguments, const ps_frequencies *set) {
    char text[128];
    if (arguments->per_ring == 0) {
        return;
    }
    put(to, "per_ring", PS_INTEGER(arguments->per_ring));
    snprintf(text, sizeof text, "%llu of %llu frequencies of the rings, both signs",
             2 * (unsigned long long)set->num,
             2 * (unsigned long long)ps_frequencies_population(set));
    put(to, "computed", PS_TEXT(text));
}

static void put_self_check(header *to, const ps_accuracy *accuracy) {
    char text[96];
    if (accuracy->was_checked) {
        snprintf(text, sizeof text, "%.2g sqrt(sum w^2), largest deviation of |S| from host_direct",
                 accuracy->self_check);
        put(to, "self_check", PS_TEXT(text));
    } else {
        put(to, "self_check", PS_TEXT("none"));
    }
}

static void put_job(header *to, const ps_arguments *arguments, const ps_power_job *job,
                    size_t index) {
    const ps_device_limits *limits = ps_power_job_limits(job);
    const ps_candidate *chosen = ps_power_job_plan(job)->chosen;
    ps_text skipped = {0};
    if (arguments->num_samplers > 0) {
        const char *note = ps_sampler_note(ps_power_job_sampler(job));
        put(to, "sampler", PS_TEXT(arguments->samplers[index]));
        if (note != NULL) {
            put(to, "sampler_note", PS_TEXT(note));
        }
    } else {
        put(to, "input_format", PS_TEXT(ps_power_job_source_format(job)));
        put(to, "input_columns", PS_TEXT(ps_power_job_source_columns(job)));
    }
    put_points(to, ps_power_job_spectrum(job), ps_power_job_needs(job));
    put(to, "dimension", PS_INTEGER(ps_power_job_problem(job)->frequencies->dimension));
    put(to, "max_frequency", PS_INTEGER(ps_power_job_problem(job)->frequencies->max_frequency));
    put_subset(to, arguments, ps_power_job_problem(job)->frequencies);
    put(to, "device",
        PS_TEXT(limits != NULL && chosen->engine->needs_device ? limits->name : "host"));
    put(to, "engine", PS_TEXT(ps_power_job_description(job)));
    put(to, "precision", PS_TEXT(ps_precision_name(chosen->precision)));
    put(to, "tolerance", PS_NUMBER(ps_power_job_problem(job)->tolerance));
    put(to, "predicted_error", PS_NUMBER(ps_power_job_accuracy(job)->error));
    if (ps_power_job_was_replanned(job)) {
        put(to, "planned_twice", PS_TEXT("the powers measured needed a more exact engine"));
    }
    put_self_check(to, ps_power_job_accuracy(job));
    ps_needs_describe(ps_power_job_needs(job), &skipped);
    if (to->status == PSPEC_OK) {
        to->status = ps_text_check(&skipped, to->error);
    }
    put(to, "skipped", PS_TEXT(ps_text_string(&skipped)));
    ps_text_free(&skipped);
}

/* ---- rows -------------------------------------------------------------------------------- */

enum { MOST_COLUMNS = PS_MAX_DIMENSION + 8 };

static const char *const bin_columns[] = {"bin",          "frequency", "normalized_frequency",
                                          "count",        "power",     "standard_error",
                                          "anisotropy_db"};
static const char *const axis_columns[] = {"k1", "k2", "k3", "k4", "k5", "k6"};

static pspec_status add_bins(ps_table *table, const ps_spectrum *spectrum, const char *sampler,
                             ps_error *error) {
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        const ps_cell cells[] = {
            PS_TEXT(sampler),
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->frequency),
            PS_NUMBER(bin->normalized_frequency),
            PS_INTEGER(bin->count),
            PS_NUMBER(bin->power),
            number_or_missing(bin->standard_error),
            number_or_missing(bin->anisotropy_db),
        };
        PS_TRY(ps_table_add_row(table, sampler != NULL ? cells : cells + 1, error));
    }
    return PSPEC_OK;
}

static pspec_status add_frequencies(ps_table *table, const ps_spectrum *spectrum,
                                    const char *sampler, ps_error *error) {
    const unsigned dimension = spectrum->frequencies.dimension;
    for (size_t i = 0; i < spectrum->frequencies.num; i++) {
        ps_cell cells[MOST_COLUMNS];
        size_t num = 0;
        if (sampler != NULL) {
            cells[num++] = PS_TEXT(sampler);
        }
        for (unsigned axis = 0; axis < dimension; axis++) {
            cells[num++] = PS_INTEGER(spectrum->frequencies.vectors[i * dimension + axis]);
        }
        cells[num++] = PS_NUMBER(spectrum->powers[i].mean);
        cells[num++] = number_or_missing(spectrum->powers[i].standard_error);
        PS_TRY(ps_table_add_row(table, cells, error));
    }
    return PSPEC_OK;
}

static size_t choose_columns(const char **columns, const ps_arguments *arguments,
                             unsigned dimension) {
    size_t num = 0;
    if (arguments->num_samplers > 1) {
        columns[num++] = "sampler";
    }
    if (arguments->frequencies != NULL) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            columns[num++] = axis_columns[axis];
        }
        columns[num++] = "power";
        columns[num++] = "standard_error";
        return num;
    }
    for (size_t i = 0; i < sizeof bin_columns / sizeof bin_columns[0]; i++) {
        columns[num++] = bin_columns[i];
    }
    return num;
}

static pspec_status fill(ps_table *table, const ps_arguments *arguments,
                         const ps_power_job *const *jobs, size_t num, ps_error *error) {
    header to = {table, error, PSPEC_OK};
    put_common(&to, arguments);
    for (size_t i = 0; i < num; i++) {
        const char *sampler = arguments->num_samplers > 1 ? arguments->samplers[i] : NULL;
        const ps_spectrum *spectrum = ps_power_job_spectrum(jobs[i]);
        put_job(&to, arguments, jobs[i], i);
        PS_TRY(to.status);
        PS_TRY(arguments->frequencies != NULL ? add_frequencies(table, spectrum, sampler, error)
                                              : add_bins(table, spectrum, sampler, error));
    }
    return PSPEC_OK;
}

pspec_status ps_power_table(ps_table **out, const ps_arguments *arguments,
                            const ps_power_job *const *jobs, size_t num, ps_error *error) {
    const char *columns[MOST_COLUMNS];
    const unsigned dimension = ps_power_job_problem(jobs[0])->frequencies->dimension;
    const size_t num_columns = choose_columns(columns, arguments, dimension);
    PS_TRY(ps_table_create(out, "power", columns, num_columns, error));
    const pspec_status status = fill(*out, arguments, jobs, num, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(*out);
        *out = NULL;
    }
    return status;
}
