#include "scene/run/run.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>

/* More curves than this in one frame cannot be told apart. */
enum { MOST_CURVES = 8 };

/* A picture has at most so many panels: a page of more is longer than anyone scrolls. Where panels
 * do not share their curves the key has one line for each, and room for fewer. */
enum { MOST_PANELS = 12, MOST_PANELS_OF_OTHERS = 3 };

bool ps_run_varies(const ps_scene_entry *entry) {
    return entry->num_values > 1;
}

/* ---- which curves go together ---------------------------------------------------------------- */

/* How curves are dealt out: to pictures by the values of entry `group`, to panels by those of
 * `panel`, or by those of `fastest`, `chunk` at a time. Entries: num_entries is none. */
typedef struct layout {
    size_t points, group, panel;
    size_t fastest;    /* that changes with every curve */
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
        if (is_free(asked, how, i) && num_left > 1 && num_left <= MOST_CURVES &&
            (best == asked->num_entries || num < asked->entries[best].num_values)) {
            best = i;
        }
    }
    return best;
}

static size_t find_fastest(const ps_scene_result *asked, const layout *how) {
    size_t fastest = asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        fastest = is_free(asked, how, i) ? i : fastest;
    }
    return fastest;
}

/* Values of the entry that changes fastest, in panels of nearly the same number. */
static size_t find_chunk(const ps_scene_result *asked, const layout *how) {
    const size_t num = count_values(asked, how->fastest);
    const size_t num_chunks = (num + MOST_CURVES - 1) / MOST_CURVES;
    return (num + num_chunks - 1) / num_chunks;
}

/* Too many curves for a frame: a picture for each value of the first entry that varies, unless that
 * alone would be the curve; then panels. */
static layout find_layout(const ps_scene_result *asked, size_t points, bool has_singles) {
    const size_t none = asked->num_entries;
    layout how = {points, none, none, none, 0, 0};
    how.num_curves = ps_scene_num_questions(asked) / count_values(asked, points);
    size_t first = 0;
    while (first < none && !is_free(asked, &how, first)) {
        first++;
    }
    const size_t num_left = how.num_curves / count_values(asked, first);
    if (how.num_curves > MOST_CURVES && (num_left > 1 || has_singles)) {
        how.group = first;
        how.num_curves = num_left;
    }
    how.fastest = find_fastest(asked, &how);
    if (how.num_curves > MOST_CURVES) {
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
        const size_t run = count_values(asked, how->fastest);
        picture->num_panels = 0;
        for (size_t at = 0; at < picture->num_curves;) {
            const size_t left = run - at % run;
            at += left < how->chunk ? left : how->chunk;
            picture->ends[picture->num_panels++] = at;
        }
    }
}

/* ---- the list -------------------------------------------------------------------------------- */

/* Room for so many curves, which may have a panel each. */
static pspec_status allocate_curves(ps_pictures *list, ps_picture *picture, size_t num,
                                    ps_error *error) {
    PS_TRY(PS_POOL_NEW(&list->memory, &picture->curves, num, "a picture", error));
    return PS_POOL_NEW(&list->memory, &picture->ends, num, "a picture", error);
}

static pspec_status add(ps_pictures *list, const ps_picture *one, ps_error *error) {
    void *memory = list->all;
    PS_TRY(ps_grow(&memory, &list->capacity, list->num + 1, sizeof *list->all, "pictures", error));
    list->all = memory;
    list->all[list->num++] = *one;
    return PSPEC_OK;
}

/* Panels first .. end - 1 of a picture as one of its own; those before them are one already, and
 * begin is where their curves end. */
static pspec_status add_page(ps_pictures *list, const ps_picture *whole, size_t begin, size_t first,
                             size_t end, ps_error *error) {
    ps_picture one = *whole;
    one.curves += begin;
    one.ends += first;
    one.num_panels = end - first;
    for (size_t i = 0; i < one.num_panels; i++) {
        one.ends[i] -= begin;
    }
    one.num_curves = one.ends[one.num_panels - 1];
    return add(list, &one, error);
}

/* Pages of panels, as few as there can be, of nearly the same number. */
static pspec_status add_pages(ps_pictures *list, ps_picture *whole, bool is_chunked,
                              ps_error *error) {
    const size_t most = is_chunked ? MOST_PANELS_OF_OTHERS : MOST_PANELS;
    const size_t num_pages = (whole->num_panels + most - 1) / most;
    char suffix[PS_SUFFIX_BYTES];
    size_t begin = 0;
    snprintf(suffix, sizeof suffix, "%s", whole->suffix);
    for (size_t page = 0; page < num_pages; page++) {
        const size_t first = page * whole->num_panels / num_pages;
        const size_t end = (page + 1) * whole->num_panels / num_pages;
        if (page > 0) {
            snprintf(whole->suffix, sizeof whole->suffix, "%.64s-page-%zu", suffix, page + 1);
        }
        const size_t next = whole->ends[end - 1];
        PS_TRY(add_page(list, whole, begin, first, end, error));
        begin = next;
    }
    return PSPEC_OK;
}

