/* An image as light from every direction, or on the torus: docs/mathematics/maps.md. */
#define PRECISION 64
#include "integrands/map.h"
#include "integrands/torus_map.h"

#include "base/memory.h"
#include "base/text.h"
#include "images/sphere_map.h"
#include "images/pixel.h"
#include "images/torus_map.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/integrand_kind.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What self->own points to. */
typedef struct map {
    char *path;        /* NULL: of no file */
    ps_sphere_map map; /* on the sphere and the hemisphere */
    ps_map_moments moments;
    double *harmonics; /* coefficients up to a degree, which were asked for last; NULL: none */
    size_t harmonics_degree;
    ps_torus_map image; /* on the torus, with what was found of its powers so far */
    ps_torus_map_powers powers;
    size_t powers_cutoff;
    char note[160];
} map;

static const map *own_of(const ps_integrand *self) {
    return self->own;
}

/* ---- create -------------------------------------------------------------------------------- */

static pspec_status read_word(const ps_integrand *self, const char *key, const char *text,
                              const char *words, int *out, ps_error *error) {
    *out = ps_text_find_word(text, strlen(text), words);
    return *out >= 0 ? PSPEC_OK : ps_integrand_fail(self, key, text, words, error);
}

static bool is_on_torus(const ps_integrand *self) {
    return self->place.where == PS_SAMPLES_TORUS;
}

/* What a result says of the image, which nothing else does. */
static void describe(const ps_integrand *self, map *own) {
    const size_t num_clamped = own->map.num_clamped + own->image.num_clamped;
    const char *const made = own->path == NULL ? " made up for want of a file" : "";
    const char *const shape = !is_on_torus(self) && own->map.width != 2 * own->map.height
                                  ? " cover the sphere, which are not 2:1"
                                  : "";
    const char *const digits =
        own->image.pixel_bytes == PIXEL_SHORT_BYTES ? " have 17 binary digits" : "";
    int length = 0;
    if (made[0] != '\0' || shape[0] != '\0' || digits[0] != '\0') {
        length = snprintf(own->note, sizeof own->note, "%zu x %zu pixels%s%s%s",
                          own->map.width + own->image.width, own->map.height + own->image.height,
                          made, shape, digits);
    }
    if (num_clamped > 0) {
        snprintf(own->note + length, sizeof own->note - (size_t)length,
                 "%s%zu pixels were negative or not finite, and count as 0", length > 0 ? "; " : "",
                 num_clamped);
    }
}

static void give_table(ps_integrand *self, const map *own) {
    const size_t most_places = 1 << 24; /* that are numbers of single precision */
    self->numbers[MAP_WIDTH] = (double)own->map.width;
    self->numbers[MAP_HEIGHT] = (double)own->map.height;
    self->table = own->map.rows;
    self->num_table = (own->map.height + 2) * own->map.width;
    self->needs_doubles =
        self->num_table > most_places || !ps_fit_single(self->table, self->num_table);
}

static pspec_status read_sphere(ps_integrand *self, map *own, const ps_channel_source *source,
                                ps_error *error) {
    PS_TRY(ps_sphere_map_read(&own->map, source, error));
    give_table(self, own);
    return ps_sphere_map_moments(&own->moments, &own->map, ps_integrand_is_on_hemisphere(self),
                                 error);
}

static pspec_status read_torus(ps_integrand *self, map *own, const ps_channel_source *source,
                               ps_error *error) {
    const ps_torus_map_limits limits = {PS_TORUS_MAP_MOST_FLOATS, self->most_bytes};
    ps_torus_map *const image = &own->image;
    PS_TRY(ps_torus_map_read(image, source, &limits, error));
    self->numbers[TORUS_MAP_WIDTH] = (double)image->width;
    self->numbers[TORUS_MAP_HEIGHT] = (double)image->height;
    self->numbers[TORUS_MAP_BYTES] = image->pixel_bytes;
    self->kernel = "torus_map";
    self->bytes = image->pixels;
    self->num_bytes = ps_torus_map_bytes(image);
    self->needs_doubles = !ps_fit_single(&image->largest, 1);
    return PSPEC_OK;
}

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    map *own = NULL;
    int channel = 0;
    int clamps = 0;
    uint64_t width = 0;
    PS_TRY(PS_NEW(&own, 1, "a map", error));
    self->own = own;
    if (values[0][0] != '\0') {
        PS_TRY(ps_integrand_copy_path(self, values[0], &own->path, error));
    }
    PS_TRY(read_word(self, "channel", values[1], PS_MAP_CHANNELS, &channel, error));
    PS_TRY(read_word(self, "clamp", values[2], "no|yes", &clamps, error));
    PS_TRY(ps_parse_count(values[3], "width of integrand map", 2, PS_IMAGE_MOST_SIDE / 4, &width,
                          error));
    const ps_channel_source source = {own->path, (size_t)width, (ps_map_channel)channel,
                                      clamps == 1};
    PS_TRY(is_on_torus(self) ? read_torus(self, own, &source, error)
                             : read_sphere(self, own, &source, error));
    describe(self, own);
    return PSPEC_OK;
}

static void destroy(ps_integrand *self) {
    map *const own = self->own;
    if (own != NULL) {
        ps_sphere_map_free(&own->map);
        free(own->harmonics);
        ps_torus_map_free(&own->image);
        ps_torus_map_powers_free(&own->powers);
        free(own->path);
    }
    free(own);
}

/* ---- what is known ------------------------------------------------------------------------- */

