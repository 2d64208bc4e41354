/* Sampled rings through the whole of the library: against complete rings, white noise and lattices
 * in four to six dimensions; saved, loaded, merged; requests that cannot be meant.
 */
#include "harness_public.h"
#include "test_folder.h"

#include <math.h>
#include <zlib.h>

static pspec_power_request request_of(unsigned dimension, int32_t k, uint64_t per_ring) {
    pspec_power_request request = test_host_request();
    request.dimension = dimension;
    request.max_frequency = k;
    request.per_ring = per_ring;
    return request;
}

static pspec_spectrum *spectrum_of(pspec_context *context, const pspec_power_request *request,
                                   size_t num_realizations, size_t num_points) {
    test_sample what = test_make_sample(num_realizations, request->dimension, num_points, 0, false);
    pspec_spectrum *spectrum =
        test_public_spectrum(context, request, what.patterns, num_realizations);
    test_free_sample(&what);
    return spectrum;
}

/* ---- against complete rings -------------------------------------------------------------- */

static void complete_rings_have_the_same_bits(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 1; dimension <= 5; dimension++) {
        pspec_power_request request = request_of(dimension, 3, 0);
        request.rings_only = 1;
        for (int shells = 0; shells <= 1; shells++) {
            request.bins = shells ? "shells" : "round";
            request.per_ring = 0;
            pspec_spectrum *all = spectrum_of(context, &request, 3, 20);
            request.per_ring = 100000;
            pspec_spectrum *sampled = spectrum_of(context, &request, 3, 20);
            assert_true(test_is_same_spectrum(all, sampled, true));
            pspec_spectrum_destroy(all);
            pspec_spectrum_destroy(sampled);
        }
    }
    pspec_context_destroy(context);
}

/* Rings with few frequencies are complete: their means are those of the whole. The others hold the
 * powers that the whole has at the same frequencies. */
static void small_rings_are_complete(void **state) {
    (void)state;
    enum { PER_RING = 30 };
    pspec_context *context = pspec_context_create();
    pspec_power_request request = request_of(3, 5, 0);
    request.rings_only = 1;
    pspec_spectrum *all = spectrum_of(context, &request, 3, 20);
    request.per_ring = PER_RING;
    pspec_spectrum *sampled = spectrum_of(context, &request, 3, 20);
    size_t num = 0;
    const pspec_bin *a = pspec_spectrum_bins(all, &num);
    const pspec_bin *b = pspec_spectrum_bins(sampled, &num);
    assert_int_equal(num, 5);
    for (size_t i = 0; i < num; i++) {
        const bool is_complete = a[i].count / 2 <= PER_RING;
        assert_int_equal(a[i].count, b[i].count);
        assert_int_equal(a[i].num_computed, a[i].count);
        assert_int_equal(b[i].num_computed, is_complete ? a[i].count : 2 * PER_RING);
        assert_true(fabs(a[i].frequency / b[i].frequency - 1) < 1e-14);
        if (is_complete) {
            assert_true(fabs(a[i].power / b[i].power - 1) < 1e-14);
            assert_true(fabs(a[i].standard_error / b[i].standard_error - 1) < 1e-12);
        } else {
            assert_true(fabs(a[i].power - b[i].power) < 5 * b[i].standard_error);
            assert_true(b[i].standard_error > 0);
        }
    }
    assert_true(a[0].num_computed == a[0].count && b[4].num_computed < b[4].count);
    pspec_spectrum_destroy(all);
    pspec_spectrum_destroy(sampled);
    pspec_context_destroy(context);
}

/* ---- laws -------------------------------------------------------------------------------- */

static void white_noise_in_many_dimensions(void **state) {
    (void)state;
    enum { REALIZATIONS = 60, K = 30 };
    pspec_context *context = pspec_context_create();
    for (unsigned dimension = 4; dimension <= 6; dimension++) {
        const pspec_power_request request = request_of(dimension, K, 8);
        pspec_spectrum *spectrum = spectrum_of(context, &request, REALIZATIONS, 16);
        size_t num = 0;
        const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
        double squares = 0;
        assert_int_equal(num, K);
        for (size_t b = 0; b < num; b++) {
            const double deviation = (bins[b].power - 1) / bins[b].standard_error;
            squares += deviation * deviation;
            assert_true(fabs(deviation) < 4.5);
        }
        assert_true(fabs(squares / K - 1) < 5 * sqrt(2.0 / K)); /* chi-square */
        pspec_spectrum_destroy(spectrum);
    }
    pspec_context_destroy(context);
}

/* A grid of 2^d points: power N where all k_i are even, else 0. Shells of odd |k|^2 hold nothing,
 * that of |k|^2 = 4 in six dimensions 12 peaks among 252 frequencies. */
