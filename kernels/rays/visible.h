/* What host and device know alike of rays/visible.cl. */
#ifndef PS_RAYS_VISIBLE_H
#define PS_RAYS_VISIBLE_H

#include "shared/fixed.h"

typedef struct rays_scene {
    ps_u64 first, num_pixels; /* of the launch */
    ps_u64 capacity;          /* of points: whole pieces */
    ps_u32 num_triangles;
    float radius;
} rays_scene;

SAME_SIZE(rays_scene, 32);

#endif
