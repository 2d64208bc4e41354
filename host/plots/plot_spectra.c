/* Pages of spectra: points, image, powers, and what stands below them. */
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

/* ---- numbers of curves ----------------------------------------------------------------------- */

/* At one of their places; nan where there is none. */
typedef enum number { ERROR, BAR, ANISOTROPY, LEVEL, PROFILE, FIT } number;

static double take(const double *numbers, size_t bin) {
    return numbers != NULL ? numbers[bin] : (double)NAN;
}

/* The bar: where that of a power ends. The level: in dB, of pure noise beside which the anisotropy
 * of the curve stands. The profile: the upper one. */
static double take_number(const ps_series *curve, size_t bin, number which) {
    const double error = take(curve->error, bin);
    switch (which) {
    case ERROR:
        return error;
    case BAR:
        return curve->y[bin] + (isfinite(error) ? error : 0);
    case ANISOTROPY:
        return take(curve->anisotropy, bin);
    case LEVEL:
        return curve->num_realizations >= 2 ? -10 * log10(curve->num_realizations) : (double)NAN;
    case PROFILE:
        return curve->low != NULL ? take(curve->high, bin) : (double)NAN;
    case FIT:
        return take(curve->fit, bin);
    }
    return NAN;
}

static void widen_by(ps_plot_span *span, const ps_panel *curves, number which) {
    for (size_t i = 0; i < curves->num_series; i++) {
        for (size_t bin = 0; bin < curves->series[i].num; bin++) {
            ps_plot_span_widen(span, take_number(&curves->series[i], bin, which));
        }
    }
}

static bool has(const ps_panel *curves, number which) {
    ps_plot_span all = ps_plot_span_none();
    widen_by(&all, curves, which);
    return !ps_plot_span_is_empty(all);
}

/* ---- what axes show unless something else was asked for -------------------------------------- */

/* The largest power of a curve with its bar. */
static double find_top(const ps_series *curve) {
    ps_plot_span all = {0, 0};
    widen_by(&all, &(ps_panel){.num_series = 1, .series = curve}, BAR);
    return all.most;
}

/* That of all, but for curves that are louder than all others, which would flatten these: peaks of
 * lattices beside noise. Loud is what is so many times as large as all others. White noise stays in
 * sight. */
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

/* The upper profile of a curve that is in sight is, too. */
static double with_profiles(const ps_panel *curves, double most) {
    ps_plot_span all = {0, most};
    for (size_t i = 0; i < curves->num_series; i++) {
        if (find_top(&curves->series[i]) <= most) {
            widen_by(&all, &(ps_panel){.num_series = 1, .series = &curves->series[i]}, PROFILE);
        }
    }
    return all.most;
}

static ps_plot_span find_powers(const ps_panel *curves, bool is_log) {
    const double margin = is_log ? 1.4 : 1.05;
    if (!is_log) {
        return (ps_plot_span){0, margin * with_profiles(curves, find_most(curves))};
    }
    ps_plot_span all = ps_plot_span_above(curves);
    ps_plot_span tops = ps_plot_span_none();
    widen_by(&tops, curves, BAR);
    ps_plot_span_widen(&all, with_profiles(curves, tops.most));
    ps_plot_span_widen(&all, 1); /* white noise */
    return (ps_plot_span){all.least / margin, all.most * margin};
}

static ps_plot_span find_frequencies(const ps_panel *curves, bool is_log) {
    const double margin = 1.1;
    const ps_plot_span places = ps_plot_span_places(curves);
    if (ps_plot_span_is_empty(places)) {
        return (ps_plot_span){is_log ? 1 / margin : 0, margin};
    }
    return is_log ? (ps_plot_span){places.least / margin, places.most * margin}
                  : (ps_plot_span){0, places.most};
}

