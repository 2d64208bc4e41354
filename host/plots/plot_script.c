#include "plots/plot_script.h"

#include "base/text.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Okabe and Ito's colours, which the colour-blind can tell apart; beyond them dashes change. */
static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                      "#E69F00", "#56B4E9", "#000000"};
enum { NUM_COLOURS = sizeof colours / sizeof colours[0], MAX_BARS = 200 };

/* Viridis at steps of 1/8 (Smith and van der Walt, CC0): even steps look even. */
static const char viridis[] = "0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
                              "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725'";

/* Tone map as in PSA: small powers stay visible beside peaks. */
static double tone(double power) {
    return log2(1 + 0.25 * sqrt(fmax(power, 0)));
}

/* A text constant of gnuplot. Only letters, blanks and whole characters beyond ASCII stand as they are: everything else is
 * an octal number, so that no quote, backslash or backtick is left to be understood; digits, too, which would go on with
 * the number before them. What no text has (control characters, bytes that are not UTF-8) would spoil lines and XML. */
void ps_plot_print_text(const char *text, FILE *stream) {
    putc('"', stream);
    while (*text != '\0') {
        const unsigned char byte = (unsigned char)*text;
        const size_t length = ps_text_character(text);
        if (length > 1) {
            fwrite(text, 1, length, stream);
        } else if (length == 0) {
            fputs(byte < 0x80 ? " " : PS_TEXT_UNKNOWN, stream);
        } else if (isalpha(byte) || byte == ' ') {
            putc(byte, stream);
        } else {
            fprintf(stream, "\\%03o", byte);
        }
        text += length > 0 ? length : 1;
    }
    putc('"', stream);
}

void ps_plot_print_value(double value, FILE *stream) {
    if (isfinite(value)) {
        fprintf(stream, " %.9g", value);
    } else {
        fputs(" NaN", stream);
    }
}

/* ---- data ---- */

static void print_curve(const ps_plot_curve *curve, size_t number, FILE *stream) {
    fprintf(stream, "$curve%zu << EOD\n", number);
    for (size_t i = 0; i < curve->num_bins; i++) {
        ps_plot_print_value(curve->normalized_frequency[i], stream);
        ps_plot_print_value(curve->power[i], stream);
        ps_plot_print_value(curve->standard_error[i], stream);
        ps_plot_print_value(curve->anisotropy_db[i], stream);
        putc('\n', stream);
    }
    fputs("EOD\n", stream);
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

/* ---- panels ---- */

/* Where things are: fractions of the page. */
typedef struct layout {
    bool has_image, has_lower; /* a panel below the powers */
    const char *x_label, *y_label;
    double left, right, middle; /* of the curves; middle: between power and anisotropy */
} layout;

static bool any_finite(const ps_plot *plot, bool of_errors) {
    for (size_t i = 0; i < plot->num_curves; i++) {
        const ps_plot_curve *const curve = &plot->curves[i];
        const double *const values = of_errors ? curve->standard_error : curve->anisotropy_db;
        for (size_t bin = 0; bin < curve->num_bins; bin++) {
            if (isfinite(values[bin])) {
                return true;
            }
        }
    }
    return false;
}

static double find_range(const ps_plot *plot) {
    double range = 0;
    for (size_t i = 0; i < plot->num_curves; i++) {
        for (size_t bin = 0; bin < plot->curves[i].num_bins; bin++) {
            range = fmax(range, plot->curves[i].normalized_frequency[bin]);
        }
    }
    return range > 0 ? range : 1;
}

/* Of the height of the panel: a line of the key, which must not lie on the curves, and the most that it may have. */
static const double KEY_LINE = 0.075, MOST_KEY = 0.4;

/* The largest power with its bar; white noise stays in sight, and there is room for the key. */
static double find_height(const ps_plot *plot) {
    double height = 1.2;
    for (size_t i = 0; i < plot->num_curves; i++) {
        const ps_plot_curve *const curve = &plot->curves[i];
        for (size_t bin = 0; bin < curve->num_bins; bin++) {
            const double bar =
                isfinite(curve->standard_error[bin]) ? curve->standard_error[bin] : 0;
            const double top = curve->power[bin] + bar;
            height = isfinite(top) ? fmax(height, top) : height;
        }
    }
    const double key =
        plot->num_curves > 1 ? fmin(KEY_LINE * (double)plot->num_curves, MOST_KEY) : 0;
    return 1.05 * height / (1 - key);
}

void ps_plot_print_page(const char *title, const char *terminal, int width, int height,
                        FILE *stream) {
    if (strcmp(terminal, "pdfcairo") == 0) { /* in inches; 100 pixels each */
        fprintf(stream, "set terminal pdfcairo enhanced color size %gin,%gin font 'Sans,11.5'\n",
                width / 100.0, height / 100.0);
    } else {
        fprintf(stream, "set terminal %s enhanced size %d,%d background '#ffffff' font '%s'\n",
                terminal, width, height,
                strcmp(terminal, "svg") == 0 ? "sans-serif,16" : "Sans,12");
    }
    fputs("set encoding utf8\n", stream);
    fputs("set border linewidth 0.8 linecolor '#404040'\nset tics textcolor '#202020'\n", stream);
    fputs("set multiplot\nset label 1 ", stream);
    ps_plot_print_text(title != NULL ? title : "", stream);
    fprintf(stream, " at screen 0.5,%.4g center noenhanced font ',%d'\n", 1 - 26.6 / height,
            strcmp(terminal, "svg") == 0 ? 20 : 15); /* svg counts pixels, the others points */
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
        if (at <= tone(maximum) && (last < 0 || at - last >= closest)) {
            fprintf(stream, "%s'%g' %.6g", last >= 0 ? ", " : "", ticks[i], at);
            last = at;
        }
    }
    fputs(")\n", stream);
}

