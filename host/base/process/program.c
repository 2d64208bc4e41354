#include "base/process/program.h"

#include "base/memory.h"
#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ; /* POSIX wants it declared by whoever uses it */

/* ---- one that is started -------------------------------------------------------------------- */

static void close_both(const int ends[2]) {
    close(ends[0]);
    close(ends[1]);
}

int ps_pipe_open(int ends[2]) {
    if (pipe(ends) != 0) {
        return errno;
    }
    if (fcntl(ends[0], F_SETFD, FD_CLOEXEC) == 0 && fcntl(ends[1], F_SETFD, FD_CLOEXEC) == 0) {
        return 0;
    }
    const int reason = errno;
    close_both(ends);
    return reason;
}

/* Threads of ours may block signals, which the child is to hear. */
static int set_attributes(posix_spawnattr_t *attributes, bool leads) {
    const short flags = (short)(POSIX_SPAWN_SETSIGMASK | (leads ? POSIX_SPAWN_SETPGROUP : 0));
    sigset_t none;
    sigemptyset(&none);
    int reason = posix_spawnattr_setsigmask(attributes, &none);
    if (reason == 0) {
        reason = posix_spawnattr_setpgroup(attributes, 0);
    }
    return reason == 0 ? posix_spawnattr_setflags(attributes, flags) : reason;
}

int ps_child_start(pid_t *child, const char *path, char *const arguments[],
                   const int descriptors[3], bool leads) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int reason = posix_spawn_file_actions_init(&actions);
    if (reason != 0) {
        return reason;
    }
    reason = posix_spawnattr_init(&attributes);
    if (reason != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return reason;
    }
    reason = set_attributes(&attributes, leads);
    for (int i = 0; i < 3 && reason == 0; i++) {
        reason = posix_spawn_file_actions_adddup2(&actions, descriptors[i], i);
    }
    if (reason == 0) {
        reason = posix_spawn(child, path, &actions, &attributes, arguments, environ);
    }
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

/* ---- a command whose output is read --------------------------------------------------------- */

enum { LINE_BYTES = 200, COMMAND_SHOWN = 120 };
/* Between two looks at standard error; of reads of 4 KiB as many as a pipe holds. */
enum { MILLISECONDS = 10, MOST_READS = 16 };

/* A descriptor is -1 where the stream has ended. */
struct ps_program {
    pid_t child; /* 0: it has ended */
    int output, complaints;
    char command[COMMAND_SHOWN]; /* the beginning, for sentences */
    char line[LINE_BYTES];       /* of standard error, as far as it has come */
    size_t length;
    char last[LINE_BYTES]; /* the last whole line that is not empty */
};

static void close_stream(int *descriptor) {
    if (*descriptor >= 0) {
        close(*descriptor);
    }
    *descriptor = -1;
}

static int start_shell(ps_program *self, const char *command, const int output[2],
                       const int complaints[2]) {
    static const char shell[] = "/bin/sh";
    char name[] = "sh";
    char option[] = "-c";
    ps_text copy = {0}; /* arguments are not constant, for reasons of history */
    ps_text_append(&copy, "%s", command);
    char *const arguments[] = {name, option, copy.data, NULL};
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int descriptors[] = {nothing, output[1], complaints[1]};
    const int reason = copy.failed ? ENOMEM
                       : nothing < 0
                           ? errno
                           : ps_child_start(&self->child, shell, arguments, descriptors, true);
    if (nothing >= 0) {
        close(nothing);
    }
    ps_text_free(&copy);
    return reason;
}

/* Returns 0 or the errno of what failed; then nothing is open. */
static int start(ps_program *self, const char *command) {
    int output[2];
    int complaints[2];
    int reason = ps_pipe_open(output);
    if (reason != 0) {
        return reason;
    }
    reason = ps_pipe_open(complaints);
    if (reason != 0) {
        close_both(output);
        return reason;
    }
    reason = start_shell(self, command, output, complaints);
    close(output[1]);
    close(complaints[1]);
    self->output = output[0];
    self->complaints = complaints[0];
    if (reason != 0) {
        close_stream(&self->output);
        close_stream(&self->complaints);
    }
    return reason;
}

pspec_status ps_program_start(ps_program **out, const char *command, ps_error *error) {
    PS_TRY(PS_NEW(out, 1, "a program", error));
    ps_program *const self = *out;
    snprintf(self->command, sizeof self->command, "%s", command);
    const int reason = start(self, command);
    if (reason != 0) {
        free(self);
        *out = NULL;
        return ps_fail(error, PSPEC_ERROR_IO, "cannot run \"%.*s\": %s", COMMAND_SHOWN, command,
                       strerror(reason));
    }
    return PSPEC_OK;
}

static void keep_line(ps_program *self) {
    if (self->length > 0) {
        memcpy(self->last, self->line, self->length);
        self->last[self->length] = '\0';
    }
    self->length = 0;
}

static pspec_status fail_waiting(const ps_program *self, ps_error *error) {
    const int reason = errno;
    return reason == EINTR ? ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted while \"%s\" ran",
                                     self->command)
                           : ps_fail(error, PSPEC_ERROR_IO, "cannot read what \"%s\" prints: %s",
                                     self->command, strerror(reason));
}

