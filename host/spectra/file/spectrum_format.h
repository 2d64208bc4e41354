/* What writer and reader of spectrum files agree on; see docs/user/spectrum_file.md. */
#ifndef PS_SPECTRA_FILE_SPECTRUM_FORMAT_H
#define PS_SPECTRA_FILE_SPECTRUM_FORMAT_H

#include "frequencies/bin_rule.h"

#include <stdint.h>

#define PS_SPECTRUM_MAGIC "pointspec spectrum"
enum { PS_SPECTRUM_VERSION = 3, PS_SPECTRUM_OLD_VERSION = 2 };

/* Values of the header lines, by the enumerators that they stand for; frequencies by these. */
static const char *const ps_spectrum_kinds[] = {"list",   "box",     "ball",
                                                "sample", "degrees", "even-degrees"};
static const char *const ps_spectrum_normalizations[] = {"power", "effective", "pairs", "integral"};

/* A sample is a list in memory (ps_frequencies.rings), and a kind of its own in files; degrees are
 * two. */
enum {
    PS_SPECTRUM_LIST,
    PS_SPECTRUM_BOX,
    PS_SPECTRUM_BALL,
    PS_SPECTRUM_SAMPLE,
    PS_SPECTRUM_DEGREES,
    PS_SPECTRUM_EVEN_DEGREES,
    PS_SPECTRUM_NUM_KINDS
};

/* The value of the line of bins: words of ps_bin_rule_write, but "rings" for round, and of relative
 * widths N behind a blank. */
typedef struct ps_spectrum_bins_text {
    char text[80];
} ps_spectrum_bins_text;
ps_spectrum_bins_text ps_spectrum_bins_write(const ps_bin_rule *rule);
/* False where it is none. */
bool ps_spectrum_bins_parse(ps_bin_rule *out, const char *text, unsigned dimension);

/* Doubles after the header, and of the sums of what follows: points, effective sample sizes, bins,
 * frequencies. */
enum { PS_SPECTRUM_TOTALS = 3, PS_SPECTRUM_SUMS = 4 };
/* Version 2 has the sum of N among the totals, not that of its squares; and what it calls power is
 * that of integrals, but of sets of one N. */
enum { PS_SPECTRUM_OLD_TOTALS = 4 };

/* More realizations than a double counts exactly are no realizations. */
#define PS_SPECTRUM_MOST_REALIZATIONS ((uint64_t)1 << 53)

#endif
