/* The gnuplot script of spectra: image, powers, and what stands below them. */
#include "plots/plot_script.h"

#include <math.h>

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

/* Anisotropies stand below powers where there are any; on the sphere there are none. */
static bool has_anisotropy(const ps_figure *figure) {
    return !figure->on_sphere && ps_spectra_has(figure->panels, ps_spectra_anisotropy);
}

/* Where curves begin. */
static int find_left(const ps_figure *figure) {
    return LEFT + (figure->points != NULL ? POINTS_WIDTH : 0) +
           (figure->image != NULL ? IMAGE_WIDTH : 0);
}

static int find_width(const ps_figure *figure) {
    return figure->image != NULL ? find_left(figure) - LEFT + CURVES_WIDTH
                                 : find_left(figure) - LEFT + PS_SCRIPT_WIDTH;
}

/* ---- the key --------------------------------------------------------------------------------- */

static const char profiles_label[] = "lower, upper profile", fit_label[] = "fit near 0";

/* Does a curve go beyond what is shown, though nobody asked for that? */
static bool is_cut(const ps_figure *figure, const ps_series *curve) {
    return !figure->is_log_y && !figure->axes.has_y &&
           ps_spectra_find_top(curve) > ps_spectra_find_most(figure->panels);
}

static const char *name_curve(char out[PS_SCRIPT_CUT_BYTES], const ps_figure *figure,
                              const ps_series *curve) {
    enum { MOST_LETTERS = 150 }; /* more than any key has room for */
    char cut[PS_SCRIPT_CUT_BYTES];
    char top[32] = "";
    if (is_cut(figure, curve)) {
        snprintf(top, sizeof top, " (to %.3g)", ps_spectra_find_top(curve));
    }
    snprintf(out, PS_SCRIPT_CUT_BYTES, "%s%s",
             ps_script_cut(cut, curve->label != NULL ? curve->label : "", MOST_LETTERS), top);
    return out;
}

/* Is it the first curve with its level of noise? */
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

static const char *name_level(char out[PS_SCRIPT_CUT_BYTES], const ps_panel *curves, size_t index) {
    const ps_series *const curve = &curves->series[index];
    char of[32] = "";
    if (count_levels(curves) > 1) {
        snprintf(of, sizeof of, " of M = %.0f", curve->num_realizations);
    }
    snprintf(out, PS_SCRIPT_CUT_BYTES, "pure noise%s, %.1f dB", of, ps_spectra_level(curve, 0));
    return out;
}

/* Curves, unless there is one alone; levels of noise, profiles and fits where they are drawn. */
static ps_script_key make_key(const ps_figure *figure) {
    const ps_panel *const curves = figure->panels;
    char name[PS_SCRIPT_CUT_BYTES];
    ps_script_key key = {.where = {.left = find_left(figure), .right = find_width(figure) - RIGHT}};
    for (size_t i = 0; curves->num_series > 1 && i < curves->num_series; i++) {
        ps_script_key_add(&key, NULL, name_curve(name, figure, &curves->series[i]));
    }
    for (size_t i = 0; has_anisotropy(figure) && i < curves->num_series; i++) {
        if (is_first(curves, i)) {
            ps_script_key_add(&key, NULL, name_level(name, curves, i));
        }
    }
    if (ps_spectra_has(curves, ps_spectra_profile)) {
        ps_script_key_add(&key, NULL, profiles_label);
    }
    if (ps_spectra_has(curves, ps_spectra_fit)) {
        ps_script_key_add(&key, NULL, fit_label);
    }
    return key;
}

/* ---- places of panels ------------------------------------------------------------------------ */

typedef struct layout {
    const ps_figure *figure;
    const ps_panel *curves;
    ps_script_key key;
    bool has_lower; /* a panel below the powers */
    const char *x_label, *y_label;
    ps_script_box upper, lower, image, points;
} layout;

