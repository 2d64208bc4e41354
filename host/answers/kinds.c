#include "answers/kind.h"

const ps_kind *const ps_kinds[] = {
    PS_COMMANDS(PS_KIND_OF, PS_NO_COMMAND, PS_NO_COMMAND, PS_NO_COMMAND) NULL};
