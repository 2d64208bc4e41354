/* Pictures as files and texts: a script of gnuplot, its answer, and what makes that whole. */
#include "plots/plot.h"

#include "base/text.h"
#include "files/output_file.h"
#include "plots/plot_script.h"

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
static const terminal *const svg_terminal = &terminals[1];

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

static pspec_status draw(ps_text *picture, const ps_text *script, const terminal *kind,
                         ps_error *error) {
    PS_TRY(ps_gnuplot_run(script, kind->last, picture, error));
    return kind == svg_terminal ? escape_ends(picture, error) : PSPEC_OK;
}

/* The file is opened first: what cannot be written is not drawn. */
pspec_status ps_figure_write(const char *path, const ps_figure *figure, ps_error *error) {
    ps_output_file *file = NULL;
    ps_text script = {0};
    ps_text picture = {0};
    pspec_status status = PSPEC_OK;
    const terminal *const kind = find_terminal(path);
    PS_TRY(check_places(path, figure, error));
    if (kind == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s: pictures end in .png, .svg or .pdf", path);
    }
    PS_TRY(ps_output_open(&file, path, error));
    PS_TRY_OUT(status, ps_script_print_figure(&script, figure, kind->name, error));
    PS_TRY_OUT(status, draw(&picture, &script, kind, error));
    ps_output_write(file, picture.data, 1, picture.length);
    PS_TRY_OUT(status, ps_output_commit(&file, error));
out:
    ps_output_discard(&file);
    ps_text_free(&script);
    ps_text_free(&picture);
    return status;
}

pspec_status ps_figure_write_script(ps_text *script, const ps_figure *figure, ps_error *error) {
    PS_TRY(check_places(figure->title, figure, error));
    return ps_script_print_figure(script, figure, svg_terminal->name, error);
}

pspec_status ps_plot_draw_script(ps_text *svg, const ps_text *script, ps_error *error) {
    return draw(svg, script, svg_terminal, error);
}
