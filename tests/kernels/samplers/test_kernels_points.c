/* Points that a kernel makes beside those of the host, bit by bit: every sampler that has them by
 * index, in all its dimensions, in whole sets and in the pieces that engines ask for. */
#include "harness_kernels.h"

#include "engines/torus/torus_points.h"
#include "harness_plan.h"
#include "sets/device_sets.h"
#include "test_samplers.h"

#include <string.h>

enum { MOST_POINTS = 108, REALIZATIONS = 3 }; /* with rings of HEALPix in both caps */

static ps_device *device;

/* Beyond 32 bits both; the last realization carries into the upper half. */
static const uint64_t seed = UINT64_C(0x123456789abcdef1);
static const uint64_t realization = (UINT64_C(5) << 32) - 2;

/* Besides each sampler as it is without parameters. */
static const char *const others[] = {
    "sobol:scramble=xor",
    "sobol:scramble=owen",
    "sobol:scramble=hash",
    "larcher-pillichshammer:scramble=owen,centred=yes",
    "larcher-pillichshammer:scramble=xor",
    "halton:start=123456789012",
};

/* By the sampler's own words, then as engines of the torus convert them; on the sphere as they are.
 */
static void make_on_host(const ps_sampler_request *request, uint64_t number, uint64_t *places) {
    const bool on_sphere = ps_sampler_is_on_sphere(request);
    double *const points = generate_points(request, number);
    for (size_t i = 0; i < request->num_points * request->dimension; i++) {
        places[i] = on_sphere ? 0 : ps_fixed_point(points[i]);
    }
    if (on_sphere) {
        memcpy(places, points, request->num_points * request->dimension * sizeof *points);
    }
    free(points);
}

static void check_range(const ps_sampler_request *request, ps_device_sets *sets,
                        const sampler_range *range) {
    const unsigned d = request->dimension;
    const size_t num = (size_t)(range->count * range->num_realizations) * d;
    uint64_t expected[MOST_POINTS * PS_MAX_DIMENSION];
    test_memory out = test_memory_create(device, NULL, num * sizeof(uint64_t));
    assert_ok(ps_device_sets_write(sets, range, &out.buffer, error));
    uint64_t *const found = test_memory_read(&out);
    for (uint64_t r = 0; r < range->num_realizations && num > 0; r++) {
        make_on_host(request, range->realization + r, expected);
        for (uint64_t i = 0; i < range->count; i++) {
            const uint64_t j = (range->begin + i * range->step) % request->num_points;
            if (memcmp(found + (r * range->count + i) * d, expected + j * d, d * sizeof *found) !=
                0) {
                fail_msg("%s, N = %zu, d = %u: point %llu of realization %llu",
                         request->sampler->name, request->num_points, d, (unsigned long long)j,
                         (unsigned long long)(range->realization + r));
            }
        }
    }
    free(found);
    test_memory_free(&out);
}

static void check_request(const ps_sampler_request *request) {
    const uint64_t n = request->num_points;
    const sampler_range ranges[] = {
        {realization, REALIZATIONS, 0, 1, n}, /* whole sets */
        {0, 2, 2 % n, ps_torus_point_step(n), (n + 1) / 2},
        {realization, 1, n - 1, 1, 1},
        {0, 2, 0, 1, 0},
    };
    ps_device_sets *sets = NULL;
    assert_ok(ps_device_sets_create(&sets, request, device, error));
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        check_range(request, sets, &ranges[i]);
    }
    ps_device_sets_destroy(sets);
}

static void check_text(const char *text, unsigned dimension) {
    static const size_t numbers[] = {1, 2, 7, 12, 48, 64, MOST_POINTS - 1, MOST_POINTS};
    size_t num_checked = 0;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        ps_sampler_request request = parse_request(text, numbers[i], dimension);
        ps_error error = {0};
        request.seed = seed;
        const bool is_possible = ps_sampler_check(&request, &error) == PSPEC_OK &&
                                 ps_device_sets_serve(&request, ps_device_get_limits(device));
        if (is_possible) {
            check_request(&request);
            num_checked++;
        }
    }
    assert_true(num_checked >= 2 || !ps_device_get_limits(device)->has_fp64);
}

static void points_have_the_bits_of_the_host(void **state) {
    (void)state;
    for (size_t s = 0; ps_samplers[s] != NULL; s++) {
        const ps_sampler *const sampler = ps_samplers[s];
        for (unsigned d = 1; sampler->by_index.name != NULL && d <= sampler->maximum_dimension;
             d++) {
            if (d >= sampler->minimum_dimension) {
                check_text(sampler->name, d);
            }
        }
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        check_text(others[i], 2);
    }
    check_text("sobol:scramble=owen", PS_MAX_DIMENSION);
}

static void points_of_the_sphere_have_them_too(void **state) {
    static const char *const texts[] = {"white-sphere",
                                        "white-hemisphere",
                                        "zphi",
                                        "fibonacci",
                                        "fibonacci-hemisphere",
                                        "healpix-jittered",
                                        "white:lift=sphere",
                                        "white:lift=hemisphere",
                                        "jittered:lift=sphere",
                                        "jittered:lift=hemisphere",
                                        "jittered:lift=hemisphere,morph=diffuse",
                                        "white-hemisphere:morph=diffuse",
                                        "fibonacci-hemisphere:morph=diffuse"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        check_text(texts[i], PS_VECTOR_DIMENSION);
    }
}

