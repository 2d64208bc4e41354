/* Truncated inner products and their equivalent numbers of points: tests/reference,
 * docs/mathematics/quadrature.md#truncation and Table 1 of Marques et al. */
#include "harness.h"

#include "rules/truncation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAST = 60 };

typedef struct subject {
    ps_brdf *brdf;
    ps_representer representer;
    double errors[LAST + 1], bounds[LAST + 1];
    size_t sh_degree;
} subject;

static subject *make(const char *text, double s, bool on_hemisphere) {
    subject *lobe = calloc(1, sizeof *lobe);
    assert_ok(ps_brdf_parse(&lobe->brdf, text, error));
    assert_ok(ps_representer_create(&lobe->representer, lobe->brdf, s, 1e-13, 4 * LAST, error));
    if (on_hemisphere) {
        assert_ok(ps_truncation_hemispherical(lobe->brdf, s, LAST, 1e-3, lobe->errors, lobe->bounds,
                                              &lobe->sh_degree, error));
    } else {
        assert_ok(
            ps_truncation_spherical(&lobe->representer, LAST, lobe->errors, lobe->bounds, error));
    }
    return lobe;
}

static void drop(subject *lobe) {
    ps_brdf_destroy(lobe->brdf);
    ps_representer_destroy(&lobe->representer);
    free(lobe);
}

static double cell(const cJSON *row, int column) {
    return test_number(cJSON_GetArrayItem(row, column));
}

static void assert_near(double value, double exact, double relative, double absolute) {
    if (!(fabs(value - exact) <= relative * fabs(exact) + absolute)) {
        fail_msg("%.17g is not %.17g", value, exact);
    }
}

/* ---- tables -------------------------------------------------------------------------------- */

static void spherical_reference(void **state) {
    cJSON *json = test_read_reference("tables.json");
    const cJSON *table = NULL;
    (void)state;
    cJSON_ArrayForEach(table, cJSON_GetObjectItem(json, "sh_truncation")) {
        subject *diffuse = make("diffuse", test_field(table, "s"), false);
        subject *glossy = make("glossy:n=30", test_field(table, "s"), false);
        const cJSON *row = NULL;
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(table, "rows")) {
            const size_t l = (size_t)cell(row, 0);
            assert_true(l <= LAST);
            assert_near(diffuse->errors[l], cell(row, 1), 1e-11, diffuse->bounds[l]);
            assert_near(glossy->errors[l], cell(row, 2), 1e-11, glossy->bounds[l]);
            assert_true(diffuse->bounds[l] <= 1e-6 * diffuse->errors[l]);
        }
        drop(diffuse);
        drop(glossy);
    }
    cJSON_Delete(json);
}

/* The reference ends at X = 300, and so leaves out at most what it says. */
static void hemispherical_reference(void **state) {
    cJSON *json = test_read_reference("tables.json");
    const cJSON *tables =
        cJSON_GetObjectItem(cJSON_GetObjectItem(json, "hsh_truncation_glossy"), "tables");
    const cJSON *table = NULL;
    (void)state;
    cJSON_ArrayForEach(table, tables) {
        subject *lobe = make("glossy:n=30", test_field(table, "s"), true);
        const cJSON *row = NULL;
        cJSON_ArrayForEach(row, cJSON_GetObjectItem(table, "rows")) {
            const size_t l = (size_t)cell(row, 0);
            const double low = cell(row, 1);
            const double high = sqrt(low * low + cell(row, 2) * cell(row, 2));
            assert_true(l <= LAST);
            assert_true(lobe->errors[l] >= low - lobe->bounds[l] - 1e-12);
            assert_true(lobe->errors[l] <= high + lobe->bounds[l] + 1e-12);
        }
        drop(lobe);
    }
    cJSON_Delete(json);
}

/* ---- values of docs/mathematics/quadrature.md#truncation ------------------------ */

typedef struct value {
    size_t degree;
    double error, points; /* 0: not given */
} value;

