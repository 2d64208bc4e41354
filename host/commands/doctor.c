/* pointspec doctor: what works here, and what does not. */
#include "commands/doctor.h"

#include "base/process/memory_limit.h"
#include "base/process/proc_files.h"
#include "base/text.h"
#include "device/drivers.h"
#include "plots/plot.h"
#include "store/cache_folder.h"
#include "store/cache_trust.h"
#include "store/result_cache.h"
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

enum { LINE_BYTES = 512, PATH_BYTES = 4096 /* the most that the system takes */ };

/* ---- caches ---------------------------------------------------------------------------------- */

static void tell_space(const ps_doctor *doctor, const char *topic, const char *folder) {
    struct statvfs facts;
    char text[PS_SIZE_TEXT];
    if (statvfs(folder, &facts) == 0) {
        const double left = (double)facts.f_bavail * (double)facts.f_frsize;
        const double little = 1 << 26; /* bytes, of which a program's kernels take a hundredth */
        ps_doctor_tell(doctor, left < little ? PS_FINDING_NOTE : PS_FINDING_GOOD, topic,
                       "%s has room for %s bytes", folder, ps_size_show(text, left));
    }
}

/* Nothing but time is lost with any of it. */
static void tell_contents(const ps_doctor *doctor, const char *folder) {
    static const struct {
        const char *name, *things;
    } parts[] = {{"results", "results"}, {"sets", "kept sets of samplers"}};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        ps_error reason = {0};
        char path[PATH_BYTES];
        char size[PS_SIZE_TEXT];
        size_t num = 0;
        uint64_t bytes = 0;
        snprintf(path, sizeof path, "%s/%s", folder, parts[i].name);
        if (ps_cache_folder_usage(path, &num, &bytes, &reason) != PSPEC_OK) {
            ps_doctor_tell(doctor, PS_FINDING_NOTE, "cache", "%s", reason.message);
        } else {
            ps_doctor_tell(doctor, PS_FINDING_GOOD, "cache",
                           "%s has %zu %s, %s bytes; rm -r on it empties it", path, num,
                           parts[i].things, ps_size_show(size, (double)bytes));
        }
    }
}

static void tell_own_cache(const ps_doctor *doctor) {
    ps_error reason = {0};
    const char *const folder = doctor->cache_folder;
    if (folder == NULL) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "cache",
                       "no folder: none of POINTSPEC_CACHE_DIR, XDG_CACHE_HOME and HOME is set");
    } else if (ps_cache_check_folder(folder, &reason) != PSPEC_OK) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "cache", "%s", reason.message);
    } else if (access(folder, F_OK) != 0) {
        ps_doctor_tell(
            doctor, errno == ENOENT ? PS_FINDING_GOOD : PS_FINDING_NOTE, "cache", "%s: %s", folder,
            errno == ENOENT ? "not there yet; it is made when it is needed" : strerror(errno));
    } else if (access(folder, R_OK | W_OK | X_OK) != 0) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "cache", "%s cannot be used: %s", folder,
                       strerror(errno));
    } else {
        ps_doctor_tell(doctor, PS_FINDING_GOOD, "cache", "%s can be written by its owner alone",
                       folder);
        tell_contents(doctor, folder);
        tell_space(doctor, "cache", folder);
    }
}

static pspec_status tell_pocl_cache(const ps_doctor *doctor, ps_error *error) {
    ps_text folder = {0};
    ps_text problem = {0};
    const pspec_status status = ps_drivers_pocl_cache(&folder, error);
    if (status == PSPEC_OK && folder.length > 0) {
        ps_drivers_pocl_cache_problem(ps_text_string(&folder), &problem);
        if (problem.length > 0) {
            ps_doctor_tell(doctor, PS_FINDING_NOTE, "kernels", "%s", ps_text_string(&problem));
        } else {
            ps_doctor_tell(doctor, PS_FINDING_GOOD, "kernels", "%s can be written",
                           ps_text_string(&folder));
            tell_space(doctor, "kernels", ps_text_string(&folder));
        }
    }
    ps_text_free(&folder);
    ps_text_free(&problem);
    return status;
}

/* ---- memory, threads, gnuplot ---------------------------------------------------------------- */

static void tell_memory(const ps_doctor *doctor) {
    ps_memory_limits limits;
    char text[PS_MEMORY_TEXT];
    ps_memory_limits_find(&limits, "");
    for (int kind = 0; kind < PS_NUM_MEMORY_KINDS; kind++) {
        if (limits.bounds[kind].limit == 0) {
            continue;
        }
        ps_memory_describe(&limits, (ps_memory_kind)kind, text, sizeof text);
        ps_doctor_tell(doctor, PS_FINDING_GOOD, "memory", "%s%s", text,
                       kind == limits.least ? "; this leaves the least" : "");
    }
}

