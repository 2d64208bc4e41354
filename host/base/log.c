#include "base/log.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

void ps_log_say(const ps_log *log, const char *format, ...) {
    enum { SENTENCE_BYTES = 512 };
    char sentence[SENTENCE_BYTES];
    va_list arguments;
    if (log->say == NULL) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    log->say(sentence, log->payload);
}
