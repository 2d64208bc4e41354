/* What a camera sees of a mesh: the place of every pixel, from which rays of occlusion go, in the
 * units of kernels/rays: the middle of the mesh is 0, and half of the diagonal of its box 1. */
#ifndef PS_JOBS_OCCLUSION_VIEW_H
#define PS_JOBS_OCCLUSION_VIEW_H

#include "base/watch.h"
#include "meshes/mesh.h"

#include <stdint.h>

enum { PS_VIEW_MOST_SIDE = 4096, PS_PLACE_NUMBERS = 6, PS_CORNER_NUMBERS = 9 };

typedef struct ps_view_options {
    ps_camera camera;
    size_t width, height; /* in pixels, which are squares */
    double radius;        /* beyond which nothing is hidden, in units of the mesh; 0: nowhere */
} ps_view_options;

typedef struct ps_view {
    size_t width, height;
    bool is_bounded;
    float radius;
    size_t num_triangles;
    float *corners;    /* [num_triangles][9] */
    size_t num_pixels; /* that see the mesh */
    uint32_t *pixels;  /* [num_pixels]: y * width + x, from the top left */
    /* [num_pixels][6]: the origin, a little above the mesh, and the normal on the camera's side */
    float *places;
} ps_view;

/* ps_view_free frees it, also after a failure. A camera that sees nothing of the mesh is
 * PSPEC_ERROR_INVALID_ARGUMENT. */
pspec_status ps_view_make(ps_view *out, const ps_mesh *mesh, const ps_view_options *options,
                          const ps_watch *watch, ps_error *error) PS_MUST_CHECK;
void ps_view_free(ps_view *view);
/* What it takes while it is made. */
uint64_t ps_view_bytes(size_t num_pixels, size_t num_triangles);

#endif
