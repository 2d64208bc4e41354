/* Of a background at random the spectra of capacity-constrained sets would have a floor. Rows:
 * parameters reach the algorithms, what cannot be made is refused. */
#include "test_samplers.h"
#include "ccvt_cases.h"

#include "math/pi.h"
#include "math/unit_vector.h"

enum { NUM = 256, CAPACITY = 64, SETS = 60, MOST_DEGREE = 12 };

/* Adds P(l) = (1/N) sum over pairs of P_l(u_i . u_j), l = 1 .. MOST_DEGREE. */
static void add_powers(const double *points, size_t num, double *powers) {
    for (size_t i = 0; i < num; i++) {
        for (size_t j = 0; j <= i; j++) {
            const double *const u = points + 3 * i;
            const double *const v = points + 3 * j;
            const double x = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
            const double share = (j < i ? 2 : 1) / (double)num;
            double before = 1;
            double p = x;
            for (int l = 1; l <= MOST_DEGREE; l++) {
                powers[l] += share * p;
                const double next = ((2 * l + 1) * x * p - l * before) / (l + 1);
                before = p;
                p = next;
            }
        }
    }
}

/* With points at random as background P(l) ends at 1/M. */
static void a_random_background_leaves_a_floor(void **state) {
    (void)state;
    enum { FEW = 30, LOW = 4 };
    double points[3 * NUM];
    double powers[MOST_DEGREE + 1] = {0};
    for (uint64_t r = 0; r < FEW; r++) {
        ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, r);
        ps_error error = {0};
        ps_ccvt c;
        ccvt_begin_case(&c, &ccvt_cases[1], NUM, CAPACITY, r);
        for (size_t k = 0; k < NUM * CAPACITY; k++) {
            double place[PS_CCVT_AXES] = {0};
            ps_random_fill_uniform(&random, place, 2);
            ps_sphere_lift(false, 0, 1, place);
            for (unsigned a = 0; a < PS_CCVT_AXES; a++) {
                c.at[a][k] = place[a];
            }
        }
        ccvt_assert_ok(ps_ccvt_run(&c, &error), &error);
        ps_ccvt_give(&c, points, NULL);
        add_powers(points, NUM, powers);
        ps_ccvt_destroy(&c);
    }
    double mean = 0;
    for (int l = 1; l <= LOW; l++) { /* 24 coefficients of 30 sets: 5 % */
        mean += (2 * l + 1) * powers[l] / (LOW * (LOW + 2)) / FEW;
    }
    assert_true(fabs(mean * CAPACITY - 1) < 0.2);
}

/* ---- rows ---------------------------------------------------------------------------------- */

static void parameters_reach_the_algorithms(void **state) {
    (void)state;
    static const char *const texts[] = {"ccvt:M=16", "ccvt-sphere:M=16"};
    double expected[3 * 64];
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        const ps_sampler_request request = make_request(texts[s], 64, ccvt_cases[s].axes);
        double *const points = generate_points(&request, 7);
        ccvt_make_case(&ccvt_cases[s], 64, 16, 7, expected);
        assert_memory_equal(points, expected, 64 * ccvt_cases[s].axes * sizeof *points);
        free(points);
    }
}

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    assert_refused("ccvt", 15, 2, "15 points asked for, it makes 16 and more");
    assert_refused("ccvt-sphere", 1, 3, "1 point asked for, it makes 2 and more");
    assert_refused("ccvt", 64, 3, "dimension 3");
    assert_refused("ccvt:M=3", 64, 2, "sampler ccvt: M: 3 is not between 4 and 16384");
    assert_refused("ccvt-sphere:M=16385", 64, 3, "sampler ccvt-sphere: M: 16385 is not between");
    assert_refused("ccvt-sphere:M=6.5", 64, 3, "M");
    assert_refused("ccvt-sphere:M=many", 64, 3, "M");
    assert_refused("ccvt", (size_t)1 << 24, 2, "with that M there are at most 65536 points");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_random_background_leaves_a_floor),
        cmocka_unit_test(parameters_reach_the_algorithms),
        cmocka_unit_test(what_cannot_be_made_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
