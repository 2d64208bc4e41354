#include "points/columns.h"

#include "base/wide.h"
#include "files/decimal.h"
#include "math/lift.h"
#include "math/morph.h"
#include "math/pi.h"
#include "math/unit_vector.h"

#include <math.h>
#include <string.h>

/* Angles may exceed their range by what rounding to 7 digits does. */
static const double ANGLE_SLACK = 1e-6;

static const double HALF_TURN = 180; /* degrees */

/* ---- what is accepted -------------------------------------------------------------------- */

/* Reduces *coordinate mod 1 to [0,1); false when it is not finite. */
static bool wrap(double *coordinate) {
    if (!isfinite(*coordinate)) {
        return false;
    }
    const double reduced = *coordinate - floor(*coordinate);
    *coordinate = reduced < 1 ? reduced : 0; /* -1e-20 rounds to 1, which is 0 on the torus */
    return true;
}

/* Are all values in [0,1)? In that range bits grow with the number, so the sign of a difference of
 * whole numbers tells, and compilers make vectors of that; -0 counts as bad here. */
PS_WIDE_BODY(bool, are_inside, (const double *values, size_t count)) {
    const uint64_t last_inside = 0x3FEFFFFFFFFFFFFF; /* the largest double below 1 */
    uint64_t signs = 0;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits = 0;
        memcpy(&bits, values + i, sizeof bits);
        signs |= bits | (last_inside - bits);
    }
    return signs >> 63 == 0;
}
PS_WIDE(bool, are_inside, (const double *values, size_t count), (values, count))

/* A row is looked at before any of it is changed: what is refused is shown as the file has it. */
static size_t accept_box(unsigned dimension, const ps_point_options *options, double *values,
                         size_t num) {
    const ps_box *const box = &options->box;
    for (size_t i = 0; i < num; i++) {
        double *const row = values + i * dimension;
        for (unsigned j = 0; j < dimension; j++) {
            if (!ps_box_holds(box, j, row[j]) && !(options->wrap && isfinite(row[j]))) {
                return i;
            }
        }
        for (unsigned j = 0; j < dimension; j++) {
            const unsigned interval = ps_box_interval(box, j);
            row[j] = ps_box_scale(row[j], box->low[interval], box->high[interval]);
            if (!(row[j] >= 0 && row[j] < 1)) {
                wrap(&row[j]);
            }
        }
    }
    return num;
}

/* Nearly always all are good. */
static size_t accept_torus(unsigned dimension, const ps_point_options *options, double *values,
                           size_t num) {
    const bool wraps = options->wrap;
    const size_t count = num * dimension;
    if (options->box.num_axes > 0) {
        return accept_box(dimension, options, values, num);
    }
    const bool are_good = are_inside(values, count);
    for (size_t i = 0; !are_good && i < count; i++) {
        const bool is_inside = values[i] >= 0 && values[i] < 1;
        if (!is_inside && !(wraps && wrap(&values[i]))) {
            return i / dimension;
        }
    }
    return num;
}

/* Divides a vector by its length; what is a unit vector to the last bits stays as it is. */
static bool normalize(double *vector) {
    const double rounding = 4 * 2.220446049250313e-16;
    double largest = 0;
    if (fabs(ps_square_length(vector) - 1) <= rounding) {
        return true;
    }
    for (int axis = 0; axis < 3; axis++) {
        if (!isfinite(vector[axis])) {
            return false;
        }
        largest = fmax(largest, fabs(vector[axis]));
    }
    if (largest == 0) {
        return false;
    }
    int exponent = 0;
    frexp(largest, &exponent); /* so that no square overflows or vanishes */
    for (int axis = 0; axis < 3; axis++) {
        vector[axis] = ldexp(vector[axis], -exponent);
    }
    const double length = sqrt(ps_square_length(vector));
    for (int axis = 0; axis < 3; axis++) {
        vector[axis] /= length;
    }
    return true;
}

/* Without a way out, which compilers make more of. */
static bool are_unit_vectors(const double *vectors, size_t num) {
    bool are_good = true;
    for (size_t i = 0; i < num; i++) {
        are_good &= ps_is_unit_vector(vectors + 3 * i);
    }
    return are_good;
}

/* Nearly always all are good. */
static size_t accept_vectors(bool normalizes, double *vectors, size_t num) {
    const bool are_good = !normalizes && are_unit_vectors(vectors, num);
    for (size_t i = 0; !are_good && i < num; i++) {
        if (normalizes ? !normalize(vectors + 3 * i) : !ps_is_unit_vector(vectors + 3 * i)) {
            return i;
        }
    }
    return num;
}

/* theta or the latitude, and phi or the longitude, within their ranges. */
static bool are_angles(ps_angle_order order, bool in_degrees, const double *row) {
    const double half = in_degrees ? HALF_TURN : PS_PI;
    if (order == PS_LON_LAT) {
        return fabs(row[0]) <= 2 * half + ANGLE_SLACK && fabs(row[1]) <= half / 2 + ANGLE_SLACK;
    }
    const double theta = row[order == PS_PHI_THETA];
    const double phi = row[order != PS_PHI_THETA];
    return theta >= -ANGLE_SLACK && theta <= half + ANGLE_SLACK &&
           fabs(phi) <= 2 * half + ANGLE_SLACK;
}

