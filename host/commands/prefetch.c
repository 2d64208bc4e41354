#include "commands/prefetch.h"
#include "request/point_source.h"

#include "answers/parts/parts.h"
#include "answers/points/points.h"
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "plan/specs.h"

#include <inttypes.h>
#include <stdlib.h>

typedef struct prefetch {
    ps_sampler_request sampler;
    const char *text; /* as it was typed */
    uint64_t num;
    ps_dealt own; /* of these, made here */
    ps_sets_options options;
    double *points; /* of one realization */
} prefetch;

/* ---- before the work ----------------------------------------------------------------------- */

static pspec_status fail_cheap(const prefetch *self, ps_error *error) {
    ps_text names = {0};
    for (size_t i = 0; ps_samplers[i] != NULL; i++) {
        if (ps_samplers[i]->version > 0) {
            ps_text_append(&names, "%s%s", names.length > 0 ? ", " : "", ps_samplers[i]->name);
        }
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
            "--prefetch: %s makes %zu points about as fast as they are read, so they are not kept; "
            "%s%s %s",
            self->text, self->sampler.num_points,
            self->sampler.sampler->version > 0 ? "larger sets are, of " : "sets are of ",
            ps_text_string(&names), "where they take more than 2 ms");
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

static pspec_status begin(prefetch *out, const ps_request *request, size_t question,
                          ps_error *error) {
    *out = (prefetch){.text = ps_request_sampler(request, question),
                      .num = request->num_realizations,
                      .options = ps_limits_sets(&request->limits, false)};
    PS_TRY(ps_sampler_request_make(&out->sampler, request, question, error));
    if (!ps_sets_are_expensive(&out->sampler)) {
        return fail_cheap(out, error);
    }
    PS_TRY(
        ps_points_check_memory(&out->sampler, 1, request->limits.constraints.memory_limit, error));
    return out->options.place.cache_folder != NULL
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO,
                         "--prefetch: there is no folder to keep sets in; set POINTSPEC_CACHE_DIR "
                         "to one that no other user can write");
}

/* All sets must have room beside each other, or the last ones would drive out the first. */
static pspec_status check_room(const ps_request *request, ps_error *error) {
    double bytes = 0;
    double allowed = 0;
    for (size_t i = 0; i < ps_request_num_questions(request); i++) {
        prefetch one;
        PS_TRY(begin(&one, request, i, error));
        bytes += (double)one.num * (double)ps_set_store_bytes(&one.sampler);
        allowed = (double)one.options.place.max_bytes;
    }
    char needed_text[PS_SIZE_TEXT];
    char allowed_text[PS_SIZE_TEXT];
    return bytes <= allowed
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "--prefetch: %" PRIu64 " sets take %s on the disk, above --kept-sets, %s",
                         request->num_realizations * ps_request_num_questions(request),
                         ps_size_show(needed_text, bytes), ps_size_show(allowed_text, allowed));
}

/* ---- the work ------------------------------------------------------------------------------ */

/* A set that cannot be kept was made in vain, and so would be those behind it. Without a store none
 * is read or kept. */
static pspec_status check_store(const prefetch *self, ps_sets *sets, ps_error *error) {
    const ps_set_counts counts = ps_sets_counts(sets);
    if (counts.num_lost == 0 && counts.num_read + counts.num_kept > 0) {
        return PSPEC_OK;
    }
    const char *const trouble = ps_sets_trouble(sets); /* no thread keeps sets any more */
    const uint64_t kept = ps_sets_count_kept(&self->sampler, &self->options.place, self->num);
    return ps_fail(error, PSPEC_ERROR_IO, "%s; %" PRIu64 " of %" PRIu64 " not kept", trouble,
                   self->num - kept, self->num);
}

