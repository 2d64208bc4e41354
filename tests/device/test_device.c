/* Building kernels, launching them, limits of a device, buffers and the profile. */
#include "harness_kernels.h"

#include "device/programs/kernel_source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static ps_device *device;

/* ---- kernels of this test, in a folder of their own ---------------------------------------- */

static char folder[] = "/tmp/pointspec-test-XXXXXX";

static void write_file(const char *name, const char *text) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void remove_file(const char *name) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    unlink(path);
}

static const char *const file_names[] = {"fill.cl", "local.cl", "broken.cl", "outer.cl",
                                         "inner.h", "lost.cl",  "again.h"};

static int write_kernels(void **state) {
    (void)state;
    assert_non_null(mkdtemp(folder));
    write_file("fill.cl", "__kernel void fill(__global uint *out, const uint value) {\n"
                          "    out[get_global_id(0)] = value + (uint)get_local_size(0) * 1000;\n"
                          "}\n"
                          "__kernel void other(__global uint *out) {\n"
                          "    out[get_global_id(0)] = 7;\n"
                          "}\n");
    write_file("local.cl", "__kernel void share(__global uint *out, __local uint *room) {\n"
                           "    room[get_local_id(0)] = (uint)get_global_id(0);\n"
                           "    barrier(CLK_LOCAL_MEM_FENCE);\n"
                           "    out[get_global_id(0)] = room[get_local_id(0)];\n"
                           "}\n");
    write_file("broken.cl", "#include \"again.h\"\n"
                            "__kernel void broken(__global int *out) {\n"
                            "    out[0] = undeclared_here;\n"
                            "}\n");
    write_file("outer.cl", "#include \"again.h\"\n"
                           "#include \"inner.h\"\n"
                           "__kernel void outer(__global int *out) {\n"
                           "    out[0] = inner(1);\n"
                           "}\n");
    write_file("inner.h", "#include \"again.h\"\n"
                          "\n"
                          "int inner(int x) {\n"
                          "    return x + another_unknown;\n"
                          "}\n");
    write_file("again.h", "/* twice */\nenum { ONCE = 1 };\n");
    write_file("lost.cl", "#include \"nowhere.h\"\n");
    setenv("POINTSPEC_KERNEL_DIR", folder, 1);
    return 0;
}

static int remove_kernels(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof file_names / sizeof file_names[0]; i++) {
        remove_file(file_names[i]);
    }
    unsetenv("POINTSPEC_KERNEL_DIR");
    return rmdir(folder);
}

/* Includes are in place, once each; #line marks say where every line came from. */
static void includes_are_expanded(void **state) {
    (void)state;
    ps_text text = {0};
    assert_ok(ps_kernel_source_expand("outer.cl", &text, error));
    assert_string_equal(ps_text_string(&text), "#line 1 \"outer.cl\"\n"
                                               "#line 1 \"again.h\"\n"
                                               "/* twice */\n"
                                               "enum { ONCE = 1 };\n"
                                               "#line 2 \"outer.cl\"\n"
                                               "#line 1 \"inner.h\"\n"
                                               "\n"
                                               "\n"
                                               "int inner(int x) {\n"
                                               "    return x + another_unknown;\n"
                                               "}\n"
                                               "#line 3 \"outer.cl\"\n"
                                               "__kernel void outer(__global int *out) {\n"
                                               "    out[0] = inner(1);\n"
                                               "}\n");
    ps_text_free(&text);
}

static void build_logs_name_file_and_line(void **state) {
    (void)state;
    const struct {
        const char *source, *kernel, *where, *what;
    } cases[] = {{"broken.cl", "broken", "broken.cl:3", "undeclared_here"},
                 {"outer.cl", "outer", "inner.h:4", "another_unknown"}};
    for (size_t i = 0; i < 2; i++) {
        ps_kernel *kernel = NULL;
        ps_error said = {0};
        assert_int_equal(ps_kernel_get(device, &kernel, cases[i].source, cases[i].kernel,
                                       "-DPRECISION=32", &said),
                         PSPEC_ERROR_BUILD);
        assert_null(kernel);
        if (strstr(said.message, cases[i].where) == NULL ||
            strstr(said.message, cases[i].what) == NULL ||
            strstr(said.message, "-DPRECISION=32") == NULL) {
            fail_msg("\"%s\" is missing in: %s", cases[i].where, said.message);
        }
    }
}

