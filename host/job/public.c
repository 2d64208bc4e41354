/* The public library (pointspec/pointspec.h): contexts and plans over the estimator. */
#include "pointspec/pointspec.h"

#include "base/memory.h"
#include "job/estimator.h"

#include "pointspec_version.h"

#include <stdlib.h>
#include <string.h>

const char *pspec_version(void) {
    return PS_VERSION;
}

/* ---- context ----------------------------------------------------------------------------- */

struct pspec_context {
    ps_error error;
    char *selector;
    ps_device *device; /* NULL until a plan needs it */
};

pspec_context *pspec_context_create(void) {
    return calloc(1, sizeof(pspec_context));
}

void pspec_context_destroy(pspec_context *context) {
    if (context != NULL) {
        ps_device_close(context->device);
        free(context->selector);
        free(context);
    }
}

const char *pspec_context_message(const pspec_context *context) {
    return context->error.message;
}

pspec_status pspec_context_set_device(pspec_context *context, const char *selector) {
    if (context->device != NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the device \"%s\" is open already: choose before the first plan",
                       ps_device_get_limits(context->device)->name);
    }
    char *copy = selector != NULL ? strdup(selector) : NULL;
    if (selector != NULL && copy == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_MEMORY, "no memory for a device's name");
    }
    free(context->selector);
    context->selector = copy;
    return PSPEC_OK;
}

/* ---- plan -------------------------------------------------------------------------------- */

struct pspec_plan {
    pspec_context *context;
    ps_frequencies frequencies;
    ps_problem problem;
    ps_plan choice;
    ps_estimator *estimator;
    ps_text text;
};

static pspec_status parse_precision(const char *name, int *out, ps_error *error) {
    *out = -1;
    for (int precision = PS_SINGLE; name != NULL && precision <= PS_EXTENDED; precision++) {
        if (strcmp(name, ps_precision_name((ps_precision)precision)) == 0) {
            *out = precision;
        }
    }
    return name == NULL || *out >= 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "precision \"%s\" is none of single, double, extended", name);
}

static pspec_status set_frequencies(pspec_plan *plan, const pspec_power_request *request,
                                    ps_error *error) {
    void *copy = NULL;
    const size_t num = request->num_frequencies;
    if (request->frequencies == NULL) {
        PS_TRY(ps_frequencies_lattice(&plan->frequencies, request->dimension,
                                      request->max_frequency, request->rings_only != 0, error));
        return ps_frequencies_enumerate(&plan->frequencies, error);
    }
    if (num == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "the list of frequencies is empty");
    }
    PS_TRY(ps_allocate(&copy, num, request->dimension * sizeof(int32_t), "frequencies", error));
    memcpy(copy, request->frequencies, num * request->dimension * sizeof(int32_t));
    return ps_frequencies_list(&plan->frequencies, request->dimension, num, copy, error);
}

static pspec_status check_request(const pspec_power_request *request, ps_error *error) {
    if (request->struct_size != sizeof *request) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "struct_size is %zu instead of %zu: begin with PSPEC_POWER_REQUEST_INIT",
                       request->struct_size, sizeof *request);
    }
    if (request->dimension < 1 || request->dimension > PS_MAX_TORUS_DIMENSION) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "dimension %u is not between 1 and %d",
                       request->dimension, PS_MAX_TORUS_DIMENSION);
    }
    if (request->num_points == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "num_points is 0");
    }
    if (!(request->tolerance > 0) || !(request->floor >= 0)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "tolerance %g must be above 0, floor %g not below", request->tolerance,
                       request->floor);
    }
    return PSPEC_OK;
}

static pspec_status choose_engine(pspec_plan *plan, const pspec_power_request *request,
                                  ps_error *error) {
    pspec_context *context = plan->context;
    ps_plan_constraints constraints = {.engine = request->engine, .mean_power = 1};
    PS_TRY(parse_precision(request->precision, &constraints.precision, error));
    if (context->device == NULL && ps_plan_may_need_device(&constraints)) {
        PS_TRY(ps_device_open(&context->device, context->selector, false, error));
    }
    const ps_device_limits *limits =
        context->device != NULL ? ps_device_get_limits(context->device) : NULL;
    PS_TRY(ps_plan_make(&plan->choice, &plan->problem, limits, &constraints, error));
    return ps_plan_require(&plan->choice, &plan->problem, error);
}

static pspec_status create_estimator(pspec_plan *plan, const pspec_power_request *request,
                                     ps_error *error) {
    const ps_estimator_options options = {
        .problem = plan->problem,
        .engine = plan->choice.chosen->engine,
        .precision = plan->choice.chosen->precision,
        .batch = plan->choice.chosen->batch,
        .exact_shells = request->exact_shells != 0,
        .want_frequencies = true,
        .self_check = request->no_self_check == 0,
        .normalization = request->normalization,
    };
    PS_TRY(ps_estimator_create(&plan->estimator, &options, plan->context->device, error));
    ps_estimator_describe(plan->estimator, &plan->text);
    return PSPEC_OK;
}

static pspec_status fill_plan(pspec_plan *plan, const pspec_power_request *request,
                              ps_error *error) {
    PS_TRY(check_request(request, error));
    PS_TRY(set_frequencies(plan, request, error));
    plan->problem = (ps_problem){
        .frequencies = &plan->frequencies,
        .num_points = request->num_points,
        .num_realizations = request->num_realizations,
        .has_weights = true,
        .tolerance = ps_plan_tolerance(request->tolerance, request->floor),
    };
    PS_TRY(choose_engine(plan, request, error));
    return create_estimator(plan, request, error);
}

