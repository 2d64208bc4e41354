/* Pictures as files and texts: a script of gnuplot, its answer, and what makes that whole. */
#include "plots/plot.h"

#include "base/text.h"
#include "files/output_file.h"
#include "files/temporary_file.h"
#include "plots/gnuplot.h"
#include "plots/plot_script.h"

#include <errno.h>
#include <string.h>
#include <strings.h>

/* last: the bytes that a whole picture ends in, but for empty lines. */
typedef struct terminal {
    const char *ending, *name, *last;
} terminal;
static const terminal terminals[] = {{".png", "pngcairo", "IEND\xae\x42\x60\x82"},
                                     {".svg", "svg", "</svg>"},
                                     {".pdf", "pdfcairo", "%%EOF"}};
enum { NUM_TERMINALS = sizeof terminals / sizeof terminals[0] };

static const terminal *find_terminal(const char *path) {
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < NUM_TERMINALS; i++) {
        if (strcasecmp(dot, terminals[i].ending) == 0) {
            return &terminals[i];
        }
    }
    return NULL;
}

bool ps_plot_is_supported(const char *path) {
    return find_terminal(path) != NULL;
}

/* Writes the script to a file without a name, and goes back to its start. */
static pspec_status make_script(FILE *script, const ps_figure *figure, const char *terminal_name,
                                ps_error *error) {
    PS_TRY(ps_figure_write_script(figure, terminal_name, script, error));
    errno = 0;
    if (fflush(script) != 0 || ferror(script) || fseeko(script, 0, SEEK_SET) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    return PSPEC_OK;
}

/* name: for the sentence. */
static pspec_status check_places(const char *name, const ps_figure *figure, ps_error *error) {
    size_t num = 0;
    for (size_t i = 0; i < figure->num_panels; i++) {
        for (size_t j = 0; j < figure->panels[i].num_series; j++) {
            num += figure->panels[i].series[j].num;
        }
    }
    return num > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is nothing to plot", name);
}

/* gnuplot writes texts as they are but for < and &; XML does not allow the end of a CDATA section
 * outside of one. */
static pspec_status escape_ends(ps_text *svg, ps_error *error) {
    static const char end[] = "]]>";
    static const char section[] = "<![CDATA[";
    ps_text out = {0};
    const char *from = ps_text_string(svg);
    for (const char *found; (found = strstr(from, end)) != NULL;) {
        const char *const begin = strstr(from, section);
        const bool is_section = begin != NULL && begin < found;
        const size_t length = (size_t)(found - from);
        ps_text_append_bytes(&out, from, length);
        ps_text_append(&out, "%s", is_section ? end : "]]&gt;");
        from = found + strlen(end);
    }
    ps_text_append(&out, "%s", from);
    ps_text_free(svg);
    *svg = out;
    return ps_text_check(svg, error);
}

static pspec_status draw(ps_text *picture, const terminal *kind, const ps_figure *figure,
                         ps_error *error) {
    FILE *script = NULL;
    PS_TRY(ps_temporary_open(&script, error));
    pspec_status status = make_script(script, figure, kind->name, error);
    if (status == PSPEC_OK) {
        status = ps_gnuplot_run(script, kind->last, picture, error);
    }
    fclose(script);
    if (status == PSPEC_OK && strcmp(kind->name, "svg") == 0) {
        status = escape_ends(picture, error);
    }
    return status;
}

/* The file is opened first: what cannot be written is not drawn. */
pspec_status ps_figure_write(const char *path, const ps_figure *figure, ps_error *error) {
    ps_output_file *file = NULL;
    ps_text picture = {0};
    pspec_status status = PSPEC_OK;
    const terminal *const kind = find_terminal(path);
    PS_TRY(check_places(path, figure, error));
    if (kind == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: pictures end in .png, .svg or .pdf", path);
    }
    PS_TRY(ps_output_open(&file, path, error));
    PS_TRY_OUT(status, draw(&picture, kind, figure, error));
    ps_output_write(file, picture.data, 1, picture.length);
    PS_TRY_OUT(status, ps_output_commit(&file, error));
out:
    ps_output_discard(&file);
    ps_text_free(&picture);
    return status;
}

pspec_status ps_figure_draw_svg(ps_text *svg, const ps_figure *figure, ps_error *error) {
    PS_TRY(check_places(figure->title, figure, error));
    return draw(svg, find_terminal(".svg"), figure, error);
}

static void add_numbers(ps_text *key, const double *numbers, size_t num) {
    if (numbers != NULL) {
        ps_text_append_bytes(key, (const char *)numbers, num * sizeof *numbers);
    }
}

static void add_text(ps_text *key, const char *text) {
    ps_text_append(key, "%s\n", text != NULL ? text : "");
}

static void add_axes(ps_text *key, const ps_plot_axes *axes) {
    ps_text_append(key, "%d %d %d %d %d %a %a %a %a\n", axes->has_log, axes->is_log_x,
                   axes->is_log_y, axes->has_x, axes->has_y, axes->x[0], axes->x[1], axes->y[0],
                   axes->y[1]);
}

static void add_frames(ps_text *key, const ps_figure *figure) {
    const size_t num = figure->points != NULL ? 1 : figure->num_panels;
    ps_text_append(key, "%zu\n", figure->num_columns);
    for (size_t i = 0; i < num; i++) {
        const ps_point_frame *const frame = &figure->frames[i];
        add_text(key, frame->x_label);
        add_text(key, frame->y_label);
        ps_text_append(key, "%d %d %a %a\n", (int)frame->form, frame->is_mirrored, frame->first,
                       frame->last);
    }
}

static void add_panel(ps_text *key, const ps_panel *panel) {
    add_text(key, panel->title);
    ps_text_append(key, "%zu\n", panel->num_series);
    for (size_t j = 0; j < panel->num_series; j++) {
        const ps_series *const series = &panel->series[j];
        add_text(key, series->formula);
        add_text(key, series->label);
        ps_text_append(key, "%zu %d %d %zu %a %a\n", series->kind, series->is_front,
                       (int)series->look, series->num, series->num_realizations, series->floor);
        add_numbers(key, series->x, series->num);
        add_numbers(key, series->y, series->num);
        add_numbers(key, series->error, series->num);
        add_numbers(key, series->anisotropy, series->num);
        add_numbers(key, series->low, series->num);
        add_numbers(key, series->high, series->num);
        add_numbers(key, series->fit, series->num);
    }
}

void ps_figure_add_key(ps_text *key, const ps_figure *figure) {
    add_text(key, figure->title);
    add_text(key, figure->x_label);
    add_text(key, figure->y_label);
    ps_text_append(key, "%d %d %d %d\n", (int)figure->form, figure->is_log_x, figure->is_log_y,
                   figure->on_sphere);
    add_axes(key, &figure->axes);
    for (size_t i = 0; i < figure->num_panels; i++) {
        add_panel(key, &figure->panels[i]);
    }
    if (figure->points != NULL) {
        add_panel(key, figure->points);
    }
    for (size_t i = 0; figure->panel_axes != NULL && i < figure->num_panels; i++) {
        add_text(key, figure->panel_axes[i].x_label);
        add_text(key, figure->panel_axes[i].y_label);
        ps_text_append(key, "%d\n", figure->panel_axes[i].is_plane);
    }
    if (figure->frames != NULL) {
        add_frames(key, figure);
    }
    if (figure->image != NULL) {
        ps_text_append(key, "%zu %a %a\n", figure->image->size, figure->image->unit,
                       figure->image->maximum);
        add_numbers(key, figure->image->power, figure->image->size * figure->image->size);
    }
}
