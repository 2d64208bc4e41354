#include "scene/run/pictures.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>

/* A picture has at most so many panels: a page of more is longer than anyone scrolls. Where panels
 * do not share their curves the key has one line for each, and room for fewer. */
enum { MOST_PANELS = 12, MOST_PANELS_OF_OTHERS = 3 };

bool ps_run_varies(const ps_scene_entry *entry) {
    return entry->num_values > 1;
}

/* ---- which curves go together ---------------------------------------------------------------- */

/* How curves are dealt out: to pictures by the values of entry `group`, to panels by those of
 * `panel`, or in turn, `chunk` at a time. Entries: num_entries is none. */
typedef struct layout {
    size_t points, group, panel;
    size_t num_curves; /* of a picture */
    size_t chunk;
} layout;

static size_t count_values(const ps_scene_result *asked, size_t entry) {
    return entry < asked->num_entries ? asked->entries[entry].num_values : 1;
}

static bool is_free(const ps_scene_result *asked, const layout *how, size_t entry) {
    return entry != how->points && entry != how->group && ps_run_varies(&asked->entries[entry]);
}

/* The entry with the fewest values that leaves few enough curves, and not a single one, for each of
 * them. */
static size_t find_panels(const ps_scene_result *asked, const layout *how) {
    size_t best = asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        const size_t num = asked->entries[i].num_values;
        const size_t num_left = how->num_curves / num;
        if (is_free(asked, how, i) && num_left > 1 && num_left <= PS_MOST_CURVES &&
            (best == asked->num_entries || num < asked->entries[best].num_values)) {
            best = i;
        }
    }
    return best;
}

/* Values of the entry that changes fastest, in panels of nearly the same number. */
static size_t find_chunk(const ps_scene_result *asked, const layout *how) {
    size_t num = 1;
    for (size_t i = 0; i < asked->num_entries; i++) {
        num = is_free(asked, how, i) ? asked->entries[i].num_values : num;
    }
    const size_t num_chunks = (num + PS_MOST_CURVES - 1) / PS_MOST_CURVES;
    return (num + num_chunks - 1) / num_chunks;
}

/* Too many curves for a frame: a picture for each value of the first entry that varies, unless that
 * alone would be the curve; then panels. */
static layout find_layout(const ps_scene_result *asked, size_t points, bool has_singles) {
    const size_t none = asked->num_entries;
    layout how = {points, none, none, 0, 0};
    how.num_curves = ps_scene_num_questions(asked) / count_values(asked, points);
    size_t first = 0;
    while (first < none && !is_free(asked, &how, first)) {
        first++;
    }
    const size_t num_left = how.num_curves / count_values(asked, first);
    if (how.num_curves > PS_MOST_CURVES && (num_left > 1 || has_singles)) {
        how.group = first;
        how.num_curves = num_left;
    }
    if (how.num_curves > PS_MOST_CURVES) {
        how.panel = find_panels(asked, &how);
        how.chunk = how.panel == none ? find_chunk(asked, &how) : 0;
    }
    return how;
}

static bool has_value(const ps_scene_result *asked, size_t question, size_t entry, size_t index) {
    return entry >= asked->num_entries ||
           ps_scene_value_of(asked, question, entry) == &asked->entries[entry].values[index];
}

/* Appends the questions of a picture with one value of the entry of panels. */
static void take_questions(ps_picture *picture, const ps_scene_result *asked, const layout *how,
                           size_t group_index, size_t panel_index) {
    const size_t num = ps_scene_num_questions(asked);
    for (size_t q = 0; q < num; q++) {
        if (has_value(asked, q, how->group, group_index) && has_value(asked, q, how->points, 0) &&
            has_value(asked, q, how->panel, panel_index)) {
            picture->curves[picture->num_curves++] = q;
        }
    }
}

/* All curves of a picture, and where its panels end. */
static void fill(ps_picture *picture, const ps_scene_result *asked, const layout *how,
                 size_t group_index) {
    for (size_t i = 0; i < count_values(asked, how->panel); i++) {
        take_questions(picture, asked, how, group_index, i);
        picture->ends[picture->num_panels++] = picture->num_curves;
    }
    if (how->chunk > 0) {
        size_t fastest = asked->num_entries - 1; /* some entry is free: there are chunks of it */
        while (!is_free(asked, how, fastest)) {
            fastest--;
        }
        const size_t run = asked->entries[fastest].num_values;
        picture->num_panels = 0;
        for (size_t at = 0; at < picture->num_curves;) {
            const size_t left = run - at % run;
            at += left < how->chunk ? left : how->chunk;
            picture->ends[picture->num_panels++] = at;
        }
    }
}

