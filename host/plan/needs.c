#include "plan/needs.h"

#include "math/pi.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void ps_needs_add(ps_needs *needs, const char *what, const char *why, double share) {
    if (needs->num_skips < PS_MAX_SKIPS) {
        ps_skip *const skip = &needs->skips[needs->num_skips++];
        *skip = (ps_skip){.share = share};
        snprintf(skip->what, sizeof skip->what, "%s", what);
        snprintf(skip->why, sizeof skip->why, "%s", why);
        needs->num_of_question = needs->num_skips;
    }
}

/* Share of the box |k_i| <= K that lies outside the ball of the bins, by volume: the unit cubes of
 * the box reach to K + 1/2, and so does the ball of rings by rounding. */
static double share_of_corners(unsigned dimension, double max_frequency, int64_t max_norm2) {
    const double half = dimension / 2.0;
    const double reach = 0.5;
    const double radius = sqrt((double)max_norm2 + reach * reach);
    const double ball = pow(PS_PI, half) / tgamma(half + 1) * pow(radius, dimension);
    const double share = 1 - ball / pow(2 * (max_frequency + reach), dimension);
    return share > 0 ? share : 0;
}

static double share_not_needed(const ps_needs_question *question) {
    const double all = (double)question->num_realizations;
    const double share = all > 0 ? 1 - question->expected_realizations / all : 0;
    return share > 0 ? share : 0;
}

ps_needs ps_needs_find(const ps_needs_question *question) {
    ps_needs needs = {.no_skip = question->accuracy.no_skip};
    const bool is_grid = question->max_frequency > 0;
    if (is_grid) {
        ps_needs_add(&needs, "frequencies -k", "real weights: P(-k) = P(k), a symmetry", 0.5);
    }
    if (question->on_sphere) {
        ps_needs_add(&needs, "orders m < 0", "real weights: c_l,-m = (-1)^m conj c_lm, a symmetry",
                     0.5);
    }
    if (question->on_hemisphere) {
        ps_needs_add(&needs, "odd degrees", "they vanish on the hemisphere, the projective plane",
                     0.5);
    }
    if (question->share_not_drawn > 0) {
        ps_needs_add(&needs, "frequencies outside the random subset of each ring",
                     "asked for by --per-ring; the standard error has the error of the choice",
                     question->share_not_drawn);
    }
    if (question->accuracy.no_skip) {
        return needs;
    }
    if (is_grid && question->dimension > 1 && !question->wants_full_array &&
        !(question->share_not_drawn > 0)) {
        ps_needs_add(
            &needs, PS_SKIP_CORNERS, "only ring means are asked for, and rings end at K",
            share_of_corners(question->dimension, question->max_frequency, question->max_norm2));
    }
    needs.no_frequency_errors =
        is_grid && question->dimension > 1 && !question->wants_frequency_errors;
    if (question->is_homogenized) {
        needs.no_shift = true;
        if (question->on_sphere) {
            ps_needs_add(&needs, "random rotations",
                         "a rotation of the sphere leaves the power unchanged", 0);
        } else {
            ps_needs_add(&needs, "random shifts", "a shift of the torus leaves the power unchanged",
                         0);
        }
    }
    if (question->has_constant_power && question->num_realizations > 1) {
        needs.one_realization = true;
        ps_needs_add(&needs, "all realizations but the first",
                     "a deterministic set has the same power every time",
                     1 - 1 / (double)question->num_realizations);
    } else if (question->accuracy.standard_error > 0) {
        needs.sequential = true;
        ps_needs_add(
            &needs, "realizations beyond the standard error asked for",
            "--standard-error; looked at after 16, 24, 32, 46, .. realizations (share: of white "
            "noise)",
            share_not_needed(question));
    }
    return needs;
}

void ps_needs_rate(ps_needs *needs, const char *what, double share) {
    for (size_t i = 0; i < needs->num_skips; i++) {
        if (strcmp(needs->skips[i].what, what) == 0) {
            needs->skips[i].share = share;
        }
    }
}

void ps_needs_describe(const ps_needs *needs, ps_text *text) {
    size_t num = 0;
    for (size_t i = 0; i < needs->num_skips; i++) {
        if (!needs->skips[i].is_matter_of_course) {
            ps_text_append(text, "%s%s (%s)", num++ > 0 ? "; " : "", needs->skips[i].what,
                           needs->skips[i].why);
        }
    }
    if (num == 0) {
        ps_text_append(text, "nothing");
    }
}
