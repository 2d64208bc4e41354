/* Pictures of points: a panel, or two sides of the sphere, for every question. */
#include "answers/points/points_picture.h"
#include "scene/run/drawing.h"

#include <string.h>

static ps_sampler_domain find_domain(const ps_table *table) {
    const ps_cell domain = ps_table_find_meta(table, "domain");
    const char *const text = domain.kind == PS_CELL_TEXT ? domain.text : "";
    return strcmp(text, "sphere") == 0       ? PS_SAMPLES_SPHERE
           : strcmp(text, "hemisphere") == 0 ? PS_SAMPLES_HEMISPHERE
                                             : PS_SAMPLES_TORUS;
}

void ps_name_sampler(const ps_scene_result *asked, size_t question, ps_text *out) {
    for (size_t i = 0; i < asked->num_entries; i++) {
        const ps_scene_entry *const entry = &asked->entries[i];
        const char *const text = ps_scene_value_of(asked, question, i)->label;
        const char *const comma = out->length > 0 ? ", " : "";
        if (entry->option == PS_OPTION_SAMPLER) {
            ps_text_append(out, "%s%s", comma, text);
        } else if (entry->option != PS_OPTION_POINTS && ps_run_varies(entry)) {
            ps_text_append(out, "%s%s %s", comma, ps_scene_key(entry), text);
        }
    }
}

/* The first realization of an answer: [M][N][dimension]. */
static pspec_status add_set(const ps_artist *artist, size_t question, ps_points_picture *picture) {
    const ps_table *const table = artist->result->questions[question].answer.table;
    const ps_npy_array *const points = ps_table_find_array(table, "coordinates");
    ps_text name = {0};
    ps_name_sampler(artist->result->asked, question, &name);
    const ps_drawn_set set = {ps_text_string(&name), find_domain(table), (unsigned)points->shape[2],
                              points->shape[1], points->data};
    pspec_status status = ps_text_check(&name, artist->error);
    if (status == PSPEC_OK) {
        status = ps_points_picture_add(picture, &set, &artist->run->hooks.watch, artist->error);
    }
    ps_text_free(&name);
    return status;
}

/* Of one set: which it is. */
static void describe(const ps_artist *artist, const ps_picture *what,
                     const ps_points_picture *picture, ps_text *out) {
    if (what->num_curves == 1) {
        ps_name_sampler(artist->result->asked, what->curves[0], out);
        ps_text_append(out, ", N = %zu", picture->num_points);
    }
}

pspec_status ps_draw_points(const ps_artist *artist, const ps_picture *what) {
    ps_points_picture picture = {.num_sets = what->num_curves};
    ps_text title = {0};
    ps_text description = {0};
    ps_figure figure;
    pspec_status status = PSPEC_OK;
    for (size_t i = 0; i < what->num_curves; i++) {
        PS_TRY_OUT(status, add_set(artist, what->curves[i], &picture));
    }
    describe(artist, what, &picture, &description);
    PS_TRY_OUT(status, ps_text_check(&description, artist->error));
    ps_plot_title(artist, what, ps_text_string(&description), &title);
    PS_TRY_OUT(status, ps_text_check(&title, artist->error));
    PS_TRY_OUT(status,
               ps_points_picture_figure(&picture, ps_text_string(&title), &figure, artist->error));
    PS_TRY_OUT(status, ps_draw(artist, &figure, what));
out:
    ps_points_picture_free(&picture);
    ps_text_free(&description);
    ps_text_free(&title);
    return status;
}
