#include "harness.h"

#include "base/workers.h"
#include "verify/stress_shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

cJSON *test_read_reference(const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/reference/%s", TEST_SOURCE_DIR, name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const size_t bytes = (size_t)ftell(file);
    rewind(file);
    char *text = calloc(bytes + 1, 1);
    assert_int_equal(fread(text, 1, bytes, file), bytes);
    fclose(file);
    cJSON *json = cJSON_Parse(text);
    assert_non_null(json);
    free(text);
    return json;
}

long double test_long_number(const cJSON *item) {
    assert_non_null(item);
    return cJSON_IsString(item) ? strtold(item->valuestring, NULL) : (long double)item->valuedouble;
}

double test_number(const cJSON *item) {
    assert_non_null(item);
    return cJSON_IsString(item) ? strtod(item->valuestring, NULL) : item->valuedouble;
}

double test_field(const cJSON *object, const char *key) {
    return test_number(cJSON_GetObjectItem(object, key));
}

test_set test_read_set(const cJSON *json) {
    test_set set = {.name = cJSON_GetObjectItem(json, "name")->valuestring,
                    .dimension = (unsigned)test_field(json, "d"),
                    .num_points = (size_t)test_field(json, "N"),
                    .json = json};
    const cJSON *points = cJSON_GetObjectItem(json, "x");
    const cJSON *weights = cJSON_GetObjectItem(json, "w");
    set.points = calloc(set.num_points * set.dimension, sizeof(double));
    set.weights = cJSON_IsArray(weights) ? calloc(set.num_points, sizeof(double)) : NULL;
    for (size_t j = 0; j < set.num_points; j++) {
        const cJSON *point = cJSON_GetArrayItem(points, (int)j);
        for (unsigned axis = 0; axis < set.dimension; axis++) {
            set.points[j * set.dimension + axis] =
                test_number(cJSON_GetArrayItem(point, (int)axis));
        }
        const double weight =
            set.weights != NULL ? test_number(cJSON_GetArrayItem(weights, (int)j)) : 1;
        if (set.weights != NULL) {
            set.weights[j] = weight;
        }
        set.weight_size_sum += fabs(weight);
    }
    set.weight_sum = test_field(json, "sum_w");
    set.weight_square_sum = test_field(json, "sum_w2");
    return set;
}

void test_free_set(test_set *set) {
    free(set->points);
    free(set->weights);
}

pspec_pattern test_pattern(const test_set *set) {
    return (pspec_pattern){set->dimension, set->num_points, set->points, set->weights};
}

static ps_device *open_device(bool with_profile) {
    ps_device *device = NULL;
    ps_error error = {0};
    const pspec_status status =
        ps_device_open(&device, getenv("POINTSPEC_DEVICE"), with_profile, &error);
    if (status == PSPEC_ERROR_NO_DEVICE) {
        print_message("skipped: %s\n", error.message);
        exit(TEST_SKIPPED);
    }
    if (status != PSPEC_OK) {
        fail_msg("%s", error.message);
    }
    return device;
}

ps_device *test_open_device(void) {
    return open_device(false);
}

ps_device *test_open_gpu(void) {
    enum { GROUP = 64 };
    ps_device *const device = open_device(true);
    ps_device_set_dedicated_local_memory(device, true);
    ps_device_set_group_size(device, test_group(GROUP));
    return device;
}

uint64_t test_count_launches(const ps_device *device, const char *words) {
    size_t num = 0;
    uint64_t launches = 0;
    const ps_profile_row *const rows = ps_device_profile(device, &num);
    for (size_t i = 0; i < num; i++) {
        launches += strncmp(rows[i].kernel, words, strlen(words)) == 0 ? rows[i].launches : 0;
    }
    return launches;
}

size_t test_group(size_t usual) {
    const char *const forced = getenv("POINTSPEC_TEST_GROUP");
    return forced != NULL ? strtoul(forced, NULL, 10) : usual;
}

static double read_power(const ps_rows *rows, const void *data, size_t i) {
    if (rows->host != NULL) {
        return rows->host[i];
    }
    return rows->precision == PS_SINGLE ? (double)((const float *)data)[i]
                                        : ((const double *)data)[i];
}

