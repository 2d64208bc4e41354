#include "base/watch.h"

#include <inttypes.h>
#include <string.h>

const char *ps_watch_things(const char *phase) {
    const char *const colon = strstr(phase, ": ");
    const char *const after = colon != NULL ? colon + 2 : phase;
    const char *const comma = strstr(after, ", ");
    return comma != NULL ? comma + 2 : after;
}

pspec_status ps_watch_tell(const ps_watch *watch, const char *phase, uint64_t done, uint64_t total,
                           const char *detail, ps_error *error) {
    const ps_watch_report report = {phase, done, total, detail};
    if (watch == NULL || watch->tell == NULL || watch->tell(&report, watch->payload) == 0) {
        return PSPEC_OK;
    }
    const char *const things = ps_watch_things(phase);
    return total > 0
               ? ps_fail(error, PSPEC_ERROR_CANCELLED,
                         "interrupted after %" PRIu64 " of %" PRIu64 " %s", done, total, things)
               : ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted after %" PRIu64 " %s", done,
                         things);
}
