/* Legendre sums over all pairs of points of sets on the sphere. */
#include "report/pairs_table.h"
#include "results/compare.h"
#include "results/spectra.h"

static const ps_option_id options[] = {PS_OPTION_SAMPLER,
                                       PS_OPTION_POINTS,
                                       PS_OPTION_REALIZATIONS,
                                       PS_OPTION_STANDARD_ERROR,
                                       PS_OPTION_SEED,
                                       PS_OPTION_HOMOGENIZE,
                                       PS_OPTION_WEIGHTS,
                                       PS_OPTION_INPUT_FORMAT,
                                       PS_OPTION_COLUMNS,
                                       PS_OPTION_SELECT_SETS,
                                       PS_OPTION_NORMALIZE_VECTORS,
                                       PS_OPTION_MAX_DEGREE,
                                       PS_OPTION_HEMISPHERE,
                                       PS_OPTION_TOLERANCE,
                                       PS_OPTION_FLOOR,
                                       PS_OPTION_PRECISION,
                                       PS_OPTION_ENGINE,
                                       PS_OPTION_NO_SKIP,
                                       PS_OPTION_NO_SELF_CHECK,
                                       PS_OPTION_MEMORY,
                                       PS_NUM_OPTIONS};

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
    {"-c2", "part that depends on the azimuth", "degree", "c2", "degree l", "C_l^2", false, true},
    {.suffix = NULL}};

const ps_result_kind ps_result_pairs = {
    .name = "pairs",
    .options = options,
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
