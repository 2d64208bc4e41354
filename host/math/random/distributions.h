/* Probabilities behind the comparison of two averages (spectra/compare.h). */
#ifndef PS_MATH_RANDOM_DISTRIBUTIONS_H
#define PS_MATH_RANDOM_DISTRIBUTIONS_H

/* X and Y independent gamma variables of mean 1 and shapes a and b, so that X / Y has the F
 * distribution with 2a and 2b degrees of freedom: the z with P(X / Y <= x / y) = Phi(z), Phi that
 * of the normal distribution. x, y >= 0, not both 0; a, b > 0.
 *
 * By the saddlepoint r + log(u / r) / r, whose tails are right to 10 % for a = b = 1 and to 1 %
 * from a = b = 10 on, at any distance from the middle and for any size of the shapes, where sums
 * and continued fractions end. Equal arguments are 0, infinite or 0 ones +-infinity. */
double ps_gamma_ratio_score(double x, double a, double y, double b);

/* The score z >= 0 with P(|X| >= z) = probability, X normal; at least that of 1e-300. */
double ps_normal_score(double probability);

/* P(|T| >= score), T of Student's distribution with that many degrees of freedom > 0, whole or
 * not. */
double ps_student_two_sided(double score, double degrees_of_freedom);

/* The score >= 0 whose probability that is, 0 < probability < 1, to 7 digits; at most 1e6. */
double ps_student_score(double probability, double degrees_of_freedom);

#endif
