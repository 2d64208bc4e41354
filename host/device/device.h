/* An OpenCL device: choice, limits, buffers, programs, launches, profile.
 *
 * A ps_device owns its context, its in-order queues and every program and kernel built through it.
 * One thread at a time; different devices, or the same one opened twice, in different threads:
 * looking, opening and closing go under the lock of the process, since PoCL has none there. Nothing
 * here knows what the kernels compute.
 */
#ifndef PS_DEVICE_DEVICE_H
#define PS_DEVICE_DEVICE_H

#include "base/status.h"
#include "device/figures.h"

#include <CL/cl.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- what a device can do ------------------------------------------------------------------ */

/* Units that multiply matrices, of kernels/torus/units.h. */
typedef enum ps_units {
    PS_UNITS_NONE = 0,
    PS_UNITS_UNKNOWN,  /* of a listed device that may have them: opening it tries them */
    PS_UNITS_EMULATED, /* by plain arithmetic, for tests */
    PS_UNITS_PTX       /* of NVIDIA, by inline PTX */
} ps_units;
const char *ps_units_name(ps_units units);
/* Of kernels that include kernels/torus/units.h, "-DUNITS=.." */
const char *ps_units_option(ps_units units);

typedef struct ps_device_limits {
    char name[128], platform[128], driver[128], version[128];
    bool is_gpu, is_cpu;
    bool has_fp64;
    bool has_dedicated_local_memory; /* GPUs; on CPUs local memory is ordinary memory */
    bool has_unified_memory;         /* the host writes into buffers without a copy */
    unsigned compute_units, clock_mhz;
    unsigned native_float_lanes, native_double_lanes;
    unsigned double_cost; /* single operations in the time of one in double; 0: not known */
    size_t max_work_group_size;
    uint64_t global_bytes, max_allocation_bytes, local_bytes, cache_bytes;
    ps_units units;
    /* what was measured of it, owned by the open device; NULL: nothing */
    const ps_figures *figures;
} ps_device_limits;

/* Limits of every device of every driver, in the order of their indices; *limits is freed by the
 * caller. No device at all is PSPEC_ERROR_NO_DEVICE, with the reason (device/drivers.h). */
pspec_status ps_device_list(ps_device_limits **limits, size_t *num_devices,
                            ps_error *error) PS_MUST_CHECK;

bool ps_device_is_pocl(const ps_device_limits *limits);
/* Whether it is a simulator such as Oclgrind, which calls itself a GPU and is for looking at
 * kernels. */
bool ps_device_is_simulator(const ps_device_limits *limits);

/* Index of the device that selector means: an index, "cpu", "gpu", "accelerator" or a part of a
 * name (case does not matter); NULL or "" is the first GPU, else the first CPU, else the first.
 * Simulators come after all others of their kind, and are the default only where there is nothing
 * else. Of several devices (device/choice.h) it is the first. */
pspec_status ps_device_choose(const ps_device_limits *limits, size_t num_devices,
                              const char *selector, size_t *index, ps_error *error) PS_MUST_CHECK;

/* ---- an open device ------------------------------------------------------------------------ */

typedef struct ps_device ps_device;

pspec_status ps_device_open(ps_device **out, const char *selector, bool with_profile,
                            ps_error *error) PS_MUST_CHECK;
void ps_device_close(ps_device *device);
const ps_device_limits *ps_device_get_limits(const ps_device *device); /* NULL: of NULL */
/* What answers call it from now on: all devices that share their work. */
void ps_device_set_name(ps_device *device, const char *name);
/* What the planner is to know of the device from now on; copied. */
pspec_status ps_device_set_figures(ps_device *device, const ps_figures *figures,
                                   ps_error *error) PS_MUST_CHECK;
/* Waits until everything enqueued is done; failures of earlier commands show here. */
pspec_status ps_device_finish(ps_device *device, ps_error *error) PS_MUST_CHECK;

/* Turns an OpenCL code into a status: no memory -> PSPEC_ERROR_MEMORY (smaller batches may help),
 * everything else -> PSPEC_ERROR_DEVICE. */
pspec_status ps_device_fail(cl_int code, const char *call, ps_error *error);

/* ---- buffers --------------------------------------------------------------------------------- */

/* Memory of the host that stays where it is, so that the device copies from it and to it by itself;
 * {0}: none. */
typedef struct ps_pinned {
    cl_mem memory;
    void *data;
} ps_pinned;

