/* Spectra in files and spectra of spectra: merging parts is the whole, saving and loading changes no bit,
 * damaged and hostile files are refused in a sentence; all of it in threads, too, and with GSL's error
 * handler untouched.
 */
#include "harness_estimator.h"
#include "test_folder.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <pthread.h>
#include <zlib.h>

enum { NUM_POINTS = 30, REALIZATIONS = 9, K = 4 };

static bool has_fp64;

static pspec_power_request make_request(void) {
    pspec_power_request request = PSPEC_POWER_REQUEST_INIT;
    request.num_points = NUM_POINTS;
    request.max_frequency = K;
    request.engine = "host_direct";
    return request;
}

static pspec_spectrum *estimate(pspec_context *context, const pspec_power_request *request,
                                const pspec_pattern *patterns, size_t num) {
    pspec_plan *plan = NULL;
    pspec_spectrum *spectrum = NULL;
    if (pspec_plan_create(&plan, context, request) != PSPEC_OK ||
        pspec_plan_run(plan, patterns, num) != PSPEC_OK ||
        pspec_spectrum_create(&spectrum, plan) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    pspec_plan_destroy(plan);
    return spectrum;
}

static bool is_same(const pspec_spectrum *a, const pspec_spectrum *b, bool with_powers) {
    size_t num = 0;
    size_t num_b = 0;
    const pspec_bin *bins = pspec_spectrum_bins(a, &num);
    const pspec_bin *bins_b = pspec_spectrum_bins(b, &num_b);
    for (size_t i = 0; i < num && num == num_b; i++) {
        if (bins[i].bin != bins_b[i].bin || bins[i].count != bins_b[i].count ||
            memcmp(&bins[i].power, &bins_b[i].power, sizeof(double)) != 0 ||
            memcmp(&bins[i].standard_error, &bins_b[i].standard_error, sizeof(double)) != 0 ||
            memcmp(&bins[i].normalized_frequency, &bins_b[i].normalized_frequency,
                   sizeof(double)) != 0) {
            return false;
        }
    }
    const int32_t *vectors = pspec_spectrum_frequencies(a, &num);
    const int32_t *vectors_b = pspec_spectrum_frequencies(b, &num_b);
    const unsigned dimension = pspec_spectrum_dimension(a);
    return num == num_b && memcmp(vectors, vectors_b, num * dimension * sizeof *vectors) == 0 &&
           pspec_spectrum_num_realizations(a) == pspec_spectrum_num_realizations(b) &&
           pspec_spectrum_mean_points(a) == pspec_spectrum_mean_points(b) &&
           pspec_spectrum_error(a) == pspec_spectrum_error(b) &&
           (!with_powers || (memcmp(pspec_spectrum_powers(a), pspec_spectrum_powers(b),
                                    num * sizeof(double)) == 0 &&
                             memcmp(pspec_spectrum_standard_errors(a),
                                    pspec_spectrum_standard_errors(b), num * sizeof(double)) == 0));
}

/* ---- merge ------------------------------------------------------------------------------- */

/* Every way to cut the realizations into three parts, one of them possibly merged before. */
static void check_merges(pspec_context *context, const pspec_power_request *request,
                         const test_sample *what, bool with_powers) {
    pspec_spectrum *whole = estimate(context, request, what->patterns, what->num);
    for (size_t cut = 1; cut + 1 < what->num; cut += 2) {
        pspec_spectrum *parts[3] = {
            estimate(context, request, what->patterns, cut),
            estimate(context, request, what->patterns + cut, 1),
            estimate(context, request, what->patterns + cut + 1, what->num - cut - 1)};
        const pspec_spectrum *const three[] = {parts[0], parts[1], parts[2]};
        pspec_spectrum *merged = NULL;
        pspec_spectrum *pair = NULL;
        pspec_spectrum *twice = NULL;
        assert_int_equal(pspec_spectrum_merge(&merged, context, three, 3), PSPEC_OK);
        assert_true(is_same(whole, merged, with_powers));
        assert_int_equal(pspec_spectrum_merge(&pair, context, three + 1, 2), PSPEC_OK);
        const pspec_spectrum *const two[] = {parts[0], pair};
        assert_int_equal(pspec_spectrum_merge(&twice, context, two, 2), PSPEC_OK);
        assert_true(is_same(whole, twice, with_powers));
        for (size_t i = 0; i < 3; i++) {
            pspec_spectrum_destroy(parts[i]);
        }
        pspec_spectrum_destroy(merged);
        pspec_spectrum_destroy(pair);
        pspec_spectrum_destroy(twice);
    }
    pspec_spectrum_destroy(whole);
}

static void merged_parts_are_the_whole(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_context_set_device(context, getenv("POINTSPEC_DEVICE"));
    /* the largest pattern comes first, so that every part has the numerical error of the whole */
    for (int weighted = 0; weighted < 2; weighted++) {
        test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, weighted != 0);
        pspec_power_request request = make_request();
        check_merges(context, &request, &what, true);
        request.exact_shells = 1;
        request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
        check_merges(context, &request, &what, true);
        request = make_request();
        request.engine = "torus_direct";
        request.precision = "single";
        check_merges(context, &request, &what, false);
        if (has_fp64) {
            request.precision = "double";
            check_merges(context, &request, &what, true);
        }
        test_free_sample(&what);
    }
    pspec_context_destroy(context);
}