pspec_status pspec_plan_create(pspec_plan **out, pspec_context *context,
                               const pspec_power_request *request) {
    void *memory = NULL;
    *out = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(pspec_plan), "a plan", &context->error));
    pspec_plan *plan = memory;
    plan->context = context;
    const pspec_status status = fill_plan(plan, request, &context->error);
    if (status != PSPEC_OK) {
        pspec_plan_destroy(plan);
        return status;
    }
    *out = plan;
    return PSPEC_OK;
}

void pspec_plan_destroy(pspec_plan *plan) {
    if (plan != NULL) {
        ps_estimator_destroy(plan->estimator);
        ps_frequencies_free(&plan->frequencies);
        ps_text_free(&plan->text);
        free(plan);
    }
}

const char *pspec_plan_text(const pspec_plan *plan) {
    return ps_text_string(&plan->text);
}

pspec_status pspec_plan_run(pspec_plan *plan, const pspec_pattern *patterns, size_t num_patterns) {
    return ps_estimator_add(plan->estimator, patterns, num_patterns, &plan->context->error);
}

/* ---- spectrum ---------------------------------------------------------------------------- */

struct pspec_spectrum {
    ps_spectrum averages;
    double error;
    pspec_bin *bins;
    double *powers, *standard_errors;
};

static pspec_status copy_bins(pspec_spectrum *spectrum, ps_error *error) {
    void *memory = NULL;
    const ps_spectrum *from = &spectrum->averages;
    PS_TRY(ps_allocate(&memory, from->num_bins, sizeof(pspec_bin), "bins", error));
    spectrum->bins = memory;
    for (size_t b = 0; b < from->num_bins; b++) {
        const ps_spectrum_bin *bin = &from->bins[b];
        spectrum->bins[b] =
            (pspec_bin){bin->key,   bin->frequency,      bin->normalized_frequency, bin->count,
                        bin->power, bin->standard_error, bin->anisotropy_db};
    }
    return PSPEC_OK;
}

static pspec_status copy_powers(pspec_spectrum *spectrum, ps_error *error) {
    void *memory = NULL;
    const ps_spectrum *from = &spectrum->averages;
    PS_TRY(ps_allocate(&memory, from->frequencies.num, sizeof(double), "powers", error));
    spectrum->powers = memory;
    PS_TRY(ps_allocate(&memory, from->frequencies.num, sizeof(double), "standard errors", error));
    spectrum->standard_errors = memory;
    for (size_t i = 0; i < from->frequencies.num; i++) {
        spectrum->powers[i] = from->powers[i].mean;
        spectrum->standard_errors[i] = from->powers[i].standard_error;
    }
    return PSPEC_OK;
}

static pspec_status fill_spectrum(pspec_spectrum *spectrum, pspec_plan *plan, ps_error *error) {
    const ps_accuracy accuracy = ps_estimator_accuracy(plan->estimator);
    PS_TRY(ps_estimator_spectrum(plan->estimator, &spectrum->averages, error));
    if (!(accuracy.error <= plan->problem.tolerance)) {
        return ps_fail(error, PSPEC_ERROR_TOLERANCE,
                       "these patterns have a mean power of %.3g, so %s precision has an error of "
                       "%.2g, above the tolerance %g: make a plan of higher precision",
                       accuracy.largest_mean_power,
                       ps_precision_name(plan->choice.chosen->precision), accuracy.error,
                       plan->problem.tolerance);
    }
    spectrum->error = accuracy.error;
    PS_TRY(copy_bins(spectrum, error));
    return copy_powers(spectrum, error);
}

pspec_status pspec_spectrum_create(pspec_spectrum **out, pspec_plan *plan) {
    void *memory = NULL;
    *out = NULL;
    PS_TRY(ps_allocate(&memory, 1, sizeof(pspec_spectrum), "a spectrum", &plan->context->error));
    pspec_spectrum *spectrum = memory;
    const pspec_status status = fill_spectrum(spectrum, plan, &plan->context->error);
    if (status != PSPEC_OK) {
        pspec_spectrum_destroy(spectrum);
        return status;
    }
    *out = spectrum;
    return PSPEC_OK;
}

void pspec_spectrum_destroy(pspec_spectrum *spectrum) {
    if (spectrum != NULL) {
        ps_spectrum_free(&spectrum->averages);
        free(spectrum->bins);
        free(spectrum->powers);
        free(spectrum->standard_errors);
        free(spectrum);
    }
}

uint64_t pspec_spectrum_num_realizations(const pspec_spectrum *spectrum) {
    return spectrum->averages.num_realizations;
}

double pspec_spectrum_error(const pspec_spectrum *spectrum) {
    return spectrum->error;
}

const pspec_bin *pspec_spectrum_bins(const pspec_spectrum *spectrum, size_t *num_bins) {
    *num_bins = spectrum->averages.num_bins;
    return spectrum->bins;
}

const int32_t *pspec_spectrum_frequencies(const pspec_spectrum *spectrum, size_t *num_frequencies) {
    *num_frequencies = spectrum->averages.frequencies.num;
    return spectrum->averages.frequencies.vectors;
}

const double *pspec_spectrum_powers(const pspec_spectrum *spectrum) {
    return spectrum->powers;
}

const double *pspec_spectrum_standard_errors(const pspec_spectrum *spectrum) {
    return spectrum->standard_errors;
}
