/* Which device a selector means: made-up lists, then the devices that are here. */
#include "harness.h"

#include "device/choice.h"
#include "device/kind.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUM_MADE_UP = 4 };
static const ps_device_limits made_up[NUM_MADE_UP] = {
    {.name = "Fast Chip FC-1"},
    {.name = "Example Core i7", .is_cpu = true},
    {.name = "Example Graphics 200", .is_gpu = true},
    {.name = "Example Graphics 100", .is_gpu = true},
};

static void selectors(void **state) {
    (void)state;
    const struct {
        const char *selector;
        size_t index;
    } cases[] = {{NULL, 2},     {"", 2},         {"0", 0},           {"3", 3},
                 {"gpu", 2},    {"cpu", 1},      {"accelerator", 0}, {"Core", 1},
                 {"core i", 1}, {"GRAPHICS", 2}, {"fc-1", 0},        {"Graphics 1", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        size_t index = NUM_MADE_UP;
        assert_ok(ps_device_choose(made_up, NUM_MADE_UP, cases[i].selector, &index, error));
        assert_int_equal(index, cases[i].index);
    }
}

static void assert_selected(const char *selector, const char *expected) {
    ps_selectors found;
    char list[256] = "";
    assert_ok(ps_selectors_find(&found, made_up, NUM_MADE_UP, selector, error));
    for (size_t i = 0; i < found.num; i++) {
        const size_t at = strlen(list);
        snprintf(list + at, sizeof list - at, "%s%s", i > 0 ? " " : "", found.of[i].text);
    }
    assert_string_equal(list, expected);
    size_t first = 0;
    assert_ok(ps_device_choose(made_up, NUM_MADE_UP, selector, &first, error));
    assert_int_equal(first, strtoul(expected, NULL, 10)); /* who works alone takes it */
}

static void several_devices(void **state) {
    (void)state;
    assert_selected("1", "1");
    assert_selected("3,0", "3 0");
    assert_selected("gpu:all", "2 3");
    assert_selected("gpu:all,cpu", "2 3 1");
    assert_selected("Example:ALL", "1 2 3");
    assert_selected("cpu:split=3", "1:split=3/0 1:split=3/1 1:split=3/2");
    assert_selected("cpu:split=3/1", "1:split=3/1");
    assert_selected("0,cpu:split=2/1,cpu:split=2/0", "0 1:split=2/1 1:split=2/0");
    assert_true(ps_selector_is_list("0,1"));
    assert_true(ps_selector_is_list("gpu:all"));
    assert_true(ps_selector_is_list("cpu:split=2"));
    assert_false(ps_selector_is_list("Graphics 1"));
    assert_false(ps_selector_is_list(NULL));
}

static void several_devices_that_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *selector, *why;
    } cases[] = {{"0,1,0", "device 0 is named twice"},
                 {"2,gpu:all", "device 2 is named twice"},
                 {"2,", "device 2 is named twice"},
                 {"cpu:split=65", "65 is not between 1 and 64"},
                 {"cpu:split=", "the number of shares of a device"},
                 {"cpu:split=2/2", "2 is not between 0 and 1"},
                 {"accelerator:all,tpu", "no OpenCL device fits \"accelerator:all,tpu\""},
                 {"gpu:all,9", "no OpenCL device fits"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_selectors found;
        ps_error said = {0};
        assert_int_equal(ps_selectors_find(&found, made_up, NUM_MADE_UP, cases[i].selector, &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, cases[i].why));
    }
}

/* Shares of a device are of its kind, and have all of its units together. */
static void a_device_is_split(void **state) {
    (void)state;
    ps_device *whole = NULL;
    ps_error said = {0};
    if (ps_device_open(&whole, getenv("POINTSPEC_DEVICE"), false, &said) != PSPEC_OK) {
        skip();
    }
    const unsigned units = ps_device_get_limits(whole)->compute_units;
    unsigned sum = 0;
    for (unsigned share = 0; units > 1 && share < 2; share++) {
        char selector[64];
        ps_device *part = NULL;
        snprintf(selector, sizeof selector, "%s:split=2/%u",
                 getenv("POINTSPEC_DEVICE") != NULL ? getenv("POINTSPEC_DEVICE") : "", share);
        const pspec_status status = ps_device_open(&part, selector, false, &said);
        if (status != PSPEC_OK) { /* GPUs are not split by their drivers */
            assert_non_null(strstr(said.message, "its driver splits no device"));
            sum = units;
            break;
        }
        const ps_device_kind kinds[] = {ps_device_kind_of(ps_device_get_limits(whole)),
                                        ps_device_kind_of(ps_device_get_limits(part))};
        assert_string_equal(kinds[0].text, kinds[1].text);
        sum += ps_device_get_limits(part)->compute_units;
        ps_device_close(part);
    }
    assert_true(units == 1 || sum == units);
    ps_device *none = NULL;
    assert_int_equal(ps_device_open(&none, ":split=64", false, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, "is not split into 64 shares"));
    ps_device_close(whole);
}

