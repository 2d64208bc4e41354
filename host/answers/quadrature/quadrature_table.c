#include "answers/quadrature/quadrature_table.h"

#include "answers/lead.h"
#include "answers/spectra/spectrum_header.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A text that is only there where there is something to say. */
static pspec_status add_remark(ps_table *table, const char *key, const char *text,
                               ps_error *error) {
    return text != NULL && text[0] != '\0' ? ps_table_add_meta(table, key, PS_TEXT(text), error)
                                           : PSPEC_OK;
}

static const char *name_weights(const ps_quadrature_question *question) {
    switch (question->weights.kind) {
    case PS_WEIGHTS_OPTIMAL:
        return question->weights.sum_to_one ? "optimal with sum 1" : "optimal";
    case PS_WEIGHTS_FILE:
        return question->weights.path;
    case PS_WEIGHTS_GIVEN:
    case PS_WEIGHTS_COLUMN:
        return question->sampler != NULL ? "equal"
                                         : "those of the files, equal where they have none";
    case PS_WEIGHTS_EQUAL:
        break;
    }
    return "equal";
}

/* What all jobs have in common. */
static pspec_status add_question(ps_table *table, const ps_request *arguments,
                                 const ps_quadrature_question *question, ps_error *error) {
    const ps_meta entries[] = {
        {"tolerance", PS_NUMBER(question->accuracy.tolerance)},
        {"seed", question->sampler != NULL ? PS_INTEGER(arguments->seed) : PS_MISSING},
        {"normalization", PS_TEXT("weights as they are; equal ones are 1/N")},
        {"weights", PS_TEXT(name_weights(question))},
        {"brdf", PS_TEXT(arguments->brdf)},
        {"smoothness", PS_NUMBER(arguments->smoothness[0])},
    };
    PS_TRY(ps_lead_add_origin(table, arguments->command_line, error));
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return add_remark(table, "note", ps_brdf_note(question->brdf), error);
}

/* As other commands say it. */
static pspec_status add_files(ps_table *table, const ps_quadrature_question *question,
                              const ps_quadrature_result *result, ps_error *error) {
    PS_TRY(ps_header_add_files(table, question->paths, question->num_paths,
                               result->num_realizations, ", one average", error));
    PS_TRY(ps_header_add_box(table, &question->point_options.box, error));
    return ps_header_add_lift(table, &question->point_options, error);
}

static pspec_status add_skipped(ps_table *table, const ps_needs *needs, ps_error *error) {
    ps_text text = {0};
    ps_needs_describe(needs, &text);
    pspec_status status = ps_text_check(&text, error);
    if (status == PSPEC_OK) {
        status = ps_table_add_meta(table, "skipped", PS_TEXT(ps_text_string(&text)), error);
    }
    ps_text_free(&text);
    return status;
}

static pspec_status add_facts(ps_table *table, const ps_quadrature_job *job, bool with_range,
                              ps_error *error) {
    const ps_quadrature_setup *const setup = &job->setup;
    const ps_quadrature_result *const result = &job->result;
    const ps_rule_facts *const facts = &result->facts;
    const ps_points_range range = {(double)facts->num_points / (double)result->num_realizations,
                                   facts->smallest_points, facts->largest_points};
    const ps_device_limits *const limits = ps_device_get_limits(setup->device);
    const ps_meta entries[] = {
        {"device", PS_TEXT(limits != NULL ? limits->name : "none")},
        {"engine", PS_TEXT(ps_text_string(&job->description))},
        {"precision", PS_TEXT(ps_precision_name(setup->plan.chosen->precision))},
        {"realizations", PS_INTEGER(result->num_realizations)},
    };
    if (job->question->sampler == NULL) {
        PS_TRY(add_files(table, job->question, result, error));
    }
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    PS_TRY(ps_header_add_points(table, &range, with_range, error));
    PS_TRY(ps_table_add_meta(table, "max_degree", PS_INTEGER(setup->max_degree), error));
    PS_TRY(add_skipped(table, &setup->needs, error));
    PS_TRY(add_remark(table, "degrees", setup->degrees_note, error));
    return facts->num_dropped > 0 ? ps_table_add_meta(table, "dropped_below_horizon",
                                                      PS_INTEGER(facts->num_dropped), error)
                                  : PSPEC_OK;
}

/* As other commands say it. */
static pspec_status add_look(ps_table *table, double wanted, const ps_quadrature_result *result,
                             ps_error *error) {
    char text[160];
    char where[48];
    const ps_sequential_look *const look = &result->look;
    if (!result->has_look) {
        return PSPEC_OK;
    }
    ps_quadrature_look_name(where, sizeof where, look);
    snprintf(text, sizeof text, "%.3g, %s; largest %.3g, of %s, %.3g with the correction", wanted,
             look->corrected <= wanted ? "reached" : "not reached", look->relative_error, where,
             look->corrected);
    return ps_table_add_meta(table, "relative_standard_error", PS_TEXT(text), error);
}

/* E from the mean of E^2, where rounding may have left less than nothing. */
static double root(double square) {
    return sqrt(fmax(square, 0));
}

