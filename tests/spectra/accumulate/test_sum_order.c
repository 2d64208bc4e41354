/* Sums over realizations are taken in one order, wherever rows are and however they are laid out:
 * means and standard errors of frequencies and bins have the same bits.
 */
#include "harness_rows.h"

#include "accumulate/blocks.h"

#include <stdlib.h>

static ps_device *device;

/* Two blocks of realizations that are merged, and an open one. */
enum { MANY = 2 * SUM_BLOCK + 40 };

/* Means of frequencies, and behind them those of bins. */
static void find_all(const rows_fixture *what, const rows_layout *how, bool is_gpu,
                     ps_mean *means) {
    uint32_t *slots = rows_make_slots(what, how);
    ps_device_set_dedicated_local_memory(device, is_gpu);
    ps_accumulator *accumulator = rows_make_accumulator(what, how, slots, false);
    rows_add_all(accumulator, what, how, slots, MANY);
    assert_ok(ps_accumulator_frequencies(accumulator, means, error));
    assert_ok(ps_accumulator_bins(accumulator, means + what->set.num, error));
    ps_accumulator_destroy(accumulator);
    ps_device_set_dedicated_local_memory(device, false);
    free(slots);
}

/* Frequencies have the same bits on the host and on the device, bins on the device, whatever the
 * rows_layout. */
static void check_everywhere(const rows_fixture *what, const rows_layout *how) {
    const bool is_single = how->precision == PS_SINGLE;
    const rows_layout *frequencies_of = &rows_layouts[is_single ? ROWS_FIRST_SINGLE : 0];
    const rows_layout *bins_of = is_single           ? &rows_layouts[ROWS_FIRST_SINGLE]
                                 : how->is_on_device ? &rows_layouts[ROWS_FIRST_DOUBLE]
                                                     : &rows_layouts[0];
    const size_t num = what->set.num;
    ps_mean *means[3];
    for (size_t i = 0; i < 3; i++) {
        means[i] = calloc(num + what->bins.num, sizeof(ps_mean));
    }
    find_all(what, frequencies_of, false, means[0]);
    find_all(what, bins_of, false, means[1]);
    for (size_t gpu = 0; gpu < (how->is_on_device ? 2 : 1); gpu++) {
        find_all(what, how, gpu > 0, means[2]);
        assert_memory_equal(means[2], means[0], num * sizeof(ps_mean));
        assert_memory_equal(means[2] + num, means[1] + num, what->bins.num * sizeof(ps_mean));
    }
    for (size_t i = 0; i < 3; i++) {
        free(means[i]);
    }
}

static void same_sums_everywhere(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_everywhere);
}

/* Equal rows have no standard error, exactly. */
static void check_equal_rows(const rows_fixture *given, const rows_layout *how) {
    rows_fixture what = *given;
    const size_t num = what.set.num;
    ps_mean *means = calloc(num + what.bins.num, sizeof *means);
    what.powers = calloc(ROWS_M * num, sizeof *what.powers);
    for (size_t i = 0; i < ROWS_M * num; i++) {
        what.powers[i] = given->powers[i % num];
    }
    for (size_t gpu = 0; gpu < (how->is_on_device ? 2 : 1); gpu++) {
        find_all(&what, how, gpu > 0, means);
        for (size_t i = 0; i < num + what.bins.num; i++) {
            assert_true(means[i].standard_error == 0);
            assert_true(i >= num || means[i].mean == what.powers[i]);
        }
    }
    free(what.powers);
    free(means);
}

static void equal_rows(void **state) {
    (void)state;
    rows_for_all_layouts(device, check_equal_rows);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_rows),
        cmocka_unit_test(same_sums_everywhere),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("sum_order", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
