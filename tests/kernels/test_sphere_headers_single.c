/* kernels/sphere in single precision. */
#define PRECISION 32
#include "sphere_header_cases.h"
