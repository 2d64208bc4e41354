/* Radiance HDR (RGBE): lines of a header, then rows of four bytes a pixel, flat or with runs of
 * either kind (G. Ward, Real pixels, Graphics Gems II, 1991; the RADIANCE file formats). */
#include "files/text_lines.h"
#include "images/image_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RED, GREEN, BLUE, EXPONENT, RGBE };

/* ---- header ------------------------------------------------------------------------------ */

/* Pixels are in the units of light times all exposures. */
static pspec_status read_header(ps_input *input, double *exposure, ps_error *error) {
    char line[PS_IMAGE_LINE_BYTES];
    char shown[PS_TOKEN_BYTES];
    static const char exposure_word[] = "EXPOSURE=";
    for (bool is_first = true;; is_first = false) {
        double factor = 0;
        PS_TRY(ps_image_read_line(input, line, error));
        if (line[0] == '\0' && !is_first) {
            return PSPEC_OK;
        }
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s is not read; 32-bit_rle_rgbe is",
                           input->name, ps_token_show(shown, line, strlen(line)));
        }
        if (strncmp(line, exposure_word, strlen(exposure_word)) == 0) {
            const char *const end =
                ps_decimal_parse(ps_skip_blanks(line + strlen(exposure_word)), &factor);
            *exposure *= factor;
            if (end == NULL || !(isfinite(*exposure) && *exposure > 0)) {
                return ps_fail(error, PSPEC_ERROR_INPUT, "%s: %s is no exposure", input->name,
                               ps_token_show(shown, line, strlen(line)));
            }
        }
    }
}

/* Rows from the bottom up (+Y), or from right to left (-X), are turned. */
typedef struct turning {
    bool is_upward, is_leftward;
} turning;

/* "-Y 512": its sign and letter, and a number, which it returns the end of, or NULL. */
static const char *take_axis(const char *text, char letter, bool *is_turned, double *num,
                             char turned) {
    text = ps_skip_blanks(text);
    if ((text[0] != '+' && text[0] != '-') || text[1] != letter) {
        return NULL;
    }
    *is_turned = text[0] == turned;
    const char *const end = ps_decimal_parse(ps_skip_blanks(text + 2), num);
    return end != NULL && *num == floor(*num) ? ps_skip_blanks(end) : NULL;
}

static pspec_status read_size(ps_input *input, double *width, double *height, turning *out,
                              ps_error *error) {
    char line[PS_IMAGE_LINE_BYTES];
    char shown[PS_TOKEN_BYTES];
    PS_TRY(ps_image_read_line(input, line, error));
    const char *end = take_axis(line, 'Y', &out->is_upward, height, '+');
    end = end != NULL ? take_axis(end, 'X', &out->is_leftward, width, '-') : NULL;
    if (end == NULL || *end != '\0') {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s: \"%s\" is no size that is read, which is \"-Y height +X width\"",
                       input->name, ps_token_show(shown, line, strlen(line)));
    }
    return PSPEC_OK;
}

/* ---- rows -------------------------------------------------------------------------------- */

static pspec_status fail_run(const ps_input *input, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT, "%s: a run of pixels does not fit its row",
                   input->name);
}

/* Each of the four bytes of all pixels by itself: a count above 128 repeats a byte. */
static pspec_status read_components(ps_input *input, unsigned char *row, size_t width,
                                    ps_error *error) {
    enum { RUN = 128 };
    for (size_t component = 0; component < RGBE; component++) {
        for (size_t x = 0; x < width;) {
            unsigned char bytes[RUN] = {0}; /* the count, then the byte that is repeated */
            PS_TRY(ps_image_read_bytes(input, bytes, 1, error));
            const bool is_run = bytes[0] > RUN;
            const size_t num = is_run ? bytes[0] - (size_t)RUN : bytes[0];
            if (num == 0 || num > width - x) {
                return fail_run(input, error);
            }
            PS_TRY(ps_image_read_bytes(input, bytes, is_run ? 1 : num, error));
            for (size_t i = 0; i < num; i++) {
                row[RGBE * x++ + component] = bytes[is_run ? 0 : i];
            }
        }
    }
    return PSPEC_OK;
}

