/* Finding, describing, choosing and opening devices. */
#include "device/choice.h"
#include "device/device_private.h"
#include "device/drivers.h"

#include "base/memory.h"
#include "base/process/process_lock.h"
#include "base/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_PLATFORMS = 16, MAX_DEVICES = PS_SELECTORS_MOST };

/* ---- listing ----------------------------------------------------------------------------- */

/* A driver that fails is not the same as none. */
static pspec_status fail_listing(cl_int code, const char *call, ps_error *error) {
    const bool is_absent =
        code == CL_SUCCESS || code == PS_CL_PLATFORM_NOT_FOUND || code == CL_DEVICE_NOT_FOUND;
    if (code == CL_OUT_OF_HOST_MEMORY) {
        return ps_drivers_fail_memory(call, error);
    }
    return is_absent ? ps_drivers_fail(error) : ps_device_fail(code, call, error);
}

/* Every device of every platform; *num_devices is 0 at most when it fails. A platform that cannot
 * tell its devices is passed over as long as another has some. */
static pspec_status find_devices(cl_device_id *devices, size_t *num_devices, ps_error *error) {
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint num_platforms = 0;
    *num_devices = 0;
    PS_TRY(ps_drivers_check_room(error));
    cl_int code = clGetPlatformIDs(MAX_PLATFORMS, platforms, &num_platforms);
    if (code != CL_SUCCESS) {
        return fail_listing(code, "clGetPlatformIDs", error);
    }
    num_platforms = num_platforms < MAX_PLATFORMS ? num_platforms : MAX_PLATFORMS;
    for (cl_uint i = 0; i < num_platforms && *num_devices < MAX_DEVICES; i++) {
        cl_uint found = 0;
        const cl_uint room = (cl_uint)(MAX_DEVICES - *num_devices);
        const cl_int answer =
            clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, room, devices + *num_devices, &found);
        if (answer == CL_SUCCESS) {
            *num_devices += found < room ? found : room;
        } else if (answer != CL_DEVICE_NOT_FOUND) { /* a platform without devices says that */
            code = answer;
        }
    }
    return *num_devices > 0 ? PSPEC_OK : fail_listing(code, "clGetDeviceIDs", error);
}

/* Asks one device; after the first failure every answer is empty, so that callers look once. */
typedef struct questions {
    cl_device_id id;
    pspec_status status;
    ps_error *error;
} questions;

/* True when the answer is there. CL_INVALID_VALUE says that the driver does not know the question,
 * which no driver has to: that answer is empty or 0. */
static bool is_answered(questions *ask, cl_int code, const char *call) {
    if (code != CL_SUCCESS && code != CL_INVALID_VALUE) {
        ask->status = ps_device_fail(code, call, ask->error);
    }
    return code == CL_SUCCESS;
}

static void query_text(questions *ask, cl_device_info what, char *out, size_t out_bytes) {
    void *text = NULL;
    size_t bytes = 0;
    out[0] = '\0';
    if (ask->status != PSPEC_OK ||
        !is_answered(ask, clGetDeviceInfo(ask->id, what, 0, NULL, &bytes), "clGetDeviceInfo")) {
        return;
    }
    ask->status = ps_allocate(&text, bytes, 1, "the name of a device", ask->error);
    if (ask->status == PSPEC_OK &&
        is_answered(ask, clGetDeviceInfo(ask->id, what, bytes, text, NULL), "clGetDeviceInfo")) {
        snprintf(out, out_bytes, "%.*s", (int)bytes, (const char *)text);
    }
    free(text);
}

static uint64_t query_number(questions *ask, cl_device_info what, size_t bytes) {
    uint64_t number = 0; /* little-endian hosts only: smaller types fill the low bytes */
    return ask->status == PSPEC_OK &&
                   is_answered(ask, clGetDeviceInfo(ask->id, what, bytes, &number, NULL),
                               "clGetDeviceInfo")
               ? number
               : 0;
}

static unsigned query_uint(questions *ask, cl_device_info what) {
    return (unsigned)query_number(ask, what, sizeof(cl_uint));
}

