#include "images/image.h"

#include "images/image_format.h"

#include <stdlib.h>
#include <string.h>

static const char convert[] = "convert it to Radiance HDR or PFM first, of linear light";

static const ps_image_format formats[] = {
    {"Radiance HDR", "#?", ps_image_read_hdr, NULL},
    {"PFM", "PF\n|Pf\n|PF\r|Pf\r|PF |Pf ", ps_image_read_pfm, NULL},
    {"OpenEXR", "\x76\x2f\x31\x01", NULL, convert},
    {"PNG", "\x89PNG", NULL, convert},
    {"JPEG", "\xff\xd8\xff", NULL, convert},
    {"TIFF", "II*|MM", NULL, convert},
};

static bool begins(const char *words, const unsigned char *bytes, size_t num_bytes) {
    for (const char *word = words; *word != '\0';) {
        const size_t length = strcspn(word, "|");
        if (length <= num_bytes && memcmp(word, bytes, length) == 0) {
            return true;
        }
        word += length + (word[length] == '|' ? 1 : 0);
    }
    return false;
}

static pspec_status read_pixels(ps_image *out, ps_input *input, ps_error *error) {
    enum { FIRST_BYTES = 4 };
    const unsigned char *bytes = NULL;
    size_t num_bytes = 0;
    PS_TRY(ps_input_peek(input, FIRST_BYTES, &bytes, &num_bytes, error));
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const ps_image_format *const format = &formats[i];
        if (begins(format->begin, bytes, num_bytes)) {
            return format->read != NULL
                       ? format->read(out, input, error)
                       : ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s is not read; %s", input->name,
                                 format->name, format->instead);
        }
    }
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s is no image in Radiance HDR (#?RADIANCE) or PFM",
                   input->name);
}

static pspec_status check_end(ps_input *input, ps_error *error) {
    char more = 0;
    size_t count = 0;
    PS_TRY(ps_input_read(input, &more, 1, &count, error));
    return count == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "%s: bytes follow the pixels that the header announces", input->name);
}

pspec_status ps_image_read(ps_image *out, const char *path, ps_error *error) {
    ps_input input = {0};
    *out = (ps_image){0};
    pspec_status status = ps_input_open(&input, path, error);
    if (status == PSPEC_OK) {
        status = read_pixels(out, &input, error);
    }
    if (status == PSPEC_OK) {
        status = check_end(&input, error);
    }
    ps_input_close(&input);
    return status;
}

void ps_image_free(ps_image *image) {
    free(image->pixels);
    *image = (ps_image){0};
}

double ps_image_luminance(const ps_image *image, size_t pixel) {
    static const double shares[] = {0.2126, 0.7152, 0.0722};
    const float *const own = image->pixels + pixel * image->num_channels;
    double sum = 0;
    for (unsigned i = 0; i < image->num_channels; i++) {
        sum += (image->num_channels > 1 ? shares[i] : 1) * (double)own[i];
    }
    return sum;
}
