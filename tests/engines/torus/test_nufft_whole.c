/* When torus_nufft does realizations by one work-group each, whole or in strips, and lengths of
 * theirs. (tests/engines/test_engine_contract.c compares their sums.)
 */
#include "harness_shapes.h"

#include "engines/torus/nufft/choice.h"
#include "engines/torus/nufft/layout.h"
#include "engines/engine.h"
#include "engines/torus/nufft/variant.h"

#include <math.h>
#include <stdlib.h>

static ps_device *device;

/* In one dimension the grid is the product of the lengths, both transforms keep less than they
 * have, and every frequency has a place of its own. */
static void lengths_of_lines(void **state) {
    (void)state;
    for (int32_t k = 1; k < 3000; k += 1 + k / 3) {
        ps_frequencies grid = test_make_grid(1, k);
        const ps_problem problem = {.frequencies = &grid, .num_points = 2000, .tolerance = 1e-4};
        const ps_nufft_choice choice = ps_nufft_choose(&problem, NULL, PS_SINGLE);
        uint32_t kept[2];
        assert_ptr_equal(choice.variant, &ps_nufft_whole);
        ps_nufft_whole_kept(&choice, kept);
        assert_int_equal(choice.lengths[0] * choice.lengths[1], choice.axes[0].n);
        assert_true(2 * kept[0] <= choice.lengths[0] && 2 * kept[1] + 1 <= choice.lengths[1]);
        assert_true(choice.lengths[0] * kept[1] >= (uint32_t)k);
        ps_frequencies_free(&grid);
    }
}

/* Not where local memory is apart, as on GPUs: there the engine goes another way. */
static void only_with_caches(void **state) {
    (void)state;
    ps_device_limits limits = *ps_device_get_limits(device);
    ps_frequencies grid = test_make_grid(2, 16);
    const ps_problem problem = {.frequencies = &grid, .num_points = 4000, .tolerance = 1e-4};
    limits.has_dedicated_local_memory = true;
    assert_ptr_not_equal(ps_nufft_choose(&problem, &limits, PS_SINGLE).variant, &ps_nufft_whole);
    ps_frequencies_free(&grid);
}

static const ps_nufft_variant *variant_for(const ps_frequencies *grid, size_t num_points,
                                           uint64_t num_realizations) {
    const ps_problem problem = {.frequencies = grid,
                                .num_points = num_points,
                                .num_realizations = num_realizations,
                                .tolerance = 1e-6};
    const ps_nufft_choice choice =
        ps_nufft_choose(&problem, ps_device_get_limits(device), PS_SINGLE);
    return choice.variant;
}

/* A set alone in strips would have one core; files may have any number of sets. Where the tiles of
 * one set are more than a buffer may have, the engine has another way, and is not refused. */
static void only_where_strips_pay(void **state) {
    (void)state;
    ps_frequencies grid = test_make_grid(2, 160);
    assert_ptr_equal(variant_for(&grid, 20000, 0), &ps_nufft_strips);
    assert_ptr_equal(variant_for(&grid, 20000, 2), &ps_nufft_strips);
    assert_ptr_not_equal(variant_for(&grid, 20000, 1), &ps_nufft_strips);
    ps_frequencies_free(&grid);
    assert_ok(ps_frequencies_lattice(&grid, 2, 4096, false, error));
    const ps_problem problem = {
        .frequencies = &grid, .num_points = 65536, .num_realizations = 100, .tolerance = 1e-6};
    assert_ptr_not_equal(variant_for(&grid, 65536, 100), &ps_nufft_strips);
    assert_null(ps_torus_nufft.survey(&problem, ps_device_get_limits(device), PS_SINGLE).why_not);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_of_lines),
        cmocka_unit_test(only_with_caches),
        cmocka_unit_test(only_where_strips_pay),
    };
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("nufft_whole", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
