/* What tells curves, panels and sets of a picture apart. */
#include "scene/run/pictures.h"

/* Values of the entries that vary, but for the number of points, that of the picture, and that of
 * the panel. */
static bool is_told(const ps_scene_result *asked, const ps_picture *what, size_t entry) {
    return entry != what->group && entry != what->points && entry != what->panel &&
           ps_run_varies(&asked->entries[entry]);
}

/* Where no entry has panels of its own, that is the one that changes fastest; the others tell
 * panels apart. */
static size_t find_fastest(const ps_scene_result *asked, const ps_picture *what) {
    size_t fastest = asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        fastest = is_told(asked, what, i) ? i : fastest;
    }
    return fastest;
}

static void append_value(const ps_scene_result *asked, size_t question, size_t entry,
                         ps_text *out) {
    ps_text_append(out, "%s%s", out->length > 0 ? ", " : "",
                   ps_scene_value_of(asked, question, entry)->label);
}

void ps_label_panel(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out) {
    const size_t fastest = find_fastest(asked, what);
    if (what->panel < asked->num_entries) {
        append_value(asked, question, what->panel, out);
        return;
    }
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (i != fastest && is_told(asked, what, i)) {
            append_value(asked, question, i, out);
        }
    }
}

void ps_label_curve(const ps_scene_result *asked, const ps_picture *what, size_t question,
                    ps_text *out) {
    const size_t fastest = find_fastest(asked, what);
    const bool is_chunk = what->panel == asked->num_entries;
    for (size_t i = 0; i < asked->num_entries; i++) {
        if (is_told(asked, what, i) && (what->num_panels == 1 || !is_chunk || i == fastest)) {
            append_value(asked, question, i, out);
        }
    }
}

void ps_label_set(const ps_scene_result *asked, size_t question, ps_text *out) {
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