/* The documents round to the digits that they print: relative tells how far. */
static void check_values(const char *brdf, bool on_hemisphere, const value *values, size_t num,
                         double relative, double points_relative) {
    subject *lobe = make(brdf, 1.5, on_hemisphere);
    ps_equal_error equal = {.representer = &lobe->representer, .morph = ps_brdf_morph(lobe->brdf)};
    for (size_t i = 0; i < num; i++) {
        const double error_of_degree = lobe->errors[values[i].degree];
        assert_near(error_of_degree, values[i].error, relative, 0);
        if (values[i].points > 0) {
            double points = 0;
            assert_ok(ps_equal_error_points(&equal, error_of_degree, &points, error));
            assert_near(points, values[i].points, points_relative, 0.5);
        }
    }
    drop(lobe);
}

static void printed_values(void **state) {
    static const value diffuse[] = {{0, .606, 0},        {1, .1096, 0},       {2, 9.861e-3, 328},
                                    {3, 9.861e-3, 328},  {4, 2.656e-3, 1843}, {5, 2.656e-3, 1843},
                                    {6, 1.066e-3, 6200}, {7, 1.066e-3, 6200}, {8, 5.291e-4, 1.6e4}};
    static const value glossy[] = {{4, .152, 0},       {8, .0303, 0},      {10, 1.210e-2, 134},
                                   {11, 7.38e-3, 256}, {12, 4.40e-3, 506}, {13, 2.560e-3, 1034},
                                   {14, 1.45e-3, 2186}};
    static const value hemispherical[] = {{6, 1.75e-2, 83},
                                          {7, 8.91e-3, 200},
                                          {8, 4.353e-3, 514},
                                          {9, 2.035e-3, 1400},
                                          {10, 9.10e-4, 4060}};
    (void)state;
    /* half a unit of the third digit; 6200 and 1.6e4 are "about" */
    check_values("diffuse", false, diffuse, sizeof diffuse / sizeof *diffuse, 1.5e-3, 0.03);
    check_values("glossy:n=30", false, glossy, sizeof glossy / sizeof *glossy, 4e-3, 0.01);
    check_values("glossy:n=30", true, hemispherical, sizeof hemispherical / sizeof *hemispherical,
                 3e-3, 0.01);
}

/* Table 1: first L with E <= 2.7e-3, and N with E_SF(N) = 2.5e-3. */
static void table_1(void **state) {
    static const struct {
        const char *brdf;
        bool on_hemisphere;
        size_t degree;
        double points;
    } rows[] = {{"diffuse", false, 4, 2002},
                {"glossy:n=30", false, 13, 1072},
                {"glossy:n=30", true, 9, 1072}};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        subject *lobe = make(rows[i].brdf, 1.5, rows[i].on_hemisphere);
        ps_equal_error equal = {.representer = &lobe->representer,
                                .morph = ps_brdf_morph(lobe->brdf)};
        double points = 0;
        size_t l = 0;
        while (lobe->errors[l] > 2.7e-3) {
            l++;
        }
        assert_int_equal(l, rows[i].degree);
        assert_ok(ps_equal_error_points(&equal, 2.5e-3, &points, error));
        print_message("%s: L = %zu, N = %.1f\n", rows[i].brdf, l, points);
        assert_near(points, rows[i].points, 0.01, 0);
        drop(lobe);
    }
}

/* ---- laws ---------------------------------------------------------------------------------- */

static void laws(void **state) {
    static const char *const lobes[] = {"diffuse", "glossy:n=0.5", "glossy:n=300", "phong:n=2.5",
                                        "phong:n=20"};
    (void)state;
    for (size_t i = 0; i < sizeof lobes / sizeof lobes[0]; i++) {
        for (double s = 1.1; s < 2; s += 0.4) {
            subject *sh = make(lobes[i], s, false);
            subject *hsh = make(lobes[i], s, true);
            const double first = sh->representer.a[0] * sh->representer.b[0] * sh->representer.b[0];
            const double kappa_0 = sh->representer.kappa_0;
            assert_near(sh->errors[0] * sh->errors[0] + first, kappa_0, 1e-13, 0);
            for (size_t l = 1; l <= LAST; l++) {
                assert_true(sh->errors[l] <= sh->errors[l - 1]);
                assert_true(sh->bounds[l] >= 0 && hsh->bounds[l] >= 0);
            }
            drop(sh);
            drop(hsh);
        }
    }
}

