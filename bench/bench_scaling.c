/* The parts that a long job is made of, measured here, and what they come to on more machines: the
 * tables of docs/user/scaling.md.
 *
 *     bench_scaling                start, a realization, a checkpoint and its reading, a part and
 *                                  its merging; then what they come to on many machines
 */
#include "bench.h"

#include "jobs/spectrum/power_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Whole arrays, whose state is the largest that there is. */
typedef struct scaling_case {
    size_t num_points;
    int32_t k;
    uint64_t few, many; /* realizations, whose difference is timed */
    uint64_t all;       /* of the job of the model */
} scaling_case;
static const scaling_case cases[] = {{1024, 64, 256, 8448, 10000000},
                                     {4096, 256, 256, 1280, 1000000},
                                     {65536, 512, 128, 256, 100000}};
enum { NUM_CASES = sizeof cases / sizeof cases[0], TIMES = 3 };

/* Seconds, but for the bytes of a checkpoint and of a part. */
typedef struct parts {
    double start, each, saving, reading, saved_bytes, merging, part_bytes;
} parts;

static ps_power_question make_question(const ps_sampler_request *request, const scaling_case *what,
                                       uint64_t num) {
    return (ps_power_question){.sampler = request,
                               .num_realizations = num,
                               .frequencies.max_frequency = what->k,
                               .has_rings_of_box = true,
                               .wants_full_array = true,
                               .keeps_sums = true,
                               .accuracy = {.tolerance = 1e-6},
                               .limits.constraints = {.precision = -1},
                               .limits.device = getenv("POINTSPEC_DEVICE")};
}

/* The least of some times from nothing to the spectrum. */
static double time_job(ps_power_job **out, const ps_power_question *question) {
    double least = INFINITY;
    for (int i = 0; i < TIMES; i++) {
        ps_power_job_destroy(*out);
        const double begin = bench_seconds();
        BENCH_TRY(ps_power_job_create(out, question, error));
        BENCH_TRY(ps_power_job_run(*out, error));
        least = fmin(least, bench_seconds() - begin);
    }
    return least;
}

/* ---- checkpoints ----------------------------------------------------------------------------- */

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    return ps_estimator_walk(payload, snapshot, error);
}

/* Onto the disk of the folder of temporary files, with the waiting for it. */
static void time_checkpoint(parts *out, ps_power_job *job) {
    char folder[] = "/tmp/pointspec-bench-XXXXXX";
    char path[64];
    struct stat facts = {0};
    if (mkdtemp(folder) == NULL) {
        bench_die("there is no folder of temporary files");
    }
    snprintf(path, sizeof path, "%s/job.npz", folder);
    const ps_checkpoint_spec spec = {.path = path, .key = "bench\n"};
    out->saving = out->reading = INFINITY;
    for (int i = 0; i < TIMES; i++) {
        ps_checkpoint *checkpoint = NULL;
        double begin = bench_seconds();
        BENCH_TRY(ps_checkpoint_open(&checkpoint, &spec, "", error));
        if (ps_checkpoint_found(checkpoint) != NULL) {
            ps_estimator_reset(job->runner.estimator);
            BENCH_TRY(walk(job->runner.estimator, ps_checkpoint_found(checkpoint), error));
            out->reading = fmin(out->reading, bench_seconds() - begin);
        }
        begin = bench_seconds();
        BENCH_TRY(ps_checkpoint_save(checkpoint, walk, job->runner.estimator, error));
        out->saving = fmin(out->saving, bench_seconds() - begin);
        ps_checkpoint_close(checkpoint);
    }
    out->saved_bytes = stat(path, &facts) == 0 ? (double)facts.st_size : NAN;
    ps_checkpoint_remove(path, 0, 1);
    rmdir(folder);
}

/* ---- merging --------------------------------------------------------------------------------- */

/* One more part, of a block, which is a node of the tree of sums (spectra/sum_nodes.h). */
static void time_merge(parts *out, const ps_sampler_request *request, const scaling_case *what) {
    enum { BLOCK = 128 };
    ps_spectrum_sums sums[2];
    for (uint64_t i = 0; i < 2; i++) {
        ps_power_job *job = NULL;
        ps_power_question question = make_question(request, what, 2 * (uint64_t)BLOCK);
        question.range = (ps_realization_range){i * BLOCK, (i + 1) * BLOCK};
        BENCH_TRY(ps_power_job_create(&job, &question, error));
        BENCH_TRY(ps_power_job_run(job, error));
        BENCH_TRY(ps_power_job_sums(job, &sums[i], error));
        ps_power_job_destroy(job);
    }
    const char *const names[] = {"one", "the other"};
    const double begin = bench_seconds();
    BENCH_TRY(ps_spectrum_sums_join(&sums[0], &sums[1], names, error));
    out->merging = bench_seconds() - begin;
    out->part_bytes = (double)(ps_sum_nodes_size(&sums[1].nodes) * sizeof(ps_sums));
    ps_spectrum_sums_free(&sums[0]);
    ps_spectrum_sums_free(&sums[1]);
}

