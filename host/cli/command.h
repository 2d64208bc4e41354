/* The commands of the program: one table (commands.c), and what they print. */
#ifndef PS_CLI_COMMAND_H
#define PS_CLI_COMMAND_H

#include "answers/arguments.h"
#include "answers/kind.h"
#include "base/watch.h"
#include "ranks/ranks.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>

/* Exit codes of the program (docs/user/conventions.md#exit-codes). */
enum {
    PS_EXIT_DONE = 0,
    PS_EXIT_FAILED = 1,
    PS_EXIT_USAGE = 2,
    PS_EXIT_CHECK = 3,
    PS_EXIT_INTERRUPTED = 130, /* by SIGINT, SIGTERM or SIGHUP */
    PS_EXIT_PIPE = 141         /* nobody reads what is written: what shells say of SIGPIPE */
};

/* All of them, in the order of --help; ended by NULL. */
extern const ps_command *const ps_commands[];

/* The command of that name; NULL with a sentence that names the nearest one. */
const ps_command *ps_command_find(const char *name, ps_error *error);

/* Exit code that goes with a status. */
int ps_exit_code(pspec_status status);

/* --help: what the program does, and what one command does. */
void ps_help_program(FILE *stream);
void ps_help_command(FILE *stream, const ps_command *command);
/* The columns, header entries and arrays of the answers that the command prints. */
pspec_status ps_help_fields(FILE *stream, const ps_command *command, ps_error *error) PS_MUST_CHECK;

/* A progress line on standard error, when that is a terminal and --quiet was not given: done, rate,
 * time left; updated at most ten times a second, erased at the end. total 0: unknown. what names
 * the things counted, for example "realizations", and must outlive the progress. */
typedef struct ps_progress ps_progress;
ps_progress *ps_progress_begin(const ps_request *arguments, const char *what); /* NULL: silent */
void ps_progress_update(ps_progress *progress, uint64_t done, uint64_t total);
/* From now on the line is about a part of the work, which it names first; time and rate begin anew.
 */
void ps_progress_part(ps_progress *progress, const char *format, ...) PS_PRINTF(2, 3);
void ps_progress_hide(ps_progress *progress); /* until the next update: something else is printed */
void ps_progress_end(ps_progress *progress);
/* The call of a ps_watch whose payload is a progress line or NULL: other phases than `what` are
 * shown, too, with a rate of their own or their detail; an interrupt cancels. */
int ps_progress_tell(const ps_watch_report *report, void *progress);

/* Where a table goes to a terminal: its view, which is no wider or longer than people look at, and
 * text as the format where none was said. */
void ps_terminal_settle(const ps_command *command, ps_request *arguments);

/* ---- signals: signals.c ---------------------------------------------------------------------- */

/* Set by the handlers, and read by whoever works. */
extern volatile sig_atomic_t ps_interrupted;

void ps_signals_prepare(void);

/* From now on the process ends with this exit code and says nothing, should its end take long. */
void ps_signals_end(int exit_code);

/* Has somebody closed the other end of a pipe that was written to? */
bool ps_signals_pipe_closed(void);

/* ---- work that a terminal sees: a progress line, warnings on standard error, interrupts ------ */

typedef struct ps_shown {
    const ps_request *arguments;
    const char *counted; /* what the progress line counts: "realizations" */
    const char *speaker; /* who says warnings: "pointspec" */
    /* What is made goes to the output while the line is shown: it would run into points on the same
     * terminal. */
    bool is_streamed;
    bool has_printed;      /* findings, to standard output */
    ps_progress *progress; /* NULL between two phases of the work */
} ps_shown;

/* shown must outlive the work. With --quiet there are no warnings, but what is missing is told. */
ps_answer_hooks ps_shown_hooks(ps_shown *shown);

/* Runs the command with these, and writes what they name. Differences that a check found are
 * PSPEC_ERROR_CHECK. ranks: NULL of a process that is alone; else rank 0 shows and writes, and all
 * have its status. */
pspec_status ps_shown_run(const ps_command *command, const ps_request *arguments, ps_ranks *ranks,
                          ps_error *error) PS_MUST_CHECK;

/* The picture of pointspec bench: error against run time, a panel for every case. */
ps_make_figure ps_bench_figure;

/* bench --scenes: what skipping is worth, scene by scene. Answers the scenes arguments->files with
 * and without skips, in turn, without the cache, and compares the answers of every question. A row
 * for each result; PSPEC_ERROR_CHECK, after the table is made, when answers differ by more than
 * both sides announce. *out may be there after an error, too. */
pspec_status ps_bench_scenes(ps_table **out, const ps_request *arguments,
                             ps_error *error) PS_MUST_CHECK;

#endif
