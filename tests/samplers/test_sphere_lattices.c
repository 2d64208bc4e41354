/* Strata and lattices of the sphere: HEALPix, z-phi cells, Fibonacci points, Bauer's spiral,
 * against formulas of their own and reference/sphere.json. */
#include "harness.h"
#include "test_samplers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "math/pi.h"
#include "math/random/random.h"
#include "samplers/fibonacci.h"
#include "samplers/sphere/spherical_fibonacci.h"

/* Of height, sine, cosine and their product. */
static const double ROUNDINGS = 3 * 0x1p-53;

static double *make_points(const char *text, size_t num_points) {
    const ps_sampler_request request = make_request(text, num_points, 3);
    return generate_points(&request, 4);
}

static void assert_near(const double *point, long double z, long double phi, double allowed) {
    const long double s = sqrtl((1 - z) * (1 + z));
    assert_true(fabsl(point[0] - s * cosl(phi)) <= allowed);
    assert_true(fabsl(point[1] - s * sinl(phi)) <= allowed);
    assert_true(fabsl(point[2] - z) <= allowed);
}

/* Azimuth in [0,1] turns. */
static long double turns_of(const double *point) {
    const long double turns = atan2l(point[1], point[0]) / PS_TWO_PI_L;
    return turns < 0 ? turns + 1 : turns;
}

/* ---- HEALPix ------------------------------------------------------------------------------- */

static const long long SIDES[] = {1, 2, 3, 4, 5, 7, 8, 16, 61};
enum { NUM_SIDES = sizeof SIDES / sizeof SIDES[0] };

/* Gorski et al. 2005, equations 2 to 9: pixel k of ring i, both from 1. Every second ring of the
 * belt begins at the azimuth 0, as in all HEALPix programs. */
static void assert_centre(const double *point, long long nside, long long i, long long k) {
    const long long south = 4 * nside - i;
    const long long pole = i < south ? i : south;
    long double z = 4.0L / 3 - 2.0L * i / (3 * nside);
    long double phi = PS_PI_L / (2 * nside) * (k - 1 + ((i - nside + 1) % 2) / 2.0L);
    if (pole < nside) {
        z = (1 - (long double)(pole * pole) / (3 * nside * nside)) * (i < south ? 1 : -1);
        phi = PS_PI_L / (2 * pole) * (k - 0.5L);
    }
    assert_near(point, z, phi, ROUNDINGS);
}

static void healpix_centres_are_where_the_paper_has_them(void **state) {
    (void)state;
    for (unsigned s = 0; s < NUM_SIDES; s++) {
        const long long nside = SIDES[s];
        double *points = make_points("healpix", (size_t)(12 * nside * nside));
        const double *point = points;
        for (long long i = 1; i < 4 * nside; i++) {
            const long long pole = i < 4 * nside - i ? i : 4 * nside - i;
            const long long length = 4 * (pole < nside ? pole : nside);
            for (long long k = 1; k <= length; k++) {
                assert_centre(point, nside, i, k);
                point += 3;
            }
        }
        assert_int_equal(point - points, 36 * nside * nside);
        free(points);
    }
}

/* The number of the pixel that a point lies in, RING order; from z and phi alone. */
static long long pixel_of(const double *point, long long nside) {
    const long double quarter = 4 * turns_of(point); /* of a turn, [0,4] */
    const long double z = point[2];
    if (fabsl(z) <= 2.0L / 3) {
        const long long rising = (long long)floorl(nside * (0.5L + quarter - 0.75L * z));
        const long long falling = (long long)floorl(nside * (0.5L + quarter + 0.75L * z));
        const long long ring = nside + 1 + rising - falling; /* from 1 at z = 2/3 */
        const long long shift = (ring + 1) % 2;
        const long long k = (rising + falling - nside + shift + 1) / 2 % (4 * nside);
        return 2 * nside * (nside - 1) + (ring - 1) * 4 * nside + k;
    }
    const long double square = (long double)point[0] * point[0] + (long double)point[1] * point[1];
    const long double distance = nside * sqrtl(3 * square / (1 + fabsl(z)));
    const long double within = quarter - floorl(quarter);
    const long long ring =
        (long long)(within * distance) + (long long)((1 - within) * distance) + 1;
    const long long k = (long long)(quarter * ring) % (4 * ring);
    return z > 0 ? 2 * ring * (ring - 1) + k : 12 * nside * nside - 2 * ring * (ring + 1) + k;
}

