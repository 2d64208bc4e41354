/* A box around points of the torus: coordinates of [low, high) become those of [0,1). */
#ifndef PS_POINTS_BOX_H
#define PS_POINTS_BOX_H

#include "math/dimension.h"

#include <stdbool.h>

/* Intervals, of every axis alike or axis by axis. */
typedef struct ps_box {
    unsigned num_axes; /* that have an interval of their own; 1: it is that of all; 0: no box */
    double low[PS_MAX_DIMENSION], high[PS_MAX_DIMENSION];
} ps_box;

/* Which interval an axis has. */
static inline unsigned ps_box_interval(const ps_box *box, unsigned axis) {
    return box->num_axes > 1 ? axis : 0;
}

static inline bool ps_box_holds(const ps_box *box, unsigned axis, double coordinate) {
    const unsigned i = ps_box_interval(box, axis);
    return coordinate >= box->low[i] && coordinate < box->high[i];
}

/* (x - low) / (high - low); what lies below the upper end stays below 1. */
static inline double ps_box_scale(double x, double low, double high) {
    const double last_inside = 1 - 0x1p-53;
    const double scaled = (x - low) / (high - low);
    return x < high && scaled >= 1 ? last_inside : scaled;
}

#endif
