#include "harness_contract.h"

#include "harness_shapes.h"
#include "harness_sphere.h"
#include "harness_sphere_shapes.h"

#include "engines/error_units.h"
#include "engines/engine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Frequencies at and beside whole vectors and tiles; the smallest there are. */
static const contract_case cases[] = {
    {"line", 1, 37, false, false, PS_OF_AMPLITUDES, {1e-5, 1e-11, 1}, 60, NULL},
    {"ball of the plane", 2, 9, true, false, PS_OF_AMPLITUDES, {1e-5, 1e-11, 1}, 60, NULL},
    {"space", 3, 4, false, false, PS_OF_AMPLITUDES, {1e-5, 1e-11, 1}, 60, NULL},
    {"list of the plane", 2, 900, false, true, PS_OF_AMPLITUDES, {1e-5, 1e-11, 1}, 0, NULL},
    {"list of five", 5, 100, false, true, PS_OF_AMPLITUDES, {1e-5, 1e-11, 1}, 0, NULL},
    {"tiles", 2, 33, false, false, PS_OF_AMPLITUDES, {1e-5, 1e-11, 0}, 130, "group="},
    {"one frequency", 1, 1, false, false, PS_OF_AMPLITUDES, {1e-4, 1e-9, 1}, 400, "whole="},
    {"whole line", 1, 37, false, false, PS_OF_AMPLITUDES, {1e-6, 1e-12, 0}, 500, "whole="},
    {"whole line of 1000", 1, 1000, false, false, PS_OF_AMPLITUDES, {1e-3, 0, 0}, 3000, "whole="},
    {"whole line of 800", 1, 800, false, false, PS_OF_AMPLITUDES, {0, 1e-9, 0}, 900, "whole="},
    {"whole plane of 5", 2, 5, false, false, PS_OF_AMPLITUDES, {1e-3, 0, 0}, 1000, "whole="},
    {"whole plane of 15", 2, 15, false, false, PS_OF_AMPLITUDES, {1e-6, 0, 0}, 4000, "whole="},
    {"whole plane of 16", 2, 16, false, false, PS_OF_AMPLITUDES, {1e-5, 1e-6, 0}, 4000, "whole="},
    {"whole plane of 20", 2, 20, false, false, PS_OF_AMPLITUDES, {0, 1e-6, 0}, 4000, "whole="},
    {"whole plane of 33", 2, 33, false, false, PS_OF_AMPLITUDES, {1e-2, 0, 0}, 9000, "whole="},
    {"whole plane of 63", 2, 63, false, false, PS_OF_AMPLITUDES, {0, 1e-9, 0}, 20000, "whole="},
    {"strips of 135", 2, 135, false, false, PS_OF_AMPLITUDES, {0, 1e-9, 0}, 20000, "strips="},
    {"strips of 159", 2, 159, false, false, PS_OF_AMPLITUDES, {1e-6, 0, 0}, 20000, "strips="},
    {"strips of 160", 2, 160, false, false, PS_OF_AMPLITUDES, {1e-6, 0, 0}, 20000, "strips="},
    {"grid of the plane", 2, 9, false, false, PS_OF_AMPLITUDES, {1e-6, 0, 0}, 20000000, "gridded"},
    {"grid of space", 3, 5, false, false, PS_OF_AMPLITUDES, {2e-6, 0, 0}, 5000000, "gridded"},
    {"degree 1", 0, 1, false, false, PS_OF_AMPLITUDES, {1e-4, 1e-12, 1}, 0, NULL},
    {"even degree 2", 0, 2, true, false, PS_OF_AMPLITUDES, {1e-5, 1e-9, 1}, 0, NULL},
    {"degrees to 3", 0, 3, false, false, PS_OF_AMPLITUDES, {1e-6, 0, 0}, 0, NULL},
    {"degrees to 7", 0, 7, false, false, PS_OF_AMPLITUDES, {1e-2, 1e-6, 0}, 0, NULL},
    {"degrees to 15", 0, 15, false, false, PS_OF_AMPLITUDES, {1e-5, 0, 0}, 0, NULL},
    {"degrees to 16", 0, 16, false, false, PS_OF_AMPLITUDES, {1e-5, 1e-9, 0}, 0, NULL},
    {"even degrees to 31", 0, 31, true, false, PS_OF_AMPLITUDES, {0, 1e-12, 0}, 0, NULL},
    {"degrees to 32", 0, 32, false, false, PS_OF_AMPLITUDES, {1e-5, 0, 0}, 0, NULL},
    {"even degrees to 33", 0, 33, true, false, PS_OF_AMPLITUDES, {1e-4, 1e-12, 1}, 0, NULL},
    {"degrees to 61", 0, 61, false, false, PS_OF_AMPLITUDES, {1e-6, 1e-12, 0}, 0, NULL},
    {"degrees to 64", 0, 64, false, false, PS_OF_AMPLITUDES, {0, 1e-6, 0}, 0, NULL},
    {"degrees to 67", 0, 67, false, false, PS_OF_AMPLITUDES, {0, 1e-13, 0}, 0, NULL},
    {"degrees to 130", 0, 130, false, false, PS_OF_AMPLITUDES, {0, 1e-12, 0}, 0, NULL},
    {"even degrees to 150", 0, 150, true, false, PS_OF_AMPLITUDES, {1e-5, 0, 0}, 0, NULL},
    {"sums of degree 1", 0, 1, false, false, PS_OF_PAIR_SUMS, {1e-5, 1e-11, 1}, 0, NULL},
    {"sums to 33", 0, 33, false, false, PS_OF_PAIR_SUMS, {1e-5, 1e-11, 1}, 0, NULL},
    {"even sums to 64", 0, 64, true, false, PS_OF_PAIR_SUMS, {1e-5, 1e-11, 0}, 0, NULL},
};

