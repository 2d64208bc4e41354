/* What a scene can ask for: the kinds of answers, and points of samplers. */
#include "scene/scene_file.h"

const ps_kind *const ps_scene_kinds[] = {
    PS_COMMANDS(PS_KIND_OF, PS_NO_COMMAND, PS_NO_COMMAND, PS_NO_COMMAND) PS_KIND_OF(points) NULL};
