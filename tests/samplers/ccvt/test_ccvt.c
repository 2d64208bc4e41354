/* Capacity-constrained sets: who owns what, sums that fall, places that are the best, neighbours,
 * the same bits for ever, what is refused. */
#include "ccvt_cases.h"
#include "stop_at_the_third.h"

#include "files/digest.h"

enum { NUM = 48, CAPACITY = 16 };

static int compare_points(const void *a, const void *b) {
    return memcmp(a, b, PS_CCVT_AXES * sizeof(double));
}

/* All background points [..][3], sorted by their bits; the caller frees them. */
static double *sorted_background(const ps_ccvt *c, unsigned axes) {
    const size_t num = c->num * c->capacity;
    double *const points = calloc(num * PS_CCVT_AXES, sizeof *points);
    assert_non_null(points);
    for (size_t k = 0; k < num; k++) {
        ps_ccvt_place(c->at, k, axes, points + PS_CCVT_AXES * k);
    }
    qsort(points, num, PS_CCVT_AXES * sizeof *points, compare_points);
    return points;
}

/* Regions are M places of an array each, so that capacities are equal when no point was lost or
 * doubled. */
static void every_point_has_one_owner_and_every_site_m_points(void **state) {
    (void)state;
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        const size_t num_bytes = NUM * CAPACITY * PS_CCVT_AXES * sizeof(double);
        ps_error error = {0};
        ps_ccvt c;
        ccvt_begin_case(&c, &ccvt_cases[s], NUM, CAPACITY, 0);
        double *const before = sorted_background(&c, ccvt_cases[s].axes);
        ccvt_assert_ok(ps_ccvt_run(&c, &error), &error);
        double *const after = sorted_background(&c, ccvt_cases[s].axes);
        assert_true(c.num_swaps > 0);
        assert_memory_equal(before, after, num_bytes);
        for (size_t k = 1; k < NUM * CAPACITY; k++) { /* and no two are the same */
            assert_true(compare_points(after + 3 * (k - 1), after + 3 * k) != 0);
        }
        free(before);
        free(after);
        ps_ccvt_destroy(&c);
    }
}

static double key_of(double *const *at, size_t k, unsigned axes, double (*key)(const double *)) {
    double place[PS_CCVT_AXES] = {0};
    ps_ccvt_place(at, k, axes, place);
    return key(place);
}

/* Nothing of a band is above the next band, and along a band keys rise. */
static void assert_in_bands(double *const *at, const ps_ccvt *c, size_t per_site) {
    const ps_ccvt_space *const space = c->space;
    const size_t bands = (size_t)rint(sqrt(space->aspect * (double)c->num));
    double below = -HUGE_VAL;
    for (size_t b = 0; b < bands; b++) {
        double highest = -HUGE_VAL;
        double before = -HUGE_VAL;
        for (size_t k = b * c->num / bands * per_site; k < (b + 1) * c->num / bands * per_site;
             k++) {
            const double height = key_of(at, k, space->room.axes, space->height);
            const double along = key_of(at, k, space->room.axes, space->along);
            assert_true(height >= below && along >= before);
            highest = fmax(highest, height);
            before = along;
        }
        below = highest;
    }
}

static void sites_and_points_begin_in_the_same_bands(void **state) {
    (void)state;
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        for (size_t num = 31; num < 2000; num *= 4) {
            ps_error error = {0};
            ps_ccvt c;
            ccvt_begin_case(&c, &ccvt_cases[s], num, CAPACITY, num);
            ccvt_assert_ok(ps_ccvt_start(&c, &error), &error);
            assert_in_bands(c.site, &c, 1);
            assert_in_bands(c.at, &c, CAPACITY);
            ps_ccvt_destroy(&c);
        }
    }
}

static double sum_of_squares(const ps_ccvt *c, const ccvt_case *which) {
    double sum = 0;
    for (size_t k = 0; k < c->num * c->capacity; k++) {
        sum += ccvt_square(c, which, k, k / c->capacity);
    }
    return sum;
}

