/* When torus_direct takes matrix units: where a device has some and room for their work-groups, and
 * they are as exact as is asked. */
#include "harness_shapes.h"

#include "engines/torus/torus_layout.h"

typedef struct unit_case {
    ps_units units;
    ps_precision precision;
    int32_t max_frequency;
    uint64_t num_points;
    double tolerance, power;
    size_t local_kib, group;
    unsigned block_tiles; /* 0: no units */
} unit_case;

/* In single precision second sums of 8192 points are too many for 1e-6, and so are powers far above
 * white noise. 32 KiB have no room for gaps behind 32 (double) or 64 frequencies a side, and blocks
 * of so many want 128 and 256 items. */
static const unit_case cases[] = {
    {PS_UNITS_PTX, PS_SINGLE, 32, 256, 1e-6, 1, 48, 1024, 8},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 1024, 16},
    {PS_UNITS_EMULATED, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 1024, 16},
    {PS_UNITS_UNKNOWN, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 1024, 0},
    {PS_UNITS_NONE, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 1024, 0},
    {PS_UNITS_PTX, PS_DOUBLE, 128, 1024, 1e-9, 1, 48, 1024, 8},
    {PS_UNITS_PTX, PS_SINGLE, 128, 4096, 1e-6, 1, 48, 1024, 16},
    {PS_UNITS_PTX, PS_SINGLE, 128, 8192, 1e-6, 1, 48, 1024, 0},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 100, 48, 1024, 0},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 2e-7, 1, 48, 1024, 0},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 128, 8},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 1, 32, 1024, 8},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 1, 16, 1024, 0},
    {PS_UNITS_PTX, PS_SINGLE, 128, 1024, 1e-6, 1, 48, 32, 0},
    {PS_UNITS_PTX, PS_DOUBLE, 128, 1024, 1e-9, 1, 32, 1024, 0},
    {PS_UNITS_PTX, PS_DOUBLE, 128, 1024, 1e-9, 1, 48, 64, 0},
};

static void units_are_taken(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const unit_case *const one = &cases[i];
        ps_frequencies grid = test_make_grid(2, one->max_frequency);
        const ps_problem problem = {.frequencies = &grid,
                                    .num_points = one->num_points,
                                    .num_realizations = 1000,
                                    .tolerance = one->tolerance,
                                    .expected_power = one->power};
        const ps_device_limits limits = {.has_fp64 = true,
                                         .has_dedicated_local_memory = true,
                                         .native_float_lanes = 1,
                                         .native_double_lanes = 1,
                                         .local_bytes = one->local_kib << 10,
                                         .max_work_group_size = one->group,
                                         .units = one->units};
        const ps_torus_layout layout = ps_torus_layout_make(&problem, &limits, one->precision);
        if ((layout.units == PS_UNITS_NONE ? 0 : layout.block_tiles) != one->block_tiles) {
            fail_msg("case %zu: units %s, blocks of %u tiles", i, ps_units_name(layout.units),
                     layout.block_tiles);
        }
        ps_frequencies_free(&grid);
    }
}

/* What is planned for more points than there are stays as it is. */
static void growth_changes_no_units(void **state) {
    (void)state;
    ps_frequencies grid = test_make_grid(2, 32);
    const ps_device_limits limits = {.has_dedicated_local_memory = true,
                                     .native_float_lanes = 1,
                                     .local_bytes = 48 << 10,
                                     .max_work_group_size = 1024,
                                     .units = PS_UNITS_PTX};
    const ps_problem problem = {
        .frequencies = &grid, .num_points = 100000, .planned_points = 1024, .tolerance = 1e-6};
    assert_int_equal(ps_torus_layout_make(&problem, &limits, PS_SINGLE).units, PS_UNITS_PTX);
    ps_frequencies_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_are_taken),
        cmocka_unit_test(growth_changes_no_units),
    };
    return cmocka_run_group_tests_name("torus_layout", tests, NULL, NULL);
}
