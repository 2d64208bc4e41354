/* How far two answers to the same question are apart, made with other engines, or of other
 * realizations: in units of what their headers announce, so that 1 is what is allowed. Infinite
 * where one has rows that the other lacks. */
#ifndef PS_ANSWERS_COMPARE_H
#define PS_ANSWERS_COMPARE_H

#include "tables/table.h"

/* Tables of power and angular. */
double ps_compare_powers(const ps_table *a, const ps_table *b);
double ps_compare_pair_sums(const ps_table *a, const ps_table *b);
/* The squared worst-case error of the header; rows may be others. */
double ps_compare_rules(const ps_table *a, const ps_table *b);
/* Tables of variance: predictions and measurements, in their standard errors. */
double ps_compare_variances(const ps_table *a, const ps_table *b);
/* Verdicts alone: 0 where both say the same, or one says nothing. */
double ps_compare_verdicts(const ps_table *a, const ps_table *b);

#endif
