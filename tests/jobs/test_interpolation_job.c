/* Kernel interpolation: one and two points in closed form, kernels, the bound of the native space,
 * functions and points that are turned together, a factor and conjugate gradients, several sets,
 * and what is refused. */
#include "harness.h"

#include "jobs/interpolation/interpolation_job.h"
#include "math/pi.h"
#include "math/sobolev.h"
#include "test_folder.h"

#include <math.h>
#include <unistd.h>

enum { SEED = 5, MOST_SMOOTHNESS = 3, MOST_POINTS = 64 };
static const double smoothness[MOST_SMOOTHNESS] = {1.5, 1.1, 1.9};

static void write_text(const char *name, const char *text) {
    assert_true(test_write_file(name, text, strlen(text)));
}

static int make_files(void **state) {
    if (test_folder_create(state) != 0 || chdir(((test_folder *)*state)->path) != 0) {
        return -1;
    }
    write_text("constant.txt", "0,0,3.5449077018110318,0\n"); /* 1 */
    write_text("linear.txt", "1,0,1,0\n");
    write_text("light.txt", "0,0,3,0\n1,0,1,0\n1,1,.5,-.25\n2,1,.1,.4\n3,3,.2,.1\n7,2,.05,-.3\n");
    /* a quarter of a turn about z: F_lm e^(-i m pi/2) */
    write_text("turned.txt",
               "0,0,3,0\n1,0,1,0\n1,1,-.25,-.5\n2,1,.4,-.1\n3,3,-.1,.2\n7,2,-.05,.3\n");
    write_text("pole.txt", "0 0 1\n");
    write_text("poles.txt", "0 0 1\n0 0 -1\n");
    write_text("nodes.txt", "1 0 0\n0 0 -1\n0 .6 .8\n.6 0 -.8\n0 0 1\n");
    write_text("equal.txt", "0 0 1\n0 1 0\n0 0 -1\n0 1 0\n");
    write_text("two.txt", "0 0 1\n0 1 0\n#\n1 0 0\n0 0 -1\n0 -1 0\n");
    write_text("first.txt", "0 0 1\n0 1 0\n");
    write_text("second.txt", "1 0 0\n0 0 -1\n0 -1 0\n");
    return 0;
}

static int remove_files(void **state) {
    return test_folder_remove(state) == 0 ? chdir("/") : -1;
}

/* ---- jobs ---------------------------------------------------------------------------------- */

typedef struct asked {
    ps_panorama panorama;
    ps_sampler_request request;
    const char *path;
    ps_interpolation_question question;
    ps_interpolation_job *job;
} asked;

/* Of a sampler, or of a file where num_points is 0. *out must not be moved. */
static void ask_given(asked *out, const ps_given_integrands *given, const char *integrand,
                      const char *source, size_t num_points) {
    *out = (asked){.request = {.num_points = num_points, .seed = SEED}, .path = source};
    assert_ok(ps_panorama_make(&out->panorama, NULL, given, &integrand, 1, error));
    assert_ok(ps_panorama_fill(&out->panorama, error));
    out->question = (ps_interpolation_question){.panorama = &out->panorama,
                                                .num_smoothness = MOST_SMOOTHNESS,
                                                .smoothness = smoothness,
                                                .num_realizations = 1,
                                                .point_options.domain = PS_DOMAIN_SPHERE,
                                                .limits.constraints.precision = -1};
    if (num_points > 0) {
        assert_ok(ps_sampler_parse(&out->request, source, error));
        assert_ok(ps_sampler_resolve(&out->request, error));
        out->question.sampler = &out->request;
    } else {
        out->question.paths = &out->path;
        out->question.num_paths = 1;
    }
}

static void ask(asked *out, const char *integrand, const char *source, size_t num_points) {
    const ps_given_integrands none = {0};
    ask_given(out, &none, integrand, source, num_points);
}

static void run(asked *self) {
    assert_ok(ps_interpolation_job_create(&self->job, &self->question, error));
    assert_ok(ps_interpolation_job_run(self->job, error));
}

static void forget(asked *self) {
    ps_interpolation_job_destroy(self->job);
    ps_panorama_free(&self->panorama);
}