static const size_t sizes[CONTRACT_SETS] = {16, 1,  2,  7,  8,  9, 15,
                                            17, 31, 33, 65, 32, 0, CONTRACT_LONGEST};

/* ---- one way ----------------------------------------------------------------------------- */

static ps_frequencies make_list(const contract_case *what) {
    enum { NUM = 77 };
    uint64_t state = 3;
    int32_t *vectors = calloc(NUM * what->dimension, sizeof(int32_t));
    ps_frequencies set = {0};
    for (size_t i = 0; i < NUM * what->dimension; i++) {
        vectors[i] = (int32_t)((2 * test_uniform(&state) - 1) * what->max_frequency);
    }
    assert_ok(ps_frequencies_list(&set, what->dimension, NUM, vectors, error));
    return set;
}

static ps_frequencies make_frequencies(const contract_case *what) {
    ps_frequencies set = {0};
    if (what->dimension == 0) {
        return test_degrees(what->max_frequency, what->is_part);
    }
    if (what->is_list) {
        return make_list(what);
    }
    assert_ok(
        ps_frequencies_lattice(&set, what->dimension, what->max_frequency, what->is_part, error));
    assert_ok(ps_frequencies_enumerate(&set, error));
    return set;
}

static void make_sets(contract_way *way) {
    const unsigned dimension = way->what->dimension;
    for (size_t r = 0; r < CONTRACT_SETS; r++) {
        way->sets[r] =
            dimension == 0
                ? test_make_sphere_pattern(&test_sphere_shapes[r % TEST_SPHERE_SHAPES], sizes[r], r)
                : test_make_pattern(&test_shapes[r % TEST_SHAPES], dimension, sizes[r], r);
    }
}

static ps_problem make_problem(const contract_way *way) {
    const contract_case *const what = way->what;
    const ps_problem asked = {.frequencies = &way->frequencies,
                              .num_points = CONTRACT_LONGEST,
                              .planned_points = what->planned_points,
                              .num_realizations = CONTRACT_SETS,
                              .has_weights = true,
                              .measure = what->measure,
                              .tolerance = what->tolerances[way->precision]};
    return ps_engine_problem(way->engine, &asked);
}

/* Is it the variant that the case is there for? (GPUs have one for all, which is asked without and
 * with pairs of numbers. PoCL is slow with their layouts: high degrees are for CPUs.) */
