/* The gnuplot script of points: panels of squares, lines and discs, whose axes have the same unit.
 */
#include "math/pi.h"
#include "plots/plot_script.h"

#include <math.h>
#include <string.h>

/* Pixels: the head of the page; what stands around a frame, with its title above and numbers and
 * labels below, which discs do not have; the middle of a label from the frame. */
enum { HEAD = 44, LEFT = 72, RIGHT = 28, ABOVE = 34, BELOW = 48, BELOW_DISC = 4 };
enum { LINE_HEIGHT = 60, LABEL = 32 };

/* The side of a frame where there are so many columns: the page stays within 1800 pixels. */
static const int sides[PS_MOST_POINT_COLUMNS] = {860, 600, 480, 370};

/* Half the side that a disc takes, in its radius: its axes have their names outside of it. */
static const double disc_reach = 1.12;

static int side_of(const ps_figure *figure) {
    return sides[figure->num_columns - 1];
}

static bool are_all(const ps_figure *figure, ps_frame_form form) {
    size_t i = 0;
    while (i < figure->num_panels && figure->frames[i].form == form) {
        i++;
    }
    return i == figure->num_panels;
}

static int frame_height(const ps_figure *figure) {
    return are_all(figure, PS_FRAME_LINE) ? LINE_HEIGHT : side_of(figure);
}

/* Of a row of panels. */
static int row_height(const ps_figure *figure) {
    return ABOVE + frame_height(figure) + (are_all(figure, PS_FRAME_DISC) ? BELOW_DISC : BELOW);
}

static size_t num_rows(const ps_figure *figure) {
    return (figure->num_panels + figure->num_columns - 1) / figure->num_columns;
}