static void missing_sources(void **state) {
    (void)state;
    ps_kernel *kernel = NULL;
    ps_error said = {0};
    assert_int_equal(ps_kernel_get(device, &kernel, "absent.cl", "x", "", &said), PSPEC_ERROR_IO);
    assert_non_null(strstr(said.message, "absent.cl"));
    assert_non_null(strstr(said.message, folder));
    assert_int_equal(ps_kernel_get(device, &kernel, "lost.cl", "x", "", &said), PSPEC_ERROR_IO);
    assert_non_null(strstr(said.message, "nowhere.h"));
    assert_int_equal(ps_kernel_get(device, &kernel, "fill.cl", "no_such_kernel", "", &said),
                     PSPEC_ERROR_DEVICE);
    assert_non_null(strstr(said.message, "CL_INVALID_KERNEL_NAME"));
    unsetenv("POINTSPEC_KERNEL_DIR"); /* now the table in the program */
    assert_int_equal(ps_kernel_get(device, &kernel, "absent.cl", "x", "", &said),
                     PSPEC_ERROR_BUILD);
    assert_non_null(strstr(said.message, "absent.cl"));
    setenv("POINTSPEC_KERNEL_DIR", folder, 1);
    assert_null(kernel);
}

/* What is cut would mean something else. */
static void options_without_room_are_refused(void **state) {
    (void)state;
    assert_string_equal(ps_defines_of(sizeof(double), 8).text, "-DPRECISION=64 -DLANES=8");
    for (size_t most = PS_DEFINES_BYTES - 2; most < PS_DEFINES_BYTES + 2; most++) {
        ps_defines full = ps_defines_of(sizeof(float), 0);
        ps_kernel *kernel = NULL;
        ps_error said = {0};
        ps_defines_add(&full, "-DX%0*d", (int)(most - strlen(full.text) - strlen(" -DX")), 0);
        const bool fits = most == PS_DEFINES_BYTES - 2;
        assert_int_equal(ps_kernel_get(device, &kernel, "fill.cl", "fill", full.text, &said),
                         fits ? PSPEC_OK : PSPEC_ERROR_BUILD);
        assert_true(fits || strstr(said.message, "letters of options") != NULL);
    }
}

/* ---- launches ------------------------------------------------------------------------------ */

static void check_filled(const test_memory *memory, size_t num, uint32_t value) {
    uint32_t *found = test_memory_read(memory);
    for (size_t i = 0; i < memory->bytes / sizeof *found; i++) {
        assert_int_equal(found[i], i < num ? value : UINT32_MAX);
    }
    free(found);
}

/* Units that do nothing, are wrong or do not build are not taken. */
static void matrix_units_are_tried(void **state) {
    static const char *const texts[] = {"__kernel void probe_units(__global uint *wrong) {}",
                                        "__kernel void probe_units(__global uint *wrong) {\n"
                                        "    wrong[0] = 1;\n"
                                        "}",
                                        "__kernel void probe_units(__global uint *wrong) { no; }"};
    char probes[sizeof folder + sizeof "/probe"];
    (void)state;
    unsetenv("POINTSPEC_KERNEL_DIR");
    assert_true(ps_units_are_right(device, PS_UNITS_EMULATED));
    setenv("POINTSPEC_KERNEL_DIR", folder, 1);
    snprintf(probes, sizeof probes, "%s/probe", folder);
    assert_int_equal(mkdir(probes, S_IRWXU), 0);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        ps_device *const other = test_open_device();
        write_file("probe/units.cl", texts[i]);
        assert_false(ps_units_are_right(other, PS_UNITS_EMULATED));
        ps_device_close(other);
    }
    remove_file("probe/units.cl");
    assert_int_equal(rmdir(probes), 0);
}

static void launches_reach_the_device(void **state) {
    (void)state;
    enum { NUM = 100 };
    ps_kernel *kernel = test_kernel(device, "fill.cl", "fill", "-DTEST");
    test_memory out = test_memory_create(device, NULL, NUM * sizeof(uint32_t));
    ps_range range = {.rank = 1, .global = {0}, .local = {5}};
    assert_ok(PS_LAUNCH(device, kernel, &range, error, PS_BUFFER(out.buffer), PS_U32(3)));
    check_filled(&out, 0, 0); /* a range without work does nothing */
    range.global[0] = 20;
    assert_ok(PS_LAUNCH(device, kernel, &range, error, PS_BUFFER(out.buffer), PS_U32(3)));
    check_filled(&out, 20, 5003);
    test_memory_free(&out);
}

