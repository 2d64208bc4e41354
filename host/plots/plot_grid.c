/* Pages of panels in rows: where panels are, and what their axes cover. */
#include "plots/plot_script.h"

#include <math.h>

/* Cells of the same size below the head of a page, in pixels, and what stands around the panel in
 * each: numbers, labels, titles. */
typedef struct grid {
    size_t columns, num;
    double head, width, height;
    double left, right, above, below;
} grid;

static double page_height(const grid *self) {
    return self->head + self->height * (double)((self->num + self->columns - 1) / self->columns);
}

/* more: height of the page, below the cells. */
static ps_script_box find_box(const grid *self, size_t cell, double more) {
    const double x = (double)(cell % self->columns) * self->width;
    const double y = self->head + (double)(cell / self->columns) * self->height;
    return (ps_script_box){x + self->left,
                           y + self->above,
                           x + self->width - self->right,
                           y + self->height - self->below,
                           self->width * (double)self->columns,
                           page_height(self) + more};
}

/* Panels of the figure in their places; more: panels behind them. */
static pspec_status begin(ps_script_page *out, ps_pool *memory, const ps_figure *figure,
                          const grid *where, size_t more, ps_error *error) {
    PS_TRY(PS_POOL_NEW(memory, &out->panels, figure->num_panels + more, "a picture", error));
    out->num_panels = figure->num_panels;
    out->width = (int)(where->width * (double)where->columns);
    out->height = (int)page_height(where);
    for (size_t i = 0; i < figure->num_panels; i++) {
        const ps_panel *const panel = &figure->panels[i];
        out->panels[i] = (ps_script_panel){.where = find_box(where, i, 0), .panel = *panel};
    }
    return PSPEC_OK;
}

static ps_script_axis make_axis(const char *label, const char *offset, bool is_log) {
    return (ps_script_axis){.label = label != NULL ? label : "",
                            .offset = offset,
                            .is_log = is_log,
                            .shown = {NAN, NAN}};
}

/* ---- frames ---------------------------------------------------------------------------------- */

/* Panels side by side, four in two rows; a panel among others is smaller than one alone, and the
 * page has a line for the title. Numbers go down to 10^-14; below them is the label, and what is
 * between it and the key. */
static grid find_frames(const ps_figure *figure) {
    enum { MOST_COLUMNS = 3, TWO_ROWS = 4 };
    grid out = {1, figure->num_panels, 0, PS_SCRIPT_WIDTH, PS_SCRIPT_HEIGHT, 104, 15, 56, 84};
    if (out.num > 1) {
        out = (grid){out.num, out.num, 40, 720, 640, 104, 15, 30, 84};
        out.columns = out.num == TWO_ROWS ? 2 : out.num < MOST_COLUMNS ? out.num : MOST_COLUMNS;
    }
    return out;
}

/* Where a logarithmic axis ends at the latest; 0 where nothing is above the floors of the numbers.
 * Bands may go down to nothing; an axis that has them shows nothing else. */
static double find_bottom(const ps_panel *panel) {
    const double below = 1e-2; /* of the least number: so much of bands is worth seeing */
    const double least = ps_plot_span_above(panel).least;
    return isfinite(least) ? fmax(least * below, ps_plot_least_floor(panel)) : 0;
}

/* Does a number, or the band around it, go further down? */
static bool goes_below(const ps_panel *panel, double bottom) {
    for (size_t i = 0; i < panel->num_series; i++) {
        const ps_series *const series = &panel->series[i];
        for (size_t k = 0; k < series->num; k++) {
            const bool has_low = series->low != NULL && series->low[k] < bottom;
            if (has_low || (series->y[k] > 0 && series->y[k] < bottom)) {
                return true;
            }
        }
    }
    return false;
}

/* The largest number of either axis, in a frame of that shape. */
static void show_plane(ps_script_panel *out) {
    const double margin = 1.05;
    const double width = out->where.right - out->where.left;
    const double height = out->where.bottom - out->where.top;
    double reach = 0;
    for (size_t i = 0; i < out->panel.num_series; i++) {
        const ps_series *const series = &out->panel.series[i];
        for (size_t k = 0; k < series->num; k++) {
            reach = fmax(reach, fabs(series->x[k]) * height / width);
            reach = fmax(reach, fabs(series->y[k]));
        }
    }
    if (reach > 0) {
        const double y = reach * margin;
        const double x = y * width / height;
        out->x.shown = (ps_plot_span){-x, x};
        out->y.shown = (ps_plot_span){-y, y};
    }
}

