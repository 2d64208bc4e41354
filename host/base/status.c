#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

pspec_status ps_fail(ps_error *error, pspec_status status, const char *format, ...) {
    if (error != NULL) {
        va_list arguments;
        va_start(arguments, format);
        error->status = status;
        vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return status;
}
