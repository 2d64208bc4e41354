/* The gnuplot script of spectra: image, powers, and what stands below them. */
#include "plots/plot_script.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_BARS = 200 };

/* Viridis at steps of 1/8 (Smith and van der Walt, CC0): even steps look even. */
static const char viridis[] = "0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
                              "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725'";

/* Tone map as in PSA: small powers stay visible beside peaks. */
static double tone(double power) {
    return log2(1 + 0.25 * sqrt(fmax(power, 0)));
}

/* ---- data ---- */

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
    const ps_panel *curves;
    bool has_lower; /* a panel below the powers */
    const char *x_label, *y_label;
    double left, right, middle; /* of the curves; middle: between power and anisotropy */
} layout;

/* What the numbers of all curves lie in, those that are finite; most is not above least where there
 * are none. */
typedef struct range {
    double least, most;
} range;

static void widen(range *covered, double value) {
    if (isfinite(value)) {
        *covered = (range){fmin(covered->least, value), fmax(covered->most, value)};
    }
}

typedef double take_number(const ps_series *series, size_t bin);

static double take_frequency(const ps_series *series, size_t bin) {
    return series->x[bin];
}

/* With its bar. */
static double take_top(const ps_series *series, size_t bin) {
    return series->y[bin] + (isfinite(series->error[bin]) ? series->error[bin] : 0);
}

static double take_error(const ps_series *series, size_t bin) {
    return series->error[bin];
}

static double take_anisotropy(const ps_series *series, size_t bin) {
    return series->anisotropy[bin];
}

static range find_range(const ps_panel *curves, take_number *take) {
    range all = {HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < curves->num_series; i++) {
        for (size_t bin = 0; bin < curves->series[i].num; bin++) {
            widen(&all, take(&curves->series[i], bin));
        }
    }
    return all;
}

static bool has_any(range all) {
    return all.most >= all.least;
}

/* In parts of the height of the panel: a line of the key, which must not lie on the curves, and the
 * most that it may have. */
static const double KEY_LINE = 0.075, MOST_KEY = 0.4;

static double find_top(const ps_series *curve) {
    double top = 0;
    for (size_t bin = 0; bin < curve->num; bin++) {
        const double power = take_top(curve, bin);
        top = isfinite(power) ? fmax(top, power) : top;
    }
    return top;
}

/* The largest power with its bar, but for curves that are louder than all others by more than LOUD
 * times, which would flatten these: peaks of lattices beside noise. White noise stays in sight. */
static double find_most(const ps_panel *curves) {
    const double loud = 5;
    const double least = 1.2;
    double most = least;
    bool is_wider = true;
    while (is_wider) { /* as long as another curve is not loud beside what is in sight */
        is_wider = false;
        for (size_t i = 0; i < curves->num_series; i++) {
            const double top = find_top(&curves->series[i]);
            if (top > most && (top <= loud * most || curves->num_series == 1)) {
                most = top;
                is_wider = true;
            }
        }
    }
    return most;
}

