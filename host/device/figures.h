/* What was measured of a device: its peaks, and how long engines take there against the built-in cost model. Plain data:
 * written and read by plan/figures_file.h, measured by job/calibrate.h, looked at by the planner and by nobody else.
 */
#ifndef PS_DEVICE_FIGURES_H
#define PS_DEVICE_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

enum { PS_FIGURES_ENGINES = 16, PS_FIGURES_PRECISIONS = 3 };

/* Seconds taken over seconds of the cost model, by precision; 0: not measured. */
typedef struct ps_engine_figure {
    char engine[32];
    double scales[PS_FIGURES_PRECISIONS];
} ps_engine_figure;

typedef struct ps_figures {
    bool is_measured;    /* false: the built-in figures, and nothing below but the note */
    char note[320];      /* "built-in: WHY", "measured on DATE (CHECKSUM)" */
    char date[32];       /* as 2026-11-22T10:00:00Z */
    double flops[2];     /* peak of fused operations per second, single and double; 0: not known */
    double copied_bytes; /* per second, read and written by a copy; 0: not known */
    size_t num_engines;
    ps_engine_figure engines[PS_FIGURES_ENGINES];
} ps_figures;

/* The factor of an engine's seconds: 1 unless it was measured here. figures may be NULL. */
double ps_figures_scale(const ps_figures *figures, const char *engine, unsigned precision);

/* Its row, made if there is none yet; NULL when the table is full or the name too long. */
ps_engine_figure *ps_figures_row(ps_figures *figures, const char *engine);

#endif