static void print_image_panel(const ps_plot_raster *raster, FILE *stream) {
    const double extent = raster->pixel * (double)raster->size / 2;
    const double first = -raster->pixel * (double)(raster->size / 2);
    fputs("set lmargin at screen 0.055\nset rmargin at screen 0.465\n"
          "set bmargin at screen 0.10\nset tmargin at screen 0.92\nset size ratio 1\n",
          stream);
    fprintf(stream, "set palette defined (%s)\nset cbrange [0:%.6g]\n", viridis,
            tone(raster->maximum));
    fputs("set colorbox user origin screen 0.475, screen 0.10 size screen 0.014, screen 0.82\n",
          stream);
    print_colour_ticks(raster->maximum, stream);
    fputs("set cblabel 'power' offset -0.6,0\nset xtics out nomirror\nset ytics out nomirror\n"
          "set xlabel 'normalized frequency k₁ N^{-1/2}'\n"
          "set ylabel 'normalized frequency k₂ N^{-1/2}' offset 1,0\n",
          stream);
    fprintf(stream, "set xrange [%.9g:%.9g]\nset yrange [%.9g:%.9g]\n", -extent, extent, -extent,
            extent);
    fprintf(stream, "plot $image matrix using (%.9g+$1*%.9g):(%.9g+$2*%.9g):3 with image notitle\n",
            first, raster->pixel, first, raster->pixel);
    fputs("unset label 1\nunset colorbox\nset size noratio\n", stream);
}

/* Colour and dashes of a curve. */
void ps_plot_print_style(size_t number, FILE *stream) {
    fprintf(stream, "linecolor rgb '%s' dashtype %zu", colours[number % NUM_COLOURS],
            number / NUM_COLOURS % 4 + 1);
}

/* No line goes through a single point. */
static const char *curve_style(const ps_plot_curve *curve) {
    return curve->num_bins > 1 ? "lines" : "points pointtype 7 pointsize 0.6";
}

/* Bars while they can be told apart, none without a length, a band when there are too many. */
static void print_errors(const ps_plot_curve *curve, size_t number, FILE *stream) {
    if (curve->num_bins <= MAX_BARS) {
        fprintf(stream,
                "$curve%zu using 1:2:($3 > 0 ? $3 : NaN) with yerrorbars pointtype 7 pointsize "
                "0.25 linewidth 0.8 linecolor rgb '%s' notitle, ",
                number, colours[number % NUM_COLOURS]);
    } else {
        fprintf(stream,
                "$curve%zu using 1:($2-$3):($2+$3) with filledcurves fillstyle transparent solid "
                "0.3 noborder linecolor rgb '%s' notitle, ",
                number, colours[number % NUM_COLOURS]);
    }
}

/* Panels with the same axis say what it is once, at the bottom. */
static void print_x_label(const layout *where, bool is_bottom, FILE *stream) {
    if (is_bottom) {
        fprintf(stream, "set format x '%%g'\nset xlabel '%s'\n", where->x_label);
    } else {
        fputs("set format x ''\nunset xlabel\n", stream);
    }
}

static void print_power_panel(const ps_plot *plot, const layout *where, FILE *stream) {
    fprintf(stream,
            "set lmargin at screen %g\nset rmargin at screen %g\n"
            "set bmargin at screen %g\nset tmargin at screen 0.92\n",
            where->left, where->right, where->has_lower ? where->middle + 0.015 : 0.10);
    fputs("set xtics in mirror\nset ytics in mirror\nset grid linecolor '#d8d8d8' linewidth 0.8 "
          "dashtype solid\n",
          stream);
    fprintf(stream, "set xrange [0:%.9g]\nset yrange [0:%.9g]\n", find_range(plot),
            find_height(plot));
    print_x_label(where, !where->has_lower || plot->on_sphere, stream);
    fprintf(stream, "set ylabel '%s%s' offset 1,0\n", where->y_label,
            any_finite(plot, true) ? " ± standard error" : "");
    fputs(plot->num_curves > 1 ? "set key top right opaque Left reverse width -1 box linecolor "
                                 "'#c0c0c0' samplen 2 noenhanced\n"
                               : "unset key\n",
          stream);
    fputs("set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead back linecolor '#707070' "
          "linewidth 1\nplot ",
          stream);
    for (size_t i = 0; i < plot->num_curves; i++) {
        print_errors(&plot->curves[i], i, stream);
        fprintf(stream, "$curve%zu using 1:2 with %s linewidth 1.6 ", i,
                curve_style(&plot->curves[i]));
        ps_plot_print_style(i, stream);
        fputs(" title ", stream);
        ps_plot_print_text(plot->curves[i].label != NULL ? plot->curves[i].label : "", stream);
        fputs(i + 1 < plot->num_curves ? ", " : "\n", stream);
    }
    fputs("unset arrow 1\nunset label 1\n", stream);
}

