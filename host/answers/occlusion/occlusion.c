/* Ambient occlusion of a mesh by point sets: how far it is from a reference. */
#include "answers/kept_rows.h"
#include "answers/ranges/row_ranges.h"
#include "answers/occlusion/occlusion.h"

#include "base/memory.h"
#include "jobs/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "math/pi.h"
#include "request/point_source.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void discard(void *computed) {
    ps_occlusion *const self = computed;
    if (self == NULL) {
        return;
    }
    for (size_t i = 0; self->results != NULL && i < self->num; i++) {
        ps_occlusion_result_free(&self->results[i]);
    }
    free(self->results);
    free(self->questions);
    free(self->samplers);
    ps_file_lists_free(self->files, self->num);
    ps_reference_free(&self->reference);
    ps_view_free(&self->view);
    ps_mesh_free(&self->mesh);
    if (self->owns_device) {
        ps_device_close(self->device);
    }
    free(self);
}

/* ---- question ------------------------------------------------------------------------------ */

static pspec_status check_image_out(const ps_request *request, ps_error *error) {
    const char *const path = request->image_out;
    const bool is_pfm = path != NULL && ps_text_ends_in(path, ".pfm");
    if (path != NULL && !is_pfm && !ps_text_ends_in(path, ".npy")) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--image-out: \"%s\" does not end in .pfm or .npy", path);
    }
    return !is_pfm || ps_request_num_questions(request) == 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--image-out: a .pfm has one image, and several samplers, sets or numbers "
                         "of points were asked for; .npy holds them all");
}

static pspec_status check_sampler(const ps_sampler_request *sampler, const char *name,
                                  ps_error *error) {
    if (!ps_sampler_is_on_sphere(sampler)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--sampler %s makes points of the torus; " PS_LIFT_KEY
                       "=sphere or " PS_LIFT_KEY "=hemisphere takes them to directions",
                       name);
    }
    return sampler->morph.kind == PS_MORPH_NONE
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "--sampler %s: directions of occlusion all count the same, and morphed "
                         "points are denser where a lobe is high",
                         name);
}

/* V of each question; it and its error as an array; the reference, and its array. */
static size_t count_images(const ps_occlusion *self) {
    return 3 * self->num + 2;
}

static ps_occlusion_question make_question(ps_occlusion *self, const ps_request *request,
                                           size_t i) {
    const ps_lift lift = request->reading.lift;
    ps_occlusion_question out = {
        .view = &self->view,
        .reference = &self->reference,
        .num_realizations = request->num_realizations,
        .sets = ps_limits_sets(&request->limits, request->accuracy.no_skip),
        .paths = self->files[i].paths,
        .num_paths = self->files[i].num,
        .point_options = ps_point_options_make(request),
        .is_folded = request->hemisphere || lift == PS_LIFT_TO_HEMISPHERE,
        .seed = request->seed,
        .memory_limit = request->limits.constraints.memory_limit,
        .num_images = count_images(self),
        .name = request->num_sources > 0 ? ps_request_name(request, i) : NULL,
        .watch = &self->watch,
        .checkpoint = request->limits.checkpoint};
    out.checkpoint.part += (unsigned)i + 1;
    out.point_options.domain = PS_DOMAIN_SPHERE;
    out.point_options.ignore_weights = true;
    return out;
}

static pspec_status make_questions(ps_occlusion *self, const ps_request *request, ps_error *error) {
    self->num = ps_request_num_questions(request);
    if (request->mesh == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "--mesh FILE is needed: the scene, in Wavefront OBJ or as quads");
    }
    PS_TRY(ps_sources_check(request, "no directions", error));
    PS_TRY(ps_point_options_check(request, error));
    PS_TRY(ps_option_pairs_check(request, PS_COMMAND_occlusion, error));
    PS_TRY(check_image_out(request, error));
    PS_TRY(PS_NEW(&self->questions, self->num, "questions", error));
    PS_TRY(PS_NEW(&self->samplers, self->num, "questions", error));
    PS_TRY(PS_NEW(&self->results, self->num, "answers", error));
    PS_TRY(ps_file_lists_make(&self->files, request, error));
    for (size_t i = 0; i < self->num; i++) {
        self->questions[i] = make_question(self, request, i);
        if (self->files[i].num == 0) {
            PS_TRY(ps_sampler_request_make(&self->samplers[i], request, i, error));
            PS_TRY(check_sampler(&self->samplers[i], ps_request_sampler(request, i), error));
            self->questions[i].sampler = &self->samplers[i];
        }
    }
    return PSPEC_OK;
}

/* The reference is the first. */
static size_t count_jobs(const ps_request *request) {
    return ps_request_num_questions(request) + 1;
}

