/* Faults on demand in the program built for tests: the linker sends the calls of our own code to
 * the wrappers of this folder (--wrap), which ask here whether this is the call that has to fail,
 * and tell here what was taken and given back. Calls inside libraries are not touched. */
#ifndef PS_TESTS_FAULTS_H
#define PS_TESTS_FAULTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum fault_class { FAULT_MEMORY, FAULT_FILE, FAULT_OPENCL, NUM_FAULT_CLASSES } fault_class;

/* Counts one call and tells whether it must fail. POINTSPEC_FAULT=CLASS:N asks for the N-th of a
 * class, CLASS:N+ for all from the N-th on. name is what the report says. Calls of the classes
 * memory and file that follow one another from the same place of the program (a loop that prints
 * characters) have one number, and the first of them fails. */
bool fault_is_due(fault_class kind, const char *name);

/* Like it for calls without which nothing can be told or tidied up any more: they can fail alone,
 * but N+ spares them. */
bool fault_is_due_alone(fault_class kind, const char *name);

/* Something was taken by the function of that name, and must be lost before main returns. NULL is
 * nothing. */
void fault_gain(const void *thing, const char *by);
void fault_lose(const void *thing);

/* A number of the environment; 0: there is none (wrap_sizes.c). */
uint64_t fault_size(const char *variable);

/* A descriptor as a thing: no object has such a small address. */
static inline const void *fault_descriptor(int descriptor) {
    return descriptor >= 0 ? (const void *)((uintptr_t)descriptor + 1) : NULL;
}

/* The linker reads its list of symbols from the lines of this folder that begin with a macro in
 * capitals: the first parameter is the symbol. WRAPPER begins the definition of one. */
#define WRAPPER(name, type, parameters)                                                            \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters

#endif
