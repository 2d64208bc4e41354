/* How fast point files are read: seconds and points/s for text and NPY, beside the plain ways.
 *
 *     bench_reading [POINTS]       default 1e7 two-dimensional points, files in $TMPDIR or /tmp
 *
 * "raw" reads the same file with fread into one large buffer: the disk cache's speed. "strtod" is what a
 * C programmer writes first for text. Bits are compared: the error column counts numbers that differ
 * from what was written.
 */
#include "bench.h"

#include "base/text.h"
#include "io/points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { DIMENSION = 2, REPEATS = 3 };

static double file_bytes(const char *path) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        bench_die(path);
    }
    const double bytes = (double)ftell(file);
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

static double read_points(const char *path, const double *points, size_t *num_wrong) {
    const ps_point_options options = {0};
    ps_point_reader *reader = NULL;
    ps_point_set set = {0};
    bool has_set = false;
    const double begin = bench_seconds();
    BENCH_TRY(ps_points_open(&reader, path, &options, error));
    BENCH_TRY(ps_points_next(reader, &set, &has_set, error));
    const double seconds = bench_seconds() - begin;
    *num_wrong = 0;
    for (size_t i = 0; i < set.num_points * DIMENSION; i++) {
        *num_wrong += set.points[i] < points[i] || set.points[i] > points[i];
    }
    ps_points_close(reader);
    ps_point_set_free(&set);
    return seconds;
}

static double read_raw(const char *path) {
    const size_t bytes = (size_t)file_bytes(path);
    char *buffer = malloc(bytes);
    FILE *file = fopen(path, "rb");
    const double begin = bench_seconds();
    if (buffer == NULL || file == NULL || fread(buffer, 1, bytes, file) != bytes) {
        bench_die(path);
    }
    const double seconds = bench_seconds() - begin;
    fclose(file);
    free(buffer);
    return seconds;
}

static double read_with_strtod(const char *path, size_t num) {
    char line[256];
    FILE *file = fopen(path, "r");
    double *points = malloc(num * DIMENSION * sizeof(double));
    const double begin = bench_seconds();
    for (size_t j = 0; file != NULL && j < num && fgets(line, sizeof line, file) != NULL; j++) {
        char *at = line;
        for (int axis = 0; axis < DIMENSION; axis++) {
            points[j * DIMENSION + (size_t)axis] = strtod(at, &at);
        }
    }
    const double seconds = bench_seconds() - begin;
    free(points);
    fclose(file);
    return seconds;
}

static void report(const char *format, const char *path, size_t num, double *points) {
    double ours[REPEATS];
    double raw[REPEATS];
    double plain[REPEATS];
    const bool is_text = format[0] == 'u';
    size_t num_wrong = 0;
    write_points(path, format, num, points);
    for (int i = 0; i < REPEATS; i++) {
        ours[i] = read_points(path, points, &num_wrong);
        raw[i] = read_raw(path);
        plain[i] = is_text ? read_with_strtod(path, num) : NAN;
    }
    const double seconds = bench_median(ours, REPEATS);
    printf("%-10s %8.3f %10.1f %9.0f %8zu | %8.3f %7.2f | %8.3f %7.2f\n", format, seconds,
           (double)num / seconds * 1e-6, file_bytes(path) / seconds * 1e-6, num_wrong,
           bench_median(raw, REPEATS), bench_median(raw, REPEATS) / seconds,
           bench_median(plain, REPEATS), bench_median(plain, REPEATS) / seconds);
    unlink(path);
}

int main(int argc, char **argv) {
    const size_t num = argc > 1 ? (size_t)strtod(argv[1], NULL) : 10000000;
    const char *folder = getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp";
    double *points = bench_uniform(num * DIMENSION, 1);
    ps_text text = {0};
    ps_text npy = {0};
    ps_text_append(&text, "%s/pointspec-bench-%ld.txt", folder, (long)getpid());
    ps_text_append(&npy, "%s/pointspec-bench-%ld.npy", folder, (long)getpid());
    printf("# %zu points, dimension %d, files in the disk cache, one thread\n", num, DIMENSION);
    printf("%-10s %8s %10s %9s %8s | %8s %7s | %8s %7s\n", "format", "seconds", "Mpoints/s", "MB/s",
           "wrong", "raw s", "ratio", "strtod s", "ratio");
    report("utk-text", ps_text_string(&text), num, points);
    report("npy", ps_text_string(&npy), num, points);
    ps_text_free(&text);
    ps_text_free(&npy);
    free(points);
    return 0;
}
