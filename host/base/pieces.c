#include "base/pieces.h"

typedef struct piece {
    void (*task)(void *payload, size_t i);
    void *payload;
    size_t begin, end;
    unsigned count;
} piece;

static void do_share(void *payload, unsigned index) {
    const piece *const self = payload;
    for (size_t i = self->begin + index; i < self->end; i += self->count) {
        self->task(self->payload, i);
    }
}

pspec_status ps_pieces_do(ps_pieces *pieces, size_t num, void (*task)(void *payload, size_t i),
                          void *payload, ps_error *error) {
    const unsigned count = ps_workers_count(pieces->workers);
    const size_t most = pieces->each * count;
    for (size_t begin = 0; begin < num; begin += most) {
        const size_t end = num - begin < most ? num : begin + most;
        piece now = {task, payload, begin, end, count};
        PS_TRY(
            ps_watch_tell(pieces->watch, pieces->phase, pieces->done, pieces->total, NULL, error));
        ps_workers_run(pieces->workers, do_share, &now);
        pieces->done += end - begin;
    }
    return PSPEC_OK;
}

pspec_status ps_pieces_share(const ps_watch *watch, const char *phase, size_t work, size_t num,
                             void (*task)(void *payload, size_t i), void *payload,
                             ps_error *error) {
    enum { WORK_AT_A_TIME = 1 << 22 }; /* it takes some hundredths of a second */
    ps_workers *const workers =
        num > 1 && work >= PS_WORKERS_LEAST ? ps_workers_create(PS_WORKERS_MOST) : NULL;
    const size_t work_of_one = work / (num > 0 ? num : 1) + 1;
    ps_pieces pieces = {.workers = workers,
                        .each = work_of_one < WORK_AT_A_TIME ? WORK_AT_A_TIME / work_of_one : 1,
                        .watch = watch,
                        .phase = phase,
                        .total = num};
    const pspec_status status = ps_pieces_do(&pieces, num, task, payload, error);
    ps_workers_destroy(workers);
    return status;
}
