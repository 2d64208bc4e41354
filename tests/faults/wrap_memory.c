/* Memory: what our code takes, also through functions of the C library and of others that give
 * memory away. */
#include "faults.h"

#include <zlib.h>

#include <errno.h>
#include <glob.h>
#include <stddef.h>
#include <xxhash.h>
#include <yaml.h>

static bool is_refused(const char *name) {
    const bool is_due = fault_is_due(FAULT_MEMORY, name);
    if (is_due) {
        errno = ENOMEM;
    }
    return is_due;
}

#define ALLOCATION(name, type, parameters, arguments)                                              \
    WRAPPER(name, type, parameters) {                                                              \
        type taken = is_refused(#name) ? NULL : __real_##name arguments;                           \
        fault_gain(taken, #name);                                                                  \
        return taken;                                                                              \
    }

ALLOCATION(malloc, void *, (size_t bytes), (bytes))
ALLOCATION(calloc, void *, (size_t count, size_t bytes), (count, bytes))
ALLOCATION(aligned_alloc, void *, (size_t alignment, size_t bytes), (alignment, bytes))
ALLOCATION(strdup, char *, (const char *text), (text))
ALLOCATION(strndup, char *, (const char *text, size_t length), (text, length))

WRAPPER(realloc, void *, (void *old, size_t bytes)) {
    if (is_refused("realloc")) {
        return NULL;
    }
    fault_lose(old);
    void *const grown = __real_realloc(old, bytes);
    fault_gain(grown, "realloc");
    return grown;
}

#define DEALLOCATION(name, type)                                                                   \
    WRAPPER(name, void, (type thing)) {                                                            \
        fault_lose(thing);                                                                         \
        __real_##name(thing);                                                                      \
    }

DEALLOCATION(free, void *)

/* zlib allocates its window here, and gives it back there. */
WRAPPER(inflateInit2_, int, (z_stream * stream, int bits, const char *version, int bytes)) {
    if (is_refused("inflateInit2_")) {
        return Z_MEM_ERROR;
    }
    fault_gain(stream, "inflateInit2_");
    return __real_inflateInit2_(stream, bits, version, bytes);
}

WRAPPER(inflateEnd, int, (z_stream * stream)) {
    fault_lose(stream);
    return __real_inflateEnd(stream);
}

/* ---- libyaml and xxHash ------------------------------------------------------------------ */

ALLOCATION(XXH3_createState, XXH3_state_t *, (void), ())

WRAPPER(XXH3_freeState, XXH_errorcode, (XXH3_state_t * state)) {
    fault_lose(state);
    return __real_XXH3_freeState(state);
}

WRAPPER(yaml_parser_initialize, int, (yaml_parser_t * parser)) {
    if (is_refused("yaml_parser_initialize")) {
        parser->error = YAML_MEMORY_ERROR;
        return 0;
    }
    fault_gain(parser, "yaml_parser_initialize");
    return __real_yaml_parser_initialize(parser);
}

WRAPPER(yaml_parser_delete, void, (yaml_parser_t * parser)) {
    fault_lose(parser);
    __real_yaml_parser_delete(parser);
}

/* Each takes what the deletion of its event gives back, also an empty one. */
#define YAML_STEP(name, type)                                                                      \
    WRAPPER(name, int, (yaml_parser_t * parser, type * out)) {                                     \
        if (is_refused(#name)) {                                                                   \
            parser->error = YAML_MEMORY_ERROR;                                                     \
            return 0;                                                                              \
        }                                                                                          \
        const int is_good = __real_##name(parser, out);                                            \
        fault_gain(is_good ? out : NULL, #name);                                                   \
        return is_good;                                                                            \
    }

YAML_STEP(yaml_parser_parse, yaml_event_t)
DEALLOCATION(yaml_event_delete, yaml_event_t *)

/* Names of files that match: the list belongs to who gives it back. */
WRAPPER(glob64, int,
        (const char *pattern, int flags, int (*tell)(const char *, int), glob_t *found)) {
    if (is_refused("glob64")) {
        return GLOB_NOSPACE;
    }
    fault_lose(found->gl_pathv);
    const int code = __real_glob64(pattern, flags, tell, found);
    fault_gain(found->gl_pathv, "glob64");
    return code;
}

WRAPPER(globfree64, void, (glob_t * found)) {
    fault_lose(found->gl_pathv);
    __real_globfree64(found);
}
