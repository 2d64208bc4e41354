/* Loops of the sphere: sums over orders, NFSFT through pointers to its functions, and the
 * coefficients as one writes them first. Compiled together with loops.c. Coefficients are those of
 * orders m >= 0, order by order, l = m .. L each, pairs of real and imaginary parts; those of m < 0
 * are their mirror image, since weights are real.
 */
#include <math.h>
#include <stdint.h>

/* sums[l] += sum over m = -l .. l of |c_lm|^2; l <= degree. */
void sum_orders_single(const float *coefficients, int64_t degree, float *sums);
void sum_orders_double(const double *coefficients, int64_t degree, double *sums);

#define DEFINE_SUMS(REAL, SUFFIX)                                                                  \
    void sum_orders_##SUFFIX(const REAL *coefficients, int64_t degree, REAL *sums) {               \
        for (int64_t m = 0; m <= degree; m++) {                                                    \
            const REAL both = m == 0 ? 1 : 2;                                                      \
            for (int64_t i = 0; i <= degree - m; i++) {                                            \
                const REAL re = coefficients[2 * i];                                               \
                const REAL im = coefficients[2 * i + 1];                                           \
                sums[m + i] += both * (re * re + im * im);                                         \
            }                                                                                      \
            coefficients += 2 * (degree - m + 1);                                                  \
        }                                                                                          \
    }

DEFINE_SUMS(float, single)
DEFINE_SUMS(double, double)

/* NFSFT has every order in a row of 2 degree + 2, l = -degree-1 .. degree, the highest order first.
 */
static const double *nfsft_row(const double *f_hat, int64_t degree, int64_t m) {
    return f_hat + 2 * ((2 * degree + 2) * (degree - m + 1) + degree + 1);
}

/* sum_orders_double() of what NFSFT has computed. */
void sum_orders_nfsft(const double *f_hat, int64_t degree, double *sums);
void sum_orders_nfsft(const double *f_hat, int64_t degree, double *sums) {
    for (int64_t m = 0; m <= degree; m++) {
        const double *const row = nfsft_row(f_hat, degree, m);
        const double both = m == 0 ? 1 : 2;
        for (int64_t l = m; l <= degree; l++) {
            sums[l] += both * (row[2 * l] * row[2 * l] + row[2 * l + 1] * row[2 * l + 1]);
        }
    }
}

/* Its coefficients in the order of the others; its Y_lm lack the sign (-1)^m. */
void nfsft_coefficients(const double *f_hat, int64_t degree, double *coefficients);
void nfsft_coefficients(const double *f_hat, int64_t degree, double *coefficients) {
    for (int64_t m = 0; m <= degree; m++) {
        const double *const row = nfsft_row(f_hat, degree, m);
        for (int64_t i = 2 * m; i < 2 * (degree + 1); i++) {
            *coefficients++ = m % 2 == 0 ? row[i] : -row[i];
        }
    }
}

/* The first numbers of the recurrence q_lm = a (z q_{l-1,m} - b q_{l-2,m}), Y_lm = q_lm (x + iy)^m,
 * in the order of coefficients[]: a and b of (l, m), for l = m: q_mm and 0. */
void plain_recurrence(int64_t degree, double *recurrence);
void plain_recurrence(int64_t degree, double *recurrence) {
    double q = sqrt(0.25 / 3.14159265358979323846);
    for (int64_t m = 0; m <= degree; m++) {
        q *= m == 0 ? 1 : -sqrt((2.0 * (double)m + 1) / (2.0 * (double)m));
        *recurrence++ = q;
        *recurrence++ = 0;
        for (int64_t l = m + 1; l <= degree; l++) {
            const double ll = (double)l * (double)l;
            const double mm = (double)m * (double)m;
            const double before = (double)(l - 1) * (double)(l - 1);
            *recurrence++ = sqrt((4 * ll - 1) / (ll - mm));
            *recurrence++ = l == m + 1 ? 0 : sqrt((before - mm) / (4 * before - 1));
        }
    }
}

