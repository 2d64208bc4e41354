/* Inside of ps_device, for the files of host/device only. */
#ifndef PS_DEVICE_DEVICE_PRIVATE_H
#define PS_DEVICE_DEVICE_PRIVATE_H

#include "base/text.h"
#include "base/workers.h"
#include "device/device.h"

#include <glob.h>
#include <pthread.h>

/* cl_ext.h: the loader's answer when no driver is installed. */
enum { PS_CL_PLATFORM_NOT_FOUND = -1001 };

typedef enum ps_program_state {
    PS_PROGRAM_IDLE = 0, /* not built, nor to be, until somebody asks again */
    PS_PROGRAM_WANTED,
    PS_PROGRAM_BEGUN,
    PS_PROGRAM_BUILT,
    PS_PROGRAM_FAILED /* which nobody was told yet */
} ps_program_state;

typedef struct ps_program {
    struct ps_program *next; /* as state, under the mutex of the builders */
    ps_program_state state;
    cl_int code;             /* of clBuildProgram */
    ps_text source, options; /* options: all that it is built with */
    cl_program object;
} ps_program;

/* Threads that build what is wanted, in the order in which it was asked for. */
typedef struct ps_builders {
    pthread_mutex_t mutex;
    pthread_cond_t has_changed; /* the state of a program, or is_over */
    pthread_t threads[PS_WORKERS_MOST];
    unsigned num, most;
    bool is_over;
} ps_builders;

struct ps_kernel {
    ps_kernel *next;
    ps_program *program;
    char name[64];    /* as long as profiles have them */
    cl_kernel object; /* NULL: its program was not waited for yet */
};

/* Local memory of its own that a driver may count beside what kernels ask for: 4 bytes by NVIDIA's
 * 580 (H100). Limits leave it out. */
enum { PS_DRIVERS_LOCAL_BYTES = 64 };

/* Memory of large_memory.c. */
typedef struct ps_large_pool ps_large_pool;

enum { PS_PROFILE_ROWS = 64 }; /* more kernels than the product has; further ones are not counted */

struct ps_device {
    ps_device_limits limits;
    uint64_t own_max_allocation; /* see ps_device_set_max_allocation */
    uint64_t own_local_bytes;    /* see ps_device_set_local_bytes */
    unsigned own_float_lanes;    /* see ps_device_set_native_lanes */
    unsigned own_double_lanes;
    bool own_unified_memory;         /* see ps_device_set_unified_memory */
    bool own_dedicated_local_memory; /* see ps_device_set_dedicated_local_memory */
    cl_device_id id;
    bool is_share; /* a sub-device, which is released */
    cl_context context;
    cl_command_queue queue;
    cl_command_queue uploads; /* of twins; NULL: there are none, or the kind has one queue */
    ps_pinned staged;         /* [PS_STAGED_BYTES] from the first write on */
    cl_event staged_until[PS_STAGED_PIECES]; /* the last write from a piece; NULL: none */
    size_t staged_at;                        /* where the next write goes */
    uint64_t num_enqueued; /* launches and reads, by which a wait knows whether there were more */
    uint64_t num_waits;    /* see ps_device_num_waits */
    ps_program *programs;  /* in the order in which they were asked for */
    ps_kernel *kernels;
    ps_builders builders;
    glob_t kept;         /* kernels that PoCL kept before (drivers.h); none for other drivers */
    size_t group_size;   /* see ps_device_set_group_size; 0: default */
    ps_figures *figures; /* that limits.figures points to, or NULL */
    double launched_flops;
    ps_large_pool *large;                     /* NULL: none yet */
    uint64_t buffer_bytes, most_buffer_bytes; /* of all buffers, now and at most */
    bool has_profile;
    ps_profile_row profile[PS_PROFILE_ROWS];
    size_t num_profile_rows;
};

/* Of a kernel that was asked for; waits until its program is built. */
pspec_status ps_kernel_object(ps_device *device, ps_kernel *kernel, cl_kernel *out,
                              ps_error *error) PS_MUST_CHECK;
void ps_programs_release(ps_device *device);

void ps_builders_create(ps_builders *builders);
/* Ends the threads after what they are building. */
void ps_builders_end(ps_device *device);
/* Lets a thread build it, unless it is built; false: there are to be none. */
bool ps_builders_begin(ps_device *device, ps_program *program);
/* Whether it is wanted or was built. */
bool ps_builders_has(ps_device *device, const ps_program *program);
/* Builds it, or waits for who does: the code of clBuildProgram. */
cl_int ps_builders_wait(ps_device *device, ps_program *program);

/* A queue of the device, as ps_device_open makes it. */
pspec_status ps_queue_create(const ps_device *device, cl_command_queue *out,
                             ps_error *error) PS_MUST_CHECK;

pspec_status ps_pinned_create(ps_device *device, ps_pinned *out, size_t bytes, const char *what,
                              ps_error *error) PS_MUST_CHECK;
void ps_staged_release(ps_device *device);

/* What double precision costs on a device of NVIDIA with this compute capability, by their table of
 * arithmetic throughput: cards for data centres have half as many units for it as for single, all
 * others 1/64 or 1/32 of them; and whether it may have mma.sync for fp16 and double precision. */
void ps_units_of_capability(ps_device_limits *limits, unsigned major, unsigned minor);

/* Adds one finished launch to the profile and releases the event. */
pspec_status ps_profile_add(ps_device *device, const char *kernel, const ps_range *range,
                            cl_event event, ps_error *error) PS_MUST_CHECK;

#define PS_TRY_CL(call, error)                                                                     \
    do {                                                                                           \
        const cl_int ps_cl_code = (call);                                                          \
        if (ps_cl_code != CL_SUCCESS) {                                                            \
            return ps_device_fail(ps_cl_code, #call, (error));                                     \
        }                                                                                          \
    } while (0)

/* large_memory.c: an object in memory of large pages where host and device share it; NULL: take
 * what the driver has. */
cl_mem ps_large_memory_create(ps_device *device, size_t bytes);
/* When the device is closed; NULL is allowed. What objects still have goes with them. */
void ps_large_pool_leave(ps_large_pool *pool);

#endif
