#include "spectra/shape/low_end.h"

#include "base/memory.h"
#include "math/gsl/regression.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* Normalized frequencies: bins up to REACH are fitted, and more up to MOST_REACH where these are
 * too few. Jittered points, d = 2, depart from their law and its curvature by 0.2 % at REACH. */
static const double REACH = 0.25, MOST_REACH = 0.5;
/* Standard errors from which on something is not taken for chance. */
static const double SIGNIFICANT = 3;
enum { NUM_COEFFICIENTS = 3, MOST_ROUNDS = 10 };

static bool is_on_sphere(const ps_spectrum *spectrum) {
    return spectrum->frequencies.kind == PS_FREQUENCIES_DEGREES;
}

double ps_shape_unit(const ps_spectrum *spectrum) {
    return is_on_sphere(spectrum) ? sqrt(PS_PI) : 1;
}

const char *ps_shape_bin_name(const ps_spectrum *spectrum) {
    return is_on_sphere(spectrum) ? "degree" : "ring";
}

/* ---- what can be fitted ------------------------------------------------------------------- */

static size_t count_below(const ps_spectrum *spectrum, double frequency) {
    size_t num = 0;
    while (num < spectrum->num_bins && spectrum->bins[num].normalized_frequency <= frequency) {
        num++;
    }
    return num;
}

static pspec_status choose_bins(size_t *num, const ps_spectrum *spectrum, ps_error *error) {
    const double unit = ps_shape_unit(spectrum);
    const size_t most = count_below(spectrum, MOST_REACH * unit);
    *num = count_below(spectrum, REACH * unit);
    if (most < PS_FEWEST_FITTED_BINS) {
        return ps_fail(
            error, PSPEC_ERROR_INPUT,
            "%zu %s%s up to %.3g of the normalized frequency %s fewer than the %d that a "
            "fit needs; more points have more of them",
            most, ps_shape_bin_name(spectrum), most == 1 ? "" : "s", MOST_REACH * unit,
            most == 1 ? "is" : "are", PS_FEWEST_FITTED_BINS);
    }
    *num = *num < PS_FEWEST_FITTED_BINS ? PS_FEWEST_FITTED_BINS : *num;
    return PSPEC_OK;
}

static pspec_status check(const ps_spectrum *spectrum, size_t num, ps_error *error) {
    const char *const name = ps_shape_bin_name(spectrum);
    if (spectrum->num_realizations < PS_FEWEST_FITTED_REALIZATIONS) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "the standard errors of %llu realization%s do not carry a fit; it needs %d "
                       "realizations",
                       (unsigned long long)spectrum->num_realizations,
                       spectrum->num_realizations == 1 ? "" : "s", PS_FEWEST_FITTED_REALIZATIONS);
    }
    for (size_t b = 0; b < num; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        if (!(bin->power > 0)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "the power of %s %lld is %g, of which there is no logarithm", name,
                           (long long)bin->key, bin->power);
        }
        if (!(bin->standard_error > 0)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s %lld has no standard error above 0 that could weigh it: its power "
                           "is the same in all realizations",
                           name, (long long)bin->key);
        }
    }
    return PSPEC_OK;
}

/* sqrt(l(l+1)) in place of l. */
static double find_frequency(const ps_spectrum *spectrum, const ps_spectrum_bin *bin) {
    return is_on_sphere(spectrum) ? bin->normalized_frequency * sqrt(1 + 1 / bin->frequency)
                                  : bin->normalized_frequency;
}

/* ---- fits --------------------------------------------------------------------------------- */

/* Columns of num numbers each but for rows, [num][NUM_COEFFICIENTS]; all in one block. */
typedef struct work {
    size_t num;
    double *frequencies, *powers, *relative_errors;
    double *logarithms; /* of powers, without bias */
    double *rows, *places, *weights, *model;
} work;

static pspec_status make_work(work *self, const ps_spectrum *spectrum, size_t num,
                              ps_error *error) {
    enum { COLUMNS = 7 };
    double *block = NULL;
    const double realizations = (double)spectrum->num_realizations;
    PS_TRY(PS_NEW(&block, (COLUMNS + NUM_COEFFICIENTS) * num, "a fit", error));
    *self = (work){num,
                   block,
                   block + num,
                   block + 2 * num,
                   block + 3 * num,
                   block + COLUMNS * num,
                   block + 4 * num,
                   block + 5 * num,
                   block + 6 * num};
    for (size_t b = 0; b < num; b++) {
        const ps_spectrum_bin *const bin = &spectrum->bins[b];
        self->frequencies[b] = find_frequency(spectrum, bin);
        self->powers[b] = bin->power;
        self->relative_errors[b] = bin->standard_error / bin->power;
        /* The logarithm of a mean of M n exponential powers, n half of the bin's frequencies, is on
         * average 1/(2 M n) too small. */
        self->logarithms[b] = log(bin->power) + 1 / (realizations * (double)bin->num_computed);
    }
    return PSPEC_OK;
}

/* ln P = ln factor + exponent ln nu + curvature nu^2 */
static pspec_status fit_law(ps_low_end *out, const work *self, ps_error *error) {
    ps_regression law;
    for (size_t b = 0; b < self->num; b++) {
        const double nu = self->frequencies[b];
        double *const row = self->rows + b * NUM_COEFFICIENTS;
        row[0] = 1;
        row[1] = log(nu);
        row[2] = nu * nu;
        self->weights[b] = 1 / (self->relative_errors[b] * self->relative_errors[b]);
    }
    PS_TRY(ps_regress(&law, self->num, NUM_COEFFICIENTS, self->rows, self->logarithms,
                      self->weights, error));
    out->factor = exp(law.coefficients[0]);
    out->exponent = law.coefficients[1];
    out->exponent_error = law.errors[1];
    out->curvature = law.coefficients[2];
    out->law_chi2 = law.chi2;
    return PSPEC_OK;
}

