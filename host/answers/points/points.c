/* Points of a sampler as a result of a scene. The command sample writes the same points to files.
 */
#include "answers/points/points.h"

#include "answers/kind.h"
#include "base/memory.h"
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "files/digest.h"
#include "jobs/point_phases.h"
#include "jobs/source.h"
#include "jobs/spectrum/power_phases.h"
#include "request/point_source.h"

#include <stdlib.h>
#include <string.h>

typedef struct realization {
    size_t num_points;
    char digest[PS_DIGEST_BYTES]; /* of the coordinates */
} realization;

typedef struct points_answer {
    const ps_request *arguments;
    ps_sampler_request sampler;
    uint64_t num;
    realization *all;
    uint64_t num_kept; /* sets that the answer has whole: none, the first, or all */
    double *points;    /* of these, one after the other */
} points_answer;

/* ---- the question -------------------------------------------------------------------------- */

double ps_points_bytes(const ps_sampler_request *sampler, double num_sets) {
    const double points = num_sets * (double)ps_sampler_most_points(sampler);
    return points * sampler->dimension * (double)sizeof(double) + ps_sampler_work_bytes(sampler);
}

pspec_status ps_points_check_memory(const ps_sampler_request *sampler, double num_sets,
                                    uint64_t limit, ps_error *error) {
    const double bytes = ps_points_bytes(sampler, num_sets);
    const bool has_work = ps_sampler_work_bytes(sampler) > 0;
    ps_memory_room room = {limit, "above the limit of"};
    char needed[PS_SIZE_TEXT];
    char allowed[PS_SIZE_TEXT];
    if (limit == 0) {
        ps_memory_room_find(&room, 0);
    }
    return bytes <= (double)room.bytes
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "%.0f points in %u dimensions take %s of memory%s, %s%s%s %s",
                         num_sets * (double)sampler->num_points, sampler->dimension,
                         ps_size_show(needed, bytes),
                         has_work ? " with what makes a set of them" : "", limit > 0 ? "" : "but ",
                         room.by, limit > 0 ? "" : " leaves",
                         ps_size_show(allowed, (double)room.bytes));
}

/* Sets that the answer has whole: all, the first for a picture, or none. */
static uint64_t count_kept(const ps_request *request) {
    return request->wants_array ? request->num_realizations : request->wants_picture ? 1 : 0;
}

static pspec_status find_sampler(ps_sampler_request *out, const ps_request *request,
                                 ps_error *error) {
    if (request->num_sources != 1) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "sampler: points are of a sampler, and none is named");
    }
    return ps_sampler_request_make(out, request, 0, error);
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_sampler_request sampler;
    PS_TRY(find_sampler(&sampler, request, error));
    /* those that are kept, and the one that is made */
    PS_TRY(ps_points_check_memory(&sampler, (double)count_kept(request) + 1,
                                  request->limits.constraints.memory_limit, error));
    return request->wants_array && request->num_realizations > 1 && ps_sampler_varies(&sampler)
               ? ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "arrays: an array holds sets of the same number of points, and those of "
                         "%s have different ones (exact=yes, or one realization)",
                         ps_request_source_name(request, 0))
               : PSPEC_OK;
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_sampler_request sampler;
    ps_phases phases = ps_plan_table_begin_phases(planner);
    PS_TRY(check_question(request, error));
    PS_TRY(find_sampler(&sampler, request, error));
    ps_phases_start(&phases, NULL, NULL);
    const ps_sets_options kept = ps_limits_sets(&request->limits, request->accuracy.no_skip);
    ps_phases_sample(&phases, &sampler, (double)request->num_realizations, &kept);
    return ps_plan_table_add_host(planner, &phases,
                                  ps_points_bytes(&sampler, (double)count_kept(request) + 1),
                                  "points of one sampler, one realization at a time", error);
}

/* ---- the answer ---------------------------------------------------------------------------- */

/* Sets that are kept have the same number of points, unless there is one. */
static pspec_status take_set(points_answer *self, const ps_point_set *set, uint64_t r,
                             ps_error *error) {
    const size_t num = set->num_points * set->dimension;
    self->all[r].num_points = set->num_points;
    ps_digest_bytes(set->points, num * sizeof *set->points, self->all[r].digest);
    if (r >= self->num_kept) {
        return PSPEC_OK;
    }
    if (r == 0) {
        PS_TRY(ps_allocate_for(&self->points, self->num_kept * num, sizeof *self->points, "points",
                               error));
    }
    memcpy(self->points + r * num, set->points, num * sizeof *set->points);
    return PSPEC_OK;
}

