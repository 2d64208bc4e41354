/* Which kinds of integrands read a file: those whose first parameter is its name. */
#ifndef TESTS_TRIALS_FILE_KINDS_H
#define TESTS_TRIALS_FILE_KINDS_H

#include "integrands/integrand.h"

#include <string.h>

static inline bool is_of_file(const ps_integrand_kind *kind) {
    const char *const first = kind->parameters[0].key;
    return first != NULL && strcmp(first, "file") == 0;
}

#endif
