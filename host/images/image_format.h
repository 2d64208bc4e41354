/* What readers of formats of images share. Private to host/images. */
#ifndef PS_IMAGES_IMAGE_FORMAT_H
#define PS_IMAGES_IMAGE_FORMAT_H

#include "files/decimal.h"
#include "images/image.h"

typedef struct ps_image_reader {
    ps_input *input;
    const ps_image_taker *taker;
    ps_image image;
    float *row; /* [width][num_channels], after ps_image_begin */
} ps_image_reader;

typedef struct ps_image_format {
    const char *name;  /* for messages */
    const char *begin; /* first bytes of a file; several, separated by bars */
    /* Reads from these bytes on. NULL: refused with `instead`. */
    pspec_status (*read)(ps_image_reader *, ps_error *);
    const char *instead; /* what to do about it */
} ps_image_format;

pspec_status ps_image_read_hdr(ps_image_reader *reader, ps_error *error) PS_MUST_CHECK;
pspec_status ps_image_read_pfm(ps_image_reader *reader, ps_error *error) PS_MUST_CHECK;

/* A line of a header without its end, with readable bytes behind it for ps_decimal_parse. */
enum {
    PS_IMAGE_LINE_BYTES = 256,
    PS_IMAGE_LINE_LETTERS = PS_IMAGE_LINE_BYTES - PS_DECIMAL_PADDING
};
pspec_status ps_image_read_line(ps_input *input, char line[PS_IMAGE_LINE_BYTES],
                                ps_error *error) PS_MUST_CHECK;
/* Exactly so many bytes. */
pspec_status ps_image_read_bytes(ps_input *input, void *out, size_t num,
                                 ps_error *error) PS_MUST_CHECK;
/* Looks at the size, which the rest of the file must have least_bytes for where its length is
 * known; the channels are there already. Then the taker begins, and there is room for a row. */
pspec_status ps_image_begin(ps_image_reader *reader, double width, double height,
                            double least_bytes, ps_error *error) PS_MUST_CHECK;
/* Hands over the row, which is number i in the order of the file. */
pspec_status ps_image_give(ps_image_reader *reader, size_t i, bool is_upward,
                           ps_error *error) PS_MUST_CHECK;

#endif