void test_run_batch(const ps_engine *engine, void *state, const ps_frequencies *frequencies,
                    ps_device *device, const ps_batch *batch, double *powers) {
    ps_rows rows = {0};
    assert_ok(engine->run(state, batch, &rows, error));
    test_read_rows(engine, state, frequencies, device, &rows, powers);
}

void test_read_rows(const ps_engine *engine, const void *state, const ps_frequencies *frequencies,
                    ps_device *device, const ps_rows *given, double *powers) {
    ps_rows there = *given;
    ps_rows *const rows = &there;
    const size_t real_bytes = rows->precision == PS_SINGLE ? sizeof(float) : sizeof(double);
    const size_t bytes = rows->stride * rows->num_rows * real_bytes;
    uint32_t *slots = calloc(frequencies->num, sizeof(uint32_t));
    void *data = NULL;
    ps_engine_slots(engine, state, frequencies->num, slots);
    assert_ok(ps_rows_wait(rows, error));
    if (rows->host == NULL) {
        data = calloc(bytes, 1);
        assert_ok(ps_buffer_read(device, &rows->device, 0, data, bytes, error));
    }
    for (size_t r = 0; r < rows->num_rows; r++) {
        for (size_t i = 0; i < frequencies->num; i++) {
            powers[r * frequencies->num + i] = read_power(rows, data, r * rows->stride + slots[i]);
        }
    }
    free(data);
    free(slots);
}

double *test_run_problem(const ps_engine *engine, const ps_problem *problem, ps_precision precision,
                         ps_device *device, const pspec_pattern *patterns, size_t num_patterns,
                         size_t batch) {
    void *state = NULL;
    const ps_frequencies *frequencies = problem->frequencies;
    double *powers = calloc(num_patterns * frequencies->num, sizeof(double));
    double *scales = calloc(num_patterns, sizeof(double));
    for (size_t r = 0; r < num_patterns; r++) {
        scales[r] = 1;
    }
    assert_ok(ps_engine_create(engine, &state, problem, precision, batch, device, error));
    for (size_t done = 0; done < num_patterns; done += batch) {
        const size_t count = num_patterns - done < batch ? num_patterns - done : batch;
        const ps_batch some = {
            .num_patterns = count, .patterns = patterns + done, .scales = scales + done};
        test_run_batch(engine, state, frequencies, device, &some, powers + done * frequencies->num);
    }
    ps_engine_destroy(engine, state);
    free(scales);
    return powers;
}

double *test_run_engine_to(const ps_engine *engine, ps_precision precision, double tolerance,
                           ps_device *device, const ps_frequencies *frequencies,
                           const pspec_pattern *patterns, size_t num_patterns, size_t batch) {
    size_t longest = 1;
    for (size_t r = 0; r < num_patterns; r++) {
        longest = patterns[r].num_points > longest ? patterns[r].num_points : longest;
    }
    const ps_problem problem = {.frequencies = frequencies,
                                .num_points = longest,
                                .num_realizations = num_patterns,
                                .tolerance = tolerance};
    return test_run_problem(engine, &problem, precision, device, patterns, num_patterns, batch);
}

double *test_run_engine(const ps_engine *engine, ps_precision precision, ps_device *device,
                        const ps_frequencies *frequencies, const pspec_pattern *patterns,
                        size_t num_patterns, size_t batch) {
    return test_run_engine_to(engine, precision, 1, device, frequencies, patterns, num_patterns,
                              batch);
}

double test_engine_error(const ps_engine *engine, const ps_problem *problem, ps_precision precision,
                         ps_device *device, double mean_power) {
    void *state = NULL;
    assert_ok(ps_engine_create(engine, &state, problem, precision, 1, device, error));
    const double found = engine->error_of_state(state, mean_power, problem->weight_share);
    ps_engine_destroy(engine, state);
    return found;
}

void test_normalize_weights(double *weights, size_t num) {
    double most = 0;
    int exponent = 0;
    for (size_t j = 0; j < num; j++) {
        most = fmax(most, fabs(weights[j]));
    }
    frexp(most, &exponent);
    for (size_t j = 0; j < num; j++) {
        weights[j] = ldexp(weights[j], -exponent);
    }
}

double test_uniform(uint64_t *state) {
    return ps_stress_uniform(state);
}

double test_own_seconds(void) {
    return (double)clock() / CLOCKS_PER_SEC / ps_workers_most();
}
