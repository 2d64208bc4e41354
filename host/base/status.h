/* Errors as values: a status code and one sentence that names what, where, which value, which
 * limit.
 *
 * Every function that can fail returns pspec_status and takes a ps_error as its last parameter; the
 * sentence is written there, by ps_fail and by nothing else (one place for a breakpoint).
 */
#ifndef PS_BASE_STATUS_H
#define PS_BASE_STATUS_H

#include "pointspec/pointspec.h"

/* Long enough for a sentence and the first lines of a kernel build log. */
enum { PS_MESSAGE_BYTES = 4096 };

typedef struct ps_error {
    pspec_status status;
    char message[PS_MESSAGE_BYTES];
} ps_error;

#if defined(__GNUC__)
#define PS_PRINTF(format_index, first_argument)                                                    \
    __attribute__((format(printf, format_index, first_argument)))
#define PS_MUST_CHECK __attribute__((warn_unused_result))
#else
#define PS_PRINTF(format_index, first_argument)
#define PS_MUST_CHECK
#endif

/* Records status and sentence in *error (which may be NULL) and returns status. */
pspec_status ps_fail(ps_error *error, pspec_status status, const char *format, ...) PS_PRINTF(3, 4);

/* Returns from the calling function when call fails. */
#define PS_TRY(call)                                                                               \
    do {                                                                                           \
        const pspec_status ps_try_status = (call);                                                 \
        if (ps_try_status != PSPEC_OK) {                                                           \
            return ps_try_status;                                                                  \
        }                                                                                          \
    } while (0)

/* Jumps to the label "out" with status set when call fails: for functions that own resources. */
#define PS_TRY_OUT(status, call)                                                                   \
    do {                                                                                           \
        (status) = (call);                                                                         \
        if ((status) != PSPEC_OK) {                                                                \
            goto out;                                                                              \
        }                                                                                          \
    } while (0)

#endif