/* Without a GPU the first CPU, without a CPU the first device. */
static void default_choice(void **state) {
    (void)state;
    size_t index = NUM_MADE_UP;
    assert_ok(ps_device_choose(made_up, 2, NULL, &index, error));
    assert_int_equal(index, 1);
    assert_ok(ps_device_choose(made_up, 1, NULL, &index, error));
    assert_int_equal(index, 0);
}

/* Oclgrind says that it is CPU, GPU and accelerator at once, and is none. */
static void simulators_come_last(void **state) {
    (void)state;
    const ps_device_limits devices[] = {
        {.name = "Oclgrind Simulator", .platform = "Oclgrind", .is_gpu = true, .is_cpu = true},
        {.name = "Fast Chip FC-1"},
        {.name = "Example Core i7", .is_cpu = true},
        {.name = "Example Graphics 200", .is_gpu = true},
    };
    size_t index = 0;
    assert_ok(ps_device_choose(devices, 4, NULL, &index, error));
    assert_int_equal(index, 3);
    assert_ok(ps_device_choose(devices, 3, NULL, &index, error));
    assert_int_equal(index, 2);
    assert_ok(ps_device_choose(devices, 2, NULL, &index, error));
    assert_int_equal(index, 1);
    assert_ok(ps_device_choose(devices, 1, NULL, &index, error)); /* there is nothing else */
    assert_int_equal(index, 0);
    assert_ok(ps_device_choose(devices, 4, "cpu", &index, error));
    assert_int_equal(index, 2);
    assert_ok(ps_device_choose(devices, 3, "gpu", &index, error)); /* asked for, and the only one */
    assert_int_equal(index, 0);
    assert_ok(ps_device_choose(devices, 4, "oclgrind", &index, error));
    assert_int_equal(index, 0);
}

static void unknown_selectors(void **state) {
    (void)state;
    size_t index = 0;
    ps_error said = {0};
    assert_int_equal(ps_device_choose(made_up, NUM_MADE_UP, "Radeon", &index, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(said.message, "\"Radeon\""));
    for (size_t i = 0; i < NUM_MADE_UP; i++) {
        assert_non_null(strstr(said.message, made_up[i].name));
    }
    const char *const indices[] = {"4", "100", "99999999999999999999"};
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(ps_device_choose(made_up, NUM_MADE_UP, indices[i], &index, &said),
                         PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(said.message, indices[i]));
    }
    assert_int_equal(ps_device_choose(made_up, 1, "gpu", &index, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(
        said.message,
        "no OpenCL device fits \"gpu\"; the only one is number 0, \"Fast Chip FC-1\"");
    assert_int_equal(ps_device_choose(made_up, 2, "gpu", &index, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_string_equal(said.message,
                        "no OpenCL device fits \"gpu\"; there are number 0, \"Fast Chip FC-1\"; "
                        "number 1, \"Example Core i7\"");
}

static void listed_devices_can_be_chosen(void **state) {
    (void)state;
    ps_device_limits *limits = NULL;
    size_t num_devices = 0;
    ps_error said = {0};
    if (ps_device_list(&limits, &num_devices, &said) != PSPEC_OK) {
        assert_non_null(strstr(said.message, "host_direct")); /* what works without */
        skip();
    }
    assert_true(num_devices > 0);
    for (size_t i = 0; i < num_devices; i++) {
        char number[24];
        size_t index = num_devices;
        snprintf(number, sizeof number, "%zu", i);
        assert_ok(ps_device_choose(limits, num_devices, number, &index, error));
        assert_int_equal(index, i);
        assert_true(limits[i].name[0] != '\0' && limits[i].platform[0] != '\0');
        assert_true(limits[i].compute_units > 0 && limits[i].max_work_group_size > 0);
        assert_true(limits[i].global_bytes >= limits[i].max_allocation_bytes);
        assert_true(limits[i].local_bytes >= 32 << 10); /* OpenCL 1.2 promises it */
        /* NVIDIA's question, which no other driver knows */
        assert_true(limits[i].double_cost == 0 || strstr(limits[i].platform, "NVIDIA") != NULL);
    }
    free(limits);
    ps_device *none = NULL;
    assert_int_equal(ps_device_open(&none, "no such device", false, &said),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    assert_null(none);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(selectors),
        cmocka_unit_test(several_devices),
        cmocka_unit_test(several_devices_that_are_refused),
        cmocka_unit_test(a_device_is_split),
        cmocka_unit_test(default_choice),
        cmocka_unit_test(simulators_come_last),
        cmocka_unit_test(unknown_selectors),
        cmocka_unit_test(listed_devices_can_be_chosen),
    };
    return cmocka_run_group_tests_name("device_choice", tests, NULL, NULL);
}
