/* Parts of point sets in the order of cells, with the windows and phases that spreading needs
 * (kernels/nufft/place.h).
 */
#ifndef PS_ENGINES_NUFFT_PLACES_H
#define PS_ENGINES_NUFFT_PLACES_H

#include "engines/nufft_layout.h"
#include "engines/nufft_plan.h"
#include "engines/torus_points.h"

typedef struct ps_nufft_places {
    const ps_nufft_layout *layout;
    const ps_nufft_plan *plans; /* of the axes */
    ps_device *device;
    unsigned dimension;
    ps_torus_points points;
    cl_kernel sort, place, window;
    uint64_t *host_places;
    ps_buffer places, order, previous, starts, along, phases;
    ps_buffer cells[PS_NUFFT_MAX_AXES], windows[PS_NUFFT_MAX_AXES];
} ps_nufft_places;

/* layout and plans are borrowed. */
pspec_status ps_nufft_places_create(ps_nufft_places *out, const ps_nufft_layout *layout,
                                    const ps_nufft_plan *plans, unsigned dimension,
                                    ps_precision precision, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
void ps_nufft_places_free(ps_nufft_places *places);

/* Every pattern is a part of at most layout->part_points; at most layout->parts of them. */
pspec_status ps_nufft_places_make(ps_nufft_places *places, const ps_batch *parts,
                                  ps_error *error) PS_MUST_CHECK;

#endif
