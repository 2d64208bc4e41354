/* GSL ends the process at an error unless its handler, one for the process, is switched off. Every
 * call of GSL stands between these two.
 */
#ifndef PS_MATH_GSL_FENCE_H
#define PS_MATH_GSL_FENCE_H

/* The first of all threads inside switches the handler off, the last one out puts back the one that
 * was there. Calls may be nested. */
void ps_gsl_enter(void);
void ps_gsl_leave(void);

#endif