static void ranges_are_rounded_up(void **state) {
    (void)state;
    const size_t groups[] = {1, 3, 64};
    for (size_t i = 0; i < 3; i++) {
        ps_device_set_group_size(device, groups[i]);
        for (size_t first = 0; first < 200; first += 1 + first / 3) {
            const ps_range range = ps_range_light(device, first, 5, 7, 1, 2);
            assert_int_equal(range.global[0] % groups[i], 0);
            assert_true(range.global[0] >= first && range.global[0] < first + groups[i]);
            assert_int_equal(range.global[1], 5);
            assert_int_equal(range.global[2], 7);
        }
    }
    ps_device_set_group_size(device, (size_t)1 << 40); /* more than any device has */
    const size_t most = ps_device_get_limits(device)->max_work_group_size;
    assert_int_equal(ps_range_light(device, 1, 1, 1, 0, 0).local[0], most);
    ps_device_set_group_size(device, 0);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    ps_kernel *kernel = test_kernel(device, "fill.cl", "fill", "-DTEST");
    test_memory out = test_memory_create(device, NULL, 64);
    const ps_range range = {.rank = 1, .global = {4}, .local = {1}};
    ps_error said = {0};
    assert_int_equal(PS_LAUNCH(device, kernel, &range, &said, PS_BUFFER(out.buffer)),
                     PSPEC_ERROR_DEVICE);
    assert_string_equal(said.message, "a kernel takes 2 arguments but 1 were given");
    assert_int_equal(
        PS_LAUNCH(device, kernel, &range, &said, PS_BUFFER(out.buffer), PS_U32(1), PS_U32(2)),
        PSPEC_ERROR_DEVICE);
    assert_int_equal(PS_LAUNCH(device, kernel, &range, &said, PS_BUFFER(out.buffer), PS_U64(1)),
                     PSPEC_ERROR_DEVICE);
    assert_non_null(strstr(said.message, "CL_INVALID_ARG_SIZE"));
    check_filled(&out, 0, 0);
    test_memory_free(&out);
}

static void large_work_groups_are_refused(void **state) {
    (void)state;
    ps_kernel *kernel = test_kernel(device, "fill.cl", "fill", "-DTEST");
    test_memory out = test_memory_create(device, NULL, 64);
    const size_t most = ps_device_get_limits(device)->max_work_group_size;
    const ps_range ranges[] = {{.rank = 1, .global = {2 * most}, .local = {2 * most}},
                               {.rank = 2, .global = {most, 2}, .local = {most, 2}}};
    for (size_t i = 0; i < 2; i++) {
        ps_error said = {0};
        assert_int_equal(
            PS_LAUNCH(device, kernel, &ranges[i], &said, PS_BUFFER(out.buffer), PS_U32(1)),
            PSPEC_ERROR_DEVICE);
        assert_non_null(strstr(said.message, "work-group of"));
        assert_non_null(strstr(said.message, ps_device_get_limits(device)->name));
    }
    test_memory_free(&out);
}

/* PoCL would end the process. */
static void too_much_local_memory_is_refused(void **state) {
    (void)state;
    ps_kernel *kernel = test_kernel(device, "local.cl", "share", "-DTEST");
    const uint64_t most = ps_device_get_limits(device)->local_bytes;
    test_memory out = test_memory_create(device, NULL, 64);
    const ps_range range = {.rank = 1, .global = {16}, .local = {4}};
    const uint64_t sizes[] = {most + 4, 2 * most, 64 * most};
    for (size_t i = 0; i < 3; i++) {
        ps_error said = {0};
        assert_int_equal(PS_LAUNCH(device, kernel, &range, &said, PS_BUFFER(out.buffer),
                                   PS_LOCAL((size_t)sizes[i])),
                         PSPEC_ERROR_DEVICE);
        assert_non_null(strstr(said.message, "local"));
    }
    check_filled(&out, 0, 0);
    assert_ok(PS_LAUNCH(device, kernel, &range, error, PS_BUFFER(out.buffer), PS_LOCAL(16)));
    uint32_t *found = test_memory_read(&out);
    for (uint32_t i = 0; i < 16; i++) {
        assert_int_equal(found[i], i);
    }
    free(found);
    test_memory_free(&out);
}

/* ---- buffers and profile ------------------------------------------------------------------- */

static void large_buffers_are_refused(void **state) {
    (void)state;
    const ps_device_limits *limits = ps_device_get_limits(device);
    const size_t sizes[] = {(size_t)limits->max_allocation_bytes + 1, SIZE_MAX};
    for (size_t i = 0; i < 2; i++) {
        ps_buffer buffer = {0};
        ps_error said = {0};
        char number[24];
        snprintf(number, sizeof number, "%zu", sizes[i]);
        assert_int_equal(ps_buffer_create(device, &buffer, sizes[i], "the tables", &said),
                         PSPEC_ERROR_MEMORY);
        assert_null(buffer.memory);
        assert_non_null(strstr(said.message, "the tables"));
        assert_non_null(strstr(said.message, number));
        assert_non_null(strstr(said.message, limits->name));
        ps_buffer_release(&buffer);
    }
}

