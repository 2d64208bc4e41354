/* Numbers that stand for value 2^(-100 scale), scale >= 0, since sin^m(theta) underflows. Where the
 * scale is more than 0 a number is taken for zero. Device only.
 */
#ifndef PS_SPHERE_SCALES_H
#define PS_SPHERE_SCALES_H

/* 2^-100 is far below what counts in either precision, and a normal number in both. Numbers grow by
 * a factor of 2^8 at most from degree to degree (g_l at l = m + 1 = 2^15), so it is enough to look
 * every few degrees. */
#define SCALE_DOWN 7.888609052210118e-31 /* 2^-100 */
#define SCALE_UP 1.2676506002282294e30   /* 2^100 */
#define DEGREES_BETWEEN_LOOKS 4

/* value 2^(-100 s) with value in [2^-100, 1], from a product of two of them. */
static inline void normalize(double *value, int *scale) {
    if (*value != 0 && fabs(*value) < SCALE_DOWN) {
        *value *= SCALE_UP;
        *scale += 1;
    }
}

#endif
