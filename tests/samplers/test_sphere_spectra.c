/* Angular power of the sphere's samplers, as P(l) = (1/N) sum_ij P_l(u_i.u_j): exact expectations
 * of white noise and of stratified points (reference/tables.json), zeros of HEALPix, invariance
 * under rotation. */
#include "harness.h"
#include "test_samplers.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_DEGREE = 16, NUM_SIGMAS = 5 };

static ps_sampler_request resolve_request(const char *text, size_t num_points) {
    ps_sampler_request request = parse_request(text, num_points, 0);
    assert_ok(ps_sampler_resolve(&request, error));
    return request;
}

/* Adds factor P_l(x) for l = 0 .. MAX_DEGREE. */
static void add_pair(double x, double factor, double sums[MAX_DEGREE + 1]) {
    double previous = 1;
    double current = x;
    sums[0] += factor;
    for (unsigned l = 1; l <= MAX_DEGREE; l++) {
        sums[l] += factor * current;
        const double next = ((2 * l + 1) * x * current - l * previous) / (l + 1);
        previous = current;
        current = next;
    }
}

static void power_of(const ps_sampler_request *request, uint64_t realization,
                     double power[MAX_DEGREE + 1]) {
    const size_t n = request->num_points;
    double *points = generate_points(request, realization);
    memset(power, 0, (MAX_DEGREE + 1) * sizeof *power);
    for (size_t i = 0; i < n; i++) {
        const double *u = points + 3 * i;
        add_pair(1, 1, power);
        for (size_t j = 0; j < i; j++) {
            const double *v = points + 3 * j;
            add_pair(u[0] * v[0] + u[1] * v[1] + u[2] * v[2], 2, power);
        }
    }
    for (unsigned l = 0; l <= MAX_DEGREE; l++) {
        power[l] /= (double)n;
    }
    free(points);
}

typedef struct estimate {
    double mean[MAX_DEGREE + 1], error[MAX_DEGREE + 1];
} estimate;

static estimate estimate_power(const ps_sampler_request *request, uint64_t num_realizations) {
    double sums[MAX_DEGREE + 1] = {0};
    double squares[MAX_DEGREE + 1] = {0};
    for (uint64_t r = 0; r < num_realizations; r++) {
        double power[MAX_DEGREE + 1];
        power_of(request, r, power);
        for (unsigned l = 0; l <= MAX_DEGREE; l++) {
            sums[l] += power[l];
            squares[l] += power[l] * power[l];
        }
    }
    estimate result;
    const double m = (double)num_realizations;
    for (unsigned l = 0; l <= MAX_DEGREE; l++) {
        result.mean[l] = sums[l] / m;
        result.error[l] = sqrt(fmax(0, squares[l] / m - result.mean[l] * result.mean[l]) / m);
    }
    return result;
}

static void assert_expected(const estimate *found, unsigned l, double expected) {
    if (!(fabs(found->mean[l] - expected) <= NUM_SIGMAS * found->error[l] + 1e-12)) {
        fail_msg("l=%u: %.6g +- %.2g, expected %.6g", l, found->mean[l], found->error[l], expected);
    }
}

static void white_noise_has_power_1(void **state) {
    (void)state;
    const char *const names[] = {"white-sphere", "white:lift=sphere", "white-hemisphere"};
    for (unsigned i = 0; i < 3; i++) {
        ps_sampler_request request = resolve_request(names[i], 20);
        request.homogenize = i == 2;
        const estimate found = estimate_power(&request, 2000);
        for (unsigned l = 1; l <= MAX_DEGREE; l++) {
            if (i < 2 || l % 2 == 0) { /* the hemisphere has even degrees only */
                assert_expected(&found, l, 1);
            }
        }
    }
}

/* Every table of reference/tables.json under the key; name makes the sampler's text of a table. */
static void assert_tables(const char *key, void (*name)(const cJSON *, char *text, size_t bytes)) {
    cJSON *tables = test_read_reference("tables.json");
    const cJSON *table = NULL;
    cJSON_ArrayForEach(table, cJSON_GetObjectItem(tables, key)) {
        char text[64];
        name(table, text, sizeof text);
        const cJSON *rows = cJSON_GetObjectItem(table, "rows");
        const size_t n =
            (size_t)(test_number(cJSON_GetArrayItem(cJSON_GetArrayItem(rows, 0), 1)) + 0.5);
        ps_sampler_request request = resolve_request(text, n);
        for (unsigned i = 0; i < 2; i++) {
            request.homogenize = i == 1;
            const estimate found = estimate_power(&request, 40000 / n);
            const cJSON *row = NULL;
            cJSON_ArrayForEach(row, rows) {
                const int l = cJSON_GetArrayItem(row, 0)->valueint;
                if (l > 0 && l <= MAX_DEGREE) {
                    assert_expected(&found, (unsigned)l, test_number(cJSON_GetArrayItem(row, 1)));
                }
            }
        }
    }
    cJSON_Delete(tables);
}

static void name_zphi(const cJSON *table, char *text, size_t bytes) {
    snprintf(text, bytes, "zphi:strata=%dx%d", cJSON_GetObjectItem(table, "n_z")->valueint,
             cJSON_GetObjectItem(table, "n_phi")->valueint);
}

static void zphi_cells_have_their_spectrum(void **state) {
    (void)state;
    assert_tables("zphi_strata", name_zphi);
}

static void name_healpix(const cJSON *table, char *text, size_t bytes) {
    snprintf(text, bytes, "healpix-jittered:nside=%d",
             cJSON_GetObjectItem(table, "nside")->valueint);
}

static void jittered_pixels_have_their_spectrum(void **state) {
    (void)state;
    assert_tables("healpix_jittered", name_healpix);
}

static void healpix_centres_have_no_odd_degrees(void **state) {
    (void)state;
    for (unsigned nside = 1; nside <= 5; nside++) {
        const ps_sampler_request request = resolve_request("healpix", (size_t)12 * nside * nside);
        double power[MAX_DEGREE + 1];
        power_of(&request, 0, power);
        for (unsigned l = 1; l <= MAX_DEGREE; l += 2) {
            assert_true(fabs(power[l]) < 1e-12);
        }
        assert_true(fabs(power[0] - (double)request.num_points) < 1e-9);
    }
}

/* Rotations change no power; folding, none of an even degree. */
static void constant_power_is_constant(void **state) {
    (void)state;
    const char *const names[] = {"fibonacci", "spiral", "healpix", "fibonacci-hemisphere",
                                 "sobol:lift=hemisphere"};
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        ps_sampler_request request = resolve_request(names[i], 192);
        double plain[MAX_DEGREE + 1];
        double rotated[MAX_DEGREE + 1];
        power_of(&request, 0, plain);
        request.homogenize = true;
        power_of(&request, 5, rotated);
        assert_true(ps_sampler_has_constant_power(&request));
        for (unsigned l = 0; l <= MAX_DEGREE; l++) {
            if (l % 2 == 0 || !ps_sampler_is_on_hemisphere(&request)) {
                assert_true(fabs(plain[l] - rotated[l]) < 1e-11);
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_noise_has_power_1),
        cmocka_unit_test(zphi_cells_have_their_spectrum),
        cmocka_unit_test(jittered_pixels_have_their_spectrum),
        cmocka_unit_test(healpix_centres_have_no_odd_degrees),
        cmocka_unit_test(constant_power_is_constant),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
