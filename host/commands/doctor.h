/* What works on this machine and what does not, as sentences: drivers, devices, caches, memory,
 * threads, gnuplot. Looks, and computes one spectrum of four points on every device; it changes
 * nothing. For files of the doctor.
 */
#ifndef PS_COMMANDS_DOCTOR_H
#define PS_COMMANDS_DOCTOR_H

#include "answers/kind.h"

#include <stdbool.h>

typedef enum ps_finding_kind {
    PS_FINDING_GOOD = 0,
    PS_FINDING_NOTE, /* something is missing that the default device can do without */
    PS_FINDING_WRONG /* the default device is not there, or cannot be relied on */
} ps_finding_kind;

typedef struct ps_doctor {
    const char *device;           /* which device is the default, as ps_device_choose takes it */
    const char *cache_folder;     /* of ours; NULL: the environment names none */
    const ps_answer_hooks *hooks; /* hear of every finding when it is found */
    ps_table *table;              /* gets a row for it */
    ps_error *unwritten;          /* why the first row that is missing there is */
} ps_doctor;

void ps_doctor_tell(const ps_doctor *doctor, ps_finding_kind kind, const char *topic,
                    const char *format, ...) PS_PRINTF(4, 5);
/* Every device: does a kernel build there, and is its number right? *is_wrong: not so for the
 * default. */
pspec_status ps_doctor_devices(const ps_doctor *doctor, bool *is_wrong,
                               ps_error *error) PS_MUST_CHECK;

#endif
