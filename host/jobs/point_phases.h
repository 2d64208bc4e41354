/* How long points take: made by samplers, read from files, written into others. */
#ifndef PS_JOBS_POINT_PHASES_H
#define PS_JOBS_POINT_PHASES_H

#include "plan/phases.h"
#include "points/points.h"
#include "sets/sets.h"

/* Adds the phase "points": so many realizations of a sampler are made, or read where they are
 * kept. */
void ps_phases_sample(ps_phases *phases, const ps_sampler_request *request, double realizations,
                      const ps_sets_options *options);

/* Adds the phase "reading": all files are read whole; given sets are there already. Returns their
 * number of points, 0 where that cannot be known. */
double ps_phases_read(ps_phases *phases, const char *const *paths, size_t num_paths,
                      const ps_point_options *options, unsigned columns);

/* Adds the phase "writing": so many coordinates and weights are written. format NULL: by the ending
 * of the path. */
void ps_phases_write(ps_phases *phases, const char *path, const char *format, double numbers);

#endif
