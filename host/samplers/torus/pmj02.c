/* Progressive multi-jittered (0,2) points (P. Christensen, A. Kensler and C. Kilpatrick 2018):
 * every beginning of 2^m points, and every block of as many after it, is a (0,m,2)-net, else as
 * random as can be. A random (0,2)-sequence in base 2 is Sobol's of two dimensions with Owen's
 * scrambling (A. Helmer, P. Christensen and A. Kensler 2021): these are its points. */
#include "samplers/list.h"

#include "samplers/torus/digital_net.h"
#include "samplers/values.h"

static pspec_status build_net(const ps_sampler_request *request, ps_digital_net *net,
                              ps_error *error) {
    return ps_sampler_sobol.build_net(request, net, error);
}

static pspec_status check(const ps_sampler_request *request, ps_error *error) {
    return ps_sampler_sobol.check(request, error);
}

const ps_sampler ps_sampler_pmj02 = {
    .name = "pmj02",
    .summary = "progressive (0,2)-sequence, at random; a net when N is a power of 2",
    .aliases = {"pmj"},
    .minimum_dimension = 2,
    .maximum_dimension = 2,
    .parameters = {{"scramble", "owen", "owen|hash|xor|none, as of sobol"}},
    .check = check,
    .build_net = build_net,
    PS_NET_MEMBERS,
};
