#include "answers/variance/parts.h"

#include "request/options.h"
#include "request/point_source.h"

#define PART_ROW(name) &ps_variance_part_##name,
static const ps_variance_part *const parts[PS_NUM_VARIANCE_PARTS] = {PS_VARIANCE_PARTS(PART_ROW)};

static size_t count_columns(const ps_variance_part *part) {
    size_t num = 0;
    while (part->columns[num] != NULL) {
        num++;
    }
    return num;
}

static pspec_status fail_without_errors(const ps_variance_part *part, const ps_request *request,
                                        ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                   "%s has errors, which need %d realizations or more (--realizations), not %llu",
                   ps_option_show(request, part->with_errors).text, PS_FEWEST_FITTED_REALIZATIONS,
                   (unsigned long long)request->num_realizations);
}

/* A sampler without randomness has none, from one realization or many. */
static pspec_status check_errors(const ps_variance_part *part, const ps_request *request,
                                 ps_error *error) {
    const bool has_enough = part->with_errors == PS_NUM_OPTIONS ||
                            request->num_realizations >= PS_FEWEST_FITTED_REALIZATIONS;
    const size_t num = has_enough ? 0 : ps_request_num_questions(request);
    for (size_t i = 0; i < num; i++) {
        ps_sampler_request sampler;
        if (ps_request_sampler(request, i) == NULL) {
            continue;
        }
        PS_TRY(ps_sampler_request_read(&sampler, request, i, error));
        PS_TRY(ps_sampler_resolve(&sampler, error));
        if (!ps_variance_has_one_set(&sampler)) {
            return fail_without_errors(part, request, error);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_variance_parts_check(const ps_request *request, ps_error *error) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        if (parts[i]->is_wanted(request)) {
            PS_TRY(parts[i]->check != NULL ? parts[i]->check(request, error) : PSPEC_OK);
            PS_TRY(check_errors(parts[i], request, error));
        }
    }
    return PSPEC_OK;
}

size_t ps_variance_parts_columns(const char **columns, size_t num, const ps_request *request) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        const size_t most = parts[i]->is_wanted(request) ? count_columns(parts[i]) : 0;
        for (size_t k = 0; k < most; k++) {
            columns[num++] = parts[i]->columns[k];
        }
    }
    return num;
}

size_t ps_variance_parts_cells(ps_cell *cells, size_t num, const ps_request *request,
                               ps_variance_job *const *jobs, size_t question, size_t integrand) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        if (parts[i]->is_wanted(request)) {
            parts[i]->fill(cells + num, request, jobs, question, integrand);
            num += count_columns(parts[i]);
        }
    }
    return num;
}

pspec_status ps_variance_parts_add_about(ps_table *table, const ps_request *request,
                                         ps_error *error) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        const char *const key = parts[i]->about.key;
        if (parts[i]->is_wanted(request) && key != NULL) {
            PS_TRY(ps_table_add_meta(table, key, PS_TEXT(parts[i]->about.text), error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_variance_parts_add_question(ps_table *table, const ps_request *request,
                                            const ps_variance_job *job, ps_error *error) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        if (parts[i]->is_wanted(request) && parts[i]->add_question != NULL) {
            PS_TRY(parts[i]->add_question(table, job, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_variance_parts_add_all(ps_table *table, const ps_request *request,
                                       ps_variance_job *const *jobs, ps_error *error) {
    for (size_t i = 0; i < PS_NUM_VARIANCE_PARTS; i++) {
        if (parts[i]->is_wanted(request) && parts[i]->add_all != NULL) {
            PS_TRY(parts[i]->add_all(table, request, jobs, error));
        }
    }
    return PSPEC_OK;
}
