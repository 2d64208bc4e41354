/* How series look, and what of them lies on each other. */
#include "plots/plot_script.h"

#include <math.h>
#include <stdint.h>

/* Okabe and Ito's colours, which the colour-blind can tell apart; beyond them dashes change. */
static const char *const colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                      "#E69F00", "#56B4E9", "#000000"};
enum { NUM_COLOURS = sizeof colours / sizeof colours[0] };

/* Circles, squares, triangles: filled and hollow ones in turn. */
static const int signs[] = {7, 6, 5, 4, 9, 8, 11, 10, 13, 12, 15, 14};
enum { NUM_SIGNS = sizeof signs / sizeof signs[0] };

/* Marks of gnuplot; that of SIGNS is one of these. */
enum { NO_MARK, PLUS = 1, CROSS = 2, RING = 6, DISC = 7, SIGN = -1 };
/* Where there are marks: everywhere, where no line goes through a place that stands alone, at a
 * single place. */
enum { ALWAYS, ALONE, SINGLE };
enum { SOLID, OF_KIND = -1 };

typedef struct look {
    int mark, when;
    double size;             /* of marks */
    bool is_larger;          /* than that below others */
    bool has_line, is_wider; /* below others */
    double width;
    int dash;
    const char *colour; /* NULL: that of the kind */
} look;

#define LINE_WIDTH 1.6
static const char grey[] = "#707070";

/* The ring of a curve leaves room for a mark in it. */
static const look looks[] = {
    [PS_LOOK_LINE] = {DISC, ALWAYS, 0.4, false, true, true, LINE_WIDTH, OF_KIND, NULL},
    [PS_LOOK_SMALL] = {DISC, ALWAYS, 0.3, false, true, true, LINE_WIDTH, OF_KIND, NULL},
    [PS_LOOK_CURVE] = {RING, ALONE, 1.4, true, true, true, LINE_WIDTH, OF_KIND, NULL},
    [PS_LOOK_MARKS] = {DISC, ALWAYS, 0.6, true, false, false, 0, SOLID, NULL},
    [PS_LOOK_SIGNS] = {SIGN, ALWAYS, 0.9, false, false, false, 1.4, OF_KIND, NULL},
    [PS_LOOK_BOUND] = {CROSS, ALONE, 1, true, true, false, 1.2, 3, NULL},
    [PS_LOOK_CLOUD] = {DISC, ALWAYS, 0.3, false, false, false, 0, SOLID, "#b8b8b8"},
    [PS_LOOK_REFERENCE] = {PLUS, SINGLE, 1.4, false, true, false, 1, 2, "#808080"},
    [PS_LOOK_FRONT] = {NO_MARK, SINGLE, 0, false, true, false, 2, SOLID, "#b0b0b0"},
    [PS_LOOK_SPECTRUM] = {DISC, ALONE, 0.6, false, true, true, LINE_WIDTH, OF_KIND, NULL},
    [PS_LOOK_THIN] = {DISC, ALONE, 0.6, false, true, true, 0.75 * LINE_WIDTH, OF_KIND, NULL},
    [PS_LOOK_LEVEL] = {NO_MARK, SINGLE, 0, false, true, false, 1.2, 2, NULL},
    [PS_LOOK_PROFILE] = {NO_MARK, SINGLE, 0, false, true, false, 1, 3, NULL},
    [PS_LOOK_FIT] = {NO_MARK, SINGLE, 0, false, true, false, 1, SOLID, "#000000"},
};

/* ---- places ---------------------------------------------------------------------------------- */

bool ps_script_is_shown(const ps_script_panel *panel, const ps_series *series, size_t place) {
    const double x = series->x[place];
    const double y = series->y[place];
    return isfinite(x) && isfinite(y) && (!panel->x.is_log || x > 0) && (!panel->y.is_log || y > 0);
}

bool ps_script_has_places(const ps_script_panel *panel) {
    for (size_t i = 0; i < panel->panel.num_series; i++) {
        const ps_series *const series = &panel->panel.series[i];
        for (size_t place = 0; place < series->num; place++) {
            if (ps_script_is_shown(panel, series, place)) {
                return true;
            }
        }
    }
    return false;
}

/* Does a line, NaN being gaps, miss a place that stands alone? */
static bool has_lone(const ps_script_panel *panel, const ps_series *series) {
    bool is_before = false;
    for (size_t i = 0; i < series->num; i++) {
        const bool is_own = ps_script_is_shown(panel, series, i);
        const bool is_after = i + 1 < series->num && ps_script_is_shown(panel, series, i + 1);
        if (is_own && !is_before && !is_after) {
            return true;
        }
        is_before = is_own;
    }
    return false;
}

/* ---- what lies on each other ----------------------------------------------------------------- */

/* So many curves that lie on one are told apart; of more the lower ones look the same. */
enum { MOST_ABOVE = 3 };

/* Of a logarithmic axis numbers are near that differ by a part of themselves, of a linear one by a
 * part of the lower curve, about the width of a line; `wide` times that where marks are. */
