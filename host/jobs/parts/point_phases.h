/* How long points take: made by samplers, read from files, written into others. */
#ifndef PS_JOBS_PARTS_POINT_PHASES_H
#define PS_JOBS_PARTS_POINT_PHASES_H

#include "plan/phases.h"
#include "points/points.h"
#include "samplers/sampler.h"

/* Of so many realizations of a sampler: the phase "points". */
void ps_phases_sample(ps_phases *phases, const ps_sampler_request *request, double realizations);

/* Of all files, whole: the phase "reading". Returns their points, 0 where that cannot be known. */
double ps_phases_read(ps_phases *phases, const char *const *paths, size_t num_paths,
                      const char *format, unsigned columns);

/* Of so many numbers, coordinates and weights: the phase "writing". format NULL: by the ending of
 * the path. */
void ps_phases_write(ps_phases *phases, const char *path, const char *format, double numbers);

#endif
