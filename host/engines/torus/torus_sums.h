/* Sums over a list of frequencies on the device and, for products, the table of their cosines and
 * sines: the first pass of torus_direct.
 */
#ifndef PS_ENGINES_TORUS_TORUS_SUMS_H
#define PS_ENGINES_TORUS_TORUS_SUMS_H

#include "engines/torus/torus_layout.h"
#include "engines/torus/torus_points.h"

typedef struct ps_torus_sums {
    size_t num, num_tiles, num_chunks, table_points;
    size_t weighted_tiles; /* tiles of the table that carry the weights */
    unsigned dimension, lanes;
    size_t real_bytes;
    bool has_table;
    ps_kernel *list, *fold, *power;
    ps_buffer frequencies, sums, totals, table;
} ps_torus_sums;

/* What kernels of a job are compiled with. */
ps_defines ps_torus_defines(const ps_torus_layout *layout, unsigned dimension);

/* vectors: [num][dimension], whole tiles of lanes except at the end. Where the layout has a table
 * it is filled, too, weights in the first weighted_tiles. */
pspec_status ps_torus_sums_create(ps_torus_sums *out, const ps_torus_layout *layout,
                                  unsigned dimension, size_t num, const int32_t *vectors,
                                  size_t batch, size_t group, size_t weighted_tiles,
                                  ps_device *device, ps_error *error) PS_MUST_CHECK;
void ps_torus_sums_free(ps_torus_sums *sums);

/* Arithmetic of a cosine and a sine and their sums. */
double ps_torus_phase_flops(unsigned dimension, size_t real_bytes);

/* Sums of the uploaded slab, chunk by chunk, for rows first_row .. , and its table. num_points: of
 * all patterns in the slab, for the profile. */
pspec_status ps_torus_sums_add(ps_torus_sums *sums, const ps_torus_points *points, size_t first_row,
                               size_t num_patterns, size_t num_points, ps_device *device,
                               ps_error *error) PS_MUST_CHECK;

/* Adds the chunks of rows first_row .. up into their totals, which are begun anew when is_first. */
pspec_status ps_torus_sums_fold(ps_torus_sums *sums, size_t first_row, size_t num_rows,
                                bool is_first, ps_device *device, ps_error *error) PS_MUST_CHECK;

/* Writes |S|^2 of the frequencies into slots first_slot .. of the first num_rows rows of powers. */
pspec_status ps_torus_sums_power(ps_torus_sums *sums, const ps_buffer *scales,
                                 const ps_buffer *power, size_t first_slot, size_t stride,
                                 size_t num_rows, ps_device *device, ps_error *error) PS_MUST_CHECK;

#endif
