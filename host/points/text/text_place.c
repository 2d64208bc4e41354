#include "points/text/points_text.h"

#include <stdarg.h>

void ps_text_place(char place[PS_PLACE_BYTES], const ps_point_reader *reader) {
    snprintf(place, PS_PLACE_BYTES, "%.440s, line %zu", reader->input.name,
             ((const ps_text_state *)reader->state)->lines.line_number);
}

pspec_status ps_text_fail(const ps_point_reader *reader, ps_error *error, const char *format, ...) {
    char what[PS_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s, line %zu: %s", reader->input.name,
                   ((const ps_text_state *)reader->state)->lines.line_number, what);
}
