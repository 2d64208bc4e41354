/* How much memory this process may still take, and which limit is the least: what the machine has
 * available, the limits of memory cgroups (versions 1 and 2; of the own group and of every group
 * around it), and ulimit -v and -d.
 *
 * What is free changes from minute to minute. So it may make batches smaller or refuse work with a
 * sentence, and never decides what is computed: only a limit that somebody typed does that
 * (plan/choose.h).
 */
#ifndef PS_BASE_PROCESS_MEMORY_LIMIT_H
#define PS_BASE_PROCESS_MEMORY_LIMIT_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum ps_memory_kind {
    PS_MEMORY_OF_MACHINE = 0, /* MemTotal and MemAvailable of /proc/meminfo */
    PS_MEMORY_CGROUP_MAX,     /* version 2: beyond memory.max the kernel kills */
    PS_MEMORY_CGROUP_HIGH,    /* version 2: beyond memory.high it all but stops */
    PS_MEMORY_CGROUP_1,       /* version 1: memory.limit_in_bytes */
    PS_MEMORY_ADDRESS_SPACE,  /* ulimit -v */
    PS_MEMORY_DATA,           /* ulimit -d */
    PS_NUM_MEMORY_KINDS
} ps_memory_kind;

enum { PS_MEMORY_PLACE = 256 };

/* One limit; limit 0: there is none of this kind. Caches of files, which the kernel gives back, are
 * not used. */
typedef struct ps_memory_bound {
    uint64_t limit, used;
    char place[PS_MEMORY_PLACE]; /* the file or the command that sets it */
} ps_memory_bound;

typedef struct ps_memory_limits {
    ps_memory_bound bounds[PS_NUM_MEMORY_KINDS]; /* of every kind the one that leaves the least */
    int least; /* the kind that leaves the least; -1: nothing is known */
} ps_memory_limits;

/* root: a folder with proc and, where /proc/self/mountinfo says so, cgroups; "" is this machine.
 * What cannot be read or understood is left out. */
void ps_memory_limits_find(ps_memory_limits *out, const char *root);

/* What a limit leaves; UINT64_MAX where there is none. */
uint64_t ps_memory_left(const ps_memory_bound *bound);

/* A sentence without its full stop, as in "/sys/fs/cgroup/memory.max: 400M, of which 20M are used".
 */
enum { PS_MEMORY_TEXT = PS_MEMORY_PLACE + 128 };
void ps_memory_describe(const ps_memory_limits *limits, ps_memory_kind kind, char *text,
                        size_t size);

/* What may still be taken and what says so ("memory.max of ..."); bytes UINT64_MAX: no limit is
 * known. */
typedef struct ps_memory_room {
    uint64_t bytes;
    char by[PS_MEMORY_PLACE];
} ps_memory_room;

/* Finds the room that this machine has; what the asker holds already, and counts, is added. */
void ps_memory_room_find(ps_memory_room *out, uint64_t held);

/* What something may take of which nobody knows whether it has an end. */
typedef struct ps_memory_share {
    double bytes;
    char by[PS_MEMORY_PLACE + 32]; /* "the limit of --memory", "half of what ... leaves" */
} ps_memory_share;

/* So much as somebody typed, or half of what is free where that is 0. Looking takes 0.1 ms. */
void ps_memory_share_find(ps_memory_share *out, uint64_t typed, uint64_t held);
/* Below this nobody looks. */
enum { PS_LEAST_SHARE = 16 << 20 };

/* Units of sizes are powers of 1024. */
#define PS_SIZE_UNITS "KMGT"
enum { PS_SIZE_STEP = 1024 };

/* Bytes as --memory takes them and with four digits: "400M", "1.5G". */
enum { PS_SIZE_TEXT = 24 };
const char *ps_size_show(char text[PS_SIZE_TEXT], double bytes);

#endif