static void every_pixel_has_its_point(void **state) {
    (void)state;
    const char *const names[] = {"healpix", "healpix-jittered"};
    for (unsigned s = 0; s < NUM_SIDES; s++) {
        for (unsigned i = 0; i < 2; i++) {
            const size_t n = (size_t)(12 * SIDES[s] * SIDES[s]);
            double *points = make_points(names[i], n);
            for (size_t j = 0; j < n; j++) {
                assert_int_equal(pixel_of(points + 3 * j, SIDES[s]), j);
            }
            free(points);
        }
    }
}

/* Uniform within the pixels, hence on the sphere, if pixels have equal areas: z and the azimuth
 * have the moments of white noise, in every realization up to the jitter of single points. */
static void jittered_pixels_have_equal_areas(void **state) {
    (void)state;
    enum { M = 2000, NSIDE = 2, N = 12 * NSIDE * NSIDE, BANDS = 32 };
    double counts[BANDS][4] = {{0}};
    const ps_sampler_request request = make_request("healpix-jittered", N, 3);
    for (uint64_t r = 0; r < M; r++) {
        double points[3 * N];
        generate_into(&request, r, points);
        for (unsigned j = 0; j < N; j++) {
            const unsigned band = (unsigned)((points[3 * j + 2] + 1) / 2 * BANDS);
            const unsigned sector = (unsigned)(turns_of(points + 3 * j) * 4);
            counts[band < BANDS ? band : BANDS - 1][sector % 4] += 1;
        }
    }
    const double expected = (double)M * N / (BANDS * 4);
    for (unsigned band = 0; band < BANDS; band++) {
        for (unsigned sector = 0; sector < 4; sector++) { /* strata only lower the variance */
            assert_true(fabs(counts[band][sector] - expected) < 5 * sqrt(expected));
        }
    }
}

/* Every point of either set has one of the other within the tolerance. */
static void assert_same_set(const double *points, const test_set *set, double tolerance) {
    for (size_t j = 0; j < set->num_points; j++) {
        double nearest = 1;
        for (size_t i = 0; i < set->num_points; i++) {
            double distance = 0;
            for (unsigned axis = 0; axis < 3; axis++) {
                distance = fmax(distance, fabs(points[3 * i + axis] - set->points[3 * j + axis]));
            }
            nearest = fmin(nearest, distance);
        }
        assert_true(nearest <= tolerance);
    }
}

/* Points of the set of that name; the caller frees them. */
static test_set read_set(const cJSON *reference, const char *name) {
    const cJSON *json = NULL;
    cJSON_ArrayForEach(json, cJSON_GetObjectItem(reference, "sets")) {
        if (strcmp(cJSON_GetObjectItem(json, "name")->valuestring, name) == 0) {
            break;
        }
    }
    assert_non_null(json);
    const cJSON *rows = cJSON_GetObjectItem(json, "xyz");
    test_set set = {.dimension = 3, .num_points = (size_t)cJSON_GetArraySize(rows)};
    set.points = malloc(3 * set.num_points * sizeof(double));
    assert_non_null(set.points);
    for (size_t i = 0; i < 3 * set.num_points; i++) {
        set.points[i] =
            test_number(cJSON_GetArrayItem(cJSON_GetArrayItem(rows, (int)(i / 3)), (int)(i % 3)));
    }
    return set;
}

