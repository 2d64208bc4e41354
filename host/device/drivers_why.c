#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */

/* Why there is no device: what is said to somebody whose drivers do not start. */
#include "device/drivers.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

static const char no_device_needed[] = "; --engine host_direct needs no device";

/* PoCL 3.1 writes the text of a program, with OpenCL's own headers, each time that it builds one,
 * kept or not: 490 KB; a limit of 600 KiB ended it, 1000 KiB did not. */
static const uint64_t least_file_bytes = UINT64_C(1) << 20;
/* That are free, for PoCL and the linker that it starts (binutils 2.40): 10 ended the process, 11
 * did not; the rest is for what a command opens meanwhile. */
enum { LEAST_DESCRIPTORS = 16 };

/* ---- PoCL's cache --------------------------------------------------------------------------- */

/* NULL: not set, or empty */
static const char *variable(const char *name) {
    const char *const value = getenv(name);
    return value != NULL && value[0] != '\0' ? value : NULL;
}

pspec_status ps_drivers_pocl_cache(ps_text *out, ps_error *error) {
    const char *const own = variable("POCL_CACHE_DIR");
    const char *const all = variable("XDG_CACHE_HOME");
    const char *const home = variable("HOME");
    if (own != NULL) {
        ps_text_append(out, "%s", own);
    } else if (all != NULL) {
        ps_text_append(out, "%s/pocl/kcache", all);
    } else if (home != NULL) {
        ps_text_append(out, "%s/.cache/pocl/kcache", home);
    }
    return ps_text_check(out, error);
}

/* Whether the first folder of path that is missing can be made, or path be written into; 0, or
 * errno. Cuts path after the folder that it is about. */
static int try_folder(char *path) {
    for (char *slash = strchr(path + 1, '/');; slash = strchr(slash + 1, '/')) {
        if (slash != NULL) {
            *slash = '\0';
        }
        if (access(path, F_OK) != 0) {
            if (mkdir(path, 0700) != 0) {
                return errno == EEXIST ? 0 : errno; /* somebody else has just made it */
            }
            (void)rmdir(path);
            return 0;
        }
        if (slash == NULL) {
            return access(path, W_OK | X_OK) == 0 ? 0 : errno;
        }
        *slash = '/';
    }
}

static uint64_t bytes_left(const struct statvfs *disk) {
    return (uint64_t)disk->f_bavail * disk->f_frsize;
}

void ps_drivers_pocl_cache_problem(const char *path, ps_text *out) {
    enum {
        MOST_LETTERS = 800
    }; /* PoCL has 1024 for a path, of which names below the folder take some 200 */
    struct statvfs facts;
    const size_t length = strlen(path);
    if (length > MOST_LETTERS) {
        ps_text_append(out,
                       "the name of the folder where PoCL keeps kernels has %zu letters, above its "
                       "limit of about %d: %.40s...",
                       length, MOST_LETTERS, path);
        return;
    }
    char *const trial = length > 0 ? strdup(path) : NULL;
    const int reason = trial != NULL ? try_folder(trial) : 0;
    if (reason != 0) {
        const bool is_whole = strcmp(path, trial) == 0;
        ps_text_append(out, "PoCL cannot keep kernels in %s: %s%s%s", path, is_whole ? "" : trial,
                       is_whole ? "" : ": ", strerror(reason));
    } else if (statvfs(path, &facts) == 0 && bytes_left(&facts) < least_file_bytes) {
        ps_text_append(out,
                       "PoCL cannot keep kernels in %s: its disk has %" PRIu64 " bytes left, and "
                       "to compile takes about %" PRIu64,
                       path, bytes_left(&facts), least_file_bytes);
    }
    free(trial);
}

/* Is a driver of PoCL among those that load? */
static bool has_pocl(const ps_drivers *drivers) {
    for (size_t i = 0; i < drivers->num; i++) {
        if (drivers->drivers[i].problem == NULL &&
            strstr(drivers->drivers[i].library, "pocl") != NULL) {
            return true;
        }
    }
    return false;
}

/* ---- limits of the process ------------------------------------------------------------------ */

/* What PoCL 3.1 with LLVM 14 maps, and of each of its threads the stack and the arena of malloc:
 * measured with (ulimit -v N; pointspec devices) and VmPeak in /proc/PID/status, and rounded up. */
