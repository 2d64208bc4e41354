/* The gnuplot script of a figure: data, then the panels of its page, each from its beginning. */
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

/* ---- data ----------------------------------------------------------------------------------- */

/* Columns 1 and 2 are x and y; where there is more, 3 is the error, 4 and 5 are the ends of the
 * band, 6 is the fit, NaN for what there is not. */
static void print_places(ps_text *out, const ps_script_panel *panel, const ps_series *series) {
    const double *const more[] = {series->error, series->low, series->high, series->fit};
    const bool has_band = series->low != NULL && series->high != NULL;
    const bool has_more = series->error != NULL || has_band || series->fit != NULL;
    const size_t num_more = sizeof more / sizeof more[0] - (series->fit == NULL);
    for (size_t place = 0; place < series->num; place++) {
        const bool is_shown = ps_script_is_shown(panel, series, place);
        ps_script_print_value(out, series->x[place]);
        ps_script_print_value(out, is_shown ? series->y[place] : NAN);
        for (size_t i = 0; has_more && i < num_more; i++) {
            ps_script_print_value(out, more[i] != NULL ? more[i][place] : NAN);
        }
        ps_text_append(out, "\n");
    }
}

/* $data0_1 is series 1 of panel 0. */
static void print_data(ps_text *out, const ps_script_page *page) {
    for (size_t i = 0; i < page->num_panels; i++) {
        const ps_script_panel *const own = &page->panels[i];
        for (size_t j = 0; j < own->panel.num_series; j++) {
            if (own->panel.series[j].num > 0 || own->panel.frame.form >= PS_FRAME_SQUARE) {
                ps_text_append(out, "$data%zu_%zu << EOD\n", i, j);
                if (own->panel.frame.form >= PS_FRAME_PIXELS) {
                    ps_script_print_pixel_data(out, &own->panel);
                } else {
                    print_places(out, own, &own->panel.series[j]);
                }
                ps_text_append(out, "EOD\n");
            }
        }
    }
}

/* ---- panels ---------------------------------------------------------------------------------- */

static bool is_svg(const ps_script_page *page) {
    return strcmp(page->terminal, "svg") == 0;
}

static void print_terminal(ps_text *out, const ps_script_page *page) {
    if (strcmp(page->terminal, "pdfcairo") == 0) { /* in inches; 100 pixels each */
        ps_text_append(out,
                       "set terminal pdfcairo enhanced color size %gin,%gin font 'Sans,11.5'\n",
                       page->width / 100.0, page->height / 100.0);
    } else {
        ps_text_append(out, "set terminal %s enhanced size %d,%d background '#ffffff' font '%s'\n",
                       page->terminal, page->width, page->height,
                       is_svg(page) ? "sans-serif,16" : "Sans,12");
    }
    ps_text_append(out, "set encoding utf8\n");
}

/* In so many pixels: of what is longer the middle is left out, for N stands at the end. */
static void print_title(ps_text *out, const ps_script_page *page, const char *title) {
    enum { LETTER = 11 };
    char cut[PS_SCRIPT_CUT_BYTES];
    const size_t room = (size_t)(page->width - page->title_left) / LETTER;
    ps_text_append(out, "set label 1 ");
    ps_script_print_text(out, ps_script_cut(cut, title, room));
    ps_text_append(out, " at screen %.4g,%.4g center noenhanced font ',%d'\n",
                   (page->title_left + page->width) / 2.0 / page->width, 1 - 26.6 / page->height,
                   is_svg(page) ? 20 : 15); /* svg counts pixels, the others points */
}

static void print_margins(ps_text *out, const ps_script_box *where) {
    ps_text_append(out,
                   "set lmargin at screen %.5f\nset rmargin at screen %.5f\n"
                   "set tmargin at screen %.5f\nset bmargin at screen %.5f\n",
                   where->left / where->page_width, where->right / where->page_width,
                   1 - where->top / where->page_height, 1 - where->bottom / where->page_height);
}

/* A line at white noise, where it is in sight. */
static void print_white(ps_text *out, ps_plot_span shown) {
    if (shown.least < 1 && shown.most > 1) {
        ps_text_append(out, "set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead back "
                            "linecolor '#707070' linewidth 1\n");
    }
}

