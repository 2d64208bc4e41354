/* kernels/sphere in double precision. */
#define PRECISION 64
#include "sphere_header_cases.h"
