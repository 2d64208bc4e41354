#include "base/memory.h"
#include "plots/plot_script.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_PIXELS = 801 }; /* the panel has some 600 pixels; more would not be seen */

/* Half as many frequencies as there are pixels at most, so the middle pixel stays around DC. */
static size_t choose_block(size_t size) {
    size_t block = 1;
    while (size / block > MAX_PIXELS) {
        block += 2;
    }
    return block;
}

/* Mean over a block of frequencies, DC and what is outside the image left out. */
static double average_block(const ps_plot_image *image, ptrdiff_t first_1, ptrdiff_t first_2,
                            size_t block) {
    const ptrdiff_t size = (ptrdiff_t)image->size;
    double sum = 0;
    size_t count = 0;
    for (ptrdiff_t i = first_1; i < first_1 + (ptrdiff_t)block; i++) {
        for (ptrdiff_t j = first_2; j < first_2 + (ptrdiff_t)block; j++) {
            const int is_inside = i >= 0 && j >= 0 && i < size && j < size;
            if (is_inside && !(i == size / 2 && j == size / 2)) {
                sum += image->power[i * size + j];
                count++;
            }
        }
    }
    return count > 0 ? sum / (double)count : 0;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The scale ends where all but one in a thousand pixels lie below, so that a few peaks do not make
 * the rest dark, and never below 2, so that white noise looks alike in all pictures. */
static pspec_status choose_maximum(ps_plot_raster *raster, ps_error *error) {
    const size_t count = raster->size * raster->size;
    double *sorted = NULL;
    PS_TRY(PS_NEW(&sorted, count, "picture", error));
    size_t num_finite = 0;
    for (size_t i = 0; i < count; i++) {
        if (isfinite(raster->power[i])) {
            sorted[num_finite++] = raster->power[i];
        }
    }
    qsort(sorted, num_finite, sizeof *sorted, compare_doubles);
    const double high = num_finite > 0 ? sorted[num_finite - 1 - num_finite / 1000] : 0;
    raster->maximum = fmax(high, 2);
    free(sorted);
    return PSPEC_OK;
}

pspec_status ps_plot_raster_make(ps_plot_raster *out, const ps_plot_image *image, ps_error *error) {
    *out = (ps_plot_raster){0};
    const size_t block = choose_block(image->size);
    const ptrdiff_t half_image = (ptrdiff_t)(image->size / 2);
    const ptrdiff_t half = (half_image + (ptrdiff_t)(block / 2)) / (ptrdiff_t)block;
    out->size = 2 * (size_t)half + 1;
    out->pixel = (double)block / image->unit;
    PS_TRY(PS_NEW(&out->power, out->size * out->size, "picture", error));
    const ptrdiff_t first = half_image - (ptrdiff_t)(block / 2) - half * (ptrdiff_t)block;
    for (size_t row = 0; row < out->size; row++) {
        for (size_t column = 0; column < out->size; column++) {
            const ptrdiff_t k_1 = first + (ptrdiff_t)(column * block);
            const ptrdiff_t k_2 = first + (ptrdiff_t)(row * block);
            out->power[row * out->size + column] = average_block(image, k_1, k_2, block);
        }
    }
    out->maximum = image->maximum;
    const pspec_status status = image->maximum > 0 ? PSPEC_OK : choose_maximum(out, error);
    if (status != PSPEC_OK) {
        free(out->power);
        out->power = NULL;
    }
    return status;
}

pspec_status ps_plot_find_maximum(double *out, const ps_plot_image *image, ps_error *error) {
    ps_plot_raster raster = {0};
    ps_plot_image own = *image;
    own.maximum = 0;
    PS_TRY(ps_plot_raster_make(&raster, &own, error));
    *out = raster.maximum;
    free(raster.power);
    return PSPEC_OK;
}