static double integral(const ps_integrand *self) {
    return is_on_torus(self) ? own_of(self)->image.mean : own_of(self)->moments.integral;
}

/* On the hemisphere that of the even extension. */
static double energy(const ps_integrand *self) {
    return is_on_torus(self)
               ? own_of(self)->image.energy
               : (ps_integrand_is_on_hemisphere(self) ? 2 : 1) * own_of(self)->moments.deviation;
}

/* Those up to a cut-off are found at once, and kept: who asks for more asks for twice as many. */
static pspec_status find_powers(map *own, size_t cutoff, ps_error *error) {
    if (own->powers.all != NULL && cutoff <= own->powers_cutoff) {
        return PSPEC_OK;
    }
    ps_torus_map_powers_free(&own->powers);
    own->powers_cutoff = cutoff > 2 * own->powers_cutoff ? cutoff : 2 * own->powers_cutoff;
    const pspec_status status =
        ps_torus_map_find_powers(&own->powers, &own->image, own->powers_cutoff, error);
    if (status != PSPEC_OK) { /* the integrand may be asked again, by another question */
        ps_torus_map_powers_free(&own->powers);
    }
    return status;
}

/* Linear between pixels: their transform times sinc^2 of either axis. */
static pspec_status powers(const ps_integrand *self, const int32_t *vectors, size_t num,
                           double *out, ps_error *error) {
    map *const own = self->own;
    size_t cutoff = 0;
    for (size_t i = 0; i < 2 * num; i++) {
        const size_t size = (size_t)labs((long)vectors[i]);
        cutoff = size > cutoff ? size : cutoff;
    }
    PS_TRY(find_powers(own, cutoff, error));
    for (size_t i = 0; i < num; i++) {
        const int32_t *const k = vectors + 2 * i;
        const double factor =
            ps_integrand_sinc(k[0], own->image.height) * ps_integrand_sinc(k[1], own->image.width);
        const double square = factor * factor;
        out[i] = square * square * ps_torus_map_power(&own->powers, &own->image, k);
    }
    return PSPEC_OK;
}

/* Questions of a scene ask for the same ones, which take seconds of a large map. */
static pspec_status find_harmonics(const ps_integrand *self, size_t max_degree, ps_error *error) {
    map *const own = self->own;
    if (own->harmonics != NULL && own->harmonics_degree == max_degree) {
        return PSPEC_OK;
    }
    free(own->harmonics);
    own->harmonics = NULL;
    own->harmonics_degree = max_degree;
    PS_TRY(PS_NEW(&own->harmonics, (max_degree + 1) * (max_degree + 2), "coefficients of a map",
                  error));
    const pspec_status status = ps_sphere_map_coefficients(
        &own->map, ps_integrand_is_on_hemisphere(self), max_degree, own->harmonics, error);
    if (status != PSPEC_OK) {
        free(own->harmonics);
        own->harmonics = NULL;
    }
    return status;
}

static pspec_status coefficients(const ps_integrand *self, size_t max_degree, double *out,
                                 ps_error *error) {
    PS_TRY(find_harmonics(self, max_degree, error));
    memcpy(out, own_of(self)->harmonics, (max_degree + 1) * (max_degree + 2) * sizeof *out);
    return PSPEC_OK;
}

/* The even extension has twice the integrals over the hemisphere at even degrees, else 0. */
static pspec_status degrees(const ps_integrand *self, size_t max_degree, double *out,
                            ps_error *error) {
    const bool is_upper = ps_integrand_is_on_hemisphere(self);
    PS_TRY(find_harmonics(self, max_degree, error));
    const double *const all = own_of(self)->harmonics;
    for (size_t l = 0; l <= max_degree; l++) {
        const double factor = !is_upper ? 1 : l % 2 == 0 ? 4 : 0;
        out[l] = 0;
        for (size_t m = 0; m <= l; m++) {
            const double *const f = all + 2 * (m * (2 * max_degree + 1 - m) / 2 + l);
            out[l] += factor * (m > 0 ? 2 : 1) * (f[0] * f[0] + f[1] * f[1]);
        }
    }
    return PSPEC_OK;
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    const void *const bytes = self->bytes;
    for (size_t i = 0; i < num; i++) {
        out[i] = is_on_torus(self) ? torus_map_value(points + 2 * i, 2, self->numbers, bytes)
                                   : map_value(points + 3 * i, 3, self->numbers, self->table);
    }
}

static void image_size(const ps_integrand *self, size_t *width, size_t *height) {
    *width = own_of(self)->map.width;
    *height = own_of(self)->map.height;
}

static const char *note(const ps_integrand *self) {
    return own_of(self)->note[0] != '\0' ? own_of(self)->note : NULL;
}

const ps_integrand_kind ps_integrand_map = {
    .name = "map",
    .kernel = "map",
    .summary = "an image in HDR or PFM: of the plane, or light from every direction",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS) | PS_INTEGRAND_ROUND,
    .least = 2,
    .most = 2,
    .parameters = {{"file", "", "Radiance HDR or PFM, +z at the top; empty: made up"},
                   {"channel", "luminance", PS_MAP_CHANNELS},
                   {"clamp", "no", "yes: pixels below 0 and NaN count as 0"},
                   {"width", "1024", "pixels of a row where no file is: light made up"}},
    .does_without_file = true,
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .powers = powers,
    .degrees = degrees,
    .coefficients = coefficients,
    .values = values,
    .image_size = image_size,
    .note = note,
};
