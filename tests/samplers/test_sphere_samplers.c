/* Samplers of the sphere and hemisphere: requests, unit length, lifts, rotations, reproducibility.
 */
#include "test_samplers.h"

#include <math.h>
#include <string.h>

#include "jobs/source.h"
#include "math/pi.h"
#include "math/random/random.h"
#include "math/random/rotation.h"

static ps_sampler_request resolve_request(const char *text, size_t num_points) {
    ps_sampler_request request = parse_request(text, num_points, 0);
    ps_error error = {0};
    if (ps_sampler_resolve(&request, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    return request;
}

static void assert_resolve_error(const char *text, size_t num_points, unsigned dimension,
                                 const char *expected) {
    ps_sampler_request request = parse_request(text, num_points, dimension);
    ps_error error = {0};
    assert_int_equal(ps_sampler_resolve(&request, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, expected) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, expected);
    }
}

/* ---- requests ------------------------------------------------------------------------------ */

static void what_is_left_open_is_filled_in(void **state) {
    (void)state;
    const struct {
        const char *text;
        size_t num_points, expected_points;
        unsigned expected_dimension;
    } cases[] = {{"white", 0, 1024, 2},
                 {"white", 7, 7, 2},
                 {"white:lift=none", 7, 7, 2},
                 {"white:lift=sphere", 0, 1024, 3},
                 {"fibonacci", 0, 1024, 3},
                 {"zphi", 0, 1024, 3},
                 {"healpix:nside=9", 0, 972, 3},
                 {"healpix:nside=302697", 0, (size_t)12 * 302697 * 302697, 3},
                 {"healpix-jittered:nside=1", 12, 12, 3},
                 {"healpix", 48, 48, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_sampler_request request = resolve_request(cases[i].text, cases[i].num_points);
        assert_true(request.num_points == cases[i].expected_points);
        assert_int_equal(request.dimension, cases[i].expected_dimension);
    }
}

static void domains_are_known(void **state) {
    (void)state;
    const struct {
        const char *text;
        ps_sampler_domain domain;
    } cases[] = {{"sobol", PS_SAMPLES_TORUS},
                 {"sobol:lift=none", PS_SAMPLES_TORUS},
                 {"sobol:lift=sphere", PS_SAMPLES_SPHERE},
                 {"sobol:scramble=xor,lift=hemisphere", PS_SAMPLES_HEMISPHERE},
                 {"z-phi", PS_SAMPLES_SPHERE},
                 {"white-hemisphere", PS_SAMPLES_HEMISPHERE},
                 {"fibonacci-hemisphere", PS_SAMPLES_HEMISPHERE}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_sampler_request request = parse_request(cases[i].text, 1, 0);
        assert_int_equal(ps_sampler_where(&request), cases[i].domain);
        assert_int_equal(ps_sampler_is_on_sphere(&request), cases[i].domain != PS_SAMPLES_TORUS);
        assert_int_equal(ps_sampler_is_on_hemisphere(&request),
                         cases[i].domain == PS_SAMPLES_HEMISPHERE);
    }
}

static void a_lift_is_forgotten_by_the_next_parsing(void **state) {
    (void)state;
    ps_sampler_request request = parse_request("white:lift=sphere", 4, 0);
    assert_int_equal(ps_sampler_parse(&request, "white", NULL), PSPEC_OK);
    assert_false(ps_sampler_is_on_sphere(&request));
}

static void assert_parse_error(const char *text, const char *expected) {
    ps_sampler_request request = {0};
    ps_error error = {0};
    assert_int_equal(ps_sampler_parse(&request, text, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, expected) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, expected);
    }
}

static void wrong_text_is_explained(void **state) {
    (void)state;
    assert_parse_error("fibonaci", "did you mean fibonacci?");
    assert_parse_error("white:lift=ball", "lift=ball is not one of none, sphere, hemisphere");
    assert_parse_error("white:lift", "lift has no value");
    assert_parse_error("white:lift=sphere,lift=sphere", "lift is given twice");
    assert_parse_error("white:lit=sphere", "no parameters except lift, morph, n, but \"lit\"");
    assert_parse_error("sobol:lit=sphere", "did you mean lift?");
    assert_parse_error("fibonacci:lift=sphere", "makes points of the sphere without lift=");
    assert_parse_error("fibonacci:nside=3", "sampler fibonacci has no parameters, but");
    assert_parse_error("healpix:nsid=3", "did you mean nside?");
}

static void wrong_requests_are_explained(void **state) {
    (void)state;
    assert_resolve_error("fibonacci", 4, 2, "dimension 2 was given, but points of the sphere");
    assert_resolve_error("white:lift=sphere", 4, 2, "dimension 2 was given");
    assert_resolve_error("healpix", 0, 0, "needs a number of points 12 nside^2, or nside=");
    assert_resolve_error("healpix", 1000, 0, "use 972 (nside=9) or 1200 (nside=10)");
    assert_resolve_error("healpix-jittered", 5, 0, "use 12 (nside=1) or 48 (nside=2)");
    assert_resolve_error("healpix:nside=8", 1024, 0, "nside=8 makes 768 points, but 1024 were");
    assert_resolve_error("healpix:nside=0", 0, 0, "nside: 0 is not between 1 and 302697");
    assert_resolve_error("healpix:nside=302698", 0, 0, "is not between 1 and 302697");
    assert_resolve_error("healpix:nside=1.5", 0, 0, "not a whole number");
    assert_resolve_error("zphi:strata=4x4", 24, 0, "does not make one stratum for each of 24");
    assert_resolve_error("zphi:strata=2x3x4", 24, 0, "has 3 numbers but must have 2");
    assert_resolve_error("zphi", 1009, 0, "use 1008 or 1012 points, or give strata=");
    assert_resolve_error("zphi", 11, 0, "use 10 or 12 points");
    assert_resolve_error("jittered:strata=2x2x2,lift=sphere", 8, 0, "but the dimension is 2");
    assert_resolve_error("jittered:lift=sphere", 1009, 0, "use 1008 or 1012 points");
}

/* ---- points -------------------------------------------------------------------------------- */

/* All samplers of the sphere, and some that are lifted; all take 12 points and 768. */
static const char *const VARIANTS[] = {"white-sphere",
                                       "white-hemisphere",
                                       "zphi",
                                       "healpix",
                                       "healpix-jittered",
                                       "fibonacci",
                                       "fibonacci-hemisphere",
                                       "spiral",
                                       "ccvt-sphere:M=4",
                                       "white:lift=sphere",
                                       "jittered:lift=hemisphere",
                                       "halton:lift=sphere",
                                       "sobol:scramble=owen,lift=hemisphere",
                                       "latin-hypercube:lift=sphere",
                                       "hammersley:lift=hemisphere",
                                       "regular:lift=sphere"};
enum { NUM_VARIANTS = sizeof VARIANTS / sizeof VARIANTS[0] };

static void assert_on_sphere(const ps_sampler_request *request, double allowed) {
    double *points = generate_points(request, 3);
    for (size_t j = 0; j < request->num_points; j++) {
        const double *u = points + 3 * j;
        const long double square =
            (long double)u[0] * u[0] + (long double)u[1] * u[1] + (long double)u[2] * u[2];
        assert_true(fabsl(sqrtl(square) - 1) <= allowed);
        assert_true(!ps_sampler_is_on_hemisphere(request) || u[2] >= 0);
    }
    free(points);
}

static void points_are_unit_vectors(void **state) {
    (void)state;
    const size_t sizes[] = {12, 48, 768, 49152};
    const double most_seconds = 0.1; /* by the row, not by the clock */
    for (unsigned v = 0; v < NUM_VARIANTS; v++) {
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            ps_sampler_request request = resolve_request(VARIANTS[v], sizes[s]);
            if (ps_sampler_seconds(&request) > most_seconds) {
                continue;
            }
            assert_on_sphere(&request, 3 * 0x1p-53); /* three roundings */
            request.homogenize = true;
            assert_on_sphere(&request, 6 * 0x1p-53);
        }
    }
}

