/* The variants of torus_nufft, and the state that they have in common. Private to torus_nufft.c,
 * which is the engine, and variants.c, which has what differs by the way of a choice.
 */
#ifndef PS_ENGINES_TORUS_NUFFT_VARIANTS_H
#define PS_ENGINES_TORUS_NUFFT_VARIANTS_H

#include "engines/torus/nufft/grid.h"
#include "engines/torus/nufft/layout.h"
#include "engines/torus/nufft/places.h"
#include "engines/torus/nufft/strips.h"
#include "engines/torus/nufft/tiles.h"
#include "engines/torus/nufft/whole.h"

typedef struct ps_nufft_state ps_nufft_state;

/* What differs between the ways of a choice. */
typedef struct ps_nufft_variant {
    double (*count_launches)(const ps_nufft_layout *, double num_points, double realizations);
    double kernels[2];   /* programs, with one axis and with more */
    bool has_transforms; /* of its axes: their plans have tables for them */
    bool takes_one; /* realization at a time, in blocks too; else as many as the layout's parts */
    pspec_status (*create)(ps_nufft_state *, ps_error *);
    /* Makes the powers of some realizations, no more than it takes at a time. */
    pspec_status (*run)(ps_nufft_state *, const ps_batch *some, const ps_nufft_target *,
                        ps_error *);
    /* What is left to do once all realizations of a batch were run; NULL: nothing. */
    pspec_status (*finish)(ps_nufft_state *, size_t num_realizations, const ps_nufft_target *,
                           ps_error *);
    void (*describe)(const ps_nufft_state *, ps_text *);
    void (*free)(ps_nufft_state *); /* also what was created in part, or not at all */
} ps_nufft_variant;

extern const ps_nufft_variant ps_nufft_variants[PS_NUFFT_NUM_WAYS];

struct ps_nufft_state {
    ps_device *device;
    ps_problem problem;
    ps_precision precision;
    ps_nufft_layout layout;
    const ps_nufft_variant *variant; /* of the layout's way */
    size_t batch;
    ps_nufft_plan plans[PS_NUFFT_MAX_AXES];
    ps_nufft_places places;
    ps_nufft_grid large; /* one of these, by the way of the choice */
    ps_nufft_whole whole;
    ps_nufft_strips strips;
    ps_nufft_tiles tiles;
    ps_buffer means, scales, power;
    double *means_of_parts;
    double large_sum; /* of the weights added so far */
};

/* A large set in blocks: begin, add any number of times, end. */
void ps_nufft_large_begin(ps_nufft_state *self);
pspec_status ps_nufft_large_add(ps_nufft_state *self, const ps_batch *block,
                                ps_error *error) PS_MUST_CHECK;
pspec_status ps_nufft_large_end(ps_nufft_state *self, const ps_nufft_target *target,
                                ps_error *error) PS_MUST_CHECK;

#endif
