/* What variants measure in common when they fill a layout.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_MEASURE_H
#define PS_ENGINES_TORUS_NUFFT_MEASURE_H

#include "engines/torus/nufft/layout.h"

/* Rows in as many lanes as local memory has room for; false: it has no room for one. */
bool ps_nufft_measure_rows(ps_nufft_layout *layout, const ps_problem *problem,
                           const ps_device_limits *limits);
/* Tiles, rows and powers for layout->lanes. */
void ps_nufft_measure_axes(ps_nufft_layout *layout);
/* After num_keys. */
void ps_nufft_set_part_points(ps_nufft_layout *layout, size_t part_points,
                              const ps_device_limits *limits);

/* Realizations at a time whose `each` bytes of work stay in the cache or fill the device, in whole
 * units, no more than there are. */
size_t ps_nufft_fitting_parts(const ps_problem *problem, const ps_device_limits *limits,
                              double each, size_t unit);

/* Points sorted together: on the host, as they came and sorted; where cells, places and points
 * begin, and on GPUs what makes their order. */
uint64_t ps_nufft_part_bytes(const ps_nufft_layout *layout, unsigned dimension);
uint64_t ps_nufft_starts_bytes(const ps_nufft_layout *layout);
/* Whatever the number of points: plans of the axes (twiddles and pattern, gains, positions;
 * polynomials and radices are small). */
uint64_t ps_nufft_table_bytes(const ps_nufft_layout *layout);
uint64_t ps_nufft_largest(const uint64_t *numbers, size_t num);

#endif
