/* Which bin a frequency belongs to, by its norm: rings of width 1 around whole numbers, rings of a
 * width P/Q from 0 on (floor is the width 1), the same in units of N^(1/d), or exact shells
 * (docs/mathematics/torus.md#rings). Every border is decided in whole numbers: there are no ties,
 * and no rounding moves a frequency.
 *
 *     round       bin b:      b^2 - b + 1 <= |k|^2 <= b^2 + b
 *     width       bin b:      b^2 P^2 <= Q^2 |k|^2 < (b + 1)^2 P^2
 *     relative    bin b:      (b P)^(2d) N^2 <= Q^(2d) |k|^(2d) < ((b + 1) P)^(2d) N^2
 *     shells      bin n:      |k|^2 = n
 *
 * DC belongs to none: bin 0 of a width above 1 has the other frequencies below it.
 */
#ifndef PS_FREQUENCIES_BIN_RULE_H
#define PS_FREQUENCIES_BIN_RULE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum ps_bin_kind {
    PS_BINS_ROUND,
    PS_BINS_WIDTH,
    PS_BINS_RELATIVE,
    PS_BINS_SHELLS
} ps_bin_kind;

/* Finer borders than these are nobody's; products of them stay within the words of bin_rule.c. */
enum { PS_MOST_BIN_WIDTH = 1000000 };

typedef struct ps_bin_rule {
    ps_bin_kind kind;
    uint32_t numerator, denominator; /* P and Q of widths, in lowest terms, at most 10^6 */
    unsigned dimension;              /* d and N of relative widths; 0 until they are known */
    uint64_t num_points;
} ps_bin_rule;

#define PS_BIN_RULES "round|floor|width=P/Q|relative=P/Q|shells"

/* One of PS_BIN_RULES; "/Q" may be left out. shown names it in sentences. */
pspec_status ps_bin_rule_parse(ps_bin_rule *out, const char *shown, const char *text,
                               ps_error *error) PS_MUST_CHECK;
/* The word that is parsed back. */
typedef struct ps_bin_rule_text {
    char text[48];
} ps_bin_rule_text;
ps_bin_rule_text ps_bin_rule_write(const ps_bin_rule *rule);
bool ps_bin_rule_is_same(const ps_bin_rule *a, const ps_bin_rule *b);
/* "ring" or "shell", for sentences. */
const char *ps_bin_rule_noun(const ps_bin_rule *rule);

/* Makes d and N of relative widths known, in others nothing. */
void ps_bin_rule_resolve(ps_bin_rule *rule, unsigned dimension, uint64_t num_points);

/* The ring number of |k|^2 >= 1, by rounding. */
int64_t ps_ring_of_norm2(int64_t norm2);
/* The bin of |k|^2 >= 1, of a rule that is resolved. |k_i| is at most 2^28. */
int64_t ps_bin_rule_find(const ps_bin_rule *rule, int64_t norm2);
/* The same of a squared length that is no whole number, where borders are right to 10^-12: what is
 * nearer to one is on it, in the bin above. Of shells a number that tells apart what differs by
 * more than 10^-6. */
int64_t ps_bin_rule_find_length(const ps_bin_rule *rule, double length2);
/* The smallest |k|^2 >= 1 that no bin below this one has. */
int64_t ps_bin_rule_low(const ps_bin_rule *rule, int64_t bin);
/* The largest |k|^2 of bins that are complete in the box |k_i| <= K; 0: none is. Shells are those
 * of the rings by rounding. */
int64_t ps_bin_rule_largest(const ps_bin_rule *rule, int32_t max_frequency);

#endif
