/* The sampler interface: names, parameters, limits, reproducibility, range. */
#include "test_samplers.h"

#include <string.h>

#include "math/random/random.h"

static void assert_parse_error(const char *text, const char *expected) {
    ps_sampler_request request = {0};
    ps_error error = {0};
    assert_int_equal(ps_sampler_parse(&request, text, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(error.message, expected) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, expected);
    }
}

static void assert_check_error(const char *text, size_t num_points, unsigned dimension,
                               const char *expected) {
    const ps_sampler_request request = parse_request(text, num_points, dimension);
    ps_error error = {0};
    assert_int_not_equal(ps_sampler_check(&request, &error), PSPEC_OK);
    if (strstr(error.message, expected) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, expected);
    }
}

static void every_name_and_alias_is_known_once(void **state) {
    (void)state;
    for (unsigned i = 0; ps_samplers[i] != NULL; i++) {
        const char *name = ps_samplers[i]->name;
        assert_ptr_equal(parse_request(name, 1, 1).sampler, ps_samplers[i]);
        for (unsigned i_alias = 0; ps_samplers[i]->aliases[i_alias] != NULL; i_alias++) {
            const char *alias = ps_samplers[i]->aliases[i_alias];
            assert_ptr_equal(parse_request(alias, 1, 1).sampler, ps_samplers[i]);
        }
    }
    assert_string_equal(parse_request("whitenoise", 1, 1).sampler->name, "white");
    assert_string_equal(parse_request("stratified", 1, 1).sampler->name, "jittered");
    assert_string_equal(parse_request("lhs", 1, 1).sampler->name, "latin-hypercube");
    assert_string_equal(parse_request("nrooks", 1, 1).sampler->name, "latin-hypercube");
}

static void values_are_parsed_over_their_defaults(void **state) {
    (void)state;
    assert_string_equal(parse_request("sobol", 1, 1).values[0], "none");
    assert_string_equal(parse_request("sobol:scramble=owen", 1, 1).values[0], "owen");
    const ps_sampler_request lp = parse_request("lp:centred=yes,scramble=xor", 1, 2);
    assert_string_equal(lp.values[0], "xor");
    assert_string_equal(lp.values[1], "yes");
}

static void wrong_text_is_explained(void **state) {
    (void)state;
    assert_parse_error("sobl", "unknown sampler \"sobl\"; did you mean sobol?");
    assert_parse_error("whitenois:x=1", "did you mean whitenoise?");
    assert_parse_error("", "unknown sampler \"\"");
    assert_parse_error("sobol:scrambel=owen", "\"scrambel\"; did you mean scramble?");
    assert_parse_error("white:x=1", "has no parameters");
    assert_parse_error("sobol:", "no parameter \"\"");
    assert_parse_error("sobol:scramble", "scramble has no value");
    assert_parse_error("sobol:scramble=", "scramble has no value");
    assert_parse_error("sobol:scramble=xor,scramble=owen", "given twice");
    assert_parse_error("sobol:scramble=xor,", "no parameter \"\"");
    assert_parse_error("sobol:scramble="
                       "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
                       "64 characters, more than 63");
    assert_parse_error(
        "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
        "unknown sampler");
}

static void wrong_values_are_explained(void **state) {
    (void)state;
    assert_check_error("sobol:scramble=faure", 4, 2,
                       "scramble=faure is not one of none, xor, owen");
    assert_check_error("lhs:offset=corner", 4, 2, "offset=corner is not one of jittered, centred");
    assert_check_error("lp:centred=maybe", 4, 2, "centred=maybe is not one of no, yes");
    assert_check_error("halton:start=-1", 4, 2, "start");
    assert_check_error("halton:start=1.5", 4, 2, "not a whole number");
    assert_check_error("jittered:strata=10x10", 128, 2, "strata=10x10 does not make");
    assert_check_error("jittered:strata=10x10", 100, 3, "has 2 numbers but the dimension is 3");
    const char *malformed[] = {"10*10", "10x",   "x10",   "0x10",   "10x0",
                               "ten",   "1x-10", "auto2", "10x 10", "99999999999999x1"};
    for (size_t i = 0; i < sizeof malformed / sizeof malformed[0]; i++) {
        char text[64] = "regular:strata=";
        strcat(text, malformed[i]);
        assert_check_error(text, 100, 2, "is not positive whole numbers joined by x");
    }
    assert_check_error("jittered:strata=1x1x1x1x1x1x1", 1, 6, "is not positive whole numbers");
}

