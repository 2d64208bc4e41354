/* Shading integrals over random orientations: exact integrals against Gauss sums of light times
 * lobe, errors that are known in closed form, prediction against measurement, and the same bits in
 * any batches. */
#include "harness.h"

#include "jobs/shade/shade_job.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "test_folder.h"

#include <math.h>
#include <unistd.h>

enum { SEED = 5 };

static void write_text(const char *name, const char *text) {
    assert_true(test_write_file(name, text, strlen(text)));
}

static int make_files(void **state) {
    enum { WIDTH = 12, HEIGHT = 6 };
    FILE *map = NULL;
    uint64_t random = 9;
    if (test_folder_create(state) != 0 || chdir(((test_folder *)*state)->path) != 0) {
        return -1;
    }
    write_text("constant.txt", "0,0,2,0\n");
    write_text("linear.txt", "0,0,1,0\n1,0,1,0\n");
    write_text("light.txt", "0,0,3,0\n1,0,1,0\n1,1,.5,-.25\n2,1,.1,.4\n3,3,.2,.1\n7,2,.05,-.3\n");
    map = fopen("map.pfm", "wb");
    assert_non_null(map);
    fprintf(map, "Pf %d %d -1\n", WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float light = (float)test_uniform(&random);
        fwrite(&light, sizeof light, 1, map);
    }
    return fclose(map);
}

static int remove_files(void **state) {
    return test_folder_remove(state) == 0 ? chdir("/") : -1;
}

/* ---- exact integrals ----------------------------------------------------------------------- */

/* int F phat about r, by Gauss sums in the cosine z, from -1 to 0 and from 0 to 1, and means over
 * equal angles about r. */
static double integrate(const ps_light *light, const ps_brdf *brdf, const double *r) {
    enum { NODES = 40, TURNS = 64 };
    double nodes[NODES];
    double weights[NODES];
    const double least = fabs(r[0]) < 0.6 ? 1 : 0;
    double a[3] = {least - r[0] * (least > 0 ? r[0] : r[1]),
                   1 - least - r[1] * (least > 0 ? r[0] : r[1]), -r[2] * (least > 0 ? r[0] : r[1])};
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int k = 0; k < 3; k++) {
        a[k] /= length;
    }
    const double b[3] = {r[1] * a[2] - r[2] * a[1], r[2] * a[0] - r[0] * a[2],
                         r[0] * a[1] - r[1] * a[0]};
    double sum = 0;
    ps_gauss_legendre(NODES, nodes, weights);
    for (int i = 0; i < 2 * NODES * TURNS; i++) {
        const double z = nodes[i / TURNS % NODES] - (i < NODES * TURNS ? 1 : 0);
        const double sine = sqrt(1 - z * z);
        const double c = sine * cos(PS_TWO_PI * (i % TURNS) / TURNS);
        const double s = sine * sin(PS_TWO_PI * (i % TURNS) / TURNS);
        double u[3];
        double value = 0;
        for (int k = 0; k < 3; k++) {
            u[k] = z * r[k] + c * a[k] + s * b[k];
        }
        ps_integrand_values(light->integrand, u, 1, &value);
        sum += weights[i / TURNS % NODES] * PS_TWO_PI / TURNS * value * ps_brdf_density(brdf, z);
    }
    return sum;
}

static void exact_integrals(void **state) {
    static const char *const lobes[] = {"diffuse", "glossy:n=5", "glossy:n=3,cut=none",
                                        "phong:n=4"};
    static const double normals[][3] = {{0, 0, 1}, {0, 0, -1}, {0.6, 0, 0.8}, {-0.48, 0.6, -0.64}};
    (void)state;
    for (size_t i = 0; i < sizeof lobes / sizeof lobes[0]; i++) {
        ps_brdf *brdf = NULL;
        ps_light light;
        assert_ok(ps_brdf_parse(&brdf, lobes[i], error));
        assert_ok(ps_light_make(&light, "coefficients:file=light.txt", NULL, brdf, error));
        assert_int_equal(light.max_degree, 7);
        for (size_t k = 0; k < sizeof normals / sizeof normals[0]; k++) {
            const double expected = integrate(&light, brdf, normals[k]);
            assert_true(fabs(ps_light_shading(&light, normals[k]) - expected) < 1e-12);
        }
        assert_true(light.shading_bound < 1e-7); /* nothing is beyond, but rounding */
        ps_light_free(&light);
        ps_brdf_destroy(brdf);
    }
}