/* The picture of one group, or its pages. */
static pspec_status add_group(ps_pictures *list, const ps_scene_result *asked, ps_picture one,
                              const layout *how, size_t index, ps_error *error) {
    const char *const stem = one.kind->suffix != NULL ? one.kind->suffix : "";
    const bool is_group = how->group < asked->num_entries;
    one.group = how->group;
    one.points = how->points;
    one.panel = how->panel;
    one.fastest = how->fastest;
    one.value = is_group ? &asked->entries[how->group].values[index] : NULL;
    if (is_group) {
        snprintf(one.suffix, sizeof one.suffix, "%s-%zu", stem, index + 1);
    } else {
        snprintf(one.suffix, sizeof one.suffix, "%s", stem);
    }
    PS_TRY(allocate_curves(list, &one, how->num_curves, error));
    fill(&one, asked, how, index);
    return add_pages(list, &one, how->chunk > 0, error);
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

/* Questions in pictures of nearly the same number, of whose panels nothing is to be said. */
static pspec_status list_runs(ps_pictures *out, const ps_scene_result *asked,
                              const ps_picture_kind *kind, size_t num_pictures, ps_error *error) {
    const size_t none = asked->num_entries;
    const size_t num = ps_scene_num_questions(asked);
    const char *const stem = kind->suffix != NULL ? kind->suffix : "";
    for (size_t i = 0; i < num_pictures; i++) {
        ps_picture one = {.kind = kind,
                          .group = none,
                          .points = none,
                          .panel = none,
                          .fastest = none,
                          .num_panels = 1};
        const size_t begin = i * num / num_pictures;
        const size_t end = (i + 1) * num / num_pictures;
        PS_TRY(allocate_curves(out, &one, end - begin, error));
        for (size_t q = begin; q < end; q++) {
            one.curves[one.num_curves++] = q;
        }
        one.ends[0] = one.num_curves;
        if (kind->dealing == PS_OF_EACH) {
            snprintf(one.suffix, PS_SUFFIX_BYTES, "%s-%zu", stem, i + 1);
        } else if (i > 0) {
            snprintf(one.suffix, PS_SUFFIX_BYTES, "%s-page-%zu", stem, i + 1);
        } else {
            snprintf(one.suffix, PS_SUFFIX_BYTES, "%s", stem);
        }
        PS_TRY(add(out, &one, error));
    }
    return PSPEC_OK;
}

/* What has panels of its own, and labels that tell its curves apart, gets no others. */
static pspec_status list_counts(ps_pictures *out, const ps_scene_result *asked,
                                const ps_picture_kind *kind, ps_error *error) {
    layout how = find_layout(asked, find_points(asked), false);
    if (kind->panels != NULL) {
        how.panel = asked->num_entries;
        how.chunk = 0;
    }
    for (size_t g = 0; g < count_values(asked, how.group); g++) {
        PS_TRY(add_group(out, asked, (ps_picture){.kind = kind}, &how, g, error));
    }
    return PSPEC_OK;
}

static bool is_wanted(const ps_scene_result *asked, const ps_picture_kind *kind) {
    return (kind->by & PS_BY_SCENE) != 0 &&
           (kind->needs != PS_NEEDS_COUNTS || asked->is_joined ||
            find_points(asked) < asked->num_entries) &&
           (kind->needs != PS_NEEDS_SCATTER ||
            ps_scene_find_entry(asked, PS_OPTION_SCATTER) != NULL) &&
           (kind->needs != PS_NEEDS_PICTURES || asked->wants_pictures) &&
           (kind->needs != PS_NEEDS_DECIBELS || asked->wants_decibels) &&
           (kind->needs != PS_NEEDS_FILES ||
            (asked->wants_pictures && ps_scene_reads_points(asked))) &&
           (kind->needs != PS_NEEDS_INTEGRAND ||
            ps_scene_find_entry(asked, PS_OPTION_INTEGRAND) != NULL);
}

/* All pictures of curves, those of a group together. */
static pspec_status list_curves(ps_pictures *out, const ps_scene_result *asked,
                                const ps_picture_kind *kinds, ps_error *error) {
    const layout how = find_layout(asked, asked->num_entries, kinds->is_spectrum);
    for (size_t g = 0; g < count_values(asked, how.group); g++) {
        for (const ps_picture_kind *kind = kinds; kind->dealing == PS_OF_CURVES && kind->make;
             kind++) {
            PS_TRY(is_wanted(asked, kind)
                       ? add_group(out, asked, (ps_picture){.kind = kind}, &how, g, error)
                       : PSPEC_OK);
        }
    }
    return PSPEC_OK;
}

pspec_status ps_pictures_list(ps_pictures *out, const ps_scene_result *asked, ps_error *error) {
    const ps_picture_kind *before = NULL;
    const size_t num = ps_scene_num_questions(asked);
    for (const ps_picture_kind *kind = asked->kind->pictures; kind->make != NULL; kind++) {
        if (!asked->wants_plot || !is_wanted(asked, kind)) {
            continue;
        }
        const bool is_first = before == NULL || before->dealing != PS_OF_CURVES;
        before = kind;
        switch (kind->dealing) {
        case PS_OF_CURVES:
            PS_TRY(is_first ? list_curves(out, asked, kind, error) : PSPEC_OK);
            break;
        case PS_OF_COUNTS:
            PS_TRY(list_counts(out, asked, kind, error));
            break;
        case PS_OF_EACH:
            PS_TRY(list_runs(out, asked, kind, num, error));
            break;
        case PS_OF_SETS: /* side by side; pages of them, as few as there can be */
            PS_TRY(list_runs(out, asked, kind, (num + MOST_PANELS - 1) / MOST_PANELS, error));
            break;
        }
    }
    return PSPEC_OK;
}

void ps_picture_say_panels(const ps_picture *picture, const ps_scene_result *asked, ps_text *out) {
    ps_text_append(out, "%zu curves are too many for one frame: %zu panels", picture->num_curves,
                   picture->num_panels);
    if (picture->panel < asked->num_entries) {
        ps_text_append(out, ", one for each of %s", ps_scene_key(&asked->entries[picture->panel]));
    }
}

void ps_pictures_free(ps_pictures *pictures) {
    ps_pool_free(&pictures->memory);
    free(pictures->all);
    *pictures = (ps_pictures){0};
}