void ps_script_size_spectra(const ps_figure *figure, int *width, int *height) {
    const ps_script_key key = make_key(figure);
    *width = find_width(figure);
    *height = PS_SCRIPT_HEIGHT + (int)ceil(ps_script_key_height(&key));
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
    const double left = find_left(figure);
    const double image_left = left - (figure->image != NULL ? IMAGE_WIDTH : 0);
    const double side = BOTTOM - TOP;
    const double middle = TOP + share * (BOTTOM - TOP - between);
    out->upper =
        (ps_script_box){left, TOP, width - RIGHT, out->has_lower ? middle : BOTTOM, width, height};
    out->lower = (ps_script_box){left, middle + between, width - RIGHT, BOTTOM, width, height};
    out->image = (ps_script_box){image_left, TOP, image_left + side, BOTTOM, width, height};
    out->key.where.page_width = width;
    out->key.where.page_height = out->key.where.bottom = height;
    out->points = (ps_script_box){LEFT / 2, TOP, LEFT / 2 + side, BOTTOM, width, height};
}

static ps_plot_span or_asked(ps_plot_span own, bool is_asked, const double *asked) {
    return is_asked ? (ps_plot_span){asked[0], asked[1]} : own;
}

/* ---- curves ---------------------------------------------------------------------------------- */

