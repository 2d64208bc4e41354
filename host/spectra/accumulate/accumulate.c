#include "spectra/accumulate/accumulate_private.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* of: weighted sums or bins */
static pspec_status allocate_powers(const ps_accumulator *self, double **powers, size_t num,
                                    const char *of, ps_error *error) {
    size_t num_powers = 0;
    if (!ps_size_multiply(self->options.batch, num, &num_powers)) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "%zu realizations of %zu %s are too many",
                       self->options.batch, num, of);
    }
    return PS_NEW(powers, num_powers, "powers of bins", error);
}

/* Single frequencies need no squares where only means are wanted, or no errors of theirs. */
static bool no_squares(const ps_accumulator_options *options) {
    return options->mean_only || options->no_frequency_errors;
}

static pspec_status create_sums(const ps_accumulator *self, ps_running_sums *sums, size_t num,
                                ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    return ps_running_sums_create(sums, num, options->expected, options->mean_only, error);
}

static pspec_status allocate(ps_accumulator *self, ps_error *error) {
    const ps_accumulator_options *options = &self->options;
    PS_TRY(PS_NEW(&self->slots, options->num_frequencies, "slots", error));
    memcpy(self->slots, options->slots, options->num_frequencies * sizeof(uint32_t));
    PS_TRY(allocate_powers(self, &self->bin_powers, self->formed->num, "bins", error));
    PS_TRY(allocate_powers(self, &self->weighted_powers, options->num_weighted, "weighted sums",
                           error));
    PS_TRY(PS_NEW(&self->weighted_blocks, options->num_weighted, "weighted sums", error));
    PS_TRY(PS_NEW(&self->units, options->batch, "units of powers", error));
    PS_TRY(create_sums(self, &self->weighted_sums, options->num_weighted, error));
    PS_TRY(create_sums(self, &self->bin_sums,
                       self->formed == options->bins ? options->bins->num : 0, error));
    self->frequency_sums.mean_only = no_squares(options);
    return options->want_frequencies && !options->is_on_device
               ? ps_running_sums_create(&self->frequency_sums, options->num_frequencies,
                                        options->expected, no_squares(options), error)
               : PSPEC_OK;
}

/* None is empty (spectra/bins.h). */
static bool has_single_members(const ps_bins *bins) {
    return bins->num == bins->num_members;
}

/* Powers of tens of thousands of bins for each realization would cost as much as their transform (d
 * = 1, K = 32768: 0.2 ms of 0.7, docs/developer/performance.md). What is still asked of a
 * realization is its mean. */
static void form_one_bin(ps_accumulator *self) {
    const ps_bins *bins = self->options.bins;
    self->all = (ps_bin){.end = bins->num_members};
    self->one = (ps_bins){.num = bins->num_members > 0 ? 1 : 0,
                          .bins = &self->all,
                          .members = bins->members,
                          .num_members = bins->num_members};
    self->formed = &self->one;
    self->options.want_frequencies = true;
    self->options.no_frequency_errors = false; /* those of bins are theirs */
}

static pspec_status create_on_device(ps_accumulator *self, ps_device *device, ps_error *error) {
    ps_accumulator_options on_device = self->options;
    on_device.bins = self->formed;
    on_device.mean_only = no_squares(&self->options);
    PS_TRY(ps_device_accumulator_create(&self->on_device, &on_device, device, error));
    return self->options.num_weighted > 0
               ? ps_device_weighted_create(&self->weighted, &on_device, device, error)
               : PSPEC_OK;
}

