/* What the module of MPI can do, for who loads it: no other source knows MPI. */
#ifndef PS_RANKS_MODULE_MPI_CALLS_H
#define PS_RANKS_MODULE_MPI_CALLS_H

#include <stddef.h>

/* Changes with every change below: a module that was left behind is told from this one. */
enum { PS_MPI_CALLS_VERSION = 1 };

typedef enum ps_mpi_tag { PS_MPI_DONE = 1, PS_MPI_FAILED, PS_MPI_BYTES, PS_MPI_VERDICT } ps_mpi_tag;

/* Calls that return an int return 0, or another number where MPI has failed. They wait asleep: a
 * rank without work leaves its processor to the others. */
typedef struct ps_mpi_calls {
    int version;
    int (*begin)(int *rank, int *num);
    /* The bytes may be used again when it returns. */
    int (*send)(int to, ps_mpi_tag tag, const void *bytes, size_t num);
    /* The same without waiting: the bytes are used until `settle` of *pending. */
    int (*post)(int to, ps_mpi_tag tag, const void *bytes, size_t num, void **pending);
    int (*settle)(void **pending);
    int (*receive)(int from, ps_mpi_tag tag, void *bytes, size_t num);
    /* Waits for a message of one of the tags, from any rank. */
    int (*wait)(const ps_mpi_tag *tags, size_t num_tags, int *from, ps_mpi_tag *tag);
    /* Is there one of the tag? Does not wait. */
    int (*is_there)(ps_mpi_tag tag);
    void (*end)(void);
} ps_mpi_calls;

#define PS_MPI_MODULE "libpointspec_mpi.so"
#define PS_MPI_SYMBOL "ps_mpi_module"

#endif