static pspec_status make_sets(const prefetch *self, ps_sets *sets, const ps_answer_hooks *hooks,
                              ps_error *error) {
    size_t num_points = 0;
    for (uint64_t r = 0; r < self->own.num; r++) {
        PS_TRY(ps_sets_next(sets, self->points, &num_points, &hooks->watch, error));
        PS_TRY(check_store(self, sets, error));
        const pspec_status status =
            ps_watch_tell(&hooks->watch, "realizations", r + 1, self->own.num, NULL, error);
        PS_TRY(ps_sets_say_kept(sets, status, error));
    }
    return PSPEC_OK;
}

static void tell(const prefetch *self, ps_sets *sets, const ps_answer_hooks *hooks) {
    const ps_set_counts counts = ps_sets_counts(sets);
    if (hooks->team != NULL) {
        ps_answer_warn(hooks, "%s, %zu points: all %" PRIu64 " sets are kept in %s/sets",
                       self->text, self->sampler.num_points, self->num,
                       self->options.place.cache_folder);
        return;
    }
    ps_answer_warn(hooks,
                   "%s, %zu points: %" PRIu64 " sets were kept already, %" PRIu64
                   " are made and kept in %s/sets",
                   self->text, self->sampler.num_points, counts.num_read, counts.num_kept,
                   self->options.place.cache_folder);
}

static pspec_status run(const prefetch *self, const ps_answer_hooks *hooks, ps_error *error) {
    ps_sets *sets = NULL;
    PS_TRY(ps_sets_create(&sets, &self->sampler, self->own.num, &self->options, error));
    ps_answer_begin_next(hooks);
    const pspec_status status = make_sets(self, sets, hooks, error);
    ps_answer_end(hooks);
    if (status == PSPEC_OK) {
        ps_answer_warn_of(hooks, ps_sets_trouble(sets));
    }
    if (status == PSPEC_OK && self->own.num == self->num) {
        tell(self, sets, hooks);
    }
    ps_sets_destroy(sets);
    return status;
}

/* All sets, or one of so many shares of them. */
static pspec_status prefetch_one(const ps_request *request, size_t question, size_t share,
                                 size_t num_shares, const ps_answer_hooks *hooks, ps_error *error) {
    prefetch self;
    void *points = NULL;
    PS_TRY(begin(&self, request, question, error));
    self.own = ps_parts_deal(self.num, num_shares, share);
    self.options.first = self.own.first;
    if (self.own.num == 0) {
        return PSPEC_OK;
    }
    PS_TRY(ps_allocate(&points, ps_sampler_most_points(&self.sampler),
                       self.sampler.dimension * sizeof(double), "points", error));
    self.points = points;
    const pspec_status status = run(&self, hooks, error);
    free(points);
    return status;
}

static pspec_status prefetch_all(const ps_request *request, size_t share, size_t num_shares,
                                 const ps_answer_hooks *hooks, ps_error *error) {
    for (size_t i = 0; i < ps_request_num_questions(request); i++) {
        PS_TRY(prefetch_one(request, i, share, num_shares, hooks, error));
    }
    return PSPEC_OK;
}

pspec_status ps_points_prefetch(const ps_request *request, const ps_answer_hooks *hooks,
                                ps_error *error) {
    const ps_team *const team = hooks->team;
    PS_TRY(ps_option_pairs_check(request, PS_COMMAND_sample, error));
    PS_TRY(check_room(request, error));
    if (team != NULL) {
        const pspec_status status = prefetch_all(request, team->own, team->num, hooks, error);
        PS_TRY(ps_team_meet(team, status, error));
    }
    return ps_team_is_led_here(team) ? prefetch_all(request, 0, 1, hooks, error) : PSPEC_OK;
}

pspec_status ps_points_look_at_shares(uint64_t *num, ps_error *why, const ps_request *request,
                                      ps_error *error) {
    (void)error;
    *num = request->num_realizations;
    if (!request->prefetch) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "sample has no realizations that are shared");
    } else if (*num < 2) {
        ps_fail(why, PSPEC_ERROR_INVALID_ARGUMENT, "one set is not shared");
    }
    return PSPEC_OK;
}