/* Parts whose plans expected other numbers of points have sums in other units. */
static void other_numbers_of_points(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 7, true);
    pspec_power_request request = make_request();
    pspec_spectrum *whole = estimate(context, &request, what.patterns, REALIZATIONS);
    pspec_spectrum *first = estimate(context, &request, what.patterns, 4);
    request.num_points = 77;
    pspec_spectrum *second = estimate(context, &request, what.patterns + 4, REALIZATIONS - 4);
    const pspec_spectrum *const parts[] = {first, second};
    pspec_spectrum *merged = NULL;
    size_t num = 0;
    assert_int_equal(pspec_spectrum_merge(&merged, context, parts, 2), PSPEC_OK);
    pspec_spectrum_frequencies(whole, &num);
    for (size_t i = 0; i < num; i++) {
        const double power = pspec_spectrum_powers(whole)[i];
        const double error = pspec_spectrum_standard_errors(whole)[i];
        assert_true(fabs(pspec_spectrum_powers(merged)[i] / power - 1) < 1e-15);
        assert_true(fabs(pspec_spectrum_standard_errors(merged)[i] / error - 1) < 1e-14);
    }
    assert_true(pspec_spectrum_mean_points(merged) == pspec_spectrum_mean_points(whole));
    pspec_spectrum_destroy(whole);
    pspec_spectrum_destroy(first);
    pspec_spectrum_destroy(second);
    pspec_spectrum_destroy(merged);
    test_free_sample(&what);
    pspec_context_destroy(context);
}

static void check_refused(pspec_context *context, const pspec_spectrum *a,
                          const pspec_power_request *request, const test_sample *what,
                          const char *part) {
    pspec_spectrum *b = estimate(context, request, what->patterns, 1);
    const pspec_spectrum *const both[] = {a, a, b};
    pspec_spectrum *merged = NULL;
    assert_int_equal(pspec_spectrum_merge(&merged, context, both, 3), PSPEC_ERROR_INPUT);
    assert_null(merged);
    assert_non_null(strstr(pspec_context_message(context), "spectrum 3 of those to merge"));
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, pspec_context_message(context));
    }
    pspec_spectrum_destroy(b);
}

