#include "verify/bench/start_probes.h"

#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX wants it declared by whoever uses it */

enum { MOST_WORDS = 12 };

/* ---- a process ----------------------------------------------------------------------------- */

/* Its standard streams are all /dev/null. 0, or the errno of what failed. */
static int spawn(const char *program, char *const *words, int null, pid_t *child) {
    posix_spawn_file_actions_t actions;
    int reason = posix_spawn_file_actions_init(&actions);
    if (reason != 0) {
        return reason;
    }
    for (int i = 0; i < 3 && reason == 0; i++) {
        reason = posix_spawn_file_actions_adddup2(&actions, null, i);
    }
    if (reason == 0) {
        reason = posix_spawn(child, program, &actions, NULL, words, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

static pspec_status wait_for(pid_t child, const char *command, ps_error *error) {
    int state = 0;
    pid_t ended = 0;
    do {
        ended = waitpid(child, &state, 0);
    } while (ended < 0 && errno == EINTR);
    return ended == child && WIFEXITED(state) && WEXITSTATUS(state) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO,
                         "a start of this program could not be measured: \"%s\" did not end well",
                         command);
}

/* A command line of next to no work, and the kernels that it loads (engines' work,
 * host/engines/engine.h). */
typedef struct start {
    const char *words[MOST_WORDS];
    bool takes_device;
    double kernels;
} start;

static pspec_status run(const ps_probe_data *data, const start *what, ps_error *error) {
    char *words[MOST_WORDS + 3] = {NULL};
    size_t num = 0;
    pid_t child = 0;
    while (num < MOST_WORDS && what->words[num] != NULL) {
        words[num] = (char *)what->words[num]; /* the interface is older than const */
        num++;
    }
    if (what->takes_device && data->device != NULL) {
        words[num] = (char *)"--device";
        words[num + 1] = (char *)data->device;
    }
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null < 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "/dev/null cannot be opened: %s", strerror(errno));
    }
    const int reason = spawn(data->program, words, null, &child);
    close(null);
    return reason == 0 ? wait_for(child, what->words[1], error)
                       : ps_fail(error, PSPEC_ERROR_IO, "%s cannot be started: %s", data->program,
                                 strerror(reason));
}

/* ---- what is measured ---------------------------------------------------------------------- */

static const start of_program = {{"pointspec", "--version"}, false, 0};
static const start of_driver = {{"pointspec", "devices"}, false, 0};
static const start of_kernels[] = {
    {{"pointspec", "power", "--sampler", "white", "-n", "16", "-k", "4", "--engine",
      "torus_direct"},
     true,
     6},
    {{"pointspec", "power", "--sampler", "white", "-n", "16", "-k", "4", "--engine", "torus_nufft"},
     true,
     3},
    {{"pointspec", "angular", "--sampler", "white-sphere", "-n", "16", "-l", "4", "--engine",
      "sphere_nufft"},
     true,
     4},
    {{"pointspec", "pairs", "--sampler", "white-sphere", "-n", "16", "-l", "4", "--engine",
      "pairs_direct"},
     true,
     2}};
enum { NUM_JOBS = sizeof of_kernels / sizeof of_kernels[0] };

static pspec_status run_jobs(const ps_probe_data *data, double *kernels, ps_error *error) {
    for (size_t i = 0; i < NUM_JOBS; i++) {
        PS_TRY(run(data, &of_kernels[i], error));
        *kernels += of_kernels[i].kernels;
    }
    return PSPEC_OK;
}

pspec_status ps_probe_start(ps_probe_data *data, const ps_probe *what, double *predicted,
                            ps_error *error) {
    const double begin = ps_clock_seconds();
    double units = what->kind == PS_HOST_KERNEL ? 0 : 1;
    pspec_status status = PSPEC_OK;
    if (what->kind == PS_HOST_KERNEL) {
        status = run_jobs(data, &units, error);
        data->unmeasured = NUM_JOBS * (data->start + data->driver);
    } else if (what->kind == PS_HOST_DRIVER) {
        status = run(data, &of_driver, error);
        data->unmeasured = data->start;
        data->driver = ps_clock_seconds() - begin - data->start;
    } else {
        status = run(data, &of_program, error);
        data->start = ps_clock_seconds() - begin;
    }
    *predicted = ps_host_seconds(NULL, what->kind, units);
    return status;
}