static void peaks_of_a_grid(void **state) {
    (void)state;
    enum { DIMENSION = 6, NUM = 64, SEEDS = 200 };
    double points[NUM][DIMENSION];
    for (unsigned j = 0; j < NUM; j++) {
        for (unsigned i = 0; i < DIMENSION; i++) {
            points[j][i] = (j >> i & 1) * 0.5;
        }
    }
    const pspec_pattern pattern = {DIMENSION, NUM, &points[0][0], NULL};
    pspec_context *context = pspec_context_create();
    pspec_power_request request = request_of(DIMENSION, 2, 40);
    request.bins = "shells";
    double sum = 0;
    double squares = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        request.per_ring_seed = seed;
        pspec_spectrum *spectrum = test_public_spectrum(context, &request, &pattern, 1);
        size_t num = 0;
        const pspec_bin *bins = pspec_spectrum_bins(spectrum, &num);
        assert_int_equal(num, 6);
        for (size_t b = 0; b < num; b++) {
            assert_int_equal(bins[b].bin, b + 1);
            assert_true(b % 2 == 1 || fabs(bins[b].power) < 1e-12);
        }
        assert_int_equal(bins[3].count, 252);
        assert_int_equal(bins[3].num_computed, 80);
        sum += bins[3].power;
        squares += bins[3].standard_error * bins[3].standard_error;
        pspec_spectrum_destroy(spectrum);
    }
    const double expected = 12.0 / 252 * NUM;
    assert_true(fabs(sum / SEEDS - expected) < 4 * sqrt(squares) / SEEDS);
    pspec_context_destroy(context);
}

/* ---- files and merging ------------------------------------------------------------------- */

static pspec_spectrum *load(pspec_context *context, const char *path) {
    pspec_spectrum *spectrum = NULL;
    if (pspec_spectrum_load(&spectrum, context, path) != PSPEC_OK) {
        fail_msg("%s", pspec_context_message(context));
    }
    return spectrum;
}

static void saving_and_merging(void **state) {
    char path[TEST_PATH_BYTES];
    pspec_context *context = pspec_context_create();
    test_sample what = test_make_sample(5, 4, TEST_NUM_POINTS, 1, false);
    pspec_power_request request = request_of(4, 4, 12);
    test_path(*state, "sample", path);
    for (int shells = 0; shells <= 1; shells++) {
        request.bins = shells ? "shells" : "round";
        pspec_spectrum *whole = test_public_spectrum(context, &request, what.patterns, 5);
        pspec_spectrum *parts[] = {test_public_spectrum(context, &request, what.patterns, 2),
                                   test_public_spectrum(context, &request, what.patterns + 2, 3)};
        assert_int_equal(pspec_spectrum_save(parts[1], context, path), PSPEC_OK);
        pspec_spectrum *loaded = load(context, path);
        assert_true(test_is_same_spectrum(parts[1], loaded, true));
        pspec_spectrum *merged = NULL;
        const pspec_spectrum *const both[] = {parts[0], loaded};
        assert_int_equal(pspec_spectrum_merge(&merged, context, both, 2), PSPEC_OK);
        size_t num = 0;
        const pspec_bin *a = pspec_spectrum_bins(whole, &num);
        const pspec_bin *b = pspec_spectrum_bins(merged, &num);
        for (size_t i = 0; i < num; i++) {
            assert_true(a[i].count == b[i].count && a[i].num_computed == b[i].num_computed);
            assert_true(fabs(a[i].power / b[i].power - 1) < 1e-13);
            assert_true(fabs(a[i].standard_error / b[i].standard_error - 1) < 1e-10);
        }
        pspec_spectrum_destroy(whole);
        pspec_spectrum_destroy(merged);
        pspec_spectrum_destroy(loaded);
        pspec_spectrum_destroy(parts[0]);
        pspec_spectrum_destroy(parts[1]);
    }
    test_free_sample(&what);
    pspec_context_destroy(context);
}

static void other_subsets_do_not_merge(void **state) {
    (void)state;
    pspec_context *context = pspec_context_create();
    pspec_power_request requests[] = {request_of(4, 3, 12), request_of(4, 3, 12),
                                      request_of(4, 3, 13), request_of(4, 4, 12),
                                      request_of(4, 3, 0)};
    const char *const parts[] = {"another seed", "frequencies instead of", "max frequency 4",
                                 "box instead of a random subset"};
    pspec_spectrum *spectra[5];
    requests[1].per_ring_seed = 2;
    for (size_t i = 0; i < 5; i++) {
        spectra[i] = spectrum_of(context, &requests[i], 1, 10);
    }
    for (size_t i = 1; i < 5; i++) {
        pspec_spectrum *merged = NULL;
        const pspec_spectrum *const both[] = {spectra[0], spectra[i]};
        assert_int_equal(pspec_spectrum_merge(&merged, context, both, 2), PSPEC_ERROR_INPUT);
        if (strstr(pspec_context_message(context), parts[i - 1]) == NULL) {
            fail_msg("\"%s\" is not in \"%s\"", parts[i - 1], pspec_context_message(context));
        }
    }
    for (size_t i = 0; i < 5; i++) {
        pspec_spectrum_destroy(spectra[i]);
    }
    pspec_context_destroy(context);
}

