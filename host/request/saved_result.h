/* Tables and spectra that the program or the library saved, given where points are wanted. */
#ifndef PS_REQUEST_SAVED_RESULT_H
#define PS_REQUEST_SAVED_RESULT_H

#include "base/status.h"

/* PSPEC_ERROR_INPUT where the file is a saved result, with what it is of, and `why`, "and variances
 * are ..", in the sentence; command: that to use instead. Standard input, pipes and what is not
 * there pass: who reads them says what is wrong. */
pspec_status ps_saved_result_refuse(const char *path, const char *why, const char *command,
                                    ps_error *error) PS_MUST_CHECK;

#endif