static void points_agree_with_the_reference(void **state) {
    (void)state;
    cJSON *reference = test_read_reference("sphere.json");
    const struct {
        const char *name, *sampler;
        double tolerance; /* the file has Fibonacci azimuths 2 pi j/Phi as products of doubles */
    } cases[] = {{"s4_fibonacci48", "fibonacci", 2e-14},
                 {"s5_healpix_nside2", "healpix:nside=2", 1e-15}};
    for (unsigned i = 0; i < 2; i++) {
        test_set set = read_set(reference, cases[i].name);
        double *points = make_points(cases[i].sampler, set.num_points);
        assert_int_equal(set.num_points, 48);
        assert_same_set(points, &set, cases[i].tolerance);
        free(points);
        free(set.points);
    }
    cJSON_Delete(reference);
}

/* ---- z-phi cells --------------------------------------------------------------------------- */

static void every_zphi_cell_has_its_point(void **state) {
    (void)state;
    const struct {
        const char *name;
        size_t num_z, num_phi;
    } cases[] = {{"zphi", 1, 1},
                 {"zphi", 1, 2},
                 {"zphi", 3, 8},
                 {"zphi", 16, 64},
                 {"zphi:strata=7x3", 7, 3},
                 {"zphi:strata=1x1009", 1, 1009}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const size_t n = cases[c].num_z * cases[c].num_phi;
        double *points = make_points(cases[c].name, n);
        for (size_t j = 0; j < n; j++) {
            const double *u = points + 3 * j;
            const size_t i_z = (size_t)floor((u[2] + 1) / 2 * (double)cases[c].num_z);
            const size_t i_phi = (size_t)floorl(turns_of(u) * cases[c].num_phi);
            assert_int_equal(i_z * cases[c].num_phi + i_phi, j);
        }
        free(points);
    }
}

/* Sides of the squarest cells at the equator, 2/n_z and 2 pi/n_phi, over all factorisations. */
static double squarest(size_t n) {
    double best = HUGE_VAL;
    for (size_t n_z = 1; n_z <= n; n_z++) {
        if (n % n_z == 0) {
            const double ratio =
                (2 / (double)n_z) / (2 * (double)PS_PI_L * (double)n_z / (double)n);
            best = fmin(best, fmax(ratio, 1 / ratio));
        }
    }
    return best;
}

static void zphi_cells_are_square_or_refused(void **state) {
    (void)state;
    for (size_t n = 1; n <= 500; n++) {
        const ps_sampler_request request = parse_request("zphi", n, 3);
        ps_error error = {0};
        const bool is_admissible = n == 1 || squarest(n) <= 2;
        assert_int_equal(ps_sampler_check(&request, &error) == PSPEC_OK, is_admissible);
        if (!is_admissible) {
            size_t below = n - 1;
            size_t above = n + 1;
            while (below > 1 && squarest(below) > 2) {
                below--;
            }
            while (squarest(above) > 2) {
                above++;
            }
            char expected[64];
            snprintf(expected, sizeof expected, "use %zu or %zu points", below, above);
            assert_non_null(strstr(error.message, expected));
        }
    }
}

/* ---- Fibonacci ----------------------------------------------------------------------------- */

/* F_n/Phi = F_(n-1) - (-1/Phi)^n exactly, so that the fraction of j/Phi is a sum over the Fibonacci
 * numbers that add up to j: no product of large numbers is involved. */
static long double fraction_by_fibonacci_numbers(uint64_t j) {
    enum { LAST = 93 }; /* F_93 is the largest below 2^64 */
    uint64_t f[LAST + 1] = {0, 1};
    long double powers[LAST + 1] = {1}; /* (-1/Phi)^n */
    const long double phi = 1.61803398874989484820458683436563812L;
    for (unsigned n = 1; n <= LAST; n++) {
        f[n] = n > 1 ? f[n - 1] + f[n - 2] : 1;
        powers[n] = powers[n - 1] / -phi;
    }
    long double sum = 0;
    for (unsigned n = LAST; n > 1; n--) {
        if (j >= f[n]) {
            j -= f[n];
            sum -= powers[n];
        }
    }
    assert_int_equal(j, 0);
    return sum - floorl(sum);
}

