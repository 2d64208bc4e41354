/* Measured figures of a device, or of this host, kept as a table in an entry of a cache in
 * FOLDER/devices (store/result_cache.h), which is found by device, driver and version of pointspec.
 *
 * What is no whole table of figures is as good as none: then the planner has the built-in figures,
 * and the note says why. Numbers outside of what a device can be are not taken either, so that no
 * file makes times that are not above 0.
 */
#ifndef PS_STORE_FIGURES_FILE_H
#define PS_STORE_FIGURES_FILE_H

#include "base/text.h"
#include "device/device.h"
#include "fields/table.h"

/* What the figures of this host are found by: the name of its processors, "unknown" where the system
 * does not say, and their number. */
void ps_host_describe(ps_device_limits *out);

/* Appends the path of the file of a device in the cache's folder. */
pspec_status ps_figures_path(ps_text *path, const char *folder, const ps_device_limits *limits,
                             ps_error *error) PS_MUST_CHECK;

/* Makes the folder of the files, unless it is there. */
pspec_status ps_figures_make_folder(const char *folder, ps_error *error) PS_MUST_CHECK;
/* That, too; the file is there whole, or as it was. */
pspec_status ps_figures_write(const char *folder, const ps_figures *figures,
                              const ps_device_limits *limits, ps_error *error) PS_MUST_CHECK;
/* The figures of such a table, without a note; PSPEC_ERROR_INPUT, and none, where one cannot
 * be. */
pspec_status ps_figures_take(ps_figures *figures, const ps_table *table,
                             ps_error *error) PS_MUST_CHECK;
/* A file that is absent or not to be used gives the built-in figures with a note, no error: that is
 * only for memory. folder NULL: built-in. */
pspec_status ps_figures_read(ps_figures *figures, const char *folder,
                             const ps_device_limits *limits, ps_error *error) PS_MUST_CHECK;

/* ps_device_open, and the device's figures from the folder. */
pspec_status ps_figures_open_device(ps_device **out, const char *selector, bool with_profile,
                                    const char *folder, ps_error *error) PS_MUST_CHECK;

#endif
