/* The file of a scene as a document of YAML. */
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

/* One document, and nothing after it. */
static pspec_status load(ps_scene_file *file, yaml_parser_t *parser) {
    yaml_document_t rest;
    if (!yaml_parser_load(parser, &file->document)) {
        return ps_scene_fail_parser(file, parser);
    }
    file->has_document = true;
    if (yaml_document_get_root_node(&file->document) == NULL) {
        return ps_scene_complain(file, 1, NULL, "nothing is asked for: the file has no content");
    }
    if (!yaml_parser_load(parser, &rest)) {
        return ps_scene_fail_parser(file, parser);
    }
    const yaml_node_t *const more = yaml_document_get_root_node(&rest);
    const pspec_status status =
        more == NULL ? PSPEC_OK
                     : ps_scene_complain(file, ps_scene_line(more), NULL,
                                         "a second document begins here; a scene is one");
    yaml_document_delete(&rest);
    return status;
}

typedef pspec_status use_parser(ps_scene_file *, yaml_parser_t *);

static pspec_status parse(ps_scene_file *file, const unsigned char *bytes, size_t num,
                          use_parser *use) {
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser)) {
        return ps_fail(file->error, PSPEC_ERROR_MEMORY, "no memory for the scene \"%s\"",
                       file->path);
    }
    yaml_parser_set_input_string(&parser, bytes, num);
    const pspec_status status = use(file, &parser);
    yaml_parser_delete(&parser);
    return status;
}

pspec_status ps_scene_file_open(ps_scene_file *out, const char *path, ps_error *error) {
    void *bytes = NULL;
    size_t num = 0;
    *out = (ps_scene_file){.path = path, .error = error};
    PS_TRY(ps_allocate(&bytes, MOST_BYTES + 1, 1, "a scene", error));
    pspec_status status = read_all(path, bytes, &num, error);
    if (status == PSPEC_OK) {
        status = parse(out, bytes, num, ps_scene_check_events);
    }
    if (status == PSPEC_OK) {
        status = parse(out, bytes, num, load);
    }
    free(bytes);
    return status;
}

void ps_scene_file_close(ps_scene_file *file) {
    if (file->has_document) {
        yaml_document_delete(&file->document);
        file->has_document = false;
    }
}
