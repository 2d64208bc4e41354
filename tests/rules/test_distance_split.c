/* Sums over near and far pairs against long double and against the sum over all pairs; laws, points
 * at the edges of cells, and points that no cell can tell apart. */
#include "harness_quadrature.h"
#include "harness_sphere.h"

#include "math/sobolev.h"
#include "rules/distance_split.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t seed = 19;
static const double smoothnesses[] = {1.1, 1.5, 1.9};

/* Signed weights whose sizes sum to 1. */
static double *make_weights(size_t num) {
    double *weights = calloc(num, sizeof *weights);
    double size = 0;
    for (size_t j = 0; j < num; j++) {
        weights[j] = test_uniform(&seed) - 0.3;
        size += fabs(weights[j]);
    }
    for (size_t j = 0; j < num; j++) {
        weights[j] /= size;
    }
    return weights;
}

static double split_sum(const ps_rule *rule, double smoothness) {
    ps_distance_split *split = NULL;
    double sum = 0;
    assert_ok(ps_distance_split_create(&split, rule, NULL, error));
    assert_ok(ps_distance_split_sum(split, smoothness, NULL, &sum, error));
    ps_distance_split_destroy(split);
    return sum;
}

/* Of |u-v|: in long double. */
static double exact_sum(const ps_rule *rule) {
    long double sum = 0;
    for (size_t i = 0; i < rule->num_points; i++) {
        long double row = 0;
        for (size_t j = 0; j < i; j++) {
            long double square = 0;
            for (size_t axis = 0; axis < 3; axis++) {
                const long double d =
                    (long double)rule->points[3 * i + axis] - rule->points[3 * j + axis];
                square += d * d;
            }
            row += rule->weights[j] * sqrtl(square);
        }
        sum += rule->weights[i] * row;
    }
    return (double)(2 * sum);
}

/* Both sums may round, to one unit of c each. */
static void check(const ps_rule *rule, double smoothness, double expected, const char *name) {
    const double found = split_sum(rule, smoothness);
    const double limit = 2 * DBL_EPSILON * ps_sobolev_constant(smoothness);
    print_message("%s, N %zu, s %.1f: off by %.2g\n", name, rule->num_points, smoothness,
                  fabs(found - expected));
    assert_true(fabs(found - expected) <= limit);
}

/* Against long double at s = 1.5, at others against the sum over all pairs. */
static void check_sampler(const char *sampler, size_t num) {
    double *points = test_rule_points(sampler, num, 0);
    double *weights = make_weights(num);
    const ps_rule rule = {num, points, weights};
    check(&rule, 1.5, exact_sum(&rule), sampler);
    for (double smoothness = 1.1; smoothness < 2; smoothness += 0.8) {
        double whole = 0;
        assert_ok(ps_rule_distance(&rule, smoothness, NULL, &whole, error));
        check(&rule, smoothness, whole, sampler);
    }
    free(points);
    free(weights);
}

/* So many that cells of the second level have proxies. */
static void many_points(void **state) {
    (void)state;
    check_sampler("fibonacci-hemisphere:morph=diffuse", 16000);
    check_sampler("white-sphere", 26000);
}

/* Points of narrow lobes are in few cells, which are cut many times. */
static void narrow_lobes(void **state) {
    (void)state;
    check_sampler("fibonacci-hemisphere:morph=glossy,n=30", 8000);
    check_sampler("white-hemisphere:morph=glossy,n=2000", 6000);
    check_sampler("fibonacci-hemisphere:morph=glossy,n=100000", 6000);
}

/* The mean of |u-v|^(2s-2) over the sphere is 2^(2s-2)/s; the points are more than are summed
 * whole. */
static void sphere_mean(void **state) {
    enum { NUM = PS_DISTANCE_MOST_WHOLE + 4000 };
    double *points = test_rule_points("fibonacci", NUM, 0);
    const ps_rule rule = {NUM, points, NULL};
    (void)state;
    for (size_t s = 0; s < sizeof smoothnesses / sizeof smoothnesses[0]; s++) {
        double sum = 0;
        const double smoothness = smoothnesses[s];
        assert_ok(ps_rule_distance(&rule, smoothness, NULL, &sum, error));
        assert_true(sum == split_sum(&rule, smoothness) / NUM / NUM);
        const double mean = exp2(2 * smoothness - 2) / smoothness;
        /* E^2 of such points is about N^-s, and less than 4 times that */
        assert_true(sum < mean && mean - sum < 4 * pow(NUM, -smoothness));
    }
    free(points);
}

/* The order of the points does not matter to a bit where none are equal. */
static void permutation(void **state) {
    enum { NUM = 5000 };
    double *points = test_sphere_white_set(NUM, &seed);
    double *weights = make_weights(NUM);
    double *turned = calloc(3 * NUM, sizeof *turned);
    double *turned_weights = calloc(NUM, sizeof *turned_weights);
    (void)state;
    for (size_t j = 0; j < NUM; j++) {
        memcpy(turned + 3 * (NUM - 1 - j), points + 3 * j, 3 * sizeof *points);
        turned_weights[NUM - 1 - j] = weights[j];
    }
    const ps_rule rule = {NUM, points, weights};
    const ps_rule other = {NUM, turned, turned_weights};
    assert_true(split_sum(&rule, 1.5) == split_sum(&other, 1.5));
    free(points);
    free(weights);
    free(turned);
    free(turned_weights);
}