static pspec_status check_question(const ps_request *request, ps_error *error) {
    ps_occlusion *self = NULL;
    PS_TRY(PS_NEW(&self, 1, "a question", error));
    const pspec_status status = make_questions(self, request, error);
    discard(self);
    return status;
}

/* As option --camera has it, else that of the file, else one that sees everything. */
static ps_camera choose_camera(const ps_request *request, const ps_mesh *mesh) {
    enum { TARGET = 3, ANGLE = 6, UP = 7 };
    const double usual_angle = 40;
    const double *const said = request->camera;
    const double angle = request->num_camera > ANGLE ? said[ANGLE] : usual_angle;
    ps_camera out = {.up = {0, 1, 0}, .width = 2 * tan(angle * PS_PI / 360)};
    if (request->num_camera == 0) {
        return mesh->has_camera ? mesh->camera : ps_camera_fit(mesh);
    }
    for (size_t i = 0; i < 3; i++) {
        out.position[i] = said[i];
        out.direction[i] = said[TARGET + i] - said[i];
        out.up[i] = request->num_camera > UP ? said[UP + i] : out.up[i];
    }
    return out;
}

static pspec_status open_device(ps_occlusion *self, const ps_request *request, ps_device *open,
                                ps_error *error) {
    return ps_limits_open_device(&request->limits, open, request->limits.device == NULL,
                                 &self->device, &self->owns_device, error);
}

/* Before there is a view. Sets of files are looked at as they are read. */
static ps_occlusion_size find_size(ps_occlusion *self, const ps_request *request) {
    ps_occlusion_size out = {&self->view, ps_reference_points(request->num_reference),
                             count_images(self), self->device};
    self->view = (ps_view){.width = request->image[0],
                           .height = request->image[1],
                           .num_triangles = self->mesh.num_triangles};
    for (size_t i = 0; i < self->num; i++) {
        const ps_sampler_request *const sampler = self->questions[i].sampler;
        const size_t num = sampler != NULL ? ps_sampler_most_points(sampler) : 0;
        out.num_points = num > out.num_points ? num : out.num_points;
    }
    return out;
}

/* ---- plan ---------------------------------------------------------------------------------- */

/* Of a triangle that is tried by a ray, on one core (AVX-512, PoCL 3.1: bench_occlusion), and of a
 * primary ray. */
static const double try_seconds = 1.7e-10;
static const double primary_seconds = 1e-8;

static pspec_status add_plan(ps_planner *planner, const ps_occlusion *self,
                             const ps_occlusion_size *size, const ps_request *request,
                             ps_error *error) {
    ps_phases phases = ps_plan_table_begin_phases(planner);
    const double pixels = (double)request->image[0] * (double)request->image[1];
    const double triangles = (double)self->mesh.num_triangles;
    double rays = (double)request->num_reference;
    ps_phases_start(&phases, NULL, NULL);
    for (size_t i = 0; i < self->num; i++) {
        const ps_occlusion_question *const question = &self->questions[i];
        if (question->sampler != NULL) {
            const double num = (double)question->num_realizations;
            ps_phases_sample(&phases, question->sampler, num, &question->sets);
            rays += num * (double)question->sampler->num_points;
        } else {
            ps_phases_read(&phases, question->paths, question->num_paths, &question->point_options,
                           3);
        }
    }
    ps_phases_add(&phases, "rays", pixels * triangles * (rays * try_seconds + primary_seconds));
    ps_phases_say(&phases, "rays", "%.4g rays from each of %.0f pixels, %.0f triangles", rays,
                  pixels, triangles);
    ps_plan_table_add_picture(&phases, request);
    const ps_only_way way = {self->device, PS_RAYS_ENGINE, (double)ps_occlusion_bytes(size),
                             "every triangle is tried by every ray"};
    return ps_plan_table_add_only(planner, &phases, &way, error);
}

static pspec_status plan(ps_planner *planner, const ps_request *request, ps_error *error) {
    ps_occlusion *self = NULL;
    pspec_status status = PSPEC_OK;
    PS_TRY(PS_NEW(&self, 1, "a plan", error));
    PS_TRY_OUT(status, make_questions(self, request, error));
    PS_TRY_OUT(status, ps_mesh_read(&self->mesh, request->mesh, error));
    PS_TRY_OUT(status, open_device(self, request, planner->device, error));
    const ps_occlusion_size size = find_size(self, request);
    PS_TRY_OUT(status,
               ps_occlusion_check_memory(&size, request->limits.constraints.memory_limit, error));
    status = add_plan(planner, self, &size, request, error);
out:
    discard(self);
    return status;
}

/* ---- work ---------------------------------------------------------------------------------- */