static void numbers_of_points_are_limited(void **state) {
    (void)state;
    assert_check_error("white", 0, 2, "0 points");
    assert_check_error("white", ((size_t)1 << 40) + 1, 2, "limit of 1099511627776");
    assert_check_error("sobol", ((size_t)1 << 32) + 1, 2, "limit of 4294967296");
    assert_check_error("lp", 1000, 2, "1000 points are not a power of 2; use 512 or 1024");
    assert_check_error("lp", (size_t)1 << 32, 2, "limit of 2147483648");
    assert_check_error("jittered", 1009, 2, "use 1008 or 1012 points");
    assert_check_error("jittered", 3, 2, "use 2 or 4 points");
    assert_check_error("regular", 1009, 3, "use 1008 or 1024 points");
    assert_check_error("halton:start=281474976710656", 1, 2, "start");
}

static void dimensions_are_limited(void **state) {
    (void)state;
    for (unsigned i = 0; ps_samplers[i] != NULL; i++) {
        if (ps_samplers[i]->domain != PS_SAMPLES_TORUS) {
            assert_check_error(ps_samplers[i]->name, 12, 2, "dimension 2 was given, but points");
            continue;
        }
        assert_check_error(ps_samplers[i]->name, 1, 0, "dimension 0 is not between");
        assert_check_error(ps_samplers[i]->name, 1, 7, "dimension 7 is not between");
    }
    assert_check_error("larcher-pillichshammer", 64, 3, "dimension 3 is not between 2 and 2");
    assert_check_error("larcher-pillichshammer", 64, 1, "dimension 1 is not between 2 and 2");
}

static void deterministic_sets_are_known_as_such(void **state) {
    (void)state;
    const char *constant[] = {"regular", "halton", "hammersley",
                              "sobol",   "lp",     "lp:centred=yes",
                              "rank1",   "r2",     "pmj02:scramble=none"};
    const char *varying[] = {"white",
                             "jittered",
                             "lhs",
                             "lhs:offset=centred",
                             "sobol:scramble=xor",
                             "sobol:scramble=owen",
                             "sobol:scramble=hash",
                             "pmj02",
                             "cmj",
                             "lp:scramble=xor"};
    for (size_t i = 0; i < sizeof constant / sizeof constant[0]; i++) {
        ps_sampler_request request = make_request(constant[i], 16, 2);
        assert_true(ps_sampler_has_constant_power(&request));
        request.homogenize = true; /* a shift leaves the power as it is */
        assert_true(ps_sampler_has_constant_power(&request));
    }
    for (size_t i = 0; i < sizeof varying / sizeof varying[0]; i++) {
        const ps_sampler_request request = make_request(varying[i], 16, 2);
        assert_false(ps_sampler_has_constant_power(&request));
    }
}

/* Every sampler with every parameter that changes its points. */
static const char *const VARIANTS[] = {
    "white",
    "regular",
    "jittered",
    "latin-hypercube",
    "latin-hypercube:offset=centred",
    "sobol",
    "sobol:scramble=xor",
    "sobol:scramble=owen",
    "sobol:scramble=hash",
    "pmj02",
    "cmj",
    "rank1",
    "kronecker",
    "halton",
    "halton:start=1000000",
    "hammersley",
    "bnot:eps=10",
    "fpo:distance=0.5",
    "ccvt:M=4",
    "larcher-pillichshammer",
    "larcher-pillichshammer:centred=yes",
    "larcher-pillichshammer:scramble=xor",
    "larcher-pillichshammer:scramble=owen,centred=yes",
};
enum { NUM_VARIANTS = sizeof VARIANTS / sizeof VARIANTS[0] };

/* Does the request pass its check? What does not fit a sampler is skipped by the tests below. */
static bool is_admissible(const ps_sampler_request *request) {
    return ps_sampler_check(request, NULL) == PSPEC_OK;
}

static void assert_in_unit_cube(const ps_sampler_request *request, uint64_t realization) {
    double *points = generate_points(request, realization);
    for (size_t i = 0; i < request->num_points * request->dimension; i++) {
        assert_true(points[i] >= 0 && points[i] < 1);
    }
    free(points);
}

