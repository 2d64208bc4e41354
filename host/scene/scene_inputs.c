/* The files that a scene reads: what cannot be read twice, or to its end, is refused before it is
 * opened. */
#include "scene/scene_file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

/* A regular file of more is one of those that the system makes up, or all holes: reading it would
 * not end. */
#define MOST_BYTES (UINT64_C(1) << 40)

typedef struct input {
    const ps_scene_file *file;
    const char *key;
    int line;
} input;

static const char *name_kind(mode_t mode) {
    return S_ISDIR(mode)                    ? "a folder"
           : S_ISFIFO(mode)                 ? "a pipe"
           : S_ISSOCK(mode)                 ? "a socket"
           : S_ISCHR(mode) || S_ISBLK(mode) ? "a device"
                                            : "no regular file";
}

/* Names of what this process has open, or of what the system makes up as it is read. */
static bool is_passing(const char *path) {
    static const char *const folders[] = {"/dev/", "/proc/", "/sys/"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        if (strncmp(path, folders[i], strlen(folders[i])) == 0 &&
            strncmp(path, "/dev/shm/", strlen("/dev/shm/")) != 0) {
            return true;
        }
    }
    return false;
}

static pspec_status check_path(const input *place, const char *path) {
    struct stat facts;
    if (stat(path, &facts) != 0) {
        (void)ps_scene_complain(place->file, place->line, place->key, "cannot read \"%s\": %s",
                                path, strerror(errno));
        return place->file->error->status = PSPEC_ERROR_IO; /* the scene may be right */
    }
    if (!S_ISREG(facts.st_mode) || is_passing(path)) {
        return ps_scene_complain(
            place->file, place->line, place->key,
            "\"%s\" is %s: it is read more than once, and so must be a regular file", path,
            S_ISREG(facts.st_mode) ? "made up by the system" : name_kind(facts.st_mode));
    }
    if (facts.st_size == 0) {
        return ps_scene_complain(place->file, place->line, place->key, "\"%s\" is empty", path);
    }
    return (uint64_t)facts.st_size <= MOST_BYTES
               ? PSPEC_OK
               : ps_scene_complain(place->file, place->line, place->key,
                                   "\"%s\" has %lld bytes, more than %llu", path,
                                   (long long)facts.st_size, (unsigned long long)MOST_BYTES);
}

static pspec_status visit_value(const ps_scene *scene, const ps_scene_result *result,
                                const ps_scene_entry *entry, const ps_scene_value *value,
                                ps_scene_visit_input *visit, void *payload, ps_error *error) {
    ps_option_input *const find = value->set == NULL ? ps_scene_find_input(entry->option) : NULL;
    for (size_t i = 0; i < value->num_texts; i++) {
        const char *const path =
            value->set != NULL ? value->texts[i]
                               : ps_scene_find_path(result->kind, entry->option, value->texts[i]);
        ps_text own = {0};
        if (path == NULL) {
            continue;
        }
        pspec_status status = ps_input_keep(&own, find, path, error);
        if (status == PSPEC_OK) {
            status = visit(payload, scene, entry, value, ps_text_string(&own), error);
        }
        ps_text_free(&own);
        PS_TRY(status);
    }
    return PSPEC_OK;
}

pspec_status ps_scene_visit_inputs(const ps_scene *scene, ps_scene_visit_input *visit,
                                   void *payload, ps_error *error) {
    for (size_t r = 0; r < scene->num_results; r++) {
        const ps_scene_result *const result = &scene->results[r];
        for (size_t e = 0; e < result->num_entries; e++) {
            const ps_scene_entry *const entry = &result->entries[e];
            for (size_t v = 0; v < entry->num_values + entry->num_more; v++) {
                PS_TRY(visit_value(scene, result, entry, &entry->values[v], visit, payload, error));
            }
        }
    }
    return PSPEC_OK;
}

static pspec_status visit_check(void *payload, const ps_scene *scene, const ps_scene_entry *entry,
                                const ps_scene_value *value, const char *path, ps_error *error) {
    (void)payload;
    const ps_scene_file file = {.path = scene->path, .is_made = scene->is_made, .error = error};
    return check_path(&(input){&file, ps_scene_key(entry), value->line}, path);
}

pspec_status ps_scene_check_inputs(const ps_scene *scene, ps_error *error) {
    return ps_scene_visit_inputs(scene, visit_check, NULL, error);
}