/* One read of standard error, of which the last line stays. */
static pspec_status hear(ps_program *self, ps_error *error) {
    char block[1 << 12];
    const ssize_t got = read(self->complaints, block, sizeof block);
    if (got < 0) {
        return fail_waiting(self, error);
    }
    for (ssize_t i = 0; i < got; i++) {
        if (block[i] == '\n') {
            keep_line(self);
        } else if (self->length + 1 < sizeof self->line) {
            self->line[self->length++] = block[i];
        }
    }
    if (got == 0) {
        keep_line(self);
        close_stream(&self->complaints);
    }
    return PSPEC_OK;
}

/* Events of standard error: the end of the stream is one. */
enum { SAID = POLLIN, SAID_OR_ENDED = POLLIN | POLLHUP };

/* One read, if such an event comes within so many milliseconds. */
static pspec_status hear_within(ps_program *self, int milliseconds, int events, bool *heard,
                                ps_error *error) {
    struct pollfd stream = {.fd = self->complaints, .events = POLLIN};
    if (stream.fd >= 0 && poll(&stream, 1, milliseconds) < 0) {
        return fail_waiting(self, error);
    }
    *heard = (stream.revents & events) != 0;
    return *heard ? hear(self, error) : PSPEC_OK;
}

static pspec_status hear_what_is_there(ps_program *self, int events, ps_error *error) {
    bool heard = true;
    for (unsigned i = 0; heard && i < MOST_READS; i++) {
        PS_TRY(hear_within(self, 0, events, &heard, error));
    }
    return PSPEC_OK;
}

/* Looks, and leaves its status to be taken. */
static bool has_ended(pid_t child) {
    siginfo_t info = {.si_pid = 0};
    return waitid(P_PID, (id_t)child, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

/* Standard output has ended: hears what the command says till its own end. What it has left behind
 * may go on, and hold the stream open. */
static pspec_status wait_for_end(ps_program *self, int *state, ps_error *error) {
    bool heard = false;
    while (self->complaints >= 0 && !has_ended(self->child)) {
        PS_TRY(hear_within(self, MILLISECONDS, SAID_OR_ENDED, &heard, error));
    }
    PS_TRY(hear_what_is_there(self, SAID_OR_ENDED, error));
    const pid_t ended = waitpid(self->child, state, 0);
    if (ended < 0 && errno == EINTR) {
        return fail_waiting(self, error);
    }
    if (ended < 0) {
        *state = 0; /* where SIGCHLD is ignored the state is lost */
    }
    self->child = 0;
    keep_line(self);
    return PSPEC_OK;
}

static pspec_status finish(ps_program *self, ps_error *error) {
    int state = 0;
    char how[64];
    if (self->child == 0) {
        return PSPEC_OK;
    }
    PS_TRY(wait_for_end(self, &state, error));
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0) {
        return PSPEC_OK;
    }
    if (WIFSIGNALED(state)) {
        snprintf(how, sizeof how, "was ended by signal %d", WTERMSIG(state));
    } else {
        snprintf(how, sizeof how, "failed with exit status %d", WEXITSTATUS(state));
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" %s%s%s", self->command, how,
                   self->last[0] != '\0' ? "; its last line: " : ", and said nothing", self->last);
}

pspec_status ps_program_read(ps_program *program, void *out, size_t max_bytes, size_t *count,
                             ps_error *error) {
    *count = 0;
    while (program->output >= 0) {
        struct pollfd stream = {.fd = program->output, .events = POLLIN};
        const int num = poll(&stream, 1, MILLISECONDS);
        const ssize_t got = num > 0 ? read(program->output, out, max_bytes) : 0;
        if (num < 0 || got < 0) {
            return fail_waiting(program, error);
        }
        *count = (size_t)got;
        if (got > 0) {
            return PSPEC_OK;
        }
        if (num == 0) {
            /* a pipe of complaints that is full would stop the command */
            PS_TRY(hear_what_is_there(program, SAID, error));
        } else {
            close_stream(&program->output);
        }
    }
    return finish(program, error);
}

void ps_program_end(ps_program *program) {
    int state = 0;
    if (program == NULL) {
        return;
    }
    close_stream(&program->output);
    close_stream(&program->complaints);
    if (program->child > 0) {
        (void)kill(-program->child, SIGKILL);
        while (waitpid(program->child, &state, 0) < 0 && errno == EINTR) {
        }
    }
    free(program);
}

/* ---- all of it ------------------------------------------------------------------------------ */

static pspec_status read_all(ps_program *program, ps_text *out, ps_error *error) {
    char block[1 << 14];
    size_t count = 1;
    while (count > 0 && out->length < PS_PROGRAM_TRIED_BYTES) {
        const size_t left = PS_PROGRAM_TRIED_BYTES - out->length;
        const size_t most = left < sizeof block ? left : sizeof block;
        PS_TRY(ps_program_read(program, block, most, &count, error));
        ps_text_append_bytes(out, block, count);
        PS_TRY(ps_text_check(out, error));
    }
    return PSPEC_OK;
}

pspec_status ps_program_try(ps_text *out, const char *command, ps_error *error) {
    ps_program *program = NULL;
    PS_TRY(ps_program_start(&program, command, error));
    const pspec_status status = read_all(program, out, error);
    ps_program_end(program);
    return status;
}
