/* Reading the parameter values of a request, and answers that several samplers share. */
#ifndef PS_SAMPLERS_VALUES_H
#define PS_SAMPLERS_VALUES_H

#include "samplers/sampler.h"

/* choices: words ended by NULL. *choice becomes the index of the word that parameter number
 * i_parameter has as its value; any other value is an error that lists the words. */
pspec_status ps_sampler_choice(const ps_sampler_request *request, unsigned i_parameter,
                               const char *const *choices, unsigned *choice,
                               ps_error *error) PS_MUST_CHECK;

/* The number that a parameter with a range has; 0 where it has none, which no request has that was
 * checked. */
double ps_sampler_number(const ps_sampler_request *request, unsigned i_parameter);

/* Reads "A" or "AxBx..": at most PS_MAX_DIMENSION positive whole numbers. */
bool ps_sampler_counts(const char *text, uint64_t counts[PS_MAX_DIMENSION], unsigned *num_counts);

/* For is_deterministic. */
bool ps_sampler_always(const ps_sampler_request *request);
bool ps_sampler_never(const ps_sampler_request *request);

/* For most_power: that of white noise, which equal strata with a uniform point in each never
 * exceed. */
double ps_sampler_white_power(const ps_sampler_request *request);

/* Refuses more points than limit, for samplers whose indices have a fixed number of digits. */
pspec_status ps_sampler_limit_points(const ps_sampler_request *request, uint64_t limit,
                                     ps_error *error) PS_MUST_CHECK;

#endif