/* Those of curves and of levels of noise. */
static ps_plot_span find_anisotropies(const ps_panel *curves) {
    const double margin = 0.05; /* of what there is */
    const double least_margin = 0.5;
    ps_plot_span all = ps_plot_span_none();
    widen_by(&all, curves, ANISOTROPY);
    widen_by(&all, curves, LEVEL);
    const double around = fmax(margin * (all.most - all.least), least_margin);
    return (ps_plot_span){all.least - around, all.most + around};
}

/* ---- series ---------------------------------------------------------------------------------- */

typedef struct composer {
    const ps_figure *figure;
    const ps_panel *curves;
    ps_script_page *page;
    ps_pool *memory;
    ps_error *error;
    size_t num_levels; /* of noise, in the panel of anisotropies; 0: there is none */
    ps_panel powers;
    ps_script_key key;
} composer;

/* Anisotropies stand below powers where there are any; on the sphere there are none. */
static bool has_anisotropy(const composer *self) {
    return !self->figure->on_sphere && has(self->curves, ANISOTROPY);
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

/* All curves, before which there is room for as many others, and two more behind them. */
static pspec_status copy_curves(const composer *self, ps_panel *out, ps_series **first) {
    const size_t num = self->curves->num_series;
    PS_TRY(PS_POOL_NEW(self->memory, first, 2 * num + 2, "a picture", self->error));
    *out = (ps_panel){.num_series = num, .series = *first};
    for (size_t i = 0; i < num; i++) {
        (*first)[i] = self->curves->series[i];
        (*first)[i].label = NULL;
        (*first)[i].look = PS_LOOK_THIN;
    }
    return PSPEC_OK;
}

/* Does a curve go beyond what is shown, though nobody asked for that? Its name says how far. */
static pspec_status name_curve(const composer *self, const ps_series *curve, const char **label) {
    const ps_figure *const figure = self->figure;
    const double top = find_top(curve);
    ps_text text = {0};
    ps_text_append(&text, "%s", curve->label != NULL ? curve->label : "");
    if (!figure->is_log_y && !figure->axes.has_y && top > find_most(self->curves)) {
        ps_text_append(&text, " (to %.3g)", top);
    }
    return ps_text_keep(label, self->memory, &text, self->error);
}

/* One is grey, as it is of all curves; several have the colours of theirs. */
static ps_series make_level(const composer *self, size_t curve) {
    return (ps_series){.look = PS_LOOK_LEVEL,
                       .kind = self->num_levels > 1 ? self->curves->series[curve].kind
                                                    : PS_SCRIPT_GREY};
}

static pspec_status name_level(const composer *self, size_t curve, const char **label) {
    const ps_series *const own = &self->curves->series[curve];
    ps_text text = {0};
    ps_text_append(&text, "pure noise");
    if (self->num_levels > 1) {
        ps_text_append(&text, " of M = %.0f", own->num_realizations);
    }
    ps_text_append(&text, ", %.1f dB", take_number(own, 0, LEVEL));
    return ps_text_keep(label, self->memory, &text, self->error);
}

/* In the key are curves, unless there is one alone; levels of noise, profiles and fits where they
 * are drawn. */
static pspec_status make_powers(const composer *self, ps_panel *out) {
    const ps_panel *const curves = self->curves;
    ps_series *series = NULL;
    PS_TRY(copy_curves(self, out, &series));
    for (size_t i = 0; i < curves->num_series; i++) {
        series[i].look = PS_LOOK_SPECTRUM;
        if (curves->num_series > 1) {
            PS_TRY(name_curve(self, &curves->series[i], &series[i].label));
        }
    }
    for (size_t i = 0; self->num_levels > 0 && i < curves->num_series; i++) {
        if (is_first(curves, i)) {
            series[out->num_series] = make_level(self, i);
            PS_TRY(name_level(self, i, &series[out->num_series++].label));
        }
    }
    if (has(curves, PROFILE)) {
        series[out->num_series++] = (ps_series){
            .look = PS_LOOK_PROFILE, .kind = PS_SCRIPT_GREY, .label = "lower, upper profile"};
    }
    if (has(curves, FIT)) {
        series[out->num_series++] = (ps_series){.look = PS_LOOK_FIT, .label = "fit near 0"};
    }
    return PSPEC_OK;
}

/* Levels of noise, as lines from one end of the axis to the other, below the curves. */
static pspec_status make_anisotropies(const composer *self, ps_plot_span shown, ps_panel *out) {
    const ps_panel *const curves = self->curves;
    ps_series *series = NULL;
    size_t num = 0;
    PS_TRY(copy_curves(self, out, &series));
    memmove(series + self->num_levels, series, curves->num_series * sizeof *series);
    out->num_series += self->num_levels;
    for (size_t i = 0; i < curves->num_series; i++) {
        ps_series *const own = &series[self->num_levels + i];
        own->y = own->anisotropy;
        own->error = own->low = own->high = own->fit = NULL;
        if (is_first(curves, i)) {
            double *ends = NULL;
            PS_TRY(PS_POOL_NEW(self->memory, &ends, 4, "a picture", self->error));
            ends[0] = shown.least;
            ends[1] = shown.most;
            ends[2] = ends[3] = take_number(own, 0, LEVEL);
            series[num] = make_level(self, i);
            series[num].num = 2;
            series[num].x = ends;
            series[num++].y = ends + 2;
        }
    }
    return PSPEC_OK;
}

/* ---- panels ---------------------------------------------------------------------------------- */

/* Pixels: of points and image, with numbers and colours; of the curves. */
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

static ps_script_panel *add_panel(const composer *self, double left, double right) {
    ps_script_panel *const out = &self->page->panels[self->page->num_panels++];
    *out = (ps_script_panel){
        .where = {left, TOP, right, BOTTOM, self->page->width, self->page->height}};
    return out;
}

static ps_script_axis make_axis(ps_plot_span shown, bool is_log, const char *label) {
    return (ps_script_axis){.shown = shown,
                            .is_log = is_log && shown.least > 0,
                            .format = is_log && shown.least > 0 ? NULL : "%g",
                            .label = label,
                            .offset = "0,0"};
}

static ps_script_axis make_frequencies(const composer *self, bool is_log, bool is_asked) {
    const ps_plot_axes *const asked = &self->figure->axes;
    ps_script_axis out = make_axis(ps_plot_span_asked(find_frequencies(self->curves, is_log),
                                                      is_asked && asked->has_x, asked->x),
                                   is_log,
                                   self->figure->on_sphere ? "normalized degree l N^{-1/2}"
                                                           : "normalized frequency |k| N^{-1/d}");
    out.offset = "0,0.2";
    return out;
}

static pspec_status place_powers(const composer *self, ps_script_panel *out) {
    const ps_figure *const figure = self->figure;
    ps_text label = {0};
    out->x = make_frequencies(self, figure->is_log_x, true);
    out->y = make_axis(ps_plot_span_asked(find_powers(self->curves, figure->is_log_y),
                                          figure->axes.has_y, figure->axes.y),
                       figure->is_log_y, NULL);
    out->has_white = true;
    ps_text_append(&label, "%s%s", figure->y_label != NULL ? figure->y_label : "",
                   has(self->curves, ERROR) ? " ± standard error" : "");
    return ps_text_keep(&out->y.label, self->memory, &label, self->error);
}

/* Panels with the same axis say what it is once, at the bottom. */
static pspec_status place_anisotropies(const composer *self, ps_script_panel *upper,
                                       ps_script_panel *out) {
    const ps_plot_span shown = find_anisotropies(self->curves);
    out->x = upper->x;
    upper->x.label = NULL;
    upper->x.format = "";
    out->y = make_axis(shown, false, "anisotropy / dB");
    out->y.step = ps_plot_tick_step(shown); /* few enough for a low panel */
    return make_anisotropies(self, out->x.shown, &out->panel);
}

/* Low degrees of good patterns have powers that a linear axis cannot show. */
static pspec_status place_logarithms(const composer *self, ps_script_panel *out) {
    ps_series *series = NULL;
    PS_TRY(copy_curves(self, &out->panel, &series));
    out->x = make_frequencies(self, true, false);
    out->y = make_axis(find_powers(self->curves, true), true, self->figure->y_label);
    return PSPEC_OK;
}

/* The lower panel has a third, on the sphere a half. */
static pspec_status place_curves(const composer *self, double left, bool has_lower) {
    const bool on_sphere = self->figure->on_sphere;
    const double share = on_sphere ? 0.5 : 0.64;
    const double between = on_sphere ? BETWEEN_ON_SPHERE : BETWEEN;
    const double right = self->page->width - RIGHT;
    ps_script_panel *const upper = add_panel(self, left, right);
    upper->panel = self->powers;
    upper->key = self->key;
    PS_TRY(place_powers(self, upper));
    if (!has_lower) {
        return PSPEC_OK;
    }
    ps_script_panel *const lower = add_panel(self, left, right);
    upper->where.bottom = TOP + share * (BOTTOM - TOP - between);
    lower->where.top = upper->where.bottom + between;
    return on_sphere ? place_logarithms(self, lower) : place_anisotropies(self, upper, lower);
}

/* A line is in the middle. */
static void place_points(const composer *self) {
    const double side = BOTTOM - TOP;
    ps_script_panel *const out = add_panel(self, LEFT / 2.0, LEFT / 2.0 + side);
    out->panel = *self->figure->points;
    if (out->panel.frame.form == PS_FRAME_LINE) {
        out->where.top = (TOP + BOTTOM - PS_SCRIPT_LINE_HEIGHT) / 2.0;
        out->where.bottom = out->where.top + PS_SCRIPT_LINE_HEIGHT;
    }
}

/* The page is higher by its key. */
static void size_page(composer *self, double left) {
    const ps_figure *const figure = self->figure;
    ps_script_page *const page = self->page;
    ps_script_box *const where = &self->key.where;
    page->title_left = figure->points != NULL ? POINTS_WIDTH : 0;
    page->width = (int)left - LEFT + (figure->image != NULL ? CURVES_WIDTH : PS_SCRIPT_WIDTH);
    if (self->powers.num_series > 1) {
        self->key = ps_script_key_of(&self->powers,
                                     (ps_script_box){.left = left, .right = page->width - RIGHT});
    }
    page->height = PS_SCRIPT_HEIGHT + (int)ceil(ps_script_key_height(&self->key));
    where->page_width = page->width;
    where->page_height = where->bottom = page->height;
}

pspec_status ps_script_place_spectra(ps_script_page *out, ps_pool *memory, const ps_figure *figure,
                                     ps_error *error) {
    enum { MOST_PANELS = 4 };
    composer self = {
        .figure = figure, .curves = figure->panels, .page = out, .memory = memory, .error = error};
    const bool has_lower =
        figure->on_sphere ? !(figure->is_log_x && figure->is_log_y) : has_anisotropy(&self);
    const double image_left = LEFT + (figure->points != NULL ? POINTS_WIDTH : 0);
    const double left = image_left + (figure->image != NULL ? IMAGE_WIDTH : 0);
    for (size_t i = 0; has_anisotropy(&self) && i < self.curves->num_series; i++) {
        self.num_levels += is_first(self.curves, i);
    }
    PS_TRY(PS_POOL_NEW(memory, &out->panels, MOST_PANELS, "a picture", error));
    PS_TRY(make_powers(&self, &self.powers));
    size_page(&self, left);
    PS_TRY(place_curves(&self, left, has_lower));
    if (figure->points != NULL) {
        place_points(&self);
    }
    if (figure->image != NULL) {
        ps_script_panel *const image = add_panel(&self, image_left, image_left + BOTTOM - TOP);
        PS_TRY(ps_script_make_raster(&image->raster, memory, figure->image, error));
    }
    return PSPEC_OK;
}