pspec_status ps_accumulator_create(ps_accumulator **out, const ps_accumulator_options *options,
                                   ps_device *device, ps_error *error) {
    *out = NULL;
    ps_accumulator *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "an accumulator", error));
    self->options = *options;
    self->formed = options->bins;
    if (options->is_on_device && !options->forms_bins && has_single_members(options->bins)) {
        form_one_bin(self);
    }
    pspec_status status = allocate(self, error);
    self->options.slots = self->slots;
    if (status == PSPEC_OK && options->is_on_device) {
        status = create_on_device(self, device, error);
    }
    if (status != PSPEC_OK) {
        ps_accumulator_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_accumulator_destroy(ps_accumulator *accumulator) {
    if (accumulator == NULL) {
        return;
    }
    ps_device_accumulator_destroy(accumulator->on_device);
    ps_device_weighted_destroy(accumulator->weighted);
    free(accumulator->slots);
    free(accumulator->bin_powers);
    free(accumulator->units);
    ps_running_sums_free(&accumulator->bin_sums);
    ps_running_sums_free(&accumulator->frequency_sums);
    ps_running_sums_free(&accumulator->weighted_sums);
    free(accumulator->weighted_powers);
    free(accumulator->weighted_blocks);
    free(accumulator);
}

/* Means over bins of one host row. */
static void average_bins(const ps_accumulator *self, const double *row, double *bin_powers) {
    const ps_bins *bins = self->options.bins;
    for (size_t b = 0; b < bins->num; b++) {
        long double sum = 0;
        for (size_t i = bins->bins[b].begin; i < bins->bins[b].end; i++) {
            sum += row[self->slots[bins->members[i]]];
        }
        bin_powers[b] = (double)(sum / (long double)(bins->bins[b].end - bins->bins[b].begin));
    }
}

/* Weighted sums of one host row. */
static void weigh(const ps_accumulator *self, const double *row, double *weighted_powers) {
    const size_t num = self->options.num_frequencies;
    for (size_t w = 0; w < self->options.num_weighted; w++) {
        const double *weights = self->options.weights + w * num;
        long double sum = 0;
        for (size_t i = 0; i < num; i++) {
            sum += weights[i] != 0 ? (long double)weights[i] * row[self->slots[i]] : 0;
        }
        weighted_powers[w] = (double)sum;
    }
}

static void add_host_rows(ps_accumulator *self, const ps_rows *rows) {
    for (size_t r = 0; r < rows->num_rows; r++) {
        const double *row = rows->host + r * rows->stride;
        average_bins(self, row, self->bin_powers + r * self->options.bins->num);
        weigh(self, row, self->weighted_powers + r * self->options.num_weighted);
        ps_running_sums_add(&self->frequency_sums, row, self->slots);
    }
}

static double mean_power(const ps_bins *bins, const double *bin_powers) {
    double sum = 0;
    double num_modes = 0;
    for (size_t b = 0; b < bins->num; b++) {
        const double num = (double)ps_bin_num_computed(&bins->bins[b]);
        sum += bin_powers[b] * num;
        num_modes += num;
    }
    return num_modes > 0 ? sum / num_modes : 0;
}

static void add_one(ps_accumulator *self, const double *bins, const double *weighted, double unit) {
    const double power = mean_power(self->formed, bins) / unit;
    if (power > self->largest || isnan(power)) {
        self->largest = power; /* and nan stays: nothing is above it */
    }
    ps_running_sums_add(&self->bin_sums, bins, NULL);
    for (size_t w = 0; w < self->options.num_weighted; w++) {
        ps_block_sums_add(&self->weighted_blocks[w], weighted[w]);
    }
    ps_running_sums_add(&self->weighted_sums, weighted, NULL);
}

/* What realizations of a batch come to, of which powers are there. */
static void add_all(ps_accumulator *self, size_t num_rows) {
    const ps_accumulator_observer *const observer = &self->options.observer;
    for (size_t r = 0; r < num_rows; r++) {
        const double *const bins = self->bin_powers + r * self->formed->num;
        const double *const weighted = self->weighted_powers + r * self->options.num_weighted;
        if (observer->tell != NULL) {
            observer->tell(observer->payload, bins, weighted);
        } else {
            add_one(self, bins, weighted, self->units[r]);
        }
    }
}

pspec_status ps_accumulator_reserve(ps_accumulator *accumulator, uint64_t count, ps_error *error) {
    PS_TRY(ps_running_sums_reserve(&accumulator->bin_sums, count, error));
    PS_TRY(ps_running_sums_reserve(&accumulator->frequency_sums, count, error));
    return ps_running_sums_reserve(&accumulator->weighted_sums, count, error);
}

/* Weighted sums first: those of frequencies change by what comes last. */
static pspec_status begin(ps_accumulator *self, const ps_rows *rows, ps_error *error) {
    if (self->weighted != NULL) {
        PS_TRY(ps_device_weighted_add(self->weighted, rows, error));
    }
    return ps_device_accumulator_add(self->on_device, rows, error);
}

static void forget(ps_accumulator *self) {
    if (self->on_device != NULL) {
        ps_device_accumulator_forget(self->on_device);
    }
    if (self->weighted != NULL) {
        ps_device_weighted_forget(self->weighted);
    }
    self->num_pending = 0;
}

/* What the batch that is pending comes to. */
static pspec_status take_pending(ps_accumulator *self, size_t num_rows, ps_error *error) {
    PS_TRY(ps_device_accumulator_take(self->on_device, num_rows, self->bin_powers, error));
    if (self->weighted != NULL) {
        PS_TRY(ps_device_weighted_take(self->weighted, num_rows, self->weighted_powers, error));
    }
    add_all(self, num_rows);
    return PSPEC_OK;
}

/* Rows that are pending have gone from the engine: nobody may try again with fewer realizations. */
pspec_status ps_accumulator_settle(ps_accumulator *accumulator, ps_error *error) {
    const size_t num_rows = accumulator->num_pending;
    accumulator->num_pending = 0;
    const pspec_status status =
        num_rows > 0 ? take_pending(accumulator, num_rows, error) : PSPEC_OK;
    return status == PSPEC_ERROR_MEMORY ? PSPEC_ERROR_DEVICE : status;
}

static void set_units(ps_accumulator *self, const double *units, size_t num) {
    for (size_t r = 0; r < num; r++) {
        self->units[r] = units != NULL ? units[r] : 1;
    }
}

/* The batch before is settled while the device works on this one. */
static pspec_status add_device_rows(ps_accumulator *self, const ps_rows *rows, const double *units,
                                    ps_error *error) {
    const pspec_status status = begin(self, rows, error);
    if (status != PSPEC_OK) {
        ps_error none;
        const pspec_status settled = ps_accumulator_settle(self, &none);
        forget(self);
        return settled == PSPEC_OK ? status : settled;
    }
    PS_TRY(ps_accumulator_settle(self, error));
    set_units(self, units, rows->num_rows);
    self->num_pending = rows->num_rows;
    return PSPEC_OK;
}

pspec_status ps_accumulator_add(ps_accumulator *accumulator, const ps_rows *rows,
                                const double *units, ps_error *error) {
    PS_TRY(
        ps_accumulator_reserve(accumulator, accumulator->num_realizations + rows->num_rows, error));
    if (accumulator->on_device != NULL) {
        PS_TRY(add_device_rows(accumulator, rows, units, error));
    } else {
        set_units(accumulator, units, rows->num_rows);
        add_host_rows(accumulator, rows);
        add_all(accumulator, rows->num_rows);
    }
    accumulator->num_realizations +=
        accumulator->options.observer.tell == NULL ? rows->num_rows : 0;
    return PSPEC_OK;
}

pspec_status ps_accumulator_add_one(ps_accumulator *accumulator, const double *bins,
                                    const double *weighted, double unit, ps_error *error) {
    PS_TRY(ps_accumulator_reserve(accumulator, accumulator->num_realizations + 1, error));
    add_one(accumulator, bins, weighted, unit);
    accumulator->num_realizations++;
    return PSPEC_OK;
}

double ps_accumulator_largest(const ps_accumulator *accumulator) {
    return accumulator->largest;
}

void ps_accumulator_reset(ps_accumulator *accumulator) {
    forget(accumulator);
    accumulator->largest = 0;
    accumulator->num_realizations = 0;
    accumulator->bin_sums.count = 0;
    accumulator->frequency_sums.count = 0;
    accumulator->weighted_sums.count = 0;
    for (size_t w = 0; w < accumulator->options.num_weighted; w++) {
        accumulator->weighted_blocks[w] = (ps_block_sums){0};
    }
    if (accumulator->on_device != NULL) {
        ps_device_accumulator_reset(accumulator->on_device);
    }
}

static void pick_bins(const ps_accumulator *self, const ps_sums *frequencies, ps_sums *bins) {
    const ps_bins *formed = self->options.bins;
    for (size_t b = 0; b < formed->num; b++) {
        bins[b] = frequencies[formed->members[formed->bins[b].begin]];
    }
}

static pspec_status get_frequencies(ps_accumulator *self, ps_sums *sums, ps_error *error) {
    if (self->on_device != NULL) {
        return ps_device_accumulator_sums(self->on_device, sums, error);
    }
    for (size_t i = 0; i < self->options.num_frequencies; i++) {
        sums[i] = ps_running_sums_get(&self->frequency_sums, i);
    }
    return PSPEC_OK;
}

/* frequencies: their sums, or NULL */
static pspec_status get_bins(ps_accumulator *self, const ps_sums *frequencies, ps_sums *bins,
                             ps_error *error) {
    ps_sums *own = NULL;
    if (self->formed == self->options.bins) {
        for (size_t b = 0; b < self->options.bins->num; b++) {
            bins[b] = ps_running_sums_get(&self->bin_sums, b);
        }
        return PSPEC_OK;
    }
    if (frequencies == NULL) {
        PS_TRY(PS_NEW(&own, self->options.num_frequencies, "sums of frequencies", error));
    }
    const pspec_status status = own != NULL ? get_frequencies(self, own, error) : PSPEC_OK;
    if (status == PSPEC_OK) {
        pick_bins(self, own != NULL ? own : frequencies, bins);
    }
    free(own);
    return status;
}

pspec_status ps_accumulator_sums(ps_accumulator *accumulator, ps_sums *bins, ps_sums *frequencies,
                                 ps_error *error) {
    PS_TRY(ps_accumulator_settle(accumulator, error));
    if (frequencies != NULL) {
        PS_TRY(get_frequencies(accumulator, frequencies, error));
    }
    return get_bins(accumulator, frequencies, bins, error);
}

static void finish(const ps_accumulator *self, const ps_sums *sums, size_t num, ps_mean *means) {
    for (size_t i = 0; i < num; i++) {
        ps_sums_finish(&sums[i], self->num_realizations, &means[i].mean, &means[i].standard_error);
    }
}

pspec_status ps_accumulator_bins(ps_accumulator *accumulator, ps_mean *means, ps_error *error) {
    const size_t num = accumulator->options.bins->num;
    ps_sums *sums = NULL;
    PS_TRY(ps_accumulator_settle(accumulator, error));
    PS_TRY(PS_NEW(&sums, num, "sums of bins", error));
    const pspec_status status = get_bins(accumulator, NULL, sums, error);
    if (status == PSPEC_OK) {
        finish(accumulator, sums, num, means);
    }
    free(sums);
    return status;
}

pspec_status ps_accumulator_frequencies(ps_accumulator *accumulator, ps_mean *means,
                                        ps_error *error) {
    PS_TRY(ps_accumulator_settle(accumulator, error));
    if (accumulator->on_device != NULL) {
        return ps_device_accumulator_frequencies(accumulator->on_device, means, error);
    }
    for (size_t i = 0; i < accumulator->options.num_frequencies; i++) {
        const ps_sums sums = ps_running_sums_get(&accumulator->frequency_sums, i);
        finish(accumulator, &sums, 1, &means[i]);
    }
    return PSPEC_OK;
}

void ps_accumulator_weighted(const ps_accumulator *accumulator, ps_mean *means) {
    for (size_t w = 0; w < accumulator->options.num_weighted; w++) {
        const ps_sums sums = ps_running_sums_get(&accumulator->weighted_sums, w);
        finish(accumulator, &sums, 1, &means[w]);
    }
}

const ps_block_sums *ps_accumulator_weighted_blocks(const ps_accumulator *accumulator) {
    return accumulator->weighted_blocks;
}