/* Two hemispherical degrees are the whole diffuse lobe, and n + 1 a Phong lobe of a whole n. */
static void exact_lobes(void **state) {
    subject *diffuse = make("diffuse", 1.5, true);
    subject *phong = make("phong:n=4", 1.5, true);
    (void)state;
    assert_true(diffuse->errors[0] > 0.1 && phong->errors[3] > 1e-4);
    for (size_t l = 4; l <= LAST; l++) {
        assert_true(diffuse->errors[l - 3] == 0 && phong->errors[l] == 0);
    }
    drop(diffuse);
    drop(phong);
}

/* Light whose powers are the a_l of a space has its worst-case errors, up to what the space has
 * beyond; light of one degree has one square of the lobe. */
static void light(void **state) {
    enum { POWERS = 2 * LAST, FEW = 12, ONE = 3 };
    double squares[LAST + 1];
    double one[ONE + 1] = {0, 0, 0, 2};
    (void)state;
    for (int on_hemisphere = 0; on_hemisphere < 2; on_hemisphere++) {
        subject *lobe = make("glossy:n=30", 1.5, on_hemisphere == 1);
        assert_ok(ps_truncation_of_light(lobe->brdf, on_hemisphere == 1, LAST, lobe->representer.a,
                                         POWERS, squares, error));
        for (size_t l = 0; l <= FEW; l++) {
            assert_near(sqrt(squares[l]), lobe->errors[l], 2e-3, 0);
        }
        assert_ok(ps_truncation_of_light(lobe->brdf, on_hemisphere == 1, LAST, one, ONE + 1,
                                         squares, error));
        if (on_hemisphere == 0) {
            const double b = lobe->representer.b[ONE];
            assert_near(squares[0], 2 * b * b, 1e-14, 0);
            assert_near(squares[ONE - 1], 2 * b * b, 1e-14, 0);
            assert_true(squares[ONE] == 0 && squares[LAST] == 0);
        }
        drop(lobe);
    }
    subject *diffuse = make("diffuse", 1.5, true);
    assert_ok(ps_truncation_of_light(diffuse->brdf, true, 2, diffuse->representer.a, POWERS,
                                     squares, error));
    assert_near(squares[1], 0, 0, 1e-26);
    drop(diffuse);
}

static void refusals(void **state) {
    double values[1];
    size_t degree = 0;
    ps_error error = {0};
    ps_brdf *brdf = NULL;
    ps_representer representer;
    (void)state;
    assert_ok(ps_brdf_parse(&brdf, "diffuse", error));
    assert_int_equal(
        ps_truncation_hemispherical(brdf, 1.5, 501, 1e-6, values, values, &degree, &error),
        PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "501"));
    assert_int_equal(ps_representer_create(&representer, brdf, 2, 1e-12, 0, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_representer_destroy(&representer);
    ps_brdf_destroy(brdf);
}

/* Errors that no ladder reaches, and those that one point has. */
static void ends_of_the_ladder(void **state) {
    subject *lobe = make("diffuse", 1.5, false);
    ps_equal_error equal = {.representer = &lobe->representer, .morph = ps_brdf_morph(lobe->brdf)};
    double points = 0;
    (void)state;
    assert_ok(ps_equal_error_points(&equal, 10, &points, error));
    assert_true(points == 1);
    assert_ok(ps_equal_error_points(&equal, 1e-5, &points, error));
    assert_true(isnan(points));
    drop(lobe);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(spherical_reference),
                                       cmocka_unit_test(hemispherical_reference),
                                       cmocka_unit_test(printed_values),
                                       cmocka_unit_test(table_1),
                                       cmocka_unit_test(laws),
                                       cmocka_unit_test(exact_lobes),
                                       cmocka_unit_test(light),
                                       cmocka_unit_test(refusals),
                                       cmocka_unit_test(ends_of_the_ladder)};
    return cmocka_run_group_tests_name("truncation", tests, NULL, NULL);
}
