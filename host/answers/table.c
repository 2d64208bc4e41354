#include "answers/kind.h"

#define KIND(name) &ps_result_##name,
#define NOTHING(name)
const ps_result_kind *const ps_result_kinds[] = {PS_TAKERS(KIND, NOTHING) NULL};
