/* Preloaded into a program (bench/gpu/static.sh): its OpenCL device says that it is a large GPU,
 * and launches are written down, into the file that POINTSPEC_LAUNCHES names, instead of being run:
 * what is read back is zeros. */
#define _GNU_SOURCE
#include <CL/cl.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

enum { ASK_CAPABILITY = 0x4000 }; /* host/device/device.c */

/* As NVIDIA's driver says of an H100; what chooses engines and their parameters for a GPU. The
 * lanes are 1 on AMD's, too. Memory is what there is here. */
cl_int clGetDeviceInfo(cl_device_id id, cl_device_info what, size_t bytes, void *value,
                       size_t *size) {
    if (what == ASK_CAPABILITY) {
        const char *const asked = getenv("POINTSPEC_CAPABILITY");
        *(cl_uint *)value = asked != NULL ? (cl_uint)atoi(asked) : 9;
        return CL_SUCCESS;
    }
    if (what == CL_DEVICE_VENDOR) {
        static const char vendor[] = "NVIDIA Corporation";
        if (size != NULL) {
            *size = sizeof vendor;
        }
        if (value != NULL) {
            snprintf(value, bytes, "%s", vendor);
        }
        return CL_SUCCESS;
    }
    const cl_int code = REAL(clGetDeviceInfo)(id, what, bytes, value, size);
    if (code != CL_SUCCESS || value == NULL) {
        return code;
    }
    switch (what) {
    case CL_DEVICE_TYPE:
        *(cl_device_type *)value = CL_DEVICE_TYPE_GPU;
        break;
    case CL_DEVICE_LOCAL_MEM_TYPE:
        *(cl_device_local_mem_type *)value = CL_LOCAL;
        break;
    case CL_DEVICE_LOCAL_MEM_SIZE:
        *(cl_ulong *)value = 48 << 10;
        break;
    case CL_DEVICE_MAX_COMPUTE_UNITS:
        *(cl_uint *)value = 132;
        break;
    case CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT:
    case CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE:
        *(cl_uint *)value = 1;
        break;
    case CL_DEVICE_MAX_CLOCK_FREQUENCY:
        *(cl_uint *)value = 1980;
        break;
    case CL_DEVICE_MAX_WORK_GROUP_SIZE:
        *(size_t *)value = 1024;
        break;
    case CL_DEVICE_HOST_UNIFIED_MEMORY:
        *(cl_bool *)value = CL_FALSE;
        break;
    default:
        break;
    }
    return code;
}

/* Zeros, which maps and copies find, too, where no kernel has written. */
cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void *host,
                      cl_int *code) {
    void *const zeros = host == NULL ? calloc(1, bytes) : NULL;
    const cl_mem memory =
        REAL(clCreateBuffer)(context, zeros != NULL ? flags | CL_MEM_COPY_HOST_PTR : flags, bytes,
                             zeros != NULL ? zeros : host, code);
    free(zeros);
    return memory;
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem memory, cl_bool waits_here, size_t offset,
                           size_t bytes, void *data, cl_uint num_waits, const cl_event *waits,
                           cl_event *event) {
    const cl_int code = REAL(clEnqueueReadBuffer)(queue, memory, waits_here, offset, bytes, data,
                                                  num_waits, waits, event);
    memset(data, 0, bytes);
    return code;
}

/* Nobody here takes PTX: programs with it are built without, and written down with it. */
static const char ptx[] = "UNITS=UNITS_PTX", emulated[] = "UNITS=UNITS_EMULATED";

static void replace(char *text, size_t room, const char *what, const char *by) {
    char *const at = strstr(text, what);
    if (at != NULL) {
        char rest[1024];
        snprintf(rest, sizeof rest, "%s", at + strlen(what));
        snprintf(at, room - (size_t)(at - text), "%s%s", by, rest);
    }
}

cl_int clBuildProgram(cl_program program, cl_uint num, const cl_device_id *ids, const char *options,
                      void (*done)(cl_program, void *), void *payload) {
    char changed[1024];
    snprintf(changed, sizeof changed, "%s", options);
    replace(changed, sizeof changed, ptx, emulated);
    return REAL(clBuildProgram)(program, num, ids, changed, done, payload);
}

static _Thread_local size_t local_bytes; /* of the arguments set last */

cl_int clSetKernelArg(cl_kernel kernel, cl_uint index, size_t bytes, const void *value) {
    local_bytes = (index > 0 ? local_bytes : 0) + (value == NULL ? bytes : 0);
    return REAL(clSetKernelArg)(kernel, index, bytes, value);
}

/* A line "SOURCE KERNEL GROUP LOCAL-BYTES OPTIONS"; the text of a program begins with the name of
 * its source (host/device/programs/kernel_source.c). */
static void write_down(cl_command_queue queue, cl_kernel kernel, size_t group) {
    cl_program program = NULL;
    cl_device_id id = NULL;
    char name[128] = "", options[1024] = "", source[128] = "";
    size_t bytes = 0;
    clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, NULL);
    clGetKernelInfo(kernel, CL_KERNEL_PROGRAM, sizeof(cl_program), &program, NULL);
    clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof(cl_device_id), &id, NULL);
    clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_OPTIONS, sizeof options, options, NULL);
    clGetProgramInfo(program, CL_PROGRAM_SOURCE, 0, NULL, &bytes);
    replace(options, sizeof options, emulated, ptx);
    char *const text = calloc(bytes + 1, 1);
    FILE *const file = fopen(getenv("POINTSPEC_LAUNCHES"), "a");
    if (text == NULL || file == NULL) {
        abort();
    }
    clGetProgramInfo(program, CL_PROGRAM_SOURCE, bytes, text, NULL);
    sscanf(text, "#line 1 \"%127[^\"]", source);
    fprintf(file, "%s %s %zu %zu %s\n", source, name, group, local_bytes, options);
    fclose(file);
    free(text);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint rank,
                              const size_t *offset, const size_t *global, const size_t *local,
                              cl_uint num_waits, const cl_event *waits, cl_event *event) {
    size_t group = 1;
    (void)offset;
    (void)global;
    for (cl_uint i = 0; local != NULL && i < rank; i++) {
        group *= local[i];
    }
    write_down(queue, kernel, group);
    return event != NULL ? clEnqueueMarkerWithWaitList(queue, num_waits, waits, event) : CL_SUCCESS;
}
