/* What differs between the ways in which torus_nufft treats a problem. A variant is a row, which
 * says when it applies and what it takes, and a launcher, which does it on the device; both are in
 * a folder of its own. variants.c lists the rows.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_VARIANT_H
#define PS_ENGINES_TORUS_NUFFT_VARIANT_H

#include "engines/nufft/grid_axis.h"
#include "engines/torus/nufft/cost.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/torus_points.h"

/* Points on the device, as sort.cl takes them. */
typedef struct ps_nufft_source {
    const ps_buffer *points, *weights, *offsets;
    size_t num_points; /* of all parts */
    bool has_weights;
} ps_nufft_source;

/* Point sets in the order of cells (kernels/nufft/place.h). */

typedef struct ps_nufft_places {
    const ps_nufft_layout *layout;
    ps_device *device;
    unsigned dimension;
    ps_torus_points points; /* {0}: places are made of points that others have on the device */
    size_t num_points;      /* that were uploaded */
    ps_kernel *sort;        /* or keys, where there is an order */
    ps_nufft_order order;   /* on GPUs */
    uint64_t *host_places;
    ps_buffer places, sorted, heights, starts;
} ps_nufft_places;

/* What kernels that know the cells of a layout are compiled with. */
ps_defines ps_nufft_defines(const ps_nufft_layout *layout, unsigned dimension);

/* layout is borrowed. */
pspec_status ps_nufft_places_create(ps_nufft_places *out, const ps_nufft_layout *layout,
                                    unsigned dimension, ps_precision precision, ps_device *device,
                                    ps_error *error) PS_MUST_CHECK;
void ps_nufft_places_free(ps_nufft_places *places);

/* The same without points of its own. */
pspec_status ps_nufft_places_create_order(ps_nufft_places *out, const ps_nufft_layout *layout,
                                          unsigned dimension, ps_precision precision,
                                          ps_device *device, ps_error *error) PS_MUST_CHECK;

/* Every pattern has at most layout->part_points points; at most layout->parts of them. */
pspec_status ps_nufft_places_upload(ps_nufft_places *places, const ps_batch *parts,
                                    ps_error *error) PS_MUST_CHECK;
/* Sorts what was uploaded by the cells or boxes of the layout. */
pspec_status ps_nufft_places_sort(ps_nufft_places *places, size_t num_parts,
                                  ps_error *error) PS_MUST_CHECK;
/* Sorts the points of parts that others have on the device. */
pspec_status ps_nufft_places_order(ps_nufft_places *places, const ps_nufft_source *source,
                                   const ps_batch *parts, ps_error *error) PS_MUST_CHECK;

/* Of an axis whose row must fit into local memory, a megabyte at most, in one lane of 8 bytes. */
enum { PS_NUFFT_MOST_ROW_CELLS = 1 << 17 };

/* Makes powers of realizations that are on their way to the device. */
typedef struct ps_nufft_launcher ps_nufft_launcher;

struct ps_nufft_variant {
    bool on_cpus, on_gpus; /* kinds of devices that it serves */
    bool is_gridded;       /* spreads points on all axes, axis 0 included, as real numbers */
    bool are_alike;        /* its axes have the same cells and windows */
    uint32_t most_cells;   /* of an axis */

    /* ---- what a choice is made of (choose.c) */
    /* Makes offer number `which` to a problem, with frequencies and without grids; false: there are
     * no more. */
    bool (*offer)(const ps_problem *, unsigned lanes, unsigned which, ps_nufft_choice *);
    /* What the cells of an axis are a multiple of; NULL: 1. */
    uint32_t (*unit)(const ps_nufft_choice *, unsigned axis);
    /* Completes a choice whose axes have grids and windows, in way number `which`; false: there are
     * no more, or it cannot be done. NULL: nothing is left to choose. */
    bool (*complete)(ps_nufft_choice *, const ps_problem *, ps_precision, unsigned which);
    /* What is left to decide, whatever it costs, once this choice is the best; NULL: nothing. */
    void (*settle)(ps_nufft_choice *, const ps_problem *);
    /* Adds what one realization of num_points takes (cost.h). */
    void (*count)(ps_nufft_counts *, const ps_nufft_choice *, ps_precision, double num_points);

    /* ---- errors (error.c) */
    double turning_roundings; /* between two transforms of one dimension */
    bool has_lattices;        /* plain sums of large sets in space may round in step */

