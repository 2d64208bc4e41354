#include "engines/sphere/nufft/tables.h"

#include "base/memory.h"
#include "device/reals.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* ---- gains and turns ---------------------------------------------------------------------- */

/* 1 / the window's transform at frequency k. */
static double inverse_of(const ps_nufft_axis *axis, size_t k) {
    return 1 / ps_nufft_window_transform(&axis->window, (long double)k / axis->n);
}

static pspec_status create_around_gains(ps_buffer *out, const ps_sphere_shape *shape,
                                        ps_precision precision, ps_device *device,
                                        ps_error *error) {
    const ps_nufft_axis *axis = &shape->axis;
    const size_t num = (size_t)shape->max_degree + 1;
    double *gains = NULL;
    PS_TRY(PS_NEW(&gains, 3 * num, "gains", error));
    for (size_t k = 0; k < num; k++) {
        const double inverse = inverse_of(axis, k);
        const long double angle = PS_TWO_PI_L * k / axis->n;
        gains[3 * k] = inverse / 2;
        gains[3 * k + 1] = (double)(-inverse / 2 * sinl(angle));
        gains[3 * k + 2] = (double)(-inverse / 2 * cosl(angle));
    }
    const pspec_status status =
        ps_reals_upload(device, out, precision, gains, 3 * num, "gains", error);
    free(gains);
    return status;
}

static pspec_status create_along_gains(ps_buffer *out, const ps_sphere_shape *shape,
                                       ps_precision precision, ps_device *device, ps_error *error) {
    const size_t num = (size_t)shape->max_degree + 1;
    double *gains = NULL;
    PS_TRY(PS_NEW(&gains, num, "gains", error));
    for (size_t k = 0; k < num; k++) {
        gains[k] = inverse_of(&shape->axis, k) / 2 / shape->rings;
    }
    const pspec_status status = ps_reals_upload(device, out, precision, gains, num, "gains", error);
    free(gains);
    return status;
}

pspec_status ps_sphere_turns_create(ps_buffer *out, uint32_t n, uint32_t num,
                                    ps_precision precision, ps_device *device, ps_error *error) {
    double *turns = NULL;
    PS_TRY(PS_NEW(&turns, 2 * (size_t)num, "turns", error));
    for (uint32_t j = 0; j < num; j++) {
        const long double angle = PS_TWO_PI_L * j / n;
        turns[2 * (size_t)j] = (double)cosl(angle);
        turns[2 * (size_t)j + 1] = (double)-sinl(angle);
    }
    const pspec_status status =
        ps_reals_upload(device, out, precision, turns, 2 * (size_t)num, "turns", error);
    free(turns);
    return status;
}

/* ---- Lambda_mm --------------------------------------------------------------------------- */

/* value 2^(-PS_SPHERE_SCALE scale), scale >= 0 and value at least 2^-PS_SPHERE_SCALE, or zero. */
typedef struct scaled {
    long double value;
    int32_t scale;
} scaled;

static scaled multiply(scaled a, long double factor) {
    a.value *= factor;
    if (a.value != 0 && fabsl(a.value) < ldexpl(1, -PS_SPHERE_SCALE)) {
        a.value = ldexpl(a.value, PS_SPHERE_SCALE);
        a.scale++;
    }
    return a;
}

/* The norm of Lambda_mm over that of Lambda_{m-1,m-1}, with its sign. */
static long double ratio(int32_t m) {
    return -sqrtl((2 * (long double)m + 1) / (2 * (long double)m));
}

/* Numbers of the host, on their way to the device. */
typedef struct host_tables {
    double *starts, *steps, *ratios, *cosines, *distances, *squares;
    int32_t *start_scales, *step_scales;
    size_t num_starts, num_rings, num_orders;
} host_tables;

static void fill_ring(host_tables *host, const ps_sphere_shape *shape, uint32_t ring) {
    const uint32_t at = shape->ring_lead + ring;
    const long double angle = PS_TWO_PI_L * ring / shape->rings;
    const long double sine = sinl(angle);
    const long double cosine = cosl(angle);
    const long double half = sinl(angle / 2);
    scaled start = {sqrtl(1 / PS_FOUR_PI_L), 0};
    scaled step = {1, 0};
    for (int32_t m = 0; m < PS_SPHERE_GROUPS; m++) {
        start = m > 0 ? multiply(start, ratio(m) * sine) : start;
        step = multiply(step, sine);
        host->starts[(size_t)m * host->num_rings + at] = (double)start.value;
        host->start_scales[(size_t)m * host->num_rings + at] = start.scale;
    }
    host->steps[at] = (double)step.value;
    host->step_scales[at] = step.scale;
    host->cosines[at] = (double)cosine;
    host->distances[at] = (double)(2 * half * half);
    host->squares[at] = (double)(at < shape->crossing ? -sine * sine : cosine * cosine);
}

static void fill_ratios(host_tables *host) {
    for (size_t m = 0; m < host->num_orders; m++) {
        long double product = 1;
        for (size_t i = 0; i < PS_SPHERE_GROUPS && i < m; i++) {
            product *= ratio((int32_t)(m - i));
        }
        host->ratios[m] = (double)product;
    }
}