/* ---- jobs ---------------------------------------------------------------------------------- */

typedef struct asked {
    ps_brdf *brdf;
    ps_light light;
    ps_sampler_request request;
    ps_quadrature_question question;
    uint64_t num_orientations;
} asked;

/* *out must not be moved. */
static void ask(asked *out, const char *lobe, const char *integrand, const char *sampler,
                size_t num_points, uint64_t num_realizations) {
    *out = (asked){.request = {.num_points = num_points, .seed = SEED}};
    assert_ok(ps_brdf_parse(&out->brdf, lobe, error));
    assert_ok(ps_light_make(&out->light, integrand, NULL, out->brdf, error));
    assert_ok(ps_sampler_parse(&out->request, sampler, error));
    assert_ok(ps_sampler_resolve(&out->request, error));
    out->request.morph = ps_brdf_morph(out->brdf);
    out->num_orientations = PS_USUAL_ORIENTATIONS;
    out->question = (ps_quadrature_question){
        .brdf = out->brdf,
        .smoothness = 1.5,
        .sampler = &out->request,
        .num_realizations = num_realizations,
        .max_degree = out->light.max_degree < 64 ? out->light.max_degree : 64,
        .accuracy.tolerance = 1e-10,
        .limits.constraints = {.engine = "host_direct", .precision = -1}};
}

/* Of the rule; degree 1 has d_1^2 + C_1^2. */
typedef struct rule_squares {
    double degree_1, worst_case;
} rule_squares;

/* What is left of it is numbers. rule: NULL, or what is found. */
static ps_shade_job answer(asked *self, rule_squares *rule) {
    ps_shade_job out;
    ps_quadrature_job *job = NULL;
    assert_ok(ps_shade_job_make(&out, &self->light, self->num_orientations, SEED, &self->question,
                                error));
    assert_ok(ps_quadrature_job_create(&job, &self->question, error));
    assert_ok(ps_quadrature_job_run(job, error));
    if (rule != NULL) {
        const ps_quadrature_degree *const degree = &job->result.degrees[1];
        *rule = (rule_squares){degree->d2.mean + degree->c2.mean, job->result.squared.mean};
    }
    ps_quadrature_job_destroy(job);
    ps_shade_job_free(&out);
    return out;
}

static void forget(asked *job) {
    ps_light_free(&job->light);
    ps_brdf_destroy(job->brdf);
}

/* Equal weights have no error of a constant. F = a + Y_10 of any rule has |d_1|^2 + |C_1|^2 over
 * three. */
static void closed_forms(void **state) {
    asked job;
    (void)state;
    ask(&job, "diffuse", "coefficients:file=constant.txt", "fibonacci-hemisphere", 16, 1);
    ps_shade_job found = answer(&job, NULL);
    assert_int_equal(found.num_orientations, 1000);
    assert_true(found.measured.mean < 1e-28 && found.predicted.mean < 1e-28);
    forget(&job);
    ask(&job, "diffuse", "coefficients:file=linear.txt", "white-hemisphere", 2, 1);
    job.num_orientations = 20000;
    rule_squares rule;
    found = answer(&job, &rule);
    const double expected = rule.degree_1 / 3;
    assert_true(fabs(found.predicted.mean / expected - 1) < 1e-12);
    assert_true(found.beyond < 1e-14);
    assert_true(fabs(found.measured.mean - expected) < 4 * found.measured.standard_error);
    assert_true(found.measured.standard_error < 0.02 * expected);
    forget(&job);
}

