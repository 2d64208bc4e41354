/* The gnuplot script of a figure: page, data, and what its form asks for. */
#include "plots/plot_script.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

/* ---- data ----------------------------------------------------------------------------------- */

/* Columns 1 and 2 are x and y; where there is more, 3 is the error, 4 the anisotropy, 5 and 6 are
 * the ends of the band, 7 is the fit, NaN for what there is not. */
static void print_series(const ps_figure *figure, const ps_series *series, FILE *stream) {
    const double *const more[] = {series->error, series->anisotropy, series->low, series->high,
                                  series->fit};
    const bool has_more = series->error != NULL || series->anisotropy != NULL ||
                          (series->low != NULL && series->high != NULL);
    const size_t num_more = sizeof more / sizeof more[0] - (series->fit == NULL);
    for (size_t place = 0; place < series->num; place++) {
        const bool is_shown = ps_script_is_shown(figure, series, place);
        ps_script_print_value(series->x[place], stream);
        ps_script_print_value(is_shown ? series->y[place] : NAN, stream);
        for (size_t i = 0; has_more && i < num_more; i++) {
            ps_script_print_value(more[i] != NULL ? more[i][place] : NAN, stream);
        }
        putc('\n', stream);
    }
}

/* Block name_1 is series 1 of the panel. */
static void print_blocks(const ps_figure *figure, const ps_panel *panel, const char *name,
                         FILE *stream) {
    for (size_t j = 0; j < panel->num_series; j++) {
        fprintf(stream, "%s_%zu << EOD\n", name, j);
        print_series(figure, &panel->series[j], stream);
        fputs("EOD\n", stream);
    }
}

/* $data0_1 is series 1 of panel 0. */
static void print_data(const ps_figure *figure, FILE *stream) {
    enum { NAME_BYTES = 32 };
    const ps_figure linear = {0}; /* points may be at 0 */
    for (size_t i = 0; i < figure->num_panels; i++) {
        char name[NAME_BYTES];
        snprintf(name, sizeof name, "$data%zu", i);
        print_blocks(figure, &figure->panels[i], name, stream);
    }
    if (figure->points != NULL) {
        print_blocks(&linear, figure->points, "$points", stream);
    }
}

/* ---- the script ------------------------------------------------------------------------------ */

/* In so many pixels: of what is longer the middle is left out, for N stands at the end. */
static void print_title(const char *title, int width, FILE *stream) {
    enum { LETTER = 11 };
    char cut[PS_SCRIPT_CUT_BYTES];
    ps_script_print_text(ps_script_cut(cut, title, (size_t)width / LETTER), stream);
}

/* left: where the part begins that the title stands over. */
static void print_page(const char *title, int left, const char *terminal, int width, int height,
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
    /* Bars would blank out what is below their middle; 0 is as if nothing was said. */
    fputs("set pointintervalbox 0.01\n", stream);
    fputs("set border linewidth 0.8 linecolor '#404040'\nset tics textcolor '#202020'\n", stream);
    fputs("set multiplot\nset label 1 ", stream);
    print_title(title, width - left, stream);
    fprintf(stream, " at screen %.4g,%.4g center noenhanced font ',%d'\n",
            (left + width) / 2.0 / width, 1 - 26.6 / height,
            strcmp(terminal, "svg") == 0 ? 20 : 15); /* svg counts pixels, the others points */
}

/* Scales as they were asked for. */
static ps_figure with_axes(const ps_figure *figure) {
    ps_figure out = *figure;
    if (figure->axes.has_log) {
        out.is_log_x = figure->axes.is_log_x;
        out.is_log_y = figure->axes.is_log_y;
    }
    return out;
}

pspec_status ps_script_print_figure(const ps_figure *asked, const char *terminal, FILE *stream,
                                    ps_error *error) {
    const ps_figure own = with_axes(asked);
    const ps_figure *const figure = &own;
    int width = PS_SCRIPT_WIDTH;
    int height = PS_SCRIPT_HEIGHT;
    if (figure->form == PS_FIGURE_SPECTRA) {
        ps_script_size_spectra(figure, &width, &height);
    }
    if (figure->form == PS_FIGURE_PANELS || figure->form == PS_FIGURE_MARKS) {
        ps_script_size_panels(figure, &width, &height);
    }
    if (figure->form == PS_FIGURE_FRAME) {
        ps_script_size_frames(figure, &width, &height);
    }
    if (figure->form == PS_FIGURE_POINTS) {
        ps_script_size_points(figure, &width, &height);
    }
    print_page(figure->title, ps_script_title_left(figure), terminal, width, height, stream);
    print_data(figure, stream);
    switch (figure->form) {
    case PS_FIGURE_SPECTRA:
        PS_TRY(ps_script_print_spectra(figure, terminal, stream, error));
        break;
    case PS_FIGURE_FRAME:
        ps_script_print_frames(figure, stream);
        break;
    case PS_FIGURE_PANELS:
    case PS_FIGURE_MARKS:
        ps_script_print_panels(figure, stream);
        break;
    case PS_FIGURE_POINTS:
        ps_script_print_points(figure, terminal, stream);
        break;
    }
    fputs("unset multiplot\n", stream);
    return PSPEC_OK;
}