static void points_stay_in_the_unit_cube(void **state) {
    (void)state;
    const size_t sizes[] = {1, 2, 3, 4, 7, 13, 64, 997, 1024, 4096, 65536};
    const double most_seconds = 0.1; /* by the row, not by the clock */
    unsigned num_checked = 0;
    for (unsigned v = 0; v < NUM_VARIANTS; v++) {
        for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            for (unsigned d = 1; d <= PS_MAX_DIMENSION; d++) {
                ps_sampler_request request = parse_request(VARIANTS[v], sizes[s], d);
                if (is_admissible(&request) && ps_sampler_seconds(&request) < most_seconds) {
                    assert_in_unit_cube(&request, d);
                    request.homogenize = true;
                    assert_in_unit_cube(&request, d);
                    num_checked++;
                }
            }
        }
    }
    assert_true(num_checked > 500);
}

static void realizations_do_not_depend_on_order(void **state) {
    (void)state;
    for (unsigned v = 0; v < NUM_VARIANTS; v++) {
        const ps_sampler_request request = make_request(VARIANTS[v], 64, 2);
        const size_t num_bytes = 2 * request.num_points * sizeof(double);
        double *first = generate_points(&request, 5);
        double *other = generate_points(&request, 3);
        double *again = generate_points(&request, 5);
        assert_memory_equal(first, again, num_bytes);
        const bool is_constant = ps_sampler_has_constant_power(&request);
        assert_int_equal(memcmp(first, other, num_bytes) == 0, is_constant);
        free(first);
        free(other);
        free(again);
    }
}

static void seeds_and_high_realization_bits_matter(void **state) {
    (void)state;
    for (unsigned v = 0; v < NUM_VARIANTS; v++) {
        ps_sampler_request request = make_request(VARIANTS[v], 64, 2);
        const size_t num_bytes = 2 * request.num_points * sizeof(double);
        if (ps_sampler_has_constant_power(&request)) {
            continue;
        }
        double *first = generate_points(&request, 5);
        double *far = generate_points(&request, 5 + ((uint64_t)1 << 32));
        request.seed += (uint64_t)1 << 32;
        double *reseeded = generate_points(&request, 5);
        assert_int_not_equal(memcmp(first, far, num_bytes), 0);
        assert_int_not_equal(memcmp(first, reseeded, num_bytes), 0);
        free(first);
        free(far);
        free(reseeded);
    }
}

/* One vector for all points of a realization: the first uniforms of the shift stream. */
static void homogenizing_adds_one_vector(void **state) {
    (void)state;
    ps_sampler_request request = make_request("halton", 1000, 3);
    double *plain = generate_points(&request, 8);
    request.homogenize = true;
    double *shifted = generate_points(&request, 8);
    double *other = generate_points(&request, 9);
    ps_random random = ps_random_init(request.seed, PS_STREAM_SHIFT, 8);
    double shift[3];
    ps_random_fill_uniform(&random, shift, 3);
    for (size_t i = 0; i < 3000; i++) {
        const double sum = plain[i] + shift[i % 3];
        assert_true(shifted[i] == (sum >= 1 ? sum - 1 : sum));
    }
    assert_true(shifted[0] != other[0]);
    free(plain);
    free(shifted);
    free(other);
}

/* A sampler of the test's own, whose one point and its shift add up to 1. */
static pspec_status generate_complement(const ps_sampler_request *request, uint64_t realization,
                                        double *points, ps_error *error) {
    (void)error;
    ps_random random = ps_random_init(request->seed, PS_STREAM_SHIFT, realization);
    points[0] = 1 - ps_random_uniform(&random);
    return PSPEC_OK;
}

static void a_shift_onto_1_arrives_at_0(void **state) {
    (void)state;
    const ps_sampler complement = {.name = "complement", .generate = generate_complement};
    const ps_sampler_request request = {
        .sampler = &complement, .num_points = 1, .dimension = 1, .homogenize = true};
    double point = -1;
    generate_into(&request, 0, &point);
    assert_true(point == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_name_and_alias_is_known_once),
        cmocka_unit_test(values_are_parsed_over_their_defaults),
        cmocka_unit_test(wrong_text_is_explained),
        cmocka_unit_test(wrong_values_are_explained),
        cmocka_unit_test(numbers_of_points_are_limited),
        cmocka_unit_test(dimensions_are_limited),
        cmocka_unit_test(deterministic_sets_are_known_as_such),
        cmocka_unit_test(points_stay_in_the_unit_cube),
        cmocka_unit_test(realizations_do_not_depend_on_order),
        cmocka_unit_test(seeds_and_high_realization_bits_matter),
        cmocka_unit_test(homogenizing_adds_one_vector),
        cmocka_unit_test(a_shift_onto_1_arrives_at_0),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
