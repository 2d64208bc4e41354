#include "base/process/memory_limit.h"

#include "base/process/proc_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

uint64_t ps_memory_left(const ps_memory_bound *bound) {
    return bound->limit == 0            ? UINT64_MAX
           : bound->limit > bound->used ? bound->limit - bound->used
                                        : 0;
}

/* Keeps the one that leaves less. */
static void consider(ps_memory_limits *out, ps_memory_kind kind, uint64_t limit, uint64_t used,
                     const char *place) {
    ps_memory_bound *const bound = &out->bounds[kind];
    const ps_memory_bound one = {.limit = limit > 0 ? limit : 1, .used = used};
    if (ps_memory_left(&one) < ps_memory_left(bound)) {
        *bound = one;
        snprintf(bound->place, sizeof bound->place, "%.*s", PS_MEMORY_PLACE - 1, place);
    }
}

/* ---- the machine --------------------------------------------------------------------------- */

static void find_machine(ps_memory_limits *out, const char *root) {
    const uint64_t unit = 1024; /* "kB" */
    uint64_t total = 0;
    uint64_t available = 0;
    if (!ps_proc_entry(root, "/proc/meminfo", "MemTotal:", &total)) {
        const long pages = sysconf(_SC_PHYS_PAGES);
        const long page_bytes = sysconf(_SC_PAGESIZE);
        if (pages > 0 && page_bytes > 0) {
            consider(out, PS_MEMORY_OF_MACHINE, (uint64_t)pages * (uint64_t)page_bytes, 0,
                     "this machine");
        }
        return;
    }
    if (!ps_proc_entry(root, "/proc/meminfo", "MemAvailable:", &available) || available > total) {
        available = total;
    }
    consider(out, PS_MEMORY_OF_MACHINE, total * unit, (total - available) * unit,
             "MemAvailable of /proc/meminfo");
}

/* ---- cgroups ------------------------------------------------------------------------------- */

/* The files of a version of cgroups. */
typedef struct version {
    bool is_second;
    const char *usage, *inactive, *active;
    struct {
        const char *file;
        ps_memory_kind kind;
    } limits[2];
} version;

static const version versions[] = {
    {false,
     "/memory.usage_in_bytes",
     "total_inactive_file",
     "total_active_file",
     {{"/memory.limit_in_bytes", PS_MEMORY_CGROUP_1}}},
    {true,
     "/memory.current",
     "inactive_file",
     "active_file",
     {{"/memory.max", PS_MEMORY_CGROUP_MAX}, {"/memory.high", PS_MEMORY_CGROUP_HIGH}}}};

/* What a group uses without the caches of files that the kernel takes back first: those that were
 * not touched lately, and half of the others, as the kernel itself counts for MemAvailable at
 * worst. */
static uint64_t used_by(const version *cgroups, const char *root, const char *group) {
    char path[PS_PROC_PATH];
    uint64_t used = 0;
    uint64_t inactive = 0;
    uint64_t active = 0;
    if (!ps_proc_join(path, group, cgroups->usage) || !ps_proc_number(root, path, &used) ||
        !ps_proc_join(path, group, "/memory.stat")) {
        return used;
    }
    (void)ps_proc_entry(root, path, cgroups->inactive, &inactive);
    (void)ps_proc_entry(root, path, cgroups->active, &active);
    const uint64_t given_back = inactive + active / 2;
    return used > given_back ? used - given_back : 0;
}

static void find_limits(ps_memory_limits *out, const version *cgroups, const char *root,
                        const char *group) {
    const uint64_t no_limit = (uint64_t)1 << 60; /* version 1 writes 2^63 less a page */
    for (size_t i = 0; i < 2 && cgroups->limits[i].file != NULL; i++) {
        char path[PS_PROC_PATH];
        uint64_t limit = 0;
        if (ps_proc_join(path, group, cgroups->limits[i].file) &&
            ps_proc_number(root, path, &limit) && limit < no_limit) {
            consider(out, cgroups->limits[i].kind, limit, used_by(cgroups, root, group), path);
        }
    }
}

