#include "images/image_format.h"

#include "base/memory.h"

#include <math.h>

pspec_status ps_image_read_bytes(ps_input *input, void *out, size_t num, ps_error *error) {
    size_t count = 0;
    PS_TRY(ps_input_read(input, out, num, &count, error));
    return count == num
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s ends before the pixels that its header announces", input->name);
}

pspec_status ps_image_read_line(ps_input *input, char line[PS_IMAGE_LINE_BYTES], ps_error *error) {
    for (size_t length = 0; length < PS_IMAGE_LINE_LETTERS; length++) {
        PS_TRY(ps_image_read_bytes(input, line + length, 1, error));
        if (line[length] == '\n') {
            line[length - (length > 0 && line[length - 1] == '\r' ? 1 : 0)] = '\0';
            return PSPEC_OK;
        }
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: a line of the header has more than %d letters",
                   input->name, PS_IMAGE_LINE_LETTERS - 1);
}

static pspec_status reserve(ps_image *image, size_t num_rows, ps_error *error) {
    void *pixels = image->pixels;
    PS_TRY(ps_grow(&pixels, &image->capacity, num_rows * image->width * image->num_channels,
                   sizeof *image->pixels, "an image", error));
    image->pixels = pixels;
    return PSPEC_OK;
}

pspec_status ps_image_make(ps_image *out, const ps_input *input, double width, double height,
                           double least_bytes, ps_error *error) {
    uint64_t left = 0;
    const bool is_known = ps_input_bytes_left(input, &left);
    if (!(width >= 1 && height >= 1 && width == floor(width) && height == floor(height) &&
          width <= PS_IMAGE_MOST_SIDE && height <= PS_IMAGE_MOST_SIDE &&
          width * height <= (double)PS_IMAGE_MOST_PIXELS)) {
        return ps_fail(
            error, PSPEC_ERROR_INPUT,
            "%s: an image of %g x %g pixels; there may be %zu of them, and %d along a side",
            input->name, width, height, PS_IMAGE_MOST_PIXELS, PS_IMAGE_MOST_SIDE);
    }
    if (is_known && (double)left < least_bytes) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: %g x %g pixels take at least %.0f bytes, and %llu are left",
                       input->name, width, height, least_bytes, (unsigned long long)left);
    }
    out->width = (size_t)width;
    out->height = (size_t)height;
    return is_known ? reserve(out, out->height, error) : PSPEC_OK;
}

pspec_status ps_image_row(ps_image *image, size_t y, float **out, ps_error *error) {
    PS_TRY(reserve(image, y + 1, error));
    *out = image->pixels + y * image->width * image->num_channels;
    return PSPEC_OK;
}

void ps_image_turn(ps_image *image) {
    const size_t row = image->width * image->num_channels;
    for (size_t y = 0; y < image->height / 2; y++) {
        float *const above = image->pixels + y * row;
        float *const below = image->pixels + (image->height - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            const float kept = above[i];
            above[i] = below[i];
            below[i] = kept;
        }
    }
}