static const uint64_t driver_bytes = UINT64_C(256) << 20;
static const uint64_t thread_bytes = UINT64_C(16) << 20;

/* The part of it that can be written to, measured with ulimit -d; and the least limit of that with
 * which PoCL, which takes it for its memory, goes on: 128 MiB, and what it has by then. */
static const uint64_t data_bytes = UINT64_C(80) << 20;
static const uint64_t least_data_limit = UINT64_C(160) << 20;

/* Threads of a driver, which compile, have stacks of the limit: 100 KiB did with kernels of the
 * torus, 64 KiB did not. */
static const uint64_t least_stack_limit = UINT64_C(256) << 10;

/* False: there is no limit. */
static bool has_limit(int resource, uint64_t *bytes) {
    struct rlimit limit;
    const bool is_known = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    *bytes = is_known ? (uint64_t)limit.rlim_cur : 0;
    return is_known;
}

/* Whether so many bytes can be mapped now, or more than there are addresses. */
static bool can_map(uint64_t bytes, int protection) {
    if (bytes > SIZE_MAX) {
        return true;
    }
    void *const room =
        mmap(NULL, (size_t)bytes, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room != MAP_FAILED) {
        munmap(room, (size_t)bytes);
    }
    return room != MAP_FAILED;
}

static pspec_status fail_room(uint64_t needed, const char *what, uint64_t limit,
                              const char *command, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_NO_DEVICE,
                   "an OpenCL driver takes about %" PRIu64 " bytes of %s, which the limit of "
                   "%" PRIu64 " bytes (%s) does not leave%s",
                   needed, what, limit, command, no_device_needed);
}

pspec_status ps_drivers_check_room(ps_error *error) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const uint64_t threads = (processors > 0 ? (uint64_t)processors : 1) * thread_bytes;
    uint64_t limit = 0;
    if (has_limit(RLIMIT_AS, &limit) && !can_map(driver_bytes + threads, PROT_NONE)) {
        return fail_room(driver_bytes + threads, "address space", limit, "ulimit -v", error);
    }
    if (has_limit(RLIMIT_DATA, &limit) &&
        (limit < least_data_limit || !can_map(data_bytes + threads, PROT_READ | PROT_WRITE))) {
        const uint64_t needed = data_bytes + threads;
        return fail_room(needed < least_data_limit ? least_data_limit : needed, "data", limit,
                         "ulimit -d", error);
    }
    if (has_limit(RLIMIT_STACK, &limit) && limit < least_stack_limit) {
        return fail_room(least_stack_limit, "stack for each thread", limit, "ulimit -s", error);
    }
    return PSPEC_OK;
}

pspec_status ps_drivers_fail_memory(const char *call, ps_error *error) {
    uint64_t limit = 0;
    return has_limit(RLIMIT_AS, &limit)
               ? ps_fail(error, PSPEC_ERROR_NO_DEVICE,
                         "an OpenCL driver found no memory within the limit of %" PRIu64
                         " bytes of address space (ulimit -v)%s",
                         limit, no_device_needed)
               : ps_fail(error, PSPEC_ERROR_DEVICE, "%s failed: CL_OUT_OF_HOST_MEMORY", call);
}

/* ---- the sentence --------------------------------------------------------------------------- */

/* Nothing is listed, or not where it is looked for. */
static void explain_list(const ps_drivers *drivers, ps_text *out) {
    if (drivers->variable == NULL && (drivers->problem == NULL || drivers->is_missing)) {
        ps_text_append(out,
                       "no OpenCL driver found: install the package pocl-opencl-icd (runs on any "
                       "CPU) or the driver package of your GPU");
    } else if (drivers->problem != NULL) {
        ps_text_append(out, "no OpenCL driver can be found: %s%s%s cannot be read: %s",
                       drivers->variable != NULL ? drivers->variable : "",
                       drivers->variable != NULL ? " is set, and " : "", drivers->place,
                       drivers->problem);
    } else {
        ps_text_append(out, "no OpenCL driver found: %s names %s, where no file *.icd is",
                       drivers->variable, drivers->place);
    }
}