static void the_sum_falls_with_every_pass_and_every_move(void **state) {
    (void)state;
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        ps_error error = {0};
        ps_ccvt c;
        ccvt_begin_case(&c, &ccvt_cases[s], NUM, CAPACITY, 1);
        ccvt_assert_ok(ps_ccvt_begin(&c, &error), &error);
        double sum = sum_of_squares(&c, &ccvt_cases[s]);
        unsigned falls = 0;
        for (uint64_t swaps = 1; c.num_swaps != swaps || c.num_passes < 4;) {
            swaps = c.num_swaps;
            ccvt_assert_ok(ps_ccvt_pass(&c, &error), &error);
            const double exchanged = sum_of_squares(&c, &ccvt_cases[s]);
            assert_true(c.num_swaps == swaps ? exchanged == sum : exchanged < sum);
            falls += c.num_swaps != swaps;
            ccvt_assert_ok(ps_ccvt_move(&c, &error), &error);
            sum = sum_of_squares(&c, &ccvt_cases[s]);
            assert_true(sum <= exchanged * (1 + 1e-12));
            assert_true(fabs(sum / ps_ccvt_energy(&c) - 1) < 1e-4); /* regions may be wide yet */
        }
        assert_true(fabs(sum / ps_ccvt_energy(&c) - 1) < 1e-9);
        assert_true(falls > 5);
        ps_ccvt_destroy(&c);
    }
}

/* The most that goes from the sum when one point of i is exchanged for one of j. */
static double best_exchange(const ps_ccvt *c, const ccvt_case *which, size_t i, size_t j) {
    double most[2] = {-HUGE_VAL, -HUGE_VAL};
    for (unsigned side = 0; side < 2; side++) {
        const size_t own = side == 0 ? i : j;
        const size_t other = side == 0 ? j : i;
        for (size_t k = own * c->capacity; k < (own + 1) * c->capacity; k++) {
            const double gain = ccvt_square(c, which, k, own) - ccvt_square(c, which, k, other);
            most[side] = gain > most[side] ? gain : most[side];
        }
    }
    return most[0] + most[1];
}

/* All pairs, near or not, and all background points: what was left out could not help. */
static void in_the_end_no_exchange_helps(void **state) {
    (void)state;
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        for (size_t num = 16; num <= 144; num *= 3) {
            ps_error error = {0};
            ps_ccvt c;
            ccvt_begin_case(&c, &ccvt_cases[s], num, CAPACITY, 2);
            ccvt_assert_ok(ps_ccvt_run(&c, &error), &error);
            const double mean = ps_ccvt_energy(&c) / (double)(num * CAPACITY);
            for (size_t i = 0; i < num; i++) {
                for (size_t j = 0; j < i; j++) {
                    assert_true(best_exchange(&c, &ccvt_cases[s], i, j) < 1e-7 * mean);
                }
            }
            ps_ccvt_destroy(&c);
        }
    }
}

/* A step of a hundredth of a region in any direction does not lower the sum of a region. */
static void in_the_end_sites_are_where_their_sum_is_least(void **state) {
    (void)state;
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        const ccvt_case *const which = &ccvt_cases[s];
        ps_error error = {0};
        ps_ccvt c;
        ccvt_begin_case(&c, which, NUM, CAPACITY, 3);
        ccvt_assert_ok(ps_ccvt_run(&c, &error), &error);
        for (size_t i = 0; i < NUM; i++) {
            double sums[1 + 2 * PS_CCVT_AXES] = {0};
            double site[PS_CCVT_AXES] = {0};
            ps_ccvt_place(c.site, i, which->axes, site);
            for (unsigned way = 0; way <= 2 * which->axes; way++) {
                double place[PS_CCVT_AXES] = {site[0], site[1], site[2]};
                if (way > 0) {
                    place[(way - 1) / 2] += (way % 2 ? 0.01 : -0.01) * c.reach[i];
                }
                const double length =
                    sqrt(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]);
                for (unsigned a = 0; a < which->axes && which->axes == 3; a++) {
                    place[a] /= length;
                }
                for (size_t k = i * CAPACITY; k < (i + 1) * CAPACITY; k++) {
                    double point[PS_CCVT_AXES] = {0};
                    ps_ccvt_place(c.at, k, which->axes, point);
                    sums[way] += which->square(point, place);
                }
                assert_true(sums[way] >= sums[0]);
            }
        }
        ps_ccvt_destroy(&c);
    }
}

