/* What a scene can ask for: the kinds of results, and points of samplers. */
#include "scene/scene_file.h"

#define KIND(name) &ps_result_##name
#define NEXT(name) KIND(name),
#define NOTHING(name)
const ps_result_kind *const ps_scene_kinds[] = {PS_TAKERS(NEXT, NOTHING) KIND(points), NULL};