static bool is_meant(const contract_way *way) {
    const bool is_gpu = ps_device_get_limits(way->device)->has_dedicated_local_memory;
    const int32_t most_degree_of_gpus = 64;
    void *state = NULL;
    ps_text text = {0};
    if (is_gpu && way->what->dimension == 0 && way->what->max_frequency > most_degree_of_gpus) {
        return false;
    }
    if (way->what->says == NULL || way->engine != &ps_torus_nufft) {
        return way->what->says == NULL;
    }
    if (is_gpu) {
        return strcmp(way->what->says, "gridded") == 0 || strcmp(way->what->says, "group=") == 0;
    }
    assert_ok(ps_engine_create(way->engine, &state, &way->problem, way->precision, 1, way->device,
                               error));
    way->engine->describe(state, &text);
    if (strstr(ps_text_string(&text), way->what->says) == NULL) {
        CONTRACT_FAIL(way, "not '%s', but %s", way->what->says, ps_text_string(&text));
    }
    ps_text_free(&text);
    ps_engine_destroy(way->engine, state);
    return true;
}

static bool is_taken(const contract_way *way) {
    const ps_device_limits *const limits = ps_device_get_limits(way->device);
    return (way->engine->domains & ps_problem_domain(&way->problem)) != 0 &&
           way->engine->survey(&way->problem, limits, way->precision).why_not == NULL;
}

static size_t try_way(contract_way *way, contract_law *law) {
    size_t num = 0;
    if (way->what->tolerances[way->precision] == 0 || !way->engine->has_precision[way->precision]) {
        return 0;
    }
    way->frequencies = make_frequencies(way->what);
    way->problem = make_problem(way);
    if (is_taken(way) && is_meant(way)) {
        make_sets(way);
        double *const expected =
            contract_powers(way, &way->problem, way->sets, CONTRACT_SETS, CONTRACT_SETS);
        way->expected = expected;
        law(way);
        free(expected);
        num = 1;
        for (size_t r = 0; r < CONTRACT_SETS; r++) {
            test_free_pattern(&way->sets[r]);
        }
    }
    ps_frequencies_free(&way->frequencies);
    return num;
}

size_t contract_walk(ps_device *device, const ps_engine *engine, contract_law *law) {
    size_t num = 0;
    for (size_t e = 0; ps_engines[e] != NULL; e++) {
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            for (int precision = PS_SINGLE; precision <= PS_EXTENDED; precision++) {
                contract_way way = {.what = &cases[i],
                                    .law = "",
                                    .engine = ps_engines[e],
                                    .precision = (ps_precision)precision,
                                    .device = device};
                num += engine == NULL || engine == way.engine ? try_way(&way, law) : 0;
            }
        }
    }
    return num;
}

void *contract_state(const contract_way *way) {
    void *state = NULL;
    assert_ok(ps_engine_create(way->engine, &state, &way->problem, way->precision, CONTRACT_SETS,
                               way->device, error));
    return state;
}

/* ---- rows -------------------------------------------------------------------------------- */

double *contract_powers(const contract_way *way, const ps_problem *problem,
                        const pspec_pattern *patterns, size_t num, size_t batch) {
    return test_run_problem(way->engine, problem, way->precision, way->device, patterns, num,
                            batch);
}

size_t contract_row_bytes(const contract_way *way) {
    return way->frequencies.num * sizeof(double);
}

void contract_check_rows(const contract_way *way, const char *what, size_t num, double *found,
                         const double *expected) {
    for (size_t i = 0; i < num * way->frequencies.num; i++) {
        if (memcmp(&found[i], &expected[i], sizeof found[i]) != 0) {
            CONTRACT_FAIL(way, "%s: set %zu, frequency %zu: %a instead of %a", what,
                          i / way->frequencies.num, i % way->frequencies.num, found[i],
                          expected[i]);
        }
    }
    free(found);
}

/* ---- bytes of buffers --------------------------------------------------------------------- */

double contract_bytes, contract_most_bytes;

/* Linked in the place of the driver's (tests/CMakeLists.txt). */
cl_mem __real_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code);
cl_mem __wrap_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code);
cl_mem __wrap_clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                             cl_int *code) {
    contract_bytes += (double)bytes;
    contract_most_bytes = fmax(contract_most_bytes, contract_bytes);
    return __real_clCreateBuffer(context, flags, bytes, host, code);
}
cl_int __real_clReleaseMemObject(cl_mem memory);
cl_int __wrap_clReleaseMemObject(cl_mem memory);
cl_int __wrap_clReleaseMemObject(cl_mem memory) {
    size_t bytes = 0;
    clGetMemObjectInfo(memory, CL_MEM_SIZE, sizeof bytes, &bytes, NULL);
    contract_bytes -= (double)bytes;
    return __real_clReleaseMemObject(memory);
}
