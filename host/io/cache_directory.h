/* The folder in which pointspec keeps what it can make again. */
#ifndef PS_IO_CACHE_DIRECTORY_H
#define PS_IO_CACHE_DIRECTORY_H

#include "base/text.h"

/* Appends POINTSPEC_CACHE_DIR, else XDG_CACHE_HOME/pointspec, else HOME/.cache/pointspec. Variables that are empty count as
 * not set, and so does an XDG_CACHE_HOME that is no absolute path. */
pspec_status ps_cache_default_directory(ps_text *out, ps_error *error) PS_MUST_CHECK;

/* Makes the folder, and those above it, unless it is there. */
pspec_status ps_cache_folder_make(const char *path, ps_error *error) PS_MUST_CHECK;

#endif
