/* K. Shoemake, "Uniform random rotations", Graphics Gems III, 1992: two independent angles, and
 * radii whose squares are u and 1 - u, make a uniform point of the unit sphere in four dimensions;
 * a uniform unit quaternion is a uniform rotation. */
#include "math/random/rotation.h"

#include "math/turns.h"

#include <math.h>

/* In long double, since every vector inherits the errors of the matrix. */
ps_rotation ps_rotation_of_quaternion(double w, double x, double y, double z) {
    const long double q[4] = {w, x, y, z};
    const long double s = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    ps_rotation rotation = {{{0}}};
    for (unsigned i = 0; i < 3; i++) { /* j and k follow i in the cycle of the axes */
        const unsigned j = (i + 1) % 3;
        const unsigned k = (i + 2) % 3;
        const long double along = q[1 + i] * q[1 + j];
        const long double across = q[0] * q[1 + k];
        const long double others = q[1 + j] * q[1 + j] + q[1 + k] * q[1 + k];
        rotation.matrix[i][i] = (double)(1 - s * others);
        rotation.matrix[i][j] = (double)(s * (along - across));
        rotation.matrix[j][i] = (double)(s * (along + across));
    }
    return rotation;
}

/* In double; each entry of a pair is one fused operation, where compilers might fuse one of two. */
static ps_rotation portable_of_quaternion(const double q[4]) {
    const double s = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    ps_rotation rotation = {{{0}}};
    for (unsigned i = 0; i < 3; i++) {
        const unsigned j = (i + 1) % 3;
        const unsigned k = (i + 2) % 3;
        const double across = q[0] * q[1 + k];
        const double others = q[1 + j] * q[1 + j] + q[1 + k] * q[1 + k];
        rotation.matrix[i][i] = 1 - s * others;
        rotation.matrix[i][j] = s * fma(q[1 + i], q[1 + j], -across);
        rotation.matrix[j][i] = s * fma(q[1 + i], q[1 + j], across);
    }
    return rotation;
}

static void draw_quaternion(ps_random *random, double q[4]) {
    const double u = ps_random_uniform(random);
    const ps_turns first = ps_turns_of(ps_random_uniform(random));
    const ps_turns second = ps_turns_of(ps_random_uniform(random));
    const double a = sqrt(u);
    const double b = sqrt(1 - u);
    ps_turns_cosine_sine(first, &q[0], &q[1]);
    ps_turns_cosine_sine(second, &q[2], &q[3]);
    q[0] *= a;
    q[1] *= a;
    q[2] *= b;
    q[3] *= b;
}

ps_rotation ps_rotation_random(ps_random *random) {
    double q[4];
    draw_quaternion(random, q);
    return ps_rotation_of_quaternion(q[0], q[1], q[2], q[3]);
}

ps_rotation ps_rotation_random_portable(ps_random *random) {
    double q[4];
    draw_quaternion(random, q);
    return portable_of_quaternion(q);
}

void ps_rotate(const ps_rotation *rotation, double *vectors, size_t num_vectors) {
    const double(*const m)[3] = rotation->matrix;
    for (size_t j = 0; j < num_vectors; j++) {
        double *const v = vectors + 3 * j;
        const double x = v[0];
        const double y = v[1];
        const double z = v[2];
        for (unsigned i = 0; i < 3; i++) {
            v[i] = m[i][0] * x + m[i][1] * y + m[i][2] * z;
        }
    }
}
