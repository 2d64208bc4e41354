/* Kernel text from disk or from the program, with its includes put in place. */
#include "device/programs/kernel_source.h"

#include "base/memory.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INCLUDES = 32, MAX_NAME = 128, READ_BYTES = 4096 };

typedef struct expansion {
    ps_text *out;
    char included[MAX_INCLUDES][MAX_NAME];
    size_t num_included;
} expansion;

static pspec_status fail_memory(const char *name, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_MEMORY, "not enough memory for kernel \"%s\"", name);
}

static pspec_status fail_disk(const char *path, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO,
                   "cannot read kernel source \"%s\" (POINTSPEC_KERNEL_DIR): %s", path,
                   strerror(errno));
}

static pspec_status read_path(const char *path, ps_text *text, ps_error *error) {
    char block[READ_BYTES];
    FILE *const file = fopen(path, "rb");
    if (file == NULL) {
        return fail_disk(path, error);
    }
    size_t length = 0;
    while ((length = fread(block, 1, sizeof block, file)) > 0) {
        ps_text_append_bytes(text, block, length);
    }
    const pspec_status status = ferror(file) ? fail_disk(path, error) : PSPEC_OK;
    fclose(file);
    return status;
}

static pspec_status read_from_disk(const char *directory, const char *name, ps_text *text,
                                   ps_error *error) {
    ps_text path = {0};
    ps_text_append(&path, "%s/%s", directory, name);
    const pspec_status status =
        path.failed ? fail_memory(name, error) : read_path(ps_text_string(&path), text, error);
    ps_text_free(&path);
    return status;
}

static pspec_status read_source(const char *name, ps_text *text, ps_error *error) {
    const char *directory = getenv("POINTSPEC_KERNEL_DIR");
    if (directory != NULL && directory[0] != '\0') {
        return read_from_disk(directory, name, text, error);
    }
    for (const ps_kernel_source *source = ps_kernel_sources; source->name != NULL; source++) {
        if (strcmp(source->name, name) == 0) {
            ps_text_append(text, "%s", source->text);
            return PSPEC_OK;
        }
    }
    return ps_fail(error, PSPEC_ERROR_BUILD, "there is no kernel source named \"%s\"", name);
}

/* The name in a line #include "name", or false. */
static bool parse_include(const char *line, char name[MAX_NAME]) {
    static const char directive[] = "#include \"";
    if (strncmp(line, directive, sizeof directive - 1) != 0) {
        return false;
    }
    const char *begin = line + sizeof directive - 1;
    const size_t length = strcspn(begin, "\"\n");
    if (length == 0 || length >= MAX_NAME || begin[length] != '"') {
        return false;
    }
    memcpy(name, begin, length);
    name[length] = '\0';
    return true;
}

static bool already_included(expansion *state, const char *name) {
    for (size_t i = 0; i < state->num_included; i++) {
        if (strcmp(state->included[i], name) == 0) {
            return true;
        }
    }
    if (state->num_included < MAX_INCLUDES) {
        snprintf(state->included[state->num_included++], MAX_NAME, "%s", name);
    }
    return false;
}

static pspec_status expand(expansion *state, const char *name, ps_error *error) {
    ps_text text = {0};
    char included[MAX_NAME];
    pspec_status status = read_source(name, &text, error);
    if (status == PSPEC_OK && text.failed) {
        status = fail_memory(name, error);
    }
    if (status == PSPEC_OK) {
        ps_text_append(state->out, "#line 1 \"%s\"\n", name);
    }
    const char *line = ps_text_string(&text);
    for (unsigned number = 1; status == PSPEC_OK && *line != '\0'; number++) {
        const size_t length = strcspn(line, "\n");
        if (!parse_include(line, included)) {
            ps_text_append_bytes(state->out, line, length);
            ps_text_append(state->out, "\n");
        } else if (!already_included(state, included)) {
            status = expand(state, included, error);
            ps_text_append(state->out, "#line %u \"%s\"\n", number + 1, name);
        } else {
            ps_text_append(state->out, "\n");
        }
        line += length + (line[length] == '\n');
    }
    ps_text_free(&text);
    return status;
}

pspec_status ps_kernel_source_expand(const char *name, ps_text *out, ps_error *error) {
    expansion state = {.out = out};
    already_included(&state, name); /* marks it: a file that includes itself appears once */
    PS_TRY(expand(&state, name, error));
    return out->failed ? fail_memory(name, error) : PSPEC_OK;
}