static pspec_status upload_all(ps_sphere_starts *self, const host_tables *host, ps_device *device,
                               ps_error *error) {
    const size_t starts = host->num_starts * sizeof(double);
    const size_t rings = host->num_rings * sizeof(double);
    static const char what[] = "a table of the sphere";
    const size_t orders = host->num_orders * sizeof(double);
    PS_TRY(ps_buffer_upload(device, &self->starts, host->starts, starts, what, error));
    PS_TRY(
        ps_buffer_upload(device, &self->start_scales, host->start_scales, starts / 2, what, error));
    PS_TRY(ps_buffer_upload(device, &self->steps, host->steps, rings, what, error));
    PS_TRY(ps_buffer_upload(device, &self->step_scales, host->step_scales, rings / 2, what, error));
    PS_TRY(ps_buffer_upload(device, &self->cosines, host->cosines, rings, what, error));
    PS_TRY(ps_buffer_upload(device, &self->distances, host->distances, rings, what, error));
    PS_TRY(ps_buffer_upload(device, &self->squares, host->squares, rings, what, error));
    return ps_buffer_upload(device, &self->ratios, host->ratios, orders, what, error);
}

pspec_status ps_sphere_starts_create(ps_sphere_starts *out, const ps_sphere_shape *shape,
                                     ps_device *device, ps_error *error) {
    host_tables host = {.num_starts = (size_t)PS_SPHERE_GROUPS * shape->ring_pitch,
                        .num_rings = shape->ring_pitch,
                        .num_orders = (size_t)shape->max_degree + 1};
    const size_t reals = host.num_starts + 4 * host.num_rings + host.num_orders;
    const size_t scales = host.num_starts + host.num_rings;
    PS_TRY(PS_NEW(&host.starts, reals + scales, "tables of the sphere", error));
    host.steps = host.starts + host.num_starts;
    host.distances = host.steps + host.num_rings;
    host.cosines = host.distances + host.num_rings;
    host.squares = host.cosines + host.num_rings;
    host.ratios = host.squares + host.num_rings;
    host.start_scales = (int32_t *)(host.ratios + host.num_orders);
    host.step_scales = host.start_scales + host.num_starts;
    for (uint32_t ring = 0; ring < shape->num_rings; ring++) {
        fill_ring(&host, shape, ring);
    }
    fill_ratios(&host);
    const pspec_status status = upload_all(out, &host, device, error);
    free(host.starts);
    return status;
}

void ps_sphere_starts_free(ps_sphere_starts *starts) {
    PS_BUFFERS_RELEASE(&starts->starts, &starts->start_scales, &starts->steps, &starts->step_scales,
                       &starts->ratios, &starts->cosines, &starts->distances, &starts->squares);
    *starts = (ps_sphere_starts){0};
}

ring_numbers ps_sphere_ring_numbers(const ps_sphere_shape *shape, bool only_even) {
    return (ring_numbers){.polar = shape->polar,
                          .crossing = shape->crossing,
                          .equatorial = shape->equatorial,
                          .L = (uint32_t)shape->max_degree,
                          .only_even = only_even,
                          .num_rings = shape->ring_lead + shape->num_rings,
                          .lead = shape->ring_lead,
                          .ring_pitch = shape->ring_pitch,
                          .block = shape->block};
}

/* ---- all --------------------------------------------------------------------------------- */

pspec_status ps_sphere_tables_create(ps_sphere_tables *out, const ps_sphere_shape *shape,
                                     double tolerance, ps_precision precision, ps_device *device,
                                     ps_error *error) {
    *out = (ps_sphere_tables){0};
    PS_TRY(
        ps_nufft_plan_create(&out->plan, &shape->axis, false, tolerance, precision, device, error));
    if (shape->route == PS_SPHERE_ON_GPU) {
        return PSPEC_OK; /* whose transforms have their own */
    }
    PS_TRY(ps_fft_plan_create(&out->halves, shape->axis.n / 2, precision, device, error));
    return create_around_gains(&out->around_gains, shape, precision, device, error);
}

void ps_sphere_tables_free(ps_sphere_tables *tables) {
    ps_buffer_release(&tables->around_gains);
    ps_nufft_plan_free(&tables->plan);
    ps_fft_plan_free(&tables->halves);
    *tables = (ps_sphere_tables){0};
}

pspec_status ps_sphere_ring_tables_create(ps_sphere_ring_tables *out, const ps_sphere_shape *shape,
                                          ps_precision precision, ps_device *device,
                                          ps_error *error) {
    const uint32_t n = shape->axis.n;
    *out = (ps_sphere_ring_tables){0};
    PS_TRY(ps_fft_plan_create(&out->transforms, shape->rings / 2, precision, device, error));
    PS_TRY(ps_sphere_turns_create(&out->turns, n, n / 2, precision, device, error));
    PS_TRY(ps_sphere_turns_create(&out->ring_turns, shape->rings, shape->num_rings, precision,
                                  device, error));
    PS_TRY(create_along_gains(&out->along_gains, shape, precision, device, error));
    return ps_sphere_starts_create(&out->starts, shape, device, error);
}

void ps_sphere_ring_tables_free(ps_sphere_ring_tables *tables) {
    PS_BUFFERS_RELEASE(&tables->turns, &tables->ring_turns, &tables->along_gains);
    ps_fft_plan_free(&tables->transforms);
    ps_sphere_starts_free(&tables->starts);
    *tables = (ps_sphere_ring_tables){0};
}
