#include "answers/ranks/ranks_work.h"

#include "answers/checkpoints.h"
#include "base/memory.h"
#include "files/temporary_file.h"
#include "spectra/sum_nodes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The work of this rank. */
typedef struct work {
    ps_ranks *ranks;
    const ps_kind *kind;
    const ps_request *request; /* as it was asked */
    ps_request own;            /* of the range of this rank */
    bool has_range;            /* else there is nothing to do */
    char range[48];
    ps_text checkpoint, key;
    ps_answer_hooks hooks;
    const ps_watch *watch; /* that of who asked */
} work;

/* ---- ranges ---------------------------------------------------------------------------------- */

/* Blocks are dealt out as evenly as they can be, in the order of ranks. */
static ps_realization_range find_range(const ps_ranks *ranks, uint64_t num_realizations) {
    const uint64_t num_blocks = (num_realizations + PS_SUM_BLOCK - 1) / PS_SUM_BLOCK;
    const uint64_t num = ps_ranks_num(ranks) < num_blocks ? ps_ranks_num(ranks) : num_blocks;
    const uint64_t own = ps_ranks_own(ranks);
    if (own >= num) {
        return (ps_realization_range){0};
    }
    const uint64_t more = num_blocks % num; /* ranks that have one more */
    const uint64_t each = num_blocks / num;
    const uint64_t first = own * each + (own < more ? own : more);
    const uint64_t end = (first + each + (own < more)) * PS_SUM_BLOCK;
    return (ps_realization_range){first * PS_SUM_BLOCK,
                                  end < num_realizations ? end : num_realizations};
}

static int tell(const ps_watch_report *report, void *payload) {
    const work *const self = payload;
    const ps_watch *const watch = self->watch;
    return ps_ranks_must_stop(self->ranks) ||
           (watch->tell != NULL && watch->tell(report, watch->payload) != 0);
}

static pspec_status begin(work *self, const ps_ranks_plan *plan, ps_error *error) {
    ps_request *const own = &self->own;
    const ps_realization_range range = find_range(self->ranks, plan->num_realizations);
    *own = *self->request;
    own->range = range;
    own->wants_state = true;
    own->is_given[PS_OPTION_RANGE] = true;
    own->said[PS_OPTION_RANGE] = self->range;
    self->has_range = range.end > 0;
    self->hooks.watch = (ps_watch){tell, self};
    self->hooks.is_shared = true;
    snprintf(self->range, sizeof self->range, "%" PRIu64 ":%" PRIu64, range.first, range.end);
    if (own->limits.checkpoint.path == NULL || !self->has_range) {
        own->limits.checkpoint.path = NULL;
        return PSPEC_OK;
    }
    ps_text_append(&self->checkpoint, "%s-rank-%zu", own->limits.checkpoint.path,
                   ps_ranks_own(self->ranks));
    PS_TRY(ps_text_check(&self->checkpoint, error));
    own->limits.checkpoint.path = ps_text_string(&self->checkpoint);
    return ps_answer_begin_checkpoints(own, self->kind, &self->key, &self->hooks, error);
}

/* ---- tables as bytes ------------------------------------------------------------------------- */

static pspec_status fail_file(ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO, "cannot use a temporary file");
}

static pspec_status write_table(const ps_table *table, FILE *stream, uint64_t *num_bytes,
                                ps_error *error) {
    ps_npz *npz = NULL;
    PS_TRY(ps_npz_open_stream(&npz, stream, PS_NPZ_LIMIT, error));
    pspec_status status = ps_table_add_to_npz(table, npz, error);
    if (status == PSPEC_OK) {
        status = ps_npz_end(npz, num_bytes, error);
    }
    if (status != PSPEC_OK) {
        ps_npz_discard(&npz);
        return status;
    }
    return ps_npz_commit(&npz, error);
}

static pspec_status pack(ps_rank_bytes *out, const ps_table *table, ps_error *error) {
    FILE *stream = NULL;
    char *data = NULL;
    uint64_t num = 0;
    PS_TRY(ps_temporary_open(&stream, error));
    pspec_status status = write_table(table, stream, &num, error);
    if (status == PSPEC_OK) {
        status = PS_NEW(&data, (size_t)num, "the answer of a rank", error);
    }
    if (status == PSPEC_OK &&
        (fseeko(stream, 0, SEEK_SET) != 0 || fread(data, 1, num, stream) != num)) {
        status = fail_file(error);
    }
    fclose(stream);
    *out = (ps_rank_bytes){data, (size_t)num};
    return status;
}

static pspec_status unpack(ps_table **out, const ps_rank_bytes *bytes, const char *name,
                           ps_error *error) {
    FILE *stream = NULL;
    ps_npz_file *file = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(ps_temporary_open(&stream, error));
    if (fwrite(bytes->data, 1, bytes->num, stream) != bytes->num || fflush(stream) != 0 ||
        fseeko(stream, 0, SEEK_SET) != 0) {
        status = fail_file(error);
    }
    if (status == PSPEC_OK) {
        status = ps_npz_read(&file, fileno(stream), name, PS_NPZ_LIMIT, error);
    }
    if (status == PSPEC_OK) {
        status = ps_table_take_npz(out, file, error);
    }
    ps_npz_free(file);
    fclose(stream);
    return status;
}

/* ---- merging --------------------------------------------------------------------------------- */

