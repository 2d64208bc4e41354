/* Plans of Fourier transforms (kernels/nufft/transform/fft.h): lengths without prime factors above
 * 7, the radices of their passes, their twiddle factors, what they cost.
 */
#ifndef PS_ENGINES_NUFFT_FFT_H
#define PS_ENGINES_NUFFT_FFT_H

#include "engines/engine.h"

/* No more passes than factors of 2 in 32 bits, and the 0 that ends them. */
enum { PS_FFT_MAX_PASSES = 32 };

/* The smallest length >= least without prime factors above 7; 0 when that is beyond 32 bits. */
uint32_t ps_fft_length(uint64_t least);

/* The same among lengths that pay: no transform up to a quarter longer is cheaper. */
uint32_t ps_fft_good_length(uint64_t least);

/* Radices of the passes, ended by 0; false when the length has other prime factors (or is 0). */
bool ps_fft_radices(uint32_t length, uint32_t radices[PS_FFT_MAX_PASSES]);

/* How many these are. */
unsigned ps_fft_passes(uint32_t length);

/* Additions and multiplications of one complex transform, as the kernels make them. */
double ps_fft_flops(uint32_t length);

/* Cells times passes. */
double ps_fft_passed(uint32_t length);

/* Cycles of a core for one transform in vectors (cycles.h). */
double ps_fft_cycles(uint32_t length);

/* Cell where the result of frequency k = 0 .. length - 1 stands. */
uint32_t ps_fft_position(uint32_t length, const uint32_t *radices, uint32_t k);

/* [length][cosine, sine] of -2 pi i / length, on the device. */
pspec_status ps_fft_roots_create(ps_buffer *out, uint32_t length, ps_precision precision,
                                 ps_device *device, ps_error *error) PS_MUST_CHECK;

/* On the device, as in kernels/nufft/transform/fft.h: radices, twiddles, position. */
typedef struct ps_fft_plan {
    uint32_t length;
    ps_buffer radices, twiddles, position;
} ps_fft_plan;

/* Arguments of kernels that transform by the plan. */
#define PS_FFT_TABLES(plan)                                                                        \
    PS_BUFFER((plan).radices), PS_BUFFER((plan).twiddles), PS_BUFFER((plan).position)

pspec_status ps_fft_plan_create(ps_fft_plan *out, uint32_t length, ps_precision precision,
                                ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_fft_plan_free(ps_fft_plan *plan);

#endif
