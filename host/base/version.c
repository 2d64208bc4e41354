#include "pointspec/pointspec.h"

#include "pointspec_version.h"

const char *pspec_version(void) {
    return PS_VERSION;
}
