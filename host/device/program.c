/* Building programs, once per (source, options); the drivers keep their own caches on disk. */
#include "device/device_private.h"
#include "device/drivers.h"
#include "device/kernel_source.h"

#include "base/memory.h"
#include "base/text.h"

#include <stdlib.h>
#include <string.h>

/* No relaxed maths: the error formulas count on IEEE arithmetic. */
/* Warnings are those of the machine (vectors wider than its registers), which PoCL counts on
 * standard error; ours are found by the tests. */
static const char common_options[] = "-cl-std=CL1.2 -w";

/* Only a program at fault has a log to show; a driver may fail without looking at it. */
static pspec_status fail_build(const ps_device *device, cl_program program, cl_int code,
                               const char *source, const char *options, ps_error *error) {
    if (code != CL_BUILD_PROGRAM_FAILURE && code != CL_INVALID_BUILD_OPTIONS) {
        return ps_device_fail(code, "clBuildProgram", error);
    }
    enum { LONGEST_LOG = 3000 }; /* leaves room for the sentence in PS_MESSAGE_BYTES */
    size_t bytes = 0;
    char *log = NULL;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &bytes);
    if (bytes > 0 && (log = calloc(bytes + 1, 1)) != NULL) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, bytes, log, NULL);
    }
    ps_fail(error, PSPEC_ERROR_BUILD, "kernel %s does not build on \"%s\" with %s:\n%.*s", source,
            device->limits.name, options, LONGEST_LOG, log != NULL ? log : "(no log)");
    free(log);
    return PSPEC_ERROR_BUILD;
}

static void release_program(ps_program *program) {
    if (program->object != NULL) {
        clReleaseProgram(program->object);
    }
    ps_text_free(&program->source);
    ps_text_free(&program->options);
    free(program);
}

static pspec_status build(const ps_device *device, ps_program *program, const char *source,
                          const char *options, ps_error *error) {
    const char *string = NULL;
    ps_text text = {0};
    cl_int code = CL_SUCCESS;
    pspec_status status = PSPEC_OK;
    ps_text_append(&program->source, "%s", source);
    ps_text_append(&program->options, "%s %s", common_options, options);
    PS_TRY(ps_text_check(&program->source, error));
    PS_TRY(ps_text_check(&program->options, error));
    PS_TRY_OUT(status, ps_kernel_source_expand(source, &text, error));
    string = ps_text_string(&text);
    program->object = clCreateProgramWithSource(device->context, 1, &string, NULL, &code);
    if (code != CL_SUCCESS) {
        program->object = NULL;
        PS_TRY_OUT(status, ps_device_fail(code, "clCreateProgramWithSource", error));
    }
    code = clBuildProgram(program->object, 1, &device->id, ps_text_string(&program->options), NULL,
                          NULL);
    if (code != CL_SUCCESS) {
        status = fail_build(device, program->object, code, source,
                            ps_text_string(&program->options), error);
    }
out:
    ps_text_free(&text);
    return status;
}

static bool is_built_of(const ps_program *program, const char *source, const char *options) {
    return strcmp(ps_text_string(&program->source), source) == 0 &&
           strcmp(ps_text_string(&program->options) + sizeof common_options, options) == 0;
}

static pspec_status get_program(ps_device *device, ps_program **out, const char *source,
                                const char *options, ps_error *error) {
    ps_program **end = &device->programs;
    while (*end != NULL && !is_built_of(*end, source, options)) {
        end = &(*end)->next;
    }
    if (*end == NULL) {
        ps_program *program = NULL;
        PS_TRY(PS_NEW(&program, 1, "a program of kernels", error));
        const pspec_status status = build(device, program, source, options, error);
        if (status != PSPEC_OK) {
            release_program(program);
            return status;
        }
        *end = program;
    }
    *out = *end;
    return PSPEC_OK;
}

static void release_kernel(ps_kernel *kernel) {
    if (kernel->object != NULL) {
        clReleaseKernel(kernel->object);
    }
    ps_text_free(&kernel->name);
    free(kernel);
}

static pspec_status create_kernel(ps_kernel *kernel, ps_program *program, const char *name,
                                  ps_error *error) {
    cl_int code = CL_SUCCESS;
    kernel->program = program;
    ps_text_append(&kernel->name, "%s", name);
    PS_TRY(ps_text_check(&kernel->name, error));
    kernel->object = clCreateKernel(program->object, name, &code);
    if (code != CL_SUCCESS) {
        kernel->object = NULL;
        return ps_device_fail(code, "clCreateKernel", error);
    }
    return PSPEC_OK;
}

static bool is_of(const ps_kernel *kernel, const ps_program *program, const char *name) {
    return kernel->program == program && strcmp(ps_text_string(&kernel->name), name) == 0;
}

pspec_status ps_kernel_get(ps_device *device, ps_kernel **out, const char *source, const char *name,
                           const char *options, ps_error *error) {
    ps_program *program = NULL;
    ps_kernel **end = &device->kernels;
    PS_TRY(ps_kept_check(&device->kept, name, error));
    PS_TRY(get_program(device, &program, source, options, error));
    while (*end != NULL && !is_of(*end, program, name)) {
        end = &(*end)->next;
    }
    if (*end == NULL) {
        ps_kernel *kernel = NULL;
        PS_TRY(PS_NEW(&kernel, 1, "a kernel", error));
        const pspec_status status = create_kernel(kernel, program, name, error);
        if (status != PSPEC_OK) {
            release_kernel(kernel);
            return status;
        }
        *end = kernel;
    }
    *out = *end;
    return PSPEC_OK;
}

void ps_programs_release(ps_device *device) {
    while (device->kernels != NULL) {
        ps_kernel *const kernel = device->kernels;
        device->kernels = kernel->next;
        release_kernel(kernel);
    }
    while (device->programs != NULL) {
        ps_program *const program = device->programs;
        device->programs = program->next;
        release_program(program);
    }
}