typedef struct ps_buffer {
    cl_mem memory;
    size_t bytes;
    ps_device *device; /* whose memory it is */
    ps_pinned twin;    /* see ps_buffer_add_twin */
} ps_buffer;

/* A buffer of which the host has the memory; {0}: none. */
typedef struct ps_mapping {
    ps_buffer buffer;
    void *data;
    cl_event is_ready; /* NULL: it is */
    uint64_t begun;    /* what the device had been given by then */
} ps_mapping;

/* Pinned memory that writes go through where the device has memory of its own, in pieces that are
 * used in turns: large enough that copying a piece takes longer than asking for it, and as many as
 * the small writes of two batches fill. */
enum {
    PS_STAGED_PIECE = 1 << 20,
    PS_STAGED_PIECES = 4,
    PS_STAGED_BYTES = PS_STAGED_PIECES * PS_STAGED_PIECE
};

/* Reads of one kind, of which two may go on while the host does something else; {0}: none. */
enum { PS_READINGS = 2 };
typedef struct ps_readings {
    ps_device *device;
    ps_pinned memory[PS_READINGS];
    cl_event is_done[PS_READINGS];
    uint64_t begun[PS_READINGS];
    uint64_t num_begun, num_taken;
} ps_readings;

/* At least one byte is allocated. Larger than the device allows: PSPEC_ERROR_MEMORY, not tried. */
pspec_status ps_buffer_create(ps_device *device, ps_buffer *out, size_t bytes, const char *what,
                              ps_error *error) PS_MUST_CHECK;
/* For a buffer that ps_mapping_begin will be asked for: where the device has memory of its own, it
 * gets pinned memory of the host as its twin. */
pspec_status ps_buffer_add_twin(ps_device *device, ps_buffer *buffer, const char *what,
                                ps_error *error) PS_MUST_CHECK;
void ps_buffer_release(ps_buffer *buffer); /* {0} is allowed */

/* Several at once: what is wanted of each, and those that go. */
typedef struct ps_wanted_buffer {
    ps_buffer *buffer;
    size_t bytes;
    const char *what;
} ps_wanted_buffer;
pspec_status ps_buffers_create(ps_device *device, const ps_wanted_buffer *wanted, size_t num,
                               ps_error *error) PS_MUST_CHECK;
#define PS_BUFFERS_CREATE(device, wanted, error)                                                   \
    ps_buffers_create(device, wanted, sizeof(wanted) / sizeof(wanted)[0], error)
void ps_buffers_release(ps_buffer *const *buffers, size_t num);
#define PS_BUFFERS_RELEASE(...)                                                                    \
    ps_buffers_release((ps_buffer *const[]){__VA_ARGS__},                                          \
                       sizeof((ps_buffer *const[]){__VA_ARGS__}) / sizeof(ps_buffer *))
/* A buffer with these bytes. */
pspec_status ps_buffer_upload(ps_device *device, ps_buffer *out, const void *data, size_t bytes,
                              const char *what, ps_error *error) PS_MUST_CHECK;
/* The same of data that are only read, and stay where they are until the buffer is released: where
 * host and device share memory they are the buffer, and nothing is copied. */
pspec_status ps_buffer_share(ps_device *device, ps_buffer *out, const void *data, size_t bytes,
                             const char *what, ps_error *error) PS_MUST_CHECK;
/* The host memory may be used again at once. Where the device has memory of its own, data are
 * copied to pinned memory first, and nobody waits for the device. */
pspec_status ps_buffer_write(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                             const void *data, size_t bytes, ps_error *error) PS_MUST_CHECK;
/* Waits until everything enqueued before is done, and for the data. */
pspec_status ps_buffer_read(ps_device *device, const ps_buffer *buffer, size_t offset_bytes,
                            void *data, size_t bytes, ps_error *error) PS_MUST_CHECK;
/* Reads that are waited for later. Memory for two of so many bytes at most. */
pspec_status ps_readings_create(ps_device *device, ps_readings *out, size_t bytes, const char *what,
                                ps_error *error) PS_MUST_CHECK;
/* The first bytes of the buffer, as they are once everything enqueued before is done. No more than
 * two at a time: one takes the place of the last but one, which was taken or is forgotten. */
pspec_status ps_readings_begin(ps_readings *readings, const ps_buffer *buffer, size_t bytes,
                               ps_error *error) PS_MUST_CHECK;
