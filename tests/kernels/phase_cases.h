/* torus/phase.h, on the host and on the device: a part of shared_cases.h. */

/* What torus/phase.h needs in C; the dimension is a variable here. */
static int dimension = 1;
#define __global
typedef unsigned long ulong;
#define DIMENSION dimension
#include "torus/phase.h"

enum { MAX_DIMENSION = 6 };

typedef struct phase_case {
    int32_t k[MAX_DIMENSION];
    ulong x[MAX_DIMENSION];
} phase_case;

static phase_case random_phase_case(void) {
    phase_case one = {.k = {0}};
    const int bits = 1 + (int)(test_uniform(&seed) * 28); /* every size up to 2^28 */
    for (int axis = 0; axis < dimension; axis++) {
        one.k[axis] = (int32_t)rint((2 * test_uniform(&seed) - 1) * ldexp(1, bits));
        one.x[axis] = (ulong)random_word() << 32 ^ (ulong)random_word();
    }
    return one;
}

static word host_phase(const phase_case *one) {
    word k[MAX_DIMENSION] = {0};
    real k_real[MAX_DIMENSION] = {0};
    for (int axis = 0; axis < dimension; axis++) {
        k[axis] = (word)(sword)one->k[axis];
        k_real[axis] = TO_REALV(AS_SWORDV(k[axis]));
    }
    return phase_of_point(k, k_real, one->x, 0, dimension);
}

/* The error of the phase in units of 2^-PRECISION turns. */
static double phase_error(const phase_case *one) {
    wide exact = 0; /* units of 2^-64 turns */
    for (int axis = 0; axis < dimension; axis++) {
        exact += (wide)one->k[axis] * (wide)one->x[axis];
    }
    const uint64_t found = (uint64_t)host_phase(one) << (64 - PRECISION);
    return ldexp(fabs((double)(int64_t)(found - (uint64_t)exact)), PRECISION - 64);
}

static void check_phase(const phase_case *one) {
    double sum_k = 0;
    for (int axis = 0; axis < dimension; axis++) {
        sum_k += fabs((double)one->k[axis]);
    }
    /* float: the sum of the low parts is cut off and so are their products with k (2 units); k, the
     * low part and each of the sums round by 2^-24. */
    const double limit = PRECISION == 64 ? 0 : 2 + (2 + dimension) * sum_k * 0x1p-24;
    const double error = phase_error(one);
    if (!(error <= limit)) {
        fail_msg("d = %d, k = (%d, ...): the phase is off by %.3f units, allowed are %.3f",
                 dimension, (int)one->k[0], error, limit);
    }
}

static void phases_are_exact(void **state) {
    (void)state;
    for (dimension = 1; dimension <= MAX_DIMENSION; dimension++) {
        for (int i = 0; i < 50000; i++) {
            const phase_case one = random_phase_case();
            check_phase(&one);
        }
        const int32_t extremes[6] = {0, 1, -1, (1 << 28) - 1, 1 << 28, -(1 << 28)};
        const ulong places[6] = {0, 1, UINT32_MAX, (ulong)1 << 32, (ulong)1 << 63, UINT64_MAX};
        for (size_t i = 0; i < 6; i++) {
            for (size_t j = 0; j < 6; j++) {
                phase_case one = {.k = {0}};
                for (int axis = 0; axis < dimension; axis++) {
                    one.k[axis] = extremes[i];
                    one.x[axis] = places[j];
                }
                check_phase(&one);
            }
        }
    }
}

static void check_device_phases(unsigned lanes, size_t num) {
    enum { LARGEST_LANES = 16 };
    phase_case *cases = malloc((num + 1) * sizeof *cases);
    ulong *points = malloc((num + 1) * (size_t)dimension * sizeof *points);
    word k[MAX_DIMENSION * LARGEST_LANES];
    assert_true(cases != NULL && points != NULL && lanes <= LARGEST_LANES);
    phase_case lane_cases[LARGEST_LANES];
    for (unsigned lane = 0; lane < lanes; lane++) {
        lane_cases[lane] = random_phase_case();
        for (unsigned axis = 0; axis < (unsigned)dimension; axis++) {
            k[axis * lanes + lane] = (word)(sword)lane_cases[lane].k[axis];
        }
    }
    for (size_t i = 0; i < num; i++) {
        cases[i] = random_phase_case();
        for (int axis = 0; axis < dimension; axis++) {
            points[i * (size_t)dimension + (size_t)axis] = cases[i].x[axis];
        }
    }
    ps_kernel *kernel =
        test_kernel(device, "probe/phase.cl", "probe_phase",
                    "-DPRECISION=%d -DLANES=%u -DDIMENSION=%d", PRECISION, lanes, dimension);
    test_memory x = test_memory_create(device, points, num * (size_t)dimension * sizeof *points);
    test_memory frequencies =
        test_memory_create(device, k, lanes * (size_t)dimension * sizeof(word));
    test_memory phases = test_memory_create(device, NULL, num * lanes * sizeof(word));
    TEST_LAUNCH(device, kernel, 3, num, 1, 1, PS_BUFFER(x.buffer), PS_BUFFER(frequencies.buffer),
                PS_BUFFER(phases.buffer), PS_U64(num));
    word *const found = test_memory_read(&phases);
    for (size_t i = 0; i < num; i++) {
        for (unsigned lane = 0; lane < lanes; lane++) {
            memcpy(cases[i].k, lane_cases[lane].k, sizeof cases[i].k);
            assert_true(found[i * lanes + lane] == host_phase(&cases[i]));
        }
    }
    free(found);
    free(points);
    free(cases);
    test_memory_free_unchanged(&x);
    test_memory_free_unchanged(&frequencies);
    test_memory_free(&phases);
}

static void device_phases_equal_host_phases(void **state) {
    (void)state;
    const unsigned lanes = device_lanes();
    const size_t sizes[4] = {0, 1, 2, 67};
    for (dimension = 1; dimension <= MAX_DIMENSION; dimension += dimension < 3 ? 1 : 3) {
        for (size_t i = 0; i < 4; i++) {
            check_device_phases(lanes, sizes[i]);
        }
    }
}