/* Where there is nothing to see an axis needs ends. */
static ps_script_axis with_ends(const ps_script_axis *own, bool has_places) {
    ps_script_axis out = *own;
    if (!has_places && !(own->shown.least < own->shown.most)) {
        out.shown = (ps_plot_span){1, 10};
    }
    return out;
}

static void print_axes(ps_text *out, const ps_script_panel *panel) {
    const bool has_places = ps_script_has_places(panel);
    const ps_script_axis x = with_ends(&panel->x, has_places);
    const ps_script_axis y = with_ends(&panel->y, has_places);
    ps_text_append(out, panel->is_key
                            ? "unset border\nunset tics\n"
                            : "set xtics in mirror\nset ytics in mirror\n"
                              "set grid linecolor '#d8d8d8' linewidth 0.8 dashtype solid\n");
    ps_script_print_axis(out, "x", &x);
    ps_script_print_axis(out, "y", &y);
    if (panel->has_white) {
        print_white(out, panel->y.shown);
    }
}

/* Bars would blank out what is below their middle; an interval of 0 is as if nothing was said. */
static const char beginning[] = "reset\nset pointintervalbox 0.01\n"
                                "set border linewidth 0.8 linecolor '#404040'\n"
                                "set tics textcolor '#202020'\n";

/* title: of the page, in its first panel; NULL in others. */
static void print_panel(ps_text *out, const ps_script_page *page, size_t number,
                        const char *title) {
    const ps_script_panel *const own = &page->panels[number];
    ps_text_append(out, "%s", beginning);
    print_margins(out, &own->where);
    if (title != NULL) {
        print_title(out, page, title);
    }
    if (own->panel.title != NULL) {
        ps_text_append(out, "set title ");
        ps_script_print_text(out, own->panel.title);
        ps_text_append(out, " noenhanced offset 0,-0.6\n");
    }
    ps_script_print_key(out, &own->key);
    if (own->raster.size > 0) {
        ps_script_print_image(out, own);
    } else if (own->panel.frame.form >= PS_FRAME_PIXELS) {
        ps_script_print_pixels(out, own, number);
    } else if (own->panel.frame.form >= PS_FRAME_SQUARE) {
        ps_script_print_points(out, page, number);
    } else {
        print_axes(out, own);
        ps_text_append(out, "plot ");
        ps_script_print_series(out, own, number);
    }
    ps_text_append(out, "\n");
}

/* ---- the script ------------------------------------------------------------------------------ */

/* Scales as they were asked for. */
static ps_figure with_axes(const ps_figure *figure) {
    ps_figure out = *figure;
    if (figure->axes.has_log) {
        out.is_log_x = figure->axes.is_log_x;
        out.is_log_y = figure->axes.is_log_y;
    }
    return out;
}

/* A frame that is alone has to show something, as zeros on a logarithmic axis do not. */
static pspec_status check_frame(const ps_script_page *page, const ps_figure *figure,
                                ps_error *error) {
    return figure->form != PS_FIGURE_FRAME || figure->num_panels > 1 ||
                   ps_script_has_places(&page->panels[0])
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "there is nothing to plot: none of its numbers has a place on its axes");
}

pspec_status ps_script_print_figure(ps_text *out, const ps_figure *asked, const char *terminal,
                                    ps_error *error) {
    static ps_script_place *const places[] = {[PS_FIGURE_SPECTRA] = ps_script_place_spectra,
                                              [PS_FIGURE_FRAME] = ps_script_place_panels,
                                              [PS_FIGURE_PANELS] = ps_script_place_panels,
                                              [PS_FIGURE_POINTS] = ps_script_place_points};
    const ps_figure figure = with_axes(asked);
    ps_script_page page = {.terminal = terminal};
    ps_pool memory = {0};
    pspec_status status = places[figure.form](&page, &memory, &figure, error);
    if (status == PSPEC_OK) {
        status = check_frame(&page, &figure, error);
    }
    if (status == PSPEC_OK) {
        print_terminal(out, &page);
        print_data(out, &page);
        ps_text_append(out, "set multiplot\n");
        for (size_t i = 0; i < page.num_panels; i++) {
            print_panel(out, &page, i, i == 0 ? figure.title : NULL);
        }
        ps_text_append(out, "unset multiplot\n");
        status = ps_text_check(out, error);
    }
    ps_pool_free(&memory);
    return status;
}
