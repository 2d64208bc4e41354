/* What the pictures of a scene's results share. Private to this folder. */
#ifndef PS_SCENE_RUN_DRAWING_H
#define PS_SCENE_RUN_DRAWING_H

#include "plots/plot.h"
#include "scene/run/run.h"

typedef struct ps_artist {
    ps_run *run;
    ps_run_result *result;
    ps_error *error;
    double image_maximum; /* of the scale that images of the result share */
} ps_artist;

/* The title of the result, what its questions have in common, what the picture shows. */
void ps_plot_title(const ps_artist *artist, const ps_picture *picture, const char *what,
                   ps_text *out);

/* Draws it, or takes it from the cache, and adds it to the result. */
pspec_status ps_draw(const ps_artist *artist, const ps_figure *figure,
                     const ps_picture *picture) PS_MUST_CHECK;

/* Adds a picture to the result: its text, or else why there is none. Takes the text. */
pspec_status ps_run_add_plot(const ps_artist *artist, const ps_picture *picture, ps_text *svg,
                             ps_text *reason) PS_MUST_CHECK;

/* A picture of curves: spectra, with an image or none (NULL), columns, errors. */
pspec_status ps_draw_curves(const ps_artist *artist, const ps_picture *what,
                            const ps_plot_image *image) PS_MUST_CHECK;

/* A picture of the rows of all questions, as the kind draws them. */
pspec_status ps_draw_chart(const ps_artist *artist, const ps_picture *what) PS_MUST_CHECK;

/* The sets of a question in the complex plane, from the array of its answer. */
pspec_status ps_draw_scatter(const ps_artist *artist, const ps_picture *what) PS_MUST_CHECK;

/* What tells the curve of a question from the others of its panel. */
void ps_label_curve(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out);
/* The sampler, and what else varies but the number of points, which pictures say themselves. */
void ps_name_sampler(const ps_scene_result *asked, size_t question, ps_text *out);
/* How far apart are questions that differ in that entry alone, by one value? */
size_t ps_question_step(const ps_scene_result *asked, size_t entry);

/* A picture of points, the first realization of every question. */
pspec_status ps_draw_points(const ps_artist *artist, const ps_picture *what) PS_MUST_CHECK;

#endif
