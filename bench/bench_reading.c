/* How fast point files are read, format by format, beside the plain ways.
 *
 *     bench_reading [TEXT_POINTS [BINARY_POINTS]]   default 2e6 and 2e7 points of the plane, files in
 *                                                   $TMPDIR or /tmp, so in the disk cache
 *
 * whole: a set into memory, as power reads it; blocks: 32768 points at a time, as convert reads it.
 * fread: the same file into one buffer that was touched before; cat: cat FILE >/dev/null; numpy:
 * loadtxt, load or fromfile, timed by Python itself ("-" without python3-numpy). All are medians of
 * runs that alternate. wrong counts numbers that differ from what was written.
 */
#include "bench.h"

#include "base/text.h"
#include "points/points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DIMENSION = 2, REPEATS = 5, BLOCK_POINTS = 32768 };

typedef struct reading_case {
    const char *format;
    bool is_text;
    const char *numpy; /* expression that reads the file named f */
} reading_case;

static const reading_case cases[] = {
    {"utk-text", true, "numpy.loadtxt(f)"},
    {"csv", true, "numpy.loadtxt(f, delimiter=',')"},
    {"edat", true, "numpy.loadtxt(f, skiprows=3)"},
    {"psa-text", true, "numpy.loadtxt(f, skiprows=1)"},
    {"gbn", true, "numpy.loadtxt(f, skiprows=1)"},
    {"eps", true, NULL},
    {"utk-binary", false, "numpy.fromfile(f, '<f8', offset=20)"},
    {"npy", false, "numpy.load(f)"},
    {"rps", false, "numpy.fromfile(f, '<f4')"},
};

static double file_bytes(const char *path) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseeko(file, 0, SEEK_END) != 0) {
        bench_die(path);
    }
    const double bytes = (double)ftello(file);
    fclose(file);
    return bytes;
}

static void write_points(const char *path, const char *format, size_t num, double *points) {
    ps_point_writer *writer = NULL;
    const ps_point_shape shape = {.num_sets = 1, .num_points = num, .dimension = DIMENSION};
    const ps_point_set set = {.dimension = DIMENSION, .num_points = num, .points = points};
    BENCH_TRY(ps_points_create(&writer, path, format, &shape, error));
    BENCH_TRY(ps_points_write(writer, &set, true, error));
    BENCH_TRY(ps_points_commit(writer, error));
    ps_points_discard(writer);
}

/* ---- the ways to read -------------------------------------------------------------------- */

static size_t count_wrong(const ps_point_set *set, size_t first, const double *points) {
    size_t num_wrong = 0;
    for (size_t i = 0; i < set->num_points * DIMENSION; i++) {
        const double expected = points[first * DIMENSION + i];
        num_wrong += set->points[i] < expected || set->points[i] > expected;
    }
    return num_wrong;
}

/* Seconds of a whole set read into memory that earlier runs have touched. */
static double read_whole(const char *path, const char *format, ps_point_set *set) {
    const ps_point_options options = {.format = format};
    ps_point_reader *reader = NULL;
    bool has_set = true;
    bool ends_set = false;
    const double begin = bench_seconds();
    BENCH_TRY(ps_points_open(&reader, path, &options, error));
    set->num_points = 0;
    while (has_set && !ends_set) {
        BENCH_TRY(ps_points_next_block(reader, set, SIZE_MAX, &has_set, &ends_set, error));
    }
    const double seconds = bench_seconds() - begin;
    ps_points_close(reader);
    return seconds;
}

static double read_blocks(const char *path, const char *format) {
    const ps_point_options options = {.format = format};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = true;
    bool ends_set = false;
    const double begin = bench_seconds();
    BENCH_TRY(ps_points_open(&reader, path, &options, error));
    while (has_set && !ends_set) {
        set.num_points = 0;
        BENCH_TRY(ps_points_next_block(reader, &set, BLOCK_POINTS, &has_set, &ends_set, error));
    }
    const double seconds = bench_seconds() - begin;
    ps_points_close(reader);
    ps_point_set_free(&set);
    return seconds;
}

static double read_raw(const char *path, char *buffer, size_t num_bytes) {
    const double begin = bench_seconds();
    FILE *file = fopen(path, "rb");
    if (file == NULL || fread(buffer, 1, num_bytes, file) != num_bytes) {
        bench_die(path);
    }
    fclose(file);
    return bench_seconds() - begin;
}