static pspec_status look(ps_occlusion *self, const ps_request *request, ps_error *error) {
    ps_view_options options = {
        .width = request->image[0], .height = request->image[1], .radius = request->radius};
    PS_TRY(ps_mesh_read(&self->mesh, request->mesh, error));
    const ps_occlusion_size size = find_size(self, request);
    PS_TRY(ps_occlusion_check_memory(&size, request->limits.constraints.memory_limit, error));
    options.camera = choose_camera(request, &self->mesh);
    PS_TRY(ps_view_make(&self->view, &self->mesh, &options, &self->watch, error));
    return ps_reference_make(&self->reference, &self->view, request->num_reference, request->seed,
                             self->device, &request->limits.checkpoint, &self->watch, error);
}

static pspec_status compute(void **out, const ps_request *request, const ps_answer_hooks *hooks,
                            ps_error *error) {
    PS_TRY(ps_allocate(out, 1, sizeof(ps_occlusion), "an answer", error));
    ps_occlusion *const self = *out;
    ps_device *open = NULL;
    PS_TRY(make_questions(self, request, error));
    ps_answer_begin_job(hooks, &self->watch, &open);
    PS_TRY(open_device(self, request, open, error));
    PS_TRY(look(self, request, error));
    for (size_t i = 0; i < self->num; i++) {
        self->questions[i].device = self->device;
        PS_TRY(ps_occlusion_run(&self->results[i], &self->questions[i], error));
    }
    ps_answer_tell_profile(hooks, self->device);
    return PSPEC_OK;
}

/* ---- what tables mean ------------------------------------------------------------------------ */

static const char *const summary[] = {"points",    "realizations", "mse",
                                      "mse_error", "visibility",   NULL};
static const ps_picture_kind pictures[] = {
    {.suffix = "-picture",
     .make = ps_occlusion_figure,
     .dealing = PS_OF_EACH,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_PICTURES,
     .arrays = {{"image", PS_FRAME_PIXELS}, {"error", PS_FRAME_PIXELS}}},
    {.suffix = "-mse",
     .what = "error of ambient occlusion",
     .make = ps_lines_figure,
     .dealing = PS_OF_COUNTS,
     .by = PS_BY_SCENE | PS_BY_COMMAND,
     .needs = PS_NEEDS_COUNTS,
     .x = "points",
     .is_of_entries = true,
     .lines = {{.y = "mse", .error = "mse_error", .look = PS_LOOK_LINE}},
     .x_label = "points N",
     .y_label = "mean square error over pixels",
     .is_log_x = true,
     .is_log_y = true},
    {.make = NULL}};

static const ps_field_row *const fields[] = {ps_fields_asked,
                                             ps_fields_points,
                                             ps_fields_occlusion,
                                             ps_fields_ranges,
                                             ps_fields_kept_rows,
                                             ps_fields_computed,
                                             NULL};

static const ps_compared_field compared[] = {{"mse", "mse_error", false, ps_compared_rule_bound},
                                             {.value = NULL}};

const ps_kind ps_kind_occlusion = {
    .name = "occlusion",
    .purpose = "ambient occlusion of a mesh by directions of point sets, and its error",
    .usage = "occlusion --mesh FILE [options] --sampler NAME | occlusion --mesh FILE [options] "
             "FILE...",
    .description =
        "Renders a mesh by ambient occlusion: from what every pixel of a camera sees of it, rays "
        "go in the directions of a set of the sphere or the hemisphere, which every pixel turns "
        "at random, and the share of the hemisphere about the normal that sees no triangle is "
        "(2/N) rays above the horizon that meet none, of the hemisphere (1/N). Prints the mean "
        "square error over pixels, against a reference of many rays whose own variance is "
        "subtracted.",
    .examples =
        {"printf 'v 0 0 0\\nv 0 0 1\\nv 1 0 1\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3 4\\nf 1 5 4\\n' "
         ">corner.obj; pointspec occlusion --mesh corner.obj --image 16x16 --sampler "
         "white-sphere -n 16..64",
         "printf 'v 0 0 0\\nv 0 0 1\\nv 1 0 1\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3 4\\nf 1 5 4\\n' "
         ">corner.obj; pointspec occlusion --mesh corner.obj --image 16x16 --sampler "
         "white-hemisphere -n 64 --image-out corner.pfm"},
    .takes = PS_COMMAND_BIT(occlusion),
    .samples = PS_DOMAIN_SPHERE,
    .counted = "realizations",
    .may_lack_device = true,
    .has_images = true,
    .has_arrays = true,
    .check_question = check_question,
    .plan = plan,
    .count_jobs = count_jobs,
    .look_at_shares = ps_answer_look_at_rows,
    .merge = ps_row_ranges_merge,
    .compute = compute,
    .tabulate = ps_occlusion_tabulate,
    .discard = discard,
    .fields = fields,
    .summary = summary,
    .pictures = pictures,
    .has_few_rows = true,
    .compared = compared,
};
