#include "meshes/mesh.h"

#include "meshes/vectors.h"

#include <stdlib.h>

void ps_mesh_free(ps_mesh *mesh) {
    free(mesh->triangles);
    *mesh = (ps_mesh){0};
}

double ps_mesh_extent(const ps_mesh *mesh, double middle[3]) {
    const double *const corners = &mesh->triangles[0][0][0];
    double half[3];
    for (unsigned axis = 0; axis < 3; axis++) {
        double low = corners[axis];
        double high = low;
        for (size_t i = 1; i < 3 * mesh->num_triangles; i++) {
            low = fmin(low, corners[3 * i + axis]);
            high = fmax(high, corners[3 * i + axis]);
        }
        middle[axis] = (low + high) / 2;
        half[axis] = (high - low) / 2;
    }
    return ps_vector_length(half);
}

ps_camera ps_camera_fit(const ps_mesh *mesh) {
    const double half_angle = 0.35; /* 20 degrees to each side, as people photograph things */
    ps_camera out = {.direction = {-0.6, -0.5, -1}, .up = {0, 1, 0}, .width = 2 * tan(half_angle)};
    const double distance = ps_mesh_extent(mesh, out.position) / sin(half_angle);
    const double length = ps_vector_length(out.direction);
    for (unsigned i = 0; i < 3; i++) {
        out.position[i] -= distance * out.direction[i] / length;
    }
    return out;
}

bool ps_camera_axes(const ps_camera *camera, double axes[3][3]) {
    const double least = 1e-9; /* of the sine of the angle between both: rounding */
    for (unsigned i = 0; i < 3; i++) {
        axes[2][i] = camera->direction[i] / ps_vector_length(camera->direction);
    }
    ps_vector_cross(axes[0], axes[2], camera->up);
    const double length = ps_vector_length(axes[0]);
    if (!(length > least * ps_vector_length(camera->up))) {
        return false;
    }
    ps_vector_scale(axes[0], 1 / length);
    ps_vector_cross(axes[1], axes[0], axes[2]);
    return true;
}
