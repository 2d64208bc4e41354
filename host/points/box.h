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

/* The length of an axis, which is 1 where there is no box. */
static inline double ps_box_edge(const ps_box *box, unsigned axis) {
    const unsigned i = ps_box_interval(box, axis);
    return box->num_axes > 0 ? box->high[i] - box->low[i] : 1;
}

/* (x - low) / (high - low); what lies below the upper end stays below 1. */
static inline double ps_box_scale(double x, double low, double high) {
    const double last_inside = 1 - 0x1p-53;
    const double scaled = (x - low) / (high - low);
    return x < high && scaled >= 1 ? last_inside : scaled;
}

/* Edges of the cube of the same volume, each in units of the axis: what frequencies of the unit
 * cell are multiplied by to be those of the box. false: it is a cube, and they are all 1. */
bool ps_box_stretch(const ps_box *box, unsigned dimension, double stretch[PS_MAX_DIMENSION]);

/* Boxes of sets that come one after the other; {0}: none has come. */
typedef struct ps_boxes {
    unsigned dimension;
    ps_box first;
    double shortest[PS_MAX_DIMENSION], longest[PS_MAX_DIMENSION]; /* edges of every axis */
    bool differ;                                                  /* in an edge */
    bool differ_in_shape;                                         /* in ratios of edges */
} ps_boxes;

/* One that came before changes nothing. */
void ps_boxes_add(ps_boxes *boxes, const ps_box *box, unsigned dimension);

#endif
