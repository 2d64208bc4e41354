/* An interruption while sets are made says in which set, and what is kept already. */
#include "sets/sets.h"

#include "test_folder.h"
#include "test_samplers.h"

enum { NUM = 128, NUM_SETS = 4 };

/* A sampler of the test's own, which takes a second, as it says, and many passes. */
enum { PASS = 28, SET = 3 };

static pspec_status make_in_passes(const ps_sampler_request *request, uint64_t realization,
                                   double *points, ps_error *error) {
    for (uint64_t pass = 0; pass <= PASS; pass++) {
        PS_TRY(ps_watch_tell(request->watch, "sampler: slow, passes", pass, 0, NULL, error));
    }
    for (size_t i = 0; i < request->num_points * request->dimension; i++) {
        points[i] = (double)realization / SET;
    }
    return PSPEC_OK;
}

static double a_second(const ps_sampler_request *request) {
    (void)request;
    return 1;
}

static int stop_in_set(const ps_watch_report *report, void *payload) {
    int *const number = payload;
    *number += report->done == 0;
    return *number == SET && report->done == PASS;
}

static void an_interruption_says_where_it_was(void **state) {
    const test_folder *const folder = *state;
    ps_sampler_request request = make_request("white", NUM, 2);
    ps_sampler slow = *request.sampler;
    slow.version = 1;
    slow.seconds = a_second;
    slow.generate = make_in_passes;
    request.sampler = &slow;
    /* room for one, so that nothing is made ahead */
    const ps_sets_options options = {
        {folder->path, 1 << 30}, 16 * 2 * NUM * sizeof(double), 0, NULL, 0};
    int number = 0;
    const ps_watch watch = {stop_in_set, &number};
    double points[2 * NUM];
    size_t num = 0;
    ps_sets *sets = NULL;
    ps_error error = {0};
    assert_int_equal(ps_sets_create(&sets, &request, NUM_SETS, &options, NULL), PSPEC_OK);
    for (int i = 1; i < SET; i++) {
        assert_int_equal(ps_sets_next(sets, points, &num, &watch, NULL), PSPEC_OK);
    }
    assert_int_equal(ps_sets_next(sets, points, &num, &watch, &error), PSPEC_ERROR_CANCELLED);
    assert_string_equal(error.message, "interrupted after 28 passes of set 3 of 4; 2 sets are "
                                       "kept, the same command goes on");
    ps_sets_destroy(sets);
}

static int remove_folders(void **state) {
    const test_folder *const folder = *state;
    test_folder sets;
    assert_true(snprintf(sets.path, sizeof sets.path, "%s/sets", folder->path) <
                (int)sizeof sets.path);
    test_folder_count(&sets, true);
    rmdir(sets.path);
    return test_folder_remove(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(an_interruption_says_where_it_was, test_folder_create,
                                        remove_folders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
