/* Is it the same sampler? Jittered points with two random generators, and white ones: which rings
 * differ.
 *
 *     cc same_sampler.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 8, NUM_POINTS = SIDE * SIDE, MAX_FREQUENCY = 16 };

static double by_library(void) {
    return rand() / (RAND_MAX + 1.0);
}

/* A generator of one's own, which is to be as good. */
static double by_multiplication(void) {
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) / 9007199254740992.0; /* 53 bits over 2^53 */
}

static pspec_spectrum *estimate(pspec_context *context, pspec_plan *plan, int num_sets,
                                double (*uniform)(void), int is_jittered) {
    pspec_spectrum *spectrum = NULL;
    pspec_status status = pspec_plan_reset(plan);
    for (int r = 0; status == PSPEC_OK && r < num_sets; r++) {
        double points[2 * NUM_POINTS];
        for (int j = 0; j < NUM_POINTS; j++) {
            points[2 * j] = is_jittered ? (j % SIDE + uniform()) / SIDE : uniform();
            points[2 * j + 1] = is_jittered ? (j / SIDE + uniform()) / SIDE : uniform();
        }
        const pspec_pattern pattern = {2, NUM_POINTS, points, NULL};
        status = pspec_plan_run(plan, &pattern, 1);
    }
    if (status != PSPEC_OK || pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        exit(1);
    }
    return spectrum;
}

static size_t compare(pspec_context *context, const char *name, const pspec_spectrum *saved,
                      pspec_spectrum *measured) {
    pspec_bin_comparison bins[MAX_FREQUENCY];
    size_t num_different = 0;
    if (pspec_spectrum_compare(saved, measured, context, 1e-3, bins, &num_different) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        exit(1);
    }
    printf("%zu of %d rings differ with %s", num_different, MAX_FREQUENCY, name);
    for (int b = 0; b < MAX_FREQUENCY; b++) {
        if (bins[b].differs) {
            printf("; ring %d, z = %.3g", b + 1, bins[b].z_score);
        }
    }
    printf("\n");
    pspec_spectrum_destroy(measured);
    return num_different;
}

int main(void) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    request.num_points = NUM_POINTS;
    request.max_frequency = MAX_FREQUENCY;
    if (pspec_plan_create(&plan, context, &request) != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    pspec_spectrum *saved = estimate(context, plan, 200, by_library, 1);
    const size_t same = compare(context, "another generator", saved,
                                estimate(context, plan, 50, by_multiplication, 1));
    const size_t white =
        compare(context, "white points", saved, estimate(context, plan, 5, by_library, 0));
    pspec_spectrum_destroy(saved);
    pspec_plan_destroy(plan);
    pspec_context_destroy(context);
    return same == 0 && white > 0 ? 0 : 1;
}
