#include "cli/run_shown.h"

#include "cli/command.h"

/* The payload of all of them is the progress line, or NULL. */

static void begin_question(void *progress, const char *result, size_t number, size_t num) {
    ps_progress_part(progress, "%s, question %zu of %zu: ", result, number, num);
}

static bool is_interrupted(void *progress) {
    (void)progress;
    return ps_interrupted != 0;
}

static void warn(void *progress, const char *sentence) {
    ps_progress_hide(progress);
    fprintf(stderr, "pointspec: %s\n", sentence);
}

ps_run_hooks ps_run_hooks_make(const ps_request *arguments) {
    return (ps_run_hooks){.begin_question = begin_question,
                          .is_interrupted = is_interrupted,
                          .warn = arguments->quiet ? NULL : warn};
}

pspec_status ps_run_answer_shown(ps_run *run, ps_error *error) {
    const ps_run_hooks before = run->hooks;
    ps_progress *const progress = ps_progress_begin(run->arguments, "realizations");
    run->hooks.watch = (ps_watch){ps_progress_tell, progress};
    run->hooks.payload = progress;
    const pspec_status status = ps_run_answer(run, error);
    run->hooks = before;
    ps_progress_end(progress);
    return status;
}
