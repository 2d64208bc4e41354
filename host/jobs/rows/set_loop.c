#include "jobs/rows/set_loop.h"

#include "device/kind.h"

static pspec_status walk(void *payload, ps_snapshot *snapshot, ps_error *error) {
    ps_set_loop *const self = payload;
    uint64_t counts[] = {self->num_done, self->is_complete};
    PS_TRY(ps_snapshot_counts(snapshot, "loop", counts, 2, error));
    self->num_done = counts[0];
    self->is_complete = counts[1] != 0;
    PS_TRY(ps_row_stream_walk(&self->stream, snapshot, error));
    return self->walk(self->stream.job, snapshot, error);
}

static pspec_status open_checkpoint(ps_set_loop *self, ps_error *error) {
    const ps_device *const device = self->stream.device;
    ps_text key = {0};
    ps_device_identify(&key, device != NULL ? ps_device_get_limits(device) : NULL);
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
    ps_row_stream_join(&self->stream, self->spec);
    if (self->spec != NULL && self->spec->path != NULL) {
        PS_TRY(open_checkpoint(self, error));
    }
    ps_snapshot *const found =
        self->checkpoint != NULL ? ps_checkpoint_found(self->checkpoint) : NULL;
    if (found != NULL) {
        PS_TRY(walk(self, found, error));
        ps_checkpoint_forget(self->checkpoint);
    }
    return self->is_complete ? PSPEC_OK : ps_row_stream_begin(&self->stream, self->num_done, error);
}

static pspec_status run(ps_set_loop *self, ps_error *error) {
    ps_row_stream *const stream = &self->stream;
    PS_TRY(begin(self, error));
    while (!self->is_complete) {
        size_t num = 0;
        const pspec_status status = ps_row_stream_next(stream, UINT64_MAX, &num, error);
        if (status != PSPEC_OK) {
            return ps_checkpoint_keep_cancelled(self->checkpoint, status, self->num_done, walk,
                                                self, error);
        }
        for (size_t i = 0; i < num; i++) {
            self->take(stream->job, self->num_done++, ps_row_stream_row(stream, i));
        }
        self->is_complete = num == 0;
        PS_TRY(ps_checkpoint_keep(self->checkpoint, self->is_complete, walk, self, error));
    }
    return PSPEC_OK;
}

pspec_status ps_set_loop_run(ps_set_loop *loop, ps_error *error) {
    const pspec_status status = run(loop, error);
    ps_row_stream_free(&loop->stream);
    ps_checkpoint_close(loop->checkpoint);
    loop->checkpoint = NULL;
    return status;
}

static pspec_status pass(ps_source *source, uint64_t num, const ps_watch *watch, uint64_t *passed,
                         ps_point_set *set, ps_error *error) {
    bool has_set = true;
    for (*passed = ps_source_skip(source, num); *passed < num; (*passed)++) {
        PS_TRY(ps_watch_tell(watch, "sets passed over", *passed, num, NULL, error));
        PS_TRY(ps_source_next_whole(source, set, &has_set, error));
        if (!has_set) {
            return PSPEC_OK;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_source_pass(ps_source *source, uint64_t num, const ps_watch *watch,
                            uint64_t *passed, ps_error *error) {
    ps_point_set set = {0};
    const pspec_status status = pass(source, num, watch, passed, &set, error);
    ps_point_set_free(&set);
    return status;
}
