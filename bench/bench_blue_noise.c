/* Points that keep a least distance: what a set costs, and what radii are made of.
 *
 *     bench_blue_noise [times]           milliseconds beside plain C loops (blue_noise/plain.h)
 *     bench_blue_noise cost              seconds beside those of prototypes
 *     bench_blue_noise hours [SETS]      hours of 1000 sets on two cores, from 20 or so many
 *     bench_blue_noise means [SETS]      N r^d, of which radii are made (samplers/darts)
 *     bench_blue_noise peers FOLDER [ROW]  beside programs of others, all or those whose rows begin so
 *                                        (bench_blue_noise_peers.sh)
 */
#include "bench.h"

#include "blue_noise/modes.h"
#include "blue_noise/plain.h"
#include "samplers/darts/distance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 7 };

typedef struct blue {
    const char *name;
    unsigned dimension;
    const ps_distance_kind *distance;
    size_t (*plain)(bench_room *, double radius, ps_random *); /* may be NULL */
} blue;

static const blue KINDS[] = {
    {"poisson-disk", 2, &ps_poisson_disk_kind, bench_plain_darts},
    {"poisson-disk", 3, &ps_poisson_disk_kind, NULL},
    {"bridson", 2, &ps_bridson_kind, bench_plain_bridson},
    {"bridson", 3, &ps_bridson_kind, NULL},
    {"bridson", 4, &ps_bridson_kind, NULL},
    {"poisson-disk-sphere", 3, &ps_sphere_disk_kind, bench_plain_sphere},
};
enum { NUM_KINDS = sizeof KINDS / sizeof KINDS[0] };

static double radius_of(const blue *kind, unsigned tries, size_t num) {
    const ps_blue_noise asked = {.dimension = kind->dimension, .tries = tries};
    return kind->distance->radius(&asked, num);
}

static size_t make(const blue *kind, const bench_room *r, double radius, unsigned tries,
                   uint64_t set) {
    const ps_blue_noise asked = {.dimension = kind->dimension,
                                 .radius = radius,
                                 .tries = tries,
                                 .most_points = BENCH_MOST_POINTS};
    ps_random random = ps_random_init(1, PS_STREAM_COORDINATES, set);
    size_t num = 0;
    BENCH_TRY(kind->distance->make(&asked, &random, r->points, &num, error));
    return num;
}

static void time_kind(const blue *kind, bench_room *r, size_t num) {
    const double radius = radius_of(kind, BENCH_TRIES, num);
    double ours[REPEATS];
    double plain[REPEATS];
    size_t num_plain = 0;
    for (int i = 0; i < REPEATS; i++) {
        double begin = bench_thread_seconds();
        make(kind, r, radius, BENCH_TRIES, (uint64_t)i);
        ours[i] = bench_thread_seconds() - begin;
        if (kind->plain != NULL) {
            ps_random random = ps_random_init(2, PS_STREAM_COORDINATES, (uint64_t)i);
            begin = bench_thread_seconds();
            num_plain = kind->plain(r, radius, &random);
            plain[i] = bench_thread_seconds() - begin;
        }
    }
    const double milliseconds = 1e3;
    const double median = bench_median(ours, REPEATS) * milliseconds;
    printf("%-20s %u %6zu %9.2f", kind->name, kind->dimension, num, median);
    if (kind->plain != NULL) {
        const double other = bench_median(plain, REPEATS) * milliseconds;
        printf(" %9.2f %6zu %6.1f", other, num_plain, other / median);
    }
    printf("\n");
}

static void count_kind(const blue *kind, const bench_room *r, unsigned tries, int num_sets) {
    const size_t num = 4096;
    const double radius = radius_of(kind, tries, num);
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < num_sets; i++) {
        const double made = (double)make(kind, r, radius, tries, (uint64_t)i);
        sum += made;
        squares += made * made;
    }
    const double mean = sum / num_sets;
    const double variance = squares / num_sets - mean * mean;
    const int power = kind->distance == &ps_sphere_disk_kind ? 2 : (int)kind->dimension;
    printf("%-20s %u %6u %9.2f %6.2f %8.5f\n", kind->name, kind->dimension, tries, mean,
           sqrt(variance / num_sets), mean * pow(radius, power));
}

static void count_kinds(const bench_room *r, int num_sets) {
    const unsigned tries[] = {2, 3, 5, 10, 20, 30, 50, 100, 200, 400, 1000};
    printf("%-20s d %6s %9s %6s %8s\n", "sampler", "tries", "mean N", "error", "N r^d");
    for (size_t k = 0; k < NUM_KINDS; k++) {
        const bool has_tries = KINDS[k].distance == &ps_bridson_kind;
        for (size_t i = 0; i < (has_tries ? sizeof tries / sizeof *tries : 1); i++) {
            count_kind(&KINDS[k], r, has_tries ? tries[i] : 0, num_sets);
        }
    }
}

static void time_kinds(bench_room *r) {
    printf("%-20s d %6s %9s %9s %6s %6s\n", "sampler", "N", "ms", "plain ms", "N", "ratio");
    for (size_t k = 0; k < NUM_KINDS; k++) {
        for (size_t num = 1024; num <= 16384; num *= 4) {
            time_kind(&KINDS[k], r, num);
        }
    }
}

int main(int num_words, char **words) {
    const char *const mode = num_words > 1 ? words[1] : "times";
    const int sets = num_words > 2 ? atoi(words[2]) : 20;
    bench_room r = {malloc(3 * BENCH_MOST_POINTS * sizeof(double)),
                    malloc(BENCH_MOST_CELLS * sizeof(int)),
                    malloc(BENCH_MOST_POINTS * sizeof(int))};
    if (r.points == NULL || r.cells == NULL || r.active == NULL) {
        bench_die("no memory");
    }
    if (strcmp(mode, "means") == 0 && sets > 0) {
        count_kinds(&r, sets);
    } else if (strcmp(mode, "hours") == 0 && sets > 0) {
        bench_blue_noise_hours((unsigned)sets);
    } else if (strcmp(mode, "cost") == 0) {
        bench_blue_noise_cost();
    } else if (strcmp(mode, "peers") == 0 && num_words > 2) {
        bench_blue_noise_peers(words[2], num_words > 3 ? words[3] : "");
    } else if (strcmp(mode, "times") == 0) {
        time_kinds(&r);
    } else {
        bench_die("modes are times, cost, hours [SETS], means [SETS], peers FOLDER [ROW]");
    }
    free(r.points);
    free(r.cells);
    free(r.active);
    return EXIT_SUCCESS;
}
