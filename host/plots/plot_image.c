/* The gnuplot script of the averaged periodogram on the whole square. */
#include "plots/plot_script.h"

#include <math.h>
#include <stdlib.h>

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

static void print_raster(const ps_plot_raster *raster, FILE *stream) {
    fputs("$image << EOD\n", stream);
    for (size_t row = 0; row < raster->size; row++) {
        for (size_t column = 0; column < raster->size; column++) {
            fprintf(stream, "%.4g ", tone(raster->power[row * raster->size + column]));
        }
        putc('\n', stream);
    }
    fputs("EOD\n", stream);
}

static void print_palette(double maximum, FILE *stream) {
    const double white = tone(1);
    const double step = pow(maximum, 1.0 / NUM_STEPS);
    fputs("set palette defined (", stream);
    for (size_t i = 0; i < NUM_STEPS; i++) {
        fprintf(stream, "%.6g '%s', ", white * (double)i / NUM_STEPS, below[i]);
    }
    fprintf(stream, "%.6g '%s'", white, neutral);
    for (size_t i = 0; i < NUM_STEPS; i++) {
        fprintf(stream, ", %.6g '%s'", tone(pow(step, (double)(i + 1))), above[i]);
    }
    fprintf(stream, ")\nset cbrange [0:%.6g]\n", tone(maximum));
}

/* Is there room for a tick beside that of white noise, which is always there, and the last one? */
static bool has_room(double at, double last, double closest) {
    return at == tone(1) || ((last < 0 || at - last >= closest) && fabs(at - tone(1)) >= closest);
}

/* Powers at the ticks of the colour box, thinned to what the scale holds. */
static void print_colour_ticks(double maximum, FILE *stream) {
    static const double ticks[] = {0,  0.01, 0.1, 0.3, 1,   2,   4,   8,
                                   20, 50,   100, 300, 1e3, 1e4, 1e5, 1e6};
    const double closest = tone(maximum) / 14;
    double last = -1;
    fputs("set cbtics (", stream);
    for (size_t i = 0; i < sizeof ticks / sizeof ticks[0]; i++) {
        const double at = tone(ticks[i]);
        if (at <= tone(maximum) && has_room(at, last, closest)) {
            fprintf(stream, "%s'%g' %.6g", last >= 0 ? ", " : "", ticks[i], at);
            last = at;
        }
    }
    fputs(")\n", stream);
}

static void print_panel(const ps_plot_raster *raster, const ps_script_box *where, FILE *stream) {
    const double extent = raster->pixel * (double)raster->size / 2;
    const double first = -raster->pixel * (double)(raster->size / 2);
    const double beside = 14; /* pixels, from the image to the colours, and their width */
    ps_script_print_margins(where, stream);
    fputs("set size ratio 1\n", stream);
    print_palette(raster->maximum, stream);
    fprintf(stream,
            "set colorbox user origin screen %.5f, screen %.5f size screen %.5f, screen %.5f\n",
            (where->right + beside) / where->page_width, 1 - where->bottom / where->page_height,
            1.4 * beside / where->page_width, (where->bottom - where->top) / where->page_height);
    print_colour_ticks(raster->maximum, stream);
    fputs("set cblabel 'power' offset -0.6,0\nset xtics out nomirror\nset ytics out nomirror\n"
          "set xlabel 'normalized frequency k₁ N^{-1/2}' offset 0,0.2\n"
          "set ylabel 'normalized frequency k₂ N^{-1/2}' offset 1.2,0\n",
          stream);
    fprintf(stream, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", -extent, extent, -extent,
            extent);
    fprintf(stream, "plot $image matrix using (%.9g+$1*%.9g):(%.9g+$2*%.9g):3 with image notitle\n",
            first, raster->pixel, first, raster->pixel);
    fputs("unset label 1\nunset colorbox\nset size noratio\n", stream);
}

pspec_status ps_script_print_image(const ps_plot_image *image, const ps_script_box *where,
                                   FILE *stream, ps_error *error) {
    ps_plot_raster raster = {0};
    PS_TRY(ps_plot_raster_make(&raster, image, error));
    print_raster(&raster, stream);
    print_panel(&raster, where, stream);
    free(raster.power);
    return PSPEC_OK;
}
