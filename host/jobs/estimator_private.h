/* Inside of ps_estimator, for the files estimator*.c only. */
#ifndef PS_JOBS_ESTIMATOR_PRIVATE_H
#define PS_JOBS_ESTIMATOR_PRIVATE_H

#include "jobs/estimator.h"

/* What pair sums have besides Q(l): C_l^2 = 2 sum_{m > 0} |c_lm|^2 of every realization, on
 * average. */

/* Sums over realizations. */
typedef struct ps_pair_sums {
    const ps_frequencies *frequencies;
    size_t batch;
    ps_pair_observer observer;
    double *scales;       /* [batch], of the batch that was begun */
    double *zonal;        /* [batch][max_degree + 1] */
    double *c2;           /* [max_degree + 1] of one realization, and behind it its Z(l) */
    void *scratch;        /* of the threads */
    ps_running_sums sums; /* of frequencies->num */
} ps_pair_sums;

/* Zeroed memory must be given; free it also after a failure. expected: realizations in all. */
pspec_status ps_pair_sums_create(ps_pair_sums *out, const ps_frequencies *frequencies, size_t batch,
                                 uint64_t expected, ps_pair_observer observer,
                                 ps_error *error) PS_MUST_CHECK;
void ps_pair_sums_free(ps_pair_sums *sums);
void ps_pair_sums_reset(ps_pair_sums *sums);
/* What a batch is to have beside its rows: all that is looked at of its points. */
void ps_pair_sums_begin(ps_pair_sums *sums, const ps_batch *batch);
/* Adds the realizations of the batch that was begun last, whose rows are on the host, where sums
 * have room for them. */
void ps_pair_sums_add(ps_pair_sums *sums, const ps_rows *rows, const uint32_t *slots);
/* means[frequencies->num] */
void ps_pair_sums_finish(const ps_pair_sums *sums, ps_mean *means);

struct ps_estimator {
    ps_estimator_options options;
    ps_device *device;
    void *engine_state; /* NULL after a refused allocation, until it is made again */
    size_t batch;
    ps_bins bins;
    uint32_t *slots;
    ps_accumulator *accumulator;
    double reference_points;  /* N_ref: 1 but under the normalization of integrals */
    double *scales;           /* [batch] */
    double *units;            /* [batch] of effective powers */
    int *exponents;           /* [batch] of the weights */
    ps_pattern_sums *sums;    /* [batch] */
    ps_pair_sums c2;          /* with options.want_c2 */
    ps_rows pending;          /* of the batch before, which are not added yet; else num_rows is 0 */
    ps_device_sets *sets;     /* of patterns without points; NULL: there are none */
    double *beginning;        /* points of the first of them, for the self-check; else NULL */
    bool leaves_checks;       /* of this batch's coordinates to the engine */
    ps_pattern_totals totals; /* but for its sums: */
    uint64_t num_elsewhere;   /* realizations before the next that another estimator has */
    ps_running_sums total_sums; /* PS_NUM_TOTALS, of the segment in a range */
    ps_accuracy accuracy;
    /* With options.makes_rows, while they are made: where counts, and powers, of the next go */
    char *next_counts, *next_powers;
    /* With options.is_range */
    uint64_t segment;   /* the realization that it begins with */
    ps_sum_nodes nodes; /* of those before */
};

/* What there is of a range beside sums, to a checkpoint or from one. */
pspec_status ps_estimator_walk_segments(ps_estimator *self, ps_snapshot *snapshot,
                                        ps_error *error) PS_MUST_CHECK;
/* The next realization's number in the whole job. */
uint64_t ps_estimator_position(const ps_estimator *self);
/* What is known of the patterns so far, not of a range. */
ps_pattern_totals ps_estimator_totals(const ps_estimator *self);

/* ---- ranges (estimator_segments.c) ---- */

/* Realizations up to the end of the segment; UINT64_MAX: it has none. */
uint64_t ps_estimator_segment_left(const ps_estimator *self);
/* Where it is there: its sums become a node, and those of the next begin. */
pspec_status ps_estimator_end_segment(ps_estimator *self, ps_error *error) PS_MUST_CHECK;
/* Back to the first realization. */
void ps_estimator_restart_segments(ps_estimator *self);
/* All nodes, to be freed also after an error. */
pspec_status ps_estimator_nodes(ps_estimator *self, ps_sum_nodes *out,
                                ps_error *error) PS_MUST_CHECK;

/* Adds rows that are pending. */
pspec_status ps_estimator_add_pending(ps_estimator *self, ps_error *error) PS_MUST_CHECK;

/* Makes the engine anew, for half as many realizations as long as memory is refused. */
pspec_status ps_estimator_make_engine(ps_estimator *self, ps_error *error) PS_MUST_CHECK;
void ps_estimator_halve_batch(ps_estimator *self);
/* An engine for patterns of so many points. */
pspec_status ps_estimator_get_ready(ps_estimator *self, uint64_t num_points,
                                    ps_error *error) PS_MUST_CHECK;

/* The same for one pattern. */
double ps_estimator_error_of(const ps_estimator *self, double mean_power,
                             const ps_pattern_sums *sums);

/* Sums, scale and exponent of a pattern of the batch. */
void ps_estimator_set_sums(ps_estimator *self, size_t pattern, uint64_t num_points,
                           const ps_pattern_sums *sums);
/* W of the weights that the normalization means: where there are none, 1/N each under that of
 * pairs. */
double ps_estimator_weight_sum(const ps_estimator *self, const ps_pattern_sums *sums);
/* Keeps the largest sum w^2 / (sum |w|)^2. */
void ps_estimator_measure_share(ps_estimator *self, const ps_pattern_sums *sums);
/* Patterns of the batch, whose powers are added, are counted. */
void ps_estimator_count_patterns(ps_estimator *self, const pspec_pattern *patterns,
                                 size_t num_patterns);
/* ps_accumulator_observer.tell of an estimator that makes rows (estimator_rows.c). */
void ps_estimator_put_powers(void *payload, const double *bins, const double *weighted);

ps_batch ps_estimator_make_batch(const ps_estimator *self, const pspec_pattern *patterns,
                                 size_t num_patterns);

/* A pattern too large for long double sums is checked by its first points, in a run of their own.
 */
pspec_status ps_estimator_check_beginning(ps_estimator *self, const pspec_pattern *beginning,
                                          ps_error *error) PS_MUST_CHECK;

/* The engine's rows of a batch of one pattern, and its coefficients to options.coefficients: in one
 * go where they are of the same sums. */
pspec_status ps_estimator_run_with_coefficients(ps_estimator *self, const ps_batch *one,
                                                ps_rows *rows, ps_error *error) PS_MUST_CHECK;

/* Adds the rows of a batch to the averages, late ones when the next batch has been launched; of the
 * patterns only their numbers of points are looked at, and for C_l^2 their points. */
pspec_status ps_estimator_take(ps_estimator *self, const ps_rows *rows,
                               const pspec_pattern *patterns, size_t num_patterns,
                               ps_error *error) PS_MUST_CHECK;

#endif
