/* May the realizations of a job be shared in parts (parts.h), how many are there, and in how many
 * parts?
 *
 * A reason why not is left as the end of a sentence in *why, whose message is empty where there is
 * none.
 */
#ifndef PS_ANSWERS_PARTS_SHARING_H
#define PS_ANSWERS_PARTS_SHARING_H

#include "answers/kind.h"

/* What the request says: its kind, options, inputs. */
void ps_sharing_look(ps_error *why, const ps_command *command, const ps_request *request);
/* What planning says of the job, which has so many realizations, or its range. */
void ps_sharing_look_at_job(ps_error *why, const ps_outlook *outlook, uint64_t num_realizations);

/* A job that was begun keeps its parts: how many, by its checkpoints; 0: it begins now. One that a
 * process has begun alone is not shared. */
pspec_status ps_sharing_find_begun(uint64_t *found, ps_error *why, const ps_request *request,
                                   ps_error *error) PS_MUST_CHECK;
/* Those that were found, or as many as wanted, if there are as many blocks. Too many of them are of
 * another job: PSPEC_ERROR_INPUT. */
pspec_status ps_sharing_choose_parts(uint64_t *num_parts, uint64_t found, uint64_t wanted,
                                     uint64_t num_realizations, ps_error *error) PS_MUST_CHECK;

#endif
