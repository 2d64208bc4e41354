/* Realizations from the store and made ahead are those of the sampler, bit for bit; what is damaged
 * is made anew; a set is found by all that its bits depend on. */
#include "sets/sets.h"

#include "test_folder.h"
#include "test_samplers.h"

enum { NUM = 128, NUM_SETS = 4, ROOM = 1 << 14 };

typedef struct set {
    size_t num_points;
    double points[ROOM];
} set;

static ps_sampler_request ask(const char *text, unsigned dimension) {
    ps_error error = {0};
    ps_sampler_request request = parse_request(text, NUM, dimension);
    if (ps_sampler_resolve(&request, &error) != PSPEC_OK) {
        fail_msg("%s: %s", text, error.message);
    }
    assert_true(ps_sampler_most_points(&request) * request.dimension <= ROOM);
    return request;
}

static ps_sets *open_sets(void **state, const ps_sampler_request *request) {
    const test_folder *const folder = *state;
    const ps_sets_options options = {{folder->path, 1 << 30}, 0, 0, NULL, 0};
    ps_sets *sets = NULL;
    assert_int_equal(ps_sets_create(&sets, request, NUM_SETS, &options, NULL), PSPEC_OK);
    return sets;
}

/* All realizations, each compared with the sampler's. */
static void take_all(ps_sets *sets, const ps_sampler_request *request) {
    static set expected;
    static set found;
    for (uint64_t r = 0; r < NUM_SETS; r++) {
        ps_error error = {0};
        assert_int_equal(
            ps_sampler_generate(request, r, expected.points, &expected.num_points, NULL, NULL),
            PSPEC_OK);
        if (ps_sets_next(sets, found.points, &found.num_points, NULL, &error) != PSPEC_OK) {
            fail_msg("%s, realization %d: %s", request->sampler->name, (int)r, error.message);
        }
        assert_int_equal(found.num_points, expected.num_points);
        assert_memory_equal(found.points, expected.points,
                            expected.num_points * request->dimension * sizeof(double));
    }
}

/* Opens, takes all, says what the store did. */
static ps_set_counts take(void **state, const ps_sampler_request *request) {
    ps_sets *const sets = open_sets(state, request);
    take_all(sets, request);
    const ps_set_counts counts = ps_sets_counts(sets);
    if (counts.num_damaged == 0) {
        assert_string_equal(ps_sets_trouble(sets), "");
    }
    ps_sets_destroy(sets);
    return counts;
}

static const char *sets_folder(void **state) {
    static char path[TEST_PATH_BYTES];
    return test_path(*state, "sets", path);
}

static int remove_folders(void **state) {
    test_folder sets;
    const char *const path = sets_folder(state);
    assert_true(strlen(path) < sizeof sets.path);
    strcpy(sets.path, path);
    test_folder_count(&sets, true);
    rmdir(sets.path);
    return test_folder_remove(state);
}

/* ---- bits ---------------------------------------------------------------------------------- */

/* Expensive enough to be kept at N = 128, but for two. */
static const struct {
    const char *text;
    unsigned dimension;
    bool is_kept;
} samplers[] = {
    {"bnot:eps=0.5", 2, true},     {"bnot:eps=0.5,lift=hemisphere,morph=glossy,n=5", 3, true},
    {"fpo:distance=0.9", 2, true}, {"ccvt-sphere", 3, true},
    {"poisson-disk", 3, true},     {"poisson-disk:exact=yes", 3, true},
    {"bridson:tries=60", 4, true}, {"white", 2, false},
    {"spiral", 3, false},
};
enum { NUM_SAMPLERS = sizeof samplers / sizeof samplers[0] };

static void kept_sets_are_those_of_the_sampler(void **state) {
    for (unsigned i = 0; i < NUM_SAMPLERS; i++) {
        const ps_sampler_request request = ask(samplers[i].text, samplers[i].dimension);
        const uint64_t num = samplers[i].is_kept ? NUM_SETS : 0;
        if (ps_sets_are_expensive(&request) != samplers[i].is_kept) {
            fail_msg("%s takes %g s", samplers[i].text, ps_sampler_seconds(&request));
        }
        const ps_set_counts first = take(state, &request);
        const ps_set_counts again = take(state, &request);
        /* bnot is kept once for both places */
        assert_true(first.num_kept == num || i == 1);
        assert_int_equal(first.num_read + first.num_kept, num);
        assert_int_equal(again.num_read, num);
        assert_int_equal(again.num_kept, 0);
    }
}

/* Sets are kept before they are lifted, shifted or morphed. */
static void one_set_serves_all_places(void **state) {
    ps_sampler_request request = ask("bnot:eps=0.5", 2);
    assert_int_equal(take(state, &request).num_kept, NUM_SETS);
    request.homogenize = true;
    assert_int_equal(take(state, &request).num_read, NUM_SETS);
    const ps_sampler_request lifted = ask("bnot:eps=0.5,lift=sphere", 3);
    assert_int_equal(take(state, &lifted).num_read, NUM_SETS);
}

