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

static pspec_status read_pixels(ps_image_reader *reader, ps_error *error) {
    enum { FIRST_BYTES = 4 };
    ps_input *const input = reader->input;
    const unsigned char *bytes = NULL;
    size_t num_bytes = 0;
    PS_TRY(ps_input_peek(input, FIRST_BYTES, &bytes, &num_bytes, error));
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const ps_image_format *const format = &formats[i];
        if (begins(format->begin, bytes, num_bytes)) {
            return format->read != NULL
                       ? format->read(reader, error)
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

pspec_status ps_image_read(const char *path, const ps_image_taker *taker, ps_error *error) {
    ps_input input = {0};
    ps_image_reader reader = {.input = &input, .taker = taker};
    pspec_status status = ps_input_open(&input, path, error);
    if (status == PSPEC_OK) {
        status = read_pixels(&reader, error);
    }
    if (status == PSPEC_OK) {
        status = check_end(&input, error);
    }
    free(reader.row);
    ps_input_close(&input);
    return status;
}

double ps_image_luminance(const float *pixel, unsigned num_channels) {
    static const double shares[] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (unsigned i = 0; i < num_channels; i++) {
        sum += (num_channels > 1 ? shares[i] : 1) * (double)pixel[i];
    }
    return sum;
}
