/* Point sets in the order of cells (kernels/nufft/place.h). */
#ifndef PS_ENGINES_TORUS_NUFFT_PLACES_H
#define PS_ENGINES_TORUS_NUFFT_PLACES_H

#include "engines/torus/nufft/layout.h"
#include "engines/torus/torus_points.h"

typedef struct ps_nufft_places {
    const ps_nufft_layout *layout;
    ps_device *device;
    unsigned dimension;
    ps_torus_points points;
    size_t num_points;    /* that were uploaded */
    ps_kernel *sort;      /* or keys, where there is an order */
    ps_nufft_order order; /* on GPUs */
    uint64_t *host_places;
    ps_buffer places, sorted, heights, starts;
} ps_nufft_places;

/* layout is borrowed. */
pspec_status ps_nufft_places_create(ps_nufft_places *out, const ps_nufft_layout *layout,
                                    unsigned dimension, ps_precision precision, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
void ps_nufft_places_free(ps_nufft_places *places);

/* Every pattern has at most layout->part_points points; at most layout->parts of them. */
pspec_status ps_nufft_places_upload(ps_nufft_places *places, const ps_batch *parts,
                                    ps_error *error) PS_MUST_CHECK;
/* Sorts what was uploaded by the cells or boxes of the layout. */
pspec_status ps_nufft_places_sort(ps_nufft_places *places, size_t num_parts,
                                  ps_error *error) PS_MUST_CHECK;

#endif