/* ---- all of it ------------------------------------------------------------------------------- */

static parts measure(const scaling_case *what) {
    ps_sampler_request request = {.num_points = what->num_points, .dimension = 2, .seed = 1};
    ps_power_job *job = NULL;
    parts out = {0};
    BENCH_TRY(ps_sampler_parse(&request, "jittered", error));
    const ps_power_question few = make_question(&request, what, what->few);
    const ps_power_question many = make_question(&request, what, what->many);
    const double begin = time_job(&job, &few);
    const double end = time_job(&job, &many);
    out.each = (end - begin) / (double)(what->many - what->few);
    out.start = fmax(0, begin - out.each * (double)what->few);
    time_checkpoint(&out, job);
    time_merge(&out, &request, what);
    ps_power_job_destroy(job);
    return out;
}

/* Seconds of a job on so many ranks: each has a range of whole blocks, whose sums are a node for
 * each binary digit of its length at most; the parts are merged one after the other, and come over
 * a network of that speed. */
static double model(const parts *with, const scaling_case *what, double ranks) {
    const double network = 1e9; /* bytes/s: 10 Gbit/s Ethernet, of which so much is left */
    const double block = 128;
    const double blocks = ceil((double)what->all / block);
    const double own = ceil(blocks / ranks);
    const double nodes = 1 + floor(log2(own));
    const double taking = (ranks - 1) * nodes * (with->merging + with->part_bytes / network);
    return with->start + own * block * with->each + taking;
}

static void print_model(const parts *all) {
    printf("\n| ranks |");
    for (int i = 0; i < NUM_CASES; i++) {
        printf(" N = %zu, K = %d, M = %.0e: s | efficiency |", cases[i].num_points, (int)cases[i].k,
               (double)cases[i].all);
    }
    printf("\n|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int ranks = 1; ranks <= 1024; ranks *= 4) {
        printf("| %d |", ranks);
        for (int i = 0; i < NUM_CASES; i++) {
            const double seconds = model(&all[i], &cases[i], ranks);
            printf(" %.3g | %.0f %% |", seconds,
                   100 * model(&all[i], &cases[i], 1) / seconds / ranks);
        }
        printf("\n");
    }
}

/* Devices of one process (answers/devices), of which no node goes over a network: N = 4096 and
 * K = 256. An H200 is predicted to take 7.6 us a realization (docs/engines/torus_nufft.md); its
 * start is what was left of 1.22 s of 4000 realizations beside 0.36 of kernels. */
static double model_of_gpus(const parts *with, double gpus, double num_realizations) {
    const double each = 7.6e-6;
    const double start = 0.86;
    const double parts_of_gpu = 4; /* PARTS_OF_DEVICE of devices_work.c */
    const double block = 128;
    const double num_parts = gpus > 1 ? parts_of_gpu * gpus : 0;
    const double own = num_realizations / gpus;
    const double nodes = num_parts > 0 ? 1 + floor(log2(own / parts_of_gpu / block)) : 0;
    return start + own * each + num_parts * nodes * with->merging;
}

static void print_gpus(const parts *with) {
    static const double realizations[] = {1e6, 1e7, 1e8};
    enum { NUM = sizeof realizations / sizeof realizations[0], MOST_GPUS = 8 };
    printf("\n| GPUs |");
    for (int i = 0; i < NUM; i++) {
        printf(" M = %.0e: s | efficiency |", realizations[i]);
    }
    printf("\n|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int gpus = 1; gpus <= MOST_GPUS; gpus *= 2) {
        printf("| %d |", gpus);
        for (int i = 0; i < NUM; i++) {
            const double seconds = model_of_gpus(with, gpus, realizations[i]);
            printf(" %.3g | %.0f %% |", seconds,
                   100 * model_of_gpus(with, 1, realizations[i]) / seconds / gpus);
        }
        printf("\n");
    }
}

int main(void) {
    parts all[NUM_CASES];
    printf("| N | K | start, s | a realization, ms | a checkpoint, MB | written, ms | read, ms | a "
           "node of a part, MB | merged, ms |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (int i = 0; i < NUM_CASES; i++) {
        const parts *const own = &all[i];
        all[i] = measure(&cases[i]);
        printf("| %zu | %d | %.2f | %.3g | %.1f | %.1f | %.1f | %.1f | %.1f |\n",
               cases[i].num_points, (int)cases[i].k, own->start, 1e3 * own->each,
               1e-6 * own->saved_bytes, 1e3 * own->saving, 1e3 * own->reading,
               1e-6 * own->part_bytes, 1e3 * own->merging);
        fflush(stdout);
    }
    print_model(all);
    print_gpus(&all[1]);
    return EXIT_SUCCESS;
}
