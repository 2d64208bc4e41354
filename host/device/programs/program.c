/* Programs, one for each (source, options), and their kernels; the drivers keep what they built on
 * disk, by their own version. */
#include "device/device_private.h"
#include "device/drivers.h"
#include "device/programs/kernel_source.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* No relaxed maths: the error formulas count on IEEE arithmetic. */
/* Warnings are those of the machine (vectors wider than its registers), which PoCL counts on
 * standard error; ours are found by the tests. */
static const char common_options[] = "-cl-std=CL1.2 -w";

/* Only a program at fault has a log to show; a driver may fail without looking at it. */
static pspec_status fail_build(const ps_device *device, const ps_program *program,
                               ps_error *error) {
    if (program->code != CL_BUILD_PROGRAM_FAILURE && program->code != CL_INVALID_BUILD_OPTIONS) {
        return ps_device_fail(program->code, "clBuildProgram", error);
    }
    enum { LONGEST_LOG = 3000 }; /* leaves room for the sentence in PS_MESSAGE_BYTES */
    size_t bytes = 0;
    char *log = NULL;
    clGetProgramBuildInfo(program->object, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes);
    if (bytes > 0 && (log = calloc(bytes + 1, 1)) != NULL) {
        clGetProgramBuildInfo(program->object, device->id, CL_PROGRAM_BUILD_LOG, bytes, log, NULL);
    }
    ps_fail(error, PSPEC_ERROR_BUILD, "kernel %s does not build on \"%s\" with %s:\n%.*s",
            ps_text_string(&program->source), device->limits.name,
            ps_text_string(&program->options), LONGEST_LOG, log != NULL ? log : "(no log)");
    free(log);
    return PSPEC_ERROR_BUILD;
}

ps_defines ps_defines_of(size_t real_bytes, unsigned lanes) {
    ps_defines defines = {""};
    ps_defines_add(&defines, "-DPRECISION=%zu", 8 * real_bytes);
    if (lanes > 0) {
        ps_defines_add(&defines, "-DLANES=%u", lanes);
    }
    return defines;
}

void ps_defines_add(ps_defines *defines, const char *format, ...) {
    char *const text = defines->text;
    va_list arguments;
    size_t length = strlen(text);
    if (length > 0 && length + 1 < sizeof defines->text) {
        text[length++] = ' ';
    }
    va_start(arguments, format);
    vsnprintf(text + length, sizeof defines->text - length, format, arguments);
    va_end(arguments);
}

static void release_program(ps_program *program) {
    if (program->object != NULL) {
        clReleaseProgram(program->object);
    }
    ps_text_free(&program->source);
    ps_text_free(&program->options);
    free(program);
}

static pspec_status create_program(const ps_device *device, ps_program *program, const char *source,
                                   const char *options, ps_error *error) {
    ps_text text = {0};
    cl_int code = CL_SUCCESS;
    ps_text_append(&program->source, "%s", source);
    ps_text_append(&program->options, "%s %s", common_options, options);
    PS_TRY(ps_text_check(&program->source, error));
    PS_TRY(ps_text_check(&program->options, error));
    pspec_status status = ps_kernel_source_expand(source, &text, error);
    if (status == PSPEC_OK) {
        const char *string = ps_text_string(&text);
        program->object = clCreateProgramWithSource(device->context, 1, &string, NULL, &code);
    }
    if (code != CL_SUCCESS) {
        program->object = NULL;
        status = ps_device_fail(code, "clCreateProgramWithSource", error);
    }
    ps_text_free(&text);
    return status;
}

static bool is_made_of(const ps_program *program, const char *source, const char *options) {
    return strcmp(ps_text_string(&program->source), source) == 0 &&
           strcmp(ps_text_string(&program->options) + sizeof common_options, options) == 0;
}

static pspec_status get_program(ps_device *device, ps_program **out, const char *source,
                                const char *options, ps_error *error) {
    ps_program **end = &device->programs;
    while (*end != NULL && !is_made_of(*end, source, options)) {
        end = &(*end)->next;
    }
    if (*end == NULL) {
        ps_program *program = NULL;
        PS_TRY(PS_NEW(&program, 1, "a program of kernels", error));
        const pspec_status status = create_program(device, program, source, options, error);
        if (status != PSPEC_OK) {
            release_program(program);
            return status;
        }
        pthread_mutex_lock(&device->builders.mutex);
        *end = program;
        pthread_mutex_unlock(&device->builders.mutex);
    }
    *out = *end;
    return PSPEC_OK;
}

static bool is_of(const ps_kernel *kernel, const ps_program *program, const char *name) {
    return kernel->program == program && strcmp(kernel->name, name) == 0;
}

/* What PoCL has kept of kernels of this name is looked at here, before it may load it, and not by
 * each question that takes the kernel. */
static pspec_status add_kernel(ps_device *device, ps_kernel **out, ps_program *program,
                               const char *name, ps_error *error) {
    PS_TRY(ps_kept_check(&device->kept, name, error));
    PS_TRY(PS_NEW(out, 1, "a kernel", error));
    (*out)->program = program;
    snprintf((*out)->name, sizeof(*out)->name, "%s", name);
    return PSPEC_OK;
}

pspec_status ps_kernel_get(ps_device *device, ps_kernel **out, const char *source, const char *name,
                           const char *options, ps_error *error) {
    ps_program *program = NULL;
    ps_kernel **end = &device->kernels;
    cl_kernel object = NULL;
    if (strlen(options) + 1 >= PS_DEFINES_BYTES) { /* what was cut has all the room */
        return ps_fail(error, PSPEC_ERROR_BUILD,
                       "kernel %s has more than %d letters of options: %s", source,
                       PS_DEFINES_BYTES - 2, options);
    }
    PS_TRY(get_program(device, &program, source, options, error));
    while (*end != NULL && !is_of(*end, program, name)) {
        end = &(*end)->next;
    }
    if (*end == NULL) {
        PS_TRY(add_kernel(device, end, program, name, error));
    }
    if (!ps_builders_begin(device, program)) {
        PS_TRY(ps_kernel_object(device, *end, &object, error));
    }
    *out = *end;
    return PSPEC_OK;
}

pspec_status ps_kernel_object(ps_device *device, ps_kernel *kernel, cl_kernel *out,
                              ps_error *error) {
    if (kernel->object == NULL) {
        cl_int code = CL_SUCCESS;
        if (ps_builders_wait(device, kernel->program) != CL_SUCCESS) {
            return fail_build(device, kernel->program, error);
        }
        kernel->object = clCreateKernel(kernel->program->object, kernel->name, &code);
        if (code != CL_SUCCESS) {
            kernel->object = NULL;
            return ps_device_fail(code, "clCreateKernel", error);
        }
    }
    *out = kernel->object;
    return PSPEC_OK;
}

pspec_status ps_device_build(ps_device *device, ps_error *error) {
    for (ps_kernel *kernel = device->kernels; kernel != NULL; kernel = kernel->next) {
        cl_kernel object = NULL;
        if (ps_builders_has(device, kernel->program)) {
            PS_TRY(ps_kernel_object(device, kernel, &object, error));
        }
    }
    return PSPEC_OK;
}

void ps_programs_release(ps_device *device) {
    ps_builders_end(device);
    while (device->kernels != NULL) {
        ps_kernel *const kernel = device->kernels;
        device->kernels = kernel->next;
        if (kernel->object != NULL) {
            clReleaseKernel(kernel->object);
        }
        free(kernel);
    }
    while (device->programs != NULL) {
        ps_program *const program = device->programs;
        device->programs = program->next;
        release_program(program);
    }
}
