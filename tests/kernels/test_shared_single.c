/* The headers shared with the device, in single precision. */
#define PRECISION 32
#include "shared_cases.h"
