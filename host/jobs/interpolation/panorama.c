#include "jobs/interpolation/panorama.h"

#include "base/memory.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* Of functions that are no images: 0.7 degrees, finer than 20000 points are apart. */
enum { USUAL_HEIGHT = 256 };

/* ---- the pixels ---------------------------------------------------------------------------- */

void ps_panorama_directions(const ps_panorama *self, size_t first_row, size_t num_rows,
                            double *out) {
    for (size_t i = first_row; i < first_row + num_rows; i++) {
        const double theta = PS_PI * ((double)i + 0.5) / (double)self->height;
        for (size_t j = 0; j < self->width; j++, out += 3) {
            const double phi = 2 * PS_PI * ((double)j + 0.5) / (double)self->width;
            out[0] = sin(theta) * cos(phi);
            out[1] = sin(theta) * sin(phi);
            out[2] = cos(theta);
        }
    }
}

/* Half of the difference of the cosines of its edges. */
double ps_panorama_share(const ps_panorama *self, size_t row) {
    const double step = PS_PI / (double)self->height;
    return sin(step * ((double)row + 0.5)) * sin(step / 2) / (double)self->width;
}

/* ---- the functions ------------------------------------------------------------------------- */

static pspec_status choose_size(ps_panorama *self, const char *const *texts, ps_error *error) {
    for (size_t i = 0; i < self->num; i++) {
        size_t width = 0;
        size_t height = 0;
        if (!ps_integrand_image_size(self->integrands[i], &width, &height)) {
            continue;
        }
        if (self->width > 0 && (width != self->width || height != self->height)) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s has %zu x %zu pixels, and a map before it %zu x %zu: maps of one "
                           "table have the same pixels",
                           texts[i], width, height, self->width, self->height);
        }
        self->width = width;
        self->height = height;
    }
    if (self->width == 0) {
        self->height = USUAL_HEIGHT;
        self->width = 2 * self->height;
    }
    return PSPEC_OK;
}

pspec_status ps_panorama_values(const ps_panorama *self, size_t function, const double *points,
                                size_t num, double *values, ps_error *error) {
    const ps_integrand *const integrand = self->integrands[function];
    ps_integrand_values(integrand, points, num, values);
    const ps_error *const failure = ps_integrand_failure(integrand);
    if (failure != NULL && failure->status != PSPEC_OK) {
        return ps_fail(error, failure->status, "%s", failure->message);
    }
    for (size_t i = 0; i < num; i++) {
        if (!isfinite(values[i])) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "integrand %s is %g at (%.6g, %.6g, %.6g)",
                           integrand->kind->name, values[i], points[3 * i], points[3 * i + 1],
                           points[3 * i + 2]);
        }
    }
    return PSPEC_OK;
}

static pspec_status fill_rows(ps_panorama *self, double *directions, ps_error *error) {
    for (size_t row = 0; row < self->height; row++) {
        ps_panorama_directions(self, row, 1, directions);
        for (size_t f = 0; f < self->num; f++) {
            double *const values = self->values + (f * self->height + row) * self->width;
            PS_TRY(ps_panorama_values(self, f, directions, self->width, values, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_panorama_make(ps_panorama *out, ps_made_integrands *made,
                              const ps_given_integrands *given, const char *const *texts,
                              size_t num, ps_error *error) {
    const ps_integrand_place sphere = {PS_SAMPLES_SPHERE, 3};
    PS_TRY(PS_NEW(&out->integrands, num, "integrands", error));
    for (; out->num < num; out->num++) {
        PS_TRY(ps_integrand_take(&out->integrands[out->num], made != NULL ? made : &out->own, given,
                                 texts[out->num], sphere, 0, error));
    }
    return choose_size(out, texts, error);
}

pspec_status ps_panorama_fill(ps_panorama *self, ps_error *error) {
    double *directions = NULL;
    PS_TRY(ps_allocate_for(&self->values, self->width * self->height, self->num * sizeof(double),
                           "images", error));
    PS_TRY(PS_NEW(&directions, self->width * 3, "directions", error));
    const pspec_status status = fill_rows(self, directions, error);
    free(directions);
    return status;
}

void ps_panorama_free(ps_panorama *self) {
    ps_made_integrands_free(&self->own);
    free(self->integrands);
    free(self->values);
    *self = (ps_panorama){0};
}
