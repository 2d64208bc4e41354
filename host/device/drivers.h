/* The drivers that the OpenCL loader is told of, and why none of them has a device. Looks at files,
 * limits and variables of the environment, as the loader and PoCL do; it asks no driver.
 */
#ifndef PS_DEVICE_DRIVERS_H
#define PS_DEVICE_DRIVERS_H

#include "base/text.h"

#include <glob.h>
#include <stdbool.h>
#include <stddef.h>

enum { PS_MOST_DRIVERS = 32 };

/* One file *.icd, or the library that OCL_ICD_VENDORS names itself. */
typedef struct ps_driver {
    char *file;    /* that names the library */
    char *library; /* NULL: the file cannot be read */
    char *problem; /* a sentence; NULL: the library loads */
} ps_driver;

typedef struct ps_drivers {
    char *place;          /* the folder or file where drivers are listed */
    const char *variable; /* that names the place; NULL: the system's own */
    char *problem;        /* why the place cannot be read; NULL: it can be */
    bool is_missing;      /* there is no such place */
    size_t num;
    ps_driver drivers[PS_MOST_DRIVERS];
} ps_drivers;

/* Looks for drivers, loading the library of each. To be freed also after an error, which is only
 * for memory. */
pspec_status ps_drivers_look(ps_drivers *out, ps_error *error) PS_MUST_CHECK;
void ps_drivers_free(ps_drivers *drivers);

/* Why there is no device, as one sentence: no driver, a library that is missing, a variable, a
 * folder that cannot be written, too little address space. Always fails, with
 * PSPEC_ERROR_NO_DEVICE. */
pspec_status ps_drivers_fail(ps_error *error);

/* Drivers make threads and end the process when these cannot have their stacks: fails, as above,
 * when the limits of address space, data or stacks leave less than they take. */
pspec_status ps_drivers_check_room(ps_error *error) PS_MUST_CHECK;
/* The sentence for drivers that found no memory although the check before them passed: what a
 * driver takes differs from start to start. Always fails, with PSPEC_ERROR_NO_DEVICE where address
 * space is limited, which explains it, else as the call that failed. */
pspec_status ps_drivers_fail_memory(const char *call, ps_error *error);

/* Where PoCL keeps compiled kernels; empty where it chooses a folder itself. */
pspec_status ps_drivers_pocl_cache(ps_text *out, ps_error *error) PS_MUST_CHECK;
/* Why PoCL cannot keep kernels there, appended as a sentence without its end; nothing where it
 * can. */
void ps_drivers_pocl_cache_problem(const char *path, ps_text *out);

/* PoCL ends the process where the name of that folder is too long, where it cannot write, or where
 * the limits of files leave too little to compile: fails, as above, in its place. */
pspec_status ps_drivers_check_pocl(ps_error *error) PS_MUST_CHECK;

/* The folders of all kernels in it, for globfree; none where it cannot be read. */
pspec_status ps_kept_list(glob_t *out, ps_error *error) PS_MUST_CHECK;
/* PoCL ends the process, too, where a file of a kernel that it takes from there is cut or empty:
 * fails with PSPEC_ERROR_DEVICE where there is such a file, changed after PoCL put it there, of a
 * kernel of that name among these; NULL: of any. */
pspec_status ps_kept_check(const glob_t *kept, const char *kernel, ps_error *error) PS_MUST_CHECK;

#endif
