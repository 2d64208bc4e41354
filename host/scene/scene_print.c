/* A scene as JSON. */
#include "scene/scene_file.h"

/* The character that text begins with, and its bytes; 0: they are not UTF-8, which paths need not
 * be. */
static size_t decode(const unsigned char *text, unsigned *code) {
    static const struct {
        unsigned char mask, lead;
        unsigned least; /* shorter forms of a character are refused */
    } forms[] = {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};
    for (size_t more = 0; more < sizeof forms / sizeof forms[0]; more++) {
        if ((text[0] & forms[more].mask) != forms[more].lead) {
            continue;
        }
        *code = text[0] & (unsigned char)~forms[more].mask;
        for (size_t i = 1; i <= more; i++) {
            if ((text[i] & 0xc0) != 0x80) {
                return 0;
            }
            *code = *code << 6 | (text[i] & 0x3f);
        }
        const bool is_surrogate = *code >= 0xd800 && *code <= 0xdfff;
        return *code >= forms[more].least && *code <= 0x10ffff && !is_surrogate ? more + 1 : 0;
    }
    return 0;
}

/* YAML refuses control characters and marks in a file, and takes some breaks of lines for blanks.
 */
static bool is_plain(unsigned code) {
    return (code >= ' ' && code < 0x7f) || (code >= 0xa0 && code != 0x2028 && code != 0x2029 &&
                                            code != 0xfeff && code != 0xfffe && code != 0xffff);
}

void ps_scene_print_text(const char *text, ps_text *out) {
    const unsigned replacement = 0xfffd;
    ps_text_append(out, "\"");
    while (*text != '\0') {
        unsigned code = replacement;
        const size_t bytes = decode((const unsigned char *)text, &code);
        if (code == '"' || code == '\\') {
            ps_text_append(out, "\\%c", (int)code);
        } else if (bytes > 0 && is_plain(code)) {
            ps_text_append_bytes(out, text, bytes);
        } else {
            ps_text_append(out, "\\u%04x", bytes > 0 ? code : replacement);
        }
        text += bytes > 0 ? bytes : 1;
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
        ps_text_append(out, ", \"pictures\": \"true\"");
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
