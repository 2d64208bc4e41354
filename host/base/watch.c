#include "base/watch.h"

#include <inttypes.h>

pspec_status ps_watch_tell(const ps_watch *watch, const char *phase, uint64_t done, uint64_t total,
                           const char *detail, ps_error *error) {
    const ps_watch_report report = {phase, done, total, detail};
    if (watch == NULL || watch->tell == NULL || watch->tell(&report, watch->payload) == 0) {
        return PSPEC_OK;
    }
    return total > 0
               ? ps_fail(error, PSPEC_ERROR_CANCELLED,
                         "interrupted after %" PRIu64 " of %" PRIu64 " %s", done, total, phase)
               : ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted after %" PRIu64 " %s", done,
                         phase);
}