    /* ---- sizes (layout.c, local.h) */
    /* Fills the rest of a layout, or leaves it without lanes. */
    void (*measure)(ps_nufft_layout *, const ps_problem *, const ps_device_limits *);
    size_t (*local_bytes)(const ps_nufft_layout *); /* the most that a launch takes */
    /* Where in a row the power of frequency k stands. */
    uint32_t (*slot)(const ps_nufft_layout *, const int32_t *k, unsigned dimension);
    double (*count_launches)(const ps_nufft_layout *, double num_points, double realizations);
    double programs[2];     /* of kernels, with one axis and with more */
    const char *program[2]; /* the same, those that have kernels/nufft/sort.cl; NULL: that alone */
    void (*describe)(const ps_nufft_layout *, ps_text *);

    const ps_nufft_launcher *launcher;
};

typedef struct ps_nufft_state {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_nufft_layout layout;
    const ps_nufft_launcher *launcher; /* that of the layout's variant */
    size_t batch;
    ps_nufft_plan plans[PS_NUFFT_MAX_AXES];
    ps_nufft_places places; /* of launchers that sort points */
    void *own;              /* what the launcher has besides */
    ps_buffer means, scales, power;
    double *means_of_parts;
    double sum_of_blocks; /* of the weights added so far */
} ps_nufft_state;

struct ps_nufft_launcher {
    bool has_transforms; /* of its axes: their plans have tables for them */
    bool sorts;          /* points by cells: places are created for it */
    size_t own_bytes;    /* of ps_nufft_state.own, which begins as zeros */
    pspec_status (*create)(ps_nufft_state *, ps_error *);
    void (*free)(void *own); /* also what was created in part */
    /* Brings the points of some realizations to the device, as many as the layout's parts at most.
     * NULL: they are sorted into places. */
    pspec_status (*upload)(ps_nufft_state *, const ps_batch *some, ps_error *);
    /* Makes the powers of what was uploaded. ps_nufft_state.means has what frequency 0 leaves in a
     * cell of each, which is taken off. */
    pspec_status (*run)(ps_nufft_state *, size_t num_realizations, const ps_nufft_target *,
                        ps_error *);
    /* What is left to do once all realizations of a batch were run; NULL: nothing. */
    pspec_status (*finish)(ps_nufft_state *, size_t num_realizations, const ps_nufft_target *,
                           ps_error *);
    /* One realization at a time, in chunks of layout.parts * layout.part_points points, the last of
     * which may have fewer: begin, then for each chunk, whose parts are in places, spread, which
     * adds it to those before, then run. NULL: as many realizations at a time as the layout has
     * parts. */
    pspec_status (*begin)(ps_nufft_state *, ps_error *);
    pspec_status (*spread)(ps_nufft_state *, size_t num_parts, ps_error *);
};

/* What kernels/nufft/grid/stockham.h is compiled with for work-groups of so many items. */
void ps_nufft_line_defines(ps_defines *defines, const ps_nufft_pass *sizes, size_t items);
/* Where the grid of GPUs leaves sums that its choice keeps: [set][k_0][k_1 ..], complex. */
const ps_buffer *ps_nufft_grid_sums(const ps_nufft_state *self);

/* In the order in which they are tried, ended by NULL. */
extern const ps_nufft_variant *const ps_nufft_variants[];

/* Sorted points are spread on rows of tiles of frequencies. */
extern const ps_nufft_variant ps_nufft_tiles;
/* One very large set at a time is spread on a grid, chunk by chunk. */
extern const ps_nufft_variant ps_nufft_large;
/* Each realization is done in one go by one work-group. */
extern const ps_nufft_variant ps_nufft_whole;
/* The same, on strips of a grid. */
extern const ps_nufft_variant ps_nufft_strips;
/* Many sets at a time, spread box by box and transformed axis by axis. */
extern const ps_nufft_variant ps_nufft_grid;
/* The same of one very large set at a time, chunk by chunk. */
extern const ps_nufft_variant ps_nufft_grid_chunks;

extern const ps_nufft_launcher ps_nufft_tiles_launcher, ps_nufft_large_launcher,
    ps_nufft_whole_launcher, ps_nufft_strips_launcher, ps_nufft_grid_launcher,
    ps_nufft_grid_chunks_launcher;

#endif
