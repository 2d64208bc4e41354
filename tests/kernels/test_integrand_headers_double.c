/* The headers of integrands, in double precision. */
#define PRECISION 64
#include "integrand_header_cases.h"
