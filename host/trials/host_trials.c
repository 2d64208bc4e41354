#include "trials/ways.h"

#include "base/workers.h"
#include "math/neumaier.h"
#include "trials/trials.h"

#include <math.h>
#include <string.h>

/* Points whose values are asked for at a time. */
enum { CHUNK = 128, AXES = 3 };

static void shift(double *points, size_t num, unsigned dimension, const double *tau) {
    for (size_t j = 0; j < num; j++) {
        for (unsigned i = 0; i < dimension; i++) {
            const double sum = points[j * dimension + i] + tau[i];
            points[j * dimension + i] = sum - floor(sum);
        }
    }
}

static void rotate(double *points, size_t num, bool is_folded, const double *matrix) {
    for (size_t j = 0; j < num; j++) {
        double *const u = points + j * AXES;
        double to[AXES];
        for (unsigned i = 0; i < AXES; i++) {
            const double *const row = matrix + (size_t)i * AXES;
            to[i] = row[0] * u[0] + row[1] * u[1] + row[2] * u[2];
        }
        const double side = is_folded && to[2] < 0 ? -1 : 1;
        for (unsigned i = 0; i < AXES; i++) {
            u[i] = side * to[i];
        }
    }
}

/* move NULL: none, but points of the hemisphere are folded all the same. */
static void move_points(const ps_integrand *integrand, double *points, size_t num,
                        const double *move) {
    static const double stay[AXES * AXES] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const ps_integrand_place place = integrand->place;
    if (place.where != PS_SAMPLES_TORUS) {
        rotate(points, num, place.where == PS_SAMPLES_HEMISPHERE, move != NULL ? move : stay);
    } else if (move != NULL) {
        shift(points, num, place.dimension, move);
    }
}

static double sum_of(const ps_integrand *integrand, const pspec_pattern *pattern,
                     const double *move) {
    const unsigned dimension = pattern->dimension;
    ps_neumaier total = {0, 0};
    for (size_t first = 0; first < pattern->num_points; first += CHUNK) {
        double points[CHUNK * PS_MAX_DIMENSION];
        double values[CHUNK];
        const size_t rest = pattern->num_points - first;
        const size_t num = rest < CHUNK ? rest : CHUNK;
        memcpy(points, pattern->points + first * dimension, num * dimension * sizeof *points);
        move_points(integrand, points, num, move);
        ps_integrand_values(integrand, points, num, values);
        for (size_t j = 0; j < num; j++) {
            const double weight = pattern->weights != NULL ? pattern->weights[first + j] : 1;
            ps_neumaier_add(&total, weight * values[j]);
        }
    }
    return ps_neumaier_value(&total);
}

typedef struct work {
    const ps_integrand *integrand;
    const pspec_pattern *patterns;
    size_t num_patterns, num_trials;
    const double *moves;
    double *sums;
} work;

static void add_some(void *payload, unsigned index, unsigned count) {
    const work *const own = payload;
    const size_t num = own->num_patterns * own->num_trials;
    const size_t numbers = ps_trials_move_numbers(own->integrand);
    const size_t end = ps_share_begin(num, index + 1, count);
    for (size_t i = ps_share_begin(num, index, count); i < end; i++) {
        const double *const move = own->moves != NULL ? own->moves + i * numbers : NULL;
        own->sums[i] = sum_of(own->integrand, &own->patterns[i / own->num_trials], move);
    }
}

void ps_host_trials_sums(const ps_integrand *integrand, const pspec_pattern *patterns,
                         size_t num_patterns, size_t num_trials, const double *moves,
                         double *sums) {
    work all = {integrand, patterns, num_patterns, num_trials, moves, sums};
    size_t num_values = 0;
    for (size_t i = 0; i < num_patterns; i++) {
        num_values += patterns[i].num_points * num_trials;
    }
    if (ps_integrand_failure(integrand) != NULL) { /* a caller is asked by one thread */
        add_some(&all, 0, 1);
        return;
    }
    ps_workers_share(num_values, add_some, &all);
}