/* Against all pairs, from many sites a cell to one, with sites on the border of the room. */
static void no_neighbour_is_left_out(void **state) {
    (void)state;
    enum { SITES = 200 };
    static uint32_t near[SITES];
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        ps_ccvt c;
        ccvt_begin_case(&c, &ccvt_cases[s], SITES, CAPACITY, 4);
        c.site[0][0] = c.space->room.low;
        c.site[1][0] = ccvt_cases[s].axes == 3 ? 0 : 1 - 0x1p-53;
        if (ccvt_cases[s].axes == 3) {
            c.site[2][0] = 0;
        }
        for (double reach = 0.02; reach < 4; reach *= 1.3) {
            ps_ccvt_grid_fill(&c.grid, c.site, reach);
            for (uint32_t i = 0; i < SITES; i++) {
                bool is_near[SITES] = {false};
                const size_t num = ps_ccvt_grid_later(&c.grid, i, near);
                for (size_t k = 0; k < num; k++) {
                    assert_true(near[k] > i && near[k] < SITES && !is_near[near[k]]);
                    is_near[near[k]] = true;
                }
                for (uint32_t j = i + 1; j < SITES; j++) {
                    double u[PS_CCVT_AXES] = {0};
                    double v[PS_CCVT_AXES] = {0};
                    ps_ccvt_place(c.site, i, ccvt_cases[s].axes, u);
                    ps_ccvt_place(c.site, j, ccvt_cases[s].axes, v);
                    const double away = sqrt(ccvt_cases[s].square(u, v));
                    assert_true(is_near[j] || away >= reach);
                }
            }
        }
        ps_ccvt_destroy(&c);
    }
}

/* The lattice: all its points differ in either coordinate, and none is nearer to another than a
 * third of the side of its share of the area. */
static void lattices_are_good(void **state) {
    (void)state;
    static const uint64_t nums[] = {64, 1000, 1009, 4096, 30030, 65536};
    for (unsigned n = 0; n < sizeof nums / sizeof nums[0]; n++) {
        const uint64_t num = nums[n];
        for (uint64_t r = 0; r < 20; r++) {
            ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, r);
            const uint64_t g = ps_torus_ccvt_generator(num, &random);
            double least = HUGE_VAL;
            uint64_t y = 0;
            assert_true(g >= 1 && g < num);
            for (uint64_t j = 1; j < num; j++) {
                y = (y + g) % num;
                assert_true(y != 0);
                const double dx = (double)(j < num - j ? j : num - j) / (double)num;
                const double dy = (double)(y < num - y ? y : num - y) / (double)num;
                least = fmin(least, dx * dx + dy * dy);
            }
            assert_true(least * (double)num > 1.0 / 9);
        }
    }
}

static void few_points_are_made_as_well(void **state) {
    (void)state;
    double points[PS_CCVT_AXES * 16];
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        const size_t least = s == 0 ? PS_TORUS_CCVT_LEAST_POINTS : PS_SPHERE_CCVT_LEAST_POINTS;
        for (size_t num = least; num <= 16; num++) {
            for (size_t capacity = 4; capacity <= 64; capacity *= 4) {
                const ps_ccvt_outcome outcome =
                    ccvt_make_case(&ccvt_cases[s], num, capacity, num, points);
                assert_true(outcome.energy > 0 && outcome.passes >= 3);
                for (size_t i = 0; i < ccvt_cases[s].axes * num; i++) {
                    assert_true(points[i] >= (s == 0 ? 0 : -1) && points[i] <= 1);
                }
            }
        }
    }
}

static void whoever_watches_may_stop_it(void **state) {
    (void)state;
    enum { MANY = 2048 };
    static double points[PS_CCVT_AXES * MANY];
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        unsigned calls = 0;
        const ps_watch watch = {stop_at_the_third, &calls};
        ps_error error = {0};
        ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
        assert_int_equal(
            ps_ccvt_make(ccvt_cases[s].space, MANY, 64, &random, &watch, points, NULL, &error),
            PSPEC_ERROR_CANCELLED);
        assert_int_equal(calls, 3);
    }
}

/* Distances since the watch heard something, and the most there were. */
typedef struct silence {
    size_t now, most;
} silence;

