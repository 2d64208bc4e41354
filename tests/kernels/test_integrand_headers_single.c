/* The headers of integrands, in single precision. */
#define PRECISION 32
#include "integrand_header_cases.h"
