/* Many files: threads that read ahead show in nothing. Sets come in order with their bits, whatever
 * they stand in; errors in their turn; and memory does not grow with the number of files.
 */
#include "harness.h"

#include "harness_points.h"
#include "jobs/source.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NUM_FILES = 90, MOST_SETS = 3, BLOCK = 700 };

typedef struct files {
    char names[NUM_FILES][TEST_PATH_BYTES];
    const char *paths[NUM_FILES];
    ps_source *source;
    ps_point_set set;
} files;

/* ---- what stands in them --------------------------------------------------------------------- */

static const char *const endings[] = {"txt", "npy", "csv", "bin"};
enum { NUM_ENDINGS = sizeof endings / sizeof endings[0], SCATTERED = 9, PIPE = 12 };

static size_t count_sets(size_t file) {
    return file == PIPE ? 1 : file % MOST_SETS + 1;
}

static size_t count_points(size_t file) {
    return file % 7 == 0 ? 5000 : 40 + file;
}

/* A number of the torus that is found nowhere else. */
static double number(size_t file, size_t set, size_t i) {
    return (double)(((file * MOST_SETS + set) << 14) + i) * 0x1p-24;
}

static void fill(ps_point_set *set, size_t file, size_t which) {
    set->dimension = 2;
    set->num_points = count_points(file);
    assert_ok(ps_points_reserve(set, set->num_points, error));
    for (size_t i = 0; i < 2 * set->num_points; i++) {
        set->points[i] = number(file, which, i);
    }
}

/* (sets, points, 2), the set fastest. */
static void write_scattered(const char *path, const ps_point_set *sets, size_t num_sets) {
    const size_t num = 2 * sets[0].num_points;
    double *const all = calloc(num * num_sets, sizeof *all);
    char shape[64];
    for (size_t s = 0; s < num_sets; s++) {
        for (size_t i = 0; i < num; i++) {
            all[(i % 2 * sets[0].num_points + i / 2) * num_sets + s] = sets[s].points[i];
        }
    }
    snprintf(shape, sizeof shape, "(%zu, %zu, 2)", num_sets, sets[0].num_points);
    assert_true(test_write_array(path, "<f8", "True", shape, all, num * num_sets * sizeof *all));
    free(all);
}

static void write_files(files *self, const test_folder *folder) {
    for (size_t f = 0; f < NUM_FILES; f++) {
        ps_point_set sets[MOST_SETS] = {{0}};
        char name[32];
        snprintf(name, sizeof name, "%zu.%s", f, f == SCATTERED ? "npy" : endings[f % NUM_ENDINGS]);
        self->paths[f] = test_path(folder, name, self->names[f]);
        for (size_t s = 0; s < count_sets(f); s++) {
            fill(&sets[s], f, s);
        }
        if (f == SCATTERED) {
            write_scattered(self->paths[f], sets, count_sets(f));
        } else {
            assert_ok(
                test_points_write(self->paths[f], NULL, sets, count_sets(f), true, NULL, error));
        }
        for (size_t s = 0; s < MOST_SETS; s++) {
            ps_point_set_free(&sets[s]);
        }
    }
}

/* The file comes through a pipe, which waits for whoever reads it first; returns its end. */
static int pass_through_pipe(files *self) {
    int ends[2];
    char bytes[1 << 14];
    FILE *const file = fopen(self->paths[PIPE], "rb");
    assert_int_equal(pipe(ends), 0);
    const size_t num = fread(bytes, 1, sizeof bytes, file);
    assert_true(feof(file));
    fclose(file);
    assert_int_equal(write(ends[1], bytes, num), num);
    close(ends[1]);
    snprintf(self->names[PIPE], TEST_PATH_BYTES, "/dev/fd/%d", ends[0]);
    return ends[0];
}

/* ---- order ----------------------------------------------------------------------------------- */

static void take_set(files *self, size_t file, size_t which) {
    ps_source_part part;
    bool has_set = true;
    assert_ok(ps_source_next(self->source, &self->set, &part, &has_set, error));
    assert_true(has_set);
    for (bool ends = part.is_whole; !ends;) {
        assert_ok(ps_source_more(self->source, &self->set, BLOCK, &ends, error));
    }
    assert_int_equal(self->set.num_points, count_points(file));
    for (size_t i = 0; i < 2 * self->set.num_points; i++) {
        assert_true(self->set.points[i] == number(file, which, i));
    }
}

static void take_files(files *self, size_t num) {
    for (size_t f = 0; f < num; f++) {
        for (size_t s = 0; s < count_sets(f); s++) {
            take_set(self, f, s);
        }
    }
}

/* Sets of all sizes, those that come in blocks and those that a limit leaves no room for, from all
 * files again and again. */
