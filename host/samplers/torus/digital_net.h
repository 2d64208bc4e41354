/* Digital nets in base 2: axis i of point j is the XOR of the direction numbers of axis i over the
 * set bits of j, read as a binary fraction of 32 digits. Then scrambling:
 *
 *   none  as it is; coordinates are multiples of 2^-32
 *   xor   one random 53-bit word per axis and realization is added without carry (digital shift):
 *         each point is uniform, the differences of points keep their digits
 *   owen  nested uniform scrambling (A. B. Owen 1995): digit b is flipped by a random bit that
 *         belongs to the digits above b, independently for each such prefix
 *   hash  the same by a hash instead of independent bits, in a fifteenth of the time
 *
 * All keep every net property, and all fill the 53 digits of a double with random bits.
 */
#ifndef PS_SAMPLERS_TORUS_DIGITAL_NET_H
#define PS_SAMPLERS_TORUS_DIGITAL_NET_H

#include "samplers/digital_net.h"
#include "samplers/sampler.h"

enum { PS_NET_DIGITS = SAMPLER_DIGITS };

typedef enum ps_net_scramble {
    PS_NET_PLAIN = NET_PLAIN,
    PS_NET_XOR = NET_XOR,
    PS_NET_OWEN = NET_OWEN,
    PS_NET_HASH = NET_HASH
} ps_net_scramble;

/* The parameter "scramble", the first of every net. */
#define PS_NET_SCRAMBLE_PARAMETER                                                                  \
    { "scramble", "none", "none|xor|owen|hash, how each realization is randomised" }

struct ps_digital_net {
    unsigned dimension;
    uint32_t origin[PS_MAX_DIMENSION]; /* point 0 */
    /* steps[i][c]: XOR of direction numbers 0..c, which takes point j-1 to point j when j has c
     * trailing zeros, since j-1 and j differ in their c + 1 lowest bits. */
    uint32_t steps[PS_MAX_DIMENSION][PS_NET_DIGITS];
};

/* Direction number b (the leading digit is bit 31) belongs to bit b of the index. */
void ps_digital_net_set_axis(ps_digital_net *net, unsigned axis,
                             const uint32_t directions[PS_NET_DIGITS]);

/* Members of the rows (samplers/sampler.h) with a .build_net, which begins with {.dimension}. */
bool ps_digital_net_is_plain(const ps_sampler_request *request);
double ps_digital_net_seconds(const ps_sampler_request *request);
/* Is the scramble one of those? */
pspec_status ps_digital_net_check(const ps_sampler_request *request, ps_error *error) PS_MUST_CHECK;
pspec_status ps_digital_net_generate(const ps_sampler_request *request, uint64_t realization,
                                     double *points, ps_error *error) PS_MUST_CHECK;
pspec_status ps_digital_net_fill(const ps_sampler_request *request, ps_sampler_places *out,
                                 ps_error *error) PS_MUST_CHECK;
#define PS_NET_MEMBERS                                                                             \
    .seconds = ps_digital_net_seconds, .is_deterministic = ps_digital_net_is_plain,                \
    .generate = ps_digital_net_generate,                                                           \
    .by_index = {.name = "net", .fill = ps_digital_net_fill, .places = net_places}

#endif
