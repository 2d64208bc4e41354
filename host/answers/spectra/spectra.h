/* What kinds of answers that are spectra of point sets share: power, angular and pairs, and the
 * measured side of check. */
#ifndef PS_ANSWERS_SPECTRA_SPECTRA_H
#define PS_ANSWERS_SPECTRA_SPECTRA_H

#include "answers/kind.h"
#include "answers/spectra/measured.h"

/* One job for each question; all have run. */
typedef struct ps_spectra {
    ps_question_list list;
    ps_device *device; /* of all of them, where they share one that was opened for them */
    size_t num_jobs;
    ps_power_job **jobs; /* [num_jobs], which is list.num */
} ps_spectra;

/* Asks and runs. *out is a ps_spectra, for ps_spectra_discard, also after an error; before it is
 * NULL or one to be renewed (ps_kind.compute). */
pspec_status ps_spectra_compute(void **out, const ps_request *request, ps_question_kind kind,
                                const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
void ps_spectra_discard(void *computed);

/* Runs one job of a question, which must outlive it: *job where it can answer it
 * (ps_power_job_renew), else a new one; NULL: there is none. *job may be there after an error. */
pspec_status ps_spectra_run_one(ps_power_job **job, ps_power_question *question,
                                const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* One device for several jobs, whose kernels are then built once. NULL where each job is to find
 * its own: for a single job, where none is needed, and for --profile, which is of one job. Closed
 * by the caller, after the jobs. */
pspec_status ps_answer_open_device(ps_device **out, const ps_request *request,
                                   const ps_plan_constraints *constraints, size_t num_jobs,
                                   const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

/* Phases of a job whose spectrum is a part of it. */
typedef struct ps_plan_more {
    void (*add)(const void *job, ps_phases *phases);
    const void *job;
} ps_plan_more;

/* The plan of number `index` of the questions of a request. more: NULL where the spectrum is all.
 */
pspec_status ps_spectra_plan_job(ps_planner *planner, const ps_request *request,
                                 const ps_power_job *job, const ps_plan_more *more, size_t index,
                                 ps_error *error) PS_MUST_CHECK;

pspec_status ps_spectra_check(const ps_request *request, ps_question_kind kind,
                              ps_error *error) PS_MUST_CHECK;
/* Plans of all questions of a list, and of the list that a request of this kind asks. */
pspec_status ps_spectra_plan_list(ps_planner *planner, const ps_request *request,
                                  ps_question_list *list, ps_error *error) PS_MUST_CHECK;
pspec_status ps_spectra_plan(ps_planner *planner, const ps_request *request, ps_question_kind kind,
                             ps_error *error) PS_MUST_CHECK;

/* The table of all jobs, with state where the request wants it. */
pspec_status ps_spectra_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                 const ps_spectra_table *kind, ps_error *error) PS_MUST_CHECK;
/* State of all jobs, where the request wants it. */
pspec_status ps_spectra_add_state(ps_table *table, const ps_spectra *spectra,
                                  const ps_request *request, ps_error *error) PS_MUST_CHECK;
/* ps_kind.merge */
pspec_status ps_spectra_merge(ps_answer *out, const ps_parts *parts, const ps_spectra_table *kind,
                              ps_error *error) PS_MUST_CHECK;
/* Curves of all jobs, as PS_FIGURE_SPECTRA; of one question alone beside its averaged periodogram
 * and the points of its first set, where the table has these. */
ps_make_figure ps_spectra_figure;
/* Both sides of the sphere, of the first set of each part that has read one. */
ps_make_figure ps_first_sets_figure;
/* The periodogram of a table of one question in the plane; false: it has none. */
bool ps_spectra_find_image(ps_plot_image *out, const ps_table *table);

/* Header entries that are columns of a summary of spectra. */
extern const char *const ps_spectra_summary[];

/* Columns, entries and arrays of power, angular and pairs; the shape of a spectrum (--fit);
 * profiles of it, which variances have, too (--bounds). */
extern const ps_field_row ps_fields_powers[], ps_fields_shape[], ps_fields_profiles[];

/* look_ahead of a row. */
pspec_status ps_spectra_look_ahead(ps_outlook *out, const ps_request *request,
                                   ps_question_kind kind, const ps_answer_hooks *hooks,
                                   ps_error *error) PS_MUST_CHECK;

#endif
