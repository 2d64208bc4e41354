/* Parts of a job are its realizations, each once, in whole blocks; how many there are is found
 * again by the names of checkpoints, and by no others. */
#include "harness.h"
#include "test_folder.h"

#include "answers/parts/parts.h"
#include "spectra/sum_nodes.h"

static void parts_are_the_job(void **state) {
    static const uint64_t jobs[] = {1, 127, 128, 129, 256, 1000, 1280, 4097, 1000000007};
    (void)state;
    for (size_t i = 0; i < sizeof jobs / sizeof jobs[0]; i++) {
        const uint64_t most = ps_parts_most(jobs[i]);
        for (uint64_t num = 1; num <= most && num < 40; num++) {
            uint64_t at = 0;
            uint64_t least = UINT64_MAX;
            uint64_t largest = 0;
            for (uint64_t part = 0; part < num; part++) {
                const ps_realization_range range = ps_parts_range(jobs[i], num, part);
                const uint64_t blocks = ps_parts_most(range.end - range.first);
                assert_true(range.first == at && range.end > at);
                assert_int_equal(range.first % PS_SUM_BLOCK, 0);
                least = blocks < least ? blocks : least;
                largest = blocks > largest ? blocks : largest;
                at = range.end;
            }
            assert_true(at == jobs[i] && largest - least <= 1);
        }
    }
    assert_int_equal(ps_parts_deal(2, 3, 2).num, 0);
}

static void make_file(const test_folder *folder, const char *name) {
    char path[TEST_PATH_BYTES];
    FILE *const file = fopen(test_path(folder, name, path), "w");
    assert_non_null(file);
    fclose(file);
}

static pspec_status find(const test_folder *folder, const char *name, uint64_t *num) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    return ps_parts_find(num, test_path(folder, name, path), &error);
}

static void names_say_how_many(void **state) {
    static const char *const others[] = {"job-part-1-of-0.npz",
                                         "job-part-0-of-4.npz",
                                         "job-part-5-of-4.npz",
                                         "job-part-1-of-4",
                                         "job-part-1-of-4.npy",
                                         "job-part-01-of-4.npz",
                                         "job-part--1-of-4.npz",
                                         "job-part-1-of-4.npz.x",
                                         "jobs-part-1-of-4.npz",
                                         "a-job-part-1-of-4.npz",
                                         "job-part-1-of-4-a.npz",
                                         "job-part-1-of-99999999999999999999.npz",
                                         "job-2.npz",
                                         "job-part-1-of-4x.npz",
                                         "job.npz-part-1-of-4",
                                         "job-part-1-of-.npz",
                                         "job-part-1-of-4.npz-part"};
    static const char *const parts[] = {"job-part-4-of-4.npz", "job-part-1-of-4.npz.lock",
                                        "job-part-2-of-4-17.npz", "job-part-3-of-4-2.npz.lock"};
    const test_folder *const folder = *state;
    char path[TEST_PATH_BYTES];
    uint64_t num = 9;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        make_file(folder, others[i]);
        assert_int_equal(find(folder, "job.npz", &num), PSPEC_OK);
        assert_int_equal(num, 0);
    }
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        make_file(folder, parts[i]);
        assert_int_equal(find(folder, "job.npz", &num), PSPEC_OK);
        assert_int_equal(num, 4);
        assert_int_equal(remove(test_path(folder, parts[i], path)), 0);
    }
    make_file(folder, "job.npz");
    assert_int_equal(find(folder, "job.npz", &num), PSPEC_OK);
    assert_int_equal(num, 1);
    make_file(folder, "job-part-2-of-3.npz");
    assert_int_equal(find(folder, "job.npz", &num), PSPEC_ERROR_INPUT);
    assert_int_equal(remove(test_path(folder, "job.npz", path)), 0);
    make_file(folder, "job-part-2-of-4.npz");
    assert_int_equal(find(folder, "job.npz", &num), PSPEC_ERROR_INPUT);
    assert_int_equal(find(folder, "nowhere/job.npz", &num), PSPEC_OK);
    assert_int_equal(num, 0);
    make_file(folder, "plain-part-3-of-7");
    assert_int_equal(find(folder, "plain", &num), PSPEC_OK);
    assert_int_equal(num, 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_are_the_job),
        cmocka_unit_test_setup_teardown(names_say_how_many, test_folder_create, test_folder_remove),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
