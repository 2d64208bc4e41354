#include "samplers/torus/radical_inverse.h"

#include "samplers/radical_inverse.h"

double ps_radical_inverse(unsigned i_prime, uint64_t index) {
    return radical_inverse(i_prime, index);
}