/* The file with a number of its body or a piece of its header changed, and a checksum that fits. */
static void refuse_changed(pspec_context *context, const char *path, char *bytes, size_t num_bytes,
                           size_t place, char change) {
    enum { CHECKSUM_BYTES = 4 };
    pspec_spectrum *spectrum = NULL;
    bytes[place] ^= change;
    const uLong checksum =
        crc32(crc32(0, NULL, 0), (const Bytef *)bytes, (uInt)(num_bytes - CHECKSUM_BYTES));
    for (size_t i = 0; i < CHECKSUM_BYTES; i++) {
        bytes[num_bytes - CHECKSUM_BYTES + i] = (char)(checksum >> (8 * i));
    }
    assert_true(test_write_file(path, bytes, num_bytes));
    const pspec_status status = pspec_spectrum_load(&spectrum, context, path);
    if (status != PSPEC_ERROR_INPUT) {
        fail_msg("byte %zu changed: status %d", place, (int)status);
    }
    bytes[place] ^= change;
}

static void hostile_files(void **state) {
    char path[TEST_PATH_BYTES];
    size_t num_bytes = 0;
    pspec_context *context = pspec_context_create();
    const pspec_power_request request = request_of(3, 3, 4);
    pspec_spectrum *spectrum = spectrum_of(context, &request, 2, 10);
    test_path(*state, "hostile", path);
    assert_int_equal(pspec_spectrum_save(spectrum, context, path), PSPEC_OK);
    char *bytes = test_read_file(path, &num_bytes);
    const size_t header = (size_t)(strstr(bytes, "\n\n") + 2 - bytes);
    const size_t list = header + (3 + 2 * 4) * sizeof(double); /* totals, two sums */
    const size_t rings = list + 3 * 4 * 3 * sizeof(int32_t);   /* all three rings are sampled */
    const size_t per_ring = (size_t)(strstr(bytes, "per_ring: 4") + 10 - bytes);
    refuse_changed(context, path, bytes, num_bytes, per_ring, '4' ^ '5');
    refuse_changed(context, path, bytes, num_bytes, per_ring, '4' ^ '1');
    refuse_changed(context, path, bytes, num_bytes, list + 1, 1);            /* a component + 256 */
    refuse_changed(context, path, bytes, num_bytes, rings + 7, (char)0xFF);  /* 2^63 in a ring */
    refuse_changed(context, path, bytes, num_bytes, rings, 9 ^ 3);           /* of 9 frequencies */
    refuse_changed(context, path, bytes, num_bytes, rings + 15, (char)0x80); /* -|k| */
    free(bytes);
    pspec_spectrum_destroy(spectrum);
    pspec_context_destroy(context);
}

/* ---- requests ---------------------------------------------------------------------------- */

static void check_refused(const pspec_power_request *request, const char *part) {
    pspec_context *context = pspec_context_create();
    pspec_plan *plan = NULL;
    assert_int_equal(pspec_plan_create(&plan, context, request), PSPEC_ERROR_INVALID_ARGUMENT);
    if (strstr(pspec_context_message(context), part) == NULL) {
        fail_msg("\"%s\" is not in \"%s\"", part, pspec_context_message(context));
    }
    pspec_context_destroy(context);
}

static void hopeless_requests(void **state) {
    (void)state;
    const int32_t list[] = {1, 0, 0, 0};
    pspec_power_request request = request_of(4, 10, 1);
    check_refused(&request, "at least 2");
    request = request_of(4, 3000, 9);
    check_refused(&request, "between 1 and 2000");
    request = request_of(4, 0, 9);
    request.frequencies = list;
    request.num_frequencies = 1;
    check_refused(&request, "a list is not averaged");
    request = request_of(6, 20, 0);
    check_refused(&request, "--per-ring");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(complete_rings_have_the_same_bits),
        cmocka_unit_test(small_rings_are_complete),
        cmocka_unit_test(white_noise_in_many_dimensions),
        cmocka_unit_test(peaks_of_a_grid),
        cmocka_unit_test(saving_and_merging),
        cmocka_unit_test(other_subsets_do_not_merge),
        cmocka_unit_test(hostile_files),
        cmocka_unit_test(hopeless_requests),
    };
    return cmocka_run_group_tests_name("per_ring", tests, test_folder_create, test_folder_remove);
}
