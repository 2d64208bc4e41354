#include "points/columns.h"

#include "math/pi.h"
#include "math/turns.h"

#include <math.h>
#include <string.h>

static const double DEGREE = PS_PI / 180;

/* ---- rows to points ---------------------------------------------------------------------- */

/* Sine and cosine of degrees, exact at multiples of 90: reducing degrees is exact, reducing radians
 * is not. */
static void turn_degrees(double degrees, double *sine, double *cosine) {
    int quarters = 0;
    const double rest = remquo(degrees, 90, &quarters) * DEGREE;
    ps_turns_add_quarters((unsigned)quarters, cos(rest), sin(rest), cosine, sine);
}

static void make_vector(double sin_theta, double cos_theta, double sin_phi, double cos_phi,
                        double *vector) {
    vector[0] = sin_theta * cos_phi;
    vector[1] = sin_theta * sin_phi;
    vector[2] = cos_theta;
}

static void angles_to_vector(const ps_layout *layout, const double *row, double *vector) {
    const double theta = row[layout->angles != PS_THETA_PHI]; /* or the latitude */
    const double phi = row[layout->angles == PS_THETA_PHI];
    double sin_theta = 0;
    double cos_theta = 0;
    double sin_phi = 0;
    double cos_phi = 0;
    if (!layout->in_degrees) {
        make_vector(sin(theta), cos(theta), sin(phi), cos(phi), vector);
        return;
    }
    turn_degrees(phi, &sin_phi, &cos_phi);
    turn_degrees(theta, &sin_theta, &cos_theta);
    if (layout->angles == PS_LON_LAT) {
        make_vector(cos_theta, sin_theta, sin_phi, cos_phi, vector);
    } else {
        make_vector(sin_theta, cos_theta, sin_phi, cos_phi, vector);
    }
}

static void angles_to_angles(const ps_layout *layout, const double *row, double *angles) {
    const double unit = layout->in_degrees ? DEGREE : 1;
    const double theta = row[layout->angles != PS_THETA_PHI]; /* or the latitude */
    angles[0] = (layout->angles == PS_LON_LAT ? 90 - theta : theta) * unit;
    angles[1] = row[layout->angles == PS_THETA_PHI] * unit;
}

void ps_columns_split(const ps_layout *layout, const double *rows, size_t num, double *points,
                      double *weights) {
    const unsigned columns = ps_layout_columns(layout);
    /* pairs come first: lifting makes vectors of them */
    const unsigned d = layout->lift != PS_NO_LIFT ? 2 : layout->dimension;
    for (size_t i = 0; i < num; i++, rows += columns, points += d) {
        if (layout->angles == PS_NO_ANGLES) {
            for (unsigned j = 0; j < d; j++) {
                points[j] = rows[j];
            }
        } else if (layout->coordinates == PS_ANGLES) {
            angles_to_angles(layout, rows, points);
        } else {
            angles_to_vector(layout, rows, points);
        }
        if (weights != NULL) {
            weights[i] = rows[columns - 1];
        }
    }
}

/* ---- points to rows ---------------------------------------------------------------------- */

static void vector_to_angles(const double *vector, double *angles) {
    angles[0] = atan2(hypot(vector[0], vector[1]), vector[2]);
    angles[1] = atan2(vector[1], vector[0]);
    if (angles[1] < 0) {
        angles[1] += PS_TWO_PI;
    }
}

static void write_angles(const ps_layout *layout, const double *angles, double *row) {
    const double unit = layout->in_degrees ? DEGREE : 1;
    const double theta = angles[0] / unit;
    row[layout->angles != PS_THETA_PHI] = layout->angles == PS_LON_LAT ? 90 - theta : theta;
    row[layout->angles == PS_THETA_PHI] = angles[1] / unit;
}

static void join_point(const ps_layout *layout, ps_coordinates source, const double *point,
                       double *row) {
    if (layout->angles == PS_NO_ANGLES && source == PS_ANGLES) {
        angles_to_vector(&(ps_layout){.angles = PS_THETA_PHI}, point, row);
    } else if (layout->angles == PS_NO_ANGLES) {
        memcpy(row, point, layout->dimension * sizeof *row);
    } else if (source == PS_ANGLES) {
        write_angles(layout, point, row);
    } else {
        double angles[2];
        vector_to_angles(point, angles);
        write_angles(layout, angles, row);
    }
}

void ps_columns_join(const ps_layout *layout, ps_coordinates source, const double *points,
                     const double *weights, size_t num, double *rows) {
    const unsigned columns = ps_layout_columns(layout);
    const unsigned d = source == PS_ANGLES ? 2 : source == PS_UNIT_VECTORS ? 3 : layout->dimension;
    for (size_t i = 0; i < num; i++) {
        join_point(layout, source, points + i * d, rows + i * columns);
        if (layout->has_weight_column) {
            rows[i * columns + columns - 1] = weights[i];
        }
    }
}
