/* A user's own integrand as an image, piecewise constant: docs/mathematics/integrands.md#pixels. */
#define PRECISION 64
#include "base/memory.h"
#include "integrands/files/coefficient_file.h"
#include "integrands/integrand_kind.h"
#include "integrands/pixels.h"
#include "math/neumaier.h"

#include <stdlib.h>

/* What self->own points to. */
typedef struct pixels {
    char *path;
    ps_npy_array image;
    double mean, energy;
    double *correlation; /* [image.num] at shifts of whole pixels; NULL: the image is too large */
} pixels;

/* Correlations take the square of that many products: some 10 ms. */
enum { MOST_CORRELATED = 4096 };

static const pixels *own_of(const ps_integrand *self) {
    return self->own;
}

/* ---- create -------------------------------------------------------------------------------- */

static pspec_status check_image(const ps_integrand *self, const pixels *own, ps_error *error) {
    char shape[PS_NPY_SHAPE_BYTES];
    const unsigned dimension = self->place.dimension;
    if (own->image.rank != dimension) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %s; pixels have an axis for each of the %u dimension%s", own->path,
                       ps_npy_shape(&own->image, shape), dimension, dimension == 1 ? "" : "s");
    }
    for (size_t i = 0; i < own->image.num; i++) {
        if (!(fabs(own->image.data[i]) <= PS_LARGEST_COEFFICIENT)) {
            char place[PS_NPY_PLACE_BYTES];
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "%s: the pixel at %s is %g, and the largest that there may be is %g",
                           own->path, ps_npy_place(&own->image, i, place), own->image.data[i],
                           PS_LARGEST_COEFFICIENT);
        }
    }
    return PSPEC_OK;
}

static void find_moments(pixels *own) {
    const double num = (double)own->image.num;
    ps_neumaier sum = {0, 0};
    ps_neumaier squares = {0, 0};
    for (size_t i = 0; i < own->image.num; i++) {
        ps_neumaier_add(&sum, own->image.data[i]);
    }
    own->mean = ps_neumaier_value(&sum) / num;
    for (size_t i = 0; i < own->image.num; i++) {
        const double off = own->image.data[i] - own->mean;
        ps_neumaier_add(&squares, off * off);
    }
    own->energy = ps_neumaier_value(&squares) / num;
}

/* The place of pixel a + q, on a torus. */
static size_t add_places(const ps_npy_array *image, size_t a, size_t q) {
    size_t sum = 0;
    size_t stride = 1;
    for (unsigned axis = image->rank; axis-- > 0;) {
        const size_t side = image->shape[axis];
        sum += (a % side + q % side) % side * stride;
        a /= side;
        q /= side;
        stride *= side;
    }
    return sum;
}

/* mean_a (img[a] - mean)(img[a + q] - mean) */
static pspec_status correlate_pixels(pixels *own, ps_error *error) {
    const ps_npy_array *const image = &own->image;
    if (image->num > MOST_CORRELATED) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&own->correlation, image->num, "a correlation", error));
    for (size_t q = 0; q < image->num; q++) {
        double sum = 0;
        for (size_t a = 0; a < image->num; a++) {
            sum +=
                (image->data[a] - own->mean) * (image->data[add_places(image, a, q)] - own->mean);
        }
        own->correlation[q] = sum / (double)image->num;
    }
    return PSPEC_OK;
}

static pspec_status read_image(pixels *own, ps_error *error) {
    ps_input input = {0};
    bool is_array = false;
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_input_open_array(&input, own->path, "pixels", error));
    PS_TRY_OUT(status, ps_npy_is_next(&input, &is_array, error));
    if (!is_array || !input.can_reopen) {
        status = ps_fail(error, PSPEC_ERROR_INPUT, "%s is no %s, which pixels are read from",
                         input.name, is_array ? "regular file" : "NPY array");
        goto out;
    }
    status = ps_npy_read_array(&own->image, &input, false, error);
out:
    ps_input_close(&input);
    return status;
}

static void give_table(ps_integrand *self, const pixels *own) {
    const size_t most_places = 1 << 24; /* that are numbers of single precision */
    for (unsigned axis = 0; axis < own->image.rank; axis++) {
        self->numbers[PIXELS_SIDES + axis] = (double)own->image.shape[axis];
    }
    self->table = own->image.data;
    self->num_table = own->image.num;
    self->needs_doubles =
        own->image.num > most_places || !ps_fit_single(own->image.data, own->image.num);
}

