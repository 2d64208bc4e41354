/* The gnuplot script of spectra: image, powers, and what stands below them. */
#include "plots/spectra_axes.h"

#include <string.h>

enum { MAX_BARS = 200 };

/* ---- where things are ------------------------------------------------------------------------ */

/* Pixels: of the image, with its numbers and colours; of the curves. */
enum {
    POINTS_WIDTH = 650,
    IMAGE_WIDTH = 770,
    CURVES_WIDTH = 630,
    TOP = 56,
    BOTTOM = 614,
    LEFT = 84,
    RIGHT = 18
};
enum { BETWEEN = 20, BETWEEN_ON_SPHERE = 70 }; /* panels with the same axis, and with their own */

typedef struct layout {
    const ps_figure *figure;
    const ps_panel *curves;
    bool has_lower; /* a panel below the powers */
    const char *x_label, *y_label;
    ps_script_box upper, lower, image, points;
} layout;

void ps_script_size_spectra(const ps_figure *figure, int *width, int *height) {
    *width = (figure->points != NULL ? POINTS_WIDTH : 0) +
             (figure->image != NULL ? IMAGE_WIDTH + CURVES_WIDTH : PS_SCRIPT_WIDTH);
    *height = PS_SCRIPT_HEIGHT;
}

int ps_script_title_left(const ps_figure *figure) {
    return figure->form == PS_FIGURE_SPECTRA && figure->points != NULL ? POINTS_WIDTH : 0;
}

/* The image is square; the lower panel has a third, on the sphere a half. */
static void place(layout *out) {
    const ps_figure *const figure = out->figure;
    const double share = figure->on_sphere ? 0.5 : 0.64;
    const double between = figure->on_sphere ? BETWEEN_ON_SPHERE : BETWEEN;
    int width = 0;
    int height = 0;
    ps_script_size_spectra(figure, &width, &height);
    const double image_left = (figure->points != NULL ? POINTS_WIDTH : 0) + LEFT;
    const double left = (figure->image != NULL ? IMAGE_WIDTH : 0) + image_left;
    const double side = BOTTOM - TOP;
    const double middle = TOP + share * (BOTTOM - TOP - between);
    out->upper =
        (ps_script_box){left, TOP, width - RIGHT, out->has_lower ? middle : BOTTOM, width, height};
    out->lower = (ps_script_box){left, middle + between, width - RIGHT, BOTTOM, width, height};
    out->image = (ps_script_box){image_left, TOP, image_left + side, BOTTOM, width, height};
    out->points = (ps_script_box){LEFT / 2, TOP, LEFT / 2 + side, BOTTOM, width, height};
}

static double height_of(const ps_script_box *where) {
    return where->bottom - where->top;
}

static ps_plot_span or_asked(ps_plot_span own, bool is_asked, const double *asked) {
    return is_asked ? (ps_plot_span){asked[0], asked[1]} : own;
}

