/* Measured figures of this host in a file of their own beside those of its devices, by the name of
 * its processors. */
#ifndef PS_STORE_HOST_FIGURES_H
#define PS_STORE_HOST_FIGURES_H

#include "store/figures_file.h"

/* What the file of this host is found by: the processors' name and number. */
void ps_host_describe(ps_device_limits *out);

/* As ps_figures_read: a file that is absent or not to be used gives the built-in figures with a
 * note. */
pspec_status ps_host_figures_read(ps_figures *figures, const char *folder,
                                  ps_error *error) PS_MUST_CHECK;
pspec_status ps_host_figures_write(const char *folder, const ps_figures *figures,
                                   ps_error *error) PS_MUST_CHECK;

#endif
