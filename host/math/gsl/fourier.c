#include "math/gsl/fourier.h"

#include "math/gsl/fence.h"

#include <gsl/gsl_fft_complex.h>
#include <stdbool.h>

/* GSL refuses no length that is a power of two. */
void ps_fourier(double *numbers, size_t num, int sign) {
    ps_gsl_enter();
    gsl_fft_complex_radix2_transform(numbers, 1, num,
                                     sign > 0 ? gsl_fft_backward : gsl_fft_forward);
    ps_gsl_leave();
}

/* A length that is a product of small primes takes num log(num) steps, any other up to num^2. */
pspec_status ps_fourier_lines(double *numbers, size_t num, size_t num_lines, ps_error *error) {
    ps_gsl_enter();
    gsl_fft_complex_wavetable *const table = gsl_fft_complex_wavetable_alloc(num);
    gsl_fft_complex_workspace *const work = gsl_fft_complex_workspace_alloc(num);
    for (size_t i = 0; table != NULL && work != NULL && i < num_lines; i++) {
        gsl_fft_complex_forward(numbers + 2 * num * i, 1, num, table, work);
    }
    const bool has_room = table != NULL && work != NULL;
    if (table != NULL) {
        gsl_fft_complex_wavetable_free(table);
    }
    if (work != NULL) {
        gsl_fft_complex_workspace_free(work);
    }
    ps_gsl_leave();
    return has_room ? PSPEC_OK
                    : ps_fail(error, PSPEC_ERROR_MEMORY,
                              "no memory for Fourier transforms of %zu numbers", num);
}
