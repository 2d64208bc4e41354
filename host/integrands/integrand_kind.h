/* What the files of the integrands share. Private to host/integrands. */
#ifndef PS_INTEGRANDS_INTEGRAND_KIND_H
#define PS_INTEGRANDS_INTEGRAND_KIND_H

#include "integrands/integrand.h"
#include "math/pi.h"

#include <math.h>

extern const ps_integrand_kind ps_integrand_ball, ps_integrand_box, ps_integrand_half_plane,
    ps_integrand_gaussian, ps_integrand_wave, ps_integrand_constant, ps_integrand_coefficients,
    ps_integrand_pixels, ps_integrand_cap, ps_integrand_harmonic, ps_integrand_square,
    ps_integrand_lobe, ps_integrand_diffuse, ps_integrand_glossy, ps_integrand_phong,
    ps_integrand_zonal, ps_integrand_map;

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
/* sin(pi k/n)/(pi k/n) of n pixels along a side, 0 at multiples of n. */
double ps_integrand_sinc(int32_t k, size_t side);

/* Where the zonal integrands are, and their parameter: an axis, "0x0x1", of any length but 0. On
 * the hemisphere it is z. */
#define PS_INTEGRAND_ROUND                                                                         \
    (PS_INTEGRAND_ON(PS_SAMPLES_SPHERE) | PS_INTEGRAND_ON(PS_SAMPLES_HEMISPHERE))
#define PS_INTEGRAND_AXIS                                                                          \
    { "axis", "0x0x1", "a direction, as 1x2x2; of the hemisphere z" }
pspec_status ps_integrand_axis(const ps_integrand *integrand, const char *text, double *axis,
                               ps_error *error) PS_MUST_CHECK;
bool ps_integrand_is_on_hemisphere(const ps_integrand *integrand);

/* From F_l0 of a zonal F, which is 0 below the horizon where it is of the hemisphere, to what the
 * member zonal has: of the hemisphere those of the even extension, 2 F_l0 at even l. */
void ps_integrand_extend(const ps_integrand *integrand, size_t max_degree, double *f);
/* The members degrees and coefficients of kinds that have zonal. */
pspec_status ps_integrand_zonal_degrees(const ps_integrand *integrand, size_t max_degree,
                                        double *powers, ps_error *error) PS_MUST_CHECK;
pspec_status ps_integrand_zonal_coefficients(const ps_integrand *integrand, size_t max_degree,
                                             double *out, ps_error *error) PS_MUST_CHECK;

/* sin and cos of half the angle g >= 0 whose cosine is x. */
typedef struct ps_half_angle {
    double sine, cosine;
} ps_half_angle;
ps_half_angle ps_integrand_half_angle(double x);

/* cosh n - sinh(n)/n, times 2 e^-n, a factor of the energy of exp(n (z - 1)). */
double ps_integrand_lobe_spread(double n);
/* C(cos g) of exp(n (z - 1)) on the whole sphere (docs/mathematics/integrands_sphere.md#lobes). */
double ps_integrand_lobe_correlation(double n, double x);
/* The member reach of exp(n (z - 1)) on the whole sphere, and of its even extension on the
 * hemisphere from PS_UNCUT_LOBE on. */
double ps_integrand_lobe_reach(double n);

/* PSPEC_ERROR_INVALID_ARGUMENT: "integrand disk: radius=0.7: " and the sentence. */
pspec_status ps_integrand_fail(const ps_integrand *integrand, const char *key, const char *text,
                               const char *why, ps_error *error);

#endif