typedef struct found {
    double rmse, norm, largest_error, residual;
    size_t num_steps;
} found;

static found row_of(const asked *self, size_t s) {
    const ps_interpolation_row *const row = ps_interpolation_job_row(self->job, s, 0);
    const uint64_t num = self->job->num_realizations;
    double square = 0;
    double norm = 0;
    double error = 0;
    ps_sums_finish(&row->squares, num, &square, &error);
    ps_sums_finish(&row->norms, num, &norm, &error);
    return (found){sqrt(square), sqrt(norm), row->largest_error, row->residual, row->num_steps};
}

static void assert_near(double a, double b, double relative) {
    assert_true(fabs(a - b) <= relative * fabs(b));
}

/* ---- laws ---------------------------------------------------------------------------------- */

/* f^ = K(u, pole)/c of the constant 1: the mean of |u - pole|^(4s-4)/c^2 is 4^(2s-2)/(2s-1)/c^2,
 * and the largest error is half a row from the other pole. */
static void one_point(void **state) {
    asked one;
    (void)state;
    ask(&one, "coefficients:file=constant.txt", "pole.txt", 0);
    run(&one);
    assert_int_equal(one.panorama.width * one.panorama.height, 512 * 256);
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        const double power = 2 * smoothness[s] - 2;
        const double c = ps_sobolev_constant(smoothness[s]);
        const double farthest = 2 * cos(PS_PI / 4 / 256);
        const found row = row_of(&one, s);
        assert_near(row.rmse, sqrt(pow(4, power) / (power + 1)) / c, 1e-4); /* of pixels */
        assert_near(row.largest_error, pow(farthest, power) / c, 1e-12);
        assert_near(row.norm, 1 / sqrt(c), 1e-14);
        assert_true(row.residual < 1e-15 && row.num_steps == 0);
    }
    forget(&one);
}

/* z at both poles: f^ = t^q - (1-t)^q with t = (1+z)/2 and q = s - 1, and |f^|^2 = 2 4^-q. */
static void two_points(void **state) {
    const double scale = sqrt(3 / PS_FOUR_PI);
    asked one;
    (void)state;
    ask(&one, "coefficients:file=linear.txt", "poles.txt", 0);
    run(&one);
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        const double q = smoothness[s] - 1;
        const double beta = tgamma(q + 1) * tgamma(q + 1) / tgamma(2 * q + 2);
        const double square =
            2 / (2 * q + 1) - 2 * beta + 1.0 / 3 - 4 * (2 / (q + 2) - 1 / (q + 1));
        const found row = row_of(&one, s);
        assert_near(row.rmse, scale * sqrt(square), 2e-3); /* of pixels: t^q is steep at poles */
        assert_near(row.norm, scale * sqrt(2 * pow(4, -q)), 1e-14);
    }
    forget(&one);
}

/* K(u, pole), payload being the smoothness. */
static pspec_status kernel(void *payload, size_t num, unsigned dimension, const double *points,
                           double *values, ps_error *failure) {
    static const double pole[] = {0, 0, 1};
    const double s = *(const double *)payload;
    assert_int_equal(dimension, 3);
    (void)failure;
    for (size_t i = 0; i < num; i++) {
        values[i] = ps_sobolev_constant(s) - ps_sobolev_distance(s, points + 3 * i, pole);
    }
    return PSPEC_OK;
}

/* One that is centred at a node is its own interpolant, whatever the other nodes. */
static void kernels_are_reproduced(void **state) {
    (void)state;
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        double own = smoothness[s];
        const ps_given_integrand integrand = {.name = "kernel", .values = kernel, .payload = &own};
        const ps_given_integrands given = {&integrand, 1};
        asked one;
        ask_given(&one, &given, "kernel", "nodes.txt", 0);
        one.question.smoothness = &own;
        one.question.num_smoothness = 1;
        run(&one);
        assert_true(row_of(&one, 0).rmse < 1e-14 && row_of(&one, 0).largest_error < 1e-13);
        assert_near(row_of(&one, 0).norm, sqrt(ps_sobolev_constant(own)), 1e-14);
        forget(&one);
    }
}

