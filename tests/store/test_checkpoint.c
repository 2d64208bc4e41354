/* Checkpoints: what was written is what is read, or nothing; one job at a time; faults of the file
 * are no faults of the job. */
#include "harness.h"
#include "test_folder.h"

#include "store/checkpoint.h"

#include <math.h>
#include <sys/stat.h>

typedef struct some_state {
    double sums[5];
    uint64_t counts[2];
    unsigned char bytes[3];
    double apart, other;
} some_state;

static const some_state known = {
    {1.0 / 3, -0.0, NAN, 1e-300, INFINITY}, {UINT64_MAX / 3, 7}, {0, 255, 1}, 2.5, -3};

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    some_state *const self = payload;
    double *const apart[] = {&self->apart, &self->other};
    PS_TRY(ps_snapshot_doubles(snapshot, "sums", self->sums, 5, error));
    PS_TRY(ps_snapshot_counts(snapshot, "counts", self->counts, 2, error));
    PS_TRY(ps_snapshot_bytes(snapshot, "bytes", self->bytes, 3, error));
    PS_TRY(ps_snapshot_doubles(snapshot, "nothing", NULL, 0, error));
    return ps_snapshot_gather(snapshot, "apart", apart, 2, error);
}

static pspec_status refuse(void *payload, ps_snapshot *snapshot, ps_error *error) {
    (void)snapshot;
    return ps_fail(error, *(pspec_status *)payload, "the walk failed");
}

static void hear(const char *sentence, void *payload) {
    (void)sentence;
    ++*(int *)payload;
}

static pspec_status open_one(ps_checkpoint **out, const char *path, const char *key, int *heard,
                             ps_error *error) {
    const ps_checkpoint_spec spec = {.path = path, .key = key, .interval = 0, .log = {hear, heard}};
    return ps_checkpoint_open(out, &spec, "device none\n", error);
}

static void save(const char *path, const char *key) {
    ps_checkpoint *checkpoint = NULL;
    some_state own = known;
    int heard = 0;
    assert_ok(open_one(&checkpoint, path, key, &heard, error));
    assert_true(ps_checkpoint_is_due(checkpoint));
    assert_ok(ps_checkpoint_save(checkpoint, walk, &own, error));
    assert_int_equal(heard, 0);
    ps_checkpoint_close(checkpoint);
}

static void what_is_read_was_written(void **state) {
    char path[TEST_PATH_BYTES];
    ps_checkpoint *checkpoint = NULL;
    some_state found = {.apart = 9};
    int heard = 0;
    test_path(*state, "job.npz", path);
    assert_ok(open_one(&checkpoint, path, "power\n", &heard, error));
    assert_null(ps_checkpoint_found(checkpoint));
    ps_checkpoint_close(checkpoint);
    assert_int_equal(test_folder_count(*state, false), 0); /* the lock goes, too */

    save(path, "power\n");
    assert_ok(open_one(&checkpoint, path, "power\n", &heard, error));
    assert_true(ps_snapshot_is_read(ps_checkpoint_found(checkpoint)));
    assert_ok(walk(&found, ps_checkpoint_found(checkpoint), error));
    assert_memory_equal(found.sums, known.sums, sizeof known.sums);
    assert_memory_equal(found.counts, known.counts, sizeof known.counts);
    assert_memory_equal(found.bytes, known.bytes, sizeof known.bytes);
    assert_true(found.apart == known.apart && found.other == known.other);

    ps_error error = {0};
    double more[6];
    ps_snapshot *const snapshot = ps_checkpoint_found(checkpoint);
    assert_int_equal(ps_snapshot_doubles(snapshot, "sums", more, 6, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "\"sums\" is of another size"));
    assert_int_equal(ps_snapshot_doubles(snapshot, "bins", more, 6, &error), PSPEC_ERROR_INPUT);
    assert_non_null(strstr(error.message, "\"bins\" is not there"));
    ps_checkpoint_forget(checkpoint);
    assert_null(ps_checkpoint_found(checkpoint));
    ps_checkpoint_close(checkpoint);
    ps_checkpoint_remove(path, 0, 2); /* a part that is not there is no fault */
    assert_int_equal(test_folder_count(*state, true), 0);
}

static void expect_refusal(const char *path, const char *key, const char *words) {
    ps_checkpoint *checkpoint = NULL;
    ps_error error = {0};
    int heard = 0;
    assert_int_equal(open_one(&checkpoint, path, key, &heard, &error), PSPEC_ERROR_INPUT);
    assert_null(checkpoint);
    assert_non_null(strstr(error.message, words));
}