static void realizations_do_not_depend_on_order(void **state) {
    (void)state;
    for (unsigned v = 0; v < NUM_VARIANTS; v++) {
        for (unsigned homogenize = 0; homogenize < 2; homogenize++) {
            ps_sampler_request request = resolve_request(VARIANTS[v], 768);
            request.homogenize = homogenize;
            const size_t num_bytes = 3 * request.num_points * sizeof(double);
            double *first = generate_points(&request, 5);
            double *other = generate_points(&request, 3);
            double *again = generate_points(&request, 5);
            request.seed += (uint64_t)1 << 32;
            double *reseeded = generate_points(&request, 5);
            const bool is_constant = ps_sampler_has_constant_power(&request) && !homogenize;
            assert_memory_equal(first, again, num_bytes);
            assert_int_equal(memcmp(first, other, num_bytes) == 0, is_constant);
            assert_int_equal(memcmp(first, reseeded, num_bytes) == 0, is_constant);
            free(first);
            free(other);
            free(again);
            free(reseeded);
        }
    }
}

static void deterministic_sets_are_known_as_such(void **state) {
    (void)state;
    const char *constant[] = {"healpix:nside=2", "fibonacci",         "fibonacci-hemisphere",
                              "spiral",          "sobol:lift=sphere", "regular:lift=hemisphere"};
    const char *varying[] = {"healpix-jittered:nside=2", "zphi", "white-sphere", "white-hemisphere",
                             "jittered:lift=sphere"};
    for (size_t i = 0; i < sizeof constant / sizeof constant[0]; i++) {
        const ps_sampler_request request = resolve_request(constant[i], 0);
        assert_true(ps_sampler_has_constant_power(&request));
    }
    for (size_t i = 0; i < sizeof varying / sizeof varying[0]; i++) {
        const ps_sampler_request request = resolve_request(varying[i], 0);
        assert_false(ps_sampler_has_constant_power(&request));
    }
}

