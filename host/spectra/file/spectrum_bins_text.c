/* The rule of bins in spectrum files. */
#include "base/text.h"
#include "spectra/file/spectrum_format.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char by_rounding[] = "rings";

ps_spectrum_bins_text ps_spectrum_bins_write(const ps_bin_rule *rule) {
    ps_spectrum_bins_text out;
    if (rule->kind == PS_BINS_RELATIVE) {
        snprintf(out.text, sizeof out.text, "%s %" PRIu64, ps_bin_rule_write(rule).text,
                 rule->num_points);
    } else {
        snprintf(out.text, sizeof out.text, "%s",
                 rule->kind == PS_BINS_ROUND ? by_rounding : ps_bin_rule_write(rule).text);
    }
    return out;
}

bool ps_spectrum_bins_parse(ps_bin_rule *out, const char *text, unsigned dimension) {
    ps_bin_rule_text word;
    uint64_t num_points = 0;
    const size_t length = strcspn(text, " ");
    if (length >= sizeof word.text ||
        (text[length] != '\0' && ps_parse_count(text + length + 1, "points", 1, SIZE_MAX / 16,
                                                &num_points, NULL) != PSPEC_OK)) {
        return false;
    }
    snprintf(word.text, sizeof word.text, "%.*s", (int)length, text);
    const bool is_round = strcmp(word.text, by_rounding) == 0;
    if (ps_bin_rule_parse(out, "bins", is_round ? "round" : word.text, NULL) != PSPEC_OK) {
        return false;
    }
    ps_bin_rule_resolve(out, dimension, num_points);
    return (num_points > 0) == (out->kind == PS_BINS_RELATIVE);
}
