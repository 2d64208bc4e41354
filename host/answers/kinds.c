#include "answers/kind.h"

#define KIND(name) &ps_kind_##name,
#define NOTHING(name)
const ps_kind *const ps_kinds[] = {PS_VERBS(KIND, NOTHING) NULL};