/* Of ranks that have a range. */
typedef struct merging {
    ps_table **tables;
    const char **names;
    size_t num;
    ps_pool memory;
} merging;

static pspec_status take_parts(merging *self, const ps_ranks *ranks, ps_table *first,
                               ps_rank_bytes *parts, ps_error *error) {
    const size_t num = ps_ranks_num(ranks);
    PS_TRY(PS_POOL_NEW(&self->memory, &self->tables, num, "answers", error));
    PS_TRY(PS_POOL_NEW(&self->memory, &self->names, num, "answers", error));
    for (size_t rank = 0; rank < num && (rank == 0 || parts[rank].num > 0); rank++) {
        ps_text name = {0};
        ps_text_append(&name, "the answer of rank %zu", rank);
        PS_TRY(ps_text_keep(&self->names[rank], &self->memory, &name, error));
        if (rank > 0) {
            PS_TRY(unpack(&self->tables[rank], &parts[rank], self->names[rank], error));
            free(parts[rank].data);
            parts[rank] = (ps_rank_bytes){0};
        } else {
            self->tables[rank] = first;
        }
        self->num = rank + 1;
    }
    return PSPEC_OK;
}

/* What one process would have answered. */
static pspec_status merge(ps_answer *out, const work *self, ps_table *first, ps_rank_bytes *parts,
                          const ps_request *request, ps_error *error) {
    merging all = {0};
    pspec_status status = take_parts(&all, self->ranks, first, parts, error);
    if (status == PSPEC_OK) {
        const ps_parts merged = {.tables = (const ps_table *const *)all.tables,
                                 .names = all.names,
                                 .num = all.num,
                                 .command_line = request->command_line,
                                 .request = request};
        status = ps_answer_merge(out, &merged, error);
    }
    for (size_t i = 1; i < all.num; i++) {
        ps_table_destroy(all.tables[i]);
    }
    ps_pool_free(&all.memory);
    return status;
}

static pspec_status finish(ps_answer *out, const work *self, ps_table *first, ps_rank_bytes *parts,
                           ps_error *error) {
    ps_request request = *self->request;
    ps_table_format format = PS_FORMAT_CSV;
    PS_TRY(ps_table_choose_format(&format, request.format, request.output, error));
    request.wants_state = request.wants_state || format == PS_FORMAT_NPZ;
    PS_TRY(merge(out, self, first, parts, &request, error));
    return ps_answer_write(out, self->kind, &request, format, &self->hooks, error);
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* Devices and plans of all ranks are those of rank 0. */
static pspec_status compare_jobs(const work *self, ps_error *error) {
    ps_outlook outlook = {0};
    const pspec_status status =
        self->has_range ? self->kind->look_ahead(&outlook, self->request, &self->hooks, error)
                        : PSPEC_OK;
    const pspec_status compared =
        ps_ranks_compare(self->ranks, &outlook.alike, status, NULL, 0, error);
    ps_text_free(&outlook.alike);
    return compared;
}

/* Own range, as a table on rank 0 and as bytes elsewhere. */
static pspec_status compute(const work *self, ps_answer *answer, ps_rank_bytes *bytes,
                            ps_error *error) {
    if (!self->has_range) {
        return PSPEC_OK;
    }
    const pspec_status status = ps_answer_make(answer, self->kind, &self->own, &self->hooks, error);
    ps_answer_end(&self->hooks);
    PS_TRY(status);
    return ps_ranks_own(self->ranks) == 0 ? PSPEC_OK : pack(bytes, answer->table, error);
}

static pspec_status run(ps_answer *out, work *self, const ps_ranks_plan *plan, ps_error *error) {
    const size_t num = ps_ranks_num(self->ranks);
    ps_answer answer = {0};
    ps_rank_bytes bytes = {0};
    ps_rank_bytes *parts = NULL;
    pspec_status status = begin(self, plan, error);
    if (status == PSPEC_OK) {
        status = PS_NEW(&parts, num, "answers of ranks", error);
    }
    if (status == PSPEC_OK) {
        status = compute(self, &answer, &bytes, error);
    }
    status = ps_ranks_gather(self->ranks, status, &bytes, parts, error);
    if (status == PSPEC_OK && ps_ranks_own(self->ranks) == 0) {
        status = finish(out, self, answer.table, parts, error);
    }
    free(bytes.data);
    ps_ranks_free(parts, num);
    ps_answer_free(&answer);
    return ps_ranks_conclude(self->ranks, status, NULL, 0, error);
}

pspec_status ps_ranks_produce(ps_answer *out, ps_ranks *ranks, const ps_ranks_plan *plan,
                              const ps_kind *kind, const ps_request *request,
                              const ps_answer_hooks *hooks, ps_error *error) {
    work self = {.ranks = ranks,
                 .kind = kind,
                 .request = request,
                 .hooks = *hooks,
                 .watch = &hooks->watch,
                 .has_range = find_range(ranks, plan->num_realizations).end > 0};
    *out = (ps_answer){0};
    pspec_status status = compare_jobs(&self, error);
    if (status == PSPEC_OK) {
        status = run(out, &self, plan, error);
    }
    if (status == PSPEC_OK) {
        ps_answer_end_checkpoints(&self.own);
    }
    ps_text_free(&self.checkpoint);
    ps_text_free(&self.key);
    return status;
}