static double law_power(const ps_low_end *self, double nu) {
    return self->factor * pow(nu, self->exponent) * exp(self->curvature * nu * nu);
}

static double plateau_power(const ps_low_end *self, double nu) {
    const double square = nu * nu;
    return self->plateau + square * (self->square + square * self->fourth);
}

/* Between a quarter and four times what was measured: a fit on its way may be below 0. */
static double near(double model, double power) {
    const double far = 4;
    return fmin(fmax(model, power / far), power * far);
}

/* The errors are relative ones of the model, not of what was measured: where a bin came out small
 * its error did, too, and it would count for more. */
static pspec_status improve_plateau(ps_low_end *out, const work *self, ps_error *error) {
    ps_regression plateau;
    for (size_t b = 0; b < self->num; b++) {
        const double square = self->frequencies[b] * self->frequencies[b];
        const double deviation = self->relative_errors[b] * self->model[b];
        double *const row = self->rows + b * NUM_COEFFICIENTS;
        row[0] = 1;
        row[1] = square;
        row[2] = square * square;
        self->weights[b] = 1 / (deviation * deviation);
    }
    PS_TRY(ps_regress(&plateau, self->num, NUM_COEFFICIENTS, self->rows, self->powers,
                      self->weights, error));
    out->plateau = plateau.coefficients[0];
    out->plateau_error = plateau.errors[0];
    out->square = plateau.coefficients[1];
    out->fourth = plateau.coefficients[2];
    return PSPEC_OK;
}

/* Both fits are judged by logarithms. */
static pspec_status fit_plateau(ps_low_end *out, const work *self, ps_error *error) {
    for (size_t b = 0; b < self->num; b++) {
        self->model[b] = near(law_power(out, self->frequencies[b]), self->powers[b]);
    }
    for (int round = 0; round < MOST_ROUNDS; round++) {
        PS_TRY(improve_plateau(out, self, error));
        for (size_t b = 0; b < self->num; b++) {
            self->model[b] = near(plateau_power(out, self->frequencies[b]), self->powers[b]);
        }
    }
    for (size_t b = 0; b < self->num; b++) {
        const double residual =
            (self->logarithms[b] - log(self->model[b])) / self->relative_errors[b];
        out->plateau_chi2 += residual * residual;
    }
    return PSPEC_OK;
}

/* Variances that were measured in M realizations weigh too much where they came out small. The
 * squares of errors are then too small by (M-1)/(M-4), and chi^2 too large by (M-1)/(M-2): this is
 * simulated for M from 8 to 100. */
static void correct(ps_low_end *out, const ps_spectrum *spectrum) {
    const double num = (double)spectrum->num_realizations;
    const double growth = sqrt((num - 1) / (num - 4));
    out->exponent_error *= growth;
    out->plateau_error *= growth;
    out->law_chi2 *= (num - 2) / (num - 1);
    out->plateau_chi2 *= (num - 2) / (num - 1);
}

/* Few spectra fall to 0 by less than the root of nu: what looks so is a plateau that rises, unless
 * the law is better by as much as three standard errors are. */
static ps_low_shape find_shape(const ps_low_end *self) {
    const double faint = 0.5;
    const bool is_flat = fabs(self->exponent) <= SIGNIFICANT * self->exponent_error;
    const bool has_plateau = self->plateau > SIGNIFICANT * self->plateau_error;
    const double lead = fabs(self->exponent) < faint ? SIGNIFICANT * SIGNIFICANT : 0;
    if (has_plateau && (is_flat || self->plateau_chi2 <= self->law_chi2 + lead)) {
        return PS_LOW_PLATEAU;
    }
    return is_flat ? PS_LOW_UNDECIDED : PS_LOW_POWER_LAW;
}

static ps_low_shape decide(const ps_low_end *self) {
    const double far = 6; /* standard deviations of chi^2 */
    const double num = (double)self->degrees_of_freedom;
    const ps_low_shape shape = find_shape(self);
    const double chi2 = shape == PS_LOW_PLATEAU     ? self->plateau_chi2
                        : shape == PS_LOW_POWER_LAW ? self->law_chi2
                                                    : fmin(self->plateau_chi2, self->law_chi2);
    return chi2 <= num + far * sqrt(2 * num) ? shape : PS_LOW_NEITHER;
}

pspec_status ps_low_end_fit(ps_low_end *out, const ps_spectrum *spectrum, ps_error *error) {
    size_t num = 0;
    work memory;
    *out = (ps_low_end){0};
    PS_TRY(choose_bins(&num, spectrum, error));
    PS_TRY(check(spectrum, num, error));
    PS_TRY(make_work(&memory, spectrum, num, error));
    out->num_bins = num;
    out->reach = spectrum->bins[num - 1].normalized_frequency;
    out->degrees_of_freedom = num - NUM_COEFFICIENTS;
    pspec_status status = fit_law(out, &memory, error);
    if (status == PSPEC_OK) {
        status = fit_plateau(out, &memory, error);
    }
    free(memory.frequencies);
    correct(out, spectrum);
    out->shape = decide(out);
    return status;
}

double ps_low_end_power(const ps_low_end *self, const ps_spectrum *spectrum,
                        const ps_spectrum_bin *bin) {
    const double nu = find_frequency(spectrum, bin);
    const bool is_plateau = self->shape == PS_LOW_PLATEAU ||
                            (self->shape == PS_LOW_NEITHER && self->plateau_chi2 < self->law_chi2);
    return is_plateau ? plateau_power(self, nu) : law_power(self, nu);
}