/* Version 2 of cgroups: "QUOTA PERIOD" in microseconds, or "max PERIOD"; of the own group. */
static void tell_quota(const ps_doctor *doctor) {
    char group[PS_PROC_PATH];
    char path[PS_PROC_PATH];
    size_t mounted = 0;
    uint64_t quota = 0;
    uint64_t period = 0;
    if (ps_proc_cgroup("", true, group, &mounted) && ps_proc_join(path, group, "/cpu.max") &&
        ps_proc_column("", path, 0, &quota) && ps_proc_column("", path, 1, &period) && period > 0) {
        ps_doctor_tell(doctor, PS_FINDING_NOTE, "threads",
                       "%s allows the time of %.3g processors, whatever their number", path,
                       (double)quota / (double)period);
    }
}

static void tell_threads(const ps_doctor *doctor) {
    char allowed[LINE_BYTES];
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    if (ps_proc_text("/proc/self/status", "Cpus_allowed_list", allowed, sizeof allowed)) {
        ps_doctor_tell(doctor, PS_FINDING_GOOD, "threads",
                       "%ld processors are there, and this process may run on number %s", online,
                       allowed);
    } else {
        ps_doctor_tell(doctor, PS_FINDING_GOOD, "threads", "%ld processors are there", online);
    }
    tell_quota(doctor);
}

static void tell_gnuplot(const ps_doctor *doctor) {
    ps_text path = {0};
    ps_error reason = {0};
    const bool is_found = ps_plot_find_gnuplot(&path, &reason) == PSPEC_OK;
    ps_doctor_tell(doctor, is_found ? PS_FINDING_GOOD : PS_FINDING_NOTE, "gnuplot", "%s",
                   is_found ? ps_text_string(&path) : reason.message);
    ps_text_free(&path);
}

/* ---- the command ----------------------------------------------------------------------------- */

static pspec_status examine(const ps_doctor *doctor, ps_error *verdict, ps_error *error) {
    bool is_wrong = false;
    PS_TRY(ps_doctor_devices(doctor, &is_wrong, error));
    tell_own_cache(doctor);
    PS_TRY(tell_pocl_cache(doctor, error));
    tell_memory(doctor);
    tell_threads(doctor);
    tell_gnuplot(doctor);
    if (is_wrong) {
        ps_fail(verdict, PSPEC_ERROR_CHECK,
                "the default device cannot be used; the lines that begin with WRONG say why; "
                "--engine host_direct needs no device");
    }
    return doctor->unwritten->status == PSPEC_OK
               ? PSPEC_OK
               : ps_fail(error, doctor->unwritten->status, "%s", doctor->unwritten->message);
}

/* The folder may be one that is not trusted, which is then a finding. */
static pspec_status run(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error) {
    static const char *const columns[] = {"finding", "topic", "sentence"};
    ps_text folder = {0};
    ps_error unwritten = {0};
    ps_error ignored = {0};
    PS_TRY(ps_request_check_no_files(request, "", error));
    PS_TRY(
        ps_table_create(&out->table, "doctor", columns, sizeof columns / sizeof columns[0], error));
    PS_TRY(ps_lead_add_origin(out->table, NULL, error));
    const bool has_folder = ps_cache_default_directory(&folder, &ignored) == PSPEC_OK;
    const ps_doctor doctor = {request->limits.device, has_folder ? ps_text_string(&folder) : NULL,
                              hooks, out->table, &unwritten};
    const pspec_status status = examine(&doctor, &out->verdict, error);
    ps_text_free(&folder);
    return status;
}

const ps_command ps_command_doctor = {
    .name = "doctor",
    .purpose = "say what works here: drivers, devices, caches, memory, threads, gnuplot",
    .usage = "doctor [options]",
    .description =
        "Looks at what pointspec depends on and says what it finds, a sentence a line: the OpenCL "
        "drivers and why one does not load, whether a kernel builds on every device and computes "
        "what is known, the folders of caches and what they hold, limits of memory, processors, "
        "gnuplot. Lines begin "
        "with ok, with note where something is missing that can be done without, or with WRONG. "
        "The exit status is 0 when the default device works, 3 when it does not.",
    .takes = PS_COMMAND_BIT(doctor),
    .examples = {"pointspec doctor", "pointspec doctor --device cpu"},
    .run = run,
};
