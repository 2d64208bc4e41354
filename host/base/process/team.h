/* Processes, or threads, that do one job together: every member has the same question, does some of
 * the work, and has what all of them found when they have met. */
#ifndef PS_BASE_PROCESS_TEAM_H
#define PS_BASE_PROCESS_TEAM_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ps_team {
    size_t own, num; /* the number of this member, and how many there are; number 0 leads */
    bool is_mixed;   /* members may have devices of different kinds, and so other bits */
    void *payload;   /* of the call */
    /* Waits for the others. Of slots[num][bytes] this member has filled its own, and has all
     * afterwards. status is how far it came; the first failure is that of all, and whoever has
     * failed need not come. */
    pspec_status (*exchange)(const struct ps_team *team, pspec_status status, void *slots,
                             size_t bytes, ps_error *error);
} ps_team;

/* Does this process write what there is to write? NULL: it is alone. */
static inline bool ps_team_is_led_here(const ps_team *team) {
    return team == NULL || team->own == 0;
}
/* Waits for the others, who have the status of all; NULL: there are none. */
static inline pspec_status ps_team_meet(const ps_team *team, pspec_status status, ps_error *error) {
    return team != NULL ? team->exchange(team, status, NULL, 0, error) : status;
}

#endif