static bool are_near(double a, double b, bool is_log, double most, double wide) {
    const double near = wide * (is_log ? 0.02 * fmax(fabs(a), fabs(b)) : 0.005 * most);
    return fabs(a - b) <= near;
}

static double find_most(const ps_series *curve) {
    double most = 0;
    for (size_t i = 0; i < curve->num; i++) {
        most = isfinite(curve->y[i]) ? fmax(most, fabs(curve->y[i])) : most;
    }
    return most;
}

/* At a quarter of the places that both have: there the lower one would be missed. */
static bool do_coincide(const ps_script_panel *panel, const ps_series *a, const ps_series *b,
                        double wide) {
    const double most = fmin(find_most(a), find_most(b));
    const size_t num = a->num < b->num ? a->num : b->num;
    size_t num_both = 0;
    size_t num_near = 0;
    for (size_t i = 0; i < num; i++) {
        const bool are_both = ps_script_is_shown(panel, a, i) && ps_script_is_shown(panel, b, i) &&
                              a->x[i] == b->x[i];
        num_both += are_both;
        num_near += are_both && are_near(a->y[i], b->y[i], panel->y.is_log, most, wide);
    }
    return num_both > 0 && 4 * num_near >= num_both;
}

static bool can_hide(const ps_series *above, const ps_series *below) {
    const look *const a = &looks[above->look];
    const look *const b = &looks[below->look];
    return (a->is_wider && b->is_wider) ||
           (a->is_larger && !a->is_wider && above->look == below->look);
}

/* So much of those that come later and lie on this one, MOST_ABOVE at most. */
static double grow(const ps_script_panel *panel, size_t index, double more, double wide) {
    const ps_series *const own = &panel->panel.series[index];
    size_t num = 0;
    for (size_t i = index + 1; i < panel->panel.num_series; i++) {
        const ps_series *const other = &panel->panel.series[i];
        num += can_hide(other, own) && do_coincide(panel, own, other, wide);
    }
    return more * (double)(num < MOST_ABOVE ? num : MOST_ABOVE);
}

double ps_script_line_width(const ps_script_panel *panel, size_t index) {
    return LINE_WIDTH + grow(panel, index, 2.2, 1);
}

/* Of marks, and of rings that are curves of a single place: rows of keys have room for four of them
 * on each other. Marks are wider than lines. */
static double find_size(const ps_script_panel *panel, size_t index) {
    const look *const how = &looks[panel->panel.series[index].look];
    return how->size + (how->is_larger ? grow(panel, index, 0.35, 5) : 0);
}

/* ---- styles ---------------------------------------------------------------------------------- */

static void print_colour(ps_text *out, const look *how, size_t kind) {
    ps_text_append(out, " linecolor rgb '%s'",
                   how->colour != NULL      ? how->colour
                   : kind == PS_SCRIPT_GREY ? grey
                                            : colours[kind % NUM_COLOURS]);
}

static void print_dashes(ps_text *out, const look *how, size_t kind) {
    if (how->dash == OF_KIND) {
        ps_text_append(out, " dashtype %zu", kind / NUM_COLOURS % 4 + 1);
    } else if (how->dash != SOLID) {
        ps_text_append(out, " dashtype %d", how->dash);
    }
}

static void print_width(ps_text *out, const ps_script_panel *panel, size_t index) {
    const ps_series *const series = &panel->panel.series[index];
    const look *const how = &looks[series->look];
    const bool is_ring = series->num == 1 && how->mark == RING;
    const double times =
        how->is_wider && !is_ring ? ps_script_line_width(panel, index) / LINE_WIDTH : 1;
    if (how->width > 0) {
        ps_text_append(out, " linewidth %g", times * how->width);
    }
}

/* Two kinds of signs have a colour. */
static void print_style(ps_text *out, const ps_script_panel *panel, size_t index) {
    const ps_series *const series = &panel->panel.series[index];
    const look *const how = &looks[series->look];
    const bool is_single = series->num == 1 && how->mark != NO_MARK;
    const bool has_marks =
        is_single || (how->when == ALWAYS) || (how->when == ALONE && has_lone(panel, series));
    const bool has_signs = how->mark == SIGN;
    const size_t kind = has_signs ? series->kind / 2 : series->kind;
    ps_text_append(out, " with %s%s", how->has_line && !is_single ? "lines" : "",
                   has_marks ? "points" : "");
    if (has_marks) {
        ps_text_append(out, " pointtype %d pointsize %g",
                       has_signs ? signs[series->kind % NUM_SIGNS] : how->mark,
                       find_size(panel, index));
    }
    print_width(out, panel, index);
    print_colour(out, how, kind);
    print_dashes(out, how, kind);
}

/* ---- bands, bars, lines ---------------------------------------------------------------------- */

/* A column that is no smaller than the end of a logarithmic axis; bottom 0: of a linear one. */
static void print_raised(ps_text *out, const char *column, double bottom) {
    if (bottom > 0) {
        ps_text_append(out, "(%s > %.9g ? %s : %.9g)", column, bottom, column, bottom);
    } else {
        ps_text_append(out, "(%s)", column);
    }
}

