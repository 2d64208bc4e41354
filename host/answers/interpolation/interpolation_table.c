#include "answers/interpolation/interpolation.h"
#include "answers/spectra/spectrum_header.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- header -------------------------------------------------------------------------------- */

/* What all questions have in common. */
static pspec_status begin(ps_table *table, const ps_interpolation_list *list,
                          const ps_request *request, ps_error *error) {
    char pixels[64];
    const ps_panorama *const panorama = &list->panorama;
    snprintf(pixels, sizeof pixels, "%zu x %zu", panorama->width, panorama->height);
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    PS_TRY(ps_table_add_meta(table, "seed",
                             ps_request_has_told(request) ? PS_INTEGER(request->seed) : PS_MISSING,
                             error));
    for (size_t f = 0; f < panorama->num; f++) {
        PS_TRY(
            ps_header_add_integrand(table, request->integrands[f], panorama->integrands[f], error));
    }
    return ps_table_add_meta(table, "pixels", PS_TEXT(pixels), error);
}

static pspec_status add_source(ps_table *table, const ps_request *request, size_t question,
                               const ps_interpolation_job *job, ps_error *error) {
    const ps_interpolation_question *const own = job->question;
    PS_TRY(ps_lead_add_source(table, request, question, error));
    if (own->sampler != NULL) {
        return PSPEC_OK;
    }
    PS_TRY(ps_header_add_files(table, own->paths, own->num_paths, job->num_realizations,
                               ", one average", error));
    PS_TRY(ps_header_add_box(table, &own->point_options.box, error));
    return ps_header_add_lift(table, &own->point_options, error);
}

static const char *name_engine(const ps_interpolation_job *job) {
    return ps_interpolation_is_dense(job->question, job->largest_points) ? "Cholesky"
                                                                         : "conjugate gradients";
}

static pspec_status add_header(ps_table *table, const ps_request *request, size_t question,
                               const ps_interpolation_job *job, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(job->device);
    const double num = (double)job->num_realizations;
    const ps_points_range range = {(double)job->num_points / num, job->smallest_points,
                                   job->largest_points};
    const ps_meta entries[] = {
        {"device", PS_TEXT(limits != NULL ? limits->name : "none")},
        {"engine", PS_TEXT(name_engine(job))},
        {"precision", PS_TEXT("double")},
        {"realizations", PS_INTEGER(job->num_realizations)},
    };
    PS_TRY(add_source(table, request, question, job, error));
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    PS_TRY(ps_header_add_points(table, &range, range.smallest < range.largest, error));
    const bool is_once = job->question->num_realizations > ps_interpolation_num_sets(job->question);
    return ps_table_add_meta(
        table, "skipped",
        PS_TEXT(is_once ? "all realizations but the first: they are the same" : "none"), error);
}

/* ---- rows ---------------------------------------------------------------------------------- */

static const char *const columns[] = {"points",     "smoothness",    "integrand", "rmse",
                                      "rmse_error", "largest_error", "norm",      "residual",
                                      "condition",  "iterations"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0], OF_INTEGRANDS = 2 };

/* The sampler, where there are several; what all rows have stands in the columns. */
static ps_lead make_lead(const ps_request *request, size_t question) {
    ps_lead lead = ps_lead_make(request, question);
    lead.num = request->num_sources > 1 ? 1 : 0;
    return lead;
}

/* Without the column of integrands where there is one. */
static size_t leave_out(void *cells, size_t size, const ps_request *request) {
    char *const at = (char *)cells + OF_INTEGRANDS * size;
    if (request->num_integrands > 1) {
        return NUM_COLUMNS;
    }
    memmove(at, at + size, (NUM_COLUMNS - OF_INTEGRANDS - 1) * size);
    return NUM_COLUMNS - 1;
}

