/* Limits of memory, found in folders that look like /proc and /sys/fs/cgroup, and sizes that people
 * type. */
#include "harness.h"

#include "base/memory.h"
#include "base/process/memory_limit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#define MB (1024.0 * 1024)
#define MEMINFO "MemTotal:       16000000 kB\nMemFree:  1 kB\nMemAvailable:    8000000 kB\n"
#define MOUNT_1                                                                                    \
    "40 30 0:30 / /sys/fs/cgroup/memory rw,relatime shared:7 - cgroup cgroup rw,memory\n"
#define MOUNT_2                                                                                    \
    "31 23 0:28 / /sys/fs/cgroup rw,nosuid shared:9 master:2 - cgroup2 cgroup2 rw,nsdelegate\n"
#define OTHERS                                                                                     \
    "22 1 8:1 / / rw - ext4 /dev/sda rw\n33 31 0:30 / /sys/fs/cgroup/cpu rw - cgroup cgroup "      \
    "rw,cpu\n"

typedef struct fake_file {
    const char *path, *text;
} fake_file;

typedef struct fake_case {
    const char *name;
    fake_file files[12];
    ps_memory_kind kind;
    double limit, used; /* in MB */
    const char *place;
} fake_case;

static const fake_case cases[] = {
    {"the machine",
     {{"/proc/meminfo", MEMINFO}},
     PS_MEMORY_OF_MACHINE,
     15625,
     7812.5,
     "MemAvailable of /proc/meminfo"},
    {"version 2, the own group",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "0::/user/job\n"},
      {"/proc/self/mountinfo", OTHERS MOUNT_2},
      {"/sys/fs/cgroup/user/job/memory.max", "419430400\n"},
      {"/sys/fs/cgroup/user/job/memory.high", "max\n"},
      {"/sys/fs/cgroup/user/job/memory.current", "104857600\n"},
      {"/sys/fs/cgroup/user/job/memory.stat",
       "anon 1\nfile 9\ninactive_file 20971520\nactive_file 41943040\n"}},
     PS_MEMORY_CGROUP_MAX,
     400,
     60, /* 100 - 20 - 40 / 2 */
     "/sys/fs/cgroup/user/job/memory.max"},
    {"version 2, a group around it leaves less",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "0::/user/job/part\n"},
      {"/proc/self/mountinfo", MOUNT_2},
      {"/sys/fs/cgroup/user/job/part/memory.max", "max\n"},
      {"/sys/fs/cgroup/user/job/part/memory.current", "1048576\n"},
      {"/sys/fs/cgroup/user/job/memory.max", "838860800\n"},
      {"/sys/fs/cgroup/user/job/memory.current", "104857600\n"},
      {"/sys/fs/cgroup/user/memory.max", "943718400\n"},
      {"/sys/fs/cgroup/user/memory.current", "838860800\n"}},
     PS_MEMORY_CGROUP_MAX,
     900,
     800,
     "/sys/fs/cgroup/user/memory.max"},
    {"version 2, high",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "0::/a\n"},
      {"/proc/self/mountinfo", MOUNT_2},
      {"/sys/fs/cgroup/a/memory.max", "max\n"},
      {"/sys/fs/cgroup/a/memory.high", "209715200\n"},
      {"/sys/fs/cgroup/a/memory.current", "1048576\n"}},
     PS_MEMORY_CGROUP_HIGH,
     200,
     1,
     "/sys/fs/cgroup/a/memory.high"},
    {"version 2, seen from inside a container",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "0::/\n"},
      {"/proc/self/mountinfo", "31 23 0:28 /../.. /sys/fs/cgroup ro - cgroup2 cgroup rw\n"},
      {"/sys/fs/cgroup/memory.max", "314572800\n"}},
     PS_MEMORY_CGROUP_MAX,
     300,
     0,
     "/sys/fs/cgroup/memory.max"},
    {"version 1 beside an empty version 2, caches of all groups below",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "9:cpu,cpuacct:/else\n4:memory:/job\n0::/\n"},
      {"/proc/self/mountinfo",
       OTHERS MOUNT_1 "38 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n"},
      {"/sys/fs/cgroup/memory/job/memory.limit_in_bytes", "524288000\n"},
      {"/sys/fs/cgroup/memory/job/memory.usage_in_bytes", "104857600\n"},
      {"/sys/fs/cgroup/memory/job/memory.stat",
       "cache 7\ninactive_file 1\ntotal_inactive_file 52428800\ntotal_active_file 0\n"},
      {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n"}},
     PS_MEMORY_CGROUP_1,
     500,
     50,
     "/sys/fs/cgroup/memory/job/memory.limit_in_bytes"},
    {"version 1, the mount is the group",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "4:memory:/docker/0123\n"},
      {"/proc/self/mountinfo",
       "40 30 0:30 /docker/0123 /sys/fs/cg\\040roup ro - cgroup cgroup rw,memory\n"},
      {"/sys/fs/cg roup/memory.limit_in_bytes", "104857600\n"},
      {"/sys/fs/cg roup/memory.usage_in_bytes", "209715200\n"}},
     PS_MEMORY_CGROUP_1,
     100,
     200,
     "/sys/fs/cg roup/memory.limit_in_bytes"},
    {"a limit above all there is",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "0::/a\n"},
      {"/proc/self/mountinfo", MOUNT_2},
      {"/sys/fs/cgroup/a/memory.max", "1099511627776\n"},
      {"/sys/fs/cgroup/a/memory.current", "1\n"}},
     PS_MEMORY_OF_MACHINE,
     15625,
     7812.5,
     "MemAvailable of /proc/meminfo"},
    {"what makes no sense",
     {{"/proc/meminfo", MEMINFO},
      {"/proc/self/cgroup", "nonsense\n:::\n0:\n\n-1:memory\n0::a\n0::/a"},
      {"/proc/self/mountinfo", "x\n - \n - cgroup2 \n31 23 - cgroup2 x y\n" MOUNT_2},
      {"/sys/fs/cgroup/a/memory.max", "-5\n"},
      {"/sys/fs/cgroup/a/memory.high", ""},
      {"/sys/fs/cgroup/memory.max", "12 monkeys\n"},
      {"/sys/fs/cgroup/memory.high", "0x10\n"}},
     PS_MEMORY_CGROUP_MAX, /* the number in front of the monkeys */
     12 / MB,
     0,
     "/sys/fs/cgroup/memory.max"},
    {"an old kernel",
     {{"/proc/meminfo", "MemTotal: 1024 kB\n"}},
     PS_MEMORY_OF_MACHINE,
     1,
     0,
     "MemAvailable of /proc/meminfo"},
};

