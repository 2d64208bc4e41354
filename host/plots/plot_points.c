/* The gnuplot script of points: squares, lines and discs, whose axes have the same unit. */
#include "math/pi.h"
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

enum { LABEL = 32 }; /* pixels, from the frame to the middle of a label */

/* Half the side that a disc takes, in its radius: its axes have their names outside of it. */
static const double disc_reach = 1.12;

static double width_of(const ps_script_box *where) {
    return where->right - where->left;
}

static double height_of(const ps_script_box *where) {
    return where->bottom - where->top;
}

/* ---- marks ----------------------------------------------------------------------------------- */

static size_t num_points(const ps_panel *panel) {
    size_t num = 0;
    for (size_t j = 0; j < panel->num_series; j++) {
        num += panel->series[j].num;
    }
    return num;
}

/* A third of the distance that so many points have on a grid, as in the figures of the papers; a
 * hundredth of the side where they are few, and never less than is seen. */
double ps_script_mark_size(const ps_panel *panel, double side) {
    const double share = 1.0 / 3;
    const double least = 1.1;
    const double most = side / 100;
    const double num = fmax(1, (double)num_points(panel));
    const double distance = panel->frame.form == PS_FRAME_DISC
                                ? side / 2 / disc_reach * sqrt(PS_PI / num)
                                : side / sqrt(num);
    return fmin(most, fmax(least, share * distance));
}

/* What gnuplot 5.4 draws for "pointtype 7 pointsize 1 linewidth 0.5", looked up in its output: a
 * circle of 6 pixels, or points of 1/72 inch, and its line; in SVG one of 12 pixels at a font of
 * 16. A page in inches has 100 pixels each. */
static double point_size(const char *terminal, double pixels) {
    const double line = 0.5;
    const double unit = 6;
    if (strcmp(terminal, "svg") == 0) {
        return pixels / (2 * unit);
    }
    const bool is_page = strcmp(terminal, "pdfcairo") == 0;
    const double length = is_page ? pixels * 72 / 100 : pixels;
    return fmax(0, length - (is_page ? line / 2 : line)) / unit;
}

/* What points stand in front of: the circle, as a curve, for SVG has circles that are objects in
 * white; else nothing, but gnuplot makes no axes for nothing. */
static void print_ground(ps_text *out, const ps_frame *frame) {
    if (frame->form == PS_FRAME_DISC) {
        ps_text_append(out,
                       "plot sample [t=0:%.9g] '+' using (cos(t)):(sin(t)) with lines linecolor "
                       "rgb '#404040' linewidth 0.8 notitle",
                       PS_TWO_PI);
    } else {
        ps_text_append(out, "plot NaN notitle");
    }
}

/* Circles, on a line bars. */
static void print_marks(ps_text *out, const ps_script_panel *own, const char *terminal,
                        size_t number) {
    const double pixels = ps_script_mark_size(&own->panel, width_of(&own->where));
    const size_t num_series = num_points(&own->panel) > 0 ? own->panel.num_series : 0;
    for (size_t j = 0; j < num_series; j++) {
        ps_text_append(out, ", $data%zu_%zu using ", number, j);
        if (own->panel.frame.form == PS_FRAME_LINE) {
            ps_text_append(out, "1:(-0.6):(0):(1.2) with vectors nohead linewidth 1.2");
        } else {
            ps_text_append(out, "1:2 with points pointtype 7 pointsize %.4f linewidth 0.5",
                           point_size(terminal, pixels));
        }
        ps_text_append(out, " linecolor rgb '#101010' notitle");
    }
}

/* ---- frames ---------------------------------------------------------------------------------- */

static void print_x_range(ps_text *out, const ps_frame *frame, double first, double last) {
    ps_text_append(out, "set xrange [%.9g:%.9g]\n", frame->is_mirrored ? last : first,
                   frame->is_mirrored ? first : last);
}

/* The name of an axis; `system`: of the coordinates of its middle. */
static void print_name(ps_text *out, int number, const char *name, const char *system, double x,
                       double y, const char *turn) {
    ps_text_append(out, "set label %d ", number);
    ps_script_print_text(out, name);
    ps_text_append(out, " at %s %.5f,%.5f center %s\n", system, x, y, turn);
}

/* A square or a line: the ends of its axes are all the numbers there are. */
static void print_square(ps_text *out, const ps_script_box *where, const ps_frame *frame) {
    const double first = frame->first;
    const double last = frame->last;
    const bool is_line = frame->form == PS_FRAME_LINE;
    print_x_range(out, frame, first, last);
    ps_text_append(out,
                   "set xtics (%.9g, %.9g) out nomirror scale 0.6\n"
                   "set border %d linewidth 0.8 linecolor '#404040'\n",
                   first, last, is_line ? 1 : 15);
    print_name(out, 2, frame->x_label, "graph", 0.5, -(double)LABEL / height_of(where), "");
    if (is_line) {
        ps_text_append(out, "set yrange [-1:1]\nunset ytics\n");
        return;
    }
    ps_text_append(out, "set yrange [%.9g:%.9g]\nset ytics (%.9g, %.9g) out nomirror scale 0.6\n",
                   first, last, first, last);
    print_name(out, 3, frame->y_label, "graph", -(double)LABEL / width_of(where), 0.5,
               "rotate by 90");
}

static void print_disc(ps_text *out, const ps_script_box *where, const ps_frame *frame) {
    const double pixels = 15; /* from the circle to the middle of a name */
    const double beside = 1 + pixels * 2 * disc_reach / width_of(where);
    print_x_range(out, frame, -disc_reach, disc_reach);
    ps_text_append(out,
                   "unset border\nunset xtics\nunset ytics\n"
                   "set yrange [%.9g:%.9g]\n",
                   -disc_reach, disc_reach);
    print_name(out, 2, frame->x_label, "first", beside, 0, "");
    print_name(out, 3, frame->y_label, "first", 0, beside, "");
}

void ps_script_print_points(ps_text *out, const ps_script_page *page, size_t number) {
    const ps_script_panel *const own = &page->panels[number];
    const ps_frame *const frame = &own->panel.frame;
    if (frame->form == PS_FRAME_DISC) {
        print_disc(out, &own->where, frame);
    } else {
        print_square(out, &own->where, frame);
    }
    print_ground(out, frame);
    print_marks(out, own, page->terminal, number);
}