/* Is the point of this row of the sphere below the horizon? */
static bool is_below_horizon(const ps_layout *layout, const double *row) {
    if (layout->lift != PS_NO_LIFT) { /* z = 2x - 1 on the sphere, x being in [0,1) or wrapped */
        return layout->lift == PS_LIFT_TO_SPHERE && row[0] - floor(row[0]) < 0.5;
    }
    switch (layout->angles) {
    case PS_LON_LAT:
        return row[1] < 0;
    case PS_THETA_PHI:
    case PS_PHI_THETA:
        return layout->in_degrees ? row[layout->angles == PS_PHI_THETA] > HALF_TURN / 2
                                  : cos(row[layout->angles == PS_PHI_THETA]) < 0;
    case PS_NO_ANGLES:
        break;
    }
    return row[2] < 0;
}

static size_t accept_sphere(const ps_layout *layout, const ps_point_options *options,
                            const double *rows, double *points, size_t num) {
    const unsigned columns = ps_layout_columns(layout);
    if (layout->angles == PS_NO_ANGLES) {
        return accept_vectors(options->normalize_vectors, points, num);
    }
    for (size_t i = 0; i < num; i++) {
        if (!are_angles(layout->angles, layout->in_degrees, rows + i * columns)) {
            return i;
        }
    }
    return num;
}

/* Pairs at the beginning of the array become vectors, up to the first that is none of the plane. */
static size_t accept_lifted(const ps_layout *layout, const ps_point_options *options,
                            double *points, size_t num) {
    const bool on_hemisphere = layout->lift == PS_LIFT_TO_HEMISPHERE;
    const size_t good = accept_torus(2, options, points, num);
    ps_sphere_lift(on_hemisphere, 0, good, points);
    if (on_hemisphere) {
        ps_morph_points(&options->morph, good, points);
    }
    return good;
}

size_t ps_columns_accept(const ps_layout *layout, const ps_point_options *options,
                         const double *rows, double *points, size_t num) {
    if (layout->coordinates == PS_TORUS_COORDINATES) {
        return accept_torus(layout->dimension, options, points, num);
    }
    const size_t good = layout->lift != PS_NO_LIFT
                            ? accept_lifted(layout, options, points, num)
                            : accept_sphere(layout, options, rows, points, num);
    for (size_t i = 0; options->above_horizon && i < good; i++) {
        if (is_below_horizon(layout, rows + i * ps_layout_columns(layout))) {
            return i;
        }
    }
    return good;
}

size_t ps_weights_accept(const double *weights, size_t num) {
    size_t i = 0;
    while (i < num && isfinite(weights[i])) {
        i++;
    }
    return i;
}

/* ---- what is not ------------------------------------------------------------------------- */

static const char *show_number(char text[PS_DECIMAL_BYTES], double value) {
    ps_decimal_format(text, value);
    return text;
}

/* Within a period of the torus: what lies further out is hardly a point that left it, and reduced
 * it says nothing. */
static bool is_near(double coordinate) {
    return coordinate >= -1 && coordinate < 2;
}

/* Azimuth, polar angle and a weight, as tables of quadrature rules have them? */
static bool may_be_degrees(const double *row) {
    return are_angles(PS_PHI_THETA, true, row) && !are_angles(PS_PHI_THETA, false, row) &&
           row[2] > 0 && row[2] < 1;
}

static pspec_status refuse_torus(const ps_layout *layout, const ps_point_options *options,
                                 const char *where, const double *row, ps_error *error) {
    const bool has_box = options->box.num_axes > 0;
    char text[PS_DECIMAL_BYTES];
    for (unsigned j = 0; j < layout->dimension; j++) { /* first, for nothing else would help */
        if (!isfinite(row[j])) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s: coordinate %s is not a finite number",
                           where, show_number(text, row[j]));
        }
    }
    for (unsigned j = 0; has_box && j < layout->dimension; j++) {
        if (!ps_box_holds(&options->box, j, row[j]) && !options->wrap) {
            const unsigned interval = ps_box_interval(&options->box, j);
            char ends[2][PS_DECIMAL_BYTES];
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: coordinate %s is outside [%s,%s) of --box; --wrap would reduce it",
                           where, show_number(text, row[j]),
                           show_number(ends[0], options->box.low[interval]),
                           show_number(ends[1], options->box.high[interval]));
        }
    }
    for (unsigned j = 0; !has_box && j < layout->dimension; j++) {
        const bool is_inside = row[j] >= 0 && row[j] < 1;
        if (!is_inside && !options->wrap) {
            const bool is_vector = layout->dimension >= 3 && ps_is_unit_vector(row);
            const bool may_be_weight = !layout->has_own_box && j > 0 &&
                                       j + 1 == layout->dimension && !layout->has_weight_column &&
                                       options->dimension == 0;
            const bool may_be_angles =
                options->domain == PS_DOMAIN_ANY && layout->dimension == 3 && may_be_degrees(row);
            return ps_fail(
                error, PSPEC_ERROR_INPUT, "%s: coordinate %s is outside [0,1)%s; %s%s", where,
                show_number(text, row[j]), layout->has_own_box ? " of the box" : "",
                may_be_angles ? "are these degrees? --columns phi-theta-w:degrees"
                : is_vector   ? "a unit vector? Points of the torus are meant here"
                : is_near(row[j]) || layout->has_own_box
                    ? "--wrap would reduce it mod 1"
                    : "in other units? --box X0,X1 takes [X0,X1) to it",
                may_be_weight && !is_vector && !may_be_angles ? " (a weight? --weights column)"
                                                              : "");
        }
    }
    return PSPEC_OK;
}

