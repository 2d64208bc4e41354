#include "answers/ranks/ranks_work.h"

#include "answers/devices/devices_work.h"
#include "base/memory.h"

#include <stdlib.h>

/* What rank 0 says after a round: it was the last, or all parts are answered with other plans. */
typedef struct verdict {
    bool is_again;
    ps_replan replans[]; /* of each question */
} verdict;

/* The work of this rank. */
typedef struct work {
    ps_ranks *ranks;
    const ps_ranks_plan *plan;
    const ps_kind *kind;
    ps_request request; /* as it was asked, and the plans that parts follow */
    ps_dealt own;       /* parts of this rank, one after the other; it may have none */
    ps_part *parts;     /* [own.num] */
    ps_answer *answers; /* [own.num] of them */
    ps_answer_hooks hooks;
    const ps_watch *watch; /* that of who asked */
    size_t num_questions;
    verdict *next;
    size_t verdict_bytes;
} work;

static ps_dealt deal(const work *self, size_t rank) {
    return ps_parts_deal(self->plan->job.num_parts, ps_ranks_num(self->ranks), rank);
}

static int tell(const ps_watch_report *report, void *payload) {
    const work *const self = payload;
    const ps_watch *const watch = self->watch;
    return ps_ranks_must_stop(self->ranks) ||
           (watch->tell != NULL && watch->tell(report, watch->payload) != 0);
}

/* ---- own parts ------------------------------------------------------------------------------- */

static pspec_status begin(work *self, ps_error *error) {
    const ps_ranks_plan *const plan = self->plan;
    PS_TRY(PS_NEW(&self->parts, self->own.num, "parts of a job", error));
    PS_TRY(PS_NEW(&self->answers, self->own.num, "answers of parts", error));
    for (size_t i = 0; i < self->own.num; i++) {
        PS_TRY(ps_part_begin(&self->parts[i], self->kind, &self->request,
                             plan->job.num_realizations, plan->job.num_parts, self->own.first + i,
                             &self->hooks, error));
    }
    return PSPEC_OK;
}

/* Rank 0 keeps its own. */
static pspec_status compute(const work *self, ps_rank_bytes *bytes, ps_error *error) {
    for (size_t i = 0; i < self->own.num; i++) {
        ps_answer *const answer = &self->answers[i];
        const pspec_status status =
            ps_devices_make(answer, self->kind, &self->parts[i].request, &self->hooks, error);
        ps_answer_end(&self->hooks);
        PS_TRY(status);
        if (ps_ranks_own(self->ranks) > 0) {
            PS_TRY(ps_ranks_pack(bytes, answer->table, error));
            ps_answer_free(answer);
        }
    }
    return PSPEC_OK;
}

static void end(work *self, bool is_written) {
    for (size_t i = 0; i < self->own.num; i++) {
        if (self->parts != NULL) {
            ps_part_end(&self->parts[i], is_written);
        }
        if (self->answers != NULL) {
            ps_answer_free(&self->answers[i]);
        }
    }
    free(self->parts);
    free(self->answers);
    self->parts = NULL;
    self->answers = NULL;
}

/* ---- those of all ranks, on rank 0 ----------------------------------------------------------- */

typedef struct gathered {
    ps_table **tables; /* of all parts, in order; the first are of rank 0, which has them */
    const char **names;
    ps_pool memory;
} gathered;

static pspec_status take_part(gathered *job, const work *self, size_t rank, size_t part,
                              const ps_rank_bytes *bytes, size_t *at, ps_error *error) {
    ps_text name = {0};
    ps_text_append(&name, "part %zu of rank %zu", part + 1, rank);
    PS_TRY(ps_text_keep(&job->names[part], &job->memory, &name, error));
    if (rank == 0) {
        job->tables[part] = self->answers[part].table;
        return PSPEC_OK;
    }
    return ps_ranks_unpack(&job->tables[part], bytes, at, job->names[part], error);
}

