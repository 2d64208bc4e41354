/* The interface of every engine, on the torus and on the sphere, and the table that names them all.
 *
 * An engine turns batches of point sets into rows of powers, one row per realization, one slot per
 * frequency or degree (plus padding). It says when it applies, what it costs in work and memory and
 * how exact it is; the planner (host/plan) compares. Costs are counts of work: turning them into
 * seconds is the cost model's business. A new engine is a new file and a row in engines/engines.c.
 */
#ifndef PS_ENGINES_ENGINE_H
#define PS_ENGINES_ENGINE_H

#include "base/status.h"
#include "base/text.h"
#include "device/device.h"
#include "device/precision.h"
#include "frequencies/frequencies.h"
#include "sets/device_sets.h"

/* Which harmonics coefficients are of: exponentials are those of the torus. */
typedef enum ps_harmonics {
    PS_NO_HARMONICS = 0,
    PS_SPHERICAL_HARMONICS,
    PS_HEMISPHERICAL_HARMONICS,
    PS_EXPONENTIALS
} ps_harmonics;

/* What the tolerance of a problem is about. */
typedef enum ps_measure {
    PS_OF_AMPLITUDES = 0, /* S relative to white noise, see ps_survey.error */
    PS_OF_PAIR_SUMS = 1   /* Q(l) relative to (sum |w|)^2, on the sphere (engines/error_units.h) */
} ps_measure;

/* What is to be computed, for the whole job: engines and planner see nothing of batches. */
typedef struct ps_problem {
    const ps_frequencies *frequencies;
    uint64_t num_points;       /* of the largest realization */
    uint64_t num_realizations; /* 0: not known in advance */
    bool has_weights;
    ps_measure measure;
    double tolerance; /* as the measure says */
    /* Powers, relative to white noise, that pair sums are to have right to 10 %; 0: none */
    double floor;
    double weight_share;   /* largest sum w^2 / (sum |w|)^2 of a set; 0: not known, 1 / N */
    double expected_power; /* mean effective power of the sets; 0: not known, 1 as of white noise */
    /* num_points when the job was planned, which later growth leaves alone, for choices that must
     * be the same for all of it; 0: num_points */
    uint64_t planned_points;
    /* Points of a set in host memory at a time, where the engine allows it; 0: all */
    uint64_t block_points;
    ps_harmonics harmonics;  /* whose coefficients are wanted, too */
    bool keeps_coefficients; /* of every set, until the end; else of the only one */
    bool fills_boxes;        /* with those of every set on the torus at the end */
    bool keeps_sums;         /* sums of frequencies become state of the answer */
    size_t num_weighted;     /* weighted sums of the powers of every realization */
    double making_bytes;     /* of the host, while a sampler makes a set (ps_sampler_work_bytes) */
} ps_problem;

/* That of white noise where nothing is known: 1, with a margin on the sphere. */
double ps_expected_power(const ps_problem *problem);

/* planned_points where the job was planned already, else num_points. */
double ps_planned_points(const ps_problem *problem);

/* Work and memory of a whole job. */
typedef struct ps_work {
    double phases;        /* (point, frequency) pairs for which a cosine and sine are made */
    double product_flops; /* additions and multiplications of products of tables */
    /* What a device at its peak would do while spreading and transforming */
    double transform_flops;
    double harmonics;    /* (point, degree, order) triples, orders from 0 on, and what
                                     begins and ends them in units of the same time */
    double pair_degrees; /* (pair of points, degree), each pair once */
    double node_degrees; /* (node of a histogram of pairs, degree) */
    double binned_pairs; /* pairs of points put into a histogram */
    double launches;     /* kernel launches */
    double programs;     /* of kernels, which the driver loads once in a process */
    double fixed_bytes;  /* memory, whatever the batch */
    double host_bytes;   /* part of that on the host */
    /* On the host besides, unless memory is unified: twins of buffers that it fills */
    double twin_bytes;
    double bytes_per_realization; /* on the device, for each realization of a batch */
    double row_bytes;             /* part of that for its powers */
    double point_bytes; /* of points of each realization besides, on the device and on the host */
    /* part of that, twice on the device, and with twins where memory is not unified */
    double coordinate_bytes;
    double largest_buffer_per_realization; /* part of that in one allocation */
    /* Realizations of a batch that share work, whatever fits into caches; 0: any */
    double wanted_batch;
    bool takes_blocks; /* ps_engine.stream will */
} ps_work;

