#include "cli/points_shown.h"

#include "cli/command.h"

#include <string.h>
#include <unistd.h>

typedef struct listener {
    const ps_request *arguments;
    const char *command, *counted;
    ps_progress *progress;
} listener;

/* A progress line would run into points that go to the same terminal. */
static void begin_line(void *payload) {
    listener *const ear = payload;
    const bool shares_terminal = strcmp(ear->arguments->output, "-") == 0 && isatty(STDOUT_FILENO);
    ear->progress = shares_terminal ? NULL : ps_progress_begin(ear->arguments, ear->counted);
}

static void end_line(void *payload) {
    listener *const ear = payload;
    ps_progress_end(ear->progress);
    ear->progress = NULL;
}

static int tell(const ps_watch_report *report, void *payload) {
    const listener *const ear = payload;
    return ps_progress_tell(report, ear->progress);
}

static void warn(void *payload, const char *sentence) {
    const listener *const ear = payload;
    fprintf(stderr, "pointspec %s: %s\n", ear->command, sentence);
}

pspec_status ps_points_make_shown(ps_make_points *make, const char *command, const char *counted,
                                  const ps_request *arguments, ps_error *error) {
    listener ear = {arguments, command, counted, NULL};
    const ps_answer_hooks hooks = {.watch = {tell, &ear},
                                   .payload = &ear,
                                   .next = begin_line,
                                   .end = end_line,
                                   .warn = arguments->quiet ? NULL : warn};
    return make(arguments, &hooks, error);
}