/* What is printed: series of a panel, whose data have this number. */
typedef struct printed {
    ps_text *out;
    const ps_script_panel *panel;
    size_t number;
    const char *comma; /* before the next */
} printed;

static void begin(printed *self, size_t index) {
    ps_text_append(self->out, "%s$data%zu_%zu using ", self->comma, self->number, index);
    self->comma = ", ";
}

static void end(const printed *self, const ps_series *series) {
    print_colour(self->out, &looks[series->look], series->kind);
    ps_text_append(self->out, " notitle");
}

/* Around a single place the band is a box. */
static void print_band(printed *self, size_t index) {
    const ps_series *const series = &self->panel->panel.series[index];
    const bool is_single = series->num == 1;
    begin(self, index);
    ps_text_append(self->out, "1:%s", is_single ? "2:($1*0.985):($1*1.015):" : "");
    print_raised(self->out, "$4", self->panel->bottom);
    ps_text_append(self->out, ":5 with %s fillstyle transparent solid 0.25 noborder",
                   is_single ? "boxxyerror" : "filledcurves");
    end(self, series);
}

/* None without a length. */
static void print_bars(printed *self, size_t index) {
    begin(self, index);
    ps_text_append(self->out, "1:($3 > 0 ? $2 : NaN):");
    print_raised(self->out, "$2-$3", self->panel->bottom);
    ps_text_append(self->out, ":($2+$3) with yerrorbars pointtype 7 pointsize 0.1 linewidth 1.2");
    end(self, &self->panel->panel.series[index]);
}

/* Of a spectrum bars while they can be told apart, a band when there are too many. */
static void print_errors(printed *self, size_t index) {
    enum { MOST_BARS = 200 };
    const ps_series *const series = &self->panel->panel.series[index];
    begin(self, index);
    ps_text_append(
        self->out, "%s",
        series->num <= MOST_BARS
            ? "1:2:($3 > 0 ? $3 : NaN) with yerrorbars pointtype 7 pointsize 0.25 linewidth 0.8"
            : "1:($2-$3):($2+$3) with filledcurves fillstyle transparent solid 0.3 noborder");
    end(self, series);
}

/* What lies below the line of this series; that of spectra lies below all lines. */
static void print_below(printed *self, size_t index) {
    const ps_series *const series = &self->panel->panel.series[index];
    if (series->look == PS_LOOK_CURVE && series->low != NULL && series->high != NULL) {
        print_band(self, index);
    }
    if (series->look == PS_LOOK_MARKS && series->error != NULL) {
        print_bars(self, index);
    }
}

/* An entry of the key alone has no data. */
static void print_line(printed *self, size_t index) {
    const ps_series *const series = &self->panel->panel.series[index];
    if (series->num > 0) {
        begin(self, index);
        ps_text_append(self->out, "1:2");
    } else {
        ps_text_append(self->out, "%sNaN", self->comma);
        self->comma = ", ";
    }
    print_style(self->out, self->panel, index);
    ps_script_print_entry(self->out, &self->panel->key, series);
}

/* Profiles and the fit of a spectrum, columns 4 to 6. */
static void print_profiles(printed *self, size_t index) {
    const ps_series *const series = &self->panel->panel.series[index];
    const bool has_profiles = series->low != NULL && series->high != NULL;
    for (int column = has_profiles ? 4 : 6; column <= (series->fit != NULL ? 6 : 5); column++) {
        const look *const how = &looks[column == 6 ? PS_LOOK_FIT : PS_LOOK_PROFILE];
        begin(self, index);
        ps_text_append(self->out, "1:($%d > 0 ? $%d : NaN) with lines linewidth %g", column, column,
                       how->width);
        print_colour(self->out, how, series->kind);
        print_dashes(self->out, how, series->kind);
        ps_text_append(self->out, " notitle");
    }
}

void ps_script_print_series(ps_text *out, const ps_script_panel *panel, size_t number) {
    printed self = {.out = out, .panel = panel, .number = number, .comma = ""};
    const bool has_places = ps_script_has_places(panel);
    const size_t num = panel->panel.num_series;
    if (!has_places) {
        ps_text_append(out, "NaN notitle");
        self.comma = ", ";
    }
    for (size_t i = 0; has_places && i < num; i++) {
        const ps_series *const series = &panel->panel.series[i];
        if (series->look == PS_LOOK_SPECTRUM && series->error != NULL) {
            print_errors(&self, i);
        }
    }
    for (size_t i = 0; i < num; i++) {
        if (has_places) {
            print_below(&self, i);
        }
        if (has_places || panel->panel.series[i].num == 0) {
            print_line(&self, i);
        }
    }
    for (size_t i = 0; has_places && i < num; i++) {
        const ps_look own = panel->panel.series[i].look;
        if (own == PS_LOOK_SPECTRUM || own == PS_LOOK_THIN) {
            print_profiles(&self, i);
        }
    }
}
