#include "plan/needs.h"

#include <math.h>

static void add(ps_needs *needs, const char *what, const char *why, double share) {
    if (needs->num_skips < PS_MAX_SKIPS) {
        needs->skips[needs->num_skips++] = (ps_skip){what, why, share};
    }
}

/* Share of the box |k_i| <= K that lies outside the ball |k|^2 <= K^2 + K, by volume. */
static double share_of_corners(unsigned dimension, double max_frequency) {
    const double pi = 3.14159265358979323846;
    const double half = dimension / 2.0;
    const double radius = max_frequency + 0.5;
    const double ball = pow(pi, half) / tgamma(half + 1) * pow(radius, dimension);
    const double share = 1 - ball / pow(2 * radius, dimension);
    return share > 0 ? share : 0;
}

static double share_not_needed(const ps_needs_question *question) {
    const double all = (double)question->num_realizations;
    const double share = all > 0 ? 1 - question->expected_realizations / all : 0;
    return share > 0 ? share : 0;
}

ps_needs ps_needs_find(const ps_needs_question *question) {
    ps_needs needs = {0};
    const bool is_grid = question->max_frequency > 0;
    if (is_grid) {
        add(&needs, "frequencies -k", "real weights: P(-k) = P(k), a symmetry", 0.5);
    }
    if (question->on_sphere) {
        add(&needs, "orders m < 0", "real weights: c_l,-m = (-1)^m conj c_lm, a symmetry", 0.5);
    }
    if (question->on_hemisphere) {
        add(&needs, "odd degrees", "they vanish on the hemisphere, the projective plane", 0.5);
    }
    if (question->share_not_drawn > 0) {
        add(&needs, "frequencies outside the random subset of each ring",
            "asked for by --per-ring; the standard error has the error of the choice",
            question->share_not_drawn);
    }
    if (question->no_skip) {
        return needs;
    }
    if (is_grid && question->dimension > 1 && !question->wants_full_array) {
        needs.only_ball = true;
        add(&needs, "corners of the box", "only ring means are asked for, and rings end at K",
            share_of_corners(question->dimension, question->max_frequency));
    }
    if (question->is_homogenized) {
        needs.no_shift = true;
        if (question->on_sphere) {
            add(&needs, "random rotations", "a rotation of the sphere leaves the power unchanged",
                0);
        } else {
            add(&needs, "random shifts", "a shift of the torus leaves the power unchanged", 0);
        }
    }
    if (question->has_constant_power && question->num_realizations > 1) {
        needs.one_realization = true;
        add(&needs, "all realizations but the first",
            "a deterministic set has the same power every time",
            1 - 1 / (double)question->num_realizations);
    } else if (question->standard_error > 0) {
        needs.sequential = true;
        add(&needs, "realizations beyond the standard error asked for",
            "--standard-error; looked at after 16, 24, 32, 46, .. realizations (share: of white "
            "noise)",
            share_not_needed(question));
    }
    return needs;
}

void ps_needs_describe(const ps_needs *needs, ps_text *text) {
    for (size_t i = 0; i < needs->num_skips; i++) {
        ps_text_append(text, "%s%s (%s)", i > 0 ? "; " : "", needs->skips[i].what,
                       needs->skips[i].why);
    }
    if (needs->num_skips == 0) {
        ps_text_append(text, "nothing");
    }
}
