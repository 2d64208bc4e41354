#include "ranks/ranks.h"

#include "base/memory.h"
#include "base/text.h"
#include "ranks/module/mpi_calls.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What ranks hand in, and the verdict; bytes follow. */
typedef struct report {
    uint64_t num_bytes;
    ps_error error; /* status PSPEC_OK: without a sentence */
} report;

struct ps_ranks {
    const ps_mpi_calls *calls;
    int own, num;
    bool is_stopped;    /* this rank was told that another has failed */
    bool is_broken;     /* messages were lost: nobody waits for the others any more */
    bool has_concluded; /* rank 0 has given the verdict of this round, a failure */
    report verdict;     /* that one, and its way to every rank */
    void **pending;     /* [num] */
};

/* ---- the environment --------------------------------------------------------------------- */

/* -1: it says nothing. */
static long find_number(const char *const *names) {
    for (; *names != NULL; names++) {
        const char *const text = getenv(*names);
        char *end = NULL;
        const long number = text != NULL ? strtol(text, &end, 10) : -1;
        if (number >= 0 && end != text && *end == '\0') {
            return number;
        }
    }
    return -1;
}

/* Slurm's are set in jobs without MPI, too: they count beside those of PMI alone. */
static const char *const own_names[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", NULL};
static const char *const num_names[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS",
                                        NULL};

size_t ps_ranks_find_own(void) {
    const long own = find_number(own_names);
    return own > 0 ? (size_t)own : 0;
}

size_t ps_ranks_find_local(size_t *num) {
    static const char *const own[] = {"OMPI_COMM_WORLD_LOCAL_RANK", "MPI_LOCALRANKID",
                                      "SLURM_LOCALID", NULL};
    static const char *const all[] = {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", NULL};
    const long number = find_number(own);
    const long local = find_number(all);
    *num = local > 0 ? (size_t)local : 0;
    return number > 0 ? (size_t)number : 0;
}

/* ---- the module -------------------------------------------------------------------------- */

/* Plugins of Open MPI look for its symbols among the global ones. It stays until the process ends.
 */
static const ps_mpi_calls *load(const char *const *folders) {
    const ps_mpi_calls *calls = NULL;
    for (; *folders != NULL && calls == NULL; folders++) {
        ps_text path = {0};
        ps_text_append(&path, "%s/%s", *folders, PS_MPI_MODULE);
        void *const module = !path.failed && access(ps_text_string(&path), R_OK) == 0
                                 ? dlopen(ps_text_string(&path), RTLD_NOW | RTLD_GLOBAL)
                                 : NULL;
        calls = module != NULL ? dlsym(module, PS_MPI_SYMBOL) : NULL;
        ps_text_free(&path);
    }
    return calls != NULL && calls->version == PS_MPI_CALLS_VERSION ? calls : NULL;
}

static pspec_status begin(ps_ranks *self, long num, ps_error *error) {
    if (self->calls->begin(&self->own, &self->num) != 0) {
        return ps_fail(error, PSPEC_ERROR_IO, "MPI does not begin");
    }
    return self->num > 1 || num <= 1
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_IO,
                         "this is one of %ld processes, but the MPI of %s, which was built with "
                         "another, sees one: start them by its own mpirun",
                         num, PS_MPI_MODULE);
}

pspec_status ps_ranks_begin(ps_ranks **out, const ps_mpi_calls *calls, long num, ps_error *error) {
    ps_ranks *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "ranks", error));
    self->calls = calls;
    pspec_status status = begin(self, num, error);
    if (status == PSPEC_OK) {
        status = PS_NEW(&self->pending, (size_t)self->num, "ranks", error);
    }
    if (status != PSPEC_OK) {
        free(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

pspec_status ps_ranks_open(ps_ranks **out, const char *const *folders, ps_error *error) {
    const long own = find_number(own_names);
    const long num = find_number(num_names);
    *out = NULL;
    if (own < 0 || num <= 1) {
        return PSPEC_OK;
    }
    const ps_mpi_calls *const calls = load(folders);
    if (calls == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO,
                       "this is one of %ld processes, each of which would do the whole job: the "
                       "module %s is not beside the program, which is built with it where CMake "
                       "finds MPI (libopenmpi-dev)",
                       num, PS_MPI_MODULE);
    }
    return ps_ranks_begin(out, calls, num, error);
}

void ps_ranks_close(ps_ranks *self) {
    if (self == NULL) {
        return;
    }
    if (!self->is_broken) {
        self->calls->end();
    }
    free(self->pending);
    free(self);
}

size_t ps_ranks_num(const ps_ranks *self) {
    return self != NULL ? (size_t)self->num : 1;
}

size_t ps_ranks_own(const ps_ranks *self) {
    return self != NULL ? (size_t)self->own : 0;
}

/* ---- rounds ------------------------------------------------------------------------------ */

bool ps_ranks_must_stop(ps_ranks *self) {
    if (self == NULL) {
        return false;
    }
    self->is_stopped = self->is_stopped ||
                       self->calls->is_there(self->own == 0 ? PS_MPI_FAILED : PS_MPI_VERDICT) != 0;
    return self->is_stopped;
}

static pspec_status check(ps_ranks *self, int code, ps_error *error) {
    self->is_broken = self->is_broken || code != 0;
    return code == 0 ? PSPEC_OK : ps_fail(error, PSPEC_ERROR_IO, "a message of MPI failed");
}

/* Who has lost messages waits for no more of them: the end of the process ends the others. */
static pspec_status fail_broken(pspec_status status, ps_error *error) {
    return status != PSPEC_OK ? status
                              : ps_fail(error, PSPEC_ERROR_IO, "messages of MPI were lost");
}

static report make_report(pspec_status status, const ps_error *error, size_t num_bytes) {
    report out = {.num_bytes = status == PSPEC_OK ? num_bytes : 0};
    if (status != PSPEC_OK) {
        out.error = *error;
        out.error.status = status;
    }
    return out;
}

static pspec_status send(ps_ranks *self, int to, ps_mpi_tag tag, const report *head,
                         const void *bytes, ps_error *error) {
    PS_TRY(check(self, self->calls->send(to, tag, head, sizeof *head), error));
    return head->num_bytes == 0
               ? PSPEC_OK
               : check(self, self->calls->send(to, PS_MPI_BYTES, bytes, head->num_bytes), error);
}

/* Bytes of a verdict go down a tree, in log2 of the ranks: to those whose number has one bit more,
 * below all others of its own. */
static pspec_status forward(ps_ranks *self, const void *bytes, size_t num, ps_error *error) {
    int step = 1;
    while (step < self->num && (self->own & step) == 0) {
        step *= 2;
    }
    for (step /= 2; step > 0 && num > 0; step /= 2) {
        if (self->own + step < self->num) {
            PS_TRY(
                check(self, self->calls->send(self->own + step, PS_MPI_BYTES, bytes, num), error));
        }
    }
    return PSPEC_OK;
}

static pspec_status tell_all(ps_ranks *self, const report *verdict, const void *bytes,
                             ps_error *error) {
    for (int rank = 1; rank < self->num; rank++) {
        PS_TRY(
            check(self, self->calls->send(rank, PS_MPI_VERDICT, verdict, sizeof *verdict), error));
    }
    return forward(self, bytes, verdict->num_bytes, error);
}

static pspec_status take_bytes(ps_ranks *self, int from, size_t num, ps_rank_bytes *out,
                               ps_error *error) {
    char *data = NULL;
    self->is_broken = true; /* until they are here */
    PS_TRY(PS_NEW(&data, num, "the answers of ranks", error));
    self->is_broken = false;
    *out = (ps_rank_bytes){data, num};
    return check(self, self->calls->receive(from, PS_MPI_BYTES, data, num), error);
}

/* The first failure is the verdict, and ends the round for all ranks. */
static pspec_status fail(ps_ranks *self, int from, const ps_error *why, ps_error *error) {
    ps_error sentence = *why;
    if (from > 0) {
        ps_fail(&sentence, why->status, "rank %d: %.3900s", from, why->message);
    }
    *error = sentence;
    self->has_concluded = true;
    self->verdict = make_report(sentence.status, &sentence, 0);
    for (int rank = 1; rank < self->num; rank++) { /* who may be waiting to hand in bytes */
        PS_TRY(check(self,
                     self->calls->post(rank, PS_MPI_VERDICT, &self->verdict, sizeof self->verdict,
                                       &self->pending[rank]),
                     error));
    }
    return sentence.status;
}

/* One report of any rank. */
static pspec_status take_report(ps_ranks *self, ps_rank_bytes *parts, pspec_status status,
                                ps_error *error) {
    static const ps_mpi_tag tags[] = {PS_MPI_FAILED, PS_MPI_DONE};
    ps_mpi_tag tag = PS_MPI_DONE;
    int from = 0;
    report head;
    PS_TRY(check(self, self->calls->wait(tags, 2, &from, &tag), error));
    PS_TRY(check(self, self->calls->receive(from, tag, &head, sizeof head), error));
    if (head.num_bytes > 0) {
        ps_rank_bytes bytes = {0};
        const pspec_status taken = take_bytes(self, from, head.num_bytes, &bytes, error);
        if (parts == NULL || taken != PSPEC_OK) { /* the job has failed */
            free(bytes.data);
        } else {
            parts[from] = bytes;
        }
        PS_TRY(taken);
    }
    return tag == PS_MPI_FAILED && !self->has_concluded ? fail(self, from, &head.error, error)
                                                        : status;
}

/* Rank 0, which stopped because another has failed, takes that rank's sentence. */
static pspec_status gather_all(ps_ranks *self, pspec_status status, ps_rank_bytes *parts,
                               ps_error *error) {
    const bool is_first = status != PSPEC_OK && !self->is_stopped;
    self->has_concluded = false;
    if (is_first) {
        const ps_error own = *error;
        status = fail(self, 0, &own, error);
    }
    for (int i = 1; i < self->num && !self->is_broken; i++) {
        status = take_report(self, parts, status, error);
    }
    self->is_stopped = false;
    return status;
}

pspec_status ps_ranks_gather(ps_ranks *self, pspec_status status, const ps_rank_bytes *own,
                             ps_rank_bytes *parts, ps_error *error) {
    if (self == NULL) {
        return status;
    }
    if (self->is_broken) {
        return fail_broken(status, error);
    }
    if (self->own == 0) {
        return gather_all(self, status, parts, error);
    }
    const report head = make_report(status, error, own != NULL ? own->num : 0);
    PS_TRY(send(self, 0, status == PSPEC_OK ? PS_MPI_DONE : PS_MPI_FAILED, &head,
                own != NULL ? own->data : NULL, error));
    return status;
}

static pspec_status conclude_all(ps_ranks *self, pspec_status status, const void *bytes, size_t num,
                                 ps_error *error) {
    for (int rank = 1; self->has_concluded && !self->is_broken && rank < self->num; rank++) {
        self->is_broken = self->calls->settle(&self->pending[rank]) != 0;
    }
    if (!self->has_concluded && !self->is_broken) {
        const report verdict = make_report(status, error, num);
        PS_TRY(tell_all(self, &verdict, bytes, error));
    }
    self->has_concluded = false;
    return status;
}

pspec_status ps_ranks_conclude(ps_ranks *self, pspec_status status, void *bytes, size_t num,
                               ps_error *error) {
    report verdict;
    if (self == NULL) {
        return status;
    }
    if (self->own == 0) {
        return conclude_all(self, status, bytes, num, error);
    }
    if (self->is_broken) {
        return fail_broken(status, error);
    }
    PS_TRY(check(self, self->calls->receive(0, PS_MPI_VERDICT, &verdict, sizeof verdict), error));
    self->is_stopped = false;
    if (verdict.num_bytes > 0 && verdict.num_bytes == num) {
        const int parent = self->own & (self->own - 1);
        PS_TRY(check(self, self->calls->receive(parent, PS_MPI_BYTES, bytes, num), error));
        PS_TRY(forward(self, bytes, num, error));
    }
    if (verdict.error.status == PSPEC_OK && verdict.num_bytes != num) {
        self->is_broken = true; /* others wait for what would go on from here */
        return ps_fail(error, PSPEC_ERROR_IO, "rank 0 gives %zu bytes instead of %zu",
                       (size_t)verdict.num_bytes, num);
    }
    *error = verdict.error;
    return verdict.error.status;
}

pspec_status ps_ranks_agree(ps_ranks *self, pspec_status status, ps_error *error) {
    status = ps_ranks_gather(self, status, NULL, NULL, error);
    return ps_ranks_conclude(self, status, NULL, 0, error);
}

void ps_ranks_free(ps_rank_bytes *parts, size_t num) {
    for (size_t i = 0; parts != NULL && i < num; i++) {
        free(parts[i].data);
    }
    free(parts);
}