static pspec_status add_row(ps_table *table, const ps_request *request, size_t question,
                            const ps_interpolation_job *job, size_t s, size_t f, ps_error *error) {
    const ps_lead lead = make_lead(request, question);
    const ps_interpolation_row *const row = ps_interpolation_job_row(job, s, f);
    const double num = (double)job->num_realizations;
    ps_mean square;
    ps_mean norm;
    ps_sums_finish(&row->squares, job->num_realizations, &square.mean, &square.standard_error);
    ps_sums_finish(&row->norms, job->num_realizations, &norm.mean, &norm.standard_error);
    const double rmse = sqrt(square.mean);
    ps_cell cells[NUM_COLUMNS] = {
        job->smallest_points < job->largest_points ? PS_NUMBER((double)job->num_points / num)
                                                   : PS_INTEGER(job->largest_points),
        PS_NUMBER(request->smoothness[s]),
        PS_TEXT(request->integrands[f]),
        PS_NUMBER(rmse),
        ps_number_or_missing(square.standard_error / (2 * rmse)),
        PS_NUMBER(row->largest_error),
        PS_NUMBER(sqrt(norm.mean)),
        PS_NUMBER(row->residual),
        PS_NUMBER(row->condition),
        PS_INTEGER(row->num_steps),
    };
    return ps_lead_add_row(table, &lead, cells, leave_out(cells, sizeof cells[0], request), error);
}

static pspec_status add_rows(ps_table *table, const ps_interpolation_list *list,
                             const ps_request *request, size_t question, ps_error *error) {
    const ps_interpolation_job *const job = list->jobs[question];
    PS_TRY(add_header(table, request, question, job, error));
    for (size_t s = 0; s < request->num_smoothness; s++) {
        for (size_t f = 0; f < request->num_integrands; f++) {
            PS_TRY(add_row(table, request, question, job, s, f, error));
        }
    }
    return PSPEC_OK;
}

/* ---- images -------------------------------------------------------------------------------- */

bool ps_interpolation_is_shown(const ps_request *request, size_t question) {
    uint64_t most = 0;
    for (size_t i = 0; i < request->num_counts; i++) {
        most = request->counts[i] > most ? request->counts[i] : most;
    }
    return ps_request_points(request, question) == most;
}

static pspec_status make_images(ps_npy_array *out, const ps_panorama *panorama, size_t num,
                                ps_error *error) {
    const size_t shape[] = {num, panorama->height, panorama->width};
    return ps_npy_make_array(out, sizeof shape / sizeof shape[0], shape, false, error);
}

pspec_status ps_interpolation_add_light(ps_table *table, const ps_panorama *panorama,
                                        ps_error *error) {
    const size_t pixels = panorama->width * panorama->height;
    ps_npy_array array;
    PS_TRY(make_images(&array, panorama, panorama->num, error));
    memcpy(array.data, panorama->values, panorama->num * pixels * sizeof *panorama->values);
    return ps_table_add_array(table, "light", false, &array, error);
}

static pspec_status add_images(ps_table *table, const ps_interpolation_list *list,
                               const ps_request *request, ps_error *error) {
    const ps_panorama *const panorama = &list->panorama;
    const size_t pixels = panorama->width * panorama->height;
    const size_t of_job = request->num_smoothness * panorama->num;
    size_t num = 0;
    ps_npy_array array;
    for (size_t i = 0; i < list->num; i++) {
        num += list->jobs[i]->images != NULL;
    }
    if (num == 0) {
        return PSPEC_OK;
    }
    PS_TRY(make_images(&array, panorama, num * of_job, error));
    double *at = array.data;
    for (size_t i = 0; i < list->num; i++) {
        if (list->jobs[i]->images != NULL) {
            memcpy(at, list->jobs[i]->images, of_job * pixels * sizeof *at);
            at += of_job * pixels;
        }
    }
    PS_TRY(ps_table_add_array(table, "image", false, &array, error));
    return ps_interpolation_add_light(table, panorama, error);
}

pspec_status ps_interpolation_table(ps_table **out, const ps_interpolation_list *list,
                                    const ps_request *request, ps_error *error) {
    const char *names[NUM_COLUMNS];
    const ps_lead first = make_lead(request, 0);
    memcpy(names, columns, sizeof columns);
    PS_TRY(ps_lead_create_table(out, "interpolation", &first, names,
                                leave_out(names, sizeof names[0], request), error));
    PS_TRY(begin(*out, list, request, error));
    for (size_t i = 0; i < list->num; i++) {
        PS_TRY(add_rows(*out, list, request, i, error));
    }
    return add_images(*out, list, request, error);
}