static void assert_fraction(uint64_t j) {
    const long double fraction = (long double)fibonacci_fraction(j) * 0x1p-64L;
    const long double difference = fabsl(fraction - fraction_by_fibonacci_numbers(j));
    assert_true(fminl(difference, 1 - difference) <= 2e-18L); /* 37 units of 2^-64: the sum's own */
}

static void fibonacci_fractions_are_exact(void **state) {
    (void)state;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    for (uint64_t j = 0; j < 1000; j++) {
        assert_fraction(j);
        assert_fraction(10000000 - j);
        assert_fraction(((uint64_t)1 << 40) - j);
        assert_fraction(UINT64_MAX - j);
        assert_fraction(ps_random_u64(&random));
    }
    for (unsigned bit = 0; bit < 64; bit++) {
        assert_fraction((uint64_t)1 << bit);
    }
    assert_fraction(591286729879); /* F_58, next to a whole number */
}

static void fibonacci_points_follow_their_definition(void **state) {
    (void)state;
    const struct {
        const char *name;
        size_t heights;
    } cases[] = {{"fibonacci", 1}, {"fibonacci-hemisphere", 2}};
    const size_t sizes[] = {1, 2, 3, 48, 1000, 100003};
    for (unsigned c = 0; c < 2; c++) {
        for (unsigned s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
            double *points = make_points(cases[c].name, sizes[s]);
            for (size_t j = 0; j < sizes[s]; j++) {
                const long double z =
                    1 - (2 * (long double)j + 1) / (long double)(cases[c].heights * sizes[s]);
                assert_near(points + 3 * j, z, PS_TWO_PI_L * fraction_by_fibonacci_numbers(j),
                            ROUNDINGS);
            }
            free(points);
        }
    }
}

/* The sine of the polar angle keeps all its digits next to the poles. */
static void fibonacci_points_are_right_at_the_poles(void **state) {
    (void)state;
    enum { N = 1 << 20 };
    double *points = make_points("fibonacci", N);
    for (size_t j = 0; j < N; j += j == 9 ? N - 20 : 1) {
        const long double north = 2 * (long double)j + 1;
        const long double s = sqrtl(north * (2 * (long double)N - north)) / N;
        const double *u = points + 3 * j;
        assert_true(fabsl(hypotl(u[0], u[1]) / s - 1) <= 3 * 0x1p-53L);
    }
    free(points);
}

/* ---- the spiral ---------------------------------------------------------------------------- */

static void the_spiral_follows_its_definition(void **state) {
    (void)state;
    const size_t sizes[] = {1, 2, 3, 48, 1001, 65536};
    for (unsigned s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        double *points = make_points("spiral", sizes[s]);
        for (size_t j = 0; j < sizes[s]; j++) {
            const long double n = (long double)sizes[s];
            const long double z = 1 - (2 * (long double)j + 1) / n;
            const long double phi = sqrtl(n * PS_PI_L) * asinl(z);
            /* asin itself passes 5e-20/cos on, which is what sqrt(N) makes of it at the poles */
            assert_near(points + 3 * j, z, phi, ROUNDINGS + 1e-19 * (double)n);
        }
        free(points);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(healpix_centres_are_where_the_paper_has_them),
        cmocka_unit_test(every_pixel_has_its_point),
        cmocka_unit_test(jittered_pixels_have_equal_areas),
        cmocka_unit_test(points_agree_with_the_reference),
        cmocka_unit_test(every_zphi_cell_has_its_point),
        cmocka_unit_test(zphi_cells_are_square_or_refused),
        cmocka_unit_test(fibonacci_fractions_are_exact),
        cmocka_unit_test(fibonacci_points_follow_their_definition),
        cmocka_unit_test(fibonacci_points_are_right_at_the_poles),
        cmocka_unit_test(the_spiral_follows_its_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