/* A batch of realizations. power = scales[r] |S|^2, S with weights w 2^-exponents[r] (NULL: 0),
 * the largest of which jobs make a number in [1/2, 1): factors of fp16 have no place for others; on
 * the sphere |S|^2 is Q(l) = (4 pi / (2l + 1)) sum_m |c_lm|^2, whose expectation is sum w^2 for
 * white noise, as that of |S|^2 on the torus. Points of the sphere are vectors of a length between
 * 1 - 1e-6 and 1 + 1e-6: they stand for their directions, and it is the engine that divides.
 * should_stop, unless it is NULL, is asked every second or so; true ends the run with
 * PSPEC_ERROR_CANCELLED. */
typedef struct ps_batch {
    size_t num_patterns;
    const pspec_pattern *patterns;
    const double *scales;
    const int *exponents;
    /* Instead of points, which patterns then lack, and weights: realizations that the device makes
     * itself, the first pattern being number `realization`; with is_one_set patterns are parts of
     * that one, from first_point on. NULL: patterns have their points. Only for engines that take
     * them. */
    ps_device_sets *sets;
    uint64_t realization, first_point;
    bool is_one_set;
    bool (*should_stop)(void *payload);
    void *payload;
} ps_batch;

/* What a pair of points costs before its first degree, in degrees: kernels/pairs/sums.cl. */
enum { PS_PAIR_BEGIN_DEGREES = 12 };

/* PSPEC_ERROR_CANCELLED when the batch is to stop. */
pspec_status ps_batch_go_on(const ps_batch *batch, ps_error *error) PS_MUST_CHECK;
/* The same once the device has done what was launched, for launches that follow each other without
 * points for the device in between: the driver would take them all, and nobody could stop them. */
pspec_status ps_batch_go_on_after(const ps_batch *batch, ps_device *device,
                                  ps_error *error) PS_MUST_CHECK;
/* Patterns first .. of a batch, `most` at most, as a batch. */
ps_batch ps_batch_part(const ps_batch *batch, size_t first, size_t most);
/* Points first .. of a pattern, `most` at most, as a pattern. */
pspec_pattern ps_pattern_part(const pspec_pattern *whole, size_t first, size_t most);
/* The same of the only pattern of a batch, as a batch that borrows *part. */
ps_batch ps_batch_chunk(const ps_batch *one, size_t first, size_t most, pspec_pattern *part);
/* Points of the largest pattern, 1 at least. */
size_t ps_batch_longest(const ps_batch *batch);

/* Rows of powers, borrowed from the engine until its next run, or, if they are late, until the one
 * behind it. */
typedef struct ps_late_rows ps_late_rows;
typedef struct ps_rows {
    size_t num_rows, stride; /* realizations; entries from row to row */
    ps_precision precision;  /* of the entries: single -> float, else double */
    const double *host;      /* rows in host memory, or NULL */
    ps_buffer device;        /* else rows in device memory, padded to a multiple of the lanes */
    ps_late_rows *late;      /* or these (engines/late_rows.h): ps_rows_wait brings them to host */
    uint64_t run;
} ps_rows;

/* Waits for late rows, which is sooner than for the device where the engine has run again. */
pspec_status ps_rows_wait(ps_rows *rows, ps_error *error) PS_MUST_CHECK;

/* One realization whose points come in blocks, for sets larger than memory: begin, add any number
 * of times, finish. Bits are those of run. */
typedef struct ps_engine_stream {
    /* All blocks but the last have a multiple of so many points. 0: this state takes whole sets
     * only. */
    size_t (*unit)(const void *state);
    pspec_status (*begin)(void *state, ps_error *);
    /* The only pattern of the batch: more points. Its exponent is that of the whole set; scales are
     * not looked at. */
    pspec_status (*add)(void *state, const ps_batch *block, ps_error *);
    pspec_status (*finish)(void *state, double scale, ps_rows *, ps_error *);
} ps_engine_stream;

/* Where points may lie: bits of ps_engine.domains. */
enum { PS_ON_TORUS = 1, PS_ON_SPHERE = 2 };

/* What an engine says of a problem. */
typedef struct ps_survey {
    const char *why_not; /* a static sentence; NULL: applicable, else the rest is not there */
    ps_work work;
    /* Expected error e of S in sqrt(mean |dS|^2) = e sqrt(sum w^2), mean over the frequencies, for
     * sets of the expected power (ps_expected_power). On the sphere sqrt(4 pi mean |dc_lm|^2), mean
     * over all degrees and orders. With sums_pairs instead the largest |dQ(l)| = e (sum |w|)^2 of
     * all degrees. engines/error_units.h brings both to what the problem asks for. The formula and
     * its measured slack are in the engine's page in docs/. */
    double error;
} ps_survey;

