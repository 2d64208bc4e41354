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

static pspec_status check_size(const ps_input *input, double width, double height,
                               double least_bytes, ps_error *error) {
    uint64_t left = 0;
    if (!(width >= 1 && height >= 1 && width == floor(width) && height == floor(height) &&
          width <= PS_IMAGE_MOST_SIDE && height <= PS_IMAGE_MOST_SIDE &&
          width * height <= (double)PS_IMAGE_MOST_PIXELS)) {
        return ps_fail(
            error, PSPEC_ERROR_INPUT,
            "%s: an image of %g x %g pixels; there may be %zu of them, and %d along a side",
            input->name, width, height, PS_IMAGE_MOST_PIXELS, PS_IMAGE_MOST_SIDE);
    }
    return !ps_input_bytes_left(input, &left) || (double)left >= least_bytes
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: %g x %g pixels take at least %.0f bytes, and %llu are left",
                         input->name, width, height, least_bytes, (unsigned long long)left);
}

pspec_status ps_image_begin(ps_image_reader *reader, double width, double height,
                            double least_bytes, ps_error *error) {
    ps_image *const image = &reader->image;
    PS_TRY(check_size(reader->input, width, height, least_bytes, error));
    image->width = (size_t)width;
    image->height = (size_t)height;
    PS_TRY(PS_NEW(&reader->row, image->width * image->num_channels, "a row of an image", error));
    return reader->taker->begin(reader->taker->payload, image, error);
}

pspec_status ps_image_give(ps_image_reader *reader, size_t i, bool is_upward, ps_error *error) {
    const size_t y = is_upward ? reader->image.height - 1 - i : i;
    return reader->taker->take(reader->taker->payload, &reader->image, y, reader->row, error);
}