static void sets_come_in_order(void **state) {
    const ps_source_options options[] = {{.points = {0}},
                                         {.whole_bytes = 1},
                                         {.points.memory_limit = 1 << 20},
                                         {.points.memory_limit = 1 << 22},
                                         {.points.memory_limit = 1 << 25, .whole_bytes = 1 << 16}};
    static const size_t ends[] = {1, 2, PIPE + 1, 0, PIPE + 30, NUM_FILES};
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        files self = {.source = NULL};
        ps_source_part part;
        bool has_set = true;
        write_files(&self, *state);
        const int end = pass_through_pipe(&self);
        assert_ok(ps_source_files(&self.source, self.paths, NUM_FILES, &options[i], error));
        for (size_t j = 0; j < sizeof ends / sizeof ends[0]; j++) {
            assert_ok(ps_source_rewind(self.source, error));
            take_files(&self, ends[j]);
        }
        assert_ok(ps_source_next(self.source, &self.set, &part, &has_set, error));
        assert_false(has_set);
        assert_string_equal(ps_source_format(self.source), "utk-text; npy; csv; utk-binary");
        ps_source_destroy(self.source);
        ps_point_set_free(&self.set);
        close(end);
    }
}

/* ---- errors ---------------------------------------------------------------------------------- */

static void write_text(const char *path, const char *text) {
    FILE *const file = fopen(path, "wb");
    assert_true(file != NULL && fputs(text, file) >= 0);
    fclose(file);
}

/* The sentence is that of the file alone, after all sets before it, however often it is asked. */
static void must_fail(files *self, size_t file) {
    ps_source_part part;
    ps_error found = {0};
    ps_error expected = {0};
    test_points alone;
    bool has_set = true;
    const pspec_status status =
        test_points_read(&alone, self->paths[file], &(ps_point_options){0}, &expected);
    assert_int_not_equal(status, PSPEC_OK);
    assert_ok(
        ps_source_files(&self->source, self->paths, NUM_FILES, &(ps_source_options){0}, error));
    for (int time = 0; time < 2; time++) {
        assert_ok(ps_source_rewind(self->source, error));
        take_files(self, file);
        assert_int_equal(ps_source_next(self->source, &self->set, &part, &has_set, &found), status);
        assert_string_equal(found.message, expected.message);
    }
    ps_source_destroy(self->source);
    ps_point_set_free(&self->set);
    test_points_free(&alone);
}

static void errors_come_in_their_turn(void **state) {
    files self = {.source = NULL};
    write_files(&self, *state);
    unlink(self.paths[70]);
    must_fail(&self, 70);
    write_text(self.paths[41], "");
    must_fail(&self, 41);
    write_text(self.paths[8], "0.5 0.5\n0.25 0.25\n0.5 much\n");
    must_fail(&self, 8);
    write_text(self.paths[0], "0.5 0.5\n0.25 2\n");
    must_fail(&self, 0);
}

/* ---- memory ---------------------------------------------------------------------------------- */

enum { MANY_POINTS = 100000, FEW_FILES = 40, MANY_FILES = 200 };

/* Kibibytes that this process has had at most when it has read so many files; -1: some did not
 * come. */
static long read_all(const char *path, size_t num) {
    const char *paths[MANY_FILES];
    struct rusage usage = {0};
    ps_source *source = NULL;
    ps_point_set set = {0};
    ps_source_part part;
    bool has_set = true;
    size_t num_sets = 0;
    for (size_t i = 0; i < num; i++) {
        paths[i] = path;
    }
    pspec_status status = ps_source_files(&source, paths, num, &(ps_source_options){0}, NULL);
    while (status == PSPEC_OK && has_set) {
        status = ps_source_next(source, &set, &part, &has_set, NULL);
        num_sets += has_set && set.num_points == MANY_POINTS;
    }
    getrusage(RUSAGE_SELF, &usage);
    ps_source_destroy(source);
    ps_point_set_free(&set);
    return status == PSPEC_OK && num_sets == num ? usage.ru_maxrss : -1;
}

/* In a process of its own. */
static long peak(const char *path, size_t num) {
    long found = -1;
    int ends[2];
    int code = 0;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        found = read_all(path, num);
        _exit(write(ends[1], &found, sizeof found) == sizeof found ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_int_equal(code, 0);
    assert_int_equal(read(ends[0], &found, sizeof found), sizeof found);
    close(ends[0]);
    close(ends[1]);
    assert_true(found > 0);
    return found;
}

/* Each more file than the few would add its set where it was kept. */
static void memory_is_constant_in_the_number_of_files(void **state) {
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    ps_point_set set = {.dimension = 2, .num_points = MANY_POINTS};
    assert_ok(ps_points_reserve(&set, MANY_POINTS, error));
    for (size_t i = 0; i < 2 * MANY_POINTS; i++) {
        set.points[i] = (double)i / (2 * MANY_POINTS);
    }
    assert_ok(
        test_points_write(test_path(folder, "many.npy", path), NULL, &set, 1, true, NULL, error));
    ps_point_set_free(&set);
    const long few = peak(path, FEW_FILES);
    const long many = peak(path, MANY_FILES);
    const long all = (long)(MANY_FILES - FEW_FILES) * MANY_POINTS * 2 * (long)sizeof(double) / 1024;
    print_message("%d files: %ld KiB, %d files: %ld KiB; their sets: %ld KiB more\n", FEW_FILES,
                  few, MANY_FILES, many, all);
    assert_true(many < few + all / 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sets_come_in_order, test_folder_create, test_folder_remove),
        cmocka_unit_test_setup_teardown(errors_come_in_their_turn, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(memory_is_constant_in_the_number_of_files,
                                        test_folder_create, test_folder_remove),
    };
    return cmocka_run_group_tests_name("file_streams", tests, NULL, NULL);
}
