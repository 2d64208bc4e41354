/* `plan run`. */
#ifndef PS_CLI_PLAN_SCENE_H
#define PS_CLI_PLAN_SCENE_H

#include "report/plan_table.h"

/* One block for every question of the scene request->files[0]. */
pspec_status ps_plan_scene(ps_planner *planner, const ps_request *arguments,
                           ps_error *error) PS_MUST_CHECK;

#endif