static silence *counted; /* costs have no payload */

static void costs_counted(double *const *at, size_t first, size_t num, const double *place,
                          double *out) {
    ps_torus_ccvt_space.costs(at, first, num, place, out);
    counted->now += num;
    counted->most = counted->now > counted->most ? counted->now : counted->most;
}

static int break_silence(const ps_watch_report *report, void *payload) {
    assert_string_equal(report->phase, ps_torus_ccvt_space.phase);
    ((silence *)payload)->now = 0;
    return 0;
}

/* Also where one site meets many others with large regions. */
static void nothing_takes_many_distances_in_silence(void **state) {
    (void)state;
    enum { FEW = 64, LARGE = PS_CCVT_MOST_CAPACITY };
    ps_ccvt_space space = ps_torus_ccvt_space;
    silence heard = {0};
    const ps_watch watch = {break_silence, &heard};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    ps_error error = {0};
    ps_ccvt c;
    counted = &heard;
    space.costs = costs_counted;
    ccvt_assert_ok(ps_ccvt_create(&c, &space, FEW, LARGE, &random, &watch, &error), &error);
    ccvt_assert_ok(ps_ccvt_begin(&c, &error), &error);
    for (size_t i = 0; i < FEW; i++) {
        c.reach[i] = 1; /* all pairs may meet */
    }
    ccvt_assert_ok(ps_ccvt_pass(&c, &error), &error);
    assert_in_range(heard.most, PS_CCVT_WORK_AT_A_TIME / 2,
                    PS_CCVT_WORK_AT_A_TIME + 3 * PS_CCVT_MOST_CAPACITY);
    ps_ccvt_destroy(&c);
}

static void phases_have_the_names_of_samplers(void **state) {
    (void)state;
    static const char *const phases[] = {"sampler: ccvt, passes over all pairs",
                                         "sampler: ccvt-sphere, passes over all pairs"};
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        assert_string_equal(ccvt_cases[s].space->phase, phases[s]);
    }
}

static void assert_refused(size_t num, uint64_t capacity, const char *why) {
    ps_error error = {0};
    assert_int_equal(ps_ccvt_check(num, capacity, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, why) == NULL) {
        fail_msg("%s", error.message);
    }
}

static void what_cannot_be_made_is_refused(void **state) {
    (void)state;
    ps_error error = {0};
    assert_refused(16, 3, "M = 3 background points a site: it is from 4 to 16384");
    assert_refused(16, 16385, "M = 16385");
    assert_refused(((size_t)1 << 18) + 1, 64, "at most 262144 points");
    assert_int_equal(ps_ccvt_check((size_t)1 << 18, 64, &error), PSPEC_OK);
}

/* Recorded: the bits of a set stay the same, with any compiler and on any machine. */
static void the_bits_of_a_set_are_these(void **state) {
    (void)state;
    enum { MANY = 256 };
    static const char *const digests[] = {"f95c1ed156a73ec4ef55b8edda67b8b3",
                                          "be14957b00959c085da9973df612ca24"};
    static double points[PS_CCVT_AXES * MANY];
    for (unsigned s = 0; s < CCVT_CASES; s++) {
        char digest[PS_DIGEST_BYTES];
        ccvt_make_case(&ccvt_cases[s], MANY, 64, 0, points);
        ps_digest_bytes(points, ccvt_cases[s].axes * MANY * sizeof *points, digest);
        assert_string_equal(digest, digests[s]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_point_has_one_owner_and_every_site_m_points),
        cmocka_unit_test(sites_and_points_begin_in_the_same_bands),
        cmocka_unit_test(the_sum_falls_with_every_pass_and_every_move),
        cmocka_unit_test(in_the_end_no_exchange_helps),
        cmocka_unit_test(in_the_end_sites_are_where_their_sum_is_least),
        cmocka_unit_test(no_neighbour_is_left_out),
        cmocka_unit_test(lattices_are_good),
        cmocka_unit_test(few_points_are_made_as_well),
        cmocka_unit_test(whoever_watches_may_stop_it),
        cmocka_unit_test(nothing_takes_many_distances_in_silence),
        cmocka_unit_test(phases_have_the_names_of_samplers),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(the_bits_of_a_set_are_these),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
