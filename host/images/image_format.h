/* What readers of formats of images share. Private to host/images. */
#ifndef PS_IMAGES_IMAGE_FORMAT_H
#define PS_IMAGES_IMAGE_FORMAT_H

#include "files/decimal.h"
#include "images/image.h"

typedef struct ps_image_format {
    const char *name;  /* for messages */
    const char *begin; /* first bytes of a file; several, separated by bars */
    /* Reads from these bytes on. NULL: refused with `instead`. */
    pspec_status (*read)(ps_image *, ps_input *, ps_error *);
    const char *instead; /* what to do about it */
} ps_image_format;

pspec_status ps_image_read_hdr(ps_image *out, ps_input *input, ps_error *error) PS_MUST_CHECK;
pspec_status ps_image_read_pfm(ps_image *out, ps_input *input, ps_error *error) PS_MUST_CHECK;

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
/* Looks at the size; the rest of the file must have least_bytes, where its length is known, and
 * then there is room for all pixels at once. */
pspec_status ps_image_make(ps_image *out, const ps_input *input, double width, double height,
                           double least_bytes, ps_error *error) PS_MUST_CHECK;
/* Row number y, in the order of the file, from 0 on: makes room for it unless there is, for a pipe
 * may announce what never comes. */
pspec_status ps_image_row(ps_image *image, size_t y, float **out, ps_error *error) PS_MUST_CHECK;
/* The rows from the last to the first. */
void ps_image_turn(ps_image *image);

#endif
