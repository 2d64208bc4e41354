/* The reader of sets that a caller gives: large ones come in blocks, and nonsense is an error that
 * says which set it is. */
#include "harness_given.h"

#include "jobs/source.h"

#include <math.h>
#include <string.h>

enum { NUM_POINTS = 36 };

static const test_folder *folder;

/* ---- sets in blocks -------------------------------------------------------------------------- */

static size_t append(double *out, const ps_point_set *set) {
    const size_t num = set->num_points * set->dimension;
    memcpy(out, set->points, num * sizeof *out);
    if (set->has_weights) {
        memcpy(out + num, set->weights, set->num_points * sizeof *out);
    }
    return num + (set->has_weights ? set->num_points : 0);
}

/* All blocks, in the order in which they come, and the sum of weights that was counted before. */
static size_t read_blocks(const char *path, const ps_source_options *options, double *out) {
    const char *const paths[] = {path};
    ps_source *source = NULL;
    ps_point_set set = {0};
    ps_source_part part;
    bool has_set = true;
    size_t num = 0;
    assert_ok(ps_source_files(&source, paths, 1, options, error));
    while (has_set) {
        assert_ok(ps_source_next(source, &set, &part, &has_set, error));
        num += append(out + num, &set);
        for (bool ends = part.is_whole || !has_set; !ends;) {
            set.num_points = 0;
            assert_ok(ps_source_more(source, &set, part.block_points, &ends, error));
            num += append(out + num, &set);
        }
        out[num++] = (double)part.count.sum;
    }
    ps_point_set_free(&set);
    ps_source_destroy(source);
    return num;
}

/* Sets that are too large come in blocks, and those with weights are counted by a second reader,
 * which takes the view from the first. */
static void large_sets_come_in_blocks(void **state) {
    enum { SETS = 3, LARGE = 5000, MOST = SETS * LARGE * 3 + SETS + 1 };
    static double expected[MOST], found[MOST];
    folder = *state;
    for (int has_weights = 0; has_weights < 2; has_weights++) {
        ps_source_options options = {
            .whole_bytes = 1 << 15,
            .points = {.domain = PS_DOMAIN_TORUS, .weight_column = has_weights != 0}};
        test_given sets;
        test_given_make(&sets, folder, "large.npy", 2, has_weights != 0, SETS, LARGE, 0);
        test_given_save(&sets, "npy");
        const size_t num = read_blocks(sets.name, &options, expected);
        ps_given_set one = test_given_set(&sets);
        options.points.given = (ps_given_sets){&one, 1};
        assert_int_equal(read_blocks(sets.name, &options, found), num);
        assert_memory_equal(found, expected, num * sizeof *found);
        assert_true(has_weights ? sets.num_calls > SETS + 1 : sets.num_calls == SETS + 1);
        test_given_free(&sets);
    }
}

/* ---- nonsense -------------------------------------------------------------------------------- */

static void refuses(test_given *sets, const ps_point_options *options, uint64_t most,
                    pspec_status status, const char *sentence) {
    ps_given_set one = test_given_set(sets);
    ps_point_options own = *options;
    test_points found;
    ps_error error = {0};
    one.most = most;
    own.given = (ps_given_sets){&one, 1};
    assert_int_equal(test_points_read(&found, sets->name, &own, &error), status);
    if (status != PSPEC_OK && strstr(error.message, sentence) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", sentence, error.message);
    }
    if (status == PSPEC_OK) {
        assert_int_equal(found.num_sets, most);
        assert_string_equal(found.format, "memory");
    }
    test_points_free(&found);
}

static void nonsense_is_refused(void **state) {
    const ps_point_options any = {.domain = PS_DOMAIN_ANY};
    const ps_point_options columns = {.domain = PS_DOMAIN_TORUS, .weight_column = true};
    const ps_point_options on_sphere = {.domain = PS_DOMAIN_SPHERE};
    test_given sets;
    folder = *state;
    test_given_make(&sets, folder, "mine", 4, false, 4, NUM_POINTS, 0);
    refuses(&sets, &any, 3, PSPEC_OK, "");
    refuses(&sets, &columns, 0, PSPEC_ERROR_INPUT,
            "mine: --weights column, and set 1 has no weigh");
    refuses(&sets, &on_sphere, 0, PSPEC_ERROR_INPUT, "mine: set 1 has dimension 4, not 1 to 3");
    sets.other = 2;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT,
            "mine: set 2 has dimension 3, and the first one has 4");
    sets.failing = 2;
    refuses(&sets, &any, 0, PSPEC_ERROR_CANCELLED, "the caller has gone home");
    sets.failing = sets.other = 0;
    sets.points[1][9] = NAN;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine, set 2, row 3: coordinate nan is not");
    sets.points[1][9] = 1;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine, set 2, row 3: coordinate 1 is outside [0,1)");
    sets.num_points[1] = 0;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine: set 2 has no points");
    sets.num_points[0] = 0;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine: set 1 has no points");
    test_given_free(&sets);
    test_given_make(&sets, folder, "mine", 3, true, 2, NUM_POINTS, 0);
    sets.weights[1][4] = INFINITY;
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine, set 2, row 5: weight inf is not a finite");
    test_given_free(&sets);
    test_given_make(&sets, folder, "mine", 2, false, 0, NUM_POINTS, 0);
    refuses(&sets, &any, 0, PSPEC_ERROR_INPUT, "mine holds no points");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(large_sets_come_in_blocks, test_folder_create,
                                        test_folder_remove),
        cmocka_unit_test_setup_teardown(nonsense_is_refused, test_folder_create,
                                        test_folder_remove),
    };
    return cmocka_run_group_tests_name("given_points", tests, NULL, NULL);
}