/* gnuplot would go on to whole powers of ten, where few points are, and has no ticks between them.
 */
static ps_plot_span find_log_places(const ps_panel *panel) {
    const double margin = 1.15;
    const ps_plot_span places = ps_plot_span_places(panel);
    return (ps_plot_span){places.least / margin, places.most * margin};
}

static void show_axes(ps_script_panel *out, const ps_plot_axes *asked) {
    if (out->panel.frame.form == PS_FRAME_PLANE) {
        show_plane(out);
    }
    if (out->x.is_log) {
        out->x.shown = find_log_places(&out->panel);
    }
    if (out->y.is_log) {
        out->bottom = find_bottom(&out->panel);
        if (out->bottom > 0 && goes_below(&out->panel, out->bottom)) {
            out->y.shown.least = out->bottom;
        }
    }
    out->x.shown = ps_plot_span_asked(out->x.shown, asked->has_x, asked->x);
    out->y.shown = ps_plot_span_asked(out->y.shown, asked->has_y, asked->y);
}

/* A single series needs no key, unless its label says more than the title of the picture does. */
static void place_key(ps_script_panel *out, double below) {
    ps_script_box where = out->where;
    where.bottom += below;
    if (out->panel.num_series > 1 || out->panel.series[0].label != NULL) {
        out->key = ps_script_key_of(&out->panel, where);
        out->where.bottom -= ps_script_key_height(&out->key);
    }
}

/* A frame that is alone needs no title, and one in which nothing is seen no key. */
static void finish_frame(ps_script_panel *out, const ps_plot_axes *asked, double below,
                         bool is_alone) {
    place_key(out, below);
    if (is_alone) {
        out->panel.title = NULL;
    }
    if (is_alone || ps_script_has_places(out)) {
        show_axes(out, asked);
    } else {
        out->key.num = 0;
    }
}

/* ---- small panels ---------------------------------------------------------------------------- */

/* Three in a row; one panel is as wide as two. */
static grid find_panels(const ps_figure *figure) {
    enum { MOST_COLUMNS = 3, WIDTH = 470 };
    const size_t num = figure->num_panels;
    const size_t columns = num < MOST_COLUMNS ? num : MOST_COLUMNS;
    return (grid){columns, num, 44, num > 1 ? WIDTH : 2 * WIDTH, 370, 82, 20, 30, 52};
}

/* The first series of every kind that there is, as an entry; fronts are one kind. */
static pspec_status list_entries(ps_panel *out, ps_pool *memory, const ps_figure *figure,
                                 ps_error *error) {
    size_t most = 0;
    ps_series *entries = NULL;
    for (size_t i = 0; i < figure->num_panels; i++) {
        most += figure->panels[i].num_series;
    }
    PS_TRY(PS_POOL_NEW(memory, &entries, most, "a picture", error));
    *out = (ps_panel){.series = entries};
    for (size_t i = 0; i < figure->num_panels; i++) {
        for (size_t j = 0; j < figure->panels[i].num_series; j++) {
            const ps_series *const own = &figure->panels[i].series[j];
            size_t same = 0;
            while (same < out->num_series &&
                   (entries[same].look != own->look || entries[same].kind != own->kind)) {
                same++;
            }
            if (same == out->num_series) {
                entries[out->num_series] = *own;
                entries[out->num_series++].num = 0;
            }
        }
    }
    return PSPEC_OK;
}

/* A linear axis begins at 0, unless something is below it. */
static ps_plot_span widen(ps_plot_span places, bool is_log) {
    const double margin = 1.05;
    const double low = is_log ? places.least : fmin(places.least, 0);
    return places.most > low
               ? (ps_plot_span){is_log ? low / margin : low * margin, places.most * margin}
               : (ps_plot_span){NAN, NAN};
}

static void widen_by(ps_plot_span *places, ps_plot_span other) {
    ps_plot_span_widen(places, other.least);
    ps_plot_span_widen(places, other.most);
}

