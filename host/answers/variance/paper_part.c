/* --paper-formula: the variance by the formula of P15, beside the exact one. */
#include "answers/spectra/spectrum_header.h"
#include "answers/variance/parts.h"

static bool is_wanted(const ps_request *request) {
    return request->paper_formula;
}

static void fill(ps_cell *cells, const ps_request *request, ps_variance_job *const *jobs,
                 size_t question, size_t integrand) {
    (void)request;
    cells[0] = ps_number_or_missing(jobs[question]->rows[integrand].paper);
}

const ps_variance_part ps_variance_part_paper = {
    .columns = {"paper"},
    .about = {"paper",
              "the integral (E-13) over |k| of radial means, a formula that neglects P(0+) "
              "f_0^2 / N, the last term of (V4)"},
    .is_wanted = is_wanted,
    .with_errors = PS_NUM_OPTIONS,
    .fill = fill,
};
