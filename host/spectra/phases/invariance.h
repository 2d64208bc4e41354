/* The phases that are tested: of amplitudes, and of sums of their products (shift_products.h,
 * turn_products.h). */
#ifndef PS_SPECTRA_PHASES_INVARIANCE_H
#define PS_SPECTRA_PHASES_INVARIANCE_H

#include "frequencies/frequencies.h"
#include "spectra/phases/phase_tests.h"

/* What a test is of. */
typedef struct ps_phase_label {
    int32_t k[PS_MAX_DIMENSION]; /* frequency or shift; degree and order */
    bool is_turned;              /* on the sphere: about the x axis instead of z */
    bool is_product;             /* of sums of products instead of amplitudes */
    unsigned axes;               /* of products on the torus: bits of ps_shift_family */
    int32_t reach;               /* of products on the torus */
} ps_phase_label;

typedef struct ps_invariance ps_invariance;

/* How many phases a set has, of frequencies that need not be enumerated. */
size_t ps_invariance_count(const ps_frequencies *set);

/* For frequencies that are enumerated and outlive it. Amplitudes have this error. */
pspec_status ps_invariance_create(ps_invariance **out, const ps_frequencies *set,
                                  double amplitude_error, ps_error *error) PS_MUST_CHECK;
void ps_invariance_destroy(ps_invariance *invariance);

/* labels[ps_invariance_count] */
void ps_invariance_label(const ps_invariance *invariance, bool is_turned, ps_phase_label *labels);

/* Sets that are taken at a time. */
size_t ps_invariance_sets(const ps_invariance *invariance);
/* Adds the phases of so many sets, or fewer, from number `first` on, to tests[ps_invariance_count].
 * The amplitudes of all sets are as ps_power_job.kept has them: on the torus S(0) comes first
 * in each. */
void ps_invariance_add(ps_invariance *invariance, size_t num_sets, const double *all_amplitudes,
                       size_t first, ps_phase_test *tests);

#endif
