#include "answers/spectra/measured.h"

#include "answers/spectra/spectrum_header.h"
#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ---- what is told ---------------------------------------------------------------------------- */

static void put_random(ps_header *self, const ps_request *arguments) {
    if (ps_request_has_told(arguments) || arguments->frequencies.per_ring > 0) {
        ps_header_put(self, "seed", PS_INTEGER(arguments->seed));
    }
    if (ps_request_has_samplers(arguments)) {
        ps_header_put(self, "homogenize", PS_TEXT(arguments->homogenize ? "yes" : "no"));
    }
}

/* Points of a smaller box look like a spectrum of clusters. */
static void put_empty_axis(ps_header *self, const ps_power_job *job) {
    char text[192];
    ps_empty_axis empty = {0};
    if (ps_axis_cells_find_empty(&job->sets.first_cells, &empty)) {
        snprintf(text, sizeof text,
                 "axis %u of the first set has no point from %.3g to %.3g%s: if the points are of "
                 "a smaller box, --box X0,X1 takes that for the unit cell",
                 empty.axis + 1, empty.begin, empty.end,
                 empty.end <= empty.begin ? ", through 1" : "");
        ps_header_put(self, "empty", PS_TEXT(text));
    }
}

/* That of the first set; of the others what changes powers: their edges. */
static void put_boxes(ps_header *self, const ps_power_job *job) {
    const ps_boxes *const boxes = &job->sets.boxes;
    const ps_frequencies *const set = job->problem.frequencies;
    ps_text text = {0};
    self->status = self->status == PSPEC_OK
                       ? ps_header_add_box(self->table, &boxes->first, self->error)
                       : self->status;
    if (!boxes->differ) {
        return;
    }
    for (unsigned i = 0; i < boxes->dimension; i++) {
        ps_text_append(&text, "%s%.10g to %.10g", i > 0 ? ", " : "edges of the sets are ",
                       boxes->shortest[i], boxes->longest[i]);
    }
    if (boxes->differ_in_shape && set->max_norm2 > 0) {
        ps_text_append(&text, "; rings are those of the first");
    }
    if (self->status == PSPEC_OK) {
        self->status = ps_text_check(&text, self->error);
    }
    ps_header_put(self, "box_changes", PS_TEXT(ps_text_string(&text)));
    ps_text_free(&text);
}

static void put_files(ps_header *self, const ps_request *arguments, const ps_power_job *job) {
    const bool predicts = job->question->num_sets > 0 && arguments->num_shifts > 0;
    self->status =
        self->status == PSPEC_OK
            ? ps_header_add_files(
                  self->table, job->question->paths, job->question->num_paths,
                  job->question->range.end > 0 ? job->num_all : job->spectrum.num_realizations,
                  predicts ? " to predict, the others to measure" : ", one average", self->error)
            : self->status;
    ps_header_put(self, "input_format", PS_TEXT(ps_source_format(job->sets.source)));
    ps_header_put(self, "input_columns", PS_TEXT(ps_source_columns(job->sets.source)));
    put_boxes(self, job);
    self->status = self->status == PSPEC_OK
                       ? ps_header_add_lift(self->table, &arguments->reading, self->error)
                       : self->status;
}

static void put_source(ps_header *self, const ps_request *arguments, const ps_power_job *job,
                       size_t index) {
    const ps_sampler_request *const sampler = job->question->sampler;
    const char *const note = sampler != NULL ? ps_sampler_note(sampler) : NULL;
    self->status = self->status == PSPEC_OK
                       ? ps_lead_add_source(self->table, arguments, index, self->error)
                       : self->status;
    if (note != NULL) {
        ps_header_put(self, "sampler_note", PS_TEXT(note));
    }
    if (sampler == NULL) {
        put_files(self, arguments, job);
    }
}

