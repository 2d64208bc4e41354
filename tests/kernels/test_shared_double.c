/* The headers shared with the device, in double precision. */
#define PRECISION 64
#include "shared_cases.h"
