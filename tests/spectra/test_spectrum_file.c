/* Spectra in files: saving and loading changes no bit, damaged and hostile files are refused in a
 * sentence; in threads, too.
 */
#include "harness_public.h"
#include "test_folder.h"

#include <math.h>
#include <pthread.h>
#include <zlib.h>

enum { REALIZATIONS = 9 };

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
    assert_true(test_is_same_spectrum(spectrum, loaded, true));
    assert_int_equal(num, num_loaded);
    assert_memory_equal(bins, loaded_bins, num * sizeof *bins); /* anisotropy, too */
    pspec_spectrum_destroy(loaded);
}

static void saving_and_loading_changes_no_bit(void **state) {
    static const int32_t list[] = {1, 0, 0, 0, -3, 1 << 28, -(1 << 28), 2};
    static const char *const bins[] = {NULL, NULL, "shells", NULL, "floor", "relative=1/64"};
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 1; dimension <= 3; dimension++) {
        test_sample what = test_make_sample(3, dimension, TEST_NUM_POINTS, 2, true);
        pspec_power_request request = test_host_request();
        request.dimension = dimension;
        for (int kind = 0; kind < 6; kind++) {
            request.rings_only = kind == 1;
            const size_t most = kind == 5 ? 1 : 3; /* relative widths are of one number of points */
            request.num_points = what.patterns[0].num_points;
            request.bins = bins[kind];
            request.normalization = kind == 2   ? PSPEC_NORMALIZATION_EFFECTIVE
                                    : kind == 0 ? PSPEC_NORMALIZATION_INTEGRAL
                                                : PSPEC_NORMALIZATION_POWER;
            request.frequencies = kind == 3 ? list : NULL;
            request.num_frequencies = kind == 3 ? 8 / dimension : 0;
            for (size_t num = 1; num <= most; num += 2) { /* 1: standard errors are nan */
                pspec_spectrum *spectrum =
                    test_public_spectrum(context, &request, what.patterns, num);
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
    test_sample what = test_make_sample(2, 2, TEST_NUM_POINTS, 0, false);
    pspec_power_request request = test_host_request();
    request.max_frequency = 2;
    request.rings_only = 1;
    pspec_spectrum *spectrum = test_public_spectrum(context, &request, what.patterns, 2);
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

enum { CHECKSUM_BYTES = 4 };

/* bytes[length + CHECKSUM_BYTES], at whose end the checksum comes */
static void write_with_checksum(const char *path, unsigned char *bytes, size_t length) {
    const uLong checksum = crc32(crc32(0, NULL, 0), bytes, (uInt)length);
    for (size_t i = 0; i < CHECKSUM_BYTES; i++) {
        bytes[length + i] = (unsigned char)(checksum >> (8 * i));
    }
    assert_true(test_write_file(path, bytes, length + CHECKSUM_BYTES));
}

/* The file with one piece of its header replaced, and a checksum that fits. */
static void check_hostile(const char *path, const char *bytes, size_t num_bytes, const char *from,
                          const char *to, const char *part) {
    const char *place = strstr(bytes, from);
    assert_non_null(place);
    const size_t before = (size_t)(place - bytes);
    const size_t after = num_bytes - CHECKSUM_BYTES - before - strlen(from);
    const size_t length = before + strlen(to) + after;
    unsigned char *hostile = malloc(length + CHECKSUM_BYTES);
    memcpy(hostile, bytes, before);
    memcpy(hostile + before, to, strlen(to));
    memcpy(hostile + before + strlen(to), place + strlen(from), after);
    write_with_checksum(path, hostile, length);
    assert_refused(path, part);
    free(hostile);
}

static void hostile_files_are_refused(void **state) {
    static const char *const changes[][3] = {
        {"spectrum 3\n", "spectrum 1\n", "another version"},
        {"spectrum 3\n", "spectrum 2\n", "more in it"},
        {"spectrum 3\n", "spectrum 30\n", "another version"},
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
    test_sample what = test_make_sample(1, 2, TEST_NUM_POINTS, 0, false);
    const pspec_power_request request = test_host_request();
    spectrum = test_public_spectrum(context, &request, what.patterns, 1);
    assert_int_equal(pspec_spectrum_save(spectrum, context, "/no/such/folder"), PSPEC_ERROR_IO);
    assert_int_equal(pspec_spectrum_save(spectrum, context, "-"), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_int_equal(pspec_spectrum_save(spectrum, context, ""), PSPEC_ERROR_INVALID_ARGUMENT);
    pspec_spectrum_destroy(spectrum);
    test_free_sample(&what);
    pspec_context_destroy(context);
}

/* ---- version 2 of the format ------------------------------------------------------------- */

/* A file as version 2 had it, of a spectrum for integrals, which it called power: no name of that
 * normalization, and the sum of N among the totals instead of its sums. */
static void write_version_2(const char *path, const char *bytes, size_t num_bytes) {
    static const char from[] = "normalization: integral";
    static const char to[] = "normalization: power";
    enum { REAL = sizeof(double), OLD_TOTALS = 4 };
    const char *const word = strstr(bytes, from);
    assert_non_null(word);
    const char *const end = strstr(bytes, "\n\n") + 2;
    const size_t head = (size_t)(end - bytes) - (sizeof from - sizeof to);
    const size_t rest = num_bytes - CHECKSUM_BYTES - (size_t)(end - bytes) - 7 * REAL;
    unsigned char *const old = malloc(num_bytes);
    memcpy(old, bytes, (size_t)(word - bytes));
    memcpy(old + (word - bytes), to, sizeof to - 1);
    memcpy(old + (word - bytes) + sizeof to - 1, word + sizeof from - 1,
           (size_t)(end - word) - (sizeof from - 1));
    *(char *)memchr(old, '3', head) = '2';               /* of the magic line */
    memcpy(old + head, end, REAL);                       /* N_ref */
    memcpy(old + head + REAL, end + 3 * REAL, REAL);     /* sum of N */
    memcpy(old + head + 2 * REAL, end + REAL, 2 * REAL); /* sum of W, error */
    memcpy(old + head + OLD_TOTALS * REAL, end + 7 * REAL, rest);
    write_with_checksum(path, old, head + OLD_TOTALS * REAL + rest);
    free(old);
}

/* The spectrum for integrals of patterns, saved as version 2 had it, and read. */
static pspec_spectrum *through_version_2(pspec_context *context, const char *path,
                                         const test_sample *what) {
    pspec_power_request request = test_host_request();
    pspec_spectrum *loaded = NULL;
    size_t num_bytes = 0;
    request.normalization = PSPEC_NORMALIZATION_INTEGRAL;
    request.num_points = 77;
    pspec_spectrum *spectrum = test_public_spectrum(context, &request, what->patterns, what->num);
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    pspec_spectrum_destroy(spectrum);
    char *const bytes = test_read_file(path, &num_bytes);
    write_version_2(path, bytes, num_bytes);
    free(bytes);
    if (pspec_spectrum_load(&loaded, context, path) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return loaded;
}

/* What version 2 called power is that of today where all N are one, else that for integrals: the
 * same numbers, and it goes only with its like. */
static void check_version_2(const char *path, size_t increment) {
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(3, 2, TEST_NUM_POINTS, increment, true);
    pspec_power_request request = test_host_request();
    pspec_spectrum *const old = through_version_2(context, path, &what);
    size_t num = 0;
    for (int is_integral = 0; is_integral < 2; is_integral++) {
        const bool is_same = increment == 0 ? !is_integral : is_integral;
        request.normalization =
            is_integral ? PSPEC_NORMALIZATION_INTEGRAL : PSPEC_NORMALIZATION_POWER;
        pspec_spectrum *now = test_public_spectrum(context, &request, what.patterns, what.num);
        const pspec_spectrum *const both[] = {old, now};
        pspec_spectrum *merged = NULL;
        assert_int_equal(pspec_spectrum_merge(&merged, context, both, 2),
                         is_same ? PSPEC_OK : PSPEC_ERROR_INPUT);
        assert_true(pspec_spectrum_mean_points(old) == pspec_spectrum_mean_points(now));
        pspec_spectrum_frequencies(now, &num);
        for (size_t i = 0; i < num && is_same; i++) {
            const double power = pspec_spectrum_powers(now)[i];
            const double error = pspec_spectrum_standard_errors(now)[i];
            assert_true(fabs(pspec_spectrum_powers(old)[i] / power - 1) < 1e-14);
            assert_true(fabs(pspec_spectrum_standard_errors(old)[i] / error - 1) < 1e-13);
        }
        pspec_spectrum_destroy(merged);
        pspec_spectrum_destroy(now);
    }
    pspec_spectrum_destroy(old);
    test_free_sample(&what);
    pspec_context_destroy(context);
}

static void version_2_is_read_as_what_it_is(void **state) {
    char path[TEST_PATH_BYTES];
    test_path(*state, "version-2", path);
    check_version_2(path, 0);
    check_version_2(path, 7);
}

/* ---- threads ----------------------------------------------------------------------------- */

typedef struct thread_work {
    const test_folder *folder;
    const test_sample *what;
    int number;
    uint64_t asked, said;
    pspec_spectrum *merged;
} thread_work;

static int count_progress(const pspec_progress_report *report, void *payload) {
    (void)report;
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
    const pspec_power_request request = test_host_request();
    pspec_spectrum *parts[2] = {NULL, NULL};
    pspec_context_set_progress(context, count_progress, work);
    pspec_context_set_log(context, count_sentences, work);
    for (size_t i = 0; i < 2; i++) {
        char name[32];
        char path[TEST_PATH_BYTES];
        snprintf(name, sizeof name, "thread-%d-%zu", work->number, i);
        test_path(work->folder, name, path);
        pspec_spectrum *part =
            test_public_spectrum(context, &request, work->what->patterns + 4 * i, i == 0 ? 4 : 5);
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
    test_sample what = test_make_sample(REALIZATIONS, 2, TEST_NUM_POINTS, 0, false);
    for (int i = 0; i < THREADS; i++) {
        work[i] = (thread_work){.folder = *state, .what = &what, .number = i};
        assert_int_equal(pthread_create(&threads[i], NULL, work_in_thread, &work[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        assert_non_null(work[i].merged);
        assert_true(test_is_same_spectrum(work[0].merged, work[i].merged, true));
        assert_true(work[i].asked >= REALIZATIONS && work[i].said >= 6);
    }
    for (int i = 0; i < THREADS; i++) {
        pspec_spectrum_destroy(work[i].merged);
    }
    test_free_sample(&what);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(saving_and_loading_changes_no_bit),
        cmocka_unit_test(damage_is_found),
        cmocka_unit_test(hostile_files_are_refused),
        cmocka_unit_test(other_files_are_refused),
        cmocka_unit_test(version_2_is_read_as_what_it_is),
        cmocka_unit_test(contexts_in_threads),
        cmocka_unit_test(test_gsl_is_left_alone),
    };
    test_watch_gsl();
    return cmocka_run_group_tests_name("spectrum_file", tests, test_folder_create,
                                       test_folder_remove);
}