static void nothing_is_kept_without_a_place(void **state) {
    const test_folder *const folder = *state;
    const ps_sampler_request request = ask("bnot", 2);
    const ps_sets_options none[] = {{{NULL, 1 << 30}, 0, 0, NULL, 0},
                                    {{folder->path, 0}, 0, 0, NULL, 0},
                                    {{folder->path, 2048}, 0, 0, NULL, 0}};
    for (unsigned i = 0; i < sizeof none / sizeof none[0]; i++) {
        ps_sets *sets = NULL;
        assert_int_equal(ps_sets_create(&sets, &request, NUM_SETS, &none[i], NULL), PSPEC_OK);
        take_all(sets, &request);
        assert_int_equal(ps_sets_counts(sets).num_kept, 0);
        assert_string_equal(ps_sets_trouble(sets), "");
        ps_sets_destroy(sets);
    }
    assert_int_equal(test_folder_count(folder, false), 0);
}

static void rewound_sets_come_again(void **state) {
    const ps_sampler_request request = ask("fpo:distance=0.9", 2);
    ps_sets *const sets = open_sets(state, &request);
    static set first;
    assert_int_equal(ps_sets_next(sets, first.points, &first.num_points, NULL, NULL), PSPEC_OK);
    ps_sets_rewind(sets);
    take_all(sets, &request);
    ps_sets_rewind(sets);
    take_all(sets, &request);
    ps_sets_destroy(sets);
}

/* Realizations from `first` on are those of a source from 0, made, kept, taken from the store and
 * after a rewind; of a place that keeps none, too. */
static void sets_may_begin_later(void **state) {
    const test_folder *const folder = *state;
    static const char *const texts[] = {"bnot", "white"};
    enum { FIRST = 3, MORE = 5 };
    static set expected, found;
    for (unsigned i = 0; i < 6; i++) {
        const ps_sampler_request request = ask(texts[i % 2], 2);
        const ps_sets_options options = {{i < 4 ? folder->path : NULL, 1 << 30}, 0, FIRST, NULL, 0};
        ps_sets *sets = NULL;
        assert_int_equal(ps_sets_create(&sets, &request, MORE, &options, NULL), PSPEC_OK);
        for (uint64_t r = 0; r < 2 * MORE; r++) {
            if (r == MORE) {
                ps_sets_rewind(sets);
            }
            assert_int_equal(ps_sampler_generate(&request, FIRST + r % MORE, expected.points,
                                                 &expected.num_points, NULL, NULL),
                             PSPEC_OK);
            assert_int_equal(ps_sets_next(sets, found.points, &found.num_points, NULL, NULL),
                             PSPEC_OK);
            assert_memory_equal(found.points, expected.points,
                                found.num_points * request.dimension * sizeof(double));
        }
        if (i == 2) { /* what the first round kept */
            assert_int_equal(ps_sets_counts(sets).num_kept, 0);
            assert_true(ps_sets_counts(sets).num_read >= MORE);
        }
        ps_sets_destroy(sets);
    }
    const ps_sampler_request request = ask("bnot", 2);
    assert_int_equal(take(state, &request).num_read, NUM_SETS - FIRST);
}

/* Cheap sets are made ahead in blocks, which nobody sees: whether they end with the sets or not, of
 * whatever memory, begun anew within one, and after a question that ends what is made ahead. */
static void blocks_change_no_bit(void **state) {
    (void)state;
    enum { MANY = 3500, MIDDLE = 1234, LATER = 2345, FIRST = 5 };
    static const uint64_t limits[] = {0, 1 << 20, 1 << 22};
    static set expected, found;
    const ps_sampler_request request = ask("white", 2);
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        const ps_sets_options options = {{NULL, 0}, limits[i], FIRST, NULL, 0};
        ps_sets *sets = NULL;
        assert_int_equal(ps_sets_create(&sets, &request, MANY, &options, NULL), PSPEC_OK);
        for (uint64_t r = 0; r < MIDDLE; r++) {
            assert_int_equal(ps_sets_next(sets, found.points, &found.num_points, NULL, NULL),
                             PSPEC_OK);
        }
        ps_sets_rewind(sets);
        for (uint64_t r = 0; r < MANY; r++) {
            if (r == LATER) {
                assert_string_equal(ps_sets_trouble(sets), "");
            }
            assert_int_equal(ps_sets_next(sets, found.points, &found.num_points, NULL, NULL),
                             PSPEC_OK);
            assert_int_equal(ps_sampler_generate(&request, FIRST + r, expected.points,
                                                 &expected.num_points, NULL, NULL),
                             PSPEC_OK);
            assert_int_equal(found.num_points, expected.num_points);
            assert_memory_equal(found.points, expected.points,
                                found.num_points * request.dimension * sizeof(double));
        }
        ps_sets_destroy(sets);
    }
}

