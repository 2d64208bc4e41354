/* The table of occlusion: a row for every question; images as arrays. */
#include "answers/occlusion/occlusion.h"

#include "answers/spectra/spectra.h"
#include "answers/spectra/spectrum_header.h"

/* ---- arrays -------------------------------------------------------------------------------- */

static bool wants_arrays(const ps_request *request) {
    return request->wants_array || request->wants_picture || request->wants_state ||
           request->image_out != NULL || request->plot != NULL;
}

/* Values of pixels that see the mesh, in the images of `num` of them; others have `beyond`. */
static void fill_image(double *out, const ps_view *view, const double *values,
                       const double *subtracted, double beyond) {
    for (size_t i = 0; i < view->width * view->height; i++) {
        out[i] = beyond;
    }
    for (size_t i = 0; i < view->num_pixels; i++) {
        out[view->pixels[i]] = values[i] - (subtracted != NULL ? subtracted[i] : 0);
    }
}

/* One image of each question. */
static pspec_status add_images(ps_table *table, const ps_occlusion *self, const char *name,
                               const double *subtracted, double beyond, ps_error *error) {
    const size_t shape[] = {self->num, self->view.height, self->view.width};
    const size_t pixels = self->view.height * self->view.width;
    const bool is_one = self->num == 1;
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, is_one ? 2 : 3, shape + is_one, false, error));
    for (size_t i = 0; i < self->num; i++) {
        fill_image(array.data + i * pixels, &self->view, self->results[i].seen, subtracted, beyond);
    }
    return ps_table_add_array(table, name, false, &array, error);
}

static pspec_status add_arrays(ps_table *table, const ps_occlusion *self, ps_error *error) {
    const size_t shape[] = {self->view.height, self->view.width};
    ps_npy_array array;
    PS_TRY(add_images(table, self, "image", NULL, 1, error));
    PS_TRY(add_images(table, self, "error", self->reference.seen, 0, error));
    PS_TRY(ps_npy_make_array(&array, 2, shape, false, error));
    fill_image(array.data, &self->view, self->reference.seen, NULL, 1);
    return ps_table_add_array(table, "reference", false, &array, error);
}

/* ---- the table: a row for every question ---------------------------------------------------- */

static const char *const columns[] = {"mse", "mse_error", "visibility"};
enum { NUM_COLUMNS = sizeof columns / sizeof columns[0] };

static pspec_status begin_header(ps_table *table, const ps_occlusion *self,
                                 const ps_request *request, ps_error *error) {
    const ps_device_limits *const limits = ps_device_get_limits(self->device);
    const ps_meta entries[] = {
        {"seed", PS_INTEGER(request->seed)},
        {"mesh", PS_TEXT(request->mesh)},
        {"triangles", PS_INTEGER(self->mesh.num_triangles)},
        {"width", PS_INTEGER(self->view.width)},
        {"height", PS_INTEGER(self->view.height)},
        {"pixels", PS_INTEGER(self->view.num_pixels)},
        {"radius", request->radius > 0 ? PS_NUMBER(request->radius) : PS_TEXT("infinite")},
        {"reference_rays", PS_INTEGER(self->reference.num_rays)},
        {"reference_visibility", PS_NUMBER(self->reference.mean)},
        {"reference_variance", PS_NUMBER(self->reference.variance)},
        {"device", PS_TEXT(limits != NULL ? limits->name : "none")},
        {"engine", PS_TEXT(limits != NULL ? PS_RAYS_ENGINE : "host")},
        {"precision", PS_TEXT("single")},
        {"skipped", PS_TEXT("none")},
    };
    PS_TRY(ps_lead_add_origin(table, request->command_line, error));
    return ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error);
}

