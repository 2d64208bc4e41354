/* The power spectrum of files of a million points: reading alone, file by file and ahead, as a job
 * does, then reading and computing together, seconds of all processors among them, and the largest
 * resident memory against the number of files; before it the same points from memory. A table of
 * docs/user/scaling.md.
 *
 *     bench_files                  files in $TMPDIR or /tmp, 2 GB at a time, so in the disk cache
 *
 * Times are the least of some that alternate.
 */
#include "bench.h"

#include "base/text.h"
#include "jobs/spectrum/power_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NUM_POINTS = 1000000, K = 64, FEW_FILES = 2, MOST_FILES = 40, NUM_COUNTS = 3, TIMES = 3 };
static const size_t counts[NUM_COUNTS] = {10, 20, MOST_FILES};

/* The ending of a file, and what makes it of the one before. */
typedef struct file_kind {
    const char *name, *ending, *packing;
} file_kind;
static const file_kind kinds[] = {
    {"npy", "npy", NULL}, {"text", "txt", NULL}, {"text, gzip -1", "txt.gz", "gzip -1"}};

typedef struct files {
    ps_text names[MOST_FILES];
    const char *paths[MOST_FILES];
    double bytes; /* of one */
    ps_given_set given;
    pspec_pattern points; /* the same in memory */
} files;

static void run_shell(const char *command) {
    if (system(command) != 0) {
        bench_die(command);
    }
}

static void write_points(const char *path, double *points) {
    ps_point_writer *writer = NULL;
    const ps_point_shape shape = {.num_sets = 1, .num_points = NUM_POINTS, .dimension = 2};
    const ps_point_set set = {.dimension = 2, .num_points = NUM_POINTS, .points = points};
    BENCH_TRY(ps_points_create(&writer, path, NULL, &shape, error));
    BENCH_TRY(ps_points_write(writer, &set, true, error));
    BENCH_TRY(ps_points_commit(writer, error));
    ps_points_discard(writer);
}

static void make_files(files *out, const file_kind *kind, const char *folder, double *points) {
    struct stat facts = {0};
    ps_text text = {0};
    ps_text_append(&text, "%s/points.%s", folder, kind->packing != NULL ? "txt" : kind->ending);
    write_points(ps_text_string(&text), points);
    for (size_t i = 0; i < MOST_FILES; i++) {
        ps_text command = {0};
        ps_text_append(&out->names[i], "%s/%zu.%s", folder, i, kind->ending);
        out->paths[i] = ps_text_string(&out->names[i]);
        ps_text_append(&command, "%s < '%s' > '%s'",
                       i == 0 && kind->packing != NULL ? kind->packing : "cat",
                       i == 0 ? ps_text_string(&text) : out->paths[0], out->paths[i]);
        run_shell(ps_text_string(&command));
        ps_text_free(&command);
    }
    remove(ps_text_string(&text));
    ps_text_free(&text);
    out->bytes = stat(out->paths[0], &facts) == 0 ? (double)facts.st_size : NAN;
}

static void remove_files(files *group) {
    for (size_t i = 0; i < MOST_FILES; i++) {
        remove(group->paths[i]);
        ps_text_free(&group->names[i]);
    }
}

/* ---- ways ------------------------------------------------------------------------------------ */

/* Reading alone, file by file and ahead, as a job reads; jobs with files, and with points in memory
 * as often. */
typedef enum job_way { READ_ALONE, READ_AHEAD, FROM_FILES, FROM_MEMORY } job_way;

static void read_files(const files *group, size_t num, size_t step) {
    ps_point_set set = {0};
    for (size_t i = 0; i < num; i += step) {
        ps_source *source = NULL;
        ps_source_part part;
        bool has_set = true;
        BENCH_TRY(ps_source_files(&source, group->paths + i, step, &(ps_source_options){0}, error));
        while (has_set) {
            BENCH_TRY(ps_source_next(source, &set, &part, &has_set, error));
        }
        ps_source_destroy(source);
    }
    ps_point_set_free(&set);
}

static pspec_status give(void *payload, uint64_t realization, pspec_pattern *out, bool *has_set,
                         ps_error *error) {
    const files *const group = payload;
    (void)realization;
    (void)error;
    *out = group->points;
    *has_set = true;
    return PSPEC_OK;
}

/* Of the whole process: seconds, those of its processors, and its largest memory. */
typedef struct usage {
    double seconds, busy, kibibytes;
} usage;

static usage use(void) {
    const double micro = 1e-6;
    struct rusage own = {0};
    getrusage(RUSAGE_SELF, &own);
    return (usage){.seconds = bench_seconds(),
                   .busy = (double)(own.ru_utime.tv_sec + own.ru_stime.tv_sec) +
                           micro * (double)(own.ru_utime.tv_usec + own.ru_stime.tv_usec),
                   .kibibytes = (double)own.ru_maxrss};
}

