#include "commands/doctor.h"

#include <stdarg.h>
#include <stdio.h>

const char *const ps_finding_words[] = {"ok", "note", "WRONG"};

void ps_doctor_tell(const ps_doctor *doctor, ps_finding_kind kind, const char *topic,
                    const char *format, ...) {
    char sentence[PS_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    doctor->hear(kind, topic, sentence, doctor->payload);
}
