/* Our sets beside those of others at the same stop. Seconds are of the processor, of one thread, in
 * turns: ours, theirs, ours, ..
 */
#include "blue_noise/modes.h"

#include "bench.h"
#include "blue_noise/peers.h"
#include "samplers/darts/distance.h"
#include "samplers/optimized/bnot.h"

#include <dlfcn.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_ROUNDS = 15,
    MOST_SECONDS = 120, /* of a set of theirs, beyond which none is made */
    MOST_POINTS = 16384,
    ROOM = 2 /* of points asked for: some make more */
};

typedef struct contest {
    const char *peer, *library, *symbol;
    const char *ours;
    double parameter;
    double theirs_seconds; /* what they took at N = 1024, which says how many rounds */
    double power;          /* of N, with which that grows */
} contest;

static const contest CONTESTS[] = {
    {"FPO to 0.925", "fpo", "peer_fpo", "fpo", 0.925, 0.4, 1.6},
    {"BNOT, eps = 1", "utk", "peer_bnot", "bnot", 1, 5, 2},
    {"BNOT, eps = 0.5", "utk", "peer_bnot", "bnot:eps=0.5", 0.5, 10, 2},
    {"darts, r = 0.75", "utk", "peer_darts", "poisson-disk", 0.75, 0.1, 2},
    {"fast Poisson", "utk", "peer_fast_poisson", "poisson-disk", 0, 0.1, 1},
};

/* NULL where the library was not built. */
static peer_sampler find(const char *folder, const contest *c) {
    char path[4096];
    peer_sampler found = NULL;
    snprintf(path, sizeof path, "%s/libpeer_%s.so", folder, c->library);
    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL); /* until the end */
    void *const symbol = library != NULL ? dlsym(library, c->symbol) : NULL;
    if (symbol == NULL) {
        printf("# no %s: %s\n", c->peer, dlerror());
        return NULL;
    }
    memcpy(&found, &symbol, sizeof found); /* ISO C has no cast for it */
    return found;
}

/* ---- what the sets are --------------------------------------------------------------------- */

typedef struct quality {
    size_t num;
    double least, nearest; /* in units of hexagonal packing's distance */
} quality;

static double wrapped(double difference) {
    return difference - rint(difference);
}

static quality judge(const double *points, size_t num) {
    const double unit = sqrt(2 / (sqrt(3) * (double)num));
    quality q = {num, 1, 0};
    for (size_t i = 0; i < num; i++) {
        double nearest = 1;
        for (size_t j = 0; j < num; j++) {
            const double x = wrapped(points[2 * i] - points[2 * j]);
            const double y = wrapped(points[2 * i + 1] - points[2 * j + 1]);
            nearest = i != j ? fmin(nearest, x * x + y * y) : nearest;
        }
        q.least = fmin(q.least, sqrt(nearest) / unit);
        q.nearest += sqrt(nearest) / unit / (double)num;
    }
    return q;
}

/* ---- one row ------------------------------------------------------------------------------- */

static double seconds_of(const contest *c, size_t num) {
    return c->theirs_seconds * pow((double)num / 1024, c->power);
}

static unsigned rounds_of(const contest *c, size_t num) {
    const double budget = 30;
    const double rounds = budget / seconds_of(c, num);
    return rounds < 1 ? 1 : rounds > MOST_ROUNDS ? MOST_ROUNDS : (unsigned)rounds;
}

static double parameter_of(const contest *c, size_t num) {
    const ps_blue_noise asked = {.dimension = 2};
    return c->parameter > 0 ? c->parameter : ps_poisson_disk_kind.radius(&asked, num);
}

/* Both from the same points where the peer takes some. */
static void start(double *points, size_t num, uint64_t set) {
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, set);
    ps_random_fill_uniform(&random, points, 2 * num);
}

static void compete(const contest *c, peer_sampler theirs, size_t num, double *points) {
    const ps_sampler_request request = bench_sampler(c->ours, num);
    const unsigned rounds = rounds_of(c, num);
    double our_sum = 0;
    double their_sum = 0;
    double seconds[2][MOST_ROUNDS];
    quality ours = {0};
    quality others = {0};
    for (unsigned i = 0; i < rounds; i++) {
        size_t made = 0;
        seconds[0][i] = bench_make_set(&request, i, points, &made);
        ours = judge(points, made);
        start(points, num, i);
        const double begin = bench_thread_seconds();
        made = theirs(num, parameter_of(c, num), i, points);
        seconds[1][i] = bench_thread_seconds() - begin;
        others = judge(points, made);
        our_sum += seconds[0][i];
        their_sum += seconds[1][i];
    }
    printf("%-16s %6zu %4u %10.4f %10.4f %7.1f   %6zu %5.3f %5.3f   %6zu %5.3f %5.3f\n", c->peer,
           num, rounds, bench_median(seconds[0], rounds), bench_median(seconds[1], rounds),
           their_sum / our_sum, ours.num, ours.least, ours.nearest, others.num, others.least,
           others.nearest);
    fflush(stdout);
}

void bench_blue_noise_peers(const char *folder, const char *begin) {
    double *const points = calloc((size_t)ROOM * MOST_POINTS, 2 * sizeof *points);
    if (points == NULL) {
        bench_die("no memory for points");
    }
    printf("# ours, theirs: medians, seconds; ratio of the sums; points, least distance and mean "
           "to the "
           "nearest of the last sets\n");
    printf("%-16s %6s %4s %10s %10s %7s   %20s   %20s\n", "peer", "N", "sets", "ours", "theirs",
           "ratio", "ours", "theirs");
    for (size_t k = 0; k < sizeof CONTESTS / sizeof CONTESTS[0]; k++) {
        const bool is_asked = strncmp(CONTESTS[k].peer, begin, strlen(begin)) == 0;
        const peer_sampler theirs = is_asked ? find(folder, &CONTESTS[k]) : NULL;
        for (size_t num = 1024; theirs != NULL && num <= MOST_POINTS; num *= 4) {
            if (seconds_of(&CONTESTS[k], num) > MOST_SECONDS) {
                printf("%-16s %6zu    - a set of theirs takes more than %d s\n", CONTESTS[k].peer,
                       num, MOST_SECONDS);
                continue;
            }
            compete(&CONTESTS[k], theirs, num, points);
        }
    }
    free(points);
}
