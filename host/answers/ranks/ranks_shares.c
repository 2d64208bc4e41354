/* A command that ranks share as a team (base/process/team.h). */
#include "answers/ranks/ranks_work.h"
#include "base/memory.h"

#include <string.h>

static int tell(const ps_watch_report *report, void *payload) {
    const ps_ranks_share *const self = payload;
    const ps_watch *const watch = &self->watch;
    return ps_ranks_must_stop(self->ranks) ||
           (watch->tell != NULL && watch->tell(report, watch->payload) != 0);
}

/* On rank 0: what the others have handed in goes to their slots. */
static pspec_status take_slots(const ps_team *team, char *slots, size_t bytes,
                               const ps_rank_bytes *parts, ps_error *error) {
    for (size_t i = 1; i < team->num; i++) {
        if (parts[i].num != bytes) {
            return ps_fail(error, PSPEC_ERROR_IO, "rank %zu hands in %zu bytes instead of %zu", i,
                           parts[i].num, bytes);
        }
        if (bytes > 0) {
            memcpy(slots + i * bytes, parts[i].data, bytes);
        }
    }
    return PSPEC_OK;
}

static pspec_status gather(const ps_team *team, pspec_status status, char *slots, size_t bytes,
                           ps_error *error) {
    const ps_ranks_share *const self = team->payload;
    const ps_rank_bytes own = {bytes > 0 ? slots + team->own * bytes : NULL, bytes};
    ps_rank_bytes *parts = NULL;
    ps_error lack = {0};
    if (PS_NEW(&parts, team->num, "what ranks hand in", &lack) != PSPEC_OK && status == PSPEC_OK) {
        *error = lack;
        status = lack.status;
    }
    status = ps_ranks_gather(self->ranks, status, &own, parts, error);
    if (status == PSPEC_OK && team->own == 0) {
        status = take_slots(team, slots, bytes, parts, error);
    }
    ps_ranks_free(parts, team->num);
    return status;
}

static pspec_status exchange(const ps_team *team, pspec_status status, void *slots, size_t bytes,
                             ps_error *error) {
    ps_ranks_share *const self = team->payload;
    status = gather(team, status, slots, bytes, error);
    status = ps_ranks_conclude(self->ranks, status, slots, team->num * bytes, error);
    self->has_failed = status != PSPEC_OK;
    return status;
}

void ps_ranks_begin_share(ps_ranks_share *self, ps_ranks *ranks, ps_answer_hooks *hooks) {
    *self = (ps_ranks_share){
        .team = {.own = ps_ranks_own(ranks),
                 .num = ps_ranks_num(ranks),
                 .payload = self,
                 .exchange = exchange},
        .ranks = ranks,
        .watch = hooks->watch,
    };
    hooks->watch = (ps_watch){tell, self};
    hooks->team = &self->team;
}

/* A rank that fails before the others meet fails in the round in which they do. */
pspec_status ps_ranks_end_share(ps_ranks_share *self, pspec_status status, ps_error *error) {
    return self->has_failed ? status : ps_ranks_agree(self->ranks, status, error);
}
