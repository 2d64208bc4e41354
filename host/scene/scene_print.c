/* A scene as JSON. */
#include "scene/scene_file.h"

void ps_scene_print_text(const char *text, ps_text *out) {
    ps_text_append(out, "\"");
    while (*text != '\0') {
        ps_text_append(out, "%s", ps_text_next_json(&text).text);
    }
    ps_text_append(out, "\"");
}

/* Paths as the scene has them: the record says which folder they are relative to. */
static void print_value(const ps_scene_value *value, bool is_list, ps_text *out) {
    ps_text_append(out, is_list ? "[" : "");
    for (size_t i = 0; i < value->num_texts; i++) {
        ps_text_append(out, i > 0 ? ", " : "");
        ps_scene_print_text(value->originals[i], out);
    }
    ps_text_append(out, is_list ? "]" : "");
}

static void print_values(const ps_scene_entry *entry, size_t num, ps_text *out) {
    ps_text_append(out, ",\n     \"%s\": [", ps_scene_key(entry));
    for (size_t i = 0; i < num; i++) {
        ps_text_append(out, i > 0 ? ", " : "");
        print_value(&entry->values[i], entry->option == PS_SCENE_FILES, out);
    }
    ps_text_append(out, "]");
}

static void print_sets(const ps_scene_entry *entry, size_t first, ps_text *out) {
    ps_text_append(out, ",\n     \"sets\": {");
    for (size_t i = first; i < entry->num_values + entry->num_more; i++) {
        ps_text_append(out, i > first ? ", " : "");
        ps_scene_print_text(entry->values[i].label, out);
        ps_text_append(out, ": ");
        print_value(&entry->values[i], true, out);
    }
    ps_text_append(out, "}");
}

/* Sets stand behind samplers. */
static void print_entry(const ps_scene_entry *entry, ps_text *out) {
    const size_t num_all = entry->num_values + entry->num_more;
    const size_t num = num_all - ps_scene_num_sets(entry);
    if (num > 0) {
        print_values(entry, num, out);
    }
    if (num < num_all) {
        print_sets(entry, num, out);
    }
}

static void print_result(const ps_scene_result *result, ps_text *out) {
    ps_text_append(out, "    {\"result\": \"%s\", \"name\": \"%s\"", result->kind->name,
                   result->name);
    if (result->title != NULL) {
        ps_text_append(out, ", \"title\": ");
        ps_scene_print_text(result->title, out);
    }
    ps_text_append(out, ", \"plot\": \"%s\"", result->wants_plot ? "true" : "false");
    for (int i = 0; i < PS_SCENE_NUM_AXES; i++) {
        if (result->axes_texts[i] != NULL) {
            ps_text_append(out, ", \"%s\": ", ps_options[ps_scene_axes[i]].name);
            ps_scene_print_text(result->axes_texts[i], out);
        }
    }
    if (result->wants_pictures) {
        ps_text_append(out, ", \"pictures\": \"%s\"", result->wants_decibels ? "decibels" : "true");
    }
    if (result->wants_arrays) {
        ps_text_append(out, ", \"arrays\": \"%s\"",
                       result->wants_coefficients ? "coefficients" : "true");
    }
    for (size_t i = 0; i < result->num_entries; i++) {
        print_entry(&result->entries[i], out);
    }
    ps_text_append(out, "}");
}

void ps_scene_print(const ps_scene *scene, ps_text *out) {
    ps_text_append(out, "{\n  \"scene\": \"1\",\n");
    if (scene->title != NULL) {
        ps_text_append(out, "  \"title\": ");
        ps_scene_print_text(scene->title, out);
        ps_text_append(out, ",\n");
    }
    if (scene->description != NULL) {
        ps_text_append(out, "  \"description\": ");
        ps_scene_print_text(scene->description, out);
        ps_text_append(out, ",\n");
    }
    ps_text_append(out, "  \"results\": [\n");
    for (size_t i = 0; i < scene->num_results; i++) {
        print_result(&scene->results[i], out);
        ps_text_append(out, i + 1 < scene->num_results ? ",\n" : "\n");
    }
    ps_text_append(out, "  ]");
}
