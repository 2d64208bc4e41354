#include "rules/truncation.h"

#include "base/memory.h"
#include "rules/worst_case_error.h"
#include "samplers/sphere/spherical_fibonacci.h"

#include <math.h>
#include <stdlib.h>

pspec_status ps_fibonacci_rule(double **out, size_t num_points, ps_morph morph, ps_error *error) {
    PS_TRY(ps_allocate_for(out, num_points, 3 * sizeof(double), "points", error));
    ps_fibonacci_points(0, num_points, 2 * (uint64_t)num_points, *out);
    ps_morph_points(&morph, num_points, *out);
    return PSPEC_OK;
}

pspec_status ps_fibonacci_error(const ps_representer *representer, const ps_morph *morph,
                                size_t num_points, double *out, ps_error *error) {
    double *points = NULL;
    ps_kernel_error found = {0};
    PS_TRY(ps_fibonacci_rule(&points, num_points, *morph, error));
    const ps_rule rule = {num_points, points, NULL};
    const pspec_status status =
        ps_kernel_error_of(representer, &rule, NULL, NULL, NULL, &found, error);
    free(points);
    *out = sqrt(fmax(found.squared, found.bound));
    return status;
}

static pspec_status find_error(const ps_equal_error *self, size_t num_points, double *out,
                               ps_error *error) {
    return self->error_of != NULL
               ? self->error_of(self->payload, num_points, out, error)
               : ps_fibonacci_error(self->representer, &self->morph, num_points, out, error);
}

/* Where the line through two points of the logarithms has the target. */
static double interpolate(const double num[2], const double errors[2], double target) {
    const double share = log(errors[0] / target) / log(errors[0] / errors[1]);
    return num[0] * pow(num[1] / num[0], share);
}

/* Between a rung that is too small and one that is not: two more errors near the answer. */
static pspec_status refine(const ps_equal_error *equal_error, double num[2], double errors[2],
                           double target, double *out, ps_error *error) {
    enum { STEPS = 2 };
    *out = interpolate(num, errors, target);
    for (int step = 0; step < STEPS; step++) {
        const double middle = nearbyint(*out);
        double found = 0;
        if (!(middle > num[0] && middle < num[1])) {
            break;
        }
        PS_TRY(find_error(equal_error, (size_t)middle, &found, error));
        const int end = found <= target;
        num[end] = middle;
        errors[end] = found;
        *out = interpolate(num, errors, target);
    }
    return PSPEC_OK;
}

pspec_status ps_equal_error_points(ps_equal_error *equal_error, double target, double *num_points,
                                   ps_error *error) {
    *num_points = NAN;
    for (int i = 0; i < PS_EQUAL_ERROR_RUNGS; i++) {
        if (equal_error->ladder[i] == 0) {
            PS_TRY(find_error(equal_error, (size_t)1 << i, &equal_error->ladder[i], error));
        }
        if (equal_error->ladder[i] <= target) {
            double num[2] = {exp2(i - 1), exp2(i)};
            double errors[2] = {i > 0 ? equal_error->ladder[i - 1] : 0, equal_error->ladder[i]};
            *num_points = 1;
            return i > 0 ? refine(equal_error, num, errors, target, num_points, error) : PSPEC_OK;
        }
    }
    return PSPEC_OK;
}