static void what_differs_is_not_merged(void **state) {
    (void)state;
    static const int32_t list[] = {1, 2, 3, 4};
    static const int32_t other_list[] = {1, 2, 3, 5};
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(1, 2, NUM_POINTS, 0, false);
    test_sample solid = test_make_sample(1, 3, NUM_POINTS, 0, false);
    pspec_power_request request = make_request();
    pspec_spectrum *merged = NULL;
    assert_int_equal(pspec_spectrum_merge(&merged, context, NULL, 0), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_spectrum *a = estimate(context, &request, what.patterns, 1);
    request.dimension = 3;
    check_refused(context, a, &request, &solid, "dimension 3 instead of 2");
    request = make_request();
    request.max_frequency = 5;
    check_refused(context, a, &request, &what, "max frequency 5 instead of 4");
    request = make_request();
    request.rings_only = 1;
    check_refused(context, a, &request, &what, "of rings instead of the frequencies of a box");
    request = make_request();
    request.exact_shells = 1;
    check_refused(context, a, &request, &what, "shells instead of rings");
    request = make_request();
    request.normalization = PSPEC_NORMALIZATION_EFFECTIVE;
    check_refused(context, a, &request, &what, "effective instead of power");
    request = make_request();
    request.frequencies = list;
    request.num_frequencies = 2;
    check_refused(context, a, &request, &what, "a list of frequencies instead of");
    pspec_spectrum *b = estimate(context, &request, what.patterns, 1);
    request.frequencies = other_list;
    check_refused(context, b, &request, &what, "another frequency 2");
    request.num_frequencies = 1;
    check_refused(context, b, &request, &what, "1 frequencies instead of 2");
    pspec_spectrum_destroy(a);
    pspec_spectrum_destroy(b);
    test_free_sample(&what);
    test_free_sample(&solid);
    pspec_context_destroy(context);
}

/* ---- files ------------------------------------------------------------------------------- */

static void check_round_trip(pspec_context *context, const test_folder *folder,
                             const pspec_spectrum *spectrum) {
    char path[TEST_PATH_BYTES];
    pspec_spectrum *loaded = NULL;
    test_path(folder, "spectrum", path);
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    if (pspec_spectrum_load(&loaded, context, path) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    size_t num = 0;
    size_t num_loaded = 0;
    const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
    const pspec_bin *loaded_bins = pspec_spectrum_bins(loaded, &num_loaded);
    assert_true(is_same(spectrum, loaded, true));
    assert_int_equal(num, num_loaded);
    assert_memory_equal(bins, loaded_bins, num * sizeof *bins); /* anisotropy, too */
    pspec_spectrum_destroy(loaded);
}

static void saving_and_loading_changes_no_bit(void **state) {
    static const int32_t list[] = {1, 0, 0, 0, -3, 1 << 28, -(1 << 28), 2};
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        test_sample what = test_make_sample(3, dimension, NUM_POINTS, 2, true);
        pspec_power_request request = make_request();
        request.dimension = dimension;
        for (int kind = 0; kind < 4; kind++) {
            request.rings_only = kind == 1;
            request.exact_shells = kind == 2;
            request.normalization =
                kind == 2 ? PSPEC_NORMALIZATION_EFFECTIVE : PSPEC_NORMALIZATION_POWER;
            request.frequencies = kind == 3 ? list : NULL;
            request.num_frequencies = kind == 3 ? 8 / dimension : 0;
            for (size_t num = 1; num <= 3; num += 2) { /* 1: standard errors are nan */
                pspec_spectrum *spectrum = estimate(context, &request, what.patterns, num);
                check_round_trip(context, *state, spectrum);
                pspec_spectrum_destroy(spectrum);
            }
        }
        test_free_sample(&what);
    }
    pspec_context_destroy(context);
}

/* A saved spectrum of a small grid. */
static char *make_file(const test_folder *folder, size_t *num_bytes, char path[TEST_PATH_BYTES]) {
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(2, 2, NUM_POINTS, 0, false);
    pspec_power_request request = make_request();
    request.max_frequency = 2;
    request.rings_only = 1;
    pspec_spectrum *spectrum = estimate(context, &request, what.patterns, 2);
    test_path(folder, "small", path);
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    pspec_spectrum_destroy(spectrum);
    test_free_sample(&what);
    pspec_context_destroy(context);
    return test_read_file(path, num_bytes);
}

static void assert_refused(const char *path, const char *part) {
    pspec_context *context = pspec_context_create();
    pspec_spectrum *spectrum = NULL;
    const pspec_status status = pspec_spectrum_load(&spectrum, context, path);
    const char *message = pspec_context_message(context);
    assert_true(status == PSPEC_ERROR_INPUT);
    assert_null(spectrum);
    assert_null(strchr(message, '\n'));
    if (strstr(message, part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, message);
    }
    pspec_context_destroy(context);
}

static void damage_is_found(void **state) {
    char path[TEST_PATH_BYTES];
    size_t num_bytes = 0;
    char *bytes = make_file(*state, &num_bytes, path);
    for (size_t i = 0; i < num_bytes; i++) {
        static const char changes[] = {1, 0x10, (char)0x80};
        for (size_t c = 0; c < sizeof changes; c++) {
            bytes[i] ^= changes[c];
            assert_true(test_write_file(path, bytes, num_bytes));
            assert_refused(path, "cannot be used as a spectrum: ");
            bytes[i] ^= changes[c];
        }
        assert_true(test_write_file(path, bytes, i));
        assert_refused(path, "cannot be used as a spectrum: ");
    }
    assert_true(test_write_file(path, bytes, num_bytes - 1));
    assert_refused(path, "truncated");
    bytes[num_bytes] = 'x';
    assert_true(test_write_file(path, bytes, num_bytes + 1));
    assert_refused(path, "more in it than its header says");
    free(bytes);
}

/* The file with one piece of its header replaced, and a checksum that fits. */
static void check_hostile(const char *path, const char *bytes, size_t num_bytes, const char *from,
                          const char *to, const char *part) {
    enum { CHECKSUM_BYTES = 4 };
    const char *place = strstr(bytes, from);
    assert_non_null(place);
    const size_t before = (size_t)(place - bytes);
    const size_t after = num_bytes - CHECKSUM_BYTES - before - strlen(from);
    const size_t length = before + strlen(to) + after;
    unsigned char *hostile = malloc(length + CHECKSUM_BYTES);
    memcpy(hostile, bytes, before);
    memcpy(hostile + before, to, strlen(to));
    memcpy(hostile + before + strlen(to), place + strlen(from), after);
    const uLong checksum = crc32(crc32(0, NULL, 0), hostile, (uInt)length);
    for (size_t i = 0; i < CHECKSUM_BYTES; i++) {
        hostile[length + i] = (unsigned char)(checksum >> (8 * i));
    }
    assert_true(test_write_file(path, hostile, length + CHECKSUM_BYTES));
    assert_refused(path, part);
    free(hostile);
}

static void hostile_files_are_refused(void **state) {
    static const char *const changes[][3] = {
        {"spectrum 1\n", "spectrum 2\n", "another version"},
        {"spectrum 1\n", "spectrum 10\n", "another version"},
        {"pointspec spec", "pointspac spec", "not a spectrum file"},
        {"dimension: 2", "dimension: 7", "from 1 to 6"},
        {"dimension: 2", "dimension: 0", "from 1 to 6"},
        {"dimension: 2", "dimension: 3", "does not fit"},
        {"dimension: 2", "dimension: -2", "dimension is not a number"},
        {"dimension: 2", "dimension:2", "lacks the line \"dimension\""},
        {"frequencies: ball", "frequencies: bell", "unknown kind"},
        {"frequencies: ball", "frequencies: list", "truncated"},
        {"frequencies: ball", "frequencies: box", "does not fit"},
        {"max_frequency: 2", "max_frequency: 3", "does not fit"},
        {"max_frequency: 2", "max_frequency: 20000", "does not fit"},
        {"max_frequency: 2", "max_frequency: 268435456", "does not fit"},
        {"max_frequency: 2", "max_frequency: 99999999999999999999999", "not a number"},
        {"num_frequencies: ", "num_frequencies: 4294967", "truncated"},
        {"num_frequencies: ", "num_frequencies: 99999999999999999", "not a number"},
        {"num_bins: 2", "num_bins: 4294967295", "truncated"},
        {"bins: rings", "bins: rungs", "unknown kind"},
        {"bins: rings", "bins: shells", "num_bins does not fit"},
        {"normalization: power", "normalization: ", "unknown kind"},
        {"realizations: 2", "realizations: 0", "not a number"},
        {"realizations: 2", "realizations: 9007199254740993", "not a number"},
        {"smallest_points: 30", "smallest_points: 31", "largest_points is not a number"},
        {"\n\n", "\nmore: 1\n\n", "does not end where it should"},
    };
    char path[TEST_PATH_BYTES];
    size_t num_bytes = 0;
    char *bytes = make_file(*state, &num_bytes, path);
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        check_hostile(path, bytes, num_bytes, changes[i][0], changes[i][1], changes[i][2]);
    }
    free(bytes);
}

