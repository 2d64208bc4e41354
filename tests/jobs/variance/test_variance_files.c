/* Variances of point files: single sets of the references in brackets and against their pairs,
 * halves of many sets, weights, what is measured of one set. */
#include "harness_sphere.h"
#include "harness_variance.h"
#include "test_folder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void near(const char *what, double found, double expected, double allowed) {
    if (!(fabs(found - expected) <= allowed)) {
        fail_msg("%s: %.17g, not %.17g within %g", what, found, expected, allowed);
    }
}

/* ---- files --------------------------------------------------------------------------------- */

static void write_set(FILE *file, const pspec_pattern *set) {
    for (size_t j = 0; j < set->num_points; j++) {
        for (unsigned i = 0; i < set->dimension; i++) {
            fprintf(file, "%.17g ", set->points[j * set->dimension + i]);
        }
        fprintf(file, set->weights != NULL ? "%.17g\n" : "\n",
                set->weights != NULL ? set->weights[j] : 0);
    }
}

/* Sets as lines of text with one between two of them. */
static void write_sets(const char *path, const pspec_pattern *sets, size_t num) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < num; i++) {
        fputs(i > 0 ? "#\n" : "", file);
        write_set(file, &sets[i]);
    }
    assert_int_equal(fclose(file), 0);
}

/* Of one integrand, by the host's referee, for which `path` must stay. */
static void ask(test_variance *out, const char *const *path, bool has_weights,
                ps_sampler_domain where, const char *integrand) {
    *out = (test_variance){
        .question = {.spectrum = {.paths = path,
                                  .num_paths = 1,
                                  .point_options.domain = where == PS_SAMPLES_TORUS
                                                              ? PS_DOMAIN_TORUS
                                                              : PS_DOMAIN_SPHERE,
                                  .point_options.weight_column = has_weights,
                                  .point_options.format = "utk-text",
                                  .on_sphere = where != PS_SAMPLES_TORUS,
                                  .on_hemisphere = where == PS_SAMPLES_HEMISPHERE,
                                  .wants_full_array = true,
                                  .normalization = PSPEC_NORMALIZATION_INTEGRAL,
                                  .accuracy.tolerance = 1e-6,
                                  .limits.constraints = {.engine = "host_direct", .precision = -1}},
                     .texts = out->texts,
                     .made = &out->made,
                     .num_shifts = 1,
                     .single_shifts = 2000,
                     .seed = 1,
                     .is_moved = true}};
    test_variance_add(out, integrand);
}

/* ---- single sets --------------------------------------------------------------------------- */

/* W, V and sum |w|; what a file of references says of sets without weights is of 1/N. */
static void sum_weights(const test_set *set, double sums[3]) {
    memset(sums, 0, 3 * sizeof *sums);
    for (size_t j = 0; j < set->num_points; j++) {
        const double weight = set->weights != NULL ? set->weights[j] : 1;
        sums[0] += weight;
        sums[1] += weight * weight;
        sums[2] += fabs(weight);
    }
}

/* What pairs sum to is in the bracket, is the reference, and what moves measure. Rounding, of which
 * pairs have more, is that of the integral of F^2 times what signs take away. */
static void check_single(const test_folder *folder, const test_set *set, ps_sampler_domain where,
                         const char *text, double exact) {
    char buffer[TEST_PATH_BYTES];
    const char *const path = test_path(folder, "set.txt", buffer);
    const pspec_pattern pattern = test_pattern(set);
    double sums[3];
    test_variance asked;
    sum_weights(set, sums);
    const double num_points = (double)set->num_points;
    const double signs = pow(sums[2] / sums[0], 2);
    write_sets(path, &pattern, 1);
    ask(&asked, &path, set->weights != NULL, where, text);
    const ps_variance_row *const row = test_variance_run(&asked);
    const ps_integrand *const integrand = test_variance_integrand(&asked, 0);
    const double whole = ps_integrand_factor(integrand) * ps_integrand_energy(integrand) +
                         pow(ps_integrand_integral(integrand), 2);
    const double rounding = 1e-13 * signs * whole;
    assert_true(row->pairwise >= row->prediction.lower - rounding);
    assert_true(row->pairwise <= row->prediction.upper + rounding);
    if (!isnan(exact)) {
        near(set->name, row->pairwise, exact, 1e-6 * exact + rounding);
    }
    near(set->name, row->measured, row->pairwise, 5 * row->measured_error + rounding);
    assert_true(row->prediction.standard_error == 0);
    assert_true(asked.job->beyond.is_known);
    const ps_power_beyond *const beyond = &asked.job->beyond;
    const double allowed = 1e-12 * num_points * signs;
    near(set->name, beyond->most, num_points * signs, allowed);
    near(set->name, beyond->white, num_points * sums[1] / (sums[0] * sums[0]), allowed);
    test_variance_free(&asked);
}

