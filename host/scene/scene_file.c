/* The file of a scene, read and parsed. */
#include "scene/scene_file.h"

#include "base/memory.h"
#include "files/input_file.h"

#include <stdlib.h>

/* Larger than the record of the most questions. */
enum { MOST_BYTES = 1 << 23 };

static pspec_status read_all(const char *path, unsigned char *bytes, size_t *num, ps_error *error) {
    ps_input input;
    pspec_status status = ps_input_open(&input, path, error);
    if (status == PSPEC_OK) {
        status = ps_input_read(&input, bytes, MOST_BYTES + 1, num, error);
    }
    ps_input_close(&input);
    if (status == PSPEC_OK && *num > MOST_BYTES) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "\"%s\" is larger than %d bytes, which no scene is", path, MOST_BYTES);
    }
    return status;
}

pspec_status ps_scene_file_parse(ps_scene_file *file, const unsigned char *bytes, size_t num) {
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) {
        return ps_fail(file->error, PSPEC_ERROR_MEMORY, "no memory for the scene \"%s\"",
                       file->path);
    }
    yaml_parser_set_input_string(&parser, bytes, num);
    const pspec_status status = ps_scene_build(file, &parser);
    yaml_parser_delete(&parser);
    return status;
}

pspec_status ps_scene_file_read(ps_scene_file *out, ps_scene *scene, const char *path,
                                ps_error *error) {
    void *bytes = NULL;
    size_t num = 0;
    *out = (ps_scene_file){.scene = scene, .path = path, .error = error};
    PS_TRY(ps_allocate(&bytes, MOST_BYTES + 1, 1, "a scene", error));
    pspec_status status = read_all(path, bytes, &num, error);
    if (status == PSPEC_OK) {
        status = ps_scene_file_parse(out, bytes, num);
    }
    free(bytes);
    return status;
}
