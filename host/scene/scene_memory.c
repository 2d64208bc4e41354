/* The limit of memory that comes with a run, and not with the scene. */
#include "request/options.h"
#include "scene/scene_file.h"

/* There is room for an entry of every option. */
static pspec_status add_limit(const ps_scene_file *file, ps_scene_result *result, uint64_t bytes) {
    ps_text text = {0};
    ps_scene_value *value = NULL;
    const char *kept = NULL;
    ps_text_append(&text, "%llu", (unsigned long long)bytes);
    PS_TRY(ps_text_keep(&kept, &file->scene->memory, &text, file->error));
    PS_TRY(PS_SCENE_NEW(file, &value, 1));
    PS_TRY(ps_scene_make_value(file, 1, result->line, value));
    ps_scene_set_text(value, 0, kept);
    result->entries[result->num_entries++] = (ps_scene_entry){
        .option = PS_OPTION_MEMORY, .line = result->line, .num_values = 1, .values = value};
    return PSPEC_OK;
}

pspec_status ps_scene_limit_memory(ps_scene *scene, uint64_t bytes, ps_error *error) {
    const ps_scene_file file = {.scene = scene, .error = error};
    for (size_t i = 0; i < scene->num_results; i++) {
        ps_scene_result *const result = &scene->results[i];
        if (ps_kind_asks(result->kind, PS_OPTION_MEMORY) &&
            ps_scene_find_entry(result, PS_OPTION_MEMORY) == NULL) {
            PS_TRY(add_limit(&file, result, bytes));
        }
    }
    return PSPEC_OK;
}
