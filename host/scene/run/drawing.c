/* Pictures from the numbers of tables, or from the cache. */
#include "scene/run/drawing.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* ---- a new picture ----------------------------------------------------------------------- */

void ps_plot_title(const ps_artist *artist, const ps_picture *picture, const char *what,
                   ps_text *out) {
    const ps_scene_result *const asked = artist->result->asked;
    ps_text_append(out, "%s", asked->title != NULL ? asked->title : asked->name);
    if (picture->value != NULL) {
        ps_text_append(out, ", %s", picture->value->originals[0]);
    }
    if (what[0] != '\0') {
        ps_text_append(out, ": %s", what);
    }
}

/* A picture is a function of what is drawn: gnuplot need not run twice for the same. */
static pspec_status find_svg(const ps_artist *artist, const ps_text *key, ps_text *svg,
                             bool *is_found) {
    void *bytes = NULL;
    size_t num = 0;
    ps_error reason = {0};
    *is_found = false;
    if (artist->run->cache != NULL && ps_cache_get(artist->run->cache, key->data, key->length,
                                                   &bytes, &num, is_found, &reason) != PSPEC_OK) {
        ps_run_warn_of_cache(artist->run, &reason);
    }
    if (*is_found) {
        ps_text_append_bytes(svg, bytes, num);
    }
    free(bytes);
    return ps_text_check(svg, artist->error);
}

static pspec_status keep_svg(const ps_artist *artist, const ps_text *key, const ps_text *svg) {
    ps_error reason = {0};
    if (artist->run->cache != NULL && ps_cache_put(artist->run->cache, key->data, key->length,
                                                   svg->data, svg->length, &reason) != PSPEC_OK) {
        ps_run_warn_of_cache(artist->run, &reason);
    }
    return PSPEC_OK;
}

pspec_status ps_run_add_plot(const ps_artist *artist, const ps_picture *picture, ps_text *svg,
                             ps_text *reason) {
    ps_run_result *const result = artist->result;
    void *plots = result->plots;
    PS_TRY(ps_grow(&plots, &result->plot_capacity, result->num_plots + 1, sizeof *result->plots,
                   "pictures", artist->error));
    result->plots = plots;
    ps_run_plot *const plot = &result->plots[result->num_plots++];
    *plot = (ps_run_plot){.what = picture};
    if (svg != NULL) {
        plot->svg = svg->data;
        *svg = (ps_text){0};
    } else {
        plot->reason = reason->data;
        *reason = (ps_text){0};
    }
    return PSPEC_OK;
}

static void add_line_key(ps_text *key, const ps_line_plot *plot) {
    ps_text_append(key, "%s\n%s\n%s\n%d %d\n", plot->title, plot->x_label, plot->y_label,
                   plot->is_log_x, plot->is_log_y);
    for (size_t i = 0; i < plot->num_lines; i++) {
        const ps_plot_line *const line = &plot->lines[i];
        ps_text_append(key, "%s %zu\n", line->label != NULL ? line->label : "", line->num);
        ps_text_append_bytes(key, (const char *)line->x, line->num * sizeof(double));
        ps_text_append_bytes(key, (const char *)line->y, line->num * sizeof(double));
    }
}

static void add_spectra_key(ps_text *key, const ps_plot *plot) {
    ps_text_append(key, "%s\n%d %a\n", plot->title, plot->on_sphere, plot->noise_level_db);
    for (size_t i = 0; i < plot->num_curves; i++) {
        const ps_plot_curve *const curve = &plot->curves[i];
        const size_t bytes = curve->num_bins * sizeof(double);
        ps_text_append(key, "%s %zu\n", curve->label, curve->num_bins);
        ps_text_append_bytes(key, (const char *)curve->normalized_frequency, bytes);
        ps_text_append_bytes(key, (const char *)curve->power, bytes);
        ps_text_append_bytes(key, (const char *)curve->standard_error, bytes);
        ps_text_append_bytes(key, (const char *)curve->anisotropy_db, bytes);
    }
    if (plot->image != NULL) {
        const size_t num = plot->image->size * plot->image->size;
        ps_text_append(key, "%zu %a\n", plot->image->size, plot->image->unit);
        ps_text_append_bytes(key, (const char *)plot->image->power, num * sizeof(double));
    }
}

static void add_panel_key(ps_text *key, const ps_panel_plot *plot) {
    ps_text_append(key, "%s\n%s\n%s\n%d %d %d\n", plot->title, plot->x_label, plot->y_label,
                   plot->has_lines, plot->is_linear_x, plot->is_linear_y);
    for (size_t i = 0; i < plot->num_panels; i++) {
        const ps_plot_panel *const panel = &plot->panels[i];
        ps_text_append(key, "%s %zu\n", panel->title, panel->num_series);
        for (size_t k = 0; k < panel->num_series; k++) {
            const ps_plot_series *const one = &panel->series[k];
            ps_text_append(key, "%s %zu %d %zu\n", one->label, one->kind, one->is_front, one->num);
            ps_text_append_bytes(key, (const char *)one->x, one->num * sizeof(double));
            ps_text_append_bytes(key, (const char *)one->y, one->num * sizeof(double));
        }
    }
}

static void add_key(ps_text *key, const ps_drawing *what) {
    if (what->lines != NULL) {
        add_line_key(key, what->lines);
    } else if (what->panels != NULL) {
        add_panel_key(key, what->panels);
    } else {
        add_spectra_key(key, what->spectra);
    }
}

static pspec_status draw_new(const ps_drawing *what, ps_text *svg, ps_error *error) {
    return what->lines != NULL    ? ps_line_plot_draw_svg(svg, what->lines, error)
           : what->panels != NULL ? ps_panel_plot_draw_svg(svg, what->panels, error)
                                  : ps_plot_draw_svg(svg, what->spectra, error);
}

pspec_status ps_draw(const ps_artist *artist, const ps_drawing *what, const ps_picture *picture) {
    ps_text key = {0};
    ps_text svg = {0};
    bool is_found = false;
    pspec_status status = PSPEC_OK;
    ps_text_append(&key, "plot\n%s", ps_text_string(&artist->run->identity));
    add_key(&key, what);
    PS_TRY_OUT(status, ps_text_check(&key, artist->error));
    PS_TRY_OUT(status, find_svg(artist, &key, &svg, &is_found));
    if (!is_found) {
        PS_TRY_OUT(status, draw_new(what, &svg, artist->error));
        PS_TRY_OUT(status, keep_svg(artist, &key, &svg));
    }
    status = ps_run_add_plot(artist, picture, &svg, NULL);
out:
    ps_text_free(&key);
    ps_text_free(&svg);
    return status;
}
