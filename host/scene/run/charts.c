/* Pictures as a kind draws them: of the rows of many questions, of the sets of one. */
#include "answers/spectra/scatter.h"
#include "base/memory.h"
#include "scene/run/drawing.h"

#include <stdlib.h>

typedef struct chart_memory {
    size_t num_curves;
    ps_chart_part *parts;
    ps_text *labels; /* [num_curves] */
} chart_memory;

static void release(chart_memory *self) {
    for (size_t i = 0; self->labels != NULL && i < self->num_curves; i++) {
        ps_text_free(&self->labels[i]);
    }
    free(self->parts);
    free(self->labels);
}

/* Rows of a question of several samplers say which they are of. */
static bool names_samplers(const ps_run_result *result, size_t question) {
    size_t column = 0;
    return ps_table_find_column(result->questions[question].answer.table,
                                ps_options[PS_OPTION_SAMPLER].name, &column);
}

/* The questions of a curve differ in the number of points alone. */
static pspec_status take_parts(const ps_artist *artist, const ps_picture *what, size_t num_counts,
                               chart_memory *self) {
    const ps_scene_result *const asked = artist->result->asked;
    const size_t step = num_counts > 1 ? ps_question_step(asked, what->points) : 0;
    for (size_t i = 0; i < what->num_curves; i++) {
        ps_text *const label = &self->labels[i];
        ps_label_curve(asked, what, what->curves[i], label);
        const bool has_names = names_samplers(artist->result, what->curves[i]);
        if (label->length == 0 && !has_names) {
            ps_name_sampler(asked, what->curves[i], label);
        }
        if (label->length == 0 && !has_names) { /* files */
            ps_run_label(artist->result, what->curves[i], label);
        }
        PS_TRY(ps_text_check(label, artist->error));
        for (size_t k = 0; k < num_counts; k++) {
            const size_t question = what->curves[i] + k * step;
            self->parts[i * num_counts + k] = (ps_chart_part){
                artist->result->questions[question].answer.table, ps_text_string(label)};
        }
    }
    return PSPEC_OK;
}

typedef struct verb {
    const ps_artist *artist;
    const ps_picture *what;
} verb;

static pspec_status take_figure(void *payload, const ps_figure *figure, ps_error *error) {
    const verb *const self = payload;
    (void)error; /* it is the artist's */
    return ps_draw(self->artist, figure, self->what);
}

pspec_status ps_draw_chart(const ps_artist *artist, const ps_picture *what) {
    const ps_scene_result *const asked = artist->result->asked;
    const size_t num_counts =
        what->points < asked->num_entries ? asked->entries[what->points].num_values : 1;
    chart_memory self = {.num_curves = what->num_curves};
    ps_text title = {0};
    verb own = {artist, what};
    pspec_status status = PSPEC_OK;
    PS_TRY_OUT(status,
               PS_NEW(&self.parts, what->num_curves * num_counts, "a picture", artist->error));
    PS_TRY_OUT(status, PS_NEW(&self.labels, what->num_curves, "a picture", artist->error));
    PS_TRY_OUT(status, take_parts(artist, what, num_counts, &self));
    ps_plot_title(artist, what, "", &title);
    PS_TRY_OUT(status, ps_text_check(&title, artist->error));
    const ps_chart chart = {.title = ps_text_string(&title),
                            .axes = asked->axes,
                            .num_parts = what->num_curves * num_counts,
                            .parts = self.parts,
                            .take = take_figure,
                            .payload = &own};
    status = asked->kind->chart(&chart, artist->error);
out:
    release(&self);
    ps_text_free(&title);
    return status;
}

pspec_status ps_draw_scatter(const ps_artist *artist, const ps_picture *what) {
    const ps_run_question *const question = &artist->result->questions[what->curves[0]];
    const ps_npy_array *const rows = ps_table_find_array(question->answer.table, "scatter");
    const ps_scatter scatter = {.num_sets = rows->shape[0],
                                .asked = &question->asked.request.frequencies,
                                .max_frequency = (int32_t)(rows->shape[1] / 2),
                                .rows = rows->data};
    ps_text label = {0};
    ps_text title = {0};
    verb own = {artist, what};
    ps_run_label(artist->result, what->curves[0], &label);
    ps_plot_title(artist, what, ps_text_string(&label), &title);
    pspec_status status = ps_text_check(&label, artist->error);
    if (status == PSPEC_OK) {
        status = ps_text_check(&title, artist->error);
    }
    if (status == PSPEC_OK) {
        status =
            ps_scatter_draw(&scatter, ps_text_string(&title), take_figure, &own, artist->error);
    }
    ps_text_free(&label);
    ps_text_free(&title);
    return status;
}