/* A set alone, and several; weights that do not add up to 1, too; normals aside of the lobe. */
static void predictions_hold(void **state) {
    static const struct {
        const char *lobe, *integrand, *sampler;
        size_t num_points;
        uint64_t num_realizations;
        bool is_optimal;
        double view;
    } cases[] = {
        {"diffuse", "map:file=map.pfm", "fibonacci-hemisphere", 48, 1, false, 0},
        {"diffuse", "map:file=map.pfm", "fibonacci-hemisphere", 48, 1, true, 0},
        {"diffuse", "coefficients:file=light.txt", "fibonacci-hemisphere", 48, 1, false, 60},
        {"glossy:n=30", "map:file=map.pfm", "white-hemisphere", 32, 40, false, 0},
        {"glossy:n=30", "coefficients:file=light.txt", "white-hemisphere", 8, 40, true, 0},
        {"phong:n=5", "coefficients:file=light.txt", "white-hemisphere", 16, 40, false, 0},
        {"phong:n=20", "coefficients:file=light.txt", "white-hemisphere", 16, 1, false, 85},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        asked job;
        ps_horizon horizon;
        ask(&job, cases[i].lobe, cases[i].integrand, cases[i].sampler, cases[i].num_points,
            cases[i].num_realizations);
        assert_ok(ps_horizon_make(&horizon, job.brdf, cases[i].view, job.light.max_degree, error));
        job.question.horizon = cases[i].view > 0 ? &horizon : NULL;
        job.num_orientations = cases[i].num_realizations > 1 ? 50 : 2000;
        job.question.weights.kind = cases[i].is_optimal ? PS_WEIGHTS_OPTIMAL : PS_WEIGHTS_EQUAL;
        const ps_shade_job found = answer(&job, NULL);
        const double error = hypot(found.measured.standard_error, found.predicted.standard_error);
        assert_true(fabs(found.measured.mean - found.predicted.mean) < 3.5 * error);
        assert_true(error < 0.35 * found.predicted.mean);
        ps_horizon_free(&horizon);
        forget(&job);
    }
}

/* Of constant light what is above the horizon counts: points there, less the lobe there. */
static void lobes_are_cut(void **state) {
    enum { NUM = 40 };
    asked job;
    ps_horizon horizon;
    (void)state;
    ask(&job, "diffuse", "coefficients:file=constant.txt", "fibonacci-hemisphere", NUM, 1);
    assert_ok(ps_horizon_make(&horizon, job.brdf, 50, 1, error));
    job.question.horizon = &horizon;
    job.question.max_degree = 1;
    const ps_shade_job found = answer(&job, NULL);
    const double light = 2 / sqrt(PS_FOUR_PI); /* F_00 = 2 */
    const double points = sqrt(found.measured.mean) / light;
    const double above = (1 + cos(50 * PS_PI / 180)) / 2;
    const double whole = NUM * (above + points);
    const double other = NUM * (above - points);
    assert_true(fabs(whole - round(whole)) < 1e-9 || fabs(other - round(other)) < 1e-9);
    assert_true(fabs(found.predicted.mean / found.measured.mean - 1) < 1e-9);
    ps_horizon_free(&horizon);
    forget(&job);
}

/* Norm in the Sobolev space of s = 1.5, squared: sum_lm |F_lm|^2/a_l. */
static double squared_norm(const ps_integrand *light) {
    enum { LAST = 400 };
    double powers[LAST + 1];
    double a[LAST + 1];
    double sum = 0;
    assert_ok(ps_integrand_degrees(light, LAST, powers, error));
    ps_sobolev_eigenvalues(1.5, LAST, a);
    for (size_t l = 0; l <= LAST; l++) {
        sum += powers[l] / a[l];
    }
    return sum;
}

/* Light of norm 1 has no larger error than the worst case, whatever rule, lobe and weights; smooth
 * light has a much smaller one. */
static void worst_case_holds(void **state) {
    static const char *const lights[] = {"coefficients:file=light.txt", "lobe:n=40,axis=1x-2x2",
                                         "square:axis=1x1x1", "harmonic:degree=9"};
    static const char *const samplers[] = {"fibonacci-hemisphere", "white-hemisphere"};
    (void)state;
    for (size_t i = 0; i < 4 * sizeof lights / sizeof lights[0]; i++) {
        asked job;
        rule_squares rule;
        ask(&job, i % 2 == 0 ? "diffuse" : "glossy:n=10", lights[i / 4], samplers[i / 2 % 2], 24,
            1);
        job.question.weights.kind = i % 2 == 0 ? PS_WEIGHTS_EQUAL : PS_WEIGHTS_OPTIMAL;
        const ps_shade_job found = answer(&job, &rule);
        const double most = rule.worst_case * squared_norm(job.light.integrand);
        assert_true(found.measured.mean > 1e-8 * most && found.measured.mean < most);
        assert_true(found.predicted.mean < most);
        forget(&job);
    }
}

