/* Patterns that come in blocks. */
#include "base/round.h"
#include "jobs/estimator_private.h"
#include "jobs/self_check.h"

#include <inttypes.h>

static const ps_engine_stream *stream_of(const ps_estimator *self) {
    return self->options.engine->stream;
}

/* Blocks are whole units of the engine's, large enough for the self-check. */
static size_t block_unit(const ps_estimator *self) {
    const size_t unit = stream_of(self)->unit(self->engine_state);
    return (size_t)ps_round_up(PS_SELF_CHECK_POINTS, unit);
}

bool ps_estimator_can_stream(const ps_estimator *estimator) {
    return estimator->engine_state != NULL && stream_of(estimator) != NULL &&
           estimator->options.coefficients == NULL && /* they are of whole sets */
           stream_of(estimator)->unit(estimator->engine_state) > 0;
}

/* Drivers may refuse memory no sooner than at the first use: a smaller engine begins anew, while
 * there is nothing to lose. */
static pspec_status begin(ps_estimator *self, ps_error *error) {
    for (;;) {
        const pspec_status status = stream_of(self)->begin(self->engine_state, error);
        if (status != PSPEC_ERROR_MEMORY || self->batch == 1) {
            return status;
        }
        ps_estimator_halve_batch(self);
        PS_TRY(ps_estimator_make_engine(self, error));
    }
}

/* The first block is also what the self-check looks at. */
static pspec_status start(ps_estimator *self, const pspec_pattern *first, ps_error *error) {
    if (self->options.self_check && !self->accuracy.was_checked) {
        PS_TRY(ps_estimator_check_beginning(self, first, error));
        self->accuracy.was_checked = true;
    }
    return begin(self, error);
}

static pspec_status add_blocks(ps_estimator *self, const ps_pattern_stream *stream,
                               ps_pattern_count *count, ps_error *error) {
    const size_t unit = block_unit(self);
    pspec_pattern block = {0};
    PS_TRY(stream->next(stream->payload, unit, &block, error));
    PS_TRY(start(self, &block, error));
    while (block.num_points > 0) {
        const ps_batch batch = ps_estimator_make_batch(self, &block, 1);
        PS_TRY(ps_pattern_count_add(count, &block, error));
        PS_TRY(stream_of(self)->add(self->engine_state, &batch, error));
        PS_TRY(stream->next(stream->payload, unit, &block, error));
    }
    return PSPEC_OK;
}

/* Scales and sizes came before the points; files may change in between. */
static pspec_status check_count(const ps_estimator *self, const ps_pattern_stream *stream,
                                const ps_pattern_count *count, ps_error *error) {
    ps_pattern_sums sums = {0};
    PS_TRY(ps_pattern_count_finish(count, self->options.normalization, &sums, error));
    const bool is_same = count->num_points == stream->num_points &&
                         sums.exponent == stream->sums.exponent &&
                         sums.weight_sum == stream->sums.weight_sum &&
                         sums.weight_square_sum == stream->sums.weight_square_sum;
    return is_same ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_INPUT, "set %" PRIu64 " changed while it was read",
                             count->realization + 1);
}

pspec_status ps_estimator_add_stream(ps_estimator *estimator, const ps_pattern_stream *stream,
                                     ps_error *error) {
    const pspec_pattern whole = {.dimension = stream->dimension,
                                 .num_points = (size_t)stream->num_points};
    ps_pattern_count count = {.realization = ps_estimator_position(estimator),
                              .on_sphere =
                                  ps_problem_domain(&estimator->options.problem) == PS_ON_SPHERE};
    ps_rows rows = {0};
    PS_TRY(ps_pattern_check_dimension(stream->dimension,
                                      estimator->options.problem.frequencies->dimension,
                                      count.realization, error));
    PS_TRY(ps_pattern_check_size(estimator->options.problem.frequencies, stream->num_points,
                                 count.realization, error));
    PS_TRY(ps_estimator_get_ready(estimator, stream->num_points, error));
    ps_estimator_set_sums(estimator, 0, stream->num_points, &stream->sums);
    PS_TRY(add_blocks(estimator, stream, &count, error));
    PS_TRY(check_count(estimator, stream, &count, error));
    PS_TRY(
        stream_of(estimator)->finish(estimator->engine_state, estimator->scales[0], &rows, error));
    PS_TRY(ps_estimator_take(estimator, &rows, &whole, 1, error));
    return ps_estimator_end_segment(estimator, error);
}