/* Whole pixels; 1, 1, 1, n repeats the one before n times, and 256 n times after another such. */
static pspec_status read_flat(ps_input *input, unsigned char *row, size_t width, size_t begin,
                              ps_error *error) {
    unsigned shift = 0;
    for (size_t x = begin; x < width;) {
        unsigned char *const own = row + RGBE * x;
        PS_TRY(ps_image_read_bytes(input, own, RGBE, error));
        if (!(own[RED] == 1 && own[GREEN] == 1 && own[BLUE] == 1)) {
            shift = 0;
            x++;
            continue;
        }
        const size_t num = shift < 32 ? (size_t)own[EXPONENT] << shift : width;
        if (x == 0 || num > width - x) {
            return fail_run(input, error);
        }
        for (size_t i = 0; i < num; i++) {
            memcpy(row + RGBE * (x + i), row + RGBE * (x - 1), RGBE);
        }
        x += num;
        shift += 8;
    }
    return PSPEC_OK;
}

/* 2, 2 and the width stand before components; rows that short or long have none. */
static pspec_status read_row(ps_input *input, unsigned char *row, size_t width, ps_error *error) {
    const size_t least = 8;
    const size_t most = 0x7fff;
    PS_TRY(ps_image_read_bytes(input, row, RGBE, error));
    if (width < least || width > most || row[0] != 2 || row[1] != 2 || row[2] >= 128) {
        const bool is_run = row[RED] == 1 && row[GREEN] == 1 && row[BLUE] == 1;
        return is_run ? fail_run(input, error) : read_flat(input, row, width, 1, error);
    }
    return ((size_t)row[2] << 8 | row[3]) == width
               ? read_components(input, row, width, error)
               : ps_fail(error, PSPEC_ERROR_INPUT, "%s: a row says that it has %u pixels, not %zu",
                         input->name, (unsigned)row[2] << 8 | row[3], width);
}

static void decode(float *out, const unsigned char *row, size_t width, bool is_leftward,
                   double exposure) {
    const int bias = 128 + 8; /* of the exponent, and the bits of a mantissa */
    for (size_t x = 0; x < width; x++) {
        const unsigned char *const own = row + RGBE * (is_leftward ? width - 1 - x : x);
        const double unit = own[EXPONENT] == 0 ? 0 : ldexp(1, own[EXPONENT] - bias) / exposure;
        for (size_t i = 0; i < EXPONENT; i++) {
            out[EXPONENT * x + i] = (float)(own[i] * unit);
        }
    }
}

static pspec_status read_rows(ps_image_reader *reader, turning turned, double exposure,
                              ps_error *error) {
    const size_t width = reader->image.width;
    unsigned char *const row = malloc(RGBE * width);
    pspec_status status = PSPEC_OK;
    if (row == NULL) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for a row of an image");
    }
    for (size_t i = 0; i < reader->image.height; i++) {
        PS_TRY_OUT(status, read_row(reader->input, row, width, error));
        decode(reader->row, row, width, turned.is_leftward, exposure);
        PS_TRY_OUT(status, ps_image_give(reader, i, turned.is_upward, error));
    }
out:
    free(row);
    return status;
}

/* Runs of components have 16 pixels a byte at most. Those of the old kind have no such limit, but a
 * large image of almost nothing else is taken for a header that is wrong. */
static double least_bytes(double width, double height) {
    const double small = 1 << 20;
    const double per_byte = 256;
    return fmax(RGBE * height, (width * height - small) / per_byte);
}

pspec_status ps_image_read_hdr(ps_image_reader *reader, ps_error *error) {
    double exposure = 1;
    double width = 0;
    double height = 0;
    turning turned = {false, false};
    PS_TRY(read_header(reader->input, &exposure, error));
    PS_TRY(read_size(reader->input, &width, &height, &turned, error));
    reader->image.num_channels = EXPONENT;
    PS_TRY(ps_image_begin(reader, width, height, least_bytes(width, height), error));
    return read_rows(reader, turned, exposure, error);
}
