/* Sentences for whoever wants to know what is being done; nobody by default. */
#ifndef PS_BASE_LOG_H
#define PS_BASE_LOG_H

#include "base/status.h"

/* say may be NULL; sentences have no newline and are gone when it returns. */
typedef struct ps_log {
    void (*say)(const char *sentence, void *payload);
    void *payload;
} ps_log;

void ps_log_say(const ps_log *log, const char *format, ...) PS_PRINTF(2, 3);

#endif
