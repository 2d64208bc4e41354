#include "jobs/occlusion/rays.h"

#include "base/memory.h"
#include "base/round.h"
#include "base/workers.h"
#include "engines/engine.h"
#include "math/random/rotation.h"
#include "rays/visible.h"

#include <stdlib.h>
#include <string.h>

struct ps_rays {
    const ps_view *view;
    ps_device *device;      /* NULL: the host does it */
    unsigned lanes;         /* 1 on the host */
    size_t vectors;         /* of a piece */
    size_t capacity;        /* points, whole pieces */
    size_t batch;           /* pixels that there is room for, */
    size_t pixels_of_batch; /* and that are done at a time */
    float *turns;           /* [batch][9] */
    float *points;          /* [3][capacity] */
    uint32_t *counts;       /* [pieces][batch] */
    struct {
        ps_buffer corners, places, turns, points, counts;
    } on_device;
};

/* ---- create --------------------------------------------------------------------------------- */

/* Triangles tried by rays between two calls of the watch: a tenth of a second of two cores with
 * AVX-512, and of a GPU. */
#define CPU_TRIES ((size_t)1 << 29)
#define GPU_TRIES ((size_t)1 << 34)

/* Vectors of a piece: on CPUs a piece stays in the nearest cache, and what is made of a triangle is
 * little beside it; on GPUs it stays in registers. */
enum { CPU_VECTORS = 16, GPU_VECTORS = 4 };

static void choose_sizes(ps_rays *self, size_t most_points) {
    const ps_device_limits *const limits = ps_device_get_limits(self->device);
    const bool is_gpu = limits != NULL && limits->has_dedicated_local_memory;
    const size_t tries = most_points * self->view->num_triangles;
    const size_t fit = (is_gpu ? GPU_TRIES : CPU_TRIES) / tries + 1;
    self->lanes = limits != NULL ? ps_engine_lanes(limits, PS_SINGLE) : 1;
    const size_t all = ps_divide_up(most_points, self->lanes);
    self->vectors = is_gpu ? GPU_VECTORS : CPU_VECTORS;
    self->vectors = all < self->vectors ? all : self->vectors;
    self->capacity = ps_round_up(most_points, self->lanes * self->vectors);
    self->batch = fit < self->view->num_pixels ? fit : self->view->num_pixels;
    self->pixels_of_batch = self->batch;
}

static size_t num_pieces(const ps_rays *self, size_t num_points) {
    return ps_divide_up(num_points, self->lanes * self->vectors);
}

uint64_t ps_rays_bytes(const ps_view *view, size_t most_points, ps_device *device) {
    ps_rays self = {.view = view, .device = device};
    choose_sizes(&self, most_points);
    const uint64_t pieces = device != NULL ? num_pieces(&self, self.capacity) : 1;
    const uint64_t both = self.batch * PS_TURN_NUMBERS * sizeof(float) +
                          3 * self.capacity * sizeof(float) +
                          pieces * self.batch * sizeof(uint32_t);
    const uint64_t scene = view->num_triangles * PS_CORNER_NUMBERS * sizeof(float) +
                           view->num_pixels * PS_PLACE_NUMBERS * sizeof(float);
    return device != NULL ? 2 * both + scene : both;
}

static pspec_status create_buffers(ps_rays *self, ps_error *error) {
    const ps_view *const view = self->view;
    const ps_wanted_buffer wanted[] = {
        {&self->on_device.turns, self->batch * PS_TURN_NUMBERS * sizeof(float), "turns of pixels"},
        {&self->on_device.points, 3 * self->capacity * sizeof(float), "points"},
        {&self->on_device.counts, num_pieces(self, self->capacity) * self->batch * sizeof(uint32_t),
         "counts of rays"}};
    PS_TRY(ps_buffer_upload(self->device, &self->on_device.corners, view->corners,
                            view->num_triangles * PS_CORNER_NUMBERS * sizeof *view->corners,
                            "triangles", error));
    PS_TRY(ps_buffer_upload(self->device, &self->on_device.places, view->places,
                            view->num_pixels * PS_PLACE_NUMBERS * sizeof *view->places, "pixels",
                            error));
    return PS_BUFFERS_CREATE(self->device, wanted, error);
}

static pspec_status make_room(ps_rays *self, ps_error *error) {
    const size_t pieces = self->device != NULL ? num_pieces(self, self->capacity) : 1;
    PS_TRY(PS_NEW(&self->turns, self->batch * PS_TURN_NUMBERS, "turns of pixels", error));
    PS_TRY(PS_NEW(&self->points, 3 * self->capacity, "points", error));
    PS_TRY(PS_NEW(&self->counts, pieces * self->batch, "counts of rays", error));
    return self->device != NULL ? create_buffers(self, error) : PSPEC_OK;
}