/* A logarithmic axis of y leaves out what rounding left. */
static void share_axes(const ps_script_page *page) {
    ps_plot_span x = ps_plot_span_none();
    ps_plot_span y = ps_plot_span_none();
    for (size_t i = 0; i < page->num_panels; i++) {
        const ps_script_panel *const own = &page->panels[i];
        for (size_t j = 0; j < own->panel.num_series; j++) {
            const ps_series *const series = &own->panel.series[j];
            for (size_t place = 0; place < series->num; place++) {
                if (ps_script_is_shown(own, series, place)) {
                    ps_plot_span_widen(&x, series->x[place]);
                    ps_plot_span_widen(&y, own->y.is_log ? (double)NAN : series->y[place]);
                }
            }
        }
        if (own->y.is_log) {
            widen_by(&y, ps_plot_span_above(&own->panel));
        }
    }
    for (size_t i = 0; i < page->num_panels; i++) {
        page->panels[i].x.shown = widen(x, page->panels[i].x.is_log);
        page->panels[i].y.shown = widen(y, page->panels[i].y.is_log);
    }
}

/* The key of all, in a panel of its own, of which nothing else is seen: below the others. */
static pspec_status add_key(ps_script_page *page, ps_pool *memory, const ps_figure *figure,
                            const grid *where, ps_error *error) {
    const double above = 20;
    ps_script_panel *const key = &page->panels[page->num_panels++];
    *key = (ps_script_panel){.is_key = true};
    PS_TRY(list_entries(&key->panel, memory, figure, error));
    key->where = (ps_script_box){
        .left = where->left, .right = page->width - where->right, .page_width = page->width};
    key->key = ps_script_key_of(&key->panel, key->where);
    page->height += (int)(above + ceil(ps_script_key_height(&key->key)));
    key->where.page_height = key->where.bottom = page->height;
    key->where.top = key->where.bottom - 1;
    key->key.where = key->where;
    for (size_t i = 0; i < page->num_panels; i++) {
        page->panels[i].where.page_height = page->height;
    }
    return PSPEC_OK;
}

/* Frames have a key of their own below each, and axes of their own; small panels share them. */
pspec_status ps_script_place_panels(ps_script_page *out, ps_pool *memory, const ps_figure *figure,
                                    ps_error *error) {
    const bool are_small = figure->form == PS_FIGURE_PANELS;
    const grid where = are_small ? find_panels(figure) : find_frames(figure);
    PS_TRY(begin(out, memory, figure, &where, 1, error));
    for (size_t i = 0; i < out->num_panels; i++) {
        ps_script_panel *const own = &out->panels[i];
        const ps_frame *const frame = &own->panel.frame;
        own->x = make_axis(frame->x_label != NULL ? frame->x_label : figure->x_label,
                           are_small ? "0,0.3" : "0,0", figure->is_log_x);
        own->y = make_axis(frame->y_label != NULL ? frame->y_label : figure->y_label,
                           are_small ? "1,0" : "0,0", figure->is_log_y);
        if (!are_small) {
            finish_frame(own, &figure->axes, where.below, out->num_panels == 1);
        }
    }
    if (are_small && figure->shares_axes) {
        share_axes(out);
    }
    return are_small ? add_key(out, memory, figure, &where, error) : PSPEC_OK;
}

/* ---- points ---------------------------------------------------------------------------------- */

static bool are_all(const ps_figure *figure, ps_frame_form form) {
    size_t i = 0;
    while (i < figure->num_panels && figure->panels[i].frame.form == form) {
        i++;
    }
    return i == figure->num_panels;
}

/* Discs and light have no numbers and labels below them. */
static grid find_points(const ps_figure *figure) {
    /* of a panel where there are so many columns: the page stays within 1800 pixels */
    static const double sides[PS_MOST_POINT_COLUMNS] = {860, 600, 480, 370};
    const double side = sides[figure->num_columns - 1];
    const bool are_light = are_all(figure, PS_FRAME_LIGHT); /* of every direction: 2:1 */
    const double height = are_all(figure, PS_FRAME_LINE) ? PS_SCRIPT_LINE_HEIGHT
                          : are_light                    ? side / 2
                                                         : side;
    grid out = {figure->num_columns, figure->num_panels, 44, side, height, 72, 28, 34, 48};
    out.below = are_light || are_all(figure, PS_FRAME_DISC) ? 4 : out.below;
    out.width += out.left + out.right;
    out.height += out.above + out.below;
    return out;
}

pspec_status ps_script_place_points(ps_script_page *out, ps_pool *memory, const ps_figure *figure,
                                    ps_error *error) {
    const grid where = find_points(figure);
    return begin(out, memory, figure, &where, 0, error);
}
