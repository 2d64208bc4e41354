/* Pictures of the results of a scene: each by the figure that its kind makes of tables, drawn or
 * taken from the cache. */
#include "answers/spectra/spectra.h"
#include "base/memory.h"
#include "scene/run/run.h"

#include <stdlib.h>
#include <string.h>

typedef struct artist {
    ps_run *run;
    ps_run_result *result;
    ps_error *error;
    double image_maximum; /* of the scale that images of the result share */
} artist;

static const ps_table *table_of(const artist *self, size_t question) {
    return self->result->questions[question].answer.table;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* Values of the entries that vary, but for the number of points, that of the picture, and that of
 * the panel. */
static bool is_told(const ps_scene_result *asked, const ps_picture *what, size_t entry) {
    return entry != what->group && entry != what->points && entry != what->panel &&
           ps_run_varies(&asked->entries[entry]);
}

static void append_value(const ps_scene_result *asked, size_t question, size_t entry,
                         ps_text *out) {
    ps_text_append(out, "%s%s", out->length > 0 ? ", " : "",
                   ps_scene_value_of(asked, question, entry)->label);
}

/* What tells a panel from others, the curve of a question from the others of its panel, a set of
 * points from others, whose pictures say N themselves. */
static void label_panel(const ps_scene_result *asked, const ps_picture *what, size_t question,
                        ps_text *out) {
    if (what->panel < asked->num_entries) {
        append_value(asked, question, what->panel, out);
        return;
    }
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (i != what->fastest && is_told(asked, what, i)) {
            append_value(asked, question, i, out);
        }
    }
}

static void label_curve(const ps_scene_result *asked, const ps_picture *what, size_t question,
                        ps_text *out) {
    const bool is_chunk = what->panel == asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (is_told(asked, what, i) && (what->num_panels == 1 || !is_chunk || i == what->fastest)) {
            append_value(asked, question, i, out);
        }
    }
}

