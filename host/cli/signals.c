/* Signals: what asks the program to end ends it within a second, wherever it is.
 *
 * SIGINT, SIGTERM and SIGHUP first set ps_interrupted, which long work looks at, so that the
 * command itself gives everything up and says how far it was. Where it does not within 0.7 s,
 * because it is inside a driver that compiles, say, a timer ends the process: temporary files are
 * removed, children ended, and the sentence and the exit code are the same.
 */
#define _XOPEN_SOURCE 700 /* readlink, timers */

#include "cli/command.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Handlers know nothing but what is global. */
volatile sig_atomic_t ps_interrupted = 0;
static volatile sig_atomic_t pipe_is_closed = 0;
static volatile sig_atomic_t is_ending = 0; /* the command has said what there is to say */
static volatile sig_atomic_t exit_code = PS_EXIT_INTERRUPTED;
static timer_t patience; /* ends when the command had its time to end by itself */
static volatile sig_atomic_t has_patience = 0;

/* How long work may take to stop, out of the second that the program has to end: what remains is
 * for the end of the process, which gives gigabytes back. */
static const struct timespec PATIENCE = {0, 700000000};

enum {
    PATH_BYTES = 4096,
    NUMBER_BYTES = 24,      /* digits of 64 bits, and a bit more */
    MOST_DESCRIPTORS = 1024 /* the usual limit of a process */
};

/* ---- the end of the process: calls that a handler may make --------------------------------- */

/* Writes the number at the end of text and returns where it begins. */
static const char *print_number(char text[NUMBER_BYTES], long number) {
    char *at = text + NUMBER_BYTES - 1;
    *at = '\0';
    do {
        *--at = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    return at;
}

static void join(char *out, size_t bytes, const char *start, const char *end) {
    size_t length = strlen(start);
    memcpy(out, start, length);
    for (; *end != '\0' && length + 1 < bytes; end++) {
        out[length++] = *end;
    }
    out[length] = '\0';
}

/* Is it /folder/.pointspec-HOST-PID-NUMBER.tmp of this process? See files/temporary_file.h. */
static bool is_own_temporary(const char *path, const char *pid) {
    static const char start[] = "/.pointspec-";
    static const char end[] = ".tmp";
    const size_t length = strlen(path);
    const char *const name = strrchr(path, '/');
    if (name == NULL || strncmp(name, start, sizeof start - 1) != 0 ||
        strcmp(path + length - (sizeof end - 1), end) != 0) {
        return false;
    }
    const char *const number = strchr(name + sizeof start - 1, '-');
    return number != NULL && strncmp(number + 1, pid, strlen(pid)) == 0 &&
           number[1 + strlen(pid)] == '-';
}

/* A temporary file is open as long as it is incomplete: the system knows the names of what is open.
 */
static void remove_temporary_files(const char *pid) {
    char digits[NUMBER_BYTES];
    char link[PATH_BYTES];
    char path[PATH_BYTES];
    for (int i = STDERR_FILENO + 1; i < MOST_DESCRIPTORS; i++) {
        join(link, sizeof link, "/proc/self/fd/", print_number(digits, i));
        const ssize_t length = readlink(link, path, sizeof path - 1);
        if (length > 0) {
            path[length] = '\0';
            if (is_own_temporary(path, pid)) {
                (void)unlink(path);
            }
        }
    }
}

/* gnuplot, a compiler that a driver has started, or a program that prints points, which leads a
 * group of its own. */
static void end_children(const char *pid) {
    char path[PATH_BYTES];
    char text[PATH_BYTES];
    join(path, sizeof path, "/proc/self/task/", pid);
    const size_t used = strlen(path);
    join(path + used, sizeof path - used, "/children", "");
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    const ssize_t length = descriptor >= 0 ? read(descriptor, text, sizeof text) : 0;
    long child = 0;
    for (ssize_t i = 0; i < length; i++) {
        if (text[i] >= '0' && text[i] <= '9') {
            child = 10 * child + (text[i] - '0');
        } else if (child > 0) {
            (void)kill((pid_t)-child, SIGKILL);
            (void)kill((pid_t)child, SIGKILL);
            child = 0;
        }
    }
}

/* The sentence that a command would have said, below its progress line, where there is one. */
static void say_interrupted(void) {
    static const char sentence[] = "\npointspec: interrupted\n";
    const bool has_terminal = isatty(STDERR_FILENO);
    const char *const text = sentence + (has_terminal ? 0 : 1);
    (void)!write(STDERR_FILENO, text, strlen(text));
}

static void leave(int signal_number) {
    char digits[NUMBER_BYTES];
    const char *const pid = print_number(digits, (long)getpid());
    (void)signal_number;
    remove_temporary_files(pid);
    end_children(pid);
    if (!is_ending) {
        say_interrupted();
    }
    _exit((int)exit_code);
}

/* ---- handlers ------------------------------------------------------------------------------ */

/* A signal that comes again changes nothing: the end is near. */
static void interrupt(int signal_number) {
    const int reason = errno;
    (void)signal_number;
    if (!ps_interrupted) {
        const struct itimerspec once = {.it_value = PATIENCE};
        if (!has_patience || timer_settime(patience, 0, &once, NULL) != 0) {
            alarm(1);
        }
    }
    ps_interrupted = 1;
    errno = reason;
}

/* The terminal's other signal, which ends a process at once: groups of their own do not hear it. */
static void quit(int signal_number) {
    char digits[NUMBER_BYTES];
    end_children(print_number(digits, (long)getpid()));
    (void)signal(signal_number, SIG_DFL);
    (void)raise(signal_number);
}

/* The write fails: unfinished files go away. */
static void note_pipe(int signal_number) {
    (void)signal_number;
    pipe_is_closed = 1;
}

/* The write fails, and says so. Unlike a signal that is ignored, this is not for children. */
static void pass_over(int signal_number) {
    (void)signal_number;
}

/* No SA_RESTART, so that a read or write that waits returns. A signal that our parent had ignored,
 * as nohup and shells do for background jobs, stays ignored. */
static void handle(int signal_number, void (*handler)(int)) {
    struct sigaction action;
    if (sigaction(signal_number, NULL, &action) == 0 && action.sa_handler != SIG_IGN) {
        memset(&action, 0, sizeof action);
        action.sa_handler = handler;
        sigemptyset(&action.sa_mask);
        sigaction(signal_number, &action, NULL);
    }
}

void ps_signals_prepare(void) {
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGALRM};
    signal(SIGALRM, leave); /* whatever the parent thinks of it: it is our own clock */
    has_patience = timer_create(CLOCK_MONOTONIC, &event, &patience) == 0;
    handle(SIGINT, interrupt);
    handle(SIGTERM, interrupt);
    handle(SIGHUP, interrupt);
    handle(SIGQUIT, quit);
    handle(SIGPIPE, note_pipe);
    handle(SIGXFSZ, pass_over);
}

void ps_signals_end(int code) {
    exit_code = code;
    is_ending = 1;
}

bool ps_signals_pipe_closed(void) {
    return pipe_is_closed != 0;
}
