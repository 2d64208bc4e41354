/* Pictures of the results of a scene, made from their tables by the list of pictures.c. */
#include "scene/run/drawing.h"

#include <math.h>

/* sqrt(N), of the mean N where sets differ: what frequencies are divided by. NAN without rows. */
static double frequency_unit(const ps_table *table) {
    size_t frequency = 0;
    size_t normalized = 0;
    return ps_table_find_column(table, "frequency", &frequency) &&
                   ps_table_find_column(table, "normalized_frequency", &normalized) &&
                   ps_table_num_rows(table) > 0
               ? ps_cell_number(ps_table_cell(table, 0, frequency)) /
                     ps_cell_number(ps_table_cell(table, 0, normalized))
               : NAN;
}

/* Of a question whose array was wanted and is there. */
static bool find_image(const ps_run_result *result, size_t question, ps_plot_image *out) {
    const ps_table *const table = result->questions[question].answer.table;
    const ps_npy_array *const full = ps_table_find_array(table, "full");
    if (full == NULL || full->rank != 2) {
        return false;
    }
    *out =
        (ps_plot_image){.size = full->shape[0], .power = full->data, .unit = frequency_unit(table)};
    return out->unit > 0;
}

/* Images of a result have the same colours for the same powers. */
static pspec_status find_maximum(const ps_artist *artist, double *out) {
    const ps_pictures *const pictures = &artist->result->pictures;
    *out = 0;
    for (size_t i = 0; i < pictures->num; i++) {
        ps_plot_image image;
        double own = 0;
        if (pictures->all[i].form == PS_PICTURE_IMAGE &&
            find_image(artist->result, pictures->all[i].curves[0], &image)) {
            PS_TRY(ps_plot_find_maximum(&own, &image, artist->error));
            *out = fmax(*out, own);
        }
    }
    return PSPEC_OK;
}

static pspec_status draw_image(const ps_artist *artist, const ps_picture *what) {
    ps_plot_image image;
    if (!find_image(artist->result, what->curves[0], &image)) {
        return PSPEC_OK;
    }
    image.maximum = artist->image_maximum;
    return ps_draw_curves(artist, what, &image);
}

/* Lists of frequencies have no normalized ones, and no picture. */
static bool has_bins(const ps_run_result *result) {
    size_t column = 0;
    return ps_table_find_column(result->questions[0].answer.table, result->asked->kind->spectrum->x,
                                &column);
}

static pspec_status draw(const ps_artist *artist, const ps_picture *what) {
    const bool is_image = what->form == PS_PICTURE_IMAGE;
    if (what->form == PS_PICTURE_POINTS) {
        return ps_draw_points(artist, what);
    }
    if (what->form == PS_PICTURE_SCATTER) {
        return ps_draw_scatter(artist, what);
    }
    if (what->form == PS_PICTURE_CHART) {
        return ps_draw_chart(artist, what);
    }
    const bool is_spectrum = is_image || what->form == PS_PICTURE_SPECTRA;
    if (is_spectrum && !has_bins(artist->result)) {
        return PSPEC_OK;
    }
    return is_image ? draw_image(artist, what) : ps_draw_curves(artist, what, NULL);
}

/* What a picture costs is a picture: the numbers are there. */
static pspec_status note_failure(const ps_artist *artist, const ps_picture *what) {
    ps_run *const run = artist->run;
    ps_text reason = {0};
    ps_text_append(&reason, "%s", artist->error->message);
    if (run->num_undrawn++ == 0) {
        run->undrawn = *artist->error;
    }
    *artist->error = (ps_error){0};
    pspec_status status = ps_text_check(&reason, artist->error);
    if (status == PSPEC_OK) {
        status = ps_run_add_plot(artist, what, NULL, &reason);
    }
    ps_text_free(&reason);
    return status;
}

/* Once for a result: its pictures have the same panels. */
static void say_panels(const ps_artist *artist) {
    const ps_scene_result *const asked = artist->result->asked;
    const ps_pictures *const pictures = &artist->result->pictures;
    size_t i = 0;
    while (i < pictures->num && pictures->all[i].num_panels == 1) {
        i++;
    }
    if (i == pictures->num) {
        return;
    }
    ps_text text = {0};
    ps_picture_say_panels(&pictures->all[i], asked, &text);
    ps_answer_warn(&artist->run->hooks, "%s%s.svg: %s", asked->name, pictures->all[i].suffix,
                   ps_text_string(&text));
    ps_text_free(&text);
}

pspec_status ps_run_make_plots(ps_run *run, ps_run_result *result, ps_error *error) {
    ps_artist artist = {run, result, error, 0};
    say_panels(&artist);
    PS_TRY(find_maximum(&artist, &artist.image_maximum));
    for (size_t i = 0; i < result->pictures.num; i++) {
        const ps_picture *const what = &result->pictures.all[i];
        const pspec_status status = draw(&artist, what);
        if (status == PSPEC_ERROR_CANCELLED ||
            (status != PSPEC_OK && ps_answer_is_interrupted(&run->hooks))) {
            return ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted while pictures were drawn");
        }
        if (status != PSPEC_OK) {
            PS_TRY(note_failure(&artist, what));
        }
    }
    return PSPEC_OK;
}