static void make_file(const char *root, const fake_file *file) {
    char path[512];
    snprintf(path, sizeof path, "%s%s", root, file->path);
    for (char *slash = strchr(path + strlen(root) + 1, '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
    FILE *const out = fopen(path, "w");
    assert_non_null(out);
    fputs(file->text, out);
    fclose(out);
}

static void least_limits(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char root[] = "/tmp/pointspec-memory-XXXXXX";
        char command[64];
        ps_memory_limits limits;
        assert_non_null(mkdtemp(root));
        for (const fake_file *file = cases[i].files; file->path != NULL; file++) {
            make_file(root, file);
        }
        ps_memory_limits_find(&limits, root);
        snprintf(command, sizeof command, "rm -r %s", root);
        assert_int_equal(system(command), 0);
        const ps_memory_bound *const least = &limits.bounds[cases[i].kind];
        if (limits.least != (int)cases[i].kind || strcmp(least->place, cases[i].place) != 0 ||
            (double)least->limit != cases[i].limit * MB ||
            (double)least->used != cases[i].used * MB) {
            fail_msg("%s: kind %d, %s, limit %llu, used %llu", cases[i].name, limits.least,
                     least->place, (unsigned long long)least->limit,
                     (unsigned long long)least->used);
        }
    }
}

/* Without any file there is what the system says of itself. */
static void nothing_to_read(void **state) {
    (void)state;
    ps_memory_limits limits;
    ps_memory_limits_find(&limits, "/nowhere/at all");
    assert_int_equal(limits.least, PS_MEMORY_OF_MACHINE);
    assert_true(ps_memory_left(&limits.bounds[PS_MEMORY_OF_MACHINE]) > 0);
    assert_true(ps_memory_left(&limits.bounds[PS_MEMORY_CGROUP_1]) == UINT64_MAX);
}

/* A line that is longer than any buffer hides nothing behind it, nor is its end a line. */
static void long_lines(void **state) {
    (void)state;
    enum { LONG = 10000 };
    static char text[LONG + 200];
    memset(text, 'x', LONG);
    snprintf(text + LONG, sizeof text - LONG, " - cgroup2 x y\n%s", MOUNT_2);
    const fake_file files[] = {{"/proc/self/cgroup", "0::/a\n"},
                               {"/proc/self/mountinfo", text},
                               {"/sys/fs/cgroup/a/memory.max", "1048576\n"}};
    char root[] = "/tmp/pointspec-memory-XXXXXX";
    char command[64];
    ps_memory_limits limits;
    assert_non_null(mkdtemp(root));
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        make_file(root, &files[i]);
    }
    ps_memory_limits_find(&limits, root);
    snprintf(command, sizeof command, "rm -r %s", root);
    assert_int_equal(system(command), 0);
    assert_int_equal(limits.least, PS_MEMORY_CGROUP_MAX);
}

