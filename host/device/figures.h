/* What was measured of a device: its peaks, and how long engines take there against the built-in
 * cost model; of the host, how long samplers take. Plain data: written and read by
 * store/figures_file.h, measured by verify/bench/bench.h, looked at by the planner and by nobody
 * else.
 */
#ifndef PS_DEVICE_FIGURES_H
#define PS_DEVICE_FIGURES_H

#include <stdbool.h>
#include <stddef.h>

enum { PS_FIGURES_ENGINES = 16, PS_FIGURES_PRECISIONS = 3, PS_FIGURES_HOST = 64 };

/* Seconds taken over seconds of the cost model, by precision; 0: not measured. */
typedef struct ps_engine_figure {
    char engine[32];
    double scales[PS_FIGURES_PRECISIONS];
} ps_engine_figure;

/* Seconds taken over those of its row, of one sampler. */
typedef struct ps_host_figure {
    char sampler[32];
    double scale;
} ps_host_figure;

typedef struct ps_figures {
    bool is_measured;    /* false: the built-in figures, and nothing below but the note */
    char note[320];      /* "built-in: WHY", "measured on DATE (CHECKSUM)" */
    char date[32];       /* as 2026-11-22T10:00:00Z */
    double flops[2];     /* peak of fused operations per second, single and double; 0: not known */
    double copied_bytes; /* per second, read and written by a copy; 0: not known */
    double sent_bytes;   /* per second, from the host to the device; 0: not known */
    double launches;     /* of small kernels per second, one after the other; 0: not known */
    size_t num_engines;
    ps_engine_figure engines[PS_FIGURES_ENGINES];
    size_t num_host; /* of the host; none in the file of a device */
    ps_host_figure host[PS_FIGURES_HOST];
} ps_figures;

/* The factor of an engine's seconds: 1 unless it was measured here. figures may be NULL. */
double ps_figures_scale(const ps_figures *figures, const char *engine, unsigned precision);

/* What was measured, else what is built in. figures may be NULL. */
double ps_figures_launch_seconds(const ps_figures *figures, double built_in);
double ps_figures_sent_bytes(const ps_figures *figures, double built_in);

/* That of a sampler; where it was not measured, and of all other work of the host (NULL), the
 * geometric mean of those that were. figures may be NULL. */
double ps_figures_host_scale(const ps_figures *figures, const char *sampler);

/* Its row, made if there is none yet; NULL when the table is full or the name too long. */
ps_engine_figure *ps_figures_row(ps_figures *figures, const char *engine);
/* The same of a sampler. */
ps_host_figure *ps_figures_host_row(ps_figures *figures, const char *sampler);

#endif