static void other_jobs_are_refused(void **state) {
    char path[TEST_PATH_BYTES];
    ps_checkpoint *checkpoint = NULL;
    int heard = 0;
    test_path(*state, "job.npz", path);
    save(path, "power\nseed 1\n");
    expect_refusal(path, "power\nseed 2\n", "it has \"seed 1\", and this one \"seed 2\"");
    expect_refusal(path, "power\nseed 1\nsampler white\n", "and this one \"sampler white\"");
    expect_refusal(path, "power\n", "it has \"seed 1\", and this one \"\"");
    assert_ok(open_one(&checkpoint, path, "power\nseed 1\n", &heard, error));
    expect_refusal(path, "power\nseed 1\n", "is the checkpoint of a job that runs");
    ps_checkpoint_close(checkpoint);
    test_folder_count(*state, true);
}

/* Every prefix, and every byte that is another. */
static void damage_is_seen(void **state) {
    char path[TEST_PATH_BYTES];
    unsigned char bytes[8192];
    test_path(*state, "job.npz", path);
    save(path, "power\n");
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t num = fread(bytes, 1, sizeof bytes, file);
    assert_int_equal(fclose(file), 0);
    assert_true(num > 500 && num < sizeof bytes);
    for (size_t i = 0; i < 2 * num; i++) {
        const size_t length = i < num ? i : num;
        file = fopen(path, "wb");
        assert_non_null(file);
        bytes[i % num] ^= i < num ? 0 : 0x40;
        assert_int_equal(fwrite(bytes, 1, length, file), length);
        assert_int_equal(fclose(file), 0);
        bytes[i % num] ^= i < num ? 0 : 0x40;
        expect_refusal(path, "power\n", "job.npz");
    }
    test_folder_count(*state, true);
}

static void faults_of_the_file_are_said_once(void **state) {
    char folder[TEST_PATH_BYTES];
    char moved[TEST_PATH_BYTES];
    char path[TEST_PATH_BYTES + 16];
    ps_checkpoint *checkpoint = NULL;
    some_state own = known;
    pspec_status status = PSPEC_ERROR_DEVICE;
    ps_error error = {0};
    int heard = 0;
    test_path(*state, "folder", folder);
    test_path(*state, "moved", moved);
    snprintf(path, sizeof path, "%s/job.npz", folder);
    assert_int_equal(open_one(&checkpoint, path, "power\n", &heard, &error), PSPEC_ERROR_IO);
    assert_int_equal(mkdir(folder, 0755), 0);
    assert_ok(open_one(&checkpoint, path, "power\n", &heard, error));
    assert_ok(ps_checkpoint_save(checkpoint, walk, &own, error));
    assert_int_equal(rename(folder, moved), 0); /* the folder is gone */
    assert_ok(ps_checkpoint_save(checkpoint, walk, &own, error));
    assert_ok(ps_checkpoint_save(checkpoint, walk, &own, error));
    assert_int_equal(heard, 1);
    assert_int_equal(rename(moved, folder), 0);
    assert_int_equal(ps_checkpoint_save(checkpoint, refuse, &status, &error), PSPEC_ERROR_DEVICE);
    assert_string_equal(error.message, "the walk failed");
    status = PSPEC_ERROR_MEMORY; /* the job goes on with less */
    assert_ok(ps_checkpoint_save(checkpoint, refuse, &status, error));
    ps_checkpoint_close(checkpoint);

    some_state found = {.apart = 9};
    assert_ok(open_one(&checkpoint, path, "power\n", &heard, error));
    assert_ok(walk(&found, ps_checkpoint_found(checkpoint), error));
    assert_true(found.apart == known.apart);
    ps_checkpoint_close(checkpoint);
    ps_checkpoint_remove(path, 0, 1);
    assert_int_equal(rmdir(folder), 0);
}

static void parts_have_names(void **state) {
    static const struct {
        const char *path;
        unsigned part;
        const char *name;
    } cases[] = {{"job.npz", 0, "job.npz"},
                 {"job.npz", 1, "job-2.npz"},
                 {"a.b/job", 2, "a.b/job-3"},
                 {".npz", 1, ".npz-2"}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_text name = {0};
        assert_ok(ps_checkpoint_path(&name, cases[i].path, cases[i].part, error));
        assert_string_equal(ps_text_string(&name), cases[i].name);
        ps_text_free(&name);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_read_was_written),
        cmocka_unit_test(other_jobs_are_refused),
        cmocka_unit_test(damage_is_seen),
        cmocka_unit_test(faults_of_the_file_are_said_once),
        cmocka_unit_test(parts_have_names),
    };
    return cmocka_run_group_tests_name("checkpoint", tests, test_folder_create, test_folder_remove);
}
