/* The gnuplot script of images: the averaged periodogram on the whole square, and pixels. */
#include "base/memory.h"
#include "plots/plot_script.h"

#include <math.h>
#include <stdlib.h>

/* ---- pixels ---------------------------------------------------------------------------------- */

enum { MAX_PIXELS = 801 }; /* the panel has some 600 pixels; more would not be seen */

/* Half as many frequencies as there are pixels at most, so the middle pixel stays around DC. */
static size_t choose_block(size_t size) {
    size_t block = 1;
    while (size / block > MAX_PIXELS) {
        block += 2;
    }
    return block;
}

/* Numbers in rows; `without`: the index of one that does not count. */
typedef struct pixels {
    const double *values;
    size_t rows, columns, without;
} pixels;

/* Mean over a block, what is outside the image left out; 0 where nothing is left. */
static double average_block(const pixels *image, ptrdiff_t first_row, ptrdiff_t first_column,
                            size_t block) {
    const ptrdiff_t rows = (ptrdiff_t)image->rows;
    const ptrdiff_t columns = (ptrdiff_t)image->columns;
    double sum = 0;
    size_t count = 0;
    for (ptrdiff_t i = first_row; i < first_row + (ptrdiff_t)block; i++) {
        for (ptrdiff_t j = first_column; j < first_column + (ptrdiff_t)block; j++) {
            const bool is_inside = i >= 0 && j >= 0 && i < rows && j < columns;
            if (is_inside && (size_t)(i * columns + j) != image->without) {
                sum += image->values[i * columns + j];
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
static pspec_status choose_maximum(ps_script_raster *out, ps_error *error) {
    const size_t count = out->size * out->size;
    double *sorted = NULL;
    PS_TRY(PS_NEW(&sorted, count, "picture", error));
    size_t num_finite = 0;
    for (size_t i = 0; i < count; i++) {
        if (isfinite(out->power[i])) {
            sorted[num_finite++] = out->power[i];
        }
    }
    qsort(sorted, num_finite, sizeof *sorted, compare_doubles);
    const double high = num_finite > 0 ? sorted[num_finite - 1 - num_finite / 1000] : 0;
    out->maximum = fmax(high, 2);
    free(sorted);
    return PSPEC_OK;
}

/* Blocks averaged until they fit the panel, DC left out, transposed so that x_1 runs to the right.
 */
pspec_status ps_script_make_raster(ps_script_raster *out, ps_pool *memory,
                                   const ps_plot_image *image, ps_error *error) {
    const size_t block = choose_block(image->size);
    const ptrdiff_t half_image = (ptrdiff_t)(image->size / 2);
    const ptrdiff_t half = (half_image + (ptrdiff_t)(block / 2)) / (ptrdiff_t)block;
    const size_t size = 2 * (size_t)half + 1;
    *out = (ps_script_raster){.size = size,
                              .pixel = (double)block / image->unit,
                              .maximum = image->maximum,
                              .in_decibels = image->in_decibels};
    PS_TRY(PS_POOL_NEW(memory, &out->power, size * size, "picture", error));
    const ptrdiff_t first = half_image - (ptrdiff_t)(block / 2) - half * (ptrdiff_t)block;
    const size_t dc = image->size * image->size / 2;
    const pixels all = {image->power, image->size, image->size, dc};
    for (size_t row = 0; row < size; row++) {
        for (size_t column = 0; column < size; column++) {
            const ptrdiff_t k_1 = first + (ptrdiff_t)(column * block);
            const ptrdiff_t k_2 = first + (ptrdiff_t)(row * block);
            out->power[row * size + column] = average_block(&all, k_1, k_2, block);
        }
    }
    return image->maximum > 0 ? PSPEC_OK : choose_maximum(out, error);
}

pspec_status ps_plot_find_maximum(double *out, const ps_plot_image *image, ps_error *error) {
    ps_script_raster found = {0};
    ps_pool memory = {0};
    ps_plot_image own = *image;
    own.maximum = 0;
    const pspec_status status = ps_script_make_raster(&found, &memory, &own, error);
    *out = found.maximum;
    ps_pool_free(&memory);
    return status;
}

/* ---- colours --------------------------------------------------------------------------------- */

/* Blue below white noise and orange above it, as dark at one end as at the other; white noise, 1,
 * is nearly white. Steps are even on the scale of the tone map below it, and of the logarithm above
 * it, so that noise is seen beside peaks. */
static const char *const below[] = {"#0b2545", "#1f5f99", "#7fb2d6"};
static const char neutral[] = "#f4f2ee";
static const char *const above[] = {"#f0b27a", "#c8601e", "#5c1f0a"};
enum { NUM_STEPS = sizeof below / sizeof below[0] };

/* Tone map as in PSA: small powers stay visible beside peaks. */
static double tone(double power) {
    return log2(1 + 0.25 * sqrt(fmax(power, 0)));
}

static double decibels(double power) {
    return 10 * log10(power);
}

/* Below this power nothing is told apart: DC, which is left out, and zeros of lattices. */
static const double LEAST_POWER = 1e-4;

static void print_raster(ps_text *out, const ps_script_raster *own) {
    ps_text_append(out, "$image << EOD\n");
    for (size_t row = 0; row < own->size; row++) {
        for (size_t column = 0; column < own->size; column++) {
            const double power = own->power[row * own->size + column];
            ps_text_append(out, "%.4g ",
                           own->in_decibels ? decibels(fmax(power, LEAST_POWER)) : tone(power));
        }
        ps_text_append(out, "\n");
    }
    ps_text_append(out, "EOD\n");
}

static void print_palette(ps_text *out, double maximum) {
    const double white = tone(1);
    const double step = pow(maximum, 1.0 / NUM_STEPS);
    ps_text_append(out, "set palette defined (");
    for (size_t i = 0; i < NUM_STEPS; i++) {
        ps_text_append(out, "%.6g '%s', ", white * (double)i / NUM_STEPS, below[i]);
    }
    ps_text_append(out, "%.6g '%s'", white, neutral);
    for (size_t i = 0; i < NUM_STEPS; i++) {
        ps_text_append(out, ", %.6g '%s'", tone(pow(step, (double)(i + 1))), above[i]);
    }
    ps_text_append(out, ")\nset cbrange [0:%.6g]\n", tone(maximum));
}

/* The same colours, with white noise at 0 dB; steps are even. */
static void print_decibels(ps_text *out, double maximum) {
    const double lowest = decibels(LEAST_POWER);
    const double highest = decibels(maximum);
    ps_text_append(out, "set palette defined (");
    for (size_t i = 0; i < NUM_STEPS; i++) {
        ps_text_append(out, "%.6g '%s', ", lowest * (1 - (double)i / NUM_STEPS), below[i]);
    }
    ps_text_append(out, "0 '%s'", neutral);
    for (size_t i = 0; i < NUM_STEPS; i++) {
        ps_text_append(out, ", %.6g '%s'", highest * (double)(i + 1) / NUM_STEPS, above[i]);
    }
    ps_text_append(out,
                   ")\nset cbrange [%.6g:%.6g]\nset cbtics 10\nset cblabel 'power in dB' "
                   "offset -0.6,0\n",
                   lowest, highest);
}

/* Is there room for a tick beside that of white noise, which is always there, and the last one? */
static bool has_room(double at, double last, double closest) {
    return at == tone(1) || ((last < 0 || at - last >= closest) && fabs(at - tone(1)) >= closest);
}

/* Powers at the ticks of the colour box, thinned to what the scale holds. */
static void print_colour_ticks(ps_text *out, double maximum) {
    static const double ticks[] = {0,  0.01, 0.1, 0.3, 1,   2,   4,   8,
                                   20, 50,   100, 300, 1e3, 1e4, 1e5, 1e6};
    const double closest = tone(maximum) / 14;
    double last = -1;
    ps_text_append(out, "set cbtics (");
    for (size_t i = 0; i < sizeof ticks / sizeof ticks[0]; i++) {
        const double at = tone(ticks[i]);
        if (at <= tone(maximum) && has_room(at, last, closest)) {
            ps_text_append(out, "%s'%g' %.6g", last >= 0 ? ", " : "", ticks[i], at);
            last = at;
        }
    }
    ps_text_append(out, ")\n");
}

void ps_script_print_image(ps_text *out, const ps_script_panel *panel) {
    const ps_script_raster *const own = &panel->raster;
    const ps_script_box *const where = &panel->where;
    const double extent = own->pixel * (double)own->size / 2;
    const double first = -own->pixel * (double)(own->size / 2);
    const double beside = 14; /* pixels, from the image to the colours, and their width */
    print_raster(out, own);
    ps_text_append(out, "set size ratio 1\n");
    if (own->in_decibels) {
        print_decibels(out, own->maximum);
    } else {
        print_palette(out, own->maximum);
        print_colour_ticks(out, own->maximum);
        ps_text_append(out, "set cblabel 'power' offset -0.6,0\n");
    }
    ps_text_append(
        out, "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
        (where->right + beside) / where->page_width, 1 - where->bottom / where->page_height,
        1.4 * beside / where->page_width, (where->bottom - where->top) / where->page_height);
    ps_text_append(out, "set xtics out nomirror\nset ytics out nomirror\n"
                        "set xlabel 'normalized frequency k₁ N^{-1/2}' offset 0,0.2\n"
                        "set ylabel 'normalized frequency k₂ N^{-1/2}' offset 1.2,0\n");
    ps_text_append(out, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", -extent, extent,
                   -extent, extent);
    ps_text_append(out,
                   "plot $image matrix using (%.9g+$1*%.9g):(%.9g+$2*%.9g):3 with image notitle",
                   first, own->pixel, first, own->pixel);
}

/* ---- pixels as they are ---------------------------------------------------------------------- */

enum { MOST_SHOWN = 600, WHITE = 255 }; /* more would not be seen in panels of that width */

static pixels pixels_of(const ps_series *series) {
    return (pixels){series->y, series->num / series->columns, series->columns, SIZE_MAX};
}

/* Pixels along a side of a block that is shown as one. */
static size_t block_of(const pixels *image) {
    const size_t most = image->rows > image->columns ? image->rows : image->columns;
    return (most + MOST_SHOWN - 1) / MOST_SHOWN;
}

/* As bright as screens show it. */
static double brightness(const ps_frame *frame, double mean) {
    const double gamma = 2.2;
    const double share = (mean - frame->first) / (frame->last - frame->first);
    return round(WHITE * pow(fmin(1, fmax(0, share)), 1 / gamma));
}

/* gnuplot finds the size of pixels in their distances, and draws nothing of one row or column:
 * these are there twice. */
static size_t times(size_t num, size_t block) {
    return num <= block ? 2 : 1;
}

/* The place of an index: where there is one row twice, halves of a pixel. */
static const char *place(size_t num, size_t block, bool is_row) {
    return times(num, block) == 1 ? (is_row ? "2" : "1") : is_row ? "($2/2-.25)" : "($1/2-.25)";
}

static void print_row(ps_text *out, const ps_frame *frame, const pixels *image, size_t row) {
    const size_t block = block_of(image);
    for (size_t j = 0; j < image->columns; j += block) {
        const double mean = average_block(image, (ptrdiff_t)row, (ptrdiff_t)j, block);
        const double shown = frame->form == PS_FRAME_LIGHT ? brightness(frame, mean) : mean;
        for (size_t i = 0; i < times(image->columns, block); i++) {
            ps_text_append(out, " %.6g", shown);
        }
    }
    ps_text_append(out, "\n");
}

void ps_script_print_pixel_data(ps_text *out, const ps_panel *panel) {
    const pixels image = pixels_of(&panel->series[0]);
    const size_t block = block_of(&image);
    for (size_t i = 0; i < image.rows; i += block) {
        for (size_t k = 0; k < times(image.rows, block); k++) {
            print_row(out, &panel->frame, &image, i);
        }
    }
}

/* Grey, or, where they are signed, of two colours; with a scale below. */
static void print_scale(ps_text *out, const ps_frame *frame, const ps_script_box *where) {
    const double gap = 12; /* pixels, from the image to the colours, and their height */
    const bool is_signed = frame->first < 0;
    ps_text_append(out, "set palette defined (0 '%s', 1 '%s', 2 '%s')\nset cbrange [%.6g:%.6g]\n",
                   is_signed ? below[1] : "#000000", is_signed ? neutral : "#808080",
                   is_signed ? above[1] : "#ffffff", frame->first, frame->last);
    ps_text_append(out,
                   "set colorbox horizontal user origin screen %.5f, screen %.5f size screen "
                   "%.5f, screen %.5f\nset cbtics offset 0,0.5\n",
                   where->left / where->page_width,
                   1 - (where->bottom + 2 * gap) / where->page_height,
                   (where->right - where->left) / where->page_width, gap / where->page_height);
}

/* Pixels are squares, in the middle of the panel. */
void ps_script_print_pixels(ps_text *out, const ps_script_panel *panel, size_t number) {
    const ps_frame *const frame = &panel->panel.frame;
    const ps_script_box *const where = &panel->where;
    const pixels image = pixels_of(&panel->panel.series[0]);
    const size_t block = block_of(&image);
    const double columns = ceil((double)image.columns / (double)block);
    const double rows = ceil((double)image.rows / (double)block);
    const double width = where->right - where->left;
    const double height = where->bottom - where->top;
    const double unit = fmax(columns / width, rows / height); /* pixels of the image in one */
    ps_text_append(out, "unset border\nunset xtics\nunset ytics\n");
    if (frame->form == PS_FRAME_LIGHT) {
        ps_text_append(out, "unset colorbox\nset palette gray\nset cbrange [0:%d]\n", WHITE);
    } else {
        print_scale(out, frame, where);
    }
    const double x = (columns - 1) / 2;
    const double y = (rows - 1) / 2;
    ps_text_append(out, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", x - unit * width / 2,
                   x + unit * width / 2, y + unit * height / 2, y - unit * height / 2);
    ps_text_append(out, "plot $data%zu_0 matrix using %s:%s:3 with image notitle", number,
                   place(image.columns, block, false), place(image.rows, block, true));
}
