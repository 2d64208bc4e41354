/* The program gnuplot: where it is, and a script that it turns into a picture. Private to
 * host/plots; others look for it by ps_plot_find_gnuplot (plots/plot.h).
 *
 * The script is its standard input, a file without a name; the picture its standard output, a pipe
 * that is read here to its end. So no name needs quoting, nothing blocks, nothing is left behind,
 * and it is we who write the picture: gnuplot does not notice a disk that is full. */
#ifndef PS_PLOTS_GNUPLOT_H
#define PS_PLOTS_GNUPLOT_H

#include "base/status.h"
#include "base/text.h"

#include <stdio.h>

/* Appends the picture to a text. script: at its start; last: the bytes that a whole picture ends
 * in, but for empty lines. */
pspec_status ps_gnuplot_run(FILE *script, const char *last, ps_text *picture,
                            ps_error *error) PS_MUST_CHECK;

#endif