/* Some are listed, and none loads. */
static void explain_libraries(const ps_drivers *drivers, ps_text *out) {
    ps_text_append(out, "no OpenCL driver starts: ");
    for (size_t i = 0; i < drivers->num; i++) {
        const ps_driver *const driver = &drivers->drivers[i];
        ps_text_append(out, "%s%s: %s", i > 0 ? "; " : "", driver->file, driver->problem);
    }
}

/* Some load, and none has a device. */
static void explain_devices(const ps_drivers *drivers, ps_text *out) {
    const char *const wanted = getenv("POCL_DEVICES");
    ps_text folder = {0};
    ps_text problem = {0};
    ps_error ignored = {0};
    if (ps_drivers_pocl_cache(&folder, &ignored) == PSPEC_OK) {
        ps_drivers_pocl_cache_problem(ps_text_string(&folder), &problem);
    }
    if (has_pocl(drivers) && wanted != NULL) {
        ps_text_append(out,
                       "no OpenCL device: PoCL makes those that POCL_DEVICES names, \"%s\", and "
                       "there is none of them; unset it",
                       wanted);
    } else if (has_pocl(drivers) && problem.length > 0) {
        ps_text_append(out, "no OpenCL device: %s; POCL_CACHE_DIR names another folder",
                       ps_text_string(&problem));
    } else {
        ps_text_append(out, "no OpenCL device: %zu of the drivers in %s loads, and has none",
                       drivers->num, drivers->place);
    }
    ps_text_free(&folder);
    ps_text_free(&problem);
}

pspec_status ps_drivers_fail(ps_error *error) {
    ps_drivers drivers;
    ps_text text = {0};
    pspec_status status = ps_drivers_look(&drivers, error);
    size_t num_loaded = 0;
    for (size_t i = 0; i < drivers.num; i++) {
        num_loaded += drivers.drivers[i].problem == NULL ? 1 : 0;
    }
    if (drivers.num == 0) {
        explain_list(&drivers, &text);
    } else if (num_loaded == 0) {
        explain_libraries(&drivers, &text);
    } else {
        explain_devices(&drivers, &text);
    }
    status = status == PSPEC_OK ? ps_text_check(&text, error) : status;
    if (status == PSPEC_OK) {
        status =
            ps_fail(error, PSPEC_ERROR_NO_DEVICE, "%s%s", ps_text_string(&text), no_device_needed);
    }
    ps_text_free(&text);
    ps_drivers_free(&drivers);
    return status;
}

/* How many descriptors are free, as far as that matters. */
static int free_descriptors(uint64_t limit) {
    int num = 0;
    for (int i = 0; (uint64_t)i < limit && num < LEAST_DESCRIPTORS; i++) {
        num += fcntl(i, F_GETFD) < 0 ? 1 : 0;
    }
    return num;
}

static pspec_status check_files(ps_error *error) {
    uint64_t limit = 0;
    if (has_limit(RLIMIT_FSIZE, &limit) && limit < least_file_bytes) {
        return fail_room(least_file_bytes, "a file while it compiles", limit, "ulimit -f", error);
    }
    if (has_limit(RLIMIT_NOFILE, &limit) && free_descriptors(limit) < LEAST_DESCRIPTORS) {
        return ps_fail(error, PSPEC_ERROR_NO_DEVICE,
                       "PoCL takes up to %d files at a time to compile kernels, of which the limit "
                       "of %" PRIu64 " (ulimit -n) leaves %d%s",
                       LEAST_DESCRIPTORS, limit, free_descriptors(limit), no_device_needed);
    }
    return PSPEC_OK;
}

pspec_status ps_drivers_check_pocl(ps_error *error) {
    ps_text folder = {0};
    ps_text problem = {0};
    PS_TRY(check_files(error));
    pspec_status status = ps_drivers_pocl_cache(&folder, error);
    if (status == PSPEC_OK) {
        ps_drivers_pocl_cache_problem(ps_text_string(&folder), &problem);
        status = ps_text_check(&problem, error);
    }
    if (status == PSPEC_OK && problem.length > 0) {
        status = ps_fail(error, PSPEC_ERROR_NO_DEVICE, "%s; POCL_CACHE_DIR names another folder%s",
                         ps_text_string(&problem), no_device_needed);
    }
    ps_text_free(&folder);
    ps_text_free(&problem);
    return status;
}