/* ---- the list -------------------------------------------------------------------------------- */

static pspec_status allocate_curves(ps_picture *picture, size_t num, ps_error *error) {
    PS_TRY(PS_NEW(&picture->curves, 2 * num, "a picture", error));
    picture->ends = picture->curves + num;
    return PSPEC_OK;
}

static pspec_status add(ps_pictures *list, const ps_picture *one, size_t num_curves,
                        ps_error *error) {
    void *memory = list->all;
    PS_TRY(ps_grow(&memory, &list->capacity, list->num + 1, sizeof *list->all, "pictures", error));
    list->all = memory;
    ps_picture *const picture = &list->all[list->num];
    *picture = *one;
    PS_TRY(allocate_curves(picture, num_curves, error));
    list->num++;
    return PSPEC_OK;
}

/* Panels first .. first + num - 1 of a picture as one of its own. */
static pspec_status add_page(ps_pictures *list, const ps_picture *whole, size_t first, size_t num,
                             ps_error *error) {
    const size_t begin = first > 0 ? whole->ends[first - 1] : 0;
    const size_t num_curves = whole->ends[first + num - 1] - begin;
    PS_TRY(add(list, whole, num_curves, error));
    ps_picture *const picture = &list->all[list->num - 1];
    picture->num_curves = num_curves;
    picture->num_panels = num;
    for (size_t i = 0; i < num_curves; i++) {
        picture->curves[i] = whole->curves[begin + i];
    }
    for (size_t i = 0; i < num; i++) {
        picture->ends[i] = whole->ends[first + i] - begin;
    }
    return PSPEC_OK;
}

/* Pages of panels, as few as there can be, of nearly the same number. */
static pspec_status add_pages(ps_pictures *list, ps_picture *whole, bool is_chunked,
                              ps_error *error) {
    const size_t most = is_chunked ? MOST_PANELS_OF_OTHERS : MOST_PANELS;
    const size_t num_pages = (whole->num_panels + most - 1) / most;
    char suffix[PS_SUFFIX_BYTES];
    snprintf(suffix, sizeof suffix, "%s", whole->suffix);
    for (size_t page = 0; page < num_pages; page++) {
        const size_t first = page * whole->num_panels / num_pages;
        const size_t end = (page + 1) * whole->num_panels / num_pages;
        if (page > 0) {
            snprintf(whole->suffix, sizeof whole->suffix, "%.64s-page-%zu", suffix, page + 1);
        }
        PS_TRY(add_page(list, whole, first, end - first, error));
    }
    return PSPEC_OK;
}

/* The picture of one group, or its pages. */
static pspec_status add_group(ps_pictures *list, const ps_scene_result *asked, ps_picture one,
                              const layout *how, size_t index, ps_error *error) {
    const char *const stem = one.lines != NULL ? one.lines->suffix : "";
    const bool is_group = how->group < asked->num_entries;
    one.group = how->group;
    one.points = how->points;
    one.panel = how->panel;
    one.value = is_group ? &asked->entries[how->group].values[index] : NULL;
    if (is_group) {
        snprintf(one.suffix, sizeof one.suffix, "%s-%zu", stem, index + 1);
    } else {
        snprintf(one.suffix, sizeof one.suffix, "%s", stem);
    }
    PS_TRY(allocate_curves(&one, how->num_curves, error));
    fill(&one, asked, how, index);
    const pspec_status status = add_pages(list, &one, how->chunk > 0, error);
    free(one.curves);
    return status;
}

/* The entry whose values are numbers of points, if there are several. */
static size_t find_points(const ps_scene_result *asked) {
    size_t i = 0;
    while (i < asked->num_entries &&
           (asked->entries[i].option != PS_OPTION_POINTS || !ps_run_varies(&asked->entries[i]))) {
        i++;
    }
    return i;
}

static pspec_status list_errors(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    const size_t points = find_points(asked);
    const layout how = find_layout(asked, points, false);
    if (asked->kind->convergence == NULL || points == asked->num_entries) {
        return PSPEC_OK;
    }
    const ps_picture one = {.form = PS_PICTURE_ERRORS, .lines = asked->kind->convergence};
    for (size_t g = 0; g < count_values(asked, how.group); g++) {
        PS_TRY(add_group(out, asked, one, &how, g, error));
    }
    return PSPEC_OK;
}