/* The part of the sphere that a pixel has is exact: the mean of 1 and that of f. */
static void shares_add_up(void **state) {
    asked one;
    double sum = 0;
    double mean = 0;
    (void)state;
    ask(&one, "coefficients:file=light.txt", "pole.txt", 0);
    for (size_t i = 0; i < one.panorama.height; i++) {
        for (size_t j = 0; j < one.panorama.width; j++) {
            sum += ps_panorama_share(&one.panorama, i);
            mean += ps_panorama_share(&one.panorama, i) *
                    one.panorama.values[i * one.panorama.width + j];
        }
    }
    assert_near(sum, 1, 1e-12);
    assert_near(mean, 3 / sqrt(PS_FOUR_PI), 1e-4);
    forget(&one);
}

/* |f|^2 in the space, of coefficients in the order of the files. */
static double square_norm(const ps_integrand *integrand, double s) {
    enum { LAST = 7, NUM = (LAST + 1) * (LAST + 2) };
    double f[NUM];
    double a[LAST + 1];
    double sum = 0;
    assert_ok(integrand->kind->coefficients(integrand, LAST, f, error));
    ps_sobolev_eigenvalues(s, LAST, a);
    for (size_t l = 0; l <= LAST; l++) {
        for (size_t m = 0; m <= l; m++) {
            const double *const own = f + 2 * (m * (2 * LAST + 1 - m) / 2 + l);
            sum += (m > 0 ? 2 : 1) * (own[0] * own[0] + own[1] * own[1]) / a[l];
        }
    }
    return sum;
}

/* c - k.K^-1 k at u. */
static double power_at(const double *u, size_t num, const double *points, double s) {
    ps_kernel_system *system = NULL;
    double row[2 * MOST_POINTS];
    assert_ok(ps_kernel_system_create(&system, num, points, s, NULL, error));
    for (size_t j = 0; j < num; j++) {
        row[j] = ps_sobolev_constant(s) - ps_sobolev_distance(s, u, points + 3 * j);
    }
    assert_ok(ps_kernel_system_solve(system, row, row + num, NULL, error));
    const double power = ps_sobolev_constant(s) - ps_kernel_dot(num, row, row + num);
    ps_kernel_system_destroy(system);
    return power;
}

/* (f - f^)(u)^2 <= (|f|^2 - |f^|^2) (c - k.K^-1 k), for f^ is a projection; and f^ is f at all
 * points. */
static void errors_are_bounded(void **state) {
    static const char *const functions[] = {"coefficients:file=constant.txt",
                                            "coefficients:file=linear.txt",
                                            "coefficients:file=light.txt"};
    enum { NUM = 60, STEP = 7919 };
    double points[3 * NUM];
    size_t num = 0;
    (void)state;
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        asked one;
        ask(&one, functions[i], "white-sphere", NUM);
        one.question.keeps_images = true;
        run(&one);
        assert_ok(ps_sampler_generate(&one.request, 0, points, &num, NULL, error));
        const size_t pixels = one.panorama.width * one.panorama.height;
        for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
            const found row = row_of(&one, s);
            const double square = square_norm(one.panorama.integrands[0], smoothness[s]);
            assert_true(row.residual < 1e-11);
            assert_true(row.norm * row.norm < square);
            for (size_t p = 0; p < pixels; p += STEP) {
                double row_of_pixels[3 * 512];
                ps_panorama_directions(&one.panorama, p / one.panorama.width, 1, row_of_pixels);
                const double off = one.job->images[s * pixels + p] - one.panorama.values[p];
                const double power = power_at(row_of_pixels + 3 * (p % one.panorama.width), NUM,
                                              points, smoothness[s]);
                assert_true(off * off <=
                            (square - row.norm * row.norm) * power * (1 + 1e-9) + 1e-24);
            }
        }
        forget(&one);
    }
}