static void other_files_are_refused(void **state) {
    const test_folder *folder = *state;
    char path[TEST_PATH_BYTES];
    pspec_context *context = pspec_context_create();
    pspec_spectrum *spectrum = NULL;
    test_path(folder, "nothing", path);
    remove(path);
    assert_int_equal(pspec_spectrum_load(&spectrum, context, path), PSPEC_ERROR_IO);
    assert_non_null(strstr(pspec_context_message(context), "No such file"));
    assert_refused(folder->path, "not an ordinary file");
    assert_true(test_write_file(path, "", 0));
    assert_refused(path, "not a spectrum file");
    assert_true(test_write_file(path, "0.1 0.2\n0.3 0.4\n0.5 0.6\n0.7 0.8\n", 32));
    assert_refused(path, "not a spectrum file");
    test_sample what = test_make_sample(1, 2, NUM_POINTS, 0, false);
    const pspec_power_request request = make_request();
    spectrum = estimate(context, &request, what.patterns, 1);
    assert_int_equal(pspec_spectrum_save(spectrum, context, "/no/such/folder"), PSPEC_ERROR_IO);
    assert_int_equal(pspec_spectrum_save(spectrum, context, "-"), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_spectrum_save(spectrum, context, ""), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_spectrum_destroy(spectrum);
    test_free_sample(&what);
    pspec_context_destroy(context);
}

/* ---- threads ----------------------------------------------------------------------------- */

typedef struct thread_work {
    const test_folder *folder;
    const test_sample *what;
    int number;
    uint64_t asked, said;
    pspec_spectrum *merged;
} thread_work;

static int count_progress(uint64_t done, uint64_t total, void *payload) {
    (void)done;
    (void)total;
    ((thread_work *)payload)->asked++;
    return 0;
}

static void count_sentences(const char *sentence, void *payload) {
    (void)sentence;
    ((thread_work *)payload)->said++;
}

static void *work_in_thread(void *payload) {
    thread_work *work = payload;
    pspec_context *context = pspec_context_create();
    const pspec_power_request request = make_request();
    pspec_spectrum *parts[2] = {NULL, NULL};
    pspec_context_set_progress(context, count_progress, work);
    pspec_context_set_log(context, count_sentences, work);
    for (size_t i = 0; i < 2; i++) {
        char name[32];
        char path[TEST_PATH_BYTES];
        snprintf(name, sizeof name, "thread-%d-%zu", work->number, i);
        test_path(work->folder, name, path);
        pspec_spectrum *part =
            estimate(context, &request, work->what->patterns + 4 * i, i == 0 ? 4 : 5);
        if (pspec_spectrum_save(part, context, path) != PSPEC_OK ||
            pspec_spectrum_load(&parts[i], context, path) != PSPEC_OK) {
            parts[i] = NULL;
        }
        pspec_spectrum_destroy(part);
    }
    const pspec_spectrum *const both[] = {parts[0], parts[1]};
    if (pspec_spectrum_merge(&work->merged, context, both, 2) != PSPEC_OK) {
        work->merged = NULL;
    }
    pspec_spectrum_destroy(parts[0]);
    pspec_spectrum_destroy(parts[1]);
    pspec_context_destroy(context);
    return NULL;
}

static void contexts_in_threads(void **state) {
    enum { THREADS = 3 };
    pthread_t threads[THREADS];
    thread_work work[THREADS];
    test_sample what = test_make_sample(REALIZATIONS, 2, NUM_POINTS, 0, false);
    for (int i = 0; i < THREADS; i++) {
        work[i] = (thread_work){.folder = *state, .what = &what, .number = i};
        assert_int_equal(pthread_create(&threads[i], NULL, work_in_thread, &work[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_non_null(work[i].merged);
        assert_true(is_same(work[0].merged, work[i].merged, true));
        assert_true(work[i].asked >= REALIZATIONS && work[i].said >= 6);
    }
    for (int i = 0; i < THREADS; i++) {
        pspec_spectrum_destroy(work[i].merged);
    }
    test_free_sample(&what);
}

/* ---- GSL --------------------------------------------------------------------------------- */

static int num_gsl_errors; /* the handler has no payload */

static void count_gsl_errors(const char *reason, const char *file, int line, int number) {
    (void)reason;
    (void)file;
    (void)line;
    (void)number;
    num_gsl_errors++;
}

/* The handler of the program is still there after everything that the library does, right or wrong. */
static void gsl_is_left_alone(void **state) {
    gsl_error_handler_t *before = gsl_set_error_handler(count_gsl_errors);
    merged_parts_are_the_whole(state);
    what_differs_is_not_merged(state);
    saving_and_loading_changes_no_bit(state);
    other_files_are_refused(state);
    assert_true(gsl_set_error_handler(before) == count_gsl_errors);
    assert_int_equal(num_gsl_errors, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merged_parts_are_the_whole),
        cmocka_unit_test(other_numbers_of_points),
        cmocka_unit_test(what_differs_is_not_merged),
        cmocka_unit_test(saving_and_loading_changes_no_bit),
        cmocka_unit_test(damage_is_found),
        cmocka_unit_test(hostile_files_are_refused),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(contexts_in_threads),
        cmocka_unit_test(gsl_is_left_alone),
    };
    ps_device *device = test_open_device(); /* ends as skipped when there is none */
    has_fp64 = ps_device_get_limits(device)->has_fp64;
    ps_device_close(device);
    return cmocka_run_group_tests_name("spectrum_file", tests, test_folder_create,
                                       test_folder_remove);
}
