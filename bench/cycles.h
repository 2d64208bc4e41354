/* Measures the table of host/engines/nufft/cycles.c: what the parts of a fast transform cost on
 * this device. */
#ifndef BENCH_CYCLES_H
#define BENCH_CYCLES_H

#include "engines/engine.h"

/* Prints the rows of the table as they stand there, and how well they and those that stand there
 * now describe what was measured. selector: of the device, as POINTSPEC_DEVICE. */
void bench_calibrate_cycles(const char *selector);

#endif