static void put_computed(ps_header *self, const ps_power_job *job) {
    const ps_device_limits *const limits = ps_device_get_limits(job->device);
    const ps_candidate *const chosen = job->plan.chosen;
    ps_text skipped = {0};
    ps_header_put(self, "device",
                  PS_TEXT(limits != NULL && chosen->engine->needs_device ? limits->name : "host"));
    ps_header_put(self, "engine", PS_TEXT(ps_text_string(&job->description)));
    ps_header_put(self, "precision", PS_TEXT(ps_precision_name(chosen->precision)));
    ps_header_put(self, "tolerance", PS_NUMBER(job->problem.tolerance));
    if (job->runner.num_replans > 0) {
        ps_header_put(self, "planned_twice",
                      PS_TEXT("the powers measured needed a more exact engine"));
    }
    ps_needs_describe(&job->needs, &skipped);
    if (self->status == PSPEC_OK) {
        self->status = ps_text_check(&skipped, self->error);
    }
    ps_header_put(self, "skipped", PS_TEXT(ps_text_string(&skipped)));
    ps_text_free(&skipped);
}

static pspec_status tell(ps_table *table, const ps_request *arguments, const ps_power_job *job,
                         size_t index, ps_error *error) {
    ps_header self = {table, error, PSPEC_OK};
    put_random(&self, arguments);
    put_source(&self, arguments, job, index);
    put_empty_axis(&self, job);
    put_computed(&self, job);
    return self.status;
}

/* ---- jobs ------------------------------------------------------------------------------------ */

static ps_measured measure(const ps_power_job *job) {
    const ps_accuracy *const accuracy = &job->runner.accuracy;
    return (ps_measured){
        .spectrum = &job->spectrum,
        .c2 = job->c2,
        .are_pair_sums = job->problem.measure == PS_OF_PAIR_SUMS,
        .is_one_for_all = job->needs.one_realization,
        .error = accuracy->error,
        .self_check = accuracy->was_checked ? accuracy->self_check : NAN,
        .length_error = accuracy->length_error,
        .look = job->has_look ? &job->look : NULL,
        .range = job->question->range,
        .num_all = job->num_all,
        .job = job,
    };
}

pspec_status ps_measured_of_jobs(ps_measured **out, const ps_request *arguments,
                                 const ps_power_job *const *jobs, size_t num, ps_error *error) {
    PS_TRY(PS_NEW(out, num, "answers of jobs", error));
    for (size_t i = 0; i < num; i++) {
        ps_table *told = NULL;
        PS_TRY(ps_table_create(&told, "", NULL, 0, error));
        (*out)[i] = measure(jobs[i]);
        (*out)[i].lead = ps_lead_make(arguments, i);
        (*out)[i].told = told;
        PS_TRY(tell(told, arguments, jobs[i], i, error));
    }
    return PSPEC_OK;
}

void ps_measured_free(ps_measured *all, size_t num) {
    for (size_t i = 0; all != NULL && i < num; i++) {
        ps_table_destroy(all[i].told);
    }
    free(all);
}

pspec_status ps_header_add_job(ps_table *table, const ps_request *arguments,
                               const ps_power_job *job, bool begins, ps_error *error) {
    ps_measured *one = NULL;
    pspec_status status = ps_measured_of_jobs(&one, arguments, &job, 1, error);
    if (status == PSPEC_OK) {
        status = begins ? ps_header_begin(table, arguments, one, error)
                        : ps_header_add(table, arguments, one, 1, 0, error);
    }
    ps_measured_free(one, 1);
    return status;
}

/* ---- tables ---------------------------------------------------------------------------------- */

pspec_status ps_spectra_make_table(ps_table **out, const ps_spectra_table *kind,
                                   const ps_request *request, const ps_measured *all, size_t num,
                                   ps_error *error) {
    const char *columns[PS_MOST_COLUMNS_AFTER_LEAD];
    const size_t num_columns = kind->choose_columns(columns, request, &all[0]);
    PS_TRY(ps_lead_create_table(out, kind->name, &all[0].lead, columns, num_columns, error));
    PS_TRY(ps_header_begin(*out, request, all, error));
    for (size_t i = 0; i < num; i++) {
        PS_TRY(ps_header_add(*out, request, all, num, i, error));
        PS_TRY(kind->add_rows(*out, request, &all[i], error));
    }
    return kind->add_arrays != NULL ? kind->add_arrays(*out, request, &all[0], error) : PSPEC_OK;
}
