/* Fields of spectra. */
#include "answers/spectra/spectra.h"

#define OF(name) PS_COMMAND_BIT(name)
#define OF_ALL (OF(power) | OF(angular) | OF(pairs))
static const char *const of_list = "--frequencies";
static const char *const kept = "-o FILE.npz";
static const char *const ranged = "-o FILE.npz with --range";

const ps_field_row ps_fields_powers[] = {
    {"scatter_frequency", "", PS_ENTRIES, OF(power), "--scatter", "k"},
    {"scatter_real", "", PS_ENTRIES, OF(power), "--scatter", "mean of S(k), real part"},
    {"scatter_imaginary", "", PS_ENTRIES, OF(power), "--scatter", "mean of S(k), imaginary part"},
    {"scatter_error", "", PS_ENTRIES, OF(power), "--scatter", "standard error of either part"},
    {"scatter_phase_p_value", "", PS_ENTRIES, OF(power), "--scatter",
     "probability that uniform phases have so long a mean (Rayleigh's test)"},
    {"k1", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 1"},
    {"k2", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 2"},
    {"k3", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 3"},
    {"k4", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 4"},
    {"k5", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 5"},
    {"k6", "cycles per cell", PS_COLUMN, OF(power), of_list, "k on axis 6"},
    {"bin", "", PS_COLUMN, OF(power), "rings",
     "number b of the ring; |k|^2 with --bins shells, or the number of the shell in a box that is "
     "no cube"},
    {"frequency", "cycles per cell", PS_COLUMN, OF(power), "rings", "mean |k| of the ring"},
    {"normalized_frequency", "", PS_COLUMN, OF(power), "rings", "mean |k| / N^(1/d)"},
    {"count", "", PS_COLUMN, OF(power), "rings",
     "frequencies of the ring, both signs; with --per-ring all that it has, not only those "
     "computed"},
    {"degree", "", PS_COLUMN, OF(angular) | OF(pairs), "", "l"},
    {"normalized_degree", "", PS_COLUMN, OF(angular), "", "l / sqrt(N)"},
    {"power", "", PS_COLUMN, OF(power) | OF(angular), "",
     "mean power over the ring or degree and all realizations; white noise is 1"},
    {"standard_error", "", PS_COLUMN, OF(power) | OF(angular), "",
     "standard error of power over realizations; missing for one realization"},
    {"anisotropy_db", "dB", PS_COLUMN, OF(power), "rings",
     "10 log10(s^2/P^2), s^2 the variance of the mean power within the ring and P its mean"},
    {"legendre_sum", "", PS_COLUMN, OF(pairs), "", "mean of Q(l) over realizations"},
    {"legendre_sum_error", "", PS_COLUMN, OF(pairs), "",
     "its standard error; missing for one realization"},
    {"c2", "", PS_COLUMN, OF(pairs), "", "mean of C_l^2; a rounding below 0 where it is 0"},
    {"c2_error", "", PS_COLUMN, OF(pairs), "", "its standard error"},
    {"full", "", PS_ARRAY, OF(power), "--full",
     "averaged periodogram, float64 [2K+1]^d, index k_i + K on axis i; of --plot in the plane, "
     "too"},
    {"full_standard_error", "", PS_ARRAY, OF(power), "--full",
     "its standard errors, of the same shape; a file of its own, FILE.standard_error.npy"},
    {"scatter", "", PS_ARRAY, OF(power), "--scatter",
     "S(j, k_2, ..) of each set for j = -K .. K, complex128 [M][2K+1]; no file of its own"},
    {"coefficients", "", PS_ARRAY, OF(power) | OF(angular), "--coefficients",
     "S(k) of each set, complex128 in the places of full; on the sphere c_lm of the only set at "
     "index m(2L+1-m)/2 + l"},
    {"first_set", "", PS_ARRAY, OF(power) | OF(angular), "--plot, full in the library",
     "points of the first set where the picture shows them, float64 [N][D]; no file of its own"},
    {"white_sums", "", PS_ARRAY, OF(pairs), "--plot",
     "for each question what Q(l) of white noise of these weights is in the mean, sum w^2; no file "
     "of its own"},
    {"state_asked", "", PS_STATE, OF_ALL, kept,
     "what was asked and no sum has: --per-ring, --standard-error, --floor, --fit and its "
     "exponent"},
    {"state_question", "", PS_STATE, OF_ALL, kept,
     "what the frequencies are: dimension, kind, step of degrees, K, reach, per ring, rule of "
     "bins, "
     "normalization, stretch"},
    {"state_totals", "", PS_STATE, OF_ALL, kept,
     "realizations, equal ones, smallest and largest N, sum of weights, N_ref, errors, sums of N "
     "and of W^2 / V"},
    {"state_bins", "", PS_STATE, OF_ALL, kept,
     "sums over realizations of means over bins, [bins][4]: sum and sum of squares, each as a "
     "double and what it lost"},
    {"state_powers", "", PS_STATE, OF(power), kept,
     "the same of frequencies, [frequencies][4], or [2] where nobody asked for their errors"},
    {"state_c2", "", PS_STATE, OF(pairs), kept, "the same of C_l^2, [degrees][4]"},
    {"state_frequencies", "", PS_STATE, OF(power), "-o FILE.npz with --frequencies, --per-ring",
     "the frequencies, [frequencies][d]"},
    {"state_rings", "", PS_STATE, OF(power), "-o FILE.npz with --per-ring",
     "frequencies that a ring has and their mean |k|, [bins][2]"},
    {"state_range", "", PS_STATE, OF_ALL, ranged,
     "A, B and M of the range, whether sums of bins and of frequencies are in single precision, "
     "the tolerance, of pairs the error of coefficients, largest sum w^2 / (sum |w|)^2 and mean "
     "power, and the plan: which, for which mean power, share and N"},
    {"state_parts", "", PS_STATE, OF_ALL, ranged,
     "what ranges are put together from, [parts][14]: first realization, number of them, sums of "
     "N, of W^2 / V and of W"},
    {"state_part_bins", "", PS_STATE, OF_ALL, ranged, "state_bins of each, [parts][bins][4]"},
    {"state_part_powers", "", PS_STATE, OF(power), ranged,
     "state_powers of each, [parts][frequencies][4]"},
    {"state_part_c2", "", PS_STATE, OF(pairs), ranged, "state_c2 of each, [parts][degrees][4]"},
    {.name = NULL}};

const ps_field_row ps_fields_shape[] = {
    {"fit", "", PS_ENTRIES, 0, "--fit", "how power behaves at frequency 0, a sentence"},
    {"fit_shape", "", PS_ENTRIES, 0, "--fit",
     "power law, plateau, undecided, neither, or none, where fit says why"},
    {"fit_reach", "", PS_ENTRIES, 0, "--fit",
     "the largest normalized frequency nu that was fitted"},
    {"exponent", "", PS_ENTRIES, 0, "--fit", "b of the law P = C nu^b exp(e nu^2)"},
    {"exponent_error", "", PS_ENTRIES, 0, "--fit", "its standard error"},
    {"exponent_chi2", "", PS_ENTRIES, 0, "--fit", "chi^2 of the law"},
    {"plateau", "", PS_ENTRIES, 0, "--fit", "p of P = p + q nu^2 + r nu^4"},
    {"plateau_error", "", PS_ENTRIES, 0, "--fit", "its standard error"},
    {"plateau_score", "", PS_ENTRIES, 0, "--fit", "standard errors between the plateau and 0"},
    {"plateau_chi2", "", PS_ENTRIES, 0, "--fit", "chi^2 of the plateau"},
    {"degrees_of_freedom", "", PS_ENTRIES, 0, "--fit", "of either chi^2"},
    {"convergence", "", PS_ENTRIES, 0, "--fit",
     "how fast variances of integration fall as N grows, if larger N have the same spectrum, and "
     "why; or unknown and why"},
    {"smooth_rate", "", PS_ENTRIES, 0, "--fit",
     "r of N^-r for integrands whose frequencies end somewhere, 1 + b/d"},
    {"smooth_rate_error", "", PS_ENTRIES, 0, "--fit",
     "its standard error; 0 where it does not depend on b"},
    {"jump_rate", "", PS_ENTRIES, 0, "--fit",
     "r of N^-r for discontinuous integrands, 1 + min(b, 1)/d"},
    {"jump_rate_error", "", PS_ENTRIES, 0, "--fit",
     "its standard error; 0 where it does not depend on b"},
    {"features", "", PS_ENTRIES, 0, "--fit", "peak, effective Nyquist frequency and anisotropy"},
    {"peak", "", PS_ENTRIES, 0, "--fit", "the largest power"},
    {"peak_error", "", PS_ENTRIES, 0, "--fit", "its standard error"},
    {"peak_frequency", "", PS_ENTRIES, 0, "--fit", "the normalized frequency where it is"},
    {"effective_nyquist", "", PS_ENTRIES, 0, "--fit",
     "half of the nu up to which the mean of P over all frequencies is 0.1; 1/2 of a square grid, "
     "0 of white noise, missing where the cut-off comes before"},
    {"mean_anisotropy_db", "dB", PS_ENTRIES, 0, "--fit",
     "of the mean of s^2/P^2 over rings by their count, beside noise_level_db"},
    {"lower", "", PS_COLUMN, 0, "--fit", "profile below the power"},
    {"upper", "", PS_COLUMN, 0, "--fit", "profile above the power"},
    {"fit", "", PS_COLUMN, 0, "--fit", "the curve that was fitted, law or plateau"},
    {.name = NULL}};

static const char *const found = "--fit, --bounds";

const ps_field_row ps_fields_profiles[] = {
    {"upper_profile", "", PS_ENTRIES, 0, found, "the profile above the power, a sentence"},
    {"upper_gamma", "", PS_ENTRIES, 0, found,
     "P <= gamma (nu/alpha)^B below alpha, P <= gamma above, for P plus three standard errors"},
    {"upper_alpha", "", PS_ENTRIES, 0, found, "alpha of that"},
    {"upper_exponent", "", PS_ENTRIES, 0, found,
     "B of that: as given, or the whole number nearest to the exponent that was fitted"},
    {"best_case_rate", "", PS_ENTRIES, 0, found,
     "variances fall like N^-rate by the upper profile, 1 + B/d of integrands whose frequencies "
     "end somewhere"},
    {"worst_case_rate", "", PS_ENTRIES, 0, found, "the same of those with a jump, 1 + min(B, 1)/d"},
    {"lower_profile", "", PS_ENTRIES, 0, found, "the profile below the power, a sentence"},
    {"lower_gamma", "", PS_ENTRIES, 0, found, "as upper_gamma, with >= and minus three errors"},
    {"lower_alpha", "", PS_ENTRIES, 0, found, "alpha of that"},
    {"lower_exponent", "", PS_ENTRIES, 0, found, "B of that"},
    {.name = NULL}};