static void query_platform(questions *ask, char *out, size_t out_bytes) {
    cl_platform_id platform = NULL;
    out[0] = '\0';
    if (ask->status == PSPEC_OK &&
        is_answered(ask,
                    clGetDeviceInfo(ask->id, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL),
                    "clGetDeviceInfo") &&
        !is_answered(ask, clGetPlatformInfo(platform, CL_PLATFORM_NAME, out_bytes, out, NULL),
                     "clGetPlatformInfo")) {
        out[0] = '\0';
    }
}

static void query_kind(questions *ask, ps_device_limits *limits) {
    query_text(ask, CL_DEVICE_NAME, limits->name, sizeof limits->name);
    query_text(ask, CL_DRIVER_VERSION, limits->driver, sizeof limits->driver);
    query_text(ask, CL_DEVICE_VERSION, limits->version, sizeof limits->version);
    query_platform(ask, limits->platform, sizeof limits->platform);
    const uint64_t type = query_number(ask, CL_DEVICE_TYPE, sizeof(cl_device_type));
    limits->is_gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
    limits->is_cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    limits->has_fp64 =
        query_number(ask, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof(cl_device_fp_config)) != 0;
    limits->has_dedicated_local_memory =
        query_number(ask, CL_DEVICE_LOCAL_MEM_TYPE, sizeof(cl_device_local_mem_type)) == CL_LOCAL;
    limits->has_unified_memory =
        query_number(ask, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof(cl_bool)) != 0;
}

/* NVIDIA's compute capability (cl_nv_device_attribute_query). */
enum { ASK_CAPABILITY = 0x4000, ASK_MINOR_CAPABILITY = 0x4001 };

/* What is said of NVIDIA's devices alone. */
static void query_capability(questions *ask, ps_device_limits *limits) {
    char vendor[64];
    query_text(ask, CL_DEVICE_VENDOR, vendor, sizeof vendor);
    if (strstr(vendor, "NVIDIA") != NULL) {
        const unsigned major = query_uint(ask, ASK_CAPABILITY);
        ps_units_of_capability(limits, major, query_uint(ask, ASK_MINOR_CAPABILITY));
    }
}

static pspec_status read_limits(cl_device_id id, ps_device_limits *limits, ps_error *error) {
    questions ask = {id, PSPEC_OK, error};
    *limits = (ps_device_limits){0};
    query_kind(&ask, limits);
    limits->compute_units = query_uint(&ask, CL_DEVICE_MAX_COMPUTE_UNITS);
    limits->clock_mhz = query_uint(&ask, CL_DEVICE_MAX_CLOCK_FREQUENCY);
    limits->native_float_lanes = query_uint(&ask, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT);
    limits->native_double_lanes = query_uint(&ask, CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE);
    limits->max_work_group_size =
        (size_t)query_number(&ask, CL_DEVICE_MAX_WORK_GROUP_SIZE, sizeof(size_t));
    limits->global_bytes = query_number(&ask, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof(cl_ulong));
    limits->max_allocation_bytes =
        query_number(&ask, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof(cl_ulong));
    limits->local_bytes = query_number(&ask, CL_DEVICE_LOCAL_MEM_SIZE, sizeof(cl_ulong));
    if (limits->has_dedicated_local_memory && limits->local_bytes > PS_DRIVERS_LOCAL_BYTES) {
        limits->local_bytes -= PS_DRIVERS_LOCAL_BYTES;
    }
    limits->cache_bytes = query_number(&ask, CL_DEVICE_GLOBAL_MEM_CACHE_SIZE, sizeof(cl_ulong));
    query_capability(&ask, limits);
    return ask.status;
}

static pspec_status list_devices(ps_device_limits **limits, size_t *num_devices, ps_error *error) {
    cl_device_id devices[MAX_DEVICES];
    ps_device_limits *list = NULL;
    *limits = NULL;
    PS_TRY(find_devices(devices, num_devices, error));
    PS_TRY(PS_NEW(&list, *num_devices, "the list of devices", error));
    for (size_t i = 0; i < *num_devices; i++) {
        const pspec_status status = read_limits(devices[i], list + i, error);
        if (status != PSPEC_OK) {
            free(list);
            return status;
        }
    }
    *limits = list;
    return PSPEC_OK;
}

