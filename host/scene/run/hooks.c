/* Calls of who hears of a run. */
#include "scene/run/run.h"

#include <stdarg.h>
#include <stdio.h>

void ps_run_warn(const ps_run *run, const char *format, ...) {
    char sentence[PS_MESSAGE_BYTES];
    va_list arguments;
    if (run->hooks.warn == NULL) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    run->hooks.warn(run->hooks.payload, sentence);
}

bool ps_run_is_interrupted(const ps_run *run) {
    return run->hooks.is_interrupted != NULL && run->hooks.is_interrupted(run->hooks.payload);
}
