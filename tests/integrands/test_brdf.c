/* Coefficients of BRDFs against tests/reference, closed forms and each other. */
#include "harness.h"
#include "test_folder.h"

#include "integrands/lobes/brdf.h"
#include "math/gauss_legendre.h"
#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double RELATIVE = 3e-12; /* of the reference's README */

static ps_brdf *parse(const char *text) {
    ps_brdf *brdf = NULL;
    assert_ok(ps_brdf_parse(&brdf, text, error));
    return brdf;
}

static double *coefficients(const char *text, size_t last, bool on_hemisphere) {
    ps_brdf *brdf = parse(text);
    double *b = calloc(last + 1, sizeof *b);
    if (on_hemisphere) {
        assert_ok(ps_brdf_hemispherical(brdf, last, b, error));
    } else {
        assert_ok(ps_brdf_spherical(brdf, last, b, error));
    }
    ps_brdf_destroy(brdf);
    return b;
}

static double cell(const cJSON *row, int column) {
    return test_number(cJSON_GetArrayItem(row, column));
}

static double legendre(size_t degree, double x) {
    double before = 0;
    double value = 1;
    for (size_t l = 0; l < degree; l++) {
        const double d = (double)l;
        const double next = ((2 * d + 1) * x * value - d * before) / (d + 1);
        before = value;
        value = next;
    }
    return value;
}

static void assert_close(double value, double exact, double relative, double absolute) {
    if (!(fabs(value - exact) <= relative * fabs(exact) + absolute)) {
        fail_msg("%.17g is not %.17g", value, exact);
    }
}

/* ---- tables -------------------------------------------------------------------------------- */

static void diffuse(void **state) {
    enum { LAST = 10000 };
    cJSON *json = test_read_reference("tables.json");
    const cJSON *table = cJSON_GetObjectItem(json, "b_diffuse");
    const cJSON *row = NULL;
    double *b = coefficients("diffuse", LAST, false);
    double *hsh = coefficients("diffuse", LAST, true);
    (void)state;
    cJSON_ArrayForEach(row, cJSON_GetObjectItem(table, "rows")) {
        assert_close(b[(size_t)cell(row, 0)], cell(row, 1), RELATIVE, 0);
    }
    assert_close(hsh[0], cell(cJSON_GetObjectItem(table, "hsh"), 0), RELATIVE, 0);
    assert_close(hsh[1], cell(cJSON_GetObjectItem(table, "hsh"), 1), RELATIVE, 0);
    for (size_t l = 2; l <= LAST; l++) {
        assert_true(hsh[l] == 0);
        assert_true(l % 2 == 0 || b[l] == 0);
    }
    assert_close(fabs(b[LAST]) * LAST * (double)LAST, 2 / PS_PI, 1e-3, 0);
    free(b);
    free(hsh);
    cJSON_Delete(json);
}

static void glossy(void **state) {
    enum { LAST = 1000, COLUMNS = 3 };
    static const struct {
        const char *cut;
        int column;
        bool on_hemisphere;
    } kinds[COLUMNS] = {{"horizon", 2, false}, {"none", 3, false}, {"horizon", 5, true}};
    cJSON *json = test_read_reference("tables.json");
    const cJSON *rows = cJSON_GetObjectItem(cJSON_GetObjectItem(json, "b_glossy"), "rows");
    const cJSON *row = NULL;
    (void)state;
    cJSON_ArrayForEach(row, rows) {
        for (int i = 0; i < COLUMNS; i++) {
            char text[64];
            const double n = cell(row, 0);
            snprintf(text, sizeof text, "glossy:n=%.17g,cut=%s", n, kinds[i].cut);
            double *b = coefficients(text, LAST, kinds[i].on_hemisphere);
            assert_close(b[(size_t)cell(row, 1)], cell(row, kinds[i].column), RELATIVE,
                         n >= 30 ? 1e-17 : 0);
            free(b);
        }
    }
    cJSON_Delete(json);
}

/* ---- laws ---------------------------------------------------------------------------------- */

static const char *const lobes[] = {"diffuse",
                                    "glossy:n=0.001",
                                    "glossy:n=0.01",
                                    "glossy:n=1",
                                    "glossy:n=39.9",
                                    "glossy:n=40",
                                    "glossy:n=1000",
                                    "glossy:n=1e5",
                                    "glossy:n=1e6",
                                    "glossy:n=0.01,cut=none",
                                    "glossy:n=5,cut=none",
                                    "glossy:n=1e5,cut=none",
                                    "phong:n=1",
                                    "phong:n=0.001",
                                    "phong:n=2.5",
                                    "phong:n=1000",
                                    "phong:n=1e6"};
enum { NUM_LOBES = sizeof lobes / sizeof lobes[0] };