typedef struct ps_engine {
    const char *name;
    unsigned domains; /* others are never asked */
    bool needs_device;
    bool rows_on_host;     /* though it needs a device: they are short */
    bool has_precision[3]; /* by ps_precision */
    bool takes_sets;       /* of ps_batch: points that the device makes */
    bool checks_points;    /* run gives PSPEC_ERROR_INPUT for coordinates outside [0,1) */
    bool sums_pairs; /* Q(l) = sum_ij w_i w_j P_l(u_i.u_j) over pairs; error is another one then */

    /* All that the planner asks. limits is NULL without a device. */
    ps_survey (*survey)(const ps_problem *, const ps_device_limits *limits, ps_precision);
    size_t state_bytes;
    /* Fills a state of zeros (ps_engine_create). batch: the largest number of patterns in one run.
     * The problem's frequencies are enumerated and outlive the state. */
    pspec_status (*create)(void *state, const ps_problem *, ps_precision, size_t batch, ps_device *,
                           ps_error *);
    /* slots[i] is where in a row the power of frequency i stands; NULL: at i. */
    void (*get_slots)(const void *state, uint32_t *slots);
    /* Entries in a row; NULL: as many as frequencies. */
    size_t (*get_stride)(const void *state);
    /* The error of a survey again, for the problem that the state was made for and what was
     * measured since: effective power averaged over the frequencies (1: white noise), and
     * weight_share as a problem has it. */
    double (*error_of_state)(const void *state, double mean_power, double weight_share);
    pspec_status (*run)(void *state, const ps_batch *, ps_rows *, ps_error *);
    const ps_engine_stream *stream; /* NULL: whole sets only */
    /* Of a batch of one pattern, as pairs (real, imaginary): on the torus S(k) = sum w
     * exp(-2 pi i k.x) of every frequency in their order; on the sphere c_lm = sum w Y_lm(u) for
     * l = 0 .. L, 0 <= m <= l, at index m (2L + 1 - m) / 2 + l, the order of healpy, whose a_lm is
     * the conjugate.
     * Weights as they are, whatever the exponent. With only even degrees the others are 0. out has
     * ps_num_coefficients_at. Unless rows is NULL also what run gives, to the bit, from the same
     * sums; only then scales are looked at. NULL: an engine without. */
    pspec_status (*coefficients)(void *state, const ps_batch *one, ps_rows *rows, double *out,
                                 ps_error *);
    /* "(torus_direct precision=single split=33x32 lanes=16)" */
    void (*describe)(const void *state, ps_text *);
    void (*destroy)(void *state); /* frees what a state has, also what was created in part */
} ps_engine;

/* Doubles of the coefficients: up to degree L (L + 1)(L + 2), on the torus two a frequency. */
size_t ps_num_coefficients(int32_t max_degree);
size_t ps_num_coefficients_at(const ps_frequencies *frequencies);

/* PS_ON_SPHERE for degrees, else PS_ON_TORUS. */
unsigned ps_problem_domain(const ps_problem *problem);

/* Each has a page in docs/engines/; host_direct is the referee. */
extern const ps_engine ps_torus_nufft, ps_torus_direct, ps_sphere_grid, ps_sphere_nufft,
    ps_sphere_direct, ps_pairs_direct, ps_pairs_histogram, ps_host_direct;

/* All of them, ended by NULL, in the order in which plan lists them. */
extern const ps_engine *const ps_engines[];

/* How much longer a device takes because small work-groups are not shared out evenly: a few of them
 * leave units idle. */
double ps_engine_idle_factor(double groups, const ps_device_limits *limits);

/* Part of survey of every engine whose kernels know single and double precision: is there a device
 * that has this one? */
bool ps_engine_on_device(const ps_device_limits *limits, ps_precision precision,
                         const char **why_not);

/* A state of the engine; *state is NULL after a failure. */
pspec_status ps_engine_create(const ps_engine *engine, void **state, const ps_problem *problem,
                              ps_precision precision, size_t batch, ps_device *device,
                              ps_error *error) PS_MUST_CHECK;
void ps_engine_destroy(const ps_engine *engine, void *state); /* NULL allowed */

/* Entries in a row of the engine, and where in it the powers of the num frequencies stand. */
size_t ps_engine_stride(const ps_engine *engine, const void *state, size_t num);
void ps_engine_slots(const ps_engine *engine, const void *state, size_t num, uint32_t *slots);

/* Runs a batch of one pattern: powers[num] of its frequencies. */
pspec_status ps_engine_powers(const ps_engine *engine, void *state, const ps_batch *one, size_t num,
                              ps_device *device, double *powers, ps_error *error) PS_MUST_CHECK;

/* Lanes of the device kernels: frequencies (or realizations) side by side. The native vector width
 * on CPUs; on GPUs, where it means work per work-item, GPU_LANES. */
unsigned ps_engine_lanes(const ps_device_limits *limits, ps_precision precision);

#endif
