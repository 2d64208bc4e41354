/* Rows of pointspec bench, kept for a picture of run time against error: a panel for every case. */
#ifndef PS_VERIFY_BENCH_BENCH_PLOT_H
#define PS_VERIFY_BENCH_BENCH_PLOT_H

#include "verify/bench/bench.h"

typedef struct ps_bench_rows {
    ps_bench_row *rows;
    size_t num, capacity;
} ps_bench_rows;

pspec_status ps_bench_rows_add(ps_bench_rows *list, const ps_bench_row *rows, size_t num,
                               ps_error *error) PS_MUST_CHECK;
void ps_bench_rows_free(ps_bench_rows *rows);

/* The rows of a case follow each other. */
pspec_status ps_bench_plot(const char *path, const ps_bench_rows *measured, const char *device,
                           ps_error *error) PS_MUST_CHECK;

#endif
