#include "jobs/set_loop.h"

#include "device/kind.h"

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_set_loop *const self = payload;
    uint64_t counts[] = {self->num_done, self->is_complete};
    PS_TRY(ps_snapshot_counts(snapshot, "loop", counts, 2, error));
    self->num_done = counts[0];
    self->is_complete = counts[1] != 0;
    return self->walk(self->job, snapshot, error);
}

static pspec_status open_checkpoint(ps_set_loop *self, ps_error *error) {
    ps_text key = {0};
    ps_device_identify(&key, self->device != NULL ? ps_device_get_limits(self->device) : NULL);
    pspec_status status = ps_text_check(&key, error);
    if (status == PSPEC_OK) {
        status = ps_checkpoint_open(&self->checkpoint, self->spec, ps_text_string(&key), error);
    }
    ps_text_free(&key);
    return status;
}

static pspec_status begin(ps_set_loop *self, ps_error *error) {
    self->num_done = 0;
    self->is_complete = false;
    if (self->spec == NULL || self->spec->path == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(open_checkpoint(self, error));
    if (ps_checkpoint_found(self->checkpoint) == NULL) {
        return PSPEC_OK;
    }
    PS_TRY(walk(self, ps_checkpoint_found(self->checkpoint), error));
    ps_checkpoint_forget(self->checkpoint);
    return self->is_complete || self->skip == NULL ? PSPEC_OK
                                                   : self->skip(self->job, self->num_done, error);
}

static pspec_status run(ps_set_loop *self, ps_error *error) {
    PS_TRY(begin(self, error));
    while (!self->is_complete) {
        size_t num = 0;
        const pspec_status status = self->give(self->job, self->num_done, &num, error);
        if (status != PSPEC_OK) {
            return ps_checkpoint_keep_cancelled(self->checkpoint, status, self->num_done, walk,
                                                self, error);
        }
        self->num_done += num;
        self->is_complete = num == 0;
        PS_TRY(ps_checkpoint_keep(self->checkpoint, self->is_complete, walk, self, error));
    }
    return PSPEC_OK;
}

pspec_status ps_set_loop_run(ps_set_loop *loop, ps_error *error) {
    const pspec_status status = run(loop, error);
    ps_checkpoint_close(loop->checkpoint);
    loop->checkpoint = NULL;
    return status;
}

static pspec_status pass(ps_source *source, uint64_t num, const ps_watch *watch, ps_point_set *set,
                         ps_error *error) {
    const uint64_t skipped = ps_source_skip(source, num);
    bool has_set = true;
    for (uint64_t i = skipped; has_set && i < num; i++) {
        PS_TRY(ps_watch_tell(watch, "sets passed over", i, num, NULL, error));
        PS_TRY(ps_source_next_whole(source, set, &has_set, error));
    }
    return has_set ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INPUT,
                             "there are fewer sets than the %llu that are passed over",
                             (unsigned long long)num);
}

pspec_status ps_source_pass(ps_source *source, uint64_t num, const ps_watch *watch,
                            ps_error *error) {
    ps_point_set set = {0};
    const pspec_status status = pass(source, num, watch, &set, error);
    ps_point_set_free(&set);
    return status;
}
