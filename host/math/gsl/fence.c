#include "math/gsl/fence.h"

#include "base/process/process_lock.h"

#include <gsl/gsl_errno.h>

typedef void (*any_function)(void);

void ps_gsl_enter(void) {
    ps_process *const process = ps_process_lock();
    if (process->num_in_gsl++ == 0) {
        process->former_gsl_handler = (any_function)gsl_set_error_handler_off();
    }
    ps_process_unlock();
}

void ps_gsl_leave(void) {
    ps_process *const process = ps_process_lock();
    if (--process->num_in_gsl == 0) {
        gsl_set_error_handler((gsl_error_handler_t *)process->former_gsl_handler);
    }
    ps_process_unlock();
}