/* Sets side by side, each filled up with 0: [axis][capacity]. */
static void check_coordinates(unsigned precision, bool on_sphere) {
    enum { SETS = 2, POINTS = 5, PADDED = 8, CAPACITY = SETS * PADDED + 3, AXES = 3 };
    const sampler_sets sizes = {CAPACITY, SETS, POINTS, PADDED};
    uint64_t made[SETS * POINTS * AXES];
    double expected[SETS * POINTS * AXES];
    for (size_t i = 0; i < SETS * POINTS * AXES; i++) {
        expected[i] = (double)(i * i % 97) / 128 - (on_sphere ? 0.25 : 0);
        made[i] = (uint64_t)(i * i % 97) << 57;
        if (on_sphere) {
            memcpy(&made[i], &expected[i], sizeof made[i]);
        }
    }
    ps_kernel *const kernel =
        test_kernel(device, "samplers/coordinates.cl", "sampler_coordinates",
                    "-DPRECISION=%u -DDIMENSION=%d -DON_SPHERE=%d", precision, AXES, on_sphere);
    test_memory from = test_memory_create(device, made, sizeof made);
    test_memory points = test_reals_create(device, precision, NULL, (size_t)AXES * CAPACITY);
    TEST_LAUNCH(device, kernel, 16, SETS * PADDED, 1, 1, PS_STRUCT(sizes), PS_BUFFER(from.buffer),
                PS_BUFFER(points.buffer));
    double *const found = test_reals_read(&points, precision);
    for (size_t i = 0; i < AXES * SETS * PADDED; i++) {
        const size_t axis = i / (SETS * PADDED), set = i / PADDED % SETS, j = i % PADDED;
        const double wanted = j < POINTS ? expected[(set * POINTS + j) * AXES + axis] : 0;
        assert_true(found[axis * CAPACITY + set * PADDED + j] == wanted);
    }
    free(found);
    test_memory_free_unchanged(&from);
    test_memory_free(&points);
}

static void coordinates_are_numbers(void **state) {
    (void)state;
    check_coordinates(32, false);
    if (ps_device_get_limits(device)->has_fp64) {
        check_coordinates(64, false);
        check_coordinates(64, true);
    }
}

/* Of a part of a set the host makes the points by index, too. */
static void beginnings_are_those_of_the_host(void **state) {
    (void)state;
    enum { D = 3, FEW = 20 };
    static const char *const texts[] = {"white",      "jittered",  "halton",
                                        "hammersley", "sobol",     "white-sphere",
                                        "zphi",       "fibonacci", "healpix-jittered"};
    for (size_t s = 0; s < sizeof texts / sizeof texts[0]; s++) {
        ps_sampler_request request = make_request(texts[s], s < 5 ? 64 : 48, D);
        request.seed = seed;
        double *const points = generate_points(&request, realization);
        double some[D * FEW];
        ps_device_sets *sets = NULL;
        if (ps_device_sets_serve(&request, ps_device_get_limits(device))) {
            assert_ok(ps_device_sets_create(&sets, &request, device, error));
            assert_ok(ps_device_sets_beginning(sets, realization, FEW, some, error));
            for (size_t i = 0; i < D * FEW; i++) {
                assert_true(ps_sampler_is_on_sphere(&request)
                                ? some[i] == points[i]
                                : ps_fixed_point(some[i]) == ps_fixed_point(points[i]));
            }
            ps_device_sets_destroy(sets);
        }
        free(points);
    }
}

static void others_are_made_by_the_host(void **state) {
    (void)state;
    const ps_device_limits gpu = test_gpu(true);
    const ps_device_limits without_doubles = test_gpu(false);
    const ps_device_limits cpu = test_cpu();
    ps_sampler_request white = make_request("white", 9, 2);
    const ps_sampler_request jittered = make_request("jittered", 9, 2);
    const ps_sampler_request latin = make_request("latin-hypercube", 9, 2);
    const ps_sampler_request lifted = make_request("white:lift=sphere", 9, 3);
    const ps_sampler_request net = make_request("sobol:lift=sphere", 9, 3);
    const ps_sampler_request morphed = make_request("white-hemisphere:morph=phong,n=7", 9, 3);
    assert_true(ps_device_sets_serve(&white, &gpu));
    assert_true(ps_device_sets_serve(&white, &without_doubles));
    assert_true(ps_device_sets_serve(&jittered, &gpu));
    assert_false(ps_device_sets_serve(&jittered, &without_doubles));
    assert_false(ps_device_sets_serve(&white, &cpu));
    assert_false(ps_device_sets_serve(&white, NULL));
    assert_false(ps_device_sets_serve(&latin, &gpu));
    assert_true(ps_device_sets_serve(&lifted, &gpu));
    assert_false(ps_device_sets_serve(&lifted, &without_doubles));
    assert_false(ps_device_sets_serve(&net, &gpu));
    assert_false(ps_device_sets_serve(&morphed, &gpu));
    white.num_points = (size_t)UINT32_MAX + 1;
    assert_false(ps_device_sets_serve(&white, &gpu));
    white.num_points = 9;
    white.homogenize = true;
    assert_false(ps_device_sets_serve(&white, &gpu));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_have_the_bits_of_the_host),
        cmocka_unit_test(points_of_the_sphere_have_them_too),
        cmocka_unit_test(coordinates_are_numbers),
        cmocka_unit_test(beginnings_are_those_of_the_host),
        cmocka_unit_test(others_are_made_by_the_host),
    };
    device = test_open_gpu();
    const int failures = cmocka_run_group_tests_name("kernels_points", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
