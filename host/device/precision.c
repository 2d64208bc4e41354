#include "device/precision.h"

const char *ps_precision_name(ps_precision precision) {
    static const char *const names[] = {"single", "double", "extended"};
    return names[precision];
}
