#include "math/morph.h"

#include "shared/sphere_point.h"

#include <math.h>

/* The inverse of the distribution of e^{n(z-1)} with t up to most: t = -ln(1 - (1-z')(1 - e^{-n
 * most}))/n. */
static double polar_of_lobe(double n, double most, double height, double polar) {
    const double v = polar * -expm1(-n * most);
    const double t = v < 0.5 ? -log1p(-v) / n : -log(height + polar * exp(-n * most)) / n;
    return fmin(fmax(t, 0), most);
}

double ps_morph_polar(const ps_morph *morph, double height, double polar) {
    switch (morph->kind) {
    case PS_MORPH_NONE:
        return polar;
    case PS_MORPH_DIFFUSE:
        return polar / (1 + sqrt(height));
    case PS_MORPH_GLOSSY:
        return polar_of_lobe(morph->exponent, 1, height, polar);
    case PS_MORPH_GLOSSY_SPHERE:
        return polar_of_lobe(morph->exponent, 2, height, polar);
    case PS_MORPH_PHONG: {
        /* ln z' with the digits of whichever of the two is small */
        const double logarithm = polar < 0.5 ? log1p(-polar) : log(height);
        return -expm1(logarithm / (morph->exponent + 1));
    }
    }
    return polar;
}

/* The height z itself, where it is small: t alone would lose its digits. */
static double height_of(const ps_morph *morph, double height, double polar) {
    return morph->kind == PS_MORPH_PHONG ? pow(height, 1 / (morph->exponent + 1))
                                         : 1 - ps_morph_polar(morph, height, polar);
}

static void move_to_lobe(const ps_morph *morph, double *point) {
    const double sine = hypot(point[0], point[1]);
    const double polar = sine * sine / (1 + point[2]);
    const double t = ps_morph_polar(morph, point[2], polar);
    const double stretch = sine > 0 ? sqrt(t * (2 - t)) / sine : 0;
    point[2] = height_of(morph, point[2], polar) + 0.0;
    point[0] = point[0] * stretch + 0.0;
    point[1] = point[1] * stretch + 0.0;
}

void ps_morph_points(const ps_morph *morph, size_t num, double *points) {
    if (morph->kind == PS_MORPH_NONE) {
        return;
    }
    for (size_t j = 0; j < num; j++) {
        if (morph->kind == PS_MORPH_DIFFUSE) {
            ps_sphere_point_to_diffuse(points + 3 * j);
        } else {
            move_to_lobe(morph, points + 3 * j);
        }
    }
}
