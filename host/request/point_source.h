/* Where the points of a question come from: what samplers are asked for, and how files are read. */
#ifndef PS_REQUEST_POINT_SOURCE_H
#define PS_REQUEST_POINT_SOURCE_H

#include "points/points.h"
#include "request/request.h"
#include "samplers/sampler.h"

/* What the sampler of a question is asked for: parsed, options that were not given left open. */
pspec_status ps_sampler_request_read(ps_sampler_request *out, const ps_request *arguments,
                                     size_t question, ps_error *error) PS_MUST_CHECK;
/* Resolves and checks it, and the device that has to make its sets, but for those that are kept. */
pspec_status ps_sampler_request_resolve(ps_sampler_request *out, const ps_request *arguments,
                                        ps_error *error) PS_MUST_CHECK;
/* Both. */
pspec_status ps_sampler_request_make(ps_sampler_request *out, const ps_request *arguments,
                                     size_t question, ps_error *error) PS_MUST_CHECK;

/* Returns how many realizations a sampler makes: as many as were given, or with a standard error
 * alone the most that it may take. */
uint64_t ps_num_realizations_asked(const ps_request *arguments);

/* Refuses several numbers of points for the output of `sample`. */
pspec_status ps_sample_check_counts(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;
/* Refuses weights of a file for several numbers of points. */
pspec_status ps_weights_check_counts(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

/* Refuses questions about no points, and files without a name beside samplers and sets; what:
 * "nothing to take a spectrum of". */
pspec_status ps_sources_check(const ps_request *arguments, const char *what,
                              ps_error *error) PS_MUST_CHECK;

/* Do sets have numbers of points of their own? Those of files do; a caller gives those that are
 * asked for, and so does a program that is told. */
bool ps_request_has_own_counts(const ps_request *arguments);

/* How point files are read. */
ps_point_options ps_point_options_make(const ps_request *arguments);
/* The sentence for an option of jobs that read their input again, or by parts. */
pspec_status ps_programs_refuse(const char *option, ps_error *error);
/* Refuses options about the other of samplers and files, several numbers of points of files, and
 * what does not go together in how files are read. */
pspec_status ps_point_options_check(const ps_request *arguments, ps_error *error) PS_MUST_CHECK;

#endif
