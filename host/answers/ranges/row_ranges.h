/* Answers to ranges of the realizations of kinds whose jobs have rows, put together. */
#ifndef PS_ANSWERS_RANGES_ROW_RANGES_H
#define PS_ANSWERS_RANGES_ROW_RANGES_H

#include "answers/kind.h"

/* ps_command.merge: the command of the parts is answered once more, by their rows. What it reads
 * beside points has to be there; PSPEC_ERROR_TOLERANCE where the powers of all need another plan.
 */
pspec_status ps_row_ranges_merge(ps_answer *out, const ps_parts *parts,
                                 ps_error *error) PS_MUST_CHECK;

#endif
