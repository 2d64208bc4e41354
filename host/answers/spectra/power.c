/* The averaged periodogram of sets on the torus: its table, the arrays full and coefficients. */
#include "answers/spectra/scatter.h"
#include "answers/spectra/shape_table.h"
#include "answers/spectra/spectra.h"
#include "answers/spectra/spectrum_header.h"

#include <string.h>

static pspec_status check_question(const ps_request *request, ps_error *error) {
    return ps_spectra_check(request, PS_QUESTION_POWER, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    return ps_spectra_plan(planner, request, PS_QUESTION_POWER, error);
}

static pspec_status look_ahead(ps_outlook *out, const ps_request *request,
                               const ps_answer_hooks *hooks, ps_error *error) {
    return ps_spectra_look_ahead(out, request, PS_QUESTION_POWER, hooks, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    return ps_spectra_compute(out, request, PS_QUESTION_POWER, hooks, error);
}

/* ---- rows -------------------------------------------------------------------------------- */

enum { MOST_COLUMNS = PS_MAX_DIMENSION + 7 };

static const char *const bin_columns[] = {"bin",          "frequency", "normalized_frequency",
                                          "count",        "power",     "standard_error",
                                          "anisotropy_db"};
static const char *const axis_columns[] = {"k1", "k2", "k3", "k4", "k5", "k6"};

static pspec_status add_bins(ps_table *table, const ps_request *arguments,
                             const ps_spectrum *spectrum, const ps_lead *lead, ps_error *error) {
    ps_shape shape = {0};
    if (arguments->wants_fit) {
        PS_TRY(ps_shape_find(&shape, spectrum, arguments->fit_exponent, error));
        PS_TRY(ps_shape_add_header(table, &shape, spectrum, error));
    }
    for (size_t b = 0; b < spectrum->num_bins; b++) {
        const ps_spectrum_bin *bin = &spectrum->bins[b];
        ps_cell cells[MOST_COLUMNS] = {
            PS_INTEGER(bin->key),
            PS_NUMBER(bin->frequency),
            PS_NUMBER(bin->normalized_frequency),
            PS_INTEGER(bin->count),
            PS_NUMBER(bin->power),
            ps_number_or_missing(bin->standard_error),
            ps_number_or_missing(bin->anisotropy_db),
        };
        const size_t num = ps_shape_add_cells(cells, sizeof bin_columns / sizeof bin_columns[0],
                                              arguments, &shape, spectrum, bin);
        PS_TRY(ps_lead_add_row(table, lead, cells, num, error));
    }
    return PSPEC_OK;
}

static pspec_status add_frequencies(ps_table *table, const ps_spectrum *spectrum,
                                    const ps_lead *lead, ps_error *error) {
    const unsigned dimension = spectrum->frequencies.dimension;
    for (size_t i = 0; i < spectrum->frequencies.num; i++) {
        ps_cell cells[MOST_COLUMNS];
        size_t num = 0;
        for (unsigned axis = 0; axis < dimension; axis++) {
            cells[num++] = PS_INTEGER(spectrum->frequencies.vectors[i * dimension + axis]);
        }
        cells[num++] = PS_NUMBER(spectrum->powers[i].mean);
        cells[num++] = ps_number_or_missing(spectrum->powers[i].standard_error);
        PS_TRY(ps_lead_add_row(table, lead, cells, num, error));
    }
    return PSPEC_OK;
}

static size_t choose_columns(const char **columns, const ps_request *arguments,
                             const ps_measured *first) {
    const unsigned dimension = first->spectrum->frequencies.dimension;
    size_t num = 0;
    if (arguments->frequencies.path != NULL) {
        for (unsigned axis = 0; axis < dimension; axis++) {
            columns[num++] = axis_columns[axis];
        }
        columns[num++] = "power";
        columns[num++] = "standard_error";
        return num;
    }
    for (size_t i = 0; i < sizeof bin_columns / sizeof bin_columns[0]; i++) {
        columns[num++] = bin_columns[i];
    }
    return ps_shape_add_columns(columns, num, arguments);
}

static pspec_status add_rows(ps_table *table, const ps_request *arguments, const ps_measured *self,
                             ps_error *error) {
    if (arguments->frequencies.num_shown > 0) {
        PS_TRY(ps_scatter_add_header(table, &arguments->frequencies, self->job, error));
    }
    return arguments->frequencies.path != NULL
               ? add_frequencies(table, self->spectrum, &self->lead, error)
               : add_bins(table, arguments, self->spectrum, &self->lead, error);
}

/* ---- full -------------------------------------------------------------------------------- */

/* P(0) = N W^2 / W^2 = N, N being the mean over the realizations, a constant; or W^2 / V, which
 * each has its own of. */
static ps_mean find_dc(const ps_request *arguments, const ps_spectrum *spectrum) {
    const bool is_known = spectrum->smallest_points == spectrum->largest_points ||
                          arguments->normalization == PSPEC_NORMALIZATION_INTEGRAL;
    return arguments->normalization == PSPEC_NORMALIZATION_EFFECTIVE
               ? spectrum->sample_size
               : (ps_mean){spectrum->mean_points, is_known ? 0 : spectrum->points_error};
}

static pspec_status add_full(ps_table *table, const char *name, const ps_spectrum *spectrum,
                             int which, ps_mean dc, ps_error *error) {
    const ps_frequencies *const set = &spectrum->frequencies;
    ps_npy_array array = {.rank = set->dimension};
    for (unsigned axis = 0; axis < set->dimension; axis++) {
        array.shape[axis] = 2 * (size_t)set->max_frequency + 1;
    }
    PS_TRY(ps_spectrum_full(spectrum, which, dc, &array.data, &array.num, error));
    return ps_table_add_array(table, name, false, &array, error);
}

/* Lists, and subsets of rings, fill no array. Pictures have no DC. */
static pspec_status add_arrays(ps_table *table, const ps_request *request, const ps_measured *first,
                               ps_error *error) {
    enum { PLANE = 2 };
    const ps_spectrum *const spectrum = first->spectrum;
    const bool is_array = request->wants_array || request->full != NULL;
    const bool is_drawn = request->plot != NULL && ps_request_num_questions(request) == 1;
    const bool is_picture = (request->wants_picture || is_drawn) &&
                            spectrum->frequencies.dimension == PLANE &&
                            request->frequencies.per_ring == 0;
    if (spectrum->frequencies.kind != PS_FREQUENCIES_BOX || (!is_array && !is_picture)) {
        return PSPEC_OK;
    }
    const ps_mean dc = is_array ? find_dc(request, spectrum) : (ps_mean){0};
    PS_TRY(add_full(table, "full", spectrum, 0, dc, error));
    return request->full != NULL || request->wants_errors
               ? add_full(table, "full_standard_error", spectrum, 1, dc, error)
               : PSPEC_OK;
}

/* ---- coefficients ------------------------------------------------------------------------ */

/* The box of a set, S(-k) being the conjugate of S(k). */
static void fill_box(const ps_frequencies *set, const double *amplitudes, size_t num_entries,
                     double *box) {
    const double *const values = amplitudes + 2; /* behind S(0) */
    memcpy(box + num_entries / 2 * 2, amplitudes, 2 * sizeof *box);
    for (size_t i = 0; i < set->num; i++) {
        const size_t place = ps_spectrum_place(set, i);
        const size_t opposite = num_entries - 1 - place;
        box[2 * place] = box[2 * opposite] = values[2 * i];
        box[2 * place + 1] = values[2 * i + 1];
        box[2 * opposite + 1] = -values[2 * i + 1];
    }
}

/* [sets] where there are several, then the box, or the frequencies of a list. */
static pspec_status make_boxes(ps_npy_array *out, const ps_frequencies *set, size_t num_sets,
                               ps_error *error) {
    size_t shape[PS_MAX_DIMENSION + 1] = {num_sets};
    unsigned rank = num_sets > 1 ? 1 : 0;
    if (set->kind == PS_FREQUENCIES_LIST) {
        shape[rank++] = set->num;
    } else {
        for (unsigned axis = 0; axis < set->dimension; axis++) {
            shape[rank++] = 2 * (size_t)set->max_frequency + 1;
        }
    }
    return ps_npy_make_array(out, rank, shape, true, error);
}

/* S(k) of every set, complex128 [sets][2K+1]..[2K+1], or [sets][frequencies] of a list; without the
 * first axis where there is one set. */
static pspec_status add_coefficients(ps_table *table, const ps_power_job *job, ps_error *error) {
    const ps_frequencies *const set = job->problem.frequencies;
    const size_t num_sets = job->num_kept;
    ps_npy_array array;
    const double *amplitudes = job->kept;
    PS_TRY(make_boxes(&array, set, num_sets, error));
    const size_t num_entries = num_sets > 0 ? array.num / num_sets : 0;
    for (size_t r = 0; r < num_sets; r++, amplitudes += 2 + 2 * set->num) {
        double *const box = array.data + r * 2 * num_entries;
        if (set->kind == PS_FREQUENCIES_LIST) {
            memcpy(box, amplitudes + 2, 2 * num_entries * sizeof *box);
        } else {
            fill_box(set, amplitudes, num_entries, box);
        }
    }
    return ps_table_add_array(table, "coefficients", false, &array, error);
}

/* Are the names after --full and --coefficients, if any, those of NPY files? */
static pspec_status check_arrays(const ps_request *arguments, ps_error *error) {
    if (arguments->full != NULL) {
        PS_TRY(ps_npy_check_name("--full", arguments->full, error));
    }
    return arguments->coefficients == NULL
               ? PSPEC_OK
               : ps_npy_check_name("--coefficients", arguments->coefficients, error);
}

/* ---- the kind of answer ---------------------------------------------------------------------- */

static const ps_spectra_table table_kind = {"power", choose_columns, add_rows, add_arrays};

/* The row of every set that goes through the frequency of --scatter. */
static pspec_status add_scatter(ps_table *table, const ps_frequencies_spec *asked,
                                const ps_power_job *job, ps_error *error) {
    ps_scatter scatter;
    ps_npy_array array = {.rank = 2, .is_complex = true};
    PS_TRY(ps_scatter_take(&scatter, &array.data, asked, job, error));
    array.shape[0] = scatter.num_sets;
    array.shape[1] = 2 * (size_t)scatter.max_frequency + 1;
    array.num = array.shape[0] * array.shape[1];
    return ps_table_add_array(table, "scatter", false, &array, error);
}

static pspec_status tabulate(ps_answer *out, const void *computed, const ps_request *request,
                             ps_error *error) {
    const ps_spectra *const spectra = computed;
    const ps_power_job *const job = spectra->jobs[0];
    PS_TRY(ps_spectra_tabulate(out, computed, request, &table_kind, error));
    if (request->wants_coefficients || request->coefficients != NULL) {
        PS_TRY(add_coefficients(out->table, job, error));
    }
    return request->frequencies.num_shown > 0
               ? add_scatter(out->table, &request->frequencies, job, error)
               : PSPEC_OK;
}

static pspec_status merge(ps_answer *out, const ps_parts *parts, ps_error *error) {
    return ps_spectra_merge(out, parts, &table_kind, error);
}

static const ps_picture_kind pictures[] = {
    {.make = ps_spectra_figure,
     .by = PS_BY_SCENE,
     .x = "normalized_frequency",
     .lines = {{.y = "power", .error = "standard_error", .low = "lower", .high = "upper"}},
     .x_label = "normalized frequency |k| N^{-1/d}",
     .y_label = "radial mean power",
     .is_spectrum = true},
    {.suffix = "-picture",
     .make = ps_spectra_figure,
     .dealing = PS_OF_EACH,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_PICTURES,
     .x = "normalized_frequency",
     .lines = {{.y = "power", .error = "standard_error", .low = "lower", .high = "upper"}},
     .arrays = {{"first_set", PS_FRAME_SQUARE}, {"full", PS_FRAME_PLANE}},
     .y_label = "radial mean power",
     .is_spectrum = true},
    {.suffix = "-decibels",
     .make = ps_spectra_figure,
     .dealing = PS_OF_EACH,
     .by = PS_BY_SCENE,
     .needs = PS_NEEDS_DECIBELS,
     .x = "normalized_frequency",
     .lines = {{.y = "power", .error = "standard_error", .low = "lower", .high = "upper"}},
     .y_label = "radial mean power",
     .is_in_decibels = true,
     .is_spectrum = true},
    {.suffix = "-scatter",
     .make = ps_scatter_figure,
     .dealing = PS_OF_EACH,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_SCATTER},
    {.make = NULL}};

static const ps_field_row *const fields[] = {
    ps_fields_asked,    ps_fields_points, ps_fields_powers,   ps_fields_shape,
    ps_fields_profiles, ps_fields_ranges, ps_fields_computed, NULL};

static const ps_compared_field compared[] = {
    {"power", "standard_error", false, ps_compared_power_bound}, {.value = NULL}};

static const char *const sentences[] = {"convergence", "features", NULL};

const ps_kind ps_kind_power = {
    .name = "power",
    .purpose = "averaged periodogram of point sets on the torus",
    .usage = "power [options] --sampler NAME | power [options] FILE...",
    .description =
        "Averages the periodogram P(k) = N |sum w exp(-2 pi i k.x)|^2 / (sum w)^2 over "
        "realizations "
        "and prints its mean over rings of width 1, with standard errors over the realizations. "
        "In a box that is no cube (--box, or of the file) |k| is in cycles per edge of the cube "
        "of the same volume. "
        "Files hold points of [0,1)^d; several files, and several sets in a file, are "
        "realizations. "
        "The default --tol of 1e-6 bounds the numerical error of S relative to white noise.",
    .examples = {"pointspec power --sampler jittered -n 1024 -m 100 -k 64",
                 "pointspec sample --sampler halton -n 256 | pointspec power -k 32 -"},
    .takes = PS_COMMAND_BIT(power),
    .samples = PS_DOMAIN_TORUS,
    .counted = "realizations",
    .has_images = true,
    .has_decibels = true,
    .has_arrays = true,
    .has_coefficients = true,
    .check_arguments = check_arrays,
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
    .sentences = sentences,
    .compared = compared,
};
