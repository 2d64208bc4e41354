/* The public library: contexts. */
#include "api/public_objects.h"

#include "store/figures_file.h"
#include "store/result_cache.h"

#include <stdlib.h>
#include <string.h>

pspec_context *pspec_context_create(void) {
    return calloc(1, sizeof(pspec_context));
}

void pspec_context_destroy(pspec_context *context) {
    if (context != NULL) {
        ps_device_close(context->device);
        free(context->selector);
        free(context);
    }
}

const char *pspec_context_message(const pspec_context *context) {
    return context != NULL ? context->error.message : "there is no context: no memory for one?";
}

pspec_status pspec_context_set_device(pspec_context *context, const char *selector) {
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    if (context->device != NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "the device \"%s\" is open already: choose before the first question",
                       ps_device_get_limits(context->device)->name);
    }
    char *copy = selector != NULL ? strdup(selector) : NULL;
    if (selector != NULL && copy == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_MEMORY, "no memory for a device's name");
    }
    free(context->selector);
    context->selector = copy;
    return PSPEC_OK;
}

void pspec_context_set_memory_limit(pspec_context *context, uint64_t bytes) {
    if (context != NULL) {
        context->memory_limit = bytes;
    }
}

void pspec_context_set_progress(pspec_context *context, pspec_progress progress, void *payload) {
    if (context != NULL) {
        context->watch = (ps_watch){progress, payload};
    }
}

void pspec_context_set_log(pspec_context *context, pspec_log log, void *payload) {
    if (context != NULL) {
        context->log = (ps_log){log, payload};
    }
}

void pspec_context_set_warnings(pspec_context *context, pspec_log warn, void *payload) {
    if (context != NULL) {
        context->warnings = (ps_log){warn, payload};
    }
}

/* With what `pointspec bench` has measured of it; without a folder for that, with the built-in
 * figures. */
pspec_status ps_context_open_device(pspec_context *context) {
    if (context->device != NULL) {
        return PSPEC_OK;
    }
    ps_text folder = {0};
    const char *const path =
        ps_cache_default_directory(&folder, NULL) == PSPEC_OK ? ps_text_string(&folder) : NULL;
    const pspec_status status =
        ps_figures_open_device(&context->device, context->selector, false, path, &context->error);
    ps_text_free(&folder);
    PS_TRY(status);
    const ps_device_limits *limits = ps_device_get_limits(context->device);
    ps_log_say(&context->log, "opened the device \"%s\" of %s", limits->name, limits->platform);
    return PSPEC_OK;
}