/* All images of the references are of 4 x 3 pixels. */
static void write_image(const char *path, const cJSON *rows) {
    enum { PIXELS = 4 * 3 };
    double image[PIXELS];
    size_t num = 0;
    const cJSON *row = NULL;
    const cJSON *pixel = NULL;
    cJSON_ArrayForEach(row, rows) {
        cJSON_ArrayForEach(pixel, row) {
            assert_true(num < PIXELS);
            image[num++] = test_number(pixel);
        }
    }
    assert_int_equal(num, PIXELS);
    assert_true(test_write_array(path, "<f8", "False", "(4, 3)", image, sizeof image));
}

static void describe(const test_folder *folder, char *text, size_t size, const cJSON *row) {
    const char *const name = cJSON_GetStringValue(cJSON_GetObjectItem(row, "integrand"));
    if (strcmp(name, "cap") == 0) {
        snprintf(text, size, "cap:angle=%.17g", test_field(row, "theta0"));
    } else if (strcmp(name, "disk") == 0) {
        snprintf(text, size, "disk:radius=%.17g", test_field(row, "r"));
    } else if (strcmp(name, "gaussian_periodised") == 0) {
        snprintf(text, size, "gaussian:sigma=%.17g", test_field(row, "sigma"));
    } else if (strcmp(name, "pixel_image") == 0) {
        char path[TEST_PATH_BYTES];
        write_image(test_path(folder, "image.npy", path),
                    cJSON_GetObjectItem(row, "pixels[ix][iy]"));
        snprintf(text, size, "pixels:file=%s", path);
    } else {
        snprintf(text, size, "harmonic:degree=4");
    }
}

static unsigned check_file(const test_folder *folder, const char *name, ps_sampler_domain where,
                           const char *key) {
    cJSON *const json = test_read_reference(name);
    const cJSON *one = NULL;
    unsigned num = 0;
    cJSON_ArrayForEach(one, cJSON_GetObjectItem(json, "sets")) {
        const cJSON *row = NULL;
        test_set set = where == PS_SAMPLES_TORUS ? test_read_set(one) : test_read_sphere_set(one);
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(one, "variance")) {
            char text[TEST_PATH_BYTES + 16];
            describe(folder, text, sizeof text, row);
            check_single(folder, &set, where, text, test_field(row, key));
            num++;
        }
        if (where == PS_SAMPLES_HEMISPHERE) {
            check_single(folder, &set, where, "square", test_field(one, key));
            check_single(folder, &set, where, "cap", NAN);
            num += 2;
        }
        test_free_set(&set);
    }
    cJSON_Delete(json);
    return num;
}

static void brackets_have_the_pairs_of_single_sets(void **state) {
    const test_folder *const folder = *state;
    assert_true(check_file(folder, "torus.json", PS_SAMPLES_TORUS, "var_random_shift") >= 21);
    assert_int_equal(check_file(folder, "sphere.json", PS_SAMPLES_SPHERE, "var_random_rotation"),
                     24);
    assert_true(
        check_file(folder, "hemisphere_m18.json", PS_SAMPLES_HEMISPHERE, "projective_var_z2") >= 8);
}

/* Larger sets have no pairs, and several sets are no single one. */
static void pairs_are_of_small_single_sets(void **state) {
    const test_folder *const folder = *state;
    char buffer[TEST_PATH_BYTES];
    const char *const path = test_path(folder, "sets.txt", buffer);
    const size_t num = PS_MOST_PAIRWISE_POINTS + 1;
    double *const points = calloc(2 * num, sizeof *points);
    uint64_t random = 1;
    assert_non_null(points);
    for (size_t i = 0; i < 2 * num; i++) {
        points[i] = test_uniform(&random);
    }
    for (size_t more = 0; more < 3; more++) {
        const pspec_pattern sets[2] = {{2, num - (more != 1), points, NULL},
                                       {2, num - 1, points + 1, NULL}};
        test_variance asked;
        write_sets(path, sets, more == 2 ? 2 : 1);
        ask(&asked, &path, false, PS_SAMPLES_TORUS, "disk");
        asked.question.spectrum.frequencies.max_frequency = 2;
        const ps_variance_row *const row = test_variance_run(&asked);
        assert_true(isnan(row->pairwise) == (more > 0));
        test_variance_free(&asked);
    }
    free(points);
}

/* ---- halves -------------------------------------------------------------------------------- */

/* The estimate of a set where it is, as its definition has it. */
static double square_of(const ps_integrand *integrand, const pspec_pattern *set) {
    double sum = 0;
    double weights = 0;
    for (size_t j = 0; j < set->num_points; j++) {
        const double weight = set->weights != NULL ? set->weights[j] : 1;
        double value = 0;
        ps_integrand_values(integrand, set->points + j * set->dimension, 1, &value);
        sum += weight * value;
        weights += weight;
    }
    return pow(sum / weights - ps_integrand_integral(integrand), 2);
}

