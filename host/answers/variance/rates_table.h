/* --rates: how fast variances fall as N grows, and from which N on a sampler is better than
 * another (jobs/variance/rates.h). */
#ifndef PS_ANSWERS_VARIANCE_RATES_TABLE_H
#define PS_ANSWERS_VARIANCE_RATES_TABLE_H

#include "jobs/variance/log_variance.h"
#include "tables/table.h"

/* The exponent that the header of such a table has, and its error; nan: none. sampler "": the only
 * one. */
ps_uncertain ps_rates_find(const ps_table *table, const char *sampler, const char *integrand);

#endif