static pspec_status refuse_vector(const ps_layout *layout, const ps_point_options *options,
                                  const char *where, const double *row, ps_error *error) {
    char text[3][PS_DECIMAL_BYTES];
    for (int axis = 0; axis < 3; axis++) {
        show_number(text[axis], row[axis]);
    }
    double vector[3] = {row[0], row[1], row[2]};
    const bool has_direction = normalize(vector);
    if (!layout->by_shape && !layout->has_weight_column && may_be_degrees(row)) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: (%s, %s, %s) is not a unit vector; are these degrees? --columns "
                       "phi-theta-w:degrees (of vectors --normalize-vectors would make unit ones)",
                       where, text[0], text[1], text[2]);
    }
    return ps_fail(
        error, PSPEC_ERROR_INPUT, "%s: (%s, %s, %s) %s%s", where, text[0], text[1], text[2],
        has_direction ? "is not a unit vector; --normalize-vectors would divide it by "
                        "its length"
                      : "has no direction",
        layout->by_shape ? "; --transpose reads other points, --columns theta-phi-w rows of angles"
        : has_direction && options->domain == PS_DOMAIN_ANY
            ? "; for points of the torus say --domain torus"
            : "");
}

/* What angles in this order should be, in radians or in degrees. */
static const char *describe_ranges(const ps_layout *layout) {
    if (layout->angles == PS_LON_LAT) {
        return "longitude and latitude in degrees (up to 360 and 90)";
    }
    if (layout->angles == PS_THETA_PHI) {
        return layout->in_degrees ? "theta (0 to 180) and phi (up to 360), in degrees"
                                  : "theta (0 to pi) and phi (up to 2 pi)";
    }
    return layout->in_degrees ? "phi (up to 360) and theta (0 to 180), in degrees"
                              : "phi (up to 2 pi) and theta (0 to pi)";
}

static pspec_status refuse_angles(const ps_layout *layout, const char *where, const double *row,
                                  ps_error *error) {
    char text[2][PS_DECIMAL_BYTES];
    ps_layout degrees = *layout;
    degrees.in_degrees = true;
    const bool may_be_degrees = !layout->in_degrees && are_angles(layout->angles, true, row);
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s, %s are not %s%s%s", where,
                   show_number(text[0], row[0]), show_number(text[1], row[1]),
                   describe_ranges(layout), may_be_degrees ? "; are these degrees? --columns " : "",
                   may_be_degrees ? ps_layout_name(&degrees) : "");
}

pspec_status ps_columns_refuse(const ps_layout *layout, const ps_point_options *options,
                               const char *where, const double *row, ps_error *error) {
    if (layout->lift != PS_NO_LIFT) {
        const ps_layout plane = {.dimension = 2, .has_weight_column = layout->has_weight_column};
        PS_TRY(refuse_torus(&plane, options, where, row, error));
    } else if (layout->coordinates == PS_TORUS_COORDINATES) {
        PS_TRY(refuse_torus(layout, options, where, row, error));
    } else if (layout->angles != PS_NO_ANGLES &&
               !are_angles(layout->angles, layout->in_degrees, row)) {
        return refuse_angles(layout, where, row, error);
    } else if (layout->angles == PS_NO_ANGLES) {
        double vector[3] = {row[0], row[1], row[2]};
        if (accept_vectors(options->normalize_vectors, vector, 1) == 0) {
            return refuse_vector(layout, options, where, row, error);
        }
    }
    char text[PS_DECIMAL_BYTES];
    if (options->above_horizon && layout->coordinates != PS_TORUS_COORDINATES &&
        is_below_horizon(layout, row)) {
        const bool is_vector = layout->angles == PS_NO_ANGLES && layout->lift == PS_NO_LIFT;
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %s%s is below the horizon, where this BRDF is 0; "
                       "--drop-below-horizon leaves such points out",
                       where, is_vector ? "z = " : "a direction",
                       is_vector ? show_number(text, row[2]) : "");
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: weight %s is not a finite number", where,
                   show_number(text, row[ps_layout_columns(layout) - 1]));
}
