/* What an integrand has beyond cut-offs that nobody computed a spectrum up to, for who says which
 * cut-off would do. The energy up to a cut-off is summed where that is affordable, some millions of
 * frequencies or all degrees that there are; beyond that it falls by the power law of its last
 * octave.
 */
#ifndef PS_JOBS_VARIANCE_TAILS_H
#define PS_JOBS_VARIANCE_TAILS_H

#include "integrands/integrand.h"

typedef struct ps_tails ps_tails;

/* Cut-offs are of boxes or degrees, over shells of balls. The integrand must outlive *out, which is
 * freed by ps_tails_destroy. */
pspec_status ps_tails_create(ps_tails **out, const ps_integrand *integrand, bool over_shells,
                             ps_error *error) PS_MUST_CHECK;
void ps_tails_destroy(ps_tails *tails); /* NULL is allowed */

/* The largest cut-off that is summed up to: no more than the reach of the integrand. */
size_t ps_tails_largest_cutoff(const ps_integrand *integrand, bool over_shells);
/* The energy beyond a cut-off. */
double ps_tails_beyond(const ps_tails *tails, double cutoff);
/* The least cut-off, at least 1, beyond which is this energy at most; infinite: there is none. */
double ps_tails_find(const ps_tails *tails, double energy);

#endif