static pspec_status add_one(ps_table *table, const ps_request *request, const ps_occlusion *self,
                            size_t i, ps_error *error) {
    const ps_occlusion_question *const question = &self->questions[i];
    const ps_occlusion_result *const result = &self->results[i];
    const ps_points_range range = {result->mean_points, result->smallest_points,
                                   result->largest_points};
    const ps_lead lead = ps_lead_make(request, i);
    const ps_cell cells[NUM_COLUMNS] = {PS_NUMBER(result->squared.mean),
                                        ps_number_or_missing(result->squared.standard_error),
                                        PS_NUMBER(result->mean)};
    const ps_meta entries[] = {{"realizations", PS_INTEGER(result->num_realizations)},
                               {"mse", cells[0]},
                               {"mse_error", cells[1]},
                               {"visibility", cells[2]}};
    PS_TRY(ps_lead_add_source(table, request, i, error));
    PS_TRY(ps_header_add_points(table, &range, range.smallest != range.largest, error));
    if (question->sampler == NULL) {
        PS_TRY(ps_header_add_files(table, question->paths, question->num_paths,
                                   result->num_realizations, ", one average", error));
        PS_TRY(ps_header_add_lift(table, &question->point_options, error));
    }
    PS_TRY(ps_table_add_metas(table, entries, sizeof entries / sizeof entries[0], error));
    return ps_lead_add_row(table, &lead, cells, NUM_COLUMNS, error);
}

pspec_status ps_occlusion_tabulate(ps_answer *out, const void *computed, const ps_request *request,
                                   ps_error *error) {
    const ps_occlusion *const self = computed;
    const ps_lead first = ps_lead_make(request, 0);
    PS_TRY(ps_lead_create_table(&out->table, "occlusion", &first, columns, NUM_COLUMNS, error));
    PS_TRY(begin_header(out->table, self, request, error));
    for (size_t i = 0; i < self->num; i++) {
        PS_TRY(add_one(out->table, request, self, i, error));
    }
    return wants_arrays(request) ? add_arrays(out->table, self, error) : PSPEC_OK;
}

/* ---- what it declares ----------------------------------------------------------------------- */

const ps_field_row ps_fields_occlusion[] = {
    {"mesh", "", PS_ENTRY, 0, "", "the file of the scene"},
    {"triangles", "", PS_ENTRY, 0, "", "how many it has"},
    {"width", "pixels", PS_ENTRY, 0, "", "of the image"},
    {"height", "pixels", PS_ENTRY, 0, "", "of the image"},
    {"pixels", "", PS_ENTRY, 0, "", "how many of them see the mesh, over which means are taken"},
    {"radius", "", PS_ENTRY, 0, "", "beyond which nothing hides, or infinite"},
    {"reference_rays", "", PS_ENTRY, 0, "", "rays of a pixel of the reference"},
    {"reference_visibility", "", PS_ENTRY, 0, "", "visibility of the reference, mean over pixels"},
    {"reference_variance", "", PS_ENTRY, 0, "",
     "mean square of its standard errors, which was subtracted from mse"},
    {"mse", "", PS_ENTRIES, 0, "", "as the column"},
    {"mse_error", "", PS_ENTRIES, 0, "", "as the column"},
    {"visibility", "", PS_ENTRIES, 0, "", "as the column"},
    {"mse", "", PS_COLUMN, 0, "",
     "mean square error over pixels and realizations, without what the reference has of it"},
    {"mse_error", "", PS_COLUMN, 0, "",
     "its standard error, over realizations, of one over pixels, and what is not known of the "
     "reference's variance"},
    {"visibility", "", PS_COLUMN, 0, "",
     "share of the hemisphere that sees nothing, mean over pixels and realizations"},
    {"image", "", PS_ARRAY, 0, "NPZ, --image-out, arrays of a scene",
     "visibility of every pixel, float64 [height][width], of several questions one image each; 1 "
     "where nothing of the mesh is seen"},
    {"error", "", PS_ARRAY, 0, "NPZ, arrays of a scene", "image minus reference"},
    {"reference", "", PS_ARRAY, 0, "NPZ, arrays of a scene", "the same of the reference"},
    {.name = NULL}};
