/* A command that is shared by what it keeps on the disk: each rank makes its share, all meet, and
 * rank 0 finds what the others kept.
 */
#include "answers/ranks/ranks_work.h"

static int tell(const ps_watch_report *report, void *payload) {
    const ps_ranks_share *const self = payload;
    const ps_watch *const watch = &self->watch;
    return ps_ranks_must_stop(self->ranks) ||
           (watch->tell != NULL && watch->tell(report, watch->payload) != 0);
}

static pspec_status meet(pspec_status status, void *payload, ps_error *error) {
    ps_ranks_share *const self = payload;
    status = ps_ranks_agree(self->ranks, status, error);
    self->has_failed = status != PSPEC_OK;
    return status;
}

void ps_ranks_begin_share(ps_ranks_share *self, ps_ranks *ranks, ps_answer_hooks *hooks) {
    *self = (ps_ranks_share){
        .share = {ps_ranks_own(ranks), ps_ranks_num(ranks), self, meet},
        .ranks = ranks,
        .watch = hooks->watch,
    };
    hooks->watch = (ps_watch){tell, self};
    hooks->share = &self->share;
}

/* A rank that fails before the meeting fails in its round. */
pspec_status ps_ranks_end_share(ps_ranks_share *self, pspec_status status, ps_error *error) {
    return self->has_failed ? status : ps_ranks_agree(self->ranks, status, error);
}
