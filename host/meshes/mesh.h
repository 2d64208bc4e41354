/* Triangle meshes of files, and the camera that looks at them (docs/user/occlusion.md#meshes). */
#ifndef PS_MESHES_MESH_H
#define PS_MESHES_MESH_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* Every ray is tried with every triangle. */
enum { PS_MESH_MOST_TRIANGLES = 4096, PS_MESH_MOST_VERTICES = 1 << 16 };

/* A pinhole camera. */
typedef struct ps_camera {
    double position[3], direction[3], up[3]; /* of any length */
    double width;                            /* of the picture, at distance 1 */
} ps_camera;

typedef struct ps_mesh {
    size_t num_triangles;
    double (*triangles)[3][3]; /* [num_triangles], their corners */
    bool has_camera;           /* the file has one */
    ps_camera camera;
} ps_mesh;

/* Reads Wavefront OBJ (v and f; faces become fans of triangles), and texts with a quadrilateral a
 * line. ps_mesh_free frees it, also after a failure. PSPEC_ERROR_INPUT names the line of what is no
 * mesh: triangles without an area, corners that are not there, more than there may be. */
pspec_status ps_mesh_read(ps_mesh *out, const char *path, ps_error *error) PS_MUST_CHECK;
void ps_mesh_free(ps_mesh *mesh);

/* The smallest box with all corners: its middle, and half of its diagonal. */
double ps_mesh_extent(const ps_mesh *mesh, double middle[3]);
/* A camera that sees the whole mesh, from above and from the right. */
ps_camera ps_camera_fit(const ps_mesh *mesh);
/* Unit vectors to the right, upwards and ahead; false: the camera looks along its up. */
bool ps_camera_axes(const ps_camera *camera, double axes[3][3]);

#endif