/* b_0 = 1/(2 sqrt pi), and sum b_l^2 grows to its closed form and not beyond. */
static void sums(void **state) {
    enum { LAST = 40000 };
    (void)state;
    for (size_t i = 0; i < NUM_LOBES; i++) {
        ps_brdf *brdf = parse(lobes[i]);
        double *b = coefficients(lobes[i], LAST, false);
        double sum = 0;
        for (size_t l = LAST + 1; l-- > 0;) {
            sum += b[l] * b[l];
        }
        const double energy = ps_brdf_energy(brdf);
        print_message("%-24s sum/energy - 1 = %.3g\n", lobes[i], sum / energy - 1);
        assert_close(b[0], 1 / (2 * sqrt(PS_PI)), 1e-15, 0);
        assert_true(sum <= energy * (1 + 1e-12));
        assert_true(sum >= energy * (1 - 5e-5)); /* a jump at the horizon leaves 1/L */
        free(b);
        ps_brdf_destroy(brdf);
    }
}

static void hemispherical_sums(void **state) {
    enum { LAST = 20000 };
    (void)state;
    for (size_t i = 0; i < NUM_LOBES; i++) {
        ps_brdf *brdf = parse(lobes[i]);
        if (!ps_brdf_is_below_horizon(brdf)) {
            double *b = coefficients(lobes[i], LAST, true);
            double sum = 0;
            for (size_t l = LAST + 1; l-- > 0;) {
                sum += b[l] * b[l];
            }
            assert_close(sum, ps_brdf_energy(brdf), 1e-4, 0);
            assert_close(b[0], 1 / sqrt(PS_TWO_PI), 1e-15, 0);
            free(b);
        }
        ps_brdf_destroy(brdf);
    }
}

/* int phat P_l dz 2 pi sqrt((2l+1)/(4 pi)) by a rule on [0,1] (and mirrored, below the horizon). */
static void quadrature(void **state) {
    enum { NODES = 400, LAST = 60 };
    double nodes[NODES];
    double weights[NODES];
    (void)state;
    ps_gauss_legendre(NODES, nodes, weights);
    for (size_t i = 0; i < NUM_LOBES; i++) {
        ps_brdf *brdf = parse(lobes[i]);
        double *b = coefficients(lobes[i], LAST, false);
        /* not those that are too narrow for this rule, nor z^0.001 */
        const bool is_smooth =
            strstr(lobes[i], "1e") == NULL && strstr(lobes[i], "n=0.001") == NULL;
        for (size_t l = 0; is_smooth && l <= LAST; l++) {
            double sum = 0;
            for (size_t j = 0; j < NODES; j++) {
                const double sign = l % 2 == 0 ? 1 : -1;
                const double above = ps_brdf_density(brdf, nodes[j]);
                const double below = ps_brdf_density(brdf, -nodes[j]);
                sum += weights[j] * (above + sign * below) * legendre(l, nodes[j]);
            }
            assert_close(b[l], PS_TWO_PI * sqrt((2 * (double)l + 1) / PS_FOUR_PI) * sum, 0, 2e-10);
        }
        free(b);
        ps_brdf_destroy(brdf);
    }
}

static void phong_1_is_diffuse(void **state) {
    enum { LAST = 2000 };
    (void)state;
    for (int on_hemisphere = 0; on_hemisphere < 2; on_hemisphere++) {
        double *a = coefficients("phong:n=1", LAST, on_hemisphere != 0);
        double *b = coefficients("diffuse", LAST, on_hemisphere != 0);
        for (size_t l = 0; l <= LAST; l++) {
            assert_close(a[l], b[l], 1e-12, 0);
        }
        free(a);
        free(b);
    }
}

/* Near n = 40 the cut lobe changes its algorithm, by less than it is off. */
static void algorithms_meet(void **state) {
    enum { LAST = 300 };
    double *below = coefficients("glossy:n=39.99999999999999", LAST, false);
    double *above = coefficients("glossy:n=40", LAST, false);
    (void)state;
    for (size_t l = 0; l <= LAST; l++) {
        assert_close(below[l], above[l], 2e-13, 1e-16);
    }
    free(below);
    free(above);
}

/* ---- tables from files --------------------------------------------------------------------- */

static void write_text(const char *path, const char *text) {
    assert_true(test_write_file(path, text, strlen(text)));
}

/* Tests with files run in a folder of their own. */
static int enter_folder(void **state) {
    return test_folder_create(state) == 0 ? chdir(((test_folder *)*state)->path) : -1;
}

static int leave_folder(void **state) {
    return test_folder_remove(state) == 0 ? chdir("/") : -1;
}

/* z from 0 to 1 is the diffuse lobe; the same at falling angles, and with a part below the horizon.
 */