/* Waits for the earliest that was not taken; *data stays until the next but one begins. */
pspec_status ps_readings_take(ps_readings *readings, const void **data,
                              ps_error *error) PS_MUST_CHECK;
void ps_readings_forget(ps_readings *readings);  /* what was not taken */
void ps_readings_release(ps_readings *readings); /* waits; {0} is allowed */
/* The buffer's memory for the host to fill; what was in it is lost. Waits until everything enqueued
 * is done that was enqueued before `begin`, so that filling one buffer goes on while the device
 * reads another: begin, launch, wait, fill, end. Launches after the end find the first `bytes`
 * bytes. Of a buffer with a twin, that is what the host fills: it is copied by a second queue,
 * while what was launched before goes on. */
pspec_status ps_mapping_begin(ps_device *device, ps_mapping *out, const ps_buffer *buffer,
                              ps_error *error) PS_MUST_CHECK;
pspec_status ps_mapping_wait(ps_mapping *mapping, ps_error *error) PS_MUST_CHECK;
pspec_status ps_mapping_end(ps_device *device, ps_mapping *mapping, size_t bytes,
                            ps_error *error) PS_MUST_CHECK;
/* The same before the buffer is released, when nobody asks for what is in it. */
void ps_mapping_abandon(ps_device *device, ps_mapping *mapping);
pspec_status ps_buffer_clear(ps_device *device, const ps_buffer *buffer,
                             ps_error *error) PS_MUST_CHECK;

/* Rows of bytes that stand `pitch` bytes apart. */
typedef struct ps_rectangle {
    size_t row_bytes, num_rows;
    size_t from_offset, from_pitch, to_offset, to_pitch;
} ps_rectangle;

/* Between two buffers of the device, after everything enqueued before. */
pspec_status ps_buffer_copy_rectangle(ps_device *device, const ps_buffer *source,
                                      const ps_buffer *target, const ps_rectangle *rectangle,
                                      ps_error *error) PS_MUST_CHECK;

/* The most bytes that buffers of the device have had at a time. */
uint64_t ps_device_most_buffer_bytes(const ps_device *device);

/* How often the host waited for the device, which had nothing else to do afterwards. */
uint64_t ps_device_num_waits(const ps_device *device);

/* Whether host and device are taken to have one memory, if they do. For tests: results do not
 * depend on it. */
void ps_device_set_unified_memory(ps_device *device, bool is_wanted);

/* Whether local memory is taken to be of its own, as GPUs have it, even where it is not. For tests:
 * results stay within their bounds, with the work-groups and variants of GPUs. */
void ps_device_set_dedicated_local_memory(ps_device *device, bool is_wanted);

/* The largest allocation from now on, at most what the device allows; 0 restores that. For tests,
 * too: results do not depend on it. */
void ps_device_set_max_allocation(ps_device *device, uint64_t bytes);

/* The local memory from now on, at most what the device has; 0 restores that. For tests: what is
 * planned with less runs with less. */
void ps_device_set_local_bytes(ps_device *device, uint64_t bytes);

/* The native vectors of both precisions from now on; 0 restores those of the device. For tests: the
 * kernels of other CPUs. */
void ps_device_set_native_lanes(ps_device *device, unsigned lanes);

/* The matrix units that kernels are to use from now on. For tests: they are not tried. */
void ps_device_set_units(ps_device *device, ps_units units);
/* Whether they build and multiply known numbers right, in every precision of the device. */
bool ps_units_are_right(ps_device *device, ps_units units);

/* ---- programs and kernels -------------------------------------------------------------------- */

/* What a kernel is compiled with, "-DPRECISION=32 -DLANES=16": nothing to be freed. What does not fit
 * is refused by ps_kernel_get. */
enum { PS_DEFINES_BYTES = 384 };
typedef struct ps_defines {
    char text[PS_DEFINES_BYTES];
} ps_defines;

/* Precision is that of numbers of so many bytes; lanes 0: not said. */
ps_defines ps_defines_of(size_t real_bytes, unsigned lanes);
/* "-DROOT=%d"; a blank comes between. */
void ps_defines_add(ps_defines *defines, const char *format, ...) PS_PRINTF(2, 3);

/* A kernel, which belongs to the device as its program does: both stay until it is closed. */
typedef struct ps_kernel ps_kernel;

