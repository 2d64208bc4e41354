#include "engines/engine.h"

#include "base/memory.h"
#include "device/kind.h"
#include "device/reals.h"

#include <math.h>
#include <stdlib.h>

/* Four right frequencies per work-item give 64 accumulators and 6.4 fused operations per number
 * loaded in torus/product.cl; not yet measured on a GPU. */
enum { GPU_LANES = 4, LARGEST_LANES = 16 };

unsigned ps_engine_lanes(const ps_device_limits *limits, ps_precision precision) {
    const unsigned native =
        precision == PS_SINGLE ? limits->native_float_lanes : limits->native_double_lanes;
    if (native <= 1 || limits->has_dedicated_local_memory) {
        return GPU_LANES;
    }
    unsigned lanes = 1;
    while (lanes * 2 <= native && lanes * 2 <= LARGEST_LANES) {
        lanes *= 2;
    }
    return lanes;
}

bool ps_engine_on_device(const ps_device_limits *limits, ps_precision precision,
                         const char **why_not) {
    if (limits == NULL) {
        *why_not = "needs an OpenCL device";
    } else if (precision == PS_EXTENDED) {
        *why_not = "single and double precision only";
    } else if (precision == PS_DOUBLE && !limits->has_fp64) {
        *why_not = "the device has no double precision";
    } else {
        return true;
    }
    return false;
}

double ps_engine_idle_factor(double groups, const ps_device_limits *limits) {
    const double units = ps_device_typical(limits).single_items;
    return ceil(groups / units) * units / groups;
}

pspec_status ps_batch_go_on(const ps_batch *batch, ps_error *error) {
    return batch->should_stop != NULL && batch->should_stop(batch->payload)
               ? ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted")
               : PSPEC_OK;
}

pspec_status ps_batch_go_on_after(const ps_batch *batch, ps_device *device, ps_error *error) {
    if (batch->should_stop != NULL) {
        PS_TRY(ps_device_finish(device, error));
    }
    return ps_batch_go_on(batch, error);
}

ps_batch ps_batch_part(const ps_batch *batch, size_t first, size_t most) {
    const size_t rest = batch->num_patterns - first;
    ps_batch part = *batch;
    part.num_patterns = rest < most ? rest : most;
    part.patterns += first;
    part.scales = batch->scales != NULL ? batch->scales + first : NULL;
    part.exponents = batch->exponents != NULL ? batch->exponents + first : NULL;
    part.realization += first;
    return part;
}

pspec_pattern ps_pattern_part(const pspec_pattern *whole, size_t first, size_t most) {
    const size_t rest = whole->num_points - first;
    pspec_pattern part = *whole;
    part.num_points = rest < most ? rest : most;
    part.points = whole->points != NULL ? whole->points + first * whole->dimension : NULL;
    part.weights = whole->weights != NULL ? whole->weights + first : NULL;
    return part;
}

ps_batch ps_batch_chunk(const ps_batch *one, size_t first, size_t most, pspec_pattern *part) {
    ps_batch chunk = *one;
    *part = ps_pattern_part(&one->patterns[0], first, most);
    chunk.patterns = part;
    chunk.first_point += first;
    return chunk;
}

size_t ps_batch_longest(const ps_batch *batch) {
    size_t longest = 1;
    for (size_t r = 0; r < batch->num_patterns; r++) {
        const size_t num_points = batch->patterns[r].num_points;
        longest = num_points > longest ? num_points : longest;
    }
    return longest;
}

size_t ps_num_coefficients_at(const ps_frequencies *frequencies) {
    return frequencies->kind == PS_FREQUENCIES_DEGREES
               ? ps_num_coefficients(frequencies->max_frequency)
               : 2 * frequencies->num;
}

size_t ps_num_coefficients(int32_t max_degree) {
    const size_t last = (size_t)max_degree;
    return (last + 1) * (last + 2);
}

unsigned ps_problem_domain(const ps_problem *problem) {
    return problem->frequencies->kind == PS_FREQUENCIES_DEGREES ? PS_ON_SPHERE : PS_ON_TORUS;
}

/* On the sphere white sets are planned for with a margin, since what is above 1 counts there by its
 * square root: the mean of (L + 1)^2 modes, half of them independent, stays within four standard
 * deviations. (torus_nufft has a margin of its own; the other engines of the torus hardly feel it.)
 */
static double white_power(const ps_problem *problem) {
    const double most = 1.5;
    const double num_modes = pow(problem->frequencies->max_frequency + 1.0, 2);
    return ps_problem_domain(problem) == PS_ON_SPHERE ? fmin(most, 1 + 4 * sqrt(2 / num_modes)) : 1;
}

double ps_expected_power(const ps_problem *problem) {
    return problem->expected_power > 0 ? problem->expected_power : white_power(problem);
}

double ps_planned_points(const ps_problem *problem) {
    return (double)(problem->planned_points > 0 ? problem->planned_points : problem->num_points);
}

pspec_status ps_engine_create(const ps_engine *engine, void **state, const ps_problem *problem,
                              ps_precision precision, size_t batch, ps_device *device,
                              ps_error *error) {
    *state = NULL;
    PS_TRY(ps_allocate(state, 1, engine->state_bytes, "an engine", error));
    const pspec_status status = engine->create(*state, problem, precision, batch, device, error);
    if (status != PSPEC_OK) {
        ps_engine_destroy(engine, *state);
        *state = NULL;
    }
    return status;
}

void ps_engine_destroy(const ps_engine *engine, void *state) {
    if (state != NULL) {
        engine->destroy(state);
        free(state);
    }
}

size_t ps_engine_stride(const ps_engine *engine, const void *state, size_t num) {
    return engine->get_stride != NULL ? engine->get_stride(state) : num;
}

void ps_engine_slots(const ps_engine *engine, const void *state, size_t num, uint32_t *slots) {
    if (engine->get_slots != NULL) {
        engine->get_slots(state, slots);
        return;
    }
    for (size_t i = 0; i < num; i++) {
        slots[i] = (uint32_t)i;
    }
}

/* Brings a row to the host, where it is not there; *row is freed by the caller. */
static pspec_status read_row(const ps_rows *rows, ps_device *device, void **row, ps_error *error) {
    const size_t bytes = ps_real_bytes(rows->precision);
    PS_TRY(ps_allocate(row, rows->stride, bytes, "a row of powers", error));
    return ps_buffer_read(device, &rows->device, 0, *row, rows->stride * bytes, error);
}

pspec_status ps_engine_powers(const ps_engine *engine, void *state, const ps_batch *one, size_t num,
                              ps_device *device, double *powers, ps_error *error) {
    ps_rows rows = {0};
    uint32_t *slots = NULL;
    void *row = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(engine->run(state, one, &rows, error));
    PS_TRY(ps_rows_wait(&rows, error));
    PS_TRY_OUT(status, PS_NEW(&slots, num, "slots", error));
    if (rows.host == NULL) {
        PS_TRY_OUT(status, read_row(&rows, device, &row, error));
    }
    ps_engine_slots(engine, state, num, slots);
    for (size_t i = 0; i < num; i++) {
        powers[i] =
            ps_real_at(rows.precision, rows.host != NULL ? (const void *)rows.host : row, slots[i]);
    }
out:
    free(slots);
    free(row);
    return status;
}
