#include "jobs/source.h"

/* Points that are only counted: few enough to stay in the cache. */
enum { BLOCK_POINTS = 32768 };

void ps_scout_close(ps_scout *scout) {
    ps_points_close(scout->reader);
    *scout = (ps_scout){0};
}

static pspec_status go_on(const ps_source_options *options, ps_error *error) {
    return options->should_stop != NULL && options->should_stop(options->payload)
               ? ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted while points were counted")
               : PSPEC_OK;
}

/* *block is room. */
static pspec_status count_set(ps_scout *scout, const ps_source_options *options,
                              ps_point_set *block, ps_pattern_count *count, ps_error *error) {
    bool has_block = true;
    for (bool ends_set = false; has_block && !ends_set;) {
        block->num_points = 0;
        PS_TRY(go_on(options, error));
        PS_TRY(
            ps_points_next_block(scout->reader, block, BLOCK_POINTS, &has_block, &ends_set, error));
        const pspec_pattern pattern = {block->dimension, block->num_points, block->points,
                                       block->has_weights ? block->weights : NULL};
        PS_TRY(ps_pattern_count_add(count, &pattern, error));
    }
    scout->num_sets++;
    return PSPEC_OK;
}

pspec_status ps_scout_count(ps_scout *scout, const char *path, const ps_source_options *options,
                            uint64_t number, ps_pattern_count *count, ps_error *error) {
    const ps_pattern_count none = {.realization = count->realization,
                                   .on_sphere = options->points.domain == PS_DOMAIN_SPHERE};
    ps_point_set block = {0};
    pspec_status status = PSPEC_OK;
    if (scout->reader == NULL) {
        PS_TRY(ps_points_open(&scout->reader, path, &options->points, error));
    }
    while (status == PSPEC_OK && scout->num_sets < number) {
        *count = none;
        status = count_set(scout, options, &block, count, error);
    }
    ps_point_set_free(&block);
    return status;
}
