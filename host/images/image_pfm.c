/* Portable float map: two letters, width, height, a scale whose sign is the order of bytes, and the
 * rows of float32 from the lowest up. */
#include "files/output_file.h"
#include "files/text_lines.h"
#include "images/image_format.h"

#include <string.h>

/* A word of the header, and the one blank behind it. */
static pspec_status read_word(ps_input *input, char word[PS_IMAGE_LINE_BYTES], ps_error *error) {
    size_t length = 0;
    while (length + 1 < PS_IMAGE_LINE_LETTERS) {
        PS_TRY(ps_image_read_bytes(input, word + length, 1, error));
        if (strchr(" \t\r\n", word[length]) == NULL) {
            length++;
        } else if (length > 0) {
            break;
        }
    }
    word[length] = '\0';
    return PSPEC_OK;
}

static pspec_status read_number(ps_input *input, const char *what, double *out, ps_error *error) {
    char word[PS_IMAGE_LINE_BYTES];
    char shown[PS_TOKEN_BYTES];
    PS_TRY(read_word(input, word, error));
    const char *const end = ps_decimal_parse(word, out);
    return end != NULL && *end == '\0'
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s: \"%s\" is no %s of a PFM image",
                         input->name, ps_token_show(shown, word, strlen(word)), what);
}

static void swap_bytes(float *pixels, size_t num) {
    for (size_t i = 0; i < num; i++) {
        uint32_t bits = 0;
        memcpy(&bits, &pixels[i], sizeof bits);
        bits = bits >> 24 | (bits >> 8 & 0xff00) | (bits << 8 & 0xff0000) | bits << 24;
        memcpy(&pixels[i], &bits, sizeof bits);
    }
}

static bool is_little_endian(void) {
    const uint16_t one = 1;
    return *(const unsigned char *)&one == 1;
}

pspec_status ps_image_read_pfm(ps_image_reader *reader, ps_error *error) {
    ps_input *const input = reader->input;
    char letters[PS_IMAGE_LINE_BYTES];
    double width = 0;
    double height = 0;
    double scale = 0;
    PS_TRY(read_word(input, letters, error));
    reader->image.num_channels = letters[1] == 'F' ? 3 : 1;
    PS_TRY(read_number(input, "width", &width, error));
    PS_TRY(read_number(input, "height", &height, error));
    PS_TRY(read_number(input, "scale", &scale, error));
    const double bytes = width * height * reader->image.num_channels * (double)sizeof(float);
    PS_TRY(ps_image_begin(reader, width, height, bytes, error));
    const size_t num = reader->image.width * reader->image.num_channels;
    const bool is_swapped = (scale < 0) != is_little_endian();
    for (size_t i = 0; i < reader->image.height; i++) {
        PS_TRY(ps_image_read_bytes(input, reader->row, num * sizeof *reader->row, error));
        if (is_swapped) {
            swap_bytes(reader->row, num);
        }
        PS_TRY(ps_image_give(reader, i, true, error));
    }
    return PSPEC_OK;
}

pspec_status ps_image_write_pfm(const char *path, size_t width, size_t height, const double *pixels,
                                ps_error *error) {
    ps_output_file *file = NULL;
    PS_TRY(ps_output_open(&file, path, error));
    fprintf(ps_output_stream(file), "Pf\n%zu %zu\n%s\n", width, height,
            is_little_endian() ? "-1.0" : "1.0");
    for (size_t y = height; y-- > 0;) {
        for (size_t x = 0; x < width; x++) {
            const float value = (float)pixels[y * width + x];
            ps_output_write(file, &value, sizeof value, 1);
        }
    }
    return ps_output_commit(&file, error);
}
