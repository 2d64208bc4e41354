/* A scene as JSON. */
#include "scene/scene_file.h"

void ps_scene_print_text(const char *text, ps_text *out) {
    ps_text_append(out, "\"");
    for (; *text != '\0'; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte == '"' || byte == '\\') {
            ps_text_append(out, "\\%c", byte);
        } else if (byte < ' ' || byte == 0x7f) {
            ps_text_append(out, "\\u%04x", byte);
        } else {
            ps_text_append_bytes(out, text, 1);
        }
    }
    ps_text_append(out, "\"");
}

/* Paths as the scene has them: the record says which folder they are relative to. */
static void print_value(const ps_scene_entry *entry, const ps_scene_value *value, ps_text *out) {
    const bool is_list = entry->option == PS_SCENE_FILES;
    ps_text_append(out, is_list ? "[" : "");
    for (size_t i = 0; i < value->num_texts; i++) {
        ps_text_append(out, i > 0 ? ", " : "");
        ps_scene_print_text(value->originals[i], out);
    }
    ps_text_append(out, is_list ? "]" : "");
}

static void print_entry(const ps_scene_entry *entry, ps_text *out) {
    ps_text_append(out, ",\n     \"%s\": [", ps_scene_key(entry));
    for (size_t i = 0; i < entry->num_values; i++) {
        ps_text_append(out, i > 0 ? ", " : "");
        print_value(entry, &entry->values[i], out);
    }
    ps_text_append(out, "]");
}

static void print_result(const ps_scene_result *result, ps_text *out) {
    ps_text_append(out, "    {\"result\": \"%s\", \"name\": \"%s\"", result->kind->name,
                   result->name);
    if (result->title != NULL) {
        ps_text_append(out, ", \"title\": ");
        ps_scene_print_text(result->title, out);
    }
    ps_text_append(out, ", \"plot\": \"%s\"", result->wants_plot ? "true" : "false");
    if (result->wants_pictures) {
        ps_text_append(out, ", \"pictures\": \"true\"");
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