pspec_status ps_device_list(ps_device_limits **limits, size_t *num_devices, ps_error *error) {
    ps_process_lock();
    const pspec_status status = list_devices(limits, num_devices, error);
    ps_process_unlock();
    return status;
}

/* ---- opening ----------------------------------------------------------------------------- */

/* Sub-devices are made for good, and all at once: one is kept. */
static pspec_status split(ps_device *device, const ps_choice *choice, ps_error *error) {
    const size_t units = device->limits.compute_units;
    cl_device_partition_property counts[PS_SELECTORS_MOST + 3] = {CL_DEVICE_PARTITION_BY_COUNTS};
    cl_device_id shares[PS_SELECTORS_MOST];
    cl_uint num = 0;
    for (unsigned i = 0; i < choice->num_shares; i++) { /* zeros end them */
        counts[i + 1] =
            (cl_device_partition_property)(ps_share_begin(units, i + 1,
                                                          (unsigned)choice->num_shares) -
                                           ps_share_begin(units, i, (unsigned)choice->num_shares));
    }
    PS_TRY_CL(clCreateSubDevices(device->id, counts, (cl_uint)choice->num_shares, shares, &num),
              error);
    device->id = shares[choice->share];
    device->is_share = true;
    for (size_t i = 0; i < num; i++) {
        if (i != choice->share) {
            clReleaseDevice(shares[i]);
        }
    }
    return PSPEC_OK;
}

static pspec_status take_share(ps_device *device, const ps_choice *choice, ps_error *error) {
    const ps_device_limits *const limits = &device->limits;
    questions ask = {device->id, PSPEC_OK, error};
    const unsigned most = query_uint(&ask, CL_DEVICE_PARTITION_MAX_SUB_DEVICES);
    PS_TRY(ask.status);
    if (choice->num_shares > most || choice->num_shares > limits->compute_units) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "\"%s\", of %u compute units, is not split into %zu shares%s", limits->name,
                       limits->compute_units, choice->num_shares,
                       most > 0 ? "" : ": its driver splits no device");
    }
    PS_TRY(split(device, choice, error));
    return read_limits(device->id, &device->limits, error);
}

static void remember_own(ps_device *device) {
    const ps_device_limits *const limits = &device->limits;
    device->own_max_allocation = limits->max_allocation_bytes;
    device->own_local_bytes = limits->local_bytes;
    device->own_float_lanes = limits->native_float_lanes;
    device->own_double_lanes = limits->native_double_lanes;
    device->own_unified_memory = limits->has_unified_memory;
    device->own_dedicated_local_memory = limits->has_dedicated_local_memory;
}

static pspec_status choose_among(const cl_device_id *devices, size_t num_devices,
                                 const char *selector, ps_device *device, ps_error *error) {
    ps_device_limits limits[MAX_DEVICES];
    ps_choice choice;
    for (size_t i = 0; i < num_devices; i++) {
        PS_TRY(read_limits(devices[i], &limits[i], error));
    }
    PS_TRY(ps_device_choose_share(&choice, limits, num_devices, selector, error));
    if (ps_device_is_pocl(&limits[choice.index])) {
        PS_TRY(ps_drivers_check_pocl(error));
        PS_TRY(ps_kept_list(&device->kept, error));
    }
    device->id = devices[choice.index];
    device->limits = limits[choice.index];
    if (choice.num_shares > 0) {
        PS_TRY(take_share(device, &choice, error));
    }
    remember_own(device);
    if (device->limits.is_gpu && !ps_device_is_simulator(&device->limits)) {
        ps_device_set_builders(device, ps_workers_most());
    }
    return PSPEC_OK;
}

