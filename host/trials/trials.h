/* Estimates of an integral from sets of points that are moved at random, many times each:
 *
 *     torus        I = (1/W)    sum_j w_j F(x_j + tau mod 1)
 *     sphere       I = (4 pi/W) sum_j w_j F(R u_j)
 *     hemisphere   I = (2 pi/W) sum_j w_j F(+-R u_j), the sign so that z >= 0
 *
 * W is the sum of the weights. On a device by integrands/values.cl where the integrand has a kernel
 * header, else on the host; sums have a fixed order, which does not depend on the batch, on what
 * else is in it, on work-groups or threads.
 */
#ifndef PS_TRIALS_TRIALS_H
#define PS_TRIALS_TRIALS_H

#include "device/precision.h"
#include "engines/engine.h"
#include "integrands/integrand.h"
#include "pointspec/pointspec.h"

typedef struct ps_trials_options {
    /* Of coordinates and values on the device; integrands/values.cl says what single costs. On the
     * host they are doubles. */
    ps_precision precision;
    size_t batch;       /* most sets at a time on the device */
    size_t most_points; /* of a set */
    size_t num_trials;  /* of each set */
    bool makes_points;  /* the device, of batches that have `sets` */
} ps_trials_options;

typedef struct ps_trials ps_trials;

/* Borrows the integrand and the device. On the host where the device is NULL, where it has no
 * doubles and they are asked for, where the integrand has no kernel, and where its bytes are more
 * than the device gives at a time. */
pspec_status ps_trials_create(ps_trials **out, const ps_integrand *integrand,
                              const ps_trials_options *options, ps_device *device,
                              ps_error *error) PS_MUST_CHECK;
void ps_trials_destroy(ps_trials *trials); /* NULL is allowed */
bool ps_trials_is_on_device(const ps_trials *trials);
/* Would they be? */
bool ps_trials_fit_device(const ps_integrand *integrand, ps_precision precision,
                          const ps_device *device);
/* Bytes of what such trials take, on the device and the host, with the table of the integrand, but
 * for patterns, moves and estimates. */
double ps_trials_bytes(const ps_integrand *integrand, const ps_trials_options *options,
                       const ps_device *device);

enum { PS_ROTATION_NUMBERS = 9 };

/* Numbers of a move: those of tau in [0,1), or of R, row by row. */
static inline size_t ps_trials_move_numbers(const ps_integrand *integrand) {
    return integrand->place.where == PS_SAMPLES_TORUS ? integrand->place.dimension
                                                      : PS_ROTATION_NUMBERS;
}

/* estimates[num_patterns][num_trials]; moves [num_patterns][num_trials][numbers of a move], NULL:
 * points stay where they are. Of the batch patterns count, and sets with realization. Coordinates
 * are in [0,1), or unit vectors: who gives them has checked it. Sets of another dimension, of no
 * points or more than were announced, and with weights that are 0 together are
 * PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_trials_run(ps_trials *trials, const ps_batch *batch, const double *moves,
                           double *estimates, ps_error *error) PS_MUST_CHECK;

#endif