void ps_script_size_points(const ps_figure *figure, int *width, int *height) {
    *width = (int)figure->num_columns * (LEFT + side_of(figure) + RIGHT);
    *height = HEAD + (int)num_rows(figure) * row_height(figure);
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
static double find_mark_size(const ps_panel *panel, const ps_point_frame *frame, double side) {
    const double share = 1.0 / 3;
    const double least = 1.1;
    const double most = side / 100;
    const double num = fmax(1, (double)num_points(panel));
    const double distance =
        frame->form == PS_FRAME_DISC ? side / 2 / disc_reach * sqrt(PS_PI / num) : side / sqrt(num);
    return fmin(most, fmax(least, share * distance));
}

double ps_script_mark_size(const ps_figure *figure, size_t panel) {
    return find_mark_size(&figure->panels[panel], &figure->frames[panel], side_of(figure));
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

static double width_of(const ps_script_box *where) {
    return where->right - where->left;
}

static double height_of(const ps_script_box *where) {
    return where->bottom - where->top;
}

/* Circles, on a line bars. */
static void print_look(const ps_script_points *what, FILE *stream) {
    if (what->frame->form == PS_FRAME_LINE) {
        fputs("using 1:(-0.6):(0):(1.2) with vectors nohead linewidth 1.2 ", stream);
        return;
    }
    const double pixels = find_mark_size(what->panel, what->frame, width_of(&what->where));
    fprintf(stream, "using 1:2 with points pointtype 7 pointsize %.4f linewidth 0.5 ",
            point_size(what->terminal, pixels));
}

/* What points stand in front of: the circle, as a curve, for SVG has circles that are objects in
 * white; else nothing, but gnuplot makes no axes for nothing. */
static void print_ground(const ps_point_frame *frame, FILE *stream) {
    if (frame->form == PS_FRAME_DISC) {
        fprintf(stream,
                "plot sample [t=0:%.9g] '+' using (cos(t)):(sin(t)) with lines linecolor rgb "
                "'#404040' linewidth 0.8 notitle",
                PS_TWO_PI);
    } else {
        fputs("plot NaN notitle", stream);
    }
}

static void print_marks(const ps_script_points *what, FILE *stream) {
    const size_t num_series = num_points(what->panel) > 0 ? what->panel->num_series : 0;
    print_ground(what->frame, stream);
    for (size_t j = 0; j < num_series; j++) {
        fprintf(stream, ", %s_%zu ", what->data, j);
        print_look(what, stream);
        fputs("linecolor rgb '#101010' notitle", stream);
    }
    putc('\n', stream);
}

/* ---- frames ---------------------------------------------------------------------------------- */

static void print_x_range(const ps_point_frame *frame, double first, double last, FILE *stream) {
    fprintf(stream, "set xrange [%.9g:%.9g]\n", frame->is_mirrored ? last : first,
            frame->is_mirrored ? first : last);
}

/* The name of an axis, in the middle of it. */
static void print_name(int number, const char *name, double x, double y, const char *turn,
                       FILE *stream) {
    fprintf(stream, "set label %d ", number);
    ps_script_print_text(name, stream);
    fprintf(stream, " at graph %.5f,%.5f center %s\n", x, y, turn);
}

/* A square or a line: the ends of its axes are all the numbers there are. */
static void print_square(const ps_script_box *where, const ps_point_frame *frame, FILE *stream) {
    const double first = frame->first;
    const double last = frame->last;
    const bool is_line = frame->form == PS_FRAME_LINE;
    print_x_range(frame, first, last, stream);
    fprintf(stream,
            "set xtics (%.9g, %.9g) out nomirror scale 0.6\n"
            "set border %d linewidth 0.8 linecolor '#404040'\n",
            first, last, is_line ? 1 : 15);
    print_name(2, frame->x_label, 0.5, -(double)LABEL / height_of(where), "", stream);
    if (is_line) {
        fputs("set yrange [-1:1]\nunset ytics\n", stream);
        return;
    }
    fprintf(stream, "set yrange [%.9g:%.9g]\nset ytics (%.9g, %.9g) out nomirror scale 0.6\n",
            first, last, first, last);
    print_name(3, frame->y_label, -(double)LABEL / width_of(where), 0.5, "rotate by 90", stream);
}

static void print_disc(const ps_script_box *where, const ps_point_frame *frame, FILE *stream) {
    const double pixels = 15; /* from the circle to the middle of a name */
    const double beside = 1 + pixels * 2 * disc_reach / width_of(where);
    print_x_range(frame, -disc_reach, disc_reach, stream);
    fprintf(stream,
            "unset border\nunset xtics\nunset ytics\n"
            "set yrange [%.9g:%.9g]\nset label 2 ",
            -disc_reach, disc_reach);
    ps_script_print_text(frame->x_label, stream);
    fprintf(stream, " at first %g,0 center\nset label 3 ", beside);
    ps_script_print_text(frame->y_label, stream);
    fprintf(stream, " at first 0,%g center\n", beside);
}

static void print_panel(const ps_script_points *what, FILE *stream) {
    ps_script_print_margins(&what->where, stream);
    fputs("set title ", stream);
    ps_script_print_text(what->panel->title, stream);
    fputs(" noenhanced offset 0,-0.5\n", stream);
    if (what->frame->form == PS_FRAME_DISC) {
        print_disc(&what->where, what->frame, stream);
    } else {
        print_square(&what->where, what->frame, stream);
    }
    print_marks(what, stream);
}

/* The line is in the middle. */
void ps_script_print_beside(const ps_script_points *what, FILE *stream) {
    ps_script_points own = *what;
    if (what->frame->form == PS_FRAME_LINE) {
        own.where.top = (what->where.top + what->where.bottom - LINE_HEIGHT) / 2;
        own.where.bottom = own.where.top + LINE_HEIGHT;
    }
    fputs("unset key\n", stream);
    print_panel(&own, stream);
    fputs("unset title\nunset label\nset border 31 linewidth 0.8 linecolor "
          "'#404040'\nset xtics scale default autofreq\nset ytics scale default autofreq\n",
          stream);
}

static ps_script_box find_cell(const ps_figure *figure, size_t cell) {
    int width = 0;
    int height = 0;
    ps_script_size_points(figure, &width, &height);
    const int side = side_of(figure);
    const double x = (double)(cell % figure->num_columns) * (LEFT + side + RIGHT) + LEFT;
    const double y = HEAD + (double)(cell / figure->num_columns) * row_height(figure) + ABOVE;
    return (ps_script_box){x, y, x + side, y + frame_height(figure), width, height};
}

void ps_script_print_points(const ps_figure *figure, const char *terminal, FILE *stream) {
    enum { NAME_BYTES = 32 };
    fputs("unset key\n", stream);
    for (size_t i = 0; i < figure->num_panels; i++) {
        char name[NAME_BYTES];
        snprintf(name, sizeof name, "$data%zu", i);
        if (i > 0) {
            fputs("unset label\n", stream); /* the page has its title */
        }
        print_panel(&(ps_script_points){&figure->panels[i], &figure->frames[i],
                                        find_cell(figure, i), name, terminal},
                    stream);
    }
}
