// FPO by T. Schloemer's program fpo, as UTK 1 had it: bench/blue_noise/peers.sh.
#include "peers.h"

#include <cfloat>
#include <iomanip>

#include "samplers/SamplerFPO/sampler-fpoT2.hpp"

size_t peer_fpo(size_t num, double, uint64_t set, double *points) {
    utk::Pointset<2, double, utk::Point<2, double>> made;
    rng.seed(set + 1);
    fpoSampler(made, static_cast<int>(num));
    for (size_t i = 0; i < made.size(); i++) {
        points[2 * i] = made[i].pos()[0];
        points[2 * i + 1] = made[i].pos()[1];
    }
    return made.size();
}
