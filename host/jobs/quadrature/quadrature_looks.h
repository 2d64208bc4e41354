/* When a quadrature job has enough realizations for the standard error that was asked for. */
#ifndef PS_JOBS_QUADRATURE_QUADRATURE_LOOKS_H
#define PS_JOBS_QUADRATURE_QUADRATURE_LOOKS_H

#include "spectra/sequential.h"
#include "spectra/sums.h"

/* Keys of looks: degrees are 0 .. L. */
enum { PS_LOOK_AT_E2 = -1, PS_LOOK_AT_NOTHING = -2 };

/* What is looked at after so many realizations, the numbers above which it must be `least`: E^2
 * itself, and e_l^2 of the degrees that matter. Means over the same realizations. */
typedef struct ps_quadrature_sums {
    size_t num_degrees;
    const ps_sums *degrees; /* [num_degrees][stride] */
    size_t stride;
    const ps_sums *squared; /* E^2 */
} ps_quadrature_sums;

ps_sequential_look ps_quadrature_look(const ps_quadrature_sums *sums, double least,
                                      uint64_t num_realizations);
/* "E^2", "e_l^2 of degree 3", or "nothing above the tolerance". */
void ps_quadrature_look_name(char *text, size_t size, const ps_sequential_look *look);

#endif