/* No line goes through a place that stands alone: it is marked. */
static const char *curve_style(const layout *where, const ps_series *curve, const double *numbers) {
    return curve->num == 1 ? "points pointtype 7 pointsize 0.6"
           : ps_script_has_lone(where->figure, curve, numbers)
               ? "linespoints pointtype 7 pointsize 0.5"
               : "lines";
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

static void print_look(const layout *where, size_t index, const double *numbers, double width,
                       FILE *stream) {
    const ps_series *const curve = &where->curves->series[index];
    fprintf(stream, " with %s linewidth %g ", curve_style(where, curve, numbers),
            width * ps_script_line_width(where->figure, where->curves, index));
    ps_script_print_style(curve->kind, stream);
}

/* All curves once more, of these columns. */
static void print_thinner(const layout *where, const char *columns, bool is_anisotropy,
                          FILE *stream) {
    const double thinner = 0.75;
    for (size_t i = 0; i < where->curves->num_series; i++) {
        const ps_series *const curve = &where->curves->series[i];
        fprintf(stream, "%s$data0_%zu using %s", i > 0 ? ", " : "", i, columns);
        print_look(where, i, is_anisotropy ? curve->anisotropy : curve->y, thinner, stream);
        fputs(" notitle", stream);
    }
}

/* Profiles as thin dashes, fits as thin lines. */
static const char profile_style[] = " with lines linewidth 1 dashtype 3 ";
static const char fit_style[] = " with lines linecolor rgb '#000000' linewidth 1";

static void print_profiles(const ps_panel *curves, FILE *stream) {
    for (size_t i = 0; i < curves->num_series; i++) {
        const ps_series *const curve = &curves->series[i];
        for (int column = 5; curve->low != NULL && curve->high != NULL && column <= 6; column++) {
            fprintf(stream, ", $data0_%zu using 1:($%d > 0 ? $%d : NaN)%s", i, column, column,
                    profile_style);
            ps_script_print_colour(curve->kind, stream);
            fputs(" notitle", stream);
        }
        if (curve->fit != NULL) {
            fprintf(stream, ", $data0_%zu using 1:($7 > 0 ? $7 : NaN)%s notitle", i, fit_style);
        }
    }
}

/* One is grey, as it is of all curves; several have the colours of theirs. */
static void print_level_style(const ps_panel *curves, size_t index, FILE *stream) {
    fputs(" with lines dashtype 2 linewidth 1.2 ", stream);
    if (count_levels(curves) == 1) {
        fputs("linecolor rgb '#707070'", stream);
    } else {
        ps_script_print_colour(curves->series[index].kind, stream);
    }
}

/* In the order of make_key. */
static void print_entries(const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    char name[PS_SCRIPT_CUT_BYTES];
    for (size_t i = 0; curves->num_series > 1 && i < curves->num_series; i++) {
        fputs(", NaN", stream);
        print_look(where, i, curves->series[i].y, 1, stream);
        ps_script_print_entry(&where->key, NULL,
                              name_curve(name, where->figure, &curves->series[i]), stream);
    }
    for (size_t i = 0; has_anisotropy(where->figure) && i < curves->num_series; i++) {
        if (is_first(curves, i)) {
            fputs(", NaN", stream);
            print_level_style(curves, i, stream);
            ps_script_print_entry(&where->key, NULL, name_level(name, curves, i), stream);
        }
    }
    if (ps_spectra_has(curves, ps_spectra_profile)) {
        fprintf(stream, ", NaN%slinecolor rgb '#707070'", profile_style);
        ps_script_print_entry(&where->key, NULL, profiles_label, stream);
    }
    if (ps_spectra_has(curves, ps_spectra_fit)) {
        fprintf(stream, ", NaN%s", fit_style);
        ps_script_print_entry(&where->key, NULL, fit_label, stream);
    }
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

static void print_powers(const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    for (size_t i = 0; i < curves->num_series; i++) {
        print_errors(&curves->series[i], i, stream);
    }
    for (size_t i = 0; i < curves->num_series; i++) {
        fprintf(stream, "%s$data0_%zu using 1:2", i > 0 ? ", " : "", i);
        print_look(where, i, curves->series[i].y, 1, stream);
        fputs(" notitle", stream);
    }
    print_profiles(curves, stream);
    print_entries(where, stream);
    putc('\n', stream);
}

static void print_power_panel(const layout *where, FILE *stream) {
    const ps_figure *const figure = where->figure;
    const ps_panel *const curves = where->curves;
    const ps_plot_span powers =
        or_asked(ps_spectra_powers(figure, curves), figure->axes.has_y, figure->axes.y);
    ps_script_print_margins(&where->upper, stream);
    fputs(ps_script_ticks, stream);
    print_axis("y", figure->is_log_y, powers, stream);
    print_frequencies(where, !where->has_lower || figure->on_sphere, stream);
    fprintf(stream, "set ylabel '%s%s' offset 0,0\n", where->y_label,
            ps_spectra_has(curves, ps_spectra_error) ? " ± standard error" : "");
    ps_script_print_key(&where->key, stream);
    print_white(powers, stream);
    fputs("plot ", stream);
    print_powers(where, stream);
    fputs("unset arrow 1\nunset label 1\nunset key\n", stream);
}

static void print_anisotropy_panel(const layout *where, FILE *stream) {
    const ps_panel *const curves = where->curves;
    const ps_plot_span shown = ps_spectra_anisotropies(curves);
    ps_script_print_margins(&where->lower, stream);
    print_frequencies(where, true, stream);
    fprintf(stream,
            "unset logscale y\nset format y '%%g'\nset ylabel 'anisotropy / dB' offset 0,0\n"
            "set ytics %g in mirror\n",
            ps_script_tick_step(shown)); /* few enough for a low panel */
    ps_script_print_span("y", shown, stream);
    fputs("plot ", stream);
    for (size_t i = 0; i < curves->num_series; i++) {
        if (is_first(curves, i)) {
            fprintf(stream, "%.9g", ps_spectra_level(&curves->series[i], 0));
            print_level_style(curves, i, stream);
            fputs(" notitle, ", stream);
        }
    }
    print_thinner(where, "1:4", true, stream);
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
    print_axis("y", true, ps_spectra_powers(&figure, where->curves), stream);
    fprintf(stream, "set ylabel '%s' offset 0,0\nplot ", where->y_label);
    print_thinner(&own, "1:($2 > 0 ? $2 : NaN)", false, stream);
    print_profiles(where->curves, stream);
    putc('\n', stream);
}

pspec_status ps_script_print_spectra(const ps_figure *figure, const char *terminal, FILE *stream,
                                     ps_error *error) {
    const bool on_sphere = figure->on_sphere;
    layout where = {
        .figure = figure,
        .curves = figure->panels,
        .key = make_key(figure),
        .has_lower = on_sphere ? !(figure->is_log_x && figure->is_log_y) : has_anisotropy(figure),
        .x_label = on_sphere ? "normalized degree l N^{-1/2}" : "normalized frequency |k| N^{-1/d}",
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
