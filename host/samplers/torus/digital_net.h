/* Digital nets in base 2: axis i of point j is the XOR of the direction numbers of axis i over the
 * set bits of j, read as a binary fraction of 32 digits. Then scrambling:
 *
 *   none  as it is; coordinates are multiples of 2^-32
 *   xor   one random 53-bit word per axis and realization is added without carry (digital shift):
 *         each point is uniform, the differences of points keep their digits
 *   owen  nested uniform scrambling (A. B. Owen 1995): digit b is flipped by a random bit that
 *         belongs to the digits above b, independently for each such prefix
 *
 * Both keep every net property, and both fill all 53 digits of a double with random bits.
 */
#ifndef PS_SAMPLERS_TORUS_DIGITAL_NET_H
#define PS_SAMPLERS_TORUS_DIGITAL_NET_H

#include "samplers/digital_net.h"
#include "samplers/sampler.h"

enum { PS_NET_DIGITS = SAMPLER_DIGITS };

typedef enum ps_net_scramble {
    PS_NET_PLAIN = NET_PLAIN,
    PS_NET_XOR = NET_XOR,
    PS_NET_OWEN = NET_OWEN
} ps_net_scramble;

/* The parameter "scramble", the same for every net. */
#define PS_NET_SCRAMBLE_PARAMETER                                                                  \
    { "scramble", "none", "none|xor|owen, how each realization is randomised" }

typedef struct ps_digital_net {
    unsigned dimension;
    uint32_t origin[PS_MAX_DIMENSION]; /* point 0 */
    /* steps[i][c]: XOR of direction numbers 0..c, which takes point j-1 to point j when j has c
     * trailing zeros, since j-1 and j differ in their c + 1 lowest bits. */
    uint32_t steps[PS_MAX_DIMENSION][PS_NET_DIGITS];
} ps_digital_net;

/* Direction number b (the leading digit is bit 31) belongs to bit b of the index. */
void ps_digital_net_set_axis(ps_digital_net *net, unsigned axis,
                             const uint32_t directions[PS_NET_DIGITS]);

pspec_status ps_digital_net_scramble(const ps_sampler_request *request, unsigned i_parameter,
                                     ps_net_scramble *scramble, ps_error *error) PS_MUST_CHECK;

/* Is that parameter "none"? Then every realization has the same points. */
bool ps_digital_net_is_plain(const ps_sampler_request *request, unsigned i_parameter);

/* For ps_sampler.seconds. */
double ps_digital_net_seconds(const ps_sampler_request *request, unsigned i_parameter);

/* What ps_sampler_by_index.fill leaves: the net's own numbers and its table. */
void ps_digital_net_places(const ps_digital_net *net, ps_net_scramble scramble,
                           ps_sampler_places *out);

/* Writes the first num_points points of the net, scrambled for this realization.
 * PSPEC_ERROR_CANCELLED where the watch asks to stop. */
pspec_status ps_digital_net_generate(const ps_digital_net *net, ps_net_scramble scramble,
                                     const ps_sampler_request *request, uint64_t realization,
                                     double *points, ps_error *error) PS_MUST_CHECK;

#endif
