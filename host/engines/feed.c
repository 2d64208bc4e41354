#include "engines/feed.h"

static pspec_status map_next(ps_feed *self, ps_error *error) {
    return ps_mapping_begin(self->device, &self->mapping, &self->buffers[self->next], error);
}

pspec_status ps_feed_create(ps_feed *out, size_t bytes, ps_device *device, ps_error *error) {
    static const char what[] = "points";
    *out = (ps_feed){.device = device};
    for (unsigned i = 0; i < 2; i++) {
        PS_TRY(ps_buffer_create(device, &out->buffers[i], bytes, what, error));
        PS_TRY(ps_buffer_add_twin(device, &out->buffers[i], what, error));
    }
    out->filled = out->buffers[0];
    /* Before all launches, so that the first ones are not waited for, either. */
    return map_next(out, error);
}

void ps_feed_free(ps_feed *feed) {
    ps_feed_leave(feed);
    ps_buffer_release(&feed->buffers[0]);
    ps_buffer_release(&feed->buffers[1]);
    *feed = (ps_feed){0};
}

pspec_status ps_feed_begin(ps_feed *feed, void **data, ps_error *error) {
    if (feed->mapping.data == NULL) {
        PS_TRY(map_next(feed, error));
    }
    *data = feed->mapping.data;
    return ps_mapping_wait(&feed->mapping, error);
}

/* The other buffer is asked for before the launches that read this one, which need not be waited
 * for then. */
pspec_status ps_feed_end(ps_feed *feed, size_t bytes, ps_error *error) {
    PS_TRY(ps_mapping_end(feed->device, &feed->mapping, bytes, error));
    feed->filled = feed->buffers[feed->next];
    feed->next = 1 - feed->next;
    return map_next(feed, error);
}

void ps_feed_leave(ps_feed *feed) {
    if (feed->mapping.data != NULL) {
        ps_mapping_abandon(feed->device, &feed->mapping);
    }
}