/* Edges and corners of the cube and the middles of its faces, each many times, so that cells of all
 * levels are cut; then points of one place only. */
static void edges(void **state) {
    enum { PLACES = 27, NUM = 100 * PLACES };
    double *points = calloc(3 * NUM, sizeof *points);
    double *weights = make_weights(NUM);
    (void)state;
    for (size_t j = 0; j < NUM; j++) {
        double u[3] = {(double)(j % 3) - 1, (double)(j / 3 % 3) - 1, (double)(j / 9 % 3) - 1};
        u[2] = u[0] == 0 && u[1] == 0 && u[2] == 0 ? 1 : u[2];
        const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        for (size_t axis = 0; axis < 3; axis++) {
            points[3 * j + axis] = u[axis] / length;
        }
    }
    const ps_rule rule = {NUM, points, weights};
    check(&rule, 1.5, exact_sum(&rule), "edges");
    for (size_t j = 1; j < NUM; j++) {
        memcpy(points + 3 * j, points, 3 * sizeof *points);
    }
    assert_true(split_sum(&rule, 1.1) == 0);
    free(points);
    free(weights);
}

/* What no cell tells apart is not split; a single point has no pair. */
static void one_place(void **state) {
    enum { NUM = PS_DISTANCE_MOST_WHOLE + 1 };
    double *points = calloc(3 * NUM, sizeof *points);
    ps_distance_split *split = NULL;
    bool pays = true;
    double sum = 1;
    (void)state;
    for (size_t j = 0; j < NUM; j++) {
        points[3 * j + 2] = 1;
    }
    const ps_rule rule = {NUM, points, NULL};
    const ps_rule single = {1, points, NULL};
    assert_ok(ps_distance_split_create(&split, &rule, &pays, error));
    assert_false(pays);
    ps_distance_split_destroy(split);
    ps_distance_split_destroy(NULL);
    assert_ok(ps_rule_distance(&rule, 1.5, NULL, &sum, error));
    assert_true(sum == 0 && split_sum(&single, 1.9) == 0);
    free(points);
}

static int stop(const ps_watch_report *report, void *payload) {
    *(uint64_t *)payload = report->done;
    return report->done > 0 ? 1 : 0;
}

/* Who listens may stop it. */
static void stopped(void **state) {
    enum { NUM = 20000 };
    uint64_t done = 0;
    double sum = 0;
    ps_distance_split *split = NULL;
    const ps_watch watch = {stop, &done};
    double *points = test_rule_points("fibonacci", NUM, 0);
    const ps_rule rule = {NUM, points, NULL};
    ps_error failure = {0};
    (void)state;
    assert_ok(ps_distance_split_create(&split, &rule, NULL, error));
    assert_int_equal(ps_distance_split_sum(split, 1.5, &watch, &sum, &failure),
                     PSPEC_ERROR_CANCELLED);
    assert_true(done > 0);
    ps_distance_split_destroy(split);
    free(points);
}

/* Distances that are planned for: never more than all pairs, and from some number on in proportion
 * to the points. */
static void planned(void **state) {
    (void)state;
    assert_true(ps_distance_count(1000) == 500000);
    assert_true(ps_distance_count(4e5) == 2 * ps_distance_count(2e5));
    for (double num = 1; num < 1e7; num *= 1.5) {
        assert_true(ps_distance_count(num) <= num * num / 2);
    }
    assert_true(ps_distance_bytes(200000) == 2 * ps_distance_bytes(100000));
}

static double count_of(const double *points, size_t num) {
    const ps_rule rule = {num, points, NULL};
    double found = 0;
    assert_ok(ps_distance_count_of(&rule, &found, error));
    return found;
}

/* Of known points: of few all pairs, of points that are spread out about what is planned without
 * them, of clumps all pairs in a clump. */
static void counted(void **state) {
    enum { NUM = 40000, CLUMPS = 4 };
    const double all = 0.5 * NUM * NUM;
    double *points = test_rule_points("fibonacci", NUM, 0);
    (void)state;
    assert_true(count_of(points, 1000) == 500000);
    assert_true(count_of(points, NUM) < 1.5 * ps_distance_count(NUM));
    assert_true(count_of(points, NUM) > ps_distance_count(NUM) / 1.5);
    for (size_t j = 0; j < NUM; j++) {
        memcpy(points + 3 * j, points + 3 * (NUM / CLUMPS) * (j % CLUMPS), 3 * sizeof *points);
    }
    assert_true(count_of(points, NUM) >= all / CLUMPS && count_of(points, NUM) <= all);
    assert_true(count_of(points, NUM) > 0.7 * ps_distance_count(NUM));
    for (size_t j = 0; j < NUM; j++) {
        memcpy(points + 3 * j, points, 3 * sizeof *points);
    }
    assert_true(count_of(points, NUM) == all);
    assert_true(all > 2 * ps_distance_count(NUM)); /* what was said of them before */
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_points), cmocka_unit_test(narrow_lobes),
        cmocka_unit_test(sphere_mean), cmocka_unit_test(permutation),
        cmocka_unit_test(edges),       cmocka_unit_test(one_place),
        cmocka_unit_test(stopped),     cmocka_unit_test(planned),
        cmocka_unit_test(counted)};
    return cmocka_run_group_tests_name("distance_split", tests, NULL, NULL);
}
