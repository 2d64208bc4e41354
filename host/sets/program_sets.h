/* Programs that print the sets of a source (exec:COMMAND): whether they print the same again, and
 * how many sets are taken of them. */
#ifndef PS_SETS_PROGRAM_SETS_H
#define PS_SETS_PROGRAM_SETS_H

#include "points/points.h"

/* {0}: the paths are no programs. */
typedef struct ps_program_sets {
    bool are_programs; /* the paths, all of them */
    bool repeats;      /* they print the same when they are run again */
    uint64_t num_sets; /* to take, of all together */
    bool has_runs;     /* of one set each */
    const char *path;  /* the first one */
} ps_program_sets;

ps_program_sets ps_program_sets_make(const char *const *paths, size_t num_paths,
                                     const ps_point_options *options);

/* Runs the first one twice, and the second one, and appends what that has shown. Where these print
 * the same, as those of a deterministic sampler do, there is one of them. What may not be run is
 * left to the reader. */
pspec_status ps_program_sets_try(ps_program_sets *self, const char *const *paths, size_t *num_paths,
                                 const ps_point_options *options, ps_text *said,
                                 ps_error *error) PS_MUST_CHECK;

/* Are these as many as are taken? Programs may print sets without an end. */
bool ps_program_sets_are_all(const ps_program_sets *self, uint64_t num_taken);
/* Refuses set number `of_run`, from 1 on, of one run where there is a run for each. */
pspec_status ps_program_sets_check(const ps_program_sets *self, uint64_t of_run, const char *path,
                                   ps_error *error) PS_MUST_CHECK;
/* A set is complete: closes the reader of a run that has nothing more to give. One of one set is
 * looked at for another at once, for nobody may ask for that. */
pspec_status ps_program_sets_end_run(const ps_program_sets *self, uint64_t num_taken,
                                     const char *path, ps_point_reader **reader,
                                     ps_error *error) PS_MUST_CHECK;
/* All runs are over: refuses fewer sets than were asked for. */
pspec_status ps_program_sets_end(const ps_program_sets *self, uint64_t num_taken,
                                 ps_error *error) PS_MUST_CHECK;

#endif