static pspec_status add_answer(ps_table *table, const ps_quadrature_result *result,
                               ps_error *error) {
    char check[200];
    const double e = root(result->squared.mean);
    snprintf(check, sizeof check,
             "kernel form minus spectral form: %.6g; independent points of the lobe's density have "
             "%.6g in the mean",
             result->tail.mean, result->tail_model);
    const ps_meta entries[] = {
        {"predicted_error", PS_NUMBER(result->numerical_bound)},
        {"self_check", PS_TEXT(check)},
        {"weight_sum", PS_NUMBER(result->weight_sum.mean)},
        {"worst_case_error", PS_NUMBER(e)},
        {"worst_case_error_standard_error",
         e > 0 ? ps_number_or_missing(result->squared.standard_error / (2 * e)) : PS_MISSING},
        {"zonal_error", PS_NUMBER(root(result->zonal.mean))},
        {"anisotropic_error", PS_NUMBER(root(result->anisotropic.mean))},
        {"tail", PS_NUMBER(result->tail.mean)},
        {"tail_model", PS_NUMBER(result->tail_model)},
        {"tail_bound", PS_NUMBER(result->tail_bound)},
    };
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

/* Optimal weights have a condition number and a residual. */
static pspec_status add_condition(ps_table *table, const ps_rule_facts *facts, ps_error *error) {
    char by[128] = "Cholesky";
    char warning[160];
    if (facts->largest_condition == 0) {
        return PSPEC_OK;
    }
    if (facts->most_steps > 0) {
        snprintf(by, sizeof by, "%sconjugate gradients, %zu steps to a residual of %.2g, at most",
                 facts->has_matrices ? "Cholesky, and " : "", facts->most_steps,
                 facts->largest_residual);
    }
    PS_TRY(ps_table_add_meta(table, "weights_by", PS_TEXT(by), error));
    PS_TRY(ps_table_add_meta(table, "condition", PS_NUMBER(facts->largest_condition), error));
    PS_TRY(ps_table_add_meta(table, "duplicates", PS_INTEGER(facts->num_duplicates), error));
    snprintf(warning, sizeof warning,
             "the condition number is %s%.2g: points lie so near each other that the weights have "
             "fewer than four digits",
             facts->has_matrices ? "" : "at least ", facts->largest_condition);
    return add_remark(table, "warning", facts->is_ill_conditioned ? warning : NULL, error);
}

static const char *const columns[] = {"degree",   "b", "d2", "d2_error", "c2",
                                      "c2_error", "a", "e2", "e2_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_lead *lead, const ps_quadrature_job *job,
                                ps_error *error) {
    for (size_t l = 0; l <= job->setup.max_degree; l++) {
        const ps_quadrature_degree *const degree = &job->result.degrees[l];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(l),
            PS_NUMBER(degree->b),
            PS_NUMBER(degree->d2.mean),
            ps_number_or_missing(degree->d2.standard_error),
            PS_NUMBER(degree->c2.mean),
            ps_number_or_missing(degree->c2.standard_error),
            PS_NUMBER(degree->a),
            PS_NUMBER(degree->e2.mean),
            ps_number_or_missing(degree->e2.standard_error),
        };
        PS_TRY(ps_lead_add_row(table, lead, cells, NUM_COLUMNS, error));
    }
    return PSPEC_OK;
}

static bool have_ranges(ps_quadrature_job *const *jobs, size_t num) {
    size_t i = 0;
    while (i < num &&
           jobs[i]->result.facts.smallest_points == jobs[i]->result.facts.largest_points) {
        i++;
    }
    return i < num;
}

pspec_status ps_quadrature_begin_header(ps_table *table, const ps_request *arguments,
                                        const ps_quadrature_question *question, ps_error *error) {
    return add_question(table, arguments, question, error);
}

pspec_status ps_quadrature_add_header(ps_table *table, const ps_request *arguments, size_t question,
                                      const ps_quadrature_job *job, bool with_range,
                                      ps_error *error) {
    const ps_quadrature_result *const result = &job->result;
    PS_TRY(ps_lead_add_source(table, arguments, question, error));
    PS_TRY(add_facts(table, job, with_range, error));
    PS_TRY(add_look(table, arguments->accuracy.standard_error, result, error));
    PS_TRY(add_answer(table, result, error));
    return add_condition(table, &result->facts, error);
}

static pspec_status fill(ps_table *table, const ps_request *arguments,
                         ps_quadrature_job *const *jobs, size_t num, ps_error *error) {
    const bool with_range = have_ranges(jobs, num);
    PS_TRY(add_question(table, arguments, jobs[0]->question, error));
    for (size_t i = 0; i < num; i++) {
        const ps_lead lead = ps_lead_make(arguments, i);
        PS_TRY(ps_quadrature_add_header(table, arguments, i, jobs[i], with_range, error));
        PS_TRY(add_degrees(table, &lead, jobs[i], error));
    }
    return PSPEC_OK;
}

static pspec_status add_weights(ps_table *table, const ps_quadrature_result *result,
                                ps_error *error) {
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, &result->num_weights, false, error));
    memcpy(array.data, result->weights, result->num_weights * sizeof *array.data);
    return ps_table_add_array(table, "weights", false, &array, error);
}

pspec_status ps_quadrature_table(ps_table **out, const ps_request *arguments,
                                 ps_quadrature_job *const *jobs, size_t num, ps_error *error) {
    const ps_lead first = ps_lead_make(arguments, 0);
    PS_TRY(ps_lead_create_table(out, "quadrature", &first, columns, NUM_COLUMNS, error));
    PS_TRY(fill(*out, arguments, jobs, num, error));
    return arguments->wants_array || arguments->weights_out != NULL
               ? add_weights(*out, &jobs[0]->result, error)
               : PSPEC_OK;
}
