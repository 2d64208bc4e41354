/* Legendre sums over all pairs of points of sets on the sphere. */
#include "answers/spectra/spectrum_header.h"
#include "answers/spectra/spectra.h"

#include <string.h>

static pspec_status check_question(const ps_request *request, ps_error *error) {
    return ps_spectra_check(request, PS_QUESTION_PAIRS, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    return ps_spectra_plan(planner, request, PS_QUESTION_PAIRS, error);
}

static pspec_status look_ahead(ps_outlook *out, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error) {
    if (request->plot != NULL) {
        out->alone = "the picture of pairs needs the weights of all points";
    }
    return ps_spectra_look_ahead(out, request, PS_QUESTION_PAIRS, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_PAIRS, hooks, error);
}

/* ---- the table ----------------------------------------------------------------------------- */

static const char *const columns[] = {"degree", "legendre_sum", "legendre_sum_error", "c2",
                                      "c2_error"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status add_degrees(ps_table *table, const ps_request *arguments,
                                const ps_measured *self, ps_error *error) {
    (void)arguments;
    const ps_spectrum *spectrum = self->spectrum;
    const ps_mean *c2 = self->c2;
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        const ps_cell cells[NUM_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
            PS_NUMBER(c2[b].mean),
            ps_number_or_missing(c2[b].standard_error),
        };
        PS_TRY(ps_lead_add_row(table, &self->lead, cells, NUM_COLUMNS, error));
    }
    return PSPEC_OK;
}

static size_t choose_columns(const char **names, const ps_request *arguments,
                             const ps_measured *first) {
    (void)arguments, (void)first;
    memcpy(names, columns, sizeof columns);
    return NUM_COLUMNS;
}

static const ps_spectra_table table_kind = {"pairs", choose_columns, add_degrees, NULL};

/* What white noise of the weights of each question has: mean(W)^2 over mean(W^2/V), 1/N of equal
 * ones. */
static pspec_status add_white_sums(ps_table *table, const ps_spectra *spectra, ps_error *error) {
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, &spectra->list.num, false, error));
    for (size_t i = 0; i < spectra->list.num; i++) {
        const ps_spectrum *const own = &spectra->jobs[i]->spectrum;
        const double white = own->mean_weight_sum * own->mean_weight_sum / own->sample_size.mean;
        array.data[i] = white > 0 ? white : 1;
    }
    return ps_table_add_array(table, "white_sums", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    PS_TRY(ps_spectra_tabulate(out, computed, request, &table_kind, error));
    return request->plot != NULL ? add_white_sums(out->table, computed, error) : PSPEC_OK;
}

static pspec_status merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    return ps_spectra_merge(out, parts, &table_kind, error);
}

static const ps_picture_kind pictures[] = {
    {.make = ps_spectra_figure,
     .by = PS_BY_COMMAND,
     .x = "degree",
     .lines = {{.y = "legendre_sum", .error = "legendre_sum_error"}},
     .y_label = "Legendre sum / Σ w^2",
     .is_spectrum = true},
    PS_PICTURE_OF_DEGREES("-sums", "Legendre sums", "legendre_sum", "degree l", "Q(l)"),
    PS_PICTURE_OF_DEGREES("-c2", "part that depends on the azimuth", "c2", "degree l",
                          "{/*1.35 C_l^2}"),
    {.make = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked,  ps_fields_points,   ps_fields_powers,
                                             ps_fields_ranges, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {
    {"legendre_sum", "legendre_sum_error", false, ps_compared_predicted_bound}, {.value = NULL}};

const ps_kind ps_kind_pairs = {
    .name = "pairs",
    .purpose = "Legendre sums over all pairs of points on the sphere",
    .usage = "pairs [options] --sampler NAME | pairs [options] FILE...",
    .description =
        "Averages Q(l) = sum_ij w_i w_j P_l(u_i.u_j) over realizations, and "
        "C_l^2 = 2 sum_{m > 0} |c_lm|^2 = (2l + 1) / (4 pi) Q(l) - c_l0^2, the part of it that "
        "depends on the azimuth, and prints both for the degrees 1..L with standard errors over "
        "the realizations. Weights are 1/N unless given. Files hold unit vectors or angles; "
        "several files, and several sets in a file, are realizations. With --hemisphere a point "
        "stands for its direction and the opposite one: even degrees only. --tol (default 1e-6) is "
        "the "
        "largest error of Q(l) in units of (sum |w|)^2; --floor P asks for sums down to P sum w^2 "
        "right to 10 %, which sums over pairs lose sooner than sums of squares do.",
    .examples = {"pointspec pairs --sampler fibonacci -n 256 -l 32",
                 "pointspec pairs --sampler white-hemisphere -n 64 -m 100 -l 16 --tol 1e-10"},
    .takes = PS_COMMAND_BIT(pairs),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .check_question = check_question,
    .plan = plan,
    .compute = compute,
    .tabulate = tabulate,
    .merge = merge,
    .look_ahead = look_ahead,
    .discard = ps_spectra_discard,
    .renews = true,
    .fields = fields,
    .summary = ps_spectra_summary,
    .pictures = pictures,
    .compared = compared,
};