/* ---- curves ---------------------------------------------------------------------------------- */

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
    const double thinner = 0.75;
    for (size_t i = 0; i < where->curves->num_series; i++) {
        const ps_series *const curve = &where->curves->series[i];
        fprintf(stream, "%s$data0_%zu using %s with %s linewidth %g ", i > 0 ? ", " : "", i,
                columns, style != NULL ? style : curve_style(curve),
                thinner * ps_script_line_width(where->figure, where->curves, i));
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

static size_t find_longest(const ps_panel *curves) {
    size_t longest = 0;
    for (size_t i = 0; i < curves->num_series; i++) {
        const char *const label = curves->series[i].label;
        const size_t length = label != NULL ? strlen(label) : 0;
        longest = length > longest ? length : longest;
    }
    return longest;
}

/* longest: of its labels, in letters; gnuplot makes the box by so many, but of one or two too
 * narrow. */
static void print_key(size_t longest, const ps_script_box *where, FILE *stream) {
    const int least = 3;
    const int length = longest < (size_t)least ? (int)longest : least + 1;
    fprintf(stream,
            "set key top right opaque Left reverse width %d box linecolor '#c0c0c0' samplen 2 "
            "maxrows %zu noenhanced\n",
            least - length, ps_spectra_key_rows(height_of(where)));
}

/* Scale, ticks and range of an axis. */
static void print_axis(const char *axis, bool is_log, ps_plot_span shown, FILE *stream) {
    fprintf(stream, "%sset logscale %s\n", is_log ? "" : "un", axis);
    if (is_log && shown.least > 0) {
        ps_script_print_log_ticks(axis, shown, stream);
    } else {
        fprintf(stream, "set format %s '%%g'\nset %stics in mirror autofreq\n", axis, axis);
    }
    ps_script_print_span(axis, shown, stream);
}

/* Panels with the same axis say what it is once, at the bottom. */
static void print_frequencies(const layout *where, bool is_bottom, FILE *stream) {
    const ps_figure *const figure = where->figure;
    const ps_plot_span own = ps_spectra_frequencies(figure, where->curves);
    print_axis("x", figure->is_log_x, or_asked(own, figure->axes.has_x, figure->axes.x), stream);
    if (is_bottom) {
        fprintf(stream, "set xlabel '%s' offset 0,0.2\n", where->x_label);
    } else {
        fputs("set format x ''\nunset xlabel\n", stream);
    }
}

/* A line at white noise, where it is in sight. */
static void print_white(ps_plot_span shown, FILE *stream) {
    if (shown.least < 1 && shown.most > 1) {
        fputs("set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead back linecolor "
              "'#707070' linewidth 1\n",
              stream);
    }
}

/* ---- panels ---------------------------------------------------------------------------------- */

/* Does a curve go beyond what is shown, though nobody asked for that? */
static bool is_cut(const ps_figure *figure, const ps_series *curve) {
    return !figure->is_log_y && !figure->axes.has_y &&
           ps_spectra_find_top(curve) > ps_spectra_find_most(figure->panels);
}

static void print_powers(const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    for (size_t i = 0; i < curves->num_series; i++) {
        print_errors(&curves->series[i], i, stream);
    }
    for (size_t i = 0; i < curves->num_series; i++) {
        const ps_series *const curve = &curves->series[i];
        fprintf(stream, "$data0_%zu using 1:2 with %s linewidth %g ", i, curve_style(curve),
                ps_script_line_width(where->figure, curves, i));
        ps_script_print_style(curve->kind, stream);
        fputs(" title ", stream);
        ps_script_print_text(curve->label, stream);
        if (is_cut(where->figure, curve)) {
            fprintf(stream, ".\" (to %.3g)\"", ps_spectra_find_top(curve));
        }
        fputs(i + 1 < curves->num_series ? ", " : "", stream);
    }
    print_profiles(curves, stream);
}

static void print_power_panel(const layout *where, FILE *stream) {
    const ps_figure *const figure = where->figure;
    const ps_panel *const curves = where->curves;
    const double key_part = ps_spectra_key_part(curves->num_series > 1 ? curves->num_series : 0,
                                                height_of(&where->upper));
    const ps_plot_span powers =
        or_asked(ps_spectra_powers(figure, curves, key_part), figure->axes.has_y, figure->axes.y);
    ps_script_print_margins(&where->upper, stream);
    fputs(ps_script_ticks, stream);
    print_axis("y", figure->is_log_y, powers, stream);
    print_frequencies(where, !where->has_lower || figure->on_sphere, stream);
    fprintf(stream, "set ylabel '%s%s' offset 1,0\n", where->y_label,
            ps_spectra_has(curves, ps_spectra_error) ? " ± standard error" : "");
    if (curves->num_series > 1) {
        print_key(find_longest(curves), &where->upper, stream);
    } else {
        fputs("unset key\n", stream);
    }
    print_white(powers, stream);
    fputs("plot ", stream);
    print_powers(where, stream);
    fputs("unset arrow 1\nunset label 1\n", stream);
}

/* ---- the lower panel ------------------------------------------------------------------------- */

/* Is it the first curve with its level? */
static bool is_first(const ps_panel *curves, size_t index) {
    const double realizations = curves->series[index].num_realizations;
    size_t i = 0;
    while (i < index && curves->series[i].num_realizations != realizations) {
        i++;
    }
    return i == index && realizations >= 2;
}

static size_t count_levels(const ps_panel *curves) {
    size_t num = 0;
    for (size_t i = 0; i < curves->num_series; i++) {
        num += is_first(curves, i);
    }
    return num;
}

/* One is grey, as it is of all curves; several have the colours of theirs. */
static void print_levels(const ps_panel *curves, FILE *stream) {
    const size_t num_levels = count_levels(curves);
    for (size_t i = 0; i < curves->num_series; i++) {
        if (!is_first(curves, i)) {
            continue;
        }
        const ps_series *const curve = &curves->series[i];
        fprintf(stream, "%.9g with lines dashtype 2 linewidth 1.2 ", ps_spectra_level(curve, 0));
        if (num_levels == 1) {
            fprintf(stream, "linecolor rgb '#707070' title 'pure noise, %.1f dB', ",
                    ps_spectra_level(curve, 0));
        } else {
            ps_script_print_colour(curve->kind, stream);
            fprintf(stream, " title 'pure noise of M = %.0f, %.1f dB', ", curve->num_realizations,
                    ps_spectra_level(curve, 0));
        }
    }
}

static void print_anisotropy_panel(const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    const ps_plot_span shown = ps_spectra_anisotropies(
        curves, ps_spectra_key_part(count_levels(curves), height_of(&where->lower)));
    ps_script_print_margins(&where->lower, stream);
    print_frequencies(where, true, stream);
    fprintf(stream,
            "unset logscale y\nset format y '%%g'\nset ylabel 'anisotropy / dB' offset 0,0\n"
            "set ytics %g in mirror\n",
            ps_script_tick_step(shown)); /* few enough for a low panel */
    ps_script_print_span("y", shown, stream);
    /* The key holds levels of noise alone; without them, it would be an empty box. */
    if (count_levels(curves) > 0) {
        print_key(strlen("pure noise"), &where->lower, stream);
    } else {
        fputs("unset key\n", stream);
    }
    fputs("plot ", stream);
    print_levels(curves, stream);
    print_curves(where, "1:4", "lines", stream);
    putc('\n', stream);
}

/* Low degrees of good patterns have powers that a linear axis cannot show. */
static void print_logarithmic_panel(const layout *where, FILE *stream) {
    ps_figure figure = *where->figure;
    layout own = *where;
    figure.is_log_x = figure.is_log_y = true;
    figure.axes = (ps_plot_axes){0};
    own.figure = &figure;
    ps_script_print_margins(&where->lower, stream);
    print_frequencies(&own, true, stream);
    print_axis("y", true, ps_spectra_powers(&figure, where->curves, 0), stream);
    fprintf(stream, "set ylabel '%s' offset 1,0\nunset key\nplot ", where->y_label);
    print_curves(&own, "1:($2 > 0 ? $2 : NaN)", NULL, stream);
    print_profiles(where->curves, stream);
}

pspec_status ps_script_print_spectra(const ps_figure *figure, const char *terminal, FILE *stream,
                                     ps_error *error) {
    const bool on_sphere = figure->on_sphere;
    layout where = {.figure = figure,
                    .curves = figure->panels,
                    .has_lower = on_sphere ? !(figure->is_log_x && figure->is_log_y)
                                           : ps_spectra_has(figure->panels, ps_spectra_anisotropy),
                    .x_label = on_sphere ? "normalized degree l N^{-1/2}"
                                         : "normalized frequency |k| N^{-1/d}",
                    .y_label = figure->y_label != NULL ? figure->y_label : ""};
    place(&where);
    if (figure->points != NULL) {
        ps_script_print_beside(&(ps_script_points){figure->points, &figure->frames[0], where.points,
                                                   "$points", terminal},
                               stream);
    }
    if (figure->image != NULL) {
        PS_TRY(ps_script_print_image(figure->image, &where.image, stream, error));
    }
    print_power_panel(&where, stream);
    if (where.has_lower && on_sphere) {
        print_logarithmic_panel(&where, stream);
    } else if (where.has_lower) {
        print_anisotropy_panel(&where, stream);
    }
    return PSPEC_OK;
}
