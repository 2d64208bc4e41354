/* Which pictures a result has, and under which names: known before any work, and the one list by
 * which they are drawn. */
#ifndef PS_SCENE_RUN_PICTURES_H
#define PS_SCENE_RUN_PICTURES_H

#include "scene/scene.h"

/* More curves than this in one frame cannot be told apart. */
enum { PS_MOST_CURVES = 8 };

typedef enum ps_picture_form {
    PS_PICTURE_SPECTRA, /* powers of a group of questions */
    PS_PICTURE_IMAGE,   /* of one question, with the averaged periodogram */
    PS_PICTURE_SCATTER, /* of one question, its sets in the complex plane */
    PS_PICTURE_COLUMNS, /* lines of one kind */
    PS_PICTURE_ERRORS,  /* worst-case errors against numbers of points */
    PS_PICTURE_CHART,   /* rows of all questions, as the kind draws them */
    PS_PICTURE_POINTS   /* points of questions, side by side */
} ps_picture_form;

enum { PS_SUFFIX_BYTES = 96 };

typedef struct ps_picture {
    char suffix[PS_SUFFIX_BYTES]; /* of the file: NAME + suffix + .svg */
    ps_picture_form form;
    const ps_line_kind *lines; /* of columns and of errors */
    /* What its questions have and those of other pictures do not; NULL: there are no others */
    const ps_scene_value *value;
    /* Entries of the result: of that value, of the numbers of points along a line, and of the value
     * that a panel has for itself. num_entries: none. */
    size_t group, points, panel;
    /* Questions, a curve each, or the first of a curve against numbers of points, those of a panel
     * together; panel i ends before ends[i]. One panel: a frame without others. */
    size_t num_curves, num_panels;
    size_t *curves, *ends;
} ps_picture;

typedef struct ps_pictures {
    size_t num, capacity;
    ps_picture *all;
} ps_pictures;

/* Those that the answers may lead to: of some there turns out to be nothing to draw. Freed by
 * ps_pictures_free, also after an error. */
pspec_status ps_pictures_list(ps_pictures *out, const ps_scene_result *asked,
                              ps_error *error) PS_MUST_CHECK;
/* Why it has panels, and of what. */
void ps_picture_say_panels(const ps_picture *picture, const ps_scene_result *asked, ps_text *out);
void ps_pictures_free(ps_pictures *pictures);

/* Has this entry several values? */
bool ps_run_varies(const ps_scene_entry *entry);

#endif
