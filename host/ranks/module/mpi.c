/* The module of MPI: the only file that knows it, loaded by ranks.c. */
#include "ranks/module/mpi_calls.h"

#include <mpi.h>

#include <stdlib.h>
#include <time.h>

/* A message of MPI counts its bytes by an int. */
#define MOST_BYTES ((size_t)1 << 30)

/* Waits are for milliseconds to hours. */
static void rest(unsigned *times) {
    enum { SHORT_RESTS = 100 };
    const long nanoseconds = *times < SHORT_RESTS ? 50000 : 2000000;
    *times += *times < SHORT_RESTS;
    nanosleep(&(const struct timespec){0, nanoseconds}, NULL);
}

static int finish(MPI_Request *request) {
    int is_done = 0;
    unsigned times = 0;
    int status = MPI_Test(request, &is_done, MPI_STATUS_IGNORE);
    while (status == MPI_SUCCESS && !is_done) {
        rest(&times);
        status = MPI_Test(request, &is_done, MPI_STATUS_IGNORE);
    }
    return status;
}

static int begin(int *rank, int *num) {
    int provided = 0;
    const int status = MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
    return status != MPI_SUCCESS ? status
           : MPI_Comm_rank(MPI_COMM_WORLD, rank) != MPI_SUCCESS
               ? 1
               : MPI_Comm_size(MPI_COMM_WORLD, num);
}

static int send(int to, ps_mpi_tag tag, const void *bytes, size_t num) {
    const char *at = bytes;
    int status = MPI_SUCCESS;
    do {
        MPI_Request request;
        const size_t own = num < MOST_BYTES ? num : MOST_BYTES;
        status = MPI_Isend(at, (int)own, MPI_BYTE, to, (int)tag, MPI_COMM_WORLD, &request);
        status = status == MPI_SUCCESS ? finish(&request) : status;
        at += own;
        num -= own;
    } while (status == MPI_SUCCESS && num > 0);
    return status;
}

static int settle(void **pending) {
    MPI_Request *const request = *pending;
    const int status = request != NULL ? finish(request) : MPI_SUCCESS;
    free(request);
    *pending = NULL;
    return status;
}

static int post(int to, ps_mpi_tag tag, const void *bytes, size_t num, void **pending) {
    MPI_Request *const request = malloc(sizeof *request);
    *pending = request;
    if (request == NULL) {
        return 1;
    }
    *request = MPI_REQUEST_NULL;
    return MPI_Isend(bytes, (int)num, MPI_BYTE, to, (int)tag, MPI_COMM_WORLD, request);
}

static int receive(int from, ps_mpi_tag tag, void *bytes, size_t num) {
    char *at = bytes;
    int status = MPI_SUCCESS;
    do {
        MPI_Request request;
        const size_t own = num < MOST_BYTES ? num : MOST_BYTES;
        status = MPI_Irecv(at, (int)own, MPI_BYTE, from, (int)tag, MPI_COMM_WORLD, &request);
        status = status == MPI_SUCCESS ? finish(&request) : status;
        at += own;
        num -= own;
    } while (status == MPI_SUCCESS && num > 0);
    return status;
}

static int look(ps_mpi_tag tag, int *from, int *is_found) {
    MPI_Status found;
    const int status = MPI_Iprobe(MPI_ANY_SOURCE, (int)tag, MPI_COMM_WORLD, is_found, &found);
    if (status == MPI_SUCCESS && *is_found) {
        *from = found.MPI_SOURCE;
    }
    return status;
}

static int wait_for(const ps_mpi_tag *tags, size_t num_tags, int *from, ps_mpi_tag *tag) {
    unsigned times = 0;
    for (;;) {
        for (size_t i = 0; i < num_tags; i++) {
            int is_found = 0;
            const int status = look(tags[i], from, &is_found);
            if (status != MPI_SUCCESS || is_found) {
                *tag = tags[i];
                return status;
            }
        }
        rest(&times);
    }
}

static int is_there(ps_mpi_tag tag) {
    int from = 0;
    int is_found = 0;
    return look(tag, &from, &is_found) == MPI_SUCCESS && is_found;
}

/* MPI_Finalize waits for the others, and spins: they come together here first. */
static void end(void) {
    MPI_Request request;
    if (MPI_Ibarrier(MPI_COMM_WORLD, &request) == MPI_SUCCESS) {
        (void)finish(&request);
    }
    (void)MPI_Finalize();
}

extern const ps_mpi_calls ps_mpi_module;
__attribute__((visibility("default"))) const ps_mpi_calls ps_mpi_module = {
    PS_MPI_CALLS_VERSION, begin, send, post, settle, receive, wait_for, is_there, end};