/* A quarter of a turn of points and function moves pixels onto pixels. */
static void turns_change_nothing(void **state) {
    enum { NUM = 40 };
    double points[3 * NUM];
    size_t num = 0;
    asked first;
    asked turned;
    (void)state;
    ask(&first, "coefficients:file=light.txt", "white-sphere", NUM);
    run(&first);
    assert_ok(ps_sampler_generate(&first.request, 0, points, &num, NULL, error));
    FILE *const file = fopen("points.txt", "w");
    assert_non_null(file);
    for (size_t j = 0; j < NUM; j++) {
        fprintf(file, "%.17g %.17g %.17g\n", -points[3 * j + 1], points[3 * j], points[3 * j + 2]);
    }
    assert_int_equal(fclose(file), 0);
    ask(&turned, "coefficients:file=turned.txt", "points.txt", 0);
    run(&turned);
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        const found a = row_of(&first, s);
        const found b = row_of(&turned, s);
        assert_near(a.rmse, b.rmse, 1e-10);
        assert_near(a.largest_error, b.largest_error, 1e-10);
        assert_near(a.norm, b.norm, 1e-10);
    }
    forget(&first);
    forget(&turned);
}

/* With too little memory for a matrix: by a device if there is one. */
static void ways_agree(void **state) {
    enum { NUM = 600 };
    asked dense;
    asked other;
    (void)state;
    ask(&dense, "coefficients:file=light.txt", "white-sphere", NUM);
    run(&dense);
    ask(&other, "coefficients:file=light.txt", "white-sphere", NUM);
    other.question.limits.constraints.memory_limit = 2 << 20;
    run(&other);
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        const found a = row_of(&dense, s);
        const found b = row_of(&other, s);
        assert_true(a.num_steps == 0 && b.num_steps > 0);
        assert_near(b.rmse, a.rmse, 1e-8);
        assert_near(b.norm, a.norm, 1e-8);
        assert_true(b.residual < 1e-9);
    }
    forget(&dense);
    forget(&other);
}

/* Squares are means over sets, which may have different numbers of points. */
static void several_sets(void **state) {
    static const char *const paths[] = {"two.txt", "first.txt", "second.txt"};
    found rows[3][MOST_SMOOTHNESS];
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        asked one;
        ask(&one, "coefficients:file=light.txt", paths[i], 0);
        run(&one);
        assert_int_equal(one.job->num_realizations, i == 0 ? 2 : 1);
        assert_int_equal(one.job->num_points, i == 0 ? 5 : 1 + i);
        for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
            rows[i][s] = row_of(&one, s);
        }
        forget(&one);
    }
    for (size_t s = 0; s < MOST_SMOOTHNESS; s++) {
        assert_near(rows[0][s].rmse, hypot(rows[1][s].rmse, rows[2][s].rmse) / sqrt(2), 1e-14);
        assert_true(rows[0][s].largest_error ==
                    fmax(rows[1][s].largest_error, rows[2][s].largest_error));
    }
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void refuse(asked *self, pspec_status expected, const char *part) {
    ps_error failure = {0};
    pspec_status status = ps_interpolation_job_create(&self->job, &self->question, &failure);
    if (status == PSPEC_OK) {
        status = ps_interpolation_job_run(self->job, &failure);
    }
    assert_int_equal(status, expected);
    assert_non_null(strstr(failure.message, part));
    forget(self);
}

static void bad_sets_are_refused(void **state) {
    asked one;
    (void)state;
    ask(&one, "coefficients:file=light.txt", "equal.txt", 0);
    refuse(&one, PSPEC_ERROR_INPUT, "points 2 and 4 are equal");
    ask(&one, "coefficients:file=light.txt", "white-sphere", 1000000);
    one.question.limits.constraints.memory_limit = 100 << 20;
    refuse(&one, PSPEC_ERROR_MEMORY, "interpolation at 1000000 points takes");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_point),
        cmocka_unit_test(two_points),
        cmocka_unit_test(kernels_are_reproduced),
        cmocka_unit_test(shares_add_up),
        cmocka_unit_test(errors_are_bounded),
        cmocka_unit_test(turns_change_nothing),
        cmocka_unit_test(ways_agree),
        cmocka_unit_test(several_sets),
        cmocka_unit_test(bad_sets_are_refused),
    };
    return cmocka_run_group_tests_name("interpolation_job", tests, make_files, remove_files);
}