/* With room for the key. */
static double find_height(const ps_panel *curves) {
    const double num = (double)curves->num_series;
    return 1.05 * find_most(curves) / (1 - (num > 1 ? fmin(KEY_LINE * num, MOST_KEY) : 0));
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

/* No line goes through a single point. */
static const char *curve_style(const ps_series *curve) {
    return curve->num > 1 ? "lines" : "points pointtype 7 pointsize 0.6";
}

/* Bars while they can be told apart, none without a length, a band when there are too many. */
static void print_errors(const ps_series *curve, size_t number, FILE *stream) {
    const bool has_bars = curve->num <= MAX_BARS;
    fprintf(stream, "$data0_%zu using %s ", number,
            has_bars
                ? "1:2:($3 > 0 ? $3 : NaN) with yerrorbars pointtype 7 pointsize 0.25 linewidth 0.8"
                : "1:($2-$3):($2+$3) with filledcurves fillstyle transparent solid 0.3 noborder");
    ps_script_print_colour(curve->kind, stream);
    fputs(" notitle, ", stream);
}

/* All curves once more: of these columns, and in this style unless each has its own. */
static void print_curves(const layout *where, const char *columns, const char *style,
                         FILE *stream) {
    for (size_t i = 0; i < where->curves->num_series; i++) {
        const ps_series *const curve = &where->curves->series[i];
        fprintf(stream, "%s$data0_%zu using %s with %s linewidth 1.2 ", i > 0 ? ", " : "", i,
                columns, style != NULL ? style : curve_style(curve));
        ps_script_print_style(curve->kind, stream);
        fputs(" notitle", stream);
    }
}

/* Profiles below and above as thin dashes, the fit as a thin black line. */
static void print_profiles(const ps_panel *curves, FILE *stream) {
    for (size_t i = 0; i < curves->num_series; i++) {
        const ps_series *const curve = &curves->series[i];
        for (int column = 5; curve->low != NULL && curve->high != NULL && column <= 6; column++) {
            fprintf(stream, ", $data0_%zu using 1:($%d > 0 ? $%d : NaN) with lines ", i, column,
                    column);
            ps_script_print_colour(curve->kind, stream);
            fputs(" linewidth 1 dashtype 3 notitle", stream);
        }
        if (curve->fit != NULL) {
            fprintf(stream,
                    ", $data0_%zu using 1:($7 > 0 ? $7 : NaN) with lines linecolor rgb '#000000' "
                    "linewidth 1 notitle",
                    i);
        }
    }
    putc('\n', stream);
}

static const char key[] = "set key top right opaque Left reverse width -1 box linecolor '#c0c0c0' "
                          "samplen 2 noenhanced\n";

/* Panels with the same axis say what it is once, at the bottom. */
static void print_x_label(const layout *where, bool is_bottom, FILE *stream) {
    if (is_bottom) {
        fprintf(stream, "set format x '%%g'\nset xlabel '%s'\n", where->x_label);
    } else {
        fputs("set format x ''\nunset xlabel\n", stream);
    }
}

/* Does a curve go beyond what is shown, though nobody asked for that? */
static bool is_cut(const ps_figure *figure, const ps_series *curve) {
    return !figure->is_log_y && !figure->axes.has_y && find_top(curve) > find_most(figure->panels);
}

static void print_power_panel(const ps_figure *figure, const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    const double most = find_range(curves, take_frequency).most;
    fprintf(stream,
            "set lmargin at screen %g\nset rmargin at screen %g\n"
            "set bmargin at screen %g\nset tmargin at screen 0.92\n",
            where->left, where->right, where->has_lower ? where->middle + 0.015 : 0.10);
    fputs(ps_script_ticks, stream);
    if (!figure->is_log_x) {
        fprintf(stream, "set xrange [0:%.9g]\n", most > 0 ? most : 1);
    }
    if (!figure->is_log_y) {
        fprintf(stream, "set yrange [0:%.9g]\n", find_height(curves));
    }
    ps_script_print_scale("x", figure->is_log_x, stream);
    ps_script_print_scale("y", figure->is_log_y, stream);
    ps_script_print_asked(figure, stream);
    print_x_label(where, !where->has_lower || figure->on_sphere, stream);
    fprintf(stream, "set ylabel '%s%s' offset 1,0\n", where->y_label,
            has_any(find_range(curves, take_error)) ? " ± standard error" : "");
    fputs(curves->num_series > 1 ? key : "unset key\n", stream);
    fputs("set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead back linecolor '#707070' "
          "linewidth 1\nplot ",
          stream);
    for (size_t i = 0; i < curves->num_series; i++) {
        const ps_series *const curve = &curves->series[i];
        print_errors(curve, i, stream);
        fprintf(stream, "$data0_%zu using 1:2 with %s linewidth 1.6 ", i, curve_style(curve));
        ps_script_print_style(curve->kind, stream);
        fputs(" title ", stream);
        ps_script_print_text(curve->label, stream);
        if (is_cut(figure, curve)) {
            fprintf(stream, ".\" (to %.3g)\"", find_top(curve));
        }
        fputs(i + 1 < curves->num_series ? ", " : "", stream);
    }
    print_profiles(curves, stream);
    fputs("unset arrow 1\nunset label 1\n", stream);
    if (figure->is_log_y) {
        fputs("unset logscale y\nset format y '%g'\n", stream);
    }
}

/* Few enough ticks for a low panel: a step of 1, 2 or 5 times a power of ten. */
static double find_tick_step(const ps_figure *figure) {
    const double most_ticks = 6;
    range all = find_range(figure->panels, take_anisotropy);
    widen(&all, figure->noise_level_db);
    const double least = all.most > all.least ? (all.most - all.least) / most_ticks : 1;
    const double unit = pow(10, floor(log10(least)));
    return unit * (least <= unit ? 1 : least <= 2 * unit ? 2 : least <= 5 * unit ? 5 : 10);
}

static void print_anisotropy_panel(const ps_figure *figure, const layout *where, FILE *stream) {
    fprintf(stream, "set bmargin at screen 0.10\nset tmargin at screen %g\n",
            where->middle - 0.015);
    print_x_label(where, true, stream);
    fprintf(stream,
            "set ylabel 'anisotropy / dB' offset 0,0\nset yrange [*:*]\nset ytics %g in mirror\n",
            find_tick_step(figure));
    /* The key holds the noise level alone; without it, it would be an empty box. */
    const bool has_level = isfinite(figure->noise_level_db);
    fprintf(stream, "%splot ", has_level ? key : "unset key\n");
    if (has_level) {
        fprintf(stream,
                "%.9g with lines linecolor rgb '#707070' dashtype 2 linewidth 1.2 title "
                "'pure noise, %.1f dB', ",
                figure->noise_level_db, figure->noise_level_db + 0.0);
    }
    print_curves(where, "1:4", "lines", stream);
    putc('\n', stream);
}

/* Low degrees of good patterns have powers that a linear axis cannot show. */
static void print_logarithmic_panel(const layout *where, FILE *stream) {
    fprintf(stream, "set bmargin at screen 0.10\nset tmargin at screen %g\n",
            where->middle - 0.085); /* room for the upper panel's labels */
    print_x_label(where, true, stream);
    fputs("set logscale xy\nset format y '10^{%T}'\nset ylabel 'power' offset 1,0\nunset key\n"
          "set xrange [*:*] noextend\nset yrange [*:*]\nplot ",
          stream);
    print_curves(where, "1:($2 > 0 ? $2 : NaN)", NULL, stream);
    print_profiles(where->curves, stream);
}

static pspec_status print_image(const ps_plot_image *image, FILE *stream, ps_error *error) {
    ps_plot_raster raster = {0};
    PS_TRY(ps_plot_raster_make(&raster, image, error));
    print_raster(&raster, stream);
    print_image_panel(&raster, stream);
    free(raster.power);
    return PSPEC_OK;
}

pspec_status ps_script_print_spectra(const ps_figure *figure, FILE *stream, ps_error *error) {
    const bool on_sphere = figure->on_sphere;
    const layout where = {
        .curves = figure->panels,
        .has_lower = on_sphere || has_any(find_range(figure->panels, take_anisotropy)),
        .x_label = on_sphere ? "normalized degree l N^{-1/2}" : "normalized frequency |k| N^{-1/d}",
        .y_label = on_sphere ? "power" : "radial mean power",
        .left = figure->image != NULL ? 0.605 : 0.085,
        .right = 0.985,
        .middle = on_sphere ? 0.48 : 0.38};
    if (figure->image != NULL) {
        PS_TRY(print_image(figure->image, stream, error));
    }
    print_power_panel(figure, &where, stream);
    if (on_sphere) {
        print_logarithmic_panel(&where, stream);
    } else if (where.has_lower) {
        print_anisotropy_panel(figure, &where, stream);
    }
    return PSPEC_OK;
}
