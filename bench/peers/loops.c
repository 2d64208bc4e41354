/* Loops over realizations that call a peer's plan through pointers to its functions and add up
 * |F|^2, so that neither Python nor numpy is part of what is measured. install.sh compiles this
 * with -O3 -march=native into a library that the .py files beside it load. Sums are in the
 * precision of the modes: the least memory traffic.
 */
#define _POSIX_C_SOURCE 200809L
#include <complex.h>
#include <math.h>
#include <stdint.h>
#include <stddef.h>
#include <time.h>

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* sums[i] += |modes[i]|^2; modes are pairs of real and imaginary parts. */
void accumulate_single(const float *modes, int64_t num_modes, float *sums);
void accumulate_double(const double *modes, int64_t num_modes, double *sums);

/* The realizations first .. first + count - 1 of points[][dimension][num_points] through a plan of
 * finufft, type 1. Returns finufft's error; *accumulating grows by the seconds for |F|^2. */
int finufft_loop_single(void *plan, void *setpts, void *execute, int dimension, int64_t num_points,
                        const float *points, int64_t first, int64_t count, float *weights,
                        float *modes, int64_t num_modes, float *sums, double *accumulating);
int finufft_loop_double(void *plan, void *setpts, void *execute, int dimension, int64_t num_points,
                        const double *points, int64_t first, int64_t count, double *weights,
                        double *modes, int64_t num_modes, double *sums, double *accumulating);

#define DEFINE_LOOPS(REAL, SUFFIX)                                                                 \
    void accumulate_##SUFFIX(const REAL *modes, int64_t num_modes, REAL *sums) {                   \
        for (int64_t i = 0; i < num_modes; i++) {                                                  \
            sums[i] += modes[2 * i] * modes[2 * i] + modes[2 * i + 1] * modes[2 * i + 1];          \
        }                                                                                          \
    }                                                                                              \
                                                                                                   \
    typedef int set_points_##SUFFIX(void *, int64_t, const REAL *, const REAL *, const REAL *,     \
                                    int64_t, const REAL *, const REAL *, const REAL *);            \
    typedef int execute_##SUFFIX(void *, REAL *, REAL *);                                          \
                                                                                                   \
    int finufft_loop_##SUFFIX(void *plan, void *setpts, void *execute, int dimension,              \
                              int64_t num_points, const REAL *points, int64_t first,               \
                              int64_t count, REAL *weights, REAL *modes, int64_t num_modes,        \
                              REAL *sums, double *accumulating) {                                  \
        set_points_##SUFFIX *const set_points = (set_points_##SUFFIX *)setpts;                     \
        execute_##SUFFIX *const run = (execute_##SUFFIX *)execute;                                 \
        for (int64_t r = first; r < first + count; r++) {                                          \
            /* finufft's first coordinate is that of the fastest mode: ours is the last. */        \
            const REAL *axes[3] = {NULL, NULL, NULL};                                              \
            for (int i = 0; i < dimension; i++) {                                                  \
                axes[i] = points + (r * dimension + dimension - 1 - i) * num_points;               \
            }                                                                                      \
            int error =                                                                            \
                set_points(plan, num_points, axes[0], axes[1], axes[2], 0, NULL, NULL, NULL);      \
            error = error > 1 ? error : run(plan, weights, modes);                                 \
            if (error > 1) {                                                                       \
                return error;                                                                      \
            }                                                                                      \
            const double begin = seconds();                                                        \
            accumulate_##SUFFIX(modes, num_modes, sums);                                           \
            *accumulating += seconds() - begin;                                                    \
        }                                                                                          \
        return 0;                                                                                  \
    }

DEFINE_LOOPS(float, single)
DEFINE_LOOPS(double, double)

typedef double *nfft_set_nodes(void *plan, const double *nodes);
typedef double *nfft_adjoint(void *plan);

/* The same with a plan of NFFT, whose weights are set already; points[][num_points][dimension]. */
void nfft_loop(void *plan, void *set_x, void *adjoint, int dimension, int64_t num_points,
               const double *points, int64_t first, int64_t count, int64_t num_modes, double *sums,
               double *accumulating);
void nfft_loop(void *plan, void *set_x, void *adjoint, int dimension, int64_t num_points,
               const double *points, int64_t first, int64_t count, int64_t num_modes, double *sums,
               double *accumulating) {
    for (int64_t r = first; r < first + count; r++) {
        ((nfft_set_nodes *)set_x)(plan, points + r * num_points * dimension);
        const double *const modes = ((nfft_adjoint *)adjoint)(plan);
        const double begin = seconds();
        accumulate_double(modes, num_modes, sums);
        *accumulating += seconds() - begin;
    }
}

/* What one writes first: S(k) for num_frequencies vectors k, one after the other. k.x is reduced
 * exactly but for the rounding of its sum, so this also checks the reference. */
void direct_sums(const double *points, int64_t num_points, int dimension,
                 const int32_t *frequencies, int64_t num_frequencies, double *sums);
void direct_sums(const double *points, int64_t num_points, int dimension,
                 const int32_t *frequencies, int64_t num_frequencies, double *sums) {
    const double two_pi = 6.283185307179586476925286766559;
    for (int64_t m = 0; m < num_frequencies; m++) {
        const int32_t *const k = frequencies + m * dimension;
        double re = 0;
        double im = 0;
        for (int64_t j = 0; j < num_points; j++) {
            double turns = 0;
            for (int i = 0; i < dimension; i++) {
                const double product = k[i] * points[j * dimension + i];
                turns += (product - rint(product)) + fma(k[i], points[j * dimension + i], -product);
            }
            re += cos(two_pi * turns);
            im -= sin(two_pi * turns);
        }
        sums[2 * m] = re;
        sums[2 * m + 1] = im;
    }
}
