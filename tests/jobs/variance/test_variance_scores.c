/* The z-scores of measured against predicted variances, of seventy cases with seeds of their own,
 * are as standard normal numbers: neither is biased, and both errors are right. */
#include "harness_variance.h"

#include <math.h>
#include <stdio.h>

static ps_device *device;

typedef struct kind {
    const char *sampler, *integrand;
    size_t num_points[3]; /* 0: none */
    uint64_t num_realizations, num_shifts;
} kind;

/* Squares of few trials are skewed, and their error is small where they are: 400 sets have a score
 * below -4.6 in one of some thousand cases. So a thousand sets, or some dozen
 * expensive ones that are shifted often. */
static const kind kinds[] = {
    {"white", "disk", {16, 64, 300}, 1000, 1},
    {"white", "gaussian", {16, 64}, 1000, 1},
    {"white", "wave:k=2x1", {50}, 1000, 1},
    {"white", "half-plane", {30, 128}, 1000, 1},
    {"jittered", "disk", {16, 64, 256}, 1000, 1},
    {"jittered", "gaussian", {16, 64, 256}, 1000, 1},
    {"jittered", "box:sides=0.4x0.3", {36, 144}, 1000, 1},
    {"jittered", "half-plane", {64, 256}, 1000, 1},
    {"latin-hypercube", "disk", {16, 100}, 1000, 1},
    {"latin-hypercube", "gaussian", {64}, 1000, 1},
    {"sobol:scramble=owen", "disk", {16, 64, 256}, 1000, 1},
    {"sobol:scramble=owen", "gaussian", {64}, 1000, 1},
    {"sobol:scramble=xor", "disk", {64}, 1000, 1},
    {"larcher-pillichshammer:scramble=owen", "box", {64}, 1000, 1},
    {"halton", "disk", {64, 100}, 1000, 1},
    {"hammersley", "gaussian", {16}, 1000, 1},
    {"regular", "disk", {16}, 1000, 1},
    {"poisson-disk", "disk", {64, 256}, 200, 4},
    {"poisson-disk", "gaussian", {64, 256}, 200, 4},
    {"poisson-disk", "half-plane", {100}, 200, 4},
    {"bridson", "disk", {64}, 200, 4},
    {"bridson", "gaussian", {100}, 200, 4},
    {"bnot", "disk", {64, 256}, 24, 40},
    {"bnot", "gaussian", {64}, 24, 40},
    {"bnot", "box:sides=0.3", {64}, 24, 40},
    {"fpo", "disk", {64, 256}, 16, 40},
    {"fpo", "gaussian", {64}, 16, 40},
    {"white-sphere", "cap", {16, 100}, 1000, 1},
    {"white-sphere", "harmonic", {64}, 1000, 1},
    {"white-sphere", "square:axis=1x2x2", {30}, 1000, 1},
    {"healpix-jittered", "cap", {12, 48, 192}, 1000, 1},
    {"healpix-jittered", "harmonic", {48, 192}, 1000, 1},
    {"zphi", "lobe:n=5", {64}, 1000, 1},
    {"poisson-disk-sphere", "cap", {64, 200}, 200, 2},
    {"poisson-disk-sphere", "harmonic", {64, 200}, 200, 2},
    {"fibonacci", "cap", {100}, 1000, 1},
    {"white-hemisphere", "cap", {16, 64}, 1000, 1},
    {"white-hemisphere", "square", {16, 64}, 1000, 1},
    {"jittered:lift=hemisphere", "square", {64}, 1000, 1},
    {"fibonacci-hemisphere", "cap", {64}, 1000, 1},
};
enum { NUM_KINDS = sizeof kinds / sizeof kinds[0] };

typedef struct scores {
    unsigned num;
    double sum, squares, largest;
} scores;

static double find_score(const kind *what, size_t num_points, uint64_t seed) {
    test_variance asked;
    test_variance_ask(&asked, what->sampler, num_points, what->num_realizations, what->integrand,
                      device);
    asked.question.num_shifts = what->num_shifts;
    asked.sampler.seed = seed;
    const ps_variance_row *const row = test_variance_run(&asked);
    const double score = row->z_score;
    printf("%-38s %-20s %4zu %10.4g +- %8.2g %10.4g +- %8.2g %6.2f\n", what->sampler,
           what->integrand, num_points, row->prediction.variance, row->prediction.standard_error,
           row->measured, row->measured_error, score);
    assert_true(isfinite(score));
    test_variance_free(&asked);
    return score;
}

static void scores_are_normal(void **state) {
    scores all = {0};
    (void)state;
    for (size_t i = 0; i < NUM_KINDS; i++) {
        for (size_t k = 0; k < 3 && kinds[i].num_points[k] > 0; k++) {
            const double score = find_score(&kinds[i], kinds[i].num_points[k], 1001 + all.num);
            all.num++;
            all.sum += score;
            all.squares += score * score;
            all.largest = fmax(all.largest, fabs(score));
        }
    }
    const double mean = all.sum / all.num;
    const double deviation = sqrt((all.squares - all.num * mean * mean) / (all.num - 1));
    printf("%u scores: mean %.3f, standard deviation %.3f, largest %.2f\n", all.num, mean,
           deviation, all.largest);
    assert_true(all.num >= 60);
    assert_true(fabs(mean) < 0.4);
    assert_true(deviation > 0.8 && deviation < 1.25);
    assert_true(all.largest < 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scores_are_normal),
    };
    device = test_open_device();
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    ps_device_close(device);
    return failed;
}
