/* The limit of memory that comes with a run, and not with the scene. */
#include "request/options.h"
#include "scene/scene_file.h"

#include <stdio.h>
#include <string.h>

static bool has_limit(const ps_scene_result *result) {
    for (size_t i = 0; i < result->num_entries; i++) {
        if (result->entries[i].option == PS_OPTION_MEMORY) {
            return true;
        }
    }
    return false;
}

static pspec_status add_limit(ps_scene *scene, ps_scene_result *result, const char *text,
                              ps_error *error) {
    const size_t num = result->num_entries;
    void *memory = NULL;
    PS_TRY(ps_scene_allocate(scene, 1, sizeof(ps_scene_value), &memory, error));
    ps_scene_value *const value = memory;
    PS_TRY(ps_scene_make_value(scene, 1, result->line, value, error));
    PS_TRY(ps_scene_copy(scene, "", text, &value->texts[0], error));
    value->label = value->originals[0] = value->texts[0];
    PS_TRY(ps_scene_allocate(scene, num + 1, sizeof *result->entries, &memory, error));
    ps_scene_entry *const entries = memory;
    if (num > 0) {
        memcpy(entries, result->entries, num * sizeof *entries);
    }
    entries[num] = (ps_scene_entry){
        .option = PS_OPTION_MEMORY, .line = result->line, .num_values = 1, .values = value};
    result->entries = entries;
    result->num_entries = num + 1;
    return PSPEC_OK;
}

pspec_status ps_scene_limit_memory(ps_scene *scene, uint64_t bytes, ps_error *error) {
    char text[32];
    snprintf(text, sizeof text, "%llu", (unsigned long long)bytes);
    for (size_t i = 0; i < scene->num_results; i++) {
        ps_scene_result *const result = &scene->results[i];
        if (ps_kind_asks(result->kind, PS_OPTION_MEMORY) && !has_limit(result)) {
            PS_TRY(add_limit(scene, result, text, error));
        }
    }
    return PSPEC_OK;
}