/* What has panels of its own, and labels that tell its curves apart, gets no others. */
static pspec_status list_charts(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    layout how = find_layout(asked, find_points(asked), false);
    const ps_picture one = {.form = PS_PICTURE_CHART};
    how.panel = asked->num_entries;
    how.chunk = 0;
    for (size_t g = 0; asked->kind->chart != NULL && g < count_values(asked, how.group); g++) {
        PS_TRY(add_group(out, asked, one, &how, g, error));
    }
    return PSPEC_OK;
}

static pspec_status list_lines(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    const ps_line_kind *const kinds = asked->kind->lines;
    const layout how = find_layout(asked, asked->num_entries, false);
    PS_TRY(list_errors(out, asked, error));
    PS_TRY(list_charts(out, asked, error));
    for (size_t g = 0; g < count_values(asked, how.group); g++) {
        for (size_t k = 0; kinds[k].suffix != NULL; k++) {
            const ps_picture one = {.form = PS_PICTURE_COLUMNS, .lines = &kinds[k]};
            PS_TRY(add_group(out, asked, one, &how, g, error));
        }
    }
    return PSPEC_OK;
}

/* A picture of every question. */
static pspec_status add_singles(ps_pictures *out, const ps_scene_result *asked,
                                ps_picture_form form, const char *stem, ps_error *error) {
    const size_t num = ps_scene_num_questions(asked);
    const size_t none = asked->num_entries;
    for (size_t q = 0; q < num; q++) {
        ps_picture one = {.form = form, .group = none, .points = none, .panel = none};
        snprintf(one.suffix, sizeof one.suffix, "-%s-%zu", stem, q + 1);
        PS_TRY(add(out, &one, 1, error));
        ps_picture *const picture = &out->all[out->num - 1];
        picture->num_curves = picture->num_panels = picture->ends[0] = 1;
        picture->curves[0] = q;
    }
    return PSPEC_OK;
}

static pspec_status list_spectra(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    const layout how = find_layout(asked, asked->num_entries, true);
    for (size_t g = 0; g < count_values(asked, how.group); g++) {
        PS_TRY(add_group(out, asked, (ps_picture){.form = PS_PICTURE_SPECTRA}, &how, g, error));
    }
    if (asked->wants_pictures) {
        PS_TRY(add_singles(out, asked, PS_PICTURE_IMAGE, "picture", error));
    }
    return ps_scene_find_entry(asked, PS_OPTION_SCATTER) != NULL
               ? add_singles(out, asked, PS_PICTURE_SCATTER, "scatter", error)
               : PSPEC_OK;
}

/* Sets side by side; pages of them, as few as there can be. */
static pspec_status list_points(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    const size_t num = ps_scene_num_questions(asked);
    const size_t none = asked->num_entries;
    const size_t num_pages = (num + MOST_PANELS - 1) / MOST_PANELS;
    for (size_t page = 0; page < num_pages; page++) {
        const size_t first = page * num / num_pages;
        const size_t end = (page + 1) * num / num_pages;
        ps_picture one = {.form = PS_PICTURE_POINTS, .group = none, .points = none, .panel = none};
        if (page > 0) {
            snprintf(one.suffix, sizeof one.suffix, "-page-%zu", page + 1);
        }
        PS_TRY(add(out, &one, end - first, error));
        ps_picture *const picture = &out->all[out->num - 1];
        picture->num_panels = 1; /* nothing to be said of them */
        picture->num_curves = picture->ends[0] = end - first;
        for (size_t i = 0; i < end - first; i++) {
            picture->curves[i] = first + i;
        }
    }
    return PSPEC_OK;
}

pspec_status ps_pictures_list(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    if (!asked->wants_plot) {
        return PSPEC_OK;
    }
    if (asked->kind->has_points) {
        return list_points(out, asked, error);
    }
    return asked->kind->spectrum != NULL ? list_spectra(out, asked, error)
                                         : list_lines(out, asked, error);
}

void ps_picture_say_panels(const ps_picture *picture, const ps_scene_result *asked, ps_text *out) {
    ps_text_append(out, "%zu curves are too many for one frame: %zu panels", picture->num_curves,
                   picture->num_panels);
    if (picture->panel < asked->num_entries) {
        ps_text_append(out, ", one for each of %s", ps_scene_key(&asked->entries[picture->panel]));
    }
}

void ps_pictures_free(ps_pictures *pictures) {
    for (size_t i = 0; i < pictures->num; i++) {
        free(pictures->all[i].curves);
    }
    free(pictures->all);
    *pictures = (ps_pictures){0};
}
