/* Which pictures a result has, and under which names: known before any work, and the one list by
 * which they are drawn. */
#ifndef PS_SCENE_RUN_PICTURES_H
#define PS_SCENE_RUN_PICTURES_H

#include "base/memory.h"
#include "scene/scene.h"

/* More curves than this in one frame cannot be told apart. */
enum { PS_MOST_CURVES = 8 };

enum { PS_SUFFIX_BYTES = 96 };

typedef struct ps_picture {
    char suffix[PS_SUFFIX_BYTES]; /* of the file: NAME + suffix + .svg */
    const ps_picture_kind *kind;
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
    ps_pool memory; /* of their curves and panels */
} ps_pictures;

/* Those that the answers may lead to: of some there turns out to be nothing to draw. Freed by
 * ps_pictures_free, also after an error. */
pspec_status ps_pictures_list(ps_pictures *out, const ps_scene_result *asked,
                              ps_error *error) PS_MUST_CHECK;
/* Why it has panels, and of what. */
void ps_picture_say_panels(const ps_picture *picture, const ps_scene_result *asked, ps_text *out);
void ps_pictures_free(ps_pictures *pictures);

/* What tells the curve of a question from the others of its panel, a panel from others, a set of
 * points from others, whose pictures say N themselves. */
void ps_label_curve(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out);
void ps_label_panel(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out);
void ps_label_set(const ps_scene_result *asked, size_t question, ps_text *out);

/* Has this entry several values? */
bool ps_run_varies(const ps_scene_entry *entry);

#endif