static double read_with_cat(const char *path) {
    ps_text command = {0};
    ps_text_append(&command, "cat '%s' >/dev/null", path);
    const double begin = bench_seconds();
    if (system(ps_text_string(&command)) != 0) {
        bench_die("cat failed");
    }
    const double seconds = bench_seconds() - begin;
    ps_text_free(&command);
    return seconds;
}

/* nan without numpy. */
static double read_with_numpy(const char *path, const char *expression) {
    ps_text command = {0};
    double seconds = NAN;
    ps_text_append(&command,
                   "python3 -c \"import numpy, time; f = '%s'; t = time.perf_counter(); "
                   "%s; print(time.perf_counter() - t)\" 2>/dev/null",
                   path, expression);
    FILE *const answer = popen(ps_text_string(&command), "r");
    if (answer == NULL || fscanf(answer, "%lf", &seconds) != 1) {
        seconds = NAN;
    }
    if (answer != NULL) {
        pclose(answer);
    }
    ps_text_free(&command);
    return seconds;
}

/* ---- the table --------------------------------------------------------------------------- */

static void print_ratio(double other, double ours) {
    if (isnan(other)) {
        printf(" | %8s %7s", "-", "-");
    } else {
        printf(" | %8.0f %7.2f", other, ours / other);
    }
}

static void report(const reading_case *c, const char *path, size_t num, double *points) {
    double whole[REPEATS];
    double blocks[REPEATS];
    double raw[REPEATS];
    double cat[REPEATS];
    double numpy = NAN;
    ps_point_set set = {0};
    write_points(path, c->format, num, points);
    const double bytes = file_bytes(path);
    char *const buffer = malloc((size_t)bytes);
    read_whole(path, c->format, &set); /* memory is touched here, not in the runs */
    read_raw(path, buffer, (size_t)bytes);
    for (int i = 0; i < REPEATS; i++) {
        set.num_points = 0;
        whole[i] = read_whole(path, c->format, &set);
        raw[i] = read_raw(path, buffer, (size_t)bytes);
        blocks[i] = read_blocks(path, c->format);
        cat[i] = read_with_cat(path);
    }
    if (c->numpy != NULL) {
        numpy = read_with_numpy(path, c->numpy);
    }
    const double rate = bytes * 1e-6 / bench_median(whole, REPEATS);
    const double block_rate = bytes * 1e-6 / bench_median(blocks, REPEATS);
    printf("%-10s %8.1f %8zu | %8.0f %8.0f", c->format,
           (double)num * 1e-6 / bench_median(whole, REPEATS), count_wrong(&set, 0, points), rate,
           block_rate);
    print_ratio(bytes * 1e-6 / bench_median(raw, REPEATS), rate);
    print_ratio(bytes * 1e-6 / bench_median(cat, REPEATS), block_rate);
    print_ratio(bytes * 1e-6 / numpy, rate);
    printf("\n");
    free(buffer);
    ps_point_set_free(&set);
    unlink(path);
}

int main(int argc, char **argv) {
    const size_t num_text = argc > 1 ? (size_t)strtod(argv[1], NULL) : 2000000;
    const size_t num_binary = argc > 2 ? (size_t)strtod(argv[2], NULL) : 20000000;
    const size_t most = num_text > num_binary ? num_text : num_binary;
    const char *folder = getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp";
    double *points = bench_uniform(most * DIMENSION, 1);
    ps_text path = {0};
    for (size_t i = 0; i < most * DIMENSION; i++) { /* rps holds float32 */
        points[i] = i % 2 == 0 ? points[i] : (double)(float)(points[i] / 2);
    }
    ps_text_append(&path, "%s/pointspec-bench-%ld", folder, (long)getpid());
    printf("# points of the plane: %zu as text, %zu in binary; MB/s of the file\n", num_text,
           num_binary);
    printf("%-10s %8s %8s | %8s %8s | %8s %7s | %8s %7s | %8s %7s\n", "format", "Mpoint/s", "wrong",
           "whole", "blocks", "fread", "whole/", "cat", "blocks/", "numpy", "whole/");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        report(&cases[i], ps_text_string(&path), cases[i].is_text ? num_text : num_binary, points);
    }
    ps_text_free(&path);
    free(points);
    return 0;
}
