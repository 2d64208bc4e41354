#include "points/box.h"

#include <math.h>

/* Edges whose ratios differ by less are equal: files print them with ten digits or more. */
static const double rounding = 1e-9;

bool ps_box_stretch(const ps_box *box, unsigned dimension, double stretch[PS_MAX_DIMENSION]) {
    bool is_cube = true;
    double volume = 1; /* in units of the first axis, as all is here */
    for (unsigned i = 0; i < dimension; i++) {
        volume *= ps_box_edge(box, i) / ps_box_edge(box, 0);
    }
    double cube = pow(volume, 1.0 / dimension);
    /* A step of Newton's: roots that are whole numbers or their inverses come out so. */
    cube -= (cube - volume / pow(cube, dimension - 1.0)) / dimension;
    for (unsigned i = 0; i < dimension; i++) {
        stretch[i] = cube / (ps_box_edge(box, i) / ps_box_edge(box, 0));
        is_cube = is_cube && fabs(stretch[i] - 1) <= rounding;
    }
    for (unsigned i = 0; is_cube && i < dimension; i++) {
        stretch[i] = 1;
    }
    return !is_cube;
}

static bool have_one_shape(const ps_box *a, const ps_box *b, unsigned dimension) {
    double of_a[PS_MAX_DIMENSION];
    double of_b[PS_MAX_DIMENSION];
    bool is_one = true;
    ps_box_stretch(a, dimension, of_a);
    ps_box_stretch(b, dimension, of_b);
    for (unsigned i = 0; i < dimension; i++) {
        is_one = is_one && fabs(of_a[i] / of_b[i] - 1) <= rounding;
    }
    return is_one;
}

void ps_boxes_add(ps_boxes *boxes, const ps_box *box, unsigned dimension) {
    const bool is_first = boxes->dimension == 0;
    if (is_first) {
        *boxes = (ps_boxes){.dimension = dimension, .first = *box};
    }
    for (unsigned i = 0; i < boxes->dimension; i++) {
        const double edge = ps_box_edge(box, i);
        boxes->shortest[i] = is_first ? edge : fmin(edge, boxes->shortest[i]);
        boxes->longest[i] = fmax(edge, boxes->longest[i]);
        boxes->differ = boxes->differ || boxes->shortest[i] < boxes->longest[i];
    }
    boxes->differ_in_shape =
        boxes->differ_in_shape ||
        (boxes->differ && !have_one_shape(box, &boxes->first, boxes->dimension));
}
