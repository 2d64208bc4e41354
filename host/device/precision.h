/* Precisions in which engines compute. */
#ifndef PS_DEVICE_PRECISION_H
#define PS_DEVICE_PRECISION_H

typedef enum ps_precision {
    PS_SINGLE = 0,  /* float terms, float-pair sums */
    PS_DOUBLE = 1,  /* double terms, double-pair sums */
    PS_EXTENDED = 2 /* long double on the host */
} ps_precision;

const char *ps_precision_name(ps_precision precision);

#endif