static void buffers_keep_what_is_written(void **state) {
    (void)state;
    unsigned char in[256];
    unsigned char out[256] = {0};
    ps_buffer buffer = {0};
    for (size_t i = 0; i < sizeof in; i++) {
        in[i] = (unsigned char)(i * 37);
    }
    assert_ok(ps_buffer_create(device, &buffer, sizeof in, "a test", error));
    assert_ok(ps_buffer_write(device, &buffer, 0, in, sizeof in, error));
    assert_ok(ps_buffer_write(device, &buffer, 9, in, 5, error));
    assert_ok(ps_buffer_write(device, &buffer, 0, NULL, 0, error));
    assert_ok(ps_buffer_read(device, &buffer, 9, out, 6, error));
    assert_memory_equal(out, in, 5);
    assert_int_equal(out[5], in[14]);
    assert_ok(ps_buffer_clear(device, &buffer, error));
    assert_ok(ps_buffer_read(device, &buffer, 0, out, sizeof out, error));
    for (size_t i = 0; i < sizeof out; i++) {
        assert_int_equal(out[i], 0);
    }
    ps_buffer_release(&buffer);
    ps_error said = {0};
    assert_ok(ps_buffer_create(device, &buffer, 0, "nothing", error));
    assert_ok(ps_buffer_clear(device, &buffer, error));
    assert_non_null(buffer.memory);
    assert_int_not_equal(ps_buffer_write(device, &buffer, 1000, in, 1, &said), PSPEC_OK);
    ps_buffer_release(&buffer);
    ps_buffer_release(&buffer); /* {0} is allowed */
}

static void profile_counts_launches(void **state) {
    (void)state;
    ps_device *watched = NULL;
    size_t num_rows = 0;
    assert_ok(ps_device_open(&watched, getenv("POINTSPEC_DEVICE"), true, error));
    ps_device_profile(watched, &num_rows);
    assert_int_equal(num_rows, 0);
    ps_kernel *fill = test_kernel(watched, "fill.cl", "fill", "-DTEST");
    ps_kernel *other = test_kernel(watched, "fill.cl", "other", "-DTEST");
    test_memory out = test_memory_create(watched, NULL, 64);
    const ps_range range = {.rank = 1, .global = {4}, .local = {1}, .flops = 10, .bytes = 16};
    const ps_range empty = {.rank = 1, .global = {0}, .local = {1}, .flops = 10, .bytes = 16};
    for (int i = 0; i < 5; i++) {
        assert_ok(PS_LAUNCH(watched, fill, &range, error, PS_BUFFER(out.buffer), PS_U32(i)));
        assert_ok(PS_LAUNCH(watched, fill, &empty, error, PS_BUFFER(out.buffer), PS_U32(i)));
    }
    assert_ok(PS_LAUNCH(watched, other, &range, error, PS_BUFFER(out.buffer)));
    const ps_profile_row *rows = ps_device_profile(watched, &num_rows);
    assert_int_equal(num_rows, 2);
    assert_string_equal(rows[0].kernel, "fill");
    assert_string_equal(rows[1].kernel, "other");
    assert_int_equal(rows[0].launches, 5);
    assert_int_equal(rows[1].launches, 1);
    assert_true(rows[0].flops == 50 && rows[0].bytes == 80 && rows[1].flops == 10);
    assert_true(rows[0].seconds >= 0 && rows[0].seconds < 60);
    test_memory_free(&out);
    ps_device_close(watched);
    assert_ok(ps_device_finish(device, error));
    ps_device_profile(device, &num_rows);
    assert_int_equal(num_rows, 0); /* nobody asked */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(includes_are_expanded),
        cmocka_unit_test(build_logs_name_file_and_line),
        cmocka_unit_test(missing_sources),
        cmocka_unit_test(options_without_room_are_refused),
        cmocka_unit_test(matrix_units_are_tried),
        cmocka_unit_test(launches_reach_the_device),
        cmocka_unit_test(ranges_are_rounded_up),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(large_work_groups_are_refused),
        cmocka_unit_test(too_much_local_memory_is_refused),
        cmocka_unit_test(large_buffers_are_refused),
        cmocka_unit_test(buffers_keep_what_is_written),
        cmocka_unit_test(profile_counts_launches),
    };
    device = test_open_device();
    const int failures =
        cmocka_run_group_tests_name("device", tests, write_kernels, remove_kernels);
    ps_device_close(device);
    return failures;
}
