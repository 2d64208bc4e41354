/* The text of a file of figures (store/figures_file.h): lines of "key value", the last of which is
 * a checksum. */
#ifndef PS_STORE_FIGURES_TEXT_H
#define PS_STORE_FIGURES_TEXT_H

#include "base/text.h"
#include "device/device.h"

/* Appends the lines that name a device and its driver. */
void ps_figures_append_device(ps_text *text, const ps_device_limits *limits);
/* Appends the text of a file; figures->note is not in it. */
pspec_status ps_figures_format(ps_text *text, const ps_figures *figures,
                               const ps_device_limits *limits, ps_error *error) PS_MUST_CHECK;
/* PSPEC_ERROR_INPUT with the reason when the text is not one of this device; *figures is then
 * without figures. */
pspec_status ps_figures_parse(ps_figures *figures, const char *text, size_t length,
                              const ps_device_limits *limits, ps_error *error) PS_MUST_CHECK;
/* Appends the last line of a file. */
void ps_figures_add_checksum(ps_text *text);

#endif
