/* Where realizations come from: a sampler, or point files one after the other.
 *
 * A source yields point sets in order. It can be rewound unless it reads standard input.
 */
#ifndef PS_JOB_SOURCE_H
#define PS_JOB_SOURCE_H

#include "io/points.h"
#include "samplers/sampler.h"

#include <stdint.h>

typedef struct ps_source ps_source;

/* The sampler's realizations 0 .. num_realizations - 1; request is copied. */
pspec_status ps_source_sampler(ps_source **out, const ps_sampler_request *request,
                               uint64_t num_realizations, ps_error *error) PS_MUST_CHECK;

/* All sets of all files; paths and options are kept and must outlive the source. */
pspec_status ps_source_files(ps_source **out, const char *const *paths, size_t num_paths,
                             const ps_point_options *options, ps_error *error) PS_MUST_CHECK;

/* The next set, or *has_set false. */
pspec_status ps_source_next(ps_source *source, ps_point_set *set, bool *has_set,
                            ps_error *error) PS_MUST_CHECK;
bool ps_source_can_rewind(const ps_source *source);
pspec_status ps_source_rewind(ps_source *source, ps_error *error) PS_MUST_CHECK;
/* Formats and columns of the files read so far, "npy, csv", or "". */
const char *ps_source_format(const ps_source *source);
const char *ps_source_columns(const ps_source *source);
void ps_source_destroy(ps_source *source);

#endif