static pspec_status take_parts(gathered *job, const work *self, ps_rank_bytes *bytes,
                               ps_error *error) {
    const size_t num_parts = self->plan->job.num_parts;
    PS_TRY(PS_POOL_NEW(&job->memory, &job->tables, num_parts, "answers", error));
    PS_TRY(PS_POOL_NEW(&job->memory, &job->names, num_parts, "answers", error));
    for (size_t rank = 0; rank < ps_ranks_num(self->ranks); rank++) {
        const ps_dealt theirs = deal(self, rank);
        size_t at = 0;
        for (size_t i = 0; i < theirs.num; i++) {
            PS_TRY(take_part(job, self, rank, theirs.first + i, &bytes[rank], &at, error));
        }
        free(bytes[rank].data);
        bytes[rank] = (ps_rank_bytes){0};
    }
    return PSPEC_OK;
}

static pspec_status finish(ps_answer *out, work *self, ps_rank_bytes *bytes, ps_error *error) {
    const size_t num_parts = self->plan->job.num_parts;
    gathered all = {0};
    pspec_status status = take_parts(&all, self, bytes, error);
    const ps_table *const *const tables = (const ps_table *const *)all.tables;
    if (status == PSPEC_OK) {
        status = ps_parts_plan_again(&self->next->is_again, self->next->replans,
                                     self->num_questions, tables, all.names, num_parts, error);
    }
    if (status == PSPEC_OK && !self->next->is_again) {
        status = ps_parts_finish(out, self->kind, &self->request, tables, all.names, num_parts,
                                 &self->hooks, error);
    }
    for (size_t i = self->own.num; tables != NULL && i < num_parts; i++) {
        ps_table_destroy(all.tables[i]);
    }
    ps_pool_free(&all.memory);
    return status;
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* Devices and plans of all ranks that have something to do are those of rank 0. */
static pspec_status compare_jobs(const work *self, ps_error *error) {
    static const ps_text nothing;
    const bool has_parts = self->own.num > 0;
    const ps_error *const failure = &self->plan->failure;
    if (has_parts && failure->status != PSPEC_OK) {
        *error = *failure;
    }
    return ps_ranks_compare(self->ranks, has_parts ? &self->plan->alike : &nothing,
                            has_parts ? failure->status : PSPEC_OK, NULL, 0, error);
}

/* Parts with the plans of the request: all of them, and what comes of it. */
static pspec_status go_round(ps_answer *out, work *self, ps_error *error) {
    const size_t num = ps_ranks_num(self->ranks);
    ps_rank_bytes own = {0};
    ps_rank_bytes *bytes = NULL;
    pspec_status status = begin(self, error);
    if (status == PSPEC_OK) {
        status = PS_NEW(&bytes, num, "answers of ranks", error);
    }
    if (status == PSPEC_OK) {
        status = compute(self, &own, error);
    }
    status = ps_ranks_gather(self->ranks, status, &own, bytes, error);
    if (status == PSPEC_OK && ps_ranks_own(self->ranks) == 0) {
        status = finish(out, self, bytes, error);
    }
    free(own.data);
    ps_ranks_free(bytes, num);
    status = ps_ranks_conclude(self->ranks, status, self->next, self->verdict_bytes, error);
    end(self, status == PSPEC_OK && !self->next->is_again);
    return status;
}

static pspec_status run(ps_answer *out, work *self, ps_error *error) {
    char *data = NULL;
    self->verdict_bytes = sizeof(verdict) + self->num_questions * sizeof(ps_replan);
    pspec_status status = PS_NEW(&data, self->verdict_bytes, "plans", error);
    status = ps_ranks_agree(self->ranks, status, error);
    self->next = (verdict *)(void *)data;
    while (status == PSPEC_OK) {
        status = go_round(out, self, error);
        if (status != PSPEC_OK || !self->next->is_again) {
            break;
        }
        self->request.replans = self->next->replans;
    }
    free(data);
    return status;
}

pspec_status ps_ranks_produce(ps_answer *out, ps_ranks *ranks, const ps_ranks_plan *plan,
                              const ps_kind *kind, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) {
    work self = {.ranks = ranks,
                 .plan = plan,
                 .kind = kind,
                 .request = *request,
                 .hooks = *hooks,
                 .watch = &hooks->watch,
                 .num_questions = ps_request_num_questions(request)};
    *out = (ps_answer){0};
    self.hooks.watch = (ps_watch){tell, &self};
    self.hooks.is_shared = true;
    self.own = deal(&self, ps_ranks_own(ranks));
    const pspec_status status = compare_jobs(&self, error);
    return status == PSPEC_OK ? run(out, &self, error) : status;
}
