#include "samplers/forces/loan.h"

#include <stdlib.h>

pspec_status ps_forces_need_doubles(const ps_device_limits *limits, const char *sampler,
                                    ps_error *error) {
    return limits->has_fp64
               ? PSPEC_OK
               : ps_fail(
                     error, PSPEC_ERROR_DEVICE,
                     "sampler %s computes in double precision, which the device \"%s\" does not "
                     "have; --device cpu names one that does",
                     sampler, limits->name);
}

static bool is_chosen(const char *selector) {
    return selector != NULL && selector[0] != '\0';
}

static pspec_status borrow(ps_loan *loan, const char *name, bool is_open_to_host, ps_error *error) {
    ps_error none = {0};
    const pspec_status status = ps_lender_borrow(loan->lender, &loan->device, &none);
    if (status == PSPEC_ERROR_NO_DEVICE && is_open_to_host) {
        return PSPEC_OK;
    }
    if (status != PSPEC_OK) {
        return ps_fail(error, status, "%s", none.message);
    }
    const ps_device_limits *const limits = ps_device_get_limits(loan->device);
    if (!limits->has_fp64 && is_open_to_host) {
        ps_lender_give_back(loan->lender, loan->device);
        loan->device = NULL;
        return PSPEC_OK;
    }
    return ps_forces_need_doubles(limits, name, error);
}

pspec_status ps_loan_begin(ps_loan *loan, const ps_sampler_request *request, bool may_be_host,
                           ps_error *error) {
    *loan = (ps_loan){.lender = request->lender};
    if (loan->lender == NULL) {
        PS_TRY(ps_lender_create(&loan->own, NULL, error));
        loan->lender = loan->own;
    }
    return borrow(loan, request->sampler->name,
                  may_be_host && !is_chosen(ps_lender_selector(loan->lender)), error);
}

void ps_loan_end(ps_loan *loan) {
    if (loan->device != NULL) {
        ps_lender_give_back(loan->lender, loan->device);
    }
    ps_lender_destroy(loan->own);
}

pspec_status ps_loan_check(const ps_sampler_request *request, const char *selector,
                           bool may_be_host, ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num = 0;
    size_t index = 0;
    if (may_be_host && !is_chosen(selector)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_device_list(&limits, &num, error));
    pspec_status status = ps_device_choose(limits, num, selector, &index, error);
    if (status == PSPEC_OK) {
        status = ps_forces_need_doubles(&limits[index], request->sampler->name, error);
    }
    free(limits);
    return status;
}