/* Limits of the process, and that arrays beyond them are refused before they are used: the system
 * would give them. */
static void limits_of_the_process(void **state) {
    (void)state;
    const struct {
        __rlimit_resource_t resource;
        ps_memory_kind kind;
        const char *place;
    } all[] = {{RLIMIT_AS, PS_MEMORY_ADDRESS_SPACE, "ulimit -v"},
               {RLIMIT_DATA, PS_MEMORY_DATA, "ulimit -d"}};
    for (size_t i = 0; i < 2; i++) {
        struct rlimit before;
        struct rlimit small;
        ps_memory_limits limits;
        ps_memory_room room;
        char text[PS_MEMORY_TEXT];
        assert_int_equal(getrlimit(all[i].resource, &before), 0);
        small = before;
        small.rlim_cur = (rlim_t)1 << 40;
        if (before.rlim_max != RLIM_INFINITY && before.rlim_max < small.rlim_cur) {
            skip();
        }
        assert_int_equal(setrlimit(all[i].resource, &small), 0);
        ps_memory_limits_find(&limits, "");
        assert_int_equal(setrlimit(all[i].resource, &before), 0);
        const ps_memory_bound *const bound = &limits.bounds[all[i].kind];
        assert_true(bound->limit == (uint64_t)1 << 40);
        assert_true(bound->used > 0);
        ps_memory_describe(&limits, all[i].kind, text, sizeof text);
        assert_int_equal(strncmp(text, all[i].place, strlen(all[i].place)), 0);
        assert_non_null(strstr(text, ": 1T, of which "));
        ps_memory_room_find(&room, 0);
        assert_true(room.bytes < UINT64_MAX && room.by[0] != '\0');
    }
}

static void arrays_are_refused(void **state) {
    (void)state;
    void *array = NULL;
    size_t capacity = 0;
    ps_error said = {0};
    ps_memory_room room;
    ps_memory_room_find(&room, 0);
    const size_t too_many = (size_t)(room.bytes / 8 + room.bytes / 64);
    assert_int_equal(ps_allocate(&array, too_many, 8, "points", &said), PSPEC_ERROR_MEMORY);
    double numbers[1];
    double *typed = numbers;
    ps_error again = {0};
    assert_int_equal(PS_NEW(&typed, too_many, "points", &again), PSPEC_ERROR_MEMORY);
    assert_null(typed);
    assert_string_equal(again.message, said.message);
    assert_ok(PS_NEW(&typed, 3, "points", error));
    assert_true(typed[0] == 0 && typed[2] == 0);
    free(typed);
    assert_null(array);
    assert_non_null(strstr(said.message, "not enough memory for points: they take "));
    assert_non_null(strstr(said.message, room.by));
    assert_int_equal(ps_grow(&array, &capacity, too_many, 8, "weights", &said), PSPEC_ERROR_MEMORY);
    assert_null(array);
    assert_non_null(strstr(said.message, "not enough memory for weights: they take "));
}

static void sizes(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double bytes; /* 0: refused */
        const char *shown;
    } all[] = {{"400M", 400 * MB, "400M"},
               {"2G", 2048 * MB, "2G"},
               {"1.5g", 1536 * MB, "1.5G"},
               {"1k", 1024, "1K"},
               {"3T", 3 * 1024 * 1024 * MB, "3T"},
               {"2e5", 2e5, "195.3K"},
               {"1000", 1000, "1000"},
               {"0", 0, NULL},
               {"-1M", 0, NULL},
               {"M", 0, NULL},
               {"", 0, NULL},
               {"4X", 0, NULL},
               {"4MB", 0, NULL},
               {"nanM", 0, NULL},
               {"infG", 0, NULL},
               {"9999999T", 0, NULL},
               {"1.5", 0, NULL},
               {"0000000000000000000000000000000000000000000000000001M", 0, NULL}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        uint64_t bytes = 0;
        char text[PS_SIZE_TEXT];
        ps_error said = {0};
        const pspec_status status = ps_parse_size(all[i].text, "memory", &bytes, &said);
        if (all[i].bytes > 0) {
            assert_int_equal(status, PSPEC_OK);
            assert_true((double)bytes == all[i].bytes);
            assert_string_equal(ps_size_show(text, all[i].bytes), all[i].shown);
        } else {
            assert_int_equal(status, PSPEC_ERROR_INVALID_ARGUMENT);
            assert_non_null(strstr(said.message, "is not a size above 0, such as 400M"));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(least_limits),       cmocka_unit_test(nothing_to_read),
        cmocka_unit_test(long_lines),         cmocka_unit_test(limits_of_the_process),
        cmocka_unit_test(arrays_are_refused), cmocka_unit_test(sizes),
    };
    return cmocka_run_group_tests_name("memory_limit", tests, NULL, NULL);
}
