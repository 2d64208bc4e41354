/* The rows of samplers that keep a least distance: radius=, exact=, tries=, numbers of points. */
#include "test_blue_noise.h"
#include "test_samplers.h"

#include <stdio.h>

static const char *const NAMES[] = {"poisson-disk", "bridson", "poisson-disk-sphere"};
enum { NUM_NAMES = sizeof NAMES / sizeof NAMES[0] };

static ps_sampler_request resolve(const char *text, size_t num_points, unsigned dimension) {
    ps_sampler_request request = parse_request(text, num_points, dimension);
    ps_error error = {0};
    if (ps_sampler_resolve(&request, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return request;
}

/* The caller frees the points. */
static double *generate_some(const ps_sampler_request *request, uint64_t realization, size_t *num) {
    double *const points =
        malloc(ps_sampler_most_points(request) * request->dimension * sizeof *points);
    ps_error error = {0};
    assert_non_null(points);
    if (ps_sampler_generate(request, realization, points, num, NULL, &error) != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    assert_true(*num <= ps_sampler_most_points(request));
    return points;
}

static void names_of_other_tools_are_known(void **state) {
    (void)state;
    assert_string_equal(parse_request("darts", 1, 2).sampler->name, "poisson-disk");
    assert_string_equal(parse_request("pd", 1, 2).sampler->name, "poisson-disk");
    assert_string_equal(parse_request("bridson", 1, 2).values[2], "30");
}

static void numbers_vary_unless_they_are_to_be_exact(void **state) {
    (void)state;
    for (unsigned i = 0; i < NUM_NAMES; i++) {
        char text[64];
        const ps_sampler_request free_number = resolve(NAMES[i], 100, 0);
        bool differs = false;
        assert_true(ps_sampler_varies(&free_number));
        assert_true(ps_sampler_most_points(&free_number) > 100);
        snprintf(text, sizeof text, "%s:exact=yes", NAMES[i]);
        const ps_sampler_request exact = resolve(text, 100, 0);
        assert_false(ps_sampler_varies(&exact));
        assert_int_equal(ps_sampler_most_points(&exact), 100);
        assert_true(ps_sampler_seconds(&exact) > 3 * ps_sampler_seconds(&free_number));
        for (uint64_t r = 0; r < 20; r++) {
            size_t num = 0;
            free(generate_some(&free_number, r, &num));
            differs = differs || num != 100;
            free(generate_some(&exact, r, &num));
            assert_int_equal(num, 100);
        }
        assert_true(differs);
    }
}

/* A set of the exact number is one of those that have it, with the same least distance. */
static void exact_sets_keep_the_distance(void **state) {
    (void)state;
    const ps_sampler_request request = resolve("poisson-disk:exact=yes", 200, 2);
    for (uint64_t r = 0; r < 5; r++) {
        size_t num = 0;
        double least = 0;
        double mean = 0;
        double *const points = generate_some(&request, r, &num);
        test_distances(2, points, num, &least, &mean);
        assert_true(least >= test_radius(&ps_poisson_disk_kind, 2, 0, 200) * (1 - 1e-15));
        free(points);
    }
}

static void a_radius_says_how_many_points_there_are(void **state) {
    (void)state;
    assert_int_equal(resolve("poisson-disk:radius=0.05", 0, 2).num_points, 279);
    assert_int_equal(resolve("poisson-disk:radius=0.05,lift=sphere", 0, 0).num_points, 279);
    assert_int_equal(resolve("poisson-disk:radius=0.1", 0, 3).num_points, 734);
    assert_int_equal(resolve("bridson:radius=0.05", 0, 2).num_points, 246);
    assert_int_equal(resolve("bridson:radius=0.05,tries=100", 0, 2).num_points, 259);
    assert_int_equal(resolve("poisson-disk-sphere:radius=0.1", 0, 0).num_points, 876);
    assert_int_equal(resolve("poisson-disk", 0, 0).num_points, PS_DEFAULT_POINTS);
    size_t num = 0;
    const ps_sampler_request request = resolve("poisson-disk:radius=0.05", 279, 2);
    double least = 0;
    double mean = 0;
    double *const points = generate_some(&request, 0, &num);
    test_distances(2, points, num, &least, &mean);
    test_assert_between("least distance", least, 0.05, 0.0502);
    free(points);
    resolve("poisson-disk:radius=0.05,exact=yes", 280, 2);
    assert_refused("poisson-disk:radius=0.05", 280, 2,
                   "radius=0.05 makes about 279 points, but 280 were asked for");
}

static void an_exact_number_that_never_comes_ends(void **state) {
    (void)state;
    ps_sampler_request request = resolve("poisson-disk:radius=0.3,exact=yes", 9, 2);
    request.num_points = 30;
    ps_error error = {0};
    double points[2 * 30];
    size_t num = 0;
    assert_int_equal(ps_sampler_generate(&request, 0, points, &num, NULL, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "none of 166 sets at the radius 0.3 has 30 points"));
    assert_non_null(strstr(error.message, "in the mean"));
}

static void wrong_requests_are_explained(void **state) {
    (void)state;
    assert_refused("poisson-disk:radius=wide", 0, 2, "radius: \"wide\" is not a finite number");
    assert_refused("poisson-disk:radius=0", 0, 2, "radius 0 is not above 0 and at most 0.707107");
    assert_refused("poisson-disk:radius=0.8", 0, 2, "at most 0.707107");
    assert_refused("poisson-disk:radius=1e-300", 0, 2, "more than 2^32");
    assert_refused("poisson-disk:radius=1e-300", 5, 3, "more than 2^32");
    assert_refused("poisson-disk:radius=0.0001,exact=yes", 2, 2, "for no set is so far from it");
    assert_refused("poisson-disk:exact=maybe", 5, 2, "exact=maybe is not one of no, yes");
    assert_refused("poisson-disk", (size_t)1 << 32, 2, "more than 2^32");
    assert_refused("poisson-disk:radius=0.1", 0, 4, "dimension 4 is not between 2 and 3");
    assert_refused("bridson:radius=0.1", 0, 5, "dimension 5 is not between 2 and 4");
    assert_refused("bridson", 100, 1, "dimension 1 is not between 2 and 4");
    assert_refused("bridson:tries=1", 100, 2, "1 tries are not between 2 and 1000");
    assert_refused("bridson:tries=1001", 100, 2, "1001 tries are not between 2 and 1000");
    assert_refused("bridson:tries=many", 100, 2, "tries: \"many\" is not a whole number");
    assert_refused("poisson-disk-sphere", 1, 0, "1 point asked for, it makes 2 and more");
    assert_refused("poisson-disk-sphere:radius=3.1", 0, 0, "at most 3");
    assert_refused("poisson-disk-sphere:radius=1e-9", 0, 0, "more than 2^32");
}

/* From the smallest number on, in every dimension, with a shift or rotation. */
static void few_points_are_made(void **state) {
    (void)state;
    for (unsigned i = 0; i < NUM_NAMES; i++) {
        for (unsigned dimension = 2; dimension <= 4; dimension++) {
            for (size_t n = 1; n <= 12; n++) {
                ps_sampler_request request = parse_request(NAMES[i], n, dimension);
                if (ps_sampler_check(&request, NULL) == PSPEC_OK) {
                    size_t num = 0;
                    request.homogenize = true;
                    free(generate_some(&request, n, &num));
                    assert_true(num >= 1 && num <= 2 * n + 2);
                }
            }
        }
    }
}

/* A watch that stops at its first word after so many. */
static int stop_after(const ps_watch_report *report, void *payload) {
    int *const left = (int *)payload;
    assert_true(report->done <= report->total);
    return (*left)-- <= 0;
}

static void a_watch_stops_it_at_any_word(void **state) {
    (void)state;
    static const struct {
        const ps_distance_kind *kind;
        ps_blue_noise asked;
        int most_words;
    } cases[] = {
        {&ps_poisson_disk_kind, {.dimension = 2, .radius = 0.02, .most_points = 4000}, 5},
        {&ps_bridson_kind, {.dimension = 2, .radius = 0.02, .tries = 30, .most_points = 4000}, 3},
        {&ps_sphere_disk_kind, {.dimension = 3, .radius = 0.03, .most_points = 40000}, 5}};
    double *const points = malloc(40000 * 3 * sizeof *points);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int words = 0; words <= cases[i].most_words; words++) {
            int left = words;
            const ps_watch watch = {stop_after, &left};
            ps_blue_noise asked = cases[i].asked;
            ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
            ps_error error = {0};
            size_t num = 1;
            asked.watch = &watch;
            assert_int_equal(cases[i].kind->make(&asked, &random, points, &num, &error),
                             PSPEC_ERROR_CANCELLED);
            assert_int_equal(num, 0);
        }
    }
    free(points);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_of_other_tools_are_known),
        cmocka_unit_test(numbers_vary_unless_they_are_to_be_exact),
        cmocka_unit_test(exact_sets_keep_the_distance),
        cmocka_unit_test(a_radius_says_how_many_points_there_are),
        cmocka_unit_test(an_exact_number_that_never_comes_ends),
        cmocka_unit_test(wrong_requests_are_explained),
        cmocka_unit_test(few_points_are_made),
        cmocka_unit_test(a_watch_stops_it_at_any_word),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
