/* Frequency vectors, weights, images and meshes. The first byte: does the rest come through a pipe?
 */
#include "fuzz.h"

#include "images/image.h"
#include "meshes/mesh.h"
#include "points/lists/frequency_list.h"
#include "points/lists/weight_list.h"

#include <math.h>
#include <stdlib.h>

static fuzz_file make_input(fuzz_bytes input) {
    const bool is_pipe = (fuzz_take(&input) & 1) != 0;
    return is_pipe ? fuzz_pipe_make(input) : fuzz_file_make(input);
}

static void check_frequencies(const int *vectors, size_t num_vectors, unsigned dimension) {
    enum { LARGEST = 1 << 30, MOST_DIMENSIONS = 6 };
    if (num_vectors == 0 || dimension < 1 || dimension > MOST_DIMENSIONS) {
        fuzz_fail("%zu vectors of dimension %u", num_vectors, dimension);
    }
    for (size_t i = 0; i < num_vectors * dimension; i++) {
        if (vectors[i] < -LARGEST || vectors[i] > LARGEST) {
            fuzz_fail("frequency %d", vectors[i]);
        }
    }
}

void fuzz_frequencies(const char *argument, fuzz_bytes input) {
    (void)argument;
    fuzz_file file = make_input(input);
    int *vectors = NULL;
    size_t num_vectors = 0;
    unsigned dimension = 0;
    ps_error error = {0};
    const pspec_status status =
        ps_read_frequencies(file.path, 0, &vectors, &num_vectors, &dimension, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status == PSPEC_OK) {
        check_frequencies(vectors, num_vectors, dimension);
    }
    free(vectors);
    fuzz_file_close(&file);
}

void fuzz_weights(const char *argument, fuzz_bytes input) {
    (void)argument;
    fuzz_file file = make_input(input);
    double *weights = NULL;
    size_t num_weights = 0;
    ps_error error = {0};
    const pspec_status status =
        ps_read_weights(file.path, UINT32_MAX, &weights, &num_weights, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status == PSPEC_OK && num_weights == 0) {
        fuzz_fail("no weights, and no error");
    }
    for (size_t i = 0; status == PSPEC_OK && i < num_weights; i++) {
        if (!isfinite(weights[i])) {
            fuzz_fail("weight %g", weights[i]);
        }
    }
    free(weights);
    fuzz_file_close(&file);
}

static pspec_status begin_image(void *payload, const ps_image *image, ps_error *error) {
    (void)payload;
    (void)error;
    if (image->width == 0 || image->height == 0 ||
        image->width > PS_IMAGE_MOST_PIXELS / image->height) {
        fuzz_fail("an image of %zu x %zu pixels", image->width, image->height);
    }
    return PSPEC_OK;
}

/* Reads all of the numbers, for the sanitizers. */
static pspec_status take_row(void *payload, const ps_image *image, size_t y, const float *row,
                             ps_error *error) {
    double *const sum = payload;
    (void)error;
    if (y >= image->height) {
        fuzz_fail("row %zu of %zu", y, image->height);
    }
    for (size_t x = 0; x < image->width; x++) {
        *sum += ps_image_luminance(row + x * image->num_channels, image->num_channels);
    }
    return PSPEC_OK;
}

void fuzz_image(const char *argument, fuzz_bytes input) {
    (void)argument;
    fuzz_file file = make_input(input);
    double sum = 0;
    ps_error error = {0};
    fuzz_check_error(
        ps_image_read(file.path, &(ps_image_taker){&sum, begin_image, take_row}, &error), &error,
        FUZZ_PRINTABLE);
    fuzz_file_close(&file);
}

static void check_mesh(const ps_mesh *mesh) {
    const double *const numbers = &mesh->triangles[0][0][0];
    double middle[3];
    double axes[3][3];
    const ps_camera fit = ps_camera_fit(mesh);
    if (mesh->num_triangles > PS_MESH_MOST_TRIANGLES || !(ps_mesh_extent(mesh, middle) > 0)) {
        fuzz_fail("%zu triangles, and no extent", mesh->num_triangles);
    }
    for (size_t i = 0; i < 9 * mesh->num_triangles; i++) {
        if (!isfinite(numbers[i])) {
            fuzz_fail("a corner at %g", numbers[i]);
        }
    }
    if (!ps_camera_axes(&fit, axes) ||
        (mesh->has_camera && !(ps_camera_axes(&mesh->camera, axes) && mesh->camera.width > 0))) {
        fuzz_fail("a camera without axes");
    }
}

void fuzz_mesh(const char *argument, fuzz_bytes input) {
    (void)argument;
    fuzz_file file = make_input(input);
    ps_mesh mesh;
    ps_error error = {0};
    const pspec_status status = ps_mesh_read(&mesh, file.path, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status == PSPEC_OK && mesh.num_triangles == 0) {
        fuzz_fail("a mesh without triangles");
    }
    if (status == PSPEC_OK) {
        check_mesh(&mesh);
    }
    ps_mesh_free(&mesh);
    fuzz_file_close(&file);
}