pspec_status ps_rays_create(ps_rays **out, const ps_view *view, size_t most_points,
                            ps_device *device, ps_error *error) {
    ps_rays *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "rays", error));
    self->view = view;
    self->device = device;
    choose_sizes(self, most_points);
    const pspec_status status = make_room(self, error);
    if (status != PSPEC_OK) {
        ps_rays_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_rays_destroy(ps_rays *rays) {
    if (rays == NULL) {
        return;
    }
    PS_BUFFERS_RELEASE(&rays->on_device.corners, &rays->on_device.places, &rays->on_device.turns,
                       &rays->on_device.points, &rays->on_device.counts);
    free(rays->turns);
    free(rays->points);
    free(rays->counts);
    free(rays);
}

void ps_rays_set_batch(ps_rays *rays, size_t num_pixels) {
    rays->pixels_of_batch = num_pixels > 0 && num_pixels < rays->batch ? num_pixels : rays->batch;
}

/* ---- what a batch begins with ---------------------------------------------------------------- */

typedef struct turning {
    ps_rays *rays;
    const ps_ray_set *set;
    size_t first, num;
} turning;

/* A pixel has a stream of its own, so that its turn does not depend on who makes it. */
static void turn_some(void *payload, unsigned index, unsigned count) {
    const turning *const own = payload;
    const ps_ray_set *const set = own->set;
    const uint64_t before = set->number * own->rays->view->num_pixels + own->first;
    const size_t end = ps_share_begin(own->num, index + 1, count);
    for (size_t i = ps_share_begin(own->num, index, count); i < end; i++) {
        ps_random random = ps_random_init(set->seed, PS_STREAM_TRIALS, before + i);
        const ps_rotation rotation = ps_rotation_random_portable(&random);
        for (size_t k = 0; k < PS_TURN_NUMBERS; k++) {
            own->rays->turns[i * PS_TURN_NUMBERS + k] = (float)rotation.matrix[k / 3][k % 3];
        }
    }
}

static void put_points(ps_rays *self, const ps_ray_set *set) {
    memset(self->points, 0, 3 * self->capacity * sizeof *self->points);
    for (size_t j = 0; j < set->num; j++) {
        for (size_t axis = 0; axis < 3; axis++) {
            self->points[axis * self->capacity + j] = (float)set->points[3 * j + axis];
        }
    }
}

/* ---- on the device --------------------------------------------------------------------------- */

static pspec_status get_kernel(const ps_rays *self, bool is_folded, ps_kernel **out,
                               ps_error *error) {
    ps_defines defines = ps_defines_of(sizeof(float), self->lanes);
    ps_defines_add(&defines, "-DVECTORS=%zu -DFOLD=%d -DBOUNDED=%d", self->vectors, is_folded,
                   self->view->is_bounded);
    return ps_kernel_get(self->device, out, "rays/visible.cl", "rays_visible", defines.text, error);
}

static pspec_status launch(ps_rays *self, ps_kernel *kernel, size_t first, size_t num,
                           size_t num_points, ps_error *error) {
    const double flops = 27; /* of a triangle tried by a ray: products, sums and comparisons */
    const ps_view *const view = self->view;
    const size_t pieces = num_pieces(self, num_points);
    const double tries = (double)num * (double)num_points * (double)view->num_triangles;
    const rays_scene scene = {first, num, self->capacity, (uint32_t)view->num_triangles,
                              view->radius};
    const ps_range range =
        ps_range_heavy(self->device, num, pieces, 1, flops * tries,
                       (double)num * (PS_PLACE_NUMBERS + PS_TURN_NUMBERS) * (double)sizeof(float));
    return PS_LAUNCH(self->device, kernel, &range, error, PS_STRUCT(scene),
                     PS_BUFFER(self->on_device.corners), PS_BUFFER(self->on_device.places),
                     PS_BUFFER(self->on_device.turns), PS_BUFFER(self->on_device.points),
                     PS_BUFFER(self->on_device.counts));
}

static pspec_status count_on_device(ps_rays *self, ps_kernel *kernel, const ps_ray_batch *batch,
                                    ps_error *error) {
    const size_t pieces = num_pieces(self, batch->num_points);
    PS_TRY(ps_buffer_write(self->device, &self->on_device.turns, 0, self->turns,
                           batch->num * PS_TURN_NUMBERS * sizeof *self->turns, error));
    PS_TRY(launch(self, kernel, batch->first, batch->num, batch->num_points, error));
    PS_TRY(ps_buffer_read(self->device, &self->on_device.counts, 0, self->counts,
                          pieces * batch->num * sizeof *self->counts, error));
    for (size_t i = 0; i < batch->num; i++) {
        uint32_t sum = 0;
        for (size_t piece = 0; piece < pieces; piece++) {
            sum += self->counts[piece * batch->num + i];
        }
        batch->counts[i] = sum;
    }
    return PSPEC_OK;
}

static pspec_status prepare_device(ps_rays *self, const ps_ray_set *set, ps_kernel **kernel,
                                   ps_error *error) {
    PS_TRY(get_kernel(self, set->is_folded, kernel, error));
    return ps_buffer_write(self->device, &self->on_device.points, 0, self->points,
                           3 * self->capacity * sizeof *self->points, error);
}

pspec_status ps_rays_count(ps_rays *rays, const ps_ray_set *set, uint32_t *counts,
                           const ps_watch *watch, ps_error *error) {
    ps_rays *const self = rays;
    const size_t num_pixels = self->view->num_pixels;
    ps_kernel *kernel = NULL;
    put_points(self, set);
    PS_TRY(self->device != NULL ? prepare_device(self, set, &kernel, error) : PSPEC_OK);
    for (size_t first = 0; first < num_pixels; first += self->pixels_of_batch) {
        const size_t left = num_pixels - first;
        const size_t num = left < self->pixels_of_batch ? left : self->pixels_of_batch;
        const ps_ray_batch batch = {self->view,     first,          num,
                                    self->turns,    self->points,   set->num,
                                    self->capacity, set->is_folded, counts + first};
        turning turns = {self, set, first, num};
        PS_TRY(ps_watch_tell(watch, "rays, pixels", first, num_pixels, NULL, error));
        ps_workers_share(num * PS_TURN_NUMBERS, turn_some, &turns);
        if (self->device == NULL) {
            ps_rays_count_on_host(&batch);
        } else {
            PS_TRY(count_on_device(self, kernel, &batch, error));
        }
    }
    return PSPEC_OK;
}