static void label_set(const ps_scene_result *asked, size_t question, ps_text *out) {
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

/* The title of the result, what its questions have in common, what the picture shows. */
static void write_title(const artist *self, const ps_picture *what, ps_text *out) {
    const ps_scene_result *const asked = self->result->asked;
    const size_t first = what->curves[0];
    ps_text description = {0};
    ps_text_append(out, "%s", asked->title != NULL ? asked->title : asked->name);
    if (what->value != NULL) {
        ps_text_append(out, ", %s", what->value->label);
    }
    if (what->kind->dealing == PS_OF_EACH) {
        ps_run_label(self->result, first, &description);
    } else if (what->kind->dealing == PS_OF_SETS && what->num_curves == 1) {
        const ps_npy_array *const sets = ps_table_find_array(table_of(self, first), "coordinates");
        label_set(asked, first, &description);
        if (sets != NULL) {
            ps_text_append(&description, ", N = %zu", sets->shape[1]);
        }
    } else if (what->kind->what != NULL) {
        ps_text_append(&description, "%s", what->kind->what);
    }
    if (description.length > 0) {
        ps_text_append(out, ": %s", ps_text_string(&description));
    }
    out->failed = out->failed || description.failed;
    ps_text_free(&description);
}

/* One frame has room for more of a label than the key of many panels. Rows of a question of several
 * samplers say which they are of. */
static void write_label(const artist *self, const ps_picture *what, size_t question, ps_text *out) {
    const ps_scene_result *const asked = self->result->asked;
    const ps_dealing dealing = what->kind->dealing;
    size_t column = 0;
    if (dealing == PS_OF_SETS) {
        label_set(asked, question, out);
    } else if (dealing == PS_OF_COUNTS || what->num_panels > 1) {
        label_curve(asked, what, question, out);
        if (out->length == 0 &&
            !ps_table_find_column(table_of(self, question), "sampler", &column)) {
            label_set(asked, question, out);
        } else {
            return;
        }
    }
    if (out->length == 0) {
        ps_run_label(self->result, question, out);
    }
}

/* ---- what a figure is made of ---------------------------------------------------------------- */

static size_t count_counts(const ps_scene_result *asked, const ps_picture *what) {
    return what->kind->dealing == PS_OF_COUNTS && what->points < asked->num_entries
               ? asked->entries[what->points].num_values
               : 1;
}

/* How far apart are questions that differ in the number of points alone, by one value? */
static size_t find_step(const ps_scene_result *asked, const ps_picture *what) {
    size_t step = 1;
    for (size_t i = what->points + 1; i < asked->num_entries; i++) {
        step *= asked->entries[i].num_values;
    }
    return step;
}

/* Those of a curve, which differ in the number of points alone, together. */
static pspec_status take_parts(const artist *self, const ps_picture *what, ps_pool *memory,
                               ps_chart *chart) {
    const ps_scene_result *const asked = self->result->asked;
    const size_t num_counts = count_counts(asked, what);
    const size_t step = find_step(asked, what);
    ps_chart_part *parts = NULL;
    chart->num_parts = what->num_curves * num_counts;
    PS_TRY(PS_POOL_NEW(memory, &parts, chart->num_parts, "a picture", self->error));
    for (size_t i = 0, panel = 0; i < what->num_curves; i++) {
        ps_text text = {0};
        const char *label = NULL;
        write_label(self, what, what->curves[i], &text);
        PS_TRY(ps_text_keep(&label, memory, &text, self->error));
        panel += i == what->ends[panel];
        for (size_t k = 0; k < num_counts; k++) {
            const ps_run_question *const question =
                &self->result->questions[what->curves[i] + k * step];
            parts[i * num_counts + k] =
                (ps_chart_part){question->answer.table, &question->asked.request, label, panel};
        }
    }
    chart->parts = parts;
    return PSPEC_OK;
}

static pspec_status name_panels(const artist *self, const ps_picture *what, ps_pool *memory,
                                ps_chart *chart) {
    const char **titles = NULL;
    PS_TRY(PS_POOL_NEW(memory, &titles, what->num_panels, "a picture", self->error));
    for (size_t i = 0, begin = 0; i < what->num_panels; begin = what->ends[i++]) {
        ps_text title = {0};
        label_panel(self->result->asked, what, what->curves[begin], &title);
        PS_TRY(ps_text_keep(&titles[i], memory, &title, self->error));
    }
    chart->num_panels = what->num_panels;
    chart->panels = titles;
    return PSPEC_OK;
}

static pspec_status make_figure(const artist *self, const ps_picture *what, ps_pool *memory,
                                ps_figure *out) {
    ps_text title = {0};
    ps_chart chart = {.what = what->kind,
                      .axes = self->result->asked->axes,
                      .image_maximum = self->image_maximum,
                      .watch = &self->run->hooks.watch};
    write_title(self, what, &title);
    PS_TRY(ps_text_keep(&chart.title, memory, &title, self->error));
    PS_TRY(take_parts(self, what, memory, &chart));
    PS_TRY(name_panels(self, what, memory, &chart));
    return what->kind->make(out, memory, &chart, self->error);
}

/* ---- the picture ----------------------------------------------------------------------------- */

/* Takes the text: of the picture, or else why there is none. */
static pspec_status add_plot(const artist *self, const ps_picture *what, ps_text *svg,
                             ps_text *reason) {
    ps_run_result *const result = self->result;
    void *plots = result->plots;
    PS_TRY(ps_grow(&plots, &result->plot_capacity, result->num_plots + 1, sizeof *result->plots,
                   "pictures", self->error));
    result->plots = plots;
    result->plots[result->num_plots++] =
        (ps_run_plot){what, svg != NULL ? svg->data : NULL, reason != NULL ? reason->data : NULL};
    *(svg != NULL ? svg : reason) = (ps_text){0};
    return PSPEC_OK;
}

/* A picture is a function of its script: gnuplot need not run twice for the same. */
static pspec_status find_svg(const artist *self, const ps_text *key, ps_text *svg) {
    void *bytes = NULL;
    size_t num = 0;
    bool is_found = false;
    ps_error reason = {0};
    if (self->run->cache != NULL && ps_cache_get(self->run->cache, key->data, key->length, &bytes,
                                                 &num, &is_found, &reason) != PSPEC_OK) {
        ps_run_warn_of_cache(self->run, &reason);
    }
    if (is_found) {
        ps_text_append_bytes(svg, bytes, num);
    }
    free(bytes);
    return ps_text_check(svg, self->error);
}

static void keep_svg(const artist *self, const ps_text *key, const ps_text *svg) {
    ps_error reason = {0};
    if (self->run->cache != NULL && ps_cache_put(self->run->cache, key->data, key->length,
                                                 svg->data, svg->length, &reason) != PSPEC_OK) {
        ps_run_warn_of_cache(self->run, &reason);
    }
}

static pspec_status draw_figure(const artist *self, const ps_picture *what,
                                const ps_figure *figure) {
    ps_text script = {0};
    ps_text key = {0};
    ps_text svg = {0};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status, ps_figure_write_script(&script, figure, self->error));
    ps_text_append(&key, "plot\n%s", ps_text_string(&self->run->identity));
    ps_text_append_bytes(&key, script.data, script.length);
    PS_TRY_OUT(status, ps_text_check(&key, self->error));
    PS_TRY_OUT(status, find_svg(self, &key, &svg));
    if (svg.length == 0) {
        PS_TRY_OUT(status, ps_plot_draw_script(&svg, &script, self->error));
        keep_svg(self, &key, &svg);
    }
    status = add_plot(self, what, &svg, NULL);
out:
    ps_text_free(&script);
    ps_text_free(&key);
    ps_text_free(&svg);
    return status;
}

