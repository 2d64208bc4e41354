/* Answers on all devices that a request names: `--device 0,1`, `gpu:all`, `cpu:split=2`.
 * Realizations are shared in parts (answers/parts/parts.h), and the answer is that of one device,
 * to the bit. What is not shared is done by the first device, which a warning says. */
#ifndef PS_ANSWERS_DEVICES_DEVICES_WORK_H
#define PS_ANSWERS_DEVICES_DEVICES_WORK_H

#include "answers/kind.h"

/* A selector of those devices of `selector` that rank `own` of num of one machine has (num 0:
 * nobody knows): every num-th, or the one that comes round where there are fewer. */
pspec_status ps_devices_of_rank(ps_text *out, const char *selector, size_t own, size_t num,
                                ps_error *error) PS_MUST_CHECK;

/* ps_answer_make and ps_answer_produce; of a request that names one device they do nothing else.
 * Devices of different kinds, which have other bits, are PSPEC_ERROR_INVALID_ARGUMENT unless the
 * request allows them (limits.mixed). hooks->device, if there is one, is the first. */
pspec_status ps_devices_make(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;
pspec_status ps_devices_produce(ps_answer *out, const ps_kind *kind, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error) PS_MUST_CHECK;

#endif
