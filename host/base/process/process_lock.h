/* The one thing of the library that can change and that no object owns: a mutex, for what the
 * process has once. PoCL initialises its devices without a lock, so looking for devices, opening
 * and closing them go under it; GSL has one error handler, which math/gsl/fence.h switches.
 */
#ifndef PS_BASE_PROCESS_PROCESS_LOCK_H
#define PS_BASE_PROCESS_PROCESS_LOCK_H

/* What may be looked at and changed by who has the lock. */
typedef struct ps_process {
    unsigned num_in_gsl;              /* calls under way that want GSL's handler off */
    void (*former_gsl_handler)(void); /* to be put back after the last of them */
} ps_process;

/* Waits for the lock. Not recursive: nothing that takes it is called before it is given back. */
ps_process *ps_process_lock(void);
void ps_process_unlock(void);

#endif