static pspec_status create(ps_integrand *self, const char *const *values, ps_error *error) {
    pixels *own = NULL;
    PS_TRY(PS_NEW(&own, 1, "pixels", error));
    self->own = own;
    PS_TRY(ps_integrand_copy_path(self, values[0], &own->path, error));
    PS_TRY(read_image(own, error));
    PS_TRY(check_image(self, own, error));
    find_moments(own);
    give_table(self, own);
    return correlate_pixels(own, error);
}

static void destroy(ps_integrand *self) {
    pixels *const own = self->own;
    if (own != NULL) {
        ps_npy_array_free(&own->image);
        free(own->correlation);
        free(own->path);
    }
    free(own);
}

/* ---- what is known ------------------------------------------------------------------------- */

static double integral(const ps_integrand *self) {
    return own_of(self)->mean;
}

static double energy(const ps_integrand *self) {
    return own_of(self)->energy;
}

static void values(const ps_integrand *self, const double *points, size_t num, double *out) {
    const ps_npy_array *const image = &own_of(self)->image;
    for (size_t i = 0; i < num; i++) {
        size_t place = 0;
        for (unsigned axis = 0; axis < image->rank; axis++) {
            const size_t side = image->shape[axis];
            const size_t at = (size_t)(points[i * image->rank + axis] * (double)side);
            place = place * side + (at < side ? at : side - 1); /* the product may round up */
        }
        out[i] = image->data[place];
    }
}

/* Linear on every axis between shifts of whole pixels. */
static double correlation(const ps_integrand *self, const double *x) {
    const pixels *const own = own_of(self);
    const unsigned rank = own->image.rank;
    double sum = 0;
    if (own->correlation == NULL) {
        return NAN;
    }
    for (unsigned corner = 0; corner < 1U << rank; corner++) {
        double share = 1;
        size_t place = 0;
        for (unsigned axis = 0; axis < rank; axis++) {
            const size_t side = own->image.shape[axis];
            const double at = (x[axis] - floor(x[axis])) * (double)side;
            const double below = floor(at);
            const bool is_above = (corner >> axis & 1) != 0;
            share *= is_above ? at - below : 1 - (at - below);
            place = place * side + ((size_t)below + (is_above ? 1 : 0)) % side;
        }
        sum += share * own->correlation[place];
    }
    return own->mean * own->mean + sum;
}

/* ---- points -------------------------------------------------------------------------------- */

/* The mean of the weights is 0: it belongs to k = 0, and where else the points have it, the pixel
 * has a zero. */
static pspec_status give_points(const ps_integrand *self, ps_integrand_points *out,
                                ps_error *error) {
    const pixels *const own = own_of(self);
    const ps_npy_array *const image = &own->image;
    PS_TRY(PS_NEW(&out->points, image->num * image->rank, "points", error));
    PS_TRY(PS_NEW(&out->weights, image->num, "weights", error));
    out->num = image->num;
    for (size_t i = 0; i < image->num; i++) {
        size_t rest = i;
        for (unsigned axis = image->rank; axis-- > 0;) {
            const size_t side = image->shape[axis];
            out->points[i * image->rank + axis] = (double)(rest % side) / (double)side;
            rest /= side;
        }
        out->weights[i] = image->data[i] - own->mean;
    }
    return PSPEC_OK;
}

static void give_factors(const ps_integrand *self, const int32_t *vectors, size_t num,
                         double *factors) {
    const ps_npy_array *const image = &own_of(self)->image;
    for (size_t i = 0; i < num; i++) {
        double product = 1 / (double)image->num;
        for (unsigned axis = 0; axis < image->rank; axis++) {
            product *= ps_integrand_sinc(vectors[i * image->rank + axis], image->shape[axis]);
        }
        factors[i] = product * product;
    }
}

const ps_integrand_kind ps_integrand_pixels = {
    .name = "pixels",
    .kernel = "pixels",
    .summary = "an image, NPY with an axis for each dimension, the same all over a pixel",
    .domains = PS_INTEGRAND_ON(PS_SAMPLES_TORUS),
    .least = 1,
    .most = PS_MAX_DIMENSION,
    .parameters = {{"file", "", "NPY of real numbers, any size"}},
    .create = create,
    .destroy = destroy,
    .integral = integral,
    .energy = energy,
    .points = give_points,
    .factors = give_factors,
    .values = values,
    .correlation = correlation,
};
