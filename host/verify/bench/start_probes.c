#include "verify/bench/host_probes.h"

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

/* A command line of next to no work. */
typedef const char *start[MOST_WORDS];

static pspec_status run(const ps_probe_data *data, const start given, ps_error *error) {
    char *words[MOST_WORDS + 3] = {NULL};
    size_t num = 0;
    pid_t child = 0;
    while (num < MOST_WORDS && given[num] != NULL) {
        words[num] = (char *)given[num]; /* the interface is older than const */
        num++;
    }
    if (data->device != NULL) {
        words[num] = (char *)"--device";
        words[num + 1] = (char *)data->device;
    }
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null < 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "/dev/null cannot be opened: %s", strerror(errno));
    }
    const int reason = spawn(data->program, words, null, &child);
    close(null);
    return reason == 0 ? wait_for(child, given[1], error)
                       : ps_fail(error, PSPEC_ERROR_IO, "%s cannot be started: %s", data->program,
                                 strerror(reason));
}

/* ---- what is measured ---------------------------------------------------------------------- */

static const start starts[] = {
    {"pointspec", "power", "--sampler", "white", "-n", "16", "-k", "4", "--engine", "torus_direct"},
    {"pointspec", "power", "--sampler", "white", "-n", "16", "-k", "4", "--engine", "torus_nufft"},
    {"pointspec", "angular", "--sampler", "white-sphere", "-n", "16", "-l", "4", "--engine",
     "sphere_nufft"},
    {"pointspec", "pairs", "--sampler", "white-sphere", "-n", "16", "-l", "4", "--engine",
     "pairs_direct"}};

pspec_status ps_probe_start(ps_probe_data *data, const ps_probe *what, ps_error *error) {
    (void)what;
    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++) {
        PS_TRY(run(data, starts[i], error));
    }
    return PSPEC_OK;
}
