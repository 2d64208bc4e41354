#include "harness_rows.h"

#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

/* Exponential powers with a part that all frequencies of a realization share, so that they are
 * correlated. Weights: equal; over 40 decades; the same, far outside the range of float; one ring.
 */
static rows_fixture make_fixture(ps_device *device) {
    rows_fixture made = {.device = device};
    uint64_t seed = 9;
    assert_ok(ps_frequencies_lattice(&made.set, 2, 20, false, error));
    assert_ok(ps_frequencies_enumerate(&made.set, error));
    assert_ok(ps_bins_create(&made.bins, &made.set, error));
    const size_t num = made.set.num;
    made.powers = calloc(ROWS_M * num, sizeof(double));
    made.weights = calloc(ROWS_WEIGHTED * num, sizeof(double));
    for (size_t r = 0; r < ROWS_M; r++) {
        const double common = test_uniform(&seed);
        for (size_t i = 0; i < num; i++) {
            made.powers[r * num + i] = (float)(common - log1p(-test_uniform(&seed)));
        }
    }
    for (size_t i = 0; i < num; i++) {
        made.weights[i] = 1 / (double)num;
        made.weights[num + i] = pow(10, -40 * test_uniform(&seed));
        made.weights[2 * num + i] = 3e-60 * made.weights[num + i];
    }
    const ps_bin *ring = &made.bins.bins[6];
    for (size_t i = ring->begin; i < ring->end; i++) {
        made.weights[3 * num + made.bins.members[i]] = 1;
    }
    return made;
}

static void free_fixture(rows_fixture *made) {
    ps_frequencies_free(&made->set);
    ps_bins_free(&made->bins);
    free(made->powers);
    free(made->weights);
}

uint32_t *rows_make_slots(const rows_fixture *what, const rows_layout *how) {
    uint32_t *slots = calloc(what->set.num, sizeof *slots);
    for (size_t i = 0; i < what->set.num; i++) {
        slots[i] = (uint32_t)(i * how->step % how->stride);
    }
    return slots;
}

/* Rows of some realizations, which are freed with release. */
static ps_rows make_rows(const rows_fixture *what, const rows_layout *how, const uint32_t *slots,
                         size_t first, size_t num) {
    double *places = calloc(num * how->stride, sizeof *places);
    ps_rows rows = {
        .num_rows = num, .stride = how->stride, .precision = how->precision, .host = places};
    for (size_t i = 0; i < num * how->stride; i++) {
        places[i] = NAN;
    }
    for (size_t i = 0; i < num * what->set.num; i++) {
        places[i / what->set.num * how->stride + slots[i % what->set.num]] =
            what->powers[first * what->set.num + i];
    }
    if (how->is_on_device) {
        assert_ok(ps_reals_upload(what->device, &rows.device, how->precision, places,
                                  num * how->stride, "a test", error));
    }
    return rows;
}

static void release(ps_rows *rows) {
    free((void *)rows->host);
    ps_buffer_release(&rows->device);
}

ps_accumulator *rows_make_accumulator(const rows_fixture *what, const rows_layout *how,
                                      const uint32_t *slots, bool mean_only) {
    ps_accumulator *made = NULL;
    const ps_accumulator_options options = {
        .bins = &what->bins,
        .num_frequencies = what->set.num,
        .slots = slots,
        .stride = how->stride,
        .batch = how->batch,
        .is_on_device = how->is_on_device,
        .precision = how->precision,
        .lanes = how->lanes,
        .want_frequencies = true,
        .mean_only = mean_only,
        .weights = what->weights,
        .num_weighted = ROWS_WEIGHTED,
    };
    assert_ok(ps_accumulator_create(&made, &options, what->device, error));
    return made;
}

void rows_add_all(ps_accumulator *accumulator, const rows_fixture *what, const rows_layout *how,
                  const uint32_t *slots, size_t num) {
    for (size_t r = 0, taken = 0; r < num; r += taken) {
        const size_t most = ROWS_M - r % ROWS_M < num - r ? ROWS_M - r % ROWS_M : num - r;
        taken = most < how->batch ? most : how->batch;
        ps_rows rows = make_rows(what, how, slots, r % ROWS_M, taken);
        assert_ok(ps_accumulator_add(accumulator, &rows, NULL, error));
        release(&rows);
    }
}

const rows_layout rows_layouts[ROWS_LAYOUTS] = {
    {false, PS_DOUBLE, 1, 840, 1, 4},      {false, PS_DOUBLE, 1, 1000, 7, 1},
    {true, PS_SINGLE, 16, 848, 1, ROWS_M}, {true, PS_SINGLE, 16, 1040, 77, 5},
    {true, PS_SINGLE, 4, 3000, 1111, 7},   {true, PS_SINGLE, 1, 841, 3, 16},
    {true, PS_SINGLE, 2, 1024, 3, 1},      {true, PS_DOUBLE, 8, 4096, 1235, 3},
    {true, PS_DOUBLE, 4, 1028, 5, 30},     {true, PS_DOUBLE, 16, 2000, 77, ROWS_M},
};

void rows_for_all_layouts(ps_device *device,
                          void (*check)(const rows_fixture *, const rows_layout *)) {
    const bool has_fp64 = ps_device_get_limits(device)->has_fp64;
    rows_fixture what = make_fixture(device);
    for (size_t i = 0; i < ROWS_LAYOUTS; i++) {
        if (i < ROWS_FIRST_DOUBLE || has_fp64) {
            check(&what, &rows_layouts[i]);
        }
    }
    free_fixture(&what);
}
