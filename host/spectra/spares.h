/* Large arrays of spectra that are no longer needed, for the next ones: fresh memory of a spectrum
 * of millions of frequencies costs a fifth of the time of one set (docs/developer/performance.md).
 * An estimator has them, and so has every spectrum made by it, which may outlive it. They are in no
 * plan: what a memory limit leaves beside a plan is the most that is kept. Any thread may take and
 * give.
 */
#ifndef PS_SPECTRA_SPARES_H
#define PS_SPECTRA_SPARES_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ps_spares ps_spares;

/* most_bytes: of all arrays that are kept at a time. */
pspec_status ps_spares_create(ps_spares **out, uint64_t most_bytes, ps_error *error) PS_MUST_CHECK;
/* One owner more; NULL stays NULL. */
ps_spares *ps_spares_share(ps_spares *spares);
/* One owner less; the last one frees what is kept. */
void ps_spares_leave(ps_spares *spares);
/* The same, and frees it at once: from now on nothing is kept for the other owners. */
void ps_spares_close(ps_spares *spares);
/* Of the arrays that are kept now. */
uint64_t ps_spares_bytes(ps_spares *spares);

/* Allocates as PS_NEW does, but with anything in it, where an array of this size was given. spares
 * may be NULL. */
#define PS_TAKE(spares, pointer, count, what, error)                                               \
    ps_spares_take((spares), (pointer), (count), sizeof **(pointer), (what), (error))
pspec_status ps_spares_take(ps_spares *spares, void *pointer, size_t count, size_t element_bytes,
                            const char *what, ps_error *error) PS_MUST_CHECK;
/* Takes over an array of so many bytes, or frees it. */
void ps_spares_give(ps_spares *spares, void *array, size_t bytes);

#endif
