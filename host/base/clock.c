#include "base/clock.h"

#include <time.h>

double ps_clock_seconds(void) {
    const double nano = 1e-9;
    struct timespec time = {0};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + nano * (double)time.tv_nsec;
}