static pspec_status take_sets(points_answer *self, ps_source *source, const ps_watch *watch,
                              ps_error *error) {
    ps_point_set set = {0};
    ps_source_part part;
    pspec_status status = PSPEC_OK;
    bool has_set = true;
    for (uint64_t r = 0; r < self->num; r++) {
        PS_TRY_OUT(status, ps_source_next(source, &set, &part, &has_set, error));
        PS_TRY_OUT(status, take_set(self, &set, r, error));
        PS_TRY_OUT(status, ps_watch_tell(watch, "realizations", r + 1, self->num, NULL, error));
    }
out:
    ps_point_set_free(&set);
    return status;
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    ps_source *source = NULL;
    PS_TRY(check_question(request, error));
    PS_TRY(ps_allocate(out, 1, sizeof(points_answer), "an answer", error));
    points_answer *const self = *out;
    *self = (points_answer){.arguments = request, .num = request->num_realizations};
    self->num_kept = count_kept(request);
    PS_TRY(find_sampler(&self->sampler, request, error));
    PS_TRY(PS_NEW(&self->all, self->num, "realizations", error));
    const ps_sets_options kept = ps_limits_sets(&request->limits, request->accuracy.no_skip);
    PS_TRY(ps_source_sampler(&source, &self->sampler, self->num, &kept, &hooks->watch, error));
    const pspec_status status = take_sets(self, source, &hooks->watch, error);
    ps_answer_warn_of(hooks, status == PSPEC_OK ? ps_source_trouble(source) : "");
    ps_source_destroy(source);
    return status;
}

static void discard(void *computed) {
    points_answer *const self = computed;
    if (self != NULL) {
        free(self->all);
        free(self->points);
        free(self);
    }
}

/* ---- what it comes to ---------------------------------------------------------------------- */

/* Mean number of points: a whole one unless realizations differ. */
static ps_cell mean_points(const points_answer *self) {
    double sum = 0;
    for (uint64_t r = 0; r < self->num; r++) {
        sum += (double)self->all[r].num_points;
    }
    const double mean = sum / (double)self->num;
    return mean == floor(mean) ? PS_INTEGER((long long)mean) : PS_NUMBER(mean);
}

static pspec_status add_header(ps_table *table, const points_answer *self, ps_error *error) {
    static const char *const domains[] = {[PS_SAMPLES_TORUS] = "torus",
                                          [PS_SAMPLES_SPHERE] = "sphere",
                                          [PS_SAMPLES_HEMISPHERE] = "hemisphere"};
    const char *const note = ps_sampler_note(&self->sampler);
    const ps_meta entries[] = {
        {"device", PS_TEXT("none")},
        {"engine", PS_TEXT("host")},
        {"precision", PS_TEXT("double")},
        {"sampler", PS_TEXT(ps_request_source_name(self->arguments, 0))},
        {"domain", PS_TEXT(domains[ps_sampler_where(&self->sampler)])},
        {"dimension", PS_INTEGER(self->sampler.dimension)},
        {"points", mean_points(self)},
        {"realizations", PS_INTEGER(self->num)},
        {"seed", PS_INTEGER(self->sampler.seed)},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_lead_add_origin(table, self->arguments->command_line, error));
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return note != NULL ? ps_table_add_meta(table, "sampler_note", PS_TEXT(note), error) : PSPEC_OK;
}

/* Shape (M, N, D), as sample writes it. */
static pspec_status add_points(ps_table *table, const points_answer *self, ps_error *error) {
    const size_t shape[] = {(size_t)self->num_kept, self->all[0].num_points,
                            self->sampler.dimension};
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, sizeof shape / sizeof shape[0], shape, false, error));
    memcpy(array.data, self->points, array.num * sizeof *array.data);
    return ps_table_add_array(table, "coordinates", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const points_answer *const self = computed;
    static const char *const columns[] = {"realization", "points", "digest"};
    enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };
    (void)request;
    PS_TRY(ps_table_create(&out->table, "sample", columns, NUM_COLUMNS, error));
    PS_TRY(add_header(out->table, self, error));
    for (uint64_t r = 0; r < self->num; r++) {
        const ps_cell cells[NUM_COLUMNS] = {PS_INTEGER(r), PS_INTEGER(self->all[r].num_points),
                                            PS_TEXT(self->all[r].digest)};
        PS_TRY(ps_table_add_row(out->table, cells, error));
    }
    return self->num_kept > 0 ? add_points(out->table, self, error) : PSPEC_OK;
}

static const char *const summary[] = {"points",    "realizations", "domain",
                                      "dimension", "seed",         NULL};

static const ps_field_row own_fields[] = {
    {"realization", "", PS_COLUMN, 0, "", "its number, from 0 on"},
    {"points", "", PS_COLUMN, 0, "", "N of the set"},
    {"digest", "", PS_COLUMN, 0, "", "128 bits of its coordinates, as 32 hexadecimal digits"},
    {"coordinates", "", PS_FIELD_ARRAY, false, 0, "arrays of a scene",
     "the points, float64 [M][N][D], as sample writes them"},
    {.name = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked, ps_fields_points, own_fields,
                                             ps_fields_computed, NULL};

static const ps_compared_field compared[] = {{"digest", NULL, false, NULL}, {.value = NULL}};

static const ps_picture_kind pictures[] = {
    {.make = ps_points_figure, .dealing = PS_OF_SETS, .by = PS_BY_SCENE}, {.make = NULL}};

const ps_kind ps_kind_points = {
    .name = "sample",
    .takes = PS_COMMAND_BIT(sample),
    .samples = PS_DOMAIN_ANY,
    .counted = "realizations",
    .is_of_host = true,
    .has_arrays = true,
    .pictures = pictures,
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .compared = compared,
};