static void run_job(files *group, size_t num, bool are_given) {
    static const char name[] = "points in memory";
    static const char *const names[] = {name};
    group->given =
        (ps_given_set){.name = name, .next = give, .payload = group, .most = num, .num = num};
    const ps_power_question question = {.paths = are_given ? names : group->paths,
                                        .num_paths = are_given ? 1 : num,
                                        .point_options.given = {&group->given, are_given ? 1 : 0},
                                        .frequencies.max_frequency = K,
                                        .accuracy = {.tolerance = 1e-6},
                                        .limits.constraints = {.precision = -1},
                                        .limits.device = getenv("POINTSPEC_DEVICE")};
    ps_power_job *job = NULL;
    BENCH_TRY(ps_power_job_create(&job, &question, error));
    BENCH_TRY(ps_power_job_run(job, error));
    ps_power_job_destroy(job);
}

static usage run(files *group, size_t num, job_way way) {
    const usage begin = use();
    if (way == READ_ALONE || way == READ_AHEAD) {
        read_files(group, num, way == READ_ALONE ? 1 : num);
    } else {
        run_job(group, num, way == FROM_MEMORY);
    }
    const usage end = use();
    return (usage){end.seconds - begin.seconds, end.busy - begin.busy, end.kibibytes};
}

/* Of few files and of many, in a process of its own: the least of the times so far. */
static void time_it(usage least[2], files *group, size_t num, job_way way) {
    usage found[2] = {{0}};
    int ends[2] = {-1, -1};
    fflush(stdout);
    const pid_t child = pipe(ends) == 0 ? fork() : -1;
    if (child == 0) {
        found[0] = run(group, FEW_FILES, way);
        found[1] = run(group, num, way);
        _exit(write(ends[1], found, sizeof found) == sizeof found ? EXIT_SUCCESS : EXIT_FAILURE);
    }
    waitpid(child, NULL, 0);
    close(ends[1]);
    if (read(ends[0], found, sizeof found) != sizeof found) {
        bench_die("a job of files failed");
    }
    close(ends[0]);
    for (int i = 0; i < 2; i++) {
        least[i] = found[i].seconds < least[i].seconds ? found[i] : least[i];
    }
}

/* A file more than the few, in milliseconds: without the start. */
static double per_file(double few, double many, size_t num) {
    return 1e3 * (many - few) / (double)(num - FEW_FILES);
}

static void print_job(const usage least[2], double bytes, size_t num) {
    const double each = per_file(least[0].seconds, least[1].seconds, num);
    printf(" %.1f | %.1f | %.2f | %.0f |\n", each, per_file(least[0].busy, least[1].busy, num),
           1e-6 * bytes / each, least[1].kibibytes * 1024e-6);
    fflush(stdout);
}

static void print_files(files *group, const file_kind *kind, size_t num) {
    usage least[FROM_MEMORY][2];
    printf("| %s | %zu | %.1f |", kind->name, num, 1e-6 * group->bytes);
    for (int i = 0; i < TIMES; i++) {
        for (job_way way = READ_ALONE; way < FROM_MEMORY; way++) {
            for (int j = 0; j < 2 && i == 0; j++) {
                least[way][j] = (usage){.seconds = INFINITY};
            }
            time_it(least[way], group, num, way);
        }
    }
    for (job_way way = READ_ALONE; way < FROM_FILES; way++) {
        printf(" %.1f |", per_file(least[way][0].seconds, least[way][1].seconds, num));
    }
    print_job(least[FROM_FILES], group->bytes, num);
}

static void print_memory(double *points) {
    files group = {.points = {2, NUM_POINTS, points, NULL}};
    usage least[2] = {{.seconds = INFINITY}, {.seconds = INFINITY}};
    for (int i = 0; i < TIMES; i++) {
        time_it(least, &group, MOST_FILES, FROM_MEMORY);
    }
    printf("| memory | %d | %.1f | | |", MOST_FILES, 16e-6 * NUM_POINTS);
    print_job(least, 16. * NUM_POINTS, MOST_FILES);
}

int main(void) {
    const char *const folder = getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp";
    double *const points = bench_uniform((size_t)2 * NUM_POINTS, 1);
    ps_text own = {0};
    ps_text_append(&own, "%s/pointspec-bench-%ld", folder, (long)getpid());
    if (mkdir(ps_text_string(&own), 0700) != 0) {
        bench_die("there is no folder of temporary files");
    }
    printf("| files | number | MB each | read file by file, ms a file | read ahead | "
           "read and computed | of processors | GB/s | peak, MB |\n"
           "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    print_memory(points);
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        files group = {.bytes = 0};
        make_files(&group, &kinds[k], ps_text_string(&own), points);
        for (int i = 0; i < NUM_COUNTS; i++) {
            print_files(&group, &kinds[k], counts[i]);
        }
        remove_files(&group);
    }
    rmdir(ps_text_string(&own));
    ps_text_free(&own);
    free(points);
    return EXIT_SUCCESS;
}
