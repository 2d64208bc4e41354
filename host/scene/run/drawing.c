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
        ps_text_append(out, ", %s", picture->value->label);
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

pspec_status ps_draw(const ps_artist *artist, const ps_figure *figure, const ps_picture *picture) {
    ps_text key = {0};
    ps_text svg = {0};
    bool is_found = false;
    pspec_status status = PSPEC_OK;
    ps_text_append(&key, "plot\n%s", ps_text_string(&artist->run->identity));
    ps_figure_add_key(&key, figure);
    PS_TRY_OUT(status, ps_text_check(&key, artist->error));
    PS_TRY_OUT(status, find_svg(artist, &key, &svg, &is_found));
    if (!is_found) {
        PS_TRY_OUT(status, ps_figure_draw_svg(&svg, figure, artist->error));
        PS_TRY_OUT(status, keep_svg(artist, &key, &svg));
    }
    status = ps_run_add_plot(artist, picture, &svg, NULL);
out:
    ps_text_free(&key);
    ps_text_free(&svg);
    return status;
}
