/* What works on this machine and what does not, as sentences: drivers, devices, caches, memory,
 * threads, gnuplot. Looks, and computes one spectrum of four points on every device; it changes
 * nothing.
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

/* "ok", "note", "WRONG". */
extern const char *const ps_finding_words[];

/* Hears of one finding; the strings are the teller's. */
typedef void (*ps_finding_heard)(ps_finding_kind kind, const char *topic, const char *sentence,
                                 void *payload);

typedef struct ps_doctor {
    const char *device;       /* which device is the default, as ps_device_choose takes it */
    const char *cache_folder; /* of ours; NULL: the environment names none */
    ps_finding_heard hear;
    void *payload;
} ps_doctor;

/* PSPEC_ERROR_CHECK when something is wrong. */
pspec_status ps_doctor_examine(const ps_doctor *doctor, ps_error *error) PS_MUST_CHECK;

/* The same as a table with the columns finding, topic and sentence; out->verdict says when
 * something is wrong. device as above. *out is {0} before, and freed by ps_answer_free, also after
 * an error. */
pspec_status ps_doctor_tabulate(ps_answer *out, const char *device, ps_error *error) PS_MUST_CHECK;

/* Tells a finding, for the files of the doctor; false when it is not good. */
void ps_doctor_tell(const ps_doctor *doctor, ps_finding_kind kind, const char *topic,
                    const char *format, ...) PS_PRINTF(4, 5);
/* Every device: does a kernel build there, and is its number right? *is_wrong: not so for the
 * default. */
pspec_status ps_doctor_devices(const ps_doctor *doctor, bool *is_wrong,
                               ps_error *error) PS_MUST_CHECK;

#endif
