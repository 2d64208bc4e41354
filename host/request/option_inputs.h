/* Rows of the option table whose values name files that are read: where the name stands. */
#ifndef PS_REQUEST_OPTION_INPUTS_H
#define PS_REQUEST_OPTION_INPUTS_H

#include "request/options.h"

/* The value itself; that of --weights where it is a file; that of "NAME:file=PATH". */
ps_option_input ps_input_all, ps_input_of_weights, ps_input_of_named;

#endif