/* Memory that was limited holds fewer sets, or none, and the points are the same. */
static void a_limit_of_memory_changes_no_bit(void **state) {
    (void)state;
    const ps_sampler_request request = ask("bnot", 2);
    const uint64_t least = (uint64_t)ps_sampler_work_bytes(&request) + 1;
    for (uint64_t limit = least; limit < (uint64_t)1 << 24; limit *= 4) {
        ps_sets *sets = NULL;
        const ps_sets_options options = {{NULL, 0}, limit, 0, NULL, 0};
        assert_int_equal(ps_sets_create(&sets, &request, NUM_SETS, &options, NULL), PSPEC_OK);
        take_all(sets, &request);
        ps_sets_destroy(sets);
    }
}

/* ---- what a set is found by ---------------------------------------------------------------- */

static void every_part_of_the_request_counts(void **state) {
    ps_sampler_request request = ask("poisson-disk", 3);
    assert_int_equal(take(state, &request).num_kept, NUM_SETS);
    request.seed = 2;
    assert_int_equal(take(state, &request).num_kept, NUM_SETS);
    request.seed = 1;
    request.num_points = NUM + 1;
    assert_int_equal(take(state, &request).num_kept, NUM_SETS);
    const ps_sampler_request exact = ask("poisson-disk:exact=yes", 3);
    assert_int_equal(take(state, &exact).num_kept, NUM_SETS);
    const ps_sampler_request wide = ask("poisson-disk:radius=0.179", 3);
    assert_int_equal(take(state, &wide).num_kept, NUM_SETS);
    /* another version of the algorithm, of whose sets the last one knows nothing */
    ps_sampler next = *exact.sampler;
    next.version++;
    ps_sampler_request newer = exact;
    newer.sampler = &next;
    assert_int_equal(take(state, &newer).num_kept, NUM_SETS);
    assert_int_equal(take(state, &exact).num_read, NUM_SETS);
}

/* ---- damage -------------------------------------------------------------------------------- */

static void damage(const char *path) {
    size_t num_bytes = 0;
    char *const bytes = test_read_file(path, &num_bytes);
    assert_non_null(bytes);
    bytes[num_bytes - 5] ^= 1;
    assert_true(test_write_file(path, bytes, num_bytes));
    free(bytes);
}

static unsigned damage_all(void **state) {
    char path[2 * TEST_PATH_BYTES];
    unsigned count = 0;
    DIR *const entries = opendir(sets_folder(state));
    assert_non_null(entries);
    for (const struct dirent *entry = readdir(entries); entry != NULL; entry = readdir(entries)) {
        if (strstr(entry->d_name, ".result") != NULL) {
            snprintf(path, sizeof path, "%s/%s", sets_folder(state), entry->d_name);
            damage(path);
            count++;
        }
    }
    closedir(entries);
    return count;
}

static void damaged_sets_are_made_anew(void **state) {
    const ps_sampler_request request = ask("bnot", 2);
    take(state, &request);
    assert_int_equal(damage_all(state), NUM_SETS);
    ps_sets *const sets = open_sets(state, &request);
    take_all(sets, &request);
    assert_string_equal(ps_sets_trouble(sets), "kept sets of bnot: 4 were damaged, made anew");
    assert_int_equal(ps_sets_counts(sets).num_kept, NUM_SETS);
    ps_sets_destroy(sets);
    assert_int_equal(take(state, &request).num_read, NUM_SETS);
}

/* A folder that cannot be is told once, and sets are made all the same. */
static void without_a_folder_sets_are_made(void **state) {
    const ps_sampler_request request = ask("bnot", 2);
    assert_true(test_write_file(sets_folder(state), "x", 1));
    ps_sets *const sets = open_sets(state, &request);
    take_all(sets, &request);
    const char *const trouble = ps_sets_trouble(sets);
    assert_non_null(strstr(trouble, "kept sets of bnot: "));
    assert_non_null(strstr(trouble, sets_folder(state)));
    ps_sets_destroy(sets);
}

static void names_are_counted(void **state) {
    const test_folder *const folder = *state;
    const ps_set_place place = {folder->path, 1 << 30};
    const ps_sampler_request request = ask("bnot", 2);
    assert_int_equal(ps_sets_count_kept(&request, &place, 1000), 0);
    assert_int_equal(test_folder_count(folder, false), 0);
    take(state, &request);
    assert_int_equal(ps_sets_count_kept(&request, &place, 1000), NUM_SETS);
    assert_int_equal(ps_sets_count_kept(&request, &place, 2), 2);
    assert_int_equal(ps_sets_count_kept(&request, &(ps_set_place){folder->path, 0}, 2), 0);
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, test_folder_create, remove_folders)

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_change_no_bit),
        IN_A_FOLDER(kept_sets_are_those_of_the_sampler),
        IN_A_FOLDER(one_set_serves_all_places),
        IN_A_FOLDER(nothing_is_kept_without_a_place),
        IN_A_FOLDER(rewound_sets_come_again),
        IN_A_FOLDER(sets_may_begin_later),
        IN_A_FOLDER(a_limit_of_memory_changes_no_bit),
        IN_A_FOLDER(every_part_of_the_request_counts),
        IN_A_FOLDER(damaged_sets_are_made_anew),
        IN_A_FOLDER(without_a_folder_sets_are_made),
        IN_A_FOLDER(names_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