/* Five sets of 3, 4, .. points, with weights or without: three predict, and two are measured. */
enum { NUM_SETS = 5, NUM_PREDICTING = 3, FEWEST = 3, MOST = FEWEST + NUM_SETS - 1 };

typedef struct five {
    double points[NUM_SETS][2 * MOST], weights[NUM_SETS][MOST];
    pspec_pattern sets[NUM_SETS];
    double mean, white; /* of N, and of V/W^2, of those that predict */
} five;

static void make_five(five *out, bool has_weights) {
    uint64_t random = 7;
    out->mean = FEWEST + 1;
    out->white = 0;
    for (size_t i = 0; i < NUM_SETS; i++) {
        double sum = 0;
        double squares = 0;
        for (size_t j = 0; j < FEWEST + i; j++) {
            out->points[i][2 * j] = test_uniform(&random);
            out->points[i][2 * j + 1] = test_uniform(&random);
            const double weight = has_weights ? 0.5 + test_uniform(&random) : 1;
            out->weights[i][j] = weight;
            sum += weight;
            squares += weight * weight;
        }
        out->sets[i] =
            (pspec_pattern){2, FEWEST + i, out->points[i], has_weights ? out->weights[i] : NULL};
        out->white += i < NUM_PREDICTING ? squares / (sum * sum) / NUM_PREDICTING : 0;
    }
}

/* mean(N) sum_k mean(|S|^2/W^2) |f_k|^2 over the first sets and the box to K, over N. */
static double sum_first(const five *data, const ps_integrand *integrand, int32_t limit,
                        double *held) {
    const double two_pi = 2 * acos(-1.0);
    double sum = 0;
    *held = 0;
    for (int32_t i = 0; i < (2 * limit + 1) * (2 * limit + 1); i++) {
        const int32_t k[2] = {i % (2 * limit + 1) - limit, i / (2 * limit + 1) - limit};
        double power = 0;
        if (k[0] == 0 && k[1] == 0) {
            continue;
        }
        assert_ok(ps_integrand_powers(integrand, k, 1, &power, error));
        *held += power;
        for (size_t r = 0; r < NUM_PREDICTING; r++) {
            double re = 0;
            double im = 0;
            double weights = 0;
            for (size_t j = 0; j < data->sets[r].num_points; j++) {
                const double *const x = data->points[r] + 2 * j;
                re += data->weights[r][j] * cos(two_pi * (k[0] * x[0] + k[1] * x[1]));
                im += data->weights[r][j] * sin(two_pi * (k[0] * x[0] + k[1] * x[1]));
                weights += data->weights[r][j];
            }
            sum += power * (re * re + im * im) / (weights * weights) / NUM_PREDICTING;
        }
    }
    return sum;
}

static void the_first_half_predicts_and_the_second_is_measured(void **state) {
    enum { LIMIT = 3 };
    const test_folder *const folder = *state;
    char buffer[TEST_PATH_BYTES];
    const char *const path = test_path(folder, "sets.txt", buffer);
    for (int has_weights = 0; has_weights < 2; has_weights++) {
        five all;
        test_variance asked;
        double held = 0;
        make_five(&all, has_weights == 1);
        write_sets(path, all.sets, NUM_SETS);
        ask(&asked, &path, has_weights == 1, PS_SAMPLES_TORUS, "gaussian:sigma=0.1");
        asked.question.spectrum.frequencies.max_frequency = LIMIT;
        asked.question.is_moved = false;
        const ps_variance_row *const row = test_variance_run(&asked);
        const ps_integrand *const integrand = test_variance_integrand(&asked, 0);
        const double a = square_of(integrand, &all.sets[NUM_PREDICTING]);
        const double b = square_of(integrand, &all.sets[NUM_PREDICTING + 1]);
        const double sum = sum_first(&all, integrand, LIMIT, &held);
        near("measured", row->measured, (a + b) / 2, 1e-12 * (a + b));
        near("measured_error", row->measured_error, fabs(a - b) / 2, 1e-12 * (a + b));
        assert_true(isnan(row->z_score) && isnan(row->pairwise));
        near("mean of N", test_variance_spectrum(&asked)->mean_points, all.mean, 0);
        near("lower", row->prediction.lower, sum, 1e-12 * sum);
        near("the rest", row->prediction.variance - sum,
             all.white * (ps_integrand_energy(integrand) - held), 1e-12 * sum);
        near("white", row->prediction.white, ps_integrand_energy(integrand) / all.mean, 1e-15);
        test_variance_free(&asked);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(brackets_have_the_pairs_of_single_sets),
        cmocka_unit_test(pairs_are_of_small_single_sets),
        cmocka_unit_test(the_first_half_predicts_and_the_second_is_measured),
    };
    return cmocka_run_group_tests(tests, test_folder_create, test_folder_remove);
}
