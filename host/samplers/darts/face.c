#include "samplers/darts/face.h"

#include "math/turns.h"
#include "math/pi.h"

#include <math.h>
#include <stdint.h>

double ps_chord(double angle) {
    double cosine = 0;
    double sine = 0;
    ps_cosine_sine(angle / 4, &cosine, &sine); /* angle/4 is an eighth of a turn at most */
    return 4 * sine * cosine;
}

/* Azimuth: so many eighths of a turn and part of one more, between -1 and 1. Odd eighths by sums
 * before products: gcc 12 makes c a - s b and s a + c b one fused operation on processors that have
 * it, also where that is forbidden. */
static void place(double z, double sine_theta, unsigned eighths, double part, double *vector) {
    const double root_half = 0.70710678118654752440;
    double c = 0;
    double s = 0;
    ps_cosine_sine(part * (PS_PI / 4), &c, &s);
    const double x = eighths % 2 == 0 ? c : (c - s) * root_half;
    const double y = eighths % 2 == 0 ? s : (c + s) * root_half;
    const double cosines[] = {x, -y, -x, y}; /* after so many quarters */
    const double sines[] = {y, x, -y, -x};
    vector[0] = sine_theta * cosines[eighths / 2] + 0.0; /* no -0 */
    vector[1] = sine_theta * sines[eighths / 2] + 0.0;
    vector[2] = z + 0.0;
}

void ps_face_point(unsigned face, double x, double y, double *vector) {
    static const uint8_t eighths[PS_NUM_FACES] = {1, 3, 5, 7, 0, 2, 4, 6, 1, 3, 5, 7};
    const unsigned row = face / 4; /* 0: around the north pole, 2: the south pole */
    const double from_north = (1 - x) + (1 - y);
    const double from_south = x + y;
    if ((row == 0 && from_north < 1) || (row == 2 && from_south < 1)) {
        const double nr = row == 0 ? from_north : from_south;
        const double t = nr * nr / 3; /* 1 - |z| */
        place(row == 0 ? 1 - t : t - 1, sqrt(t * (2 - t)), eighths[face], nr > 0 ? (x - y) / nr : 0,
              vector);
        return;
    }
    const double z = (from_south - row) * 2 / 3;
    place(z, sqrt(1 - z * z), eighths[face], x - y, vector);
}