static void batches(void **state) {
    static const size_t sizes[] = {1, 3, 7};
    asked job;
    ps_shade_job first = {0};
    (void)state;
    ask(&job, "diffuse", "map:file=map.pfm", "white-hemisphere", 20, 9);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        job.question.batch = sizes[i];
        const ps_shade_job found = answer(&job, NULL);
        assert_int_equal(found.num_orientations, 112); /* 1000 in all */
        first = i == 0 ? found : first;
        assert_memory_equal(&found.measured, &first.measured, sizeof first.measured);
        assert_memory_equal(&found.predicted, &first.predicted, sizeof first.predicted);
    }
    forget(&job);
}

/* What N points have, N points have: a rung of the ladder, one between, and on the device as on the
 * host. More are needed for less, and none for nothing. */
static void points_of_equal_error(void **state) {
    static const size_t nums[] = {64, 90, 700};
    enum { NUM = sizeof nums / sizeof nums[0] };
    double errors[NUM + 2];
    double points[NUM + 2];
    double on_device[NUM + 2];
    asked job;
    ps_device *const device = test_open_device();
    (void)state;
    for (size_t i = 0; i < NUM; i++) {
        ask(&job, "diffuse", "coefficients:file=light.txt", "fibonacci-hemisphere", nums[i], 1);
        job.question.max_degree = job.light.max_degree;
        job.num_orientations = 0;
        errors[i] = sqrt(answer(&job, NULL).predicted.mean);
        if (i + 1 < NUM) {
            forget(&job);
        }
    }
    errors[NUM] = 0;
    errors[NUM + 1] = 1e9;
    ps_quadrature_question rules = {.brdf = job.brdf, .smoothness = 1.5};
    assert_ok(ps_shade_equal_points(&job.light, &rules, errors, NUM + 2, points, error));
    rules.open_device = device;
    assert_ok(ps_shade_equal_points(&job.light, &rules, errors, NUM + 2, on_device, error));
    for (size_t i = 0; i < NUM; i++) {
        assert_true(fabs(points[i] / (double)nums[i] - 1) < (i == 0 ? 1e-9 : 0.02));
        assert_true(fabs(on_device[i] / points[i] - 1) < 1e-6);
    }
    assert_true(isnan(points[NUM]));
    assert_true(points[NUM + 1] == 1);
    forget(&job);
    ps_device_close(device);
}

/* (u.e)^2 by the cosine about r: 1/3 + (2/3)(1/4) P_2(r.e), the diffuse lobe having 1/4 of degree
 * 2; of the plane, no light. */
static void light_about_an_axis(void **state) {
    static const double r[][3] = {{0, 0, 1}, {0.6, -0.8, 0}, {2. / 3, 1. / 3, -2. / 3}};
    ps_brdf *brdf = NULL;
    ps_light light;
    ps_error failure = {0};
    (void)state;
    assert_ok(ps_brdf_parse(&brdf, "diffuse", error));
    assert_ok(ps_light_make(&light, "square:axis=1x2x-2", NULL, brdf, error));
    for (size_t i = 0; i < sizeof r / sizeof r[0]; i++) {
        const double z = (r[i][0] + 2 * r[i][1] - 2 * r[i][2]) / 3;
        assert_true(fabs(ps_light_shading(&light, r[i]) - 0.25 * (1 + z * z)) < 1e-15);
    }
    ps_light_free(&light);
    assert_int_equal(ps_light_make(&light, "disk", NULL, brdf, &failure),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_light_free(&light);
    ps_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_integrals),     cmocka_unit_test(closed_forms),
        cmocka_unit_test(predictions_hold),    cmocka_unit_test(batches),
        cmocka_unit_test(light_about_an_axis), cmocka_unit_test(points_of_equal_error),
        cmocka_unit_test(worst_case_holds),    cmocka_unit_test(lobes_are_cut),
    };
    return cmocka_run_group_tests_name("shade_job", tests, make_files, remove_files);
}
