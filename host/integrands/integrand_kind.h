/* What the files of the integrands share. Private to host/integrands. */
#ifndef PS_INTEGRANDS_INTEGRAND_KIND_H
#define PS_INTEGRANDS_INTEGRAND_KIND_H

#include "integrands/integrand.h"
#include "math/pi.h"

#include <math.h>

extern const ps_integrand_kind ps_integrand_ball, ps_integrand_box, ps_integrand_half_plane,
    ps_integrand_gaussian, ps_integrand_wave, ps_integrand_constant;

/* Reads a finite number with least <= x <= most; key is its parameter. */
pspec_status ps_integrand_number(const ps_integrand *integrand, const char *key, const char *text,
                                 double least, double most, double *out,
                                 ps_error *error) PS_MUST_CHECK;
/* Reads one number for each dimension, "0.5x0.25", or one for all. */
pspec_status ps_integrand_vector(const ps_integrand *integrand, const char *key, const char *text,
                                 double least, double most, double *out,
                                 ps_error *error) PS_MUST_CHECK;
/* The member values, from NAME_value of kernels/integrands/NAME.h, which is compiled for doubles
 * here: PRECISION 64 stands before it. */
#define PS_INTEGRAND_VALUES(value)                                                                 \
    static void values(const ps_integrand *self, const double *points, size_t num, double *out) {  \
        const unsigned dimension = self->place.dimension;                                          \
        for (size_t i = 0; i < num; i++) {                                                         \
            out[i] = value(points + i * dimension, dimension, self->numbers);                      \
        }                                                                                          \
    }

/* Calls add for every image of x with |x_i + n_i| <= 3/2, which are all that may lie nearer than 1.
 */
void ps_integrand_images(const double *x, unsigned dimension,
                         void (*add)(void *payload, const double *image), void *payload);

/* |k| */
double ps_integrand_norm(const int32_t *k, unsigned dimension);

/* PSPEC_ERROR_INVALID_ARGUMENT: "integrand disk: radius=0.7: " and the sentence. */
pspec_status ps_integrand_fail(const ps_integrand *integrand, const char *key, const char *text,
                               const char *why, ps_error *error);

#endif