static void zonal(void **state) {
    enum { LAST = 500 };
    (void)state;
    write_text("lobe.txt", "# z p\n0 0\n0.25, 0.25\n1 1\n");
    for (int on_hemisphere = 0; on_hemisphere < 2; on_hemisphere++) {
        double *a = coefficients("zonal:file=lobe.txt", LAST, on_hemisphere != 0);
        double *b = coefficients("diffuse", LAST, on_hemisphere != 0);
        for (size_t l = 0; l <= LAST; l++) {
            assert_close(a[l], b[l], 1e-13, 1e-16);
        }
        free(a);
        free(b);
    }
    ps_brdf *brdf = parse("zonal:file=lobe.txt");
    assert_close(ps_brdf_energy(brdf), 2 / (3 * PS_PI), 1e-14, 0);
    assert_close(ps_brdf_norm(brdf), 0.5, 1e-15, 0);
    assert_close(ps_brdf_density(brdf, 0.7), 0.7 / PS_PI, 1e-15, 0);
    assert_true(ps_brdf_density(brdf, -0.1) == 0);
    ps_brdf_destroy(brdf);
    write_text("step.txt", "0 2\n60 2\n"); /* a cap: int_{1/2}^1 P_l */
    double *b = coefficients("zonal:file=step.txt,of=degrees", LAST, false);
    for (size_t l = 1; l <= LAST; l++) {
        const double below = legendre(l - 1, 0.5);
        const double above = legendre(l + 1, 0.5);
        const double exact = (below - above) / (2 * (double)l + 1) / 0.5;
        assert_close(b[l], sqrt((2 * (double)l + 1) / PS_FOUR_PI) * exact, 0, 1e-14);
    }
    free(b);
}

static void refuses(const char *text, const char *part) {
    ps_brdf *brdf = NULL;
    ps_error error = {0};
    assert_int_not_equal(ps_brdf_parse(&brdf, text, &error), PSPEC_OK);
    assert_null(brdf);
    if (strstr(error.message, part) == NULL) {
        fail_msg("%s: \"%s\" lacks \"%s\"", text, error.message, part);
    }
}

static void refusals(void **state) {
    (void)state;
    refuses("difuse", "unknown BRDF \"difuse\"; did you mean diffuse?");
    refuses("diffuse:n=2", "has no parameters");
    refuses("glossy", "needs its exponent");
    refuses("glossy:n=0", "exponent n of the lobe");
    refuses("glossy:n=-3", "exponent n of the lobe");
    refuses("glossy:n=nan", "exponent n of the lobe");
    refuses("glossy:n=1e7", "exponent n of the lobe");
    refuses("glossy:n=3,cut=half", "is not one of horizon, none");
    refuses("glossy:n=3,n=4", "given twice");
    refuses("glossy:m=3", "did you mean n?");
    refuses("zonal", "needs its table");
    refuses("zonal:file=absent.txt", "absent.txt");
    write_text("bad.txt", "0 1\n0.5 -1\n");
    refuses("zonal:file=bad.txt", "bad.txt, line 2: the lobe is -1");
    write_text("bad.txt", "0 1\n0.5 1\n0.4 1\n");
    refuses("zonal:file=bad.txt", "line 3: 0.40000000000000002 is out of order");
    write_text("bad.txt", "0 1\n\n1.5 1\n");
    refuses("zonal:file=bad.txt", "line 3: 1.5 is no cosine");
    refuses("zonal:file=bad.txt,of=turns", "is not one of cosine, degrees, radians");
    write_text("bad.txt", "0 1 2\n");
    refuses("zonal:file=bad.txt", "line 1: more than two numbers");
    write_text("bad.txt", "0\n1 2\n");
    refuses("zonal:file=bad.txt", "line 1: \"\" is not a finite number");
    write_text("bad.txt", "0 1\n");
    refuses("zonal:file=bad.txt", "one row");
    write_text("bad.txt", "0 0\n1 0\n");
    refuses("zonal:file=bad.txt", "cannot be divided by");
}

static void below_the_horizon(void **state) {
    double b[3];
    ps_error error = {0};
    ps_brdf *brdf = parse("glossy:n=2,cut=none");
    (void)state;
    assert_int_equal(ps_brdf_hemispherical(brdf, 2, b, &error), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(error.message, "below the horizon"));
    assert_non_null(ps_brdf_note(brdf));
    ps_brdf_destroy(brdf);
    brdf = parse("glossy:n=30");
    assert_null(ps_brdf_note(brdf));
    ps_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diffuse),
        cmocka_unit_test(glossy),
        cmocka_unit_test(sums),
        cmocka_unit_test(hemispherical_sums),
        cmocka_unit_test(quadrature),
        cmocka_unit_test(phong_1_is_diffuse),
        cmocka_unit_test(algorithms_meet),
        cmocka_unit_test_setup_teardown(zonal, enter_folder, leave_folder),
        cmocka_unit_test_setup_teardown(refusals, enter_folder, leave_folder),
        cmocka_unit_test(below_the_horizon)};
    return cmocka_run_group_tests_name("brdf", tests, NULL, NULL);
}