/* The own group and those around it, up to the folder where the hierarchy is mounted. */
static void find_groups(ps_memory_limits *out, const version *cgroups, const char *root) {
    char group[PS_PROC_PATH];
    size_t mounted = 0;
    if (!ps_proc_cgroup(root, cgroups->is_second, group, &mounted)) {
        return;
    }
    for (;;) {
        find_limits(out, cgroups, root, group);
        char *const slash = strrchr(group, '/');
        if (slash == NULL || (size_t)(slash - group) < mounted) {
            return;
        }
        *slash = '\0';
    }
}

/* ---- limits of the process ----------------------------------------------------------------- */

/* statm counts in pages: all that is mapped first, and data with stacks as the sixth. */
static void find_process(ps_memory_limits *out, const char *root) {
    static const struct {
        int resource;
        unsigned column;
        ps_memory_kind kind;
        const char *place;
    } bounds[] = {{RLIMIT_AS, 0, PS_MEMORY_ADDRESS_SPACE, "ulimit -v"},
                  {RLIMIT_DATA, 5, PS_MEMORY_DATA, "ulimit -d"}};
    const long page_bytes = sysconf(_SC_PAGESIZE);
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        struct rlimit limit;
        uint64_t pages = 0;
        if (getrlimit(bounds[i].resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
            (void)ps_proc_column(root, "/proc/self/statm", bounds[i].column, &pages);
            consider(out, bounds[i].kind, (uint64_t)limit.rlim_cur, pages * (uint64_t)page_bytes,
                     bounds[i].place);
        }
    }
}

/* ---- all of them --------------------------------------------------------------------------- */

void ps_memory_limits_find(ps_memory_limits *out, const char *root) {
    *out = (ps_memory_limits){.least = -1};
    find_machine(out, root);
    for (size_t i = 0; i < sizeof versions / sizeof versions[0]; i++) {
        find_groups(out, &versions[i], root);
    }
    find_process(out, root);
    for (int kind = 0; kind < PS_NUM_MEMORY_KINDS; kind++) {
        const uint64_t left = ps_memory_left(&out->bounds[kind]);
        if (left < UINT64_MAX &&
            (out->least < 0 || left < ps_memory_left(&out->bounds[out->least]))) {
            out->least = kind;
        }
    }
}

void ps_memory_describe(const ps_memory_limits *limits, ps_memory_kind kind, char *text,
                        size_t size) {
    const ps_memory_bound *const bound = &limits->bounds[kind];
    char limit[PS_SIZE_TEXT];
    char used[PS_SIZE_TEXT];
    char left[PS_SIZE_TEXT];
    if (bound->limit == 0) {
        snprintf(text, size, "no limit");
        return;
    }
    snprintf(text, size, "%s: %s, of which %s are used and %s are left", bound->place,
             ps_size_show(limit, (double)bound->limit), ps_size_show(used, (double)bound->used),
             ps_size_show(left, (double)ps_memory_left(bound)));
}

void ps_memory_room_find(ps_memory_room *out, uint64_t held) {
    ps_memory_limits limits;
    ps_memory_limits_find(&limits, "");
    *out = (ps_memory_room){.bytes = UINT64_MAX};
    if (limits.least >= 0) {
        const ps_memory_bound *const least = &limits.bounds[limits.least];
        const uint64_t left = ps_memory_left(least);
        out->bytes = left < UINT64_MAX - held ? left + held : UINT64_MAX;
        memcpy(out->by, least->place, sizeof out->by);
    }
}

void ps_memory_share_find(ps_memory_share *out, uint64_t typed, uint64_t held) {
    ps_memory_room room;
    if (typed > 0) {
        *out = (ps_memory_share){(double)typed, "the limit of --memory"};
        return;
    }
    ps_memory_room_find(&room, held);
    out->bytes = (double)room.bytes / 2;
    snprintf(out->by, sizeof out->by, "half of what %s leaves", room.by);
}

/* ---- sizes --------------------------------------------------------------------------------- */

const char *ps_size_show(char text[PS_SIZE_TEXT], double bytes) {
    size_t power = 0;
    while (bytes >= PS_SIZE_STEP && power < sizeof PS_SIZE_UNITS - 1) {
        bytes /= PS_SIZE_STEP;
        power++;
    }
    /* As an argument, a place in a constant is an internal error of gcc 12 with -Og -fsanitize. */
    const char unit[] = {power > 0 ? PS_SIZE_UNITS[power - 1] : 0, 0};
    snprintf(text, PS_SIZE_TEXT, "%.4g%s", bytes, unit);
    return text;
}
