/* What the host hands to the device batch after batch, through two buffers in turns: it fills one
 * while the device reads the other (ps_mapping_begin).
 */
#ifndef PS_ENGINES_FEED_H
#define PS_ENGINES_FEED_H

#include "device/device.h"

typedef struct ps_feed {
    ps_device *device;
    ps_buffer filled;     /* what was filled last: one of the buffers below, which the feed owns */
    ps_buffer buffers[2]; /* with twins */
    ps_mapping mapping;   /* of the next one */
    unsigned next;
} ps_feed;

/* Zeroed memory must be given; free it also after a failure. */
pspec_status ps_feed_create(ps_feed *out, size_t bytes, ps_device *device,
                            ps_error *error) PS_MUST_CHECK;
void ps_feed_free(ps_feed *feed);
/* Memory to fill. Waits for what was launched before the last ps_feed_end; when it is not followed
 * by an end, the next one gives the same memory. */
pspec_status ps_feed_begin(ps_feed *feed, void **data, ps_error *error) PS_MUST_CHECK;
/* Launches from now on find the first bytes in `filled`. */
pspec_status ps_feed_end(ps_feed *feed, size_t bytes, ps_error *error) PS_MUST_CHECK;
/* Nobody fills the buffers for now: kernels write `filled`. */
void ps_feed_leave(ps_feed *feed);

#endif