static pspec_status open_queue(ps_device *device, ps_error *error) {
    cl_int code = CL_SUCCESS;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    if (code != CL_SUCCESS) {
        return ps_device_fail(code, "clCreateContext", error);
    }
    return ps_queue_create(device, &device->queue, error);
}

static pspec_status find_and_open(ps_device *device, const char *selector, ps_error *error) {
    cl_device_id devices[MAX_DEVICES];
    size_t num_devices = 0;
    PS_TRY(find_devices(devices, &num_devices, error));
    PS_TRY(choose_among(devices, num_devices, selector, device, error));
    return open_queue(device, error);
}

pspec_status ps_device_open(ps_device **out, const char *selector, bool with_profile,
                            ps_error *error) {
    ps_device *device = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&device, 1, "a device", error));
    device->has_profile = with_profile;
    ps_builders_create(&device->builders);
    ps_process_lock();
    const pspec_status status = find_and_open(device, selector, error);
    ps_process_unlock();
    if (status != PSPEC_OK) {
        ps_device_close(device);
        return status;
    }
    if (device->limits.units == PS_UNITS_UNKNOWN) {
        device->limits.units =
            ps_units_are_right(device, PS_UNITS_PTX) ? PS_UNITS_PTX : PS_UNITS_NONE;
    }
    *out = device;
    return PSPEC_OK;
}

/* A job that was cancelled leaves commands behind, and PoCL 3.1 lets go of a part of a device while
 * they run: its threads then read what is gone (4 of 800 jobs whose other device was lost). */
static void finish_work(cl_command_queue queue) {
    if (queue != NULL) {
        (void)clFinish(queue);
    }
}

/* A thread of PoCL 3.1 looks at the part once more after it has said that a command has ended; it
 * holds the queue until then (one of 110 processes that closed six parts ended there). */
static void wait_for_holders(cl_command_queue queue) {
    const struct timespec pause = {0, 100000}; /* nanoseconds */
    const unsigned most_pauses = 10000;        /* a second */
    for (unsigned i = 0; queue != NULL && i < most_pauses; i++) {
        cl_uint holders = 1;
        (void)clGetCommandQueueInfo(queue, CL_QUEUE_REFERENCE_COUNT, sizeof holders, &holders,
                                    NULL);
        if (holders <= 1) {
            break;
        }
        nanosleep(&pause, NULL);
    }
}

void ps_device_close(ps_device *device) {
    if (device == NULL) {
        return;
    }
    if (device->is_share) {
        finish_work(device->uploads);
        finish_work(device->queue);
    }
    ps_programs_release(device);
    globfree(&device->kept);
    free(device->figures);
    ps_staged_release(device);
    if (device->is_share) {
        wait_for_holders(device->uploads);
        wait_for_holders(device->queue);
    }
    ps_process_lock();
    if (device->uploads != NULL) {
        clReleaseCommandQueue(device->uploads);
    }
    if (device->queue != NULL) {
        clReleaseCommandQueue(device->queue);
    }
    if (device->context != NULL) {
        clReleaseContext(device->context);
    }
    if (device->is_share) {
        clReleaseDevice(device->id);
    }
    ps_process_unlock();
    ps_large_pool_leave(device->large);
    free(device);
}

const ps_device_limits *ps_device_get_limits(const ps_device *device) {
    return device != NULL ? &device->limits : NULL;
}

void ps_device_set_name(ps_device *device, const char *name) {
    snprintf(device->limits.name, sizeof device->limits.name, "%s", name);
}

pspec_status ps_device_set_figures(ps_device *device, const ps_figures *figures, ps_error *error) {
    if (device->figures == NULL) {
        PS_TRY(PS_NEW(&device->figures, 1, "figures of a device", error));
    }
    *device->figures = *figures;
    device->limits.figures = device->figures;
    return PSPEC_OK;
}

pspec_status ps_device_finish(ps_device *device, ps_error *error) {
    device->num_waits++;
    if (device->uploads != NULL) {
        PS_TRY_CL(clFinish(device->uploads), error);
    }
    PS_TRY_CL(clFinish(device->queue), error);
    return PSPEC_OK;
}
