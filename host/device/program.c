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

static pspec_status build(ps_device *device, cl_program *out, const char *source,
                          const char *options, ps_error *error) {
    ps_text text = {0};
    ps_text all_options = {0};
    cl_int code = CL_SUCCESS;
    pspec_status status = PSPEC_OK;
    *out = NULL;
    PS_TRY_OUT(status, ps_kernel_source_expand(source, &text, error));
    ps_text_append(&all_options, "%s %s", common_options, options);
    PS_TRY_OUT(status, ps_text_check(&all_options, error));
    const char *string = ps_text_string(&text);
    *out = clCreateProgramWithSource(device->context, 1, &string, NULL, &code);
    if (code != CL_SUCCESS) {
        *out = NULL;
        PS_TRY_OUT(status, ps_device_fail(code, "clCreateProgramWithSource", error));
    }
    code = clBuildProgram(*out, 1, &device->id, ps_text_string(&all_options), NULL, NULL);
    if (code != CL_SUCCESS) {
        status = fail_build(device, *out, code, source, ps_text_string(&all_options), error);
        clReleaseProgram(*out);
        *out = NULL;
    }
out:
    ps_text_free(&text);
    ps_text_free(&all_options);
    return status;
}

static cl_program find_program(const ps_device *device, const char *key) {
    for (size_t i = 0; i < device->num_programs; i++) {
        if (strcmp(device->programs[i].key, key) == 0) {
            return device->programs[i].program;
        }
    }
    return NULL;
}

/* Takes key over. */
static pspec_status remember_program(ps_device *device, ps_text *key, cl_program program,
                                     ps_error *error) {
    void *programs = device->programs;
    PS_TRY(ps_grow(&programs, &device->programs_capacity, device->num_programs + 1,
                   sizeof *device->programs, "the programs of a device", error));
    device->programs = programs;
    device->programs[device->num_programs++] = (ps_built_program){key->data, program};
    *key = (ps_text){0};
    return PSPEC_OK;
}

static pspec_status get_program(ps_device *device, cl_program *out, const char *source,
                                const char *options, ps_error *error) {
    ps_text key = {0};
    pspec_status status = PSPEC_OK;
    ps_text_append(&key, "%s %s", source, options);
    if (key.failed) {
        return ps_fail(error, PSPEC_ERROR_MEMORY, "no memory for kernel \"%s\"", source);
    }
    *out = find_program(device, key.data);
    if (*out == NULL) {
        PS_TRY_OUT(status, build(device, out, source, options, error));
        status = remember_program(device, &key, *out, error);
        if (status != PSPEC_OK) {
            clReleaseProgram(*out);
        }
    }
out:
    ps_text_free(&key);
    return status;
}

pspec_status ps_kernel_create(ps_device *device, cl_kernel *out, const char *source,
                              const char *name, const char *options, ps_error *error) {
    cl_program program = NULL;
    cl_int code = CL_SUCCESS;
    PS_TRY(ps_kept_check(&device->kept, name, error));
    PS_TRY(get_program(device, &program, source, options, error));
    *out = clCreateKernel(program, name, &code);
    if (code != CL_SUCCESS) {
        *out = NULL;
        return ps_device_fail(code, "clCreateKernel", error);
    }
    return PSPEC_OK;
}