static void assert_same_points(const char *a, const char *b, size_t num_points) {
    const ps_sampler_request request_a = resolve_request(a, num_points);
    const ps_sampler_request request_b = resolve_request(b, num_points);
    double *points_a = generate_points(&request_a, 2);
    double *points_b = generate_points(&request_b, 2);
    assert_memory_equal(points_a, points_b, 3 * num_points * sizeof(double));
    free(points_a);
    free(points_b);
}

static void samplers_agree_with_their_lifted_kin(void **state) {
    (void)state;
    assert_same_points("white-sphere", "white:lift=sphere", 1000);
    assert_same_points("white-hemisphere", "white:lift=hemisphere", 1000);
    assert_same_points("zphi:strata=5x7", "jittered:strata=5x7,lift=sphere", 35);
}

/* Lambert's map in long double. */
static void lifts_are_lamberts_map(void **state) {
    (void)state;
    const char *names[] = {"sobol:scramble=owen", "sobol:scramble=owen,lift=sphere",
                           "sobol:scramble=owen,lift=hemisphere"};
    enum { N = 4096 };
    double *plane = NULL;
    for (unsigned i = 0; i < 3; i++) {
        const ps_sampler_request request = resolve_request(names[i], N);
        double *points = generate_points(&request, 1);
        for (size_t j = 0; i > 0 && j < N; j++) {
            const long double x = plane[2 * j];
            const long double phi = PS_TWO_PI_L * plane[2 * j + 1];
            const long double z = i == 1 ? 2 * x - 1 : x;
            const long double s = sqrtl((1 - z) * (1 + z));
            assert_true(fabsl(points[3 * j] - s * cosl(phi)) <= 3.4e-16L * s);
            assert_true(fabsl(points[3 * j + 1] - s * sinl(phi)) <= 3.4e-16L * s);
            assert_true(fabsl(points[3 * j + 2] - z) <= 0x1p-53L);
        }
        if (i == 0) {
            plane = points;
        } else {
            free(points);
        }
    }
    free(plane);
}

/* One rotation for all points of a realization: the first of its stream. Hemispheres are folded. */
static void homogenizing_rotates(void **state) {
    (void)state;
    const char *names[] = {"fibonacci", "fibonacci-hemisphere", "halton:lift=hemisphere"};
    for (unsigned i = 0; i < 3; i++) {
        ps_sampler_request request = resolve_request(names[i], 500);
        double *points = generate_points(&request, 8);
        request.homogenize = true;
        double *rotated = generate_points(&request, 8);
        ps_random random = ps_random_init(request.seed, PS_STREAM_ROTATION, 8);
        const ps_rotation rotation = ps_rotation_random(&random);
        ps_rotate(&rotation, points, 500);
        unsigned num_folded = 0;
        for (size_t j = 0; j < 500; j++) {
            const bool is_folded = i > 0 && points[3 * j + 2] < 0;
            num_folded += is_folded;
            for (unsigned axis = 0; axis < 3; axis++) {
                assert_true(rotated[3 * j + axis] ==
                            (is_folded ? -points[3 * j + axis] : points[3 * j + axis]));
            }
        }
        assert_int_equal(num_folded > 0, i > 0);
        free(points);
        free(rotated);
    }
}

/* What jobs get. */
static void sources_say_what_numbers_are(void **state) {
    (void)state;
    const struct {
        const char *text;
        ps_coordinates coordinates;
        unsigned dimension;
    } cases[] = {{"halton", PS_TORUS_COORDINATES, 2},
                 {"halton:lift=hemisphere", PS_UNIT_VECTORS, 3},
                 {"spiral", PS_UNIT_VECTORS, 3}};
    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_sampler_request request = resolve_request(cases[i].text, 20);
        double *points = generate_points(&request, 0);
        ps_source *source = NULL;
        ps_point_set set = {0};
        ps_source_part part;
        bool has_set = false;
        assert_int_equal(ps_source_sampler(&source, &request, 1, &(ps_sets_options){0}, NULL, NULL),
                         PSPEC_OK);
        assert_int_equal(ps_source_next(source, &set, &part, &has_set, NULL), PSPEC_OK);
        assert_true(has_set && part.is_whole);
        assert_int_equal(set.coordinates, cases[i].coordinates);
        assert_int_equal(set.dimension, cases[i].dimension);
        assert_memory_equal(set.points, points, 20 * set.dimension * sizeof(double));
        ps_point_set_free(&set);
        ps_source_destroy(source);
        free(points);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_left_open_is_filled_in),
        cmocka_unit_test(domains_are_known),
        cmocka_unit_test(a_lift_is_forgotten_by_the_next_parsing),
        cmocka_unit_test(wrong_text_is_explained),
        cmocka_unit_test(wrong_requests_are_explained),
        cmocka_unit_test(points_are_unit_vectors),
        cmocka_unit_test(realizations_do_not_depend_on_order),
        cmocka_unit_test(deterministic_sets_are_known_as_such),
        cmocka_unit_test(samplers_agree_with_their_lifted_kin),
        cmocka_unit_test(lifts_are_lamberts_map),
        cmocka_unit_test(homogenizing_rotates),
        cmocka_unit_test(sources_say_what_numbers_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
