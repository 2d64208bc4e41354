#include "math/gsl/fourier.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_fft_complex.h>

/* GSL refuses no length that is a power of two. */
void ps_fourier(double *numbers, size_t num, int sign) {
    ps_gsl_enter();
    gsl_fft_complex_radix2_transform(numbers, 1, num,
                                     sign > 0 ? gsl_fft_backward : gsl_fft_forward);
    ps_gsl_leave();
}