/* What one writes first: for every point all orders, for every order all degrees. Adds conj(Y_lm)
 * at the points x, y, z to coefficients[]. Beyond degree 1900 or so q_lm overflows at some points.
 */
void plain_coefficients(const double *points, int64_t num_points, int64_t degree,
                        const double *recurrence, double *coefficients);
void plain_coefficients(const double *points, int64_t num_points, int64_t degree,
                        const double *recurrence, double *coefficients) {
    for (int64_t j = 0; j < num_points; j++) {
        const double x = points[3 * j];
        const double y = points[3 * j + 1];
        const double z = points[3 * j + 2];
        const double *next = recurrence;
        double *sum = coefficients;
        double re = 1;
        double im = 0;
        for (int64_t m = 0; m <= degree; m++) {
            double q = next[0];
            double before = 0;
            sum[0] += q * re;
            sum[1] += q * im;
            for (int64_t i = 1; i <= degree - m; i++) {
                const double after = next[2 * i] * (z * q - next[2 * i + 1] * before);
                before = q;
                q = after;
                sum[2 * i] += q * re;
                sum[2 * i + 1] += q * im;
            }
            next += 2 * (degree - m + 1);
            sum += 2 * (degree - m + 1);
            const double real = re * x + im * y;
            im = im * x - re * y;
            re = real;
        }
    }
}

enum { MOST_DEGREE = 4096 };

/* The numbers of plain_recurrence() for one order; returns q_mm. */
static long double exact_recurrence(int64_t degree, int64_t m, long double *a, long double *b) {
    for (int64_t l = m + 1; l <= degree; l++) {
        const long double ll = (long double)l * (long double)l;
        const long double mm = (long double)m * (long double)m;
        const long double before = (long double)(l - 1) * (long double)(l - 1);
        a[l] = sqrtl((4 * ll - 1) / (ll - mm));
        b[l] = l == m + 1 ? 0 : sqrtl((before - mm) / (4 * before - 1));
    }
    long double q = sqrtl(0.25L / 3.14159265358979323846264338327950288L);
    for (int64_t i = 1; i <= m; i++) {
        q *= -sqrtl((2 * (long double)i + 1) / (2 * (long double)i));
    }
    return q;
}

/* c_lm for one m and l = m .. degree <= 4096, as a reference: in long double, whose exponents hold
 * q_lm, of the directions of the points. */
void exact_order(const double *points, int64_t num_points, int64_t degree, int64_t m,
                 double *coefficients);
void exact_order(const double *points, int64_t num_points, int64_t degree, int64_t m,
                 double *coefficients) {
    long double a[MOST_DEGREE + 2];
    long double b[MOST_DEGREE + 2];
    long double sums[MOST_DEGREE + 1][2];
    const long double first = exact_recurrence(degree, m, a, b);
    a[degree + 1] = b[degree + 1] = 0;
    for (int64_t l = m; l <= degree; l++) {
        sums[l][0] = sums[l][1] = 0;
    }
    for (int64_t j = 0; j < num_points; j++) {
        long double x = points[3 * j];
        long double y = points[3 * j + 1];
        long double z = points[3 * j + 2];
        const long double scale = 1 / sqrtl(x * x + y * y + z * z);
        x *= scale;
        y *= scale;
        z *= scale;
        long double re = 1; /* (x - iy)^m */
        long double im = 0;
        for (int64_t i = 0; i < m; i++) {
            const long double real = re * x + im * y;
            im = im * x - re * y;
            re = real;
        }
        long double q = first;
        long double before = 0;
        for (int64_t l = m; l <= degree; l++) {
            sums[l][0] += q * re;
            sums[l][1] += q * im;
            const long double after = a[l + 1] * (z * q - b[l + 1] * before);
            before = q;
            q = after;
        }
    }
    for (int64_t l = m; l <= degree; l++) {
        *coefficients++ = (double)sums[l][0];
        *coefficients++ = (double)sums[l][1];
    }
}
