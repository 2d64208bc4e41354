/* Time that only goes forward, in seconds from some moment on. Planning never looks at it. */
#ifndef PS_BASE_CLOCK_H
#define PS_BASE_CLOCK_H

double ps_clock_seconds(void);

#endif
