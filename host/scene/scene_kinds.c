/* What a scene can ask for: the kinds of answers, and points of samplers. */
#include "scene/scene_file.h"

#define KIND(name) &ps_kind_##name
#define NEXT(name) KIND(name),
#define NOTHING(name)
const ps_kind *const ps_scene_kinds[] = {PS_VERBS(NEXT, NOTHING) KIND(points), NULL};
