/* Where kernel text comes from: POINTSPEC_KERNEL_DIR when set, else the table made at build
 * time. */
#ifndef PS_DEVICE_KERNEL_SOURCE_H
#define PS_DEVICE_KERNEL_SOURCE_H

#include "base/status.h"
#include "base/text.h"

typedef struct ps_kernel_source {
    const char *name; /* path below kernels/, for example "torus/list.cl" */
    const char *text;
} ps_kernel_source;

/* Ended by name == NULL. */
extern const ps_kernel_source ps_kernel_sources[];

/* Appends the text of name to *out with every #include "..." replaced by that file's text, once
 * each, and #line marks so that build logs name file and line. */
pspec_status ps_kernel_source_expand(const char *name, ps_text *out, ps_error *error) PS_MUST_CHECK;

#endif
