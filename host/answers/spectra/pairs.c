/* Legendre sums over all pairs of points of sets on the sphere. */
#include "answers/compare.h"
#include "answers/spectra/pairs_table.h"
#include "answers/spectra/spectra.h"

static pspec_status check_question(const ps_request *request, ps_error *error) {
    return ps_spectra_check(request, PS_QUESTION_PAIRS, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    return ps_spectra_plan(planner, request, PS_QUESTION_PAIRS, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_PAIRS, hooks, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    return ps_spectra_tabulate(out, computed, request, ps_pairs_table, error);
}

static const ps_line_kind lines[] = {
    {"-sums", "Legendre sums", "degree", "legendre_sum", "degree l", "Q(l)", false, true},
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C@_l^2", false, true},
    {.suffix = NULL}};

const ps_result_kind ps_result_pairs = {
    .name = "pairs",
    .taker = PS_TAKER_BIT(pairs),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .draw = ps_spectra_draw,
    .discard = ps_spectra_discard,
    .summary = ps_spectra_summary,
    .lines = lines,
    .compare = ps_compare_pair_sums,
};