/* Samplers beside files have none, nor have files of many points. */
static bool has_first_set(const artist *self, const ps_picture *what) {
    size_t i = 0;
    while (i < what->num_curves &&
           ps_table_find_array(table_of(self, what->curves[i]), "first_set") == NULL) {
        i++;
    }
    return i < what->num_curves;
}

/* Lists of frequencies have no normalized ones, subsets of rings no array; of few degrees there is
 * no line. */
static bool is_there(const artist *self, const ps_picture *what) {
    enum { FEWEST_ROWS = 4 };
    const ps_table *const table = table_of(self, what->curves[0]);
    const ps_picture_kind *const kind = what->kind;
    size_t column = 0;
    ps_plot_image image;
    const bool has_image =
        kind->is_spectrum && (kind->needs == PS_NEEDS_PICTURES || kind->needs == PS_NEEDS_DECIBELS);
    return (!kind->is_spectrum || ps_table_find_column(table, kind->x, &column)) &&
           (!has_image || ps_spectra_find_image(&image, table)) &&
           (kind->needs != PS_NEEDS_FILES || has_first_set(self, what)) &&
           (kind->make != ps_lines_figure || kind->dealing == PS_OF_COUNTS ||
            ps_table_num_rows(table) >= FEWEST_ROWS);
}

static pspec_status draw(const artist *self, const ps_picture *what) {
    ps_pool memory = {0};
    ps_figure figure;
    pspec_status status = PSPEC_OK;
    if (is_there(self, what)) {
        PS_TRY_OUT(status, make_figure(self, what, &memory, &figure));
        PS_TRY_OUT(status, draw_figure(self, what, &figure));
    }
out:
    ps_pool_free(&memory);
    return status;
}

/* ---- all of them ----------------------------------------------------------------------------- */

/* Images of a result have the same colours for the same powers. */
static pspec_status find_maximum(artist *self) {
    for (size_t i = 0; self->result->asked->wants_pictures && i < self->result->num; i++) {
        ps_plot_image image;
        double own = 0;
        if (ps_spectra_find_image(&image, table_of(self, i))) {
            PS_TRY(ps_plot_find_maximum(&own, &image, self->error));
            self->image_maximum = own > self->image_maximum ? own : self->image_maximum;
        }
    }
    return PSPEC_OK;
}

/* What a picture costs is a picture: the numbers are there. */
static pspec_status note_failure(const artist *self, const ps_picture *what) {
    ps_run *const run = self->run;
    ps_text reason = {0};
    ps_text_append(&reason, "%s", self->error->message);
    if (run->num_undrawn++ == 0) {
        run->undrawn = *self->error;
    }
    *self->error = (ps_error){0};
    pspec_status status = ps_text_check(&reason, self->error);
    if (status == PSPEC_OK) {
        status = add_plot(self, what, NULL, &reason);
    }
    ps_text_free(&reason);
    return status;
}

/* Once for a result: its pictures have the same panels. */
static void say_panels(const artist *self) {
    const ps_scene_result *const asked = self->result->asked;
    const ps_pictures *const pictures = &self->result->pictures;
    size_t i = 0;
    while (i < pictures->num && pictures->all[i].num_panels == 1) {
        i++;
    }
    if (i == pictures->num) {
        return;
    }
    ps_text text = {0};
    ps_picture_say_panels(&pictures->all[i], asked, &text);
    ps_answer_warn(&self->run->hooks, "%s%s.svg: %s", asked->name, pictures->all[i].suffix,
                   ps_text_string(&text));
    ps_text_free(&text);
}

pspec_status ps_run_make_plots(ps_run *run, ps_run_result *result, ps_error *error) {
    artist self = {run, result, error, 0};
    say_panels(&self);
    PS_TRY(find_maximum(&self));
    for (size_t i = 0; i < result->pictures.num; i++) {
        const ps_picture *const what = &result->pictures.all[i];
        const pspec_status status = draw(&self, what);
        if (status == PSPEC_ERROR_CANCELLED ||
            (status != PSPEC_OK && ps_answer_is_interrupted(&run->hooks))) {
            return ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted while pictures were drawn");
        }
        if (status != PSPEC_OK) {
            PS_TRY(note_failure(&self, what));
        }
    }
    return PSPEC_OK;
}