/* Few enough ticks for a low panel: a step of 1, 2 or 5 times a power of ten. */
static double find_tick_step(const ps_plot *plot) {
    const double most_ticks = 6;
    double low = isfinite(plot->noise_level_db) ? plot->noise_level_db : HUGE_VAL;
    double high = isfinite(plot->noise_level_db) ? plot->noise_level_db : -HUGE_VAL;
    for (size_t i = 0; i < plot->num_curves; i++) {
        for (size_t bin = 0; bin < plot->curves[i].num_bins; bin++) {
            const double value = plot->curves[i].anisotropy_db[bin];
            low = isfinite(value) ? fmin(low, value) : low;
            high = isfinite(value) ? fmax(high, value) : high;
        }
    }
    const double least = high > low ? (high - low) / most_ticks : 1;
    const double unit = pow(10, floor(log10(least)));
    return unit * (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10);
}

static void print_anisotropy_panel(const ps_plot *plot, const layout *where, FILE *stream) {
    fprintf(stream, "set bmargin at screen 0.10\nset tmargin at screen %g\n",
            where->middle - 0.015);
    print_x_label(where, true, stream);
    fprintf(stream,
            "set ylabel 'anisotropy / dB' offset 0,0\nset yrange [*:*]\nset ytics %g in mirror\n",
            find_tick_step(plot));
    /* The key holds the noise level alone; without it, it would be an empty box. */
    const bool has_level = isfinite(plot->noise_level_db);
    fputs(has_level ? "set key top right opaque Left reverse width -1 box linecolor '#c0c0c0' "
                      "samplen 2 noenhanced\nplot "
                    : "unset key\nplot ",
          stream);
    if (has_level) {
        fprintf(stream,
                "%.9g with lines linecolor rgb '#707070' dashtype 2 linewidth 1.2 title "
                "'pure noise, %.1f dB', ",
                plot->noise_level_db, plot->noise_level_db + 0.0);
    }
    for (size_t i = 0; i < plot->num_curves; i++) {
        fprintf(stream, "$curve%zu using 1:4 with lines linewidth 1.2 ", i);
        ps_plot_print_style(i, stream);
        fputs(i + 1 < plot->num_curves ? " notitle, " : " notitle\n", stream);
    }
}

/* Low degrees of good patterns have powers that a linear axis cannot show. */
static void print_logarithmic_panel(const ps_plot *plot, const layout *where, FILE *stream) {
    fprintf(stream, "set bmargin at screen 0.10\nset tmargin at screen %g\n",
            where->middle - 0.085); /* room for the upper panel's labels */
    print_x_label(where, true, stream);
    fputs("set logscale xy\nset format y '10^{%T}'\nset ylabel 'power' offset 1,0\nunset key\n"
          "set xrange [*:*] noextend\nset yrange [*:*]\nplot ",
          stream);
    for (size_t i = 0; i < plot->num_curves; i++) {
        fprintf(stream, "$curve%zu using 1:($2 > 0 ? $2 : NaN) with %s linewidth 1.2 ", i,
                curve_style(&plot->curves[i]));
        ps_plot_print_style(i, stream);
        fputs(i + 1 < plot->num_curves ? " notitle, " : " notitle\n", stream);
    }
}

pspec_status ps_plot_write_script(const ps_plot *plot, const char *terminal, FILE *stream,
                                  ps_error *error) {
    ps_plot_raster raster = {0};
    const bool has_image = plot->image != NULL && plot->image->power != NULL;
    const layout where = {.has_image = has_image,
                          .has_lower = plot->on_sphere || any_finite(plot, false),
                          .x_label = plot->on_sphere ? "normalized degree l N^{-1/2}"
                                                     : "normalized frequency |k| N^{-1/d}",
                          .y_label = plot->on_sphere ? "power" : "radial mean power",
                          .left = has_image ? 0.605 : 0.085,
                          .right = 0.985,
                          .middle = plot->on_sphere ? 0.48 : 0.38};
    ps_plot_print_page(plot->title, terminal, has_image ? 1400 : 1000, PS_PLOT_HEIGHT, stream);
    for (size_t i = 0; i < plot->num_curves; i++) {
        print_curve(&plot->curves[i], i, stream);
    }
    if (has_image) {
        PS_TRY(ps_plot_raster_make(&raster, plot->image, error));
        print_raster(&raster, stream);
        print_image_panel(&raster, stream);
        free(raster.power);
    }
    print_power_panel(plot, &where, stream);
    if (plot->on_sphere) {
        print_logarithmic_panel(plot, &where, stream);
    } else if (where.has_lower) {
        print_anisotropy_panel(plot, &where, stream);
    }
    fputs("unset multiplot\n", stream);
    return PSPEC_OK;
}
