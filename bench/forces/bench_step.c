/* Step blue noise on the device beside plain C loops (forces/plain.h), in one run.
 *
 *     bench_step [SELECTOR [N...]]     the first device that SELECTOR means; 1024 and 4096 points
 *
 * A set is as many rounds of both as the device took for it: the schedule is the same, and so is
 * what the host does between two. The device is open before, and its kernels are built.
 */
#include "bench.h"

#include "forces/plain.h"
#include "math/random/random.h"
#include "samplers/forces/step.h"
#include "samplers/forces/step_pairs.h"

#include <stdio.h>
#include <stdlib.h>

enum { ROUNDS = 5 };

typedef struct set {
    size_t num;
    double *x, *force, *table;
    uint64_t *counts;
} set;

static set make_room(size_t num) {
    const set s = {num, calloc(2 * num, sizeof(double)), calloc(2 * num, sizeof(double)),
                   calloc(num + 1, sizeof(double)), calloc(num, sizeof(uint64_t))};
    if (s.x == NULL || s.force == NULL || s.table == NULL || s.counts == NULL) {
        bench_die("no memory for points");
    }
    return s;
}

static void free_room(set *s) {
    free(s->x);
    free(s->force);
    free(s->table);
    free(s->counts);
}

/* Median seconds of a round: counts, curves, forces. */
static double time_plain(set *s, ps_step_curves *curves) {
    double seconds[ROUNDS];
    for (int k = 0; k < ROUNDS; k++) {
        const double begin = bench_seconds();
        bench_plain_counts(s->num, s->x, s->num, s->counts);
        ps_step_curves_measure(curves, s->counts);
        ps_step_curves_force(curves, s->table);
        bench_plain_forces(s->num, s->x, s->num, s->table, s->force);
        seconds[k] = bench_seconds() - begin;
    }
    return bench_median(seconds, ROUNDS);
}

static double time_device(set *s, ps_step_curves *curves, ps_device *device) {
    ps_step_pairs pairs;
    double seconds[ROUNDS];
    BENCH_TRY(ps_step_pairs_create(&pairs, device, s->num, s->num, error));
    for (int k = -1; k < ROUNDS; k++) { /* the first one builds */
        const double begin = bench_seconds();
        BENCH_TRY(ps_step_pairs_count(&pairs, s->x, s->counts, NULL, error));
        ps_step_curves_measure(curves, s->counts);
        ps_step_curves_force(curves, s->table);
        BENCH_TRY(ps_step_pairs_force(&pairs, s->x, s->table, s->force, NULL, error));
        seconds[k < 0 ? 0 : k] = bench_seconds() - begin;
    }
    ps_step_pairs_destroy(&pairs);
    return bench_median(seconds, ROUNDS);
}

static void time_set(size_t num, ps_device *device) {
    set s = make_room(num);
    ps_step_curves curves;
    ps_step_outcome outcome;
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    BENCH_TRY(ps_step_make(num, (ps_step_options){1, PS_STEP_SMOOTHING}, &random, device, NULL, s.x,
                           NULL, error)); /* builds */
    random = ps_random_init(1, PS_STREAM_COORDINATES, 0);
    const double begin = bench_seconds();
    BENCH_TRY(ps_step_make(num, (ps_step_options){PS_STEP_MOST_ROUNDS, PS_STEP_SMOOTHING}, &random,
                           device, NULL, s.x, &outcome, error));
    const double whole = bench_seconds() - begin;
    BENCH_TRY(ps_step_curves_create(&curves, num, num, PS_STEP_SMOOTHING, error));
    const double plain = time_plain(&s, &curves);
    const double on_device = time_device(&s, &curves, device);
    printf("%6zu %6u %8.4f %10.2f %10.2f %6.1f %9.2f %9.2f %6.1f\n", num, outcome.rounds,
           outcome.last, plain * 1e3, on_device * 1e3, plain / on_device, plain * outcome.rounds,
           whole, plain * outcome.rounds / whole);
    ps_step_curves_destroy(&curves);
    free_room(&s);
}

int main(int num_words, char **words) {
    const size_t counts[] = {1024, 4096};
    ps_device *device = NULL;
    BENCH_TRY(ps_device_open(&device, num_words > 1 ? words[1] : NULL, false, error));
    printf("%6s %6s %8s %10s %10s %6s %9s %9s %6s\n", "N", "rounds", "off", "plain ms", "device ms",
           "ratio", "plain s", "set s", "ratio");
    for (int i = 2; i < num_words; i++) {
        time_set((size_t)atoi(words[i]), device);
    }
    for (size_t i = 0; i < 2 && num_words < 3; i++) {
        time_set(counts[i], device);
    }
    ps_device_close(device);
    return EXIT_SUCCESS;
}