/* The kernel `name` of source file `source` (below kernels/), built with the options given
 * (ps_defines). A program is built once per (source, options), and asking again gives the same
 * kernel: arguments are those of a launch. A failed build puts the log into the message. GPUs have
 * threads that build while the host goes on: ps_device_build waits, or the first launch, and it is
 * then that a failure is told. */
pspec_status ps_kernel_get(ps_device *device, ps_kernel **out, const char *source, const char *name,
                           const char *options, ps_error *error) PS_MUST_CHECK;

/* Waits until all kernels that were asked for can be launched; the first that cannot, in the order
 * of asking, is the error. It is built again when it is asked for again, or launched. */
pspec_status ps_device_build(ps_device *device, ps_error *error) PS_MUST_CHECK;

/* At most so many threads build from now on; 0: who asks for a kernel builds it, as on CPUs, since
 * PoCL builds one program at a time. For tests: kernels do not depend on it. */
void ps_device_set_builders(ps_device *device, unsigned most);

/* ---- launches -------------------------------------------------------------------------------- */

typedef struct ps_argument {
    size_t bytes;
    const void *value; /* NULL: bytes of local memory */
} ps_argument;

#define PS_BUFFER(buffer) ((ps_argument){sizeof(cl_mem), &(buffer).memory})
#define PS_U32(x) ((ps_argument){sizeof(cl_uint), &(cl_uint){(cl_uint)(x)}})
#define PS_U64(x) ((ps_argument){sizeof(cl_ulong), &(cl_ulong){(cl_ulong)(x)}})
/* A struct that kernels/ declares for both sides (kernels/shared/fixed.h). */
#define PS_STRUCT(object) ((ps_argument){sizeof(object), &(object)})
#define PS_LOCAL(num_bytes) ((ps_argument){(num_bytes), NULL})

/* What one launch covers, and the work it counts as in the profile. */
typedef struct ps_range {
    unsigned rank;
    size_t offset[3]; /* of the first work-item */
    size_t global[3];
    size_t local[3];     /* all 0: the driver chooses */
    double flops, bytes; /* arithmetic done and memory touched at least once */
} ps_range;

/* Ranges with the work-groups that suit the device: heavy for work-items that run thousands of
 * operations (one per work-group on CPUs, where a work-group runs on one thread), light for short
 * ones. The first extent is rounded up to whole work-groups: kernels check it. */
ps_range ps_range_heavy(const ps_device *device, size_t first, size_t second, size_t third,
                        double flops, double bytes);
ps_range ps_range_light(const ps_device *device, size_t first, size_t second, size_t third,
                        double flops, double bytes);
/* Whether heavy ranges with a first extent of 1 have work-groups of one item: their kernels may be
 * compiled with -DALONE=1 (kernels/shared/group.h) then, and launched on ps_range_alone, whatever
 * changes in between. */
bool ps_range_is_alone(const ps_device *device);
ps_range ps_range_alone(size_t second, double flops);
/* Work-groups of `wanted` items, or as many as there may be, which share local memory: (1, second,
 * third) of them. Their kernels serve any number of items. */
ps_range ps_range_shared(const ps_device *device, size_t wanted, size_t second, size_t third,
                         double flops, double bytes);
/* Work-items in a light work-group, and in a heavy one on devices with local memory of their own; 0
 * restores the default. Results do not depend on it (that is what the tests use it for). */
void ps_device_set_group_size(ps_device *device, size_t group_size);

/* Checks the number of arguments, the work-group size and local memory against kernel and device,
 * then launches. A range with a zero extent does nothing. */
pspec_status ps_launch_arguments(ps_device *device, ps_kernel *kernel, const ps_range *range,
                                 const ps_argument *arguments, size_t num_arguments,
                                 ps_error *error) PS_MUST_CHECK;
#define PS_LAUNCH(device, kernel, range, error, ...)                                               \
    ps_launch_arguments((device), (kernel), (range), (const ps_argument[]){__VA_ARGS__},           \
                        sizeof((const ps_argument[]){__VA_ARGS__}) / sizeof(ps_argument), (error))

/* Arithmetic of everything launched so far, as its ranges count it. */
double ps_device_launched_flops(const ps_device *device);

/* ---- profile --------------------------------------------------------------------------------- */

typedef struct ps_profile_row {
    char kernel[64];
    uint64_t launches;
    double seconds, flops, bytes;
} ps_profile_row;

/* Rows in the order in which kernels first ran; empty without profile. Borrowed. */
const ps_profile_row *ps_device_profile(const ps_device *device, size_t *num_rows);

#endif
