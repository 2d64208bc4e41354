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

/* A picture of one kind; the others are NULL. */
typedef struct drawing {
    const ps_plot *spectra;
    const ps_line_plot *lines;
    const ps_panel_plot *panels;
} drawing;

/* Writes the script to a file without a name, and goes back to its start. */
static pspec_status make_script(FILE *script, const drawing *what, const char *terminal_name,
                                ps_error *error) {
    if (what->spectra != NULL) {
        PS_TRY(ps_plot_write_script(what->spectra, terminal_name, script, error));
    } else if (what->lines != NULL) {
        ps_line_plot_write_script(what->lines, terminal_name, script);
    } else {
        ps_panel_plot_write_script(what->panels, terminal_name, script);
    }
    errno = 0;
    if (fflush(script) != 0 || ferror(script) || fseeko(script, 0, SEEK_SET) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot write a temporary file: %s", strerror(errno));
    }
    return PSPEC_OK;
}

/* num: of places in all curves together. */
static pspec_status check_plot(const char *name, size_t num, ps_error *error) {
    return num > 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "%s: there is nothing to plot", name);
}

/* gnuplot writes texts as they are but for < and &; XML does not allow the end of a CDATA section outside of one. */
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

static pspec_status draw(ps_text *picture, const terminal *kind, const drawing *what,
                         ps_error *error) {
    FILE *script = NULL;
    PS_TRY(ps_temporary_open(&script, error));
    pspec_status status = make_script(script, what, kind->name, error);
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
static pspec_status draw_file(const char *path, const drawing *what, ps_error *error) {
    ps_output_file *file = NULL;
    ps_text picture = {0};
    pspec_status status = PSPEC_OK;
    const terminal *const kind = find_terminal(path);
    if (kind == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: pictures end in .png, .svg or .pdf", path);
    }
    PS_TRY(ps_output_open(&file, path, error));
    PS_TRY_OUT(status, draw(&picture, kind, what, error));
    ps_output_write(file, picture.data, 1, picture.length);
    PS_TRY_OUT(status, ps_output_commit(&file, error));
out:
    ps_output_discard(&file);
    ps_text_free(&picture);
    return status;
}

static size_t count_bins(const ps_plot *plot) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_curves; i++) {
        num += plot->curves[i].num_bins;
    }
    return num;
}

static size_t count_places(const ps_line_plot *plot) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_lines; i++) {
        num += plot->lines[i].num;
    }
    return num;
}

pspec_status ps_plot_write(const char *path, const ps_plot *plot, ps_error *error) {
    PS_TRY(check_plot(path, count_bins(plot), error));
    return draw_file(path, &(drawing){.spectra = plot}, error);
}

pspec_status ps_line_plot_write(const char *path, const ps_line_plot *plot, ps_error *error) {
    PS_TRY(check_plot(path, count_places(plot), error));
    return draw_file(path, &(drawing){.lines = plot}, error);
}

pspec_status ps_plot_draw_svg(ps_text *svg, const ps_plot *plot, ps_error *error) {
    PS_TRY(check_plot(plot->title, count_bins(plot), error));
    return draw(svg, find_terminal(".svg"), &(drawing){.spectra = plot}, error);
}

pspec_status ps_line_plot_draw_svg(ps_text *svg, const ps_line_plot *plot, ps_error *error) {
    PS_TRY(check_plot(plot->title, count_places(plot), error));
    return draw(svg, find_terminal(".svg"), &(drawing){.lines = plot}, error);
}

static size_t count_panels(const ps_panel_plot *plot) {
    size_t num = 0;
    for (size_t i = 0; i < plot->num_panels; i++) {
        for (size_t j = 0; j < plot->panels[i].num_series; j++) {
            num += plot->panels[i].series[j].num;
        }
    }
    return num;
}

pspec_status ps_panel_plot_write(const char *path, const ps_panel_plot *plot, ps_error *error) {
    PS_TRY(check_plot(path, count_panels(plot), error));
    return draw_file(path, &(drawing){.panels = plot}, error);
}

pspec_status ps_panel_plot_draw_svg(ps_text *svg, const ps_panel_plot *plot, ps_error *error) {
    PS_TRY(check_plot(plot->title, count_panels(plot), error));
    return draw(svg, find_terminal(".svg"), &(drawing){.panels = plot}, error);
}
