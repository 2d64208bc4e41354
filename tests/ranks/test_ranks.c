/* Ranks that are threads, whose messages are in a list: rounds end the same way whoever fails, and
 * where any call of MPI fails, no rank waits for ever, and each that fails has a sentence. What MPI
 * does then is what mpirun does: a process that ends without MPI_Finalize ends all. */
#include "harness.h"
#include "ranks/module/mpi_calls.h"
#include "ranks/ranks.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RANKS = 5, BYTES = 1000, NOBODY = -1 };

/* ---- the world ----------------------------------------------------------------------------- */

typedef struct message {
    struct message *next;
    struct message *next_posted; /* of those that were posted: freed when all is over */
    char *copy;
    int from, to;
    ps_mpi_tag tag;
    const void *bytes; /* of who sends, until it is taken */
    size_t num;
    bool is_taken;
} message;

static struct {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    message *first, *posted;
    int num_live, num_blocked, num_at_end;
    bool is_aborted, is_stuck;
    int fault_rank, fault_number; /* call number, from 1, of that rank fails */
    int num_calls[RANKS];
} world;

static _Thread_local int own;
static _Thread_local bool has_ended;

/* Under the mutex, after every change. */
static void tell(void) {
    world.num_blocked = 0;
    pthread_cond_broadcast(&world.changed);
}

/* Where all that live are blocked, nobody will change anything. */
static void sleep_until_changed(void) {
    world.num_blocked++;
    if (world.num_blocked == world.num_live) {
        world.is_stuck = true;
        world.is_aborted = true;
        tell();
        return;
    }
    pthread_cond_wait(&world.changed, &world.mutex);
}

static bool fails(void) {
    world.num_calls[own]++;
    return world.is_aborted ||
           (own == world.fault_rank && world.num_calls[own] == world.fault_number);
}

static message *find(int from, ps_mpi_tag tag) {
    message *at = world.first;
    while (at != NULL && (at->to != own || at->tag != tag || (from >= 0 && at->from != from))) {
        at = at->next;
    }
    return at;
}

/* At the end of the list: messages of one rank to another do not overtake. */
static void put(message *sent) {
    message **end = &world.first;
    while (*end != NULL) {
        end = &(*end)->next;
    }
    *end = sent;
    tell();
}

static void take(message *sent) {
    message **at = &world.first;
    while (*at != sent && *at != NULL) {
        at = &(*at)->next;
    }
    if (*at != NULL) {
        *at = sent->next;
    }
    sent->is_taken = true;
    tell();
}

/* ---- calls --------------------------------------------------------------------------------- */

static int call_begin(int *rank, int *num) {
    *rank = own;
    *num = RANKS;
    pthread_mutex_lock(&world.mutex);
    const bool is_fault = fails();
    pthread_mutex_unlock(&world.mutex);
    return is_fault;
}

static int wait_until_taken(message *sent) {
    while (!sent->is_taken && !world.is_aborted) {
        sleep_until_changed();
    }
    const bool is_lost = !sent->is_taken;
    if (is_lost) {
        take(sent);
    }
    return is_lost;
}

static int call_send(int to, ps_mpi_tag tag, const void *bytes, size_t num) {
    message sent = {NULL, NULL, NULL, own, to, tag, bytes, num, false};
    pthread_mutex_lock(&world.mutex);
    int code = fails();
    if (code == 0) {
        put(&sent);
        code = wait_until_taken(&sent);
    }
    pthread_mutex_unlock(&world.mutex);
    return code;
}

/* MPI keeps what is as short as a verdict, also for a rank that is gone. */
static int call_post(int to, ps_mpi_tag tag, const void *bytes, size_t num, void **pending) {
    pthread_mutex_lock(&world.mutex);
    const int code = fails();
    *pending = NULL;
    if (code == 0) {
        message *const sent = calloc(1, sizeof *sent);
        char *const copy = malloc(num);
        assert_true(sent != NULL && copy != NULL);
        memcpy(copy, bytes, num);
        *sent = (message){NULL, world.posted, copy, own, to, tag, copy, num, false};
        *pending = world.posted = sent;
        put(sent);
    }
    pthread_mutex_unlock(&world.mutex);
    return code;
}

static int call_settle(void **pending) {
    message *const sent = *pending;
    pthread_mutex_lock(&world.mutex);
    int code = fails();
    if (sent != NULL && code == 0) {
        code = wait_until_taken(sent);
    }
    pthread_mutex_unlock(&world.mutex);
    *pending = NULL;
    return code;
}

static int call_receive(int from, ps_mpi_tag tag, void *bytes, size_t num) {
    pthread_mutex_lock(&world.mutex);
    int code = fails();
    message *found = NULL;
    while (code == 0 && (found = find(from, tag)) == NULL) {
        code = world.is_aborted;
        if (code == 0) {
            sleep_until_changed();
        }
    }
    if (found != NULL) {
        code = found->num != num;
        memcpy(bytes, found->bytes, num < found->num ? num : found->num);
        take(found);
    }
    pthread_mutex_unlock(&world.mutex);
    return code;
}

static int call_wait(const ps_mpi_tag *tags, size_t num_tags, int *from, ps_mpi_tag *tag) {
    pthread_mutex_lock(&world.mutex);
    int code = fails();
    message *found = NULL;
    while (code == 0 && found == NULL) {
        for (size_t i = 0; i < num_tags && found == NULL; i++) {
            found = find(-1, tags[i]);
        }
        code = found == NULL && world.is_aborted;
        if (code == 0 && found == NULL) {
            sleep_until_changed();
        }
    }
    if (found != NULL) {
        *from = found->from;
        *tag = found->tag;
    }
    pthread_mutex_unlock(&world.mutex);
    return code;
}

/* Not counted: how often it is asked depends on the others. */
static int call_is_there(ps_mpi_tag tag) {
    pthread_mutex_lock(&world.mutex);
    const bool is_there = find(-1, tag) != NULL;
    pthread_mutex_unlock(&world.mutex);
    return is_there;
}

static void call_end(void) {
    pthread_mutex_lock(&world.mutex);
    has_ended = true;
    world.num_at_end++;
    tell();
    while (world.num_at_end < RANKS && !world.is_aborted) {
        sleep_until_changed();
    }
    pthread_mutex_unlock(&world.mutex);
}

static const ps_mpi_calls calls = {
    PS_MPI_CALLS_VERSION, call_begin, call_send,     call_post, call_settle,
    call_receive,         call_wait,  call_is_there, call_end};

/* ---- a job --------------------------------------------------------------------------------- */

typedef struct job {
    int rank, fails; /* who fails in the second round */
    pspec_status status;
    ps_error error;
    char heard[BYTES]; /* bytes of the verdict */
} job;

/* Every rank hands in bytes of its own, and has those of rank 0 afterwards. */
static pspec_status go_round(job *self, ps_ranks *ranks, pspec_status status) {
    char bytes[BYTES];
    ps_rank_bytes parts[RANKS] = {{0}};
    const ps_rank_bytes handed = {bytes, sizeof bytes};
    memset(bytes, 'a' + self->rank, sizeof bytes);
    memset(self->heard, self->rank == 0 ? 'v' : 0, sizeof self->heard);
    status = ps_ranks_gather(ranks, status, &handed, parts, &self->error);
    for (int r = 1; self->rank == 0 && status == PSPEC_OK && r < RANKS; r++) {
        const char *const data = parts[r].data;
        if (parts[r].num != BYTES || data[0] != 'a' + r || data[BYTES - 1] != 'a' + r) {
            status = ps_fail(&self->error, PSPEC_ERROR_CHECK, "rank %d handed in other bytes", r);
        }
    }
    for (int r = 0; r < RANKS; r++) {
        free(parts[r].data);
    }
    return ps_ranks_conclude(ranks, status, self->heard, sizeof self->heard, &self->error);
}

static pspec_status work(job *self, ps_ranks *ranks) {
    PS_TRY(ps_ranks_agree(ranks, PSPEC_OK, &self->error));
    PS_TRY(go_round(self, ranks, PSPEC_OK));
    pspec_status status = PSPEC_OK;
    if (self->rank == self->fails) {
        status = ps_fail(&self->error, PSPEC_ERROR_INPUT, "no points");
    } else if (ps_ranks_must_stop(ranks)) {
        status = ps_fail(&self->error, PSPEC_ERROR_CANCELLED, "interrupted");
    }
    return go_round(self, ranks, status);
}

static void *run(void *payload) {
    job *const self = payload;
    ps_ranks *ranks = NULL;
    own = self->rank;
    has_ended = false;
    self->status = ps_ranks_begin(&ranks, &calls, RANKS, &self->error);
    if (self->status == PSPEC_OK) {
        self->status = work(self, ranks);
    }
    ps_ranks_close(ranks);
    pthread_mutex_lock(&world.mutex);
    world.num_live--;
    world.is_aborted = world.is_aborted || !has_ended;
    tell();
    pthread_mutex_unlock(&world.mutex);
    return NULL;
}

/* jobs[RANKS] */
static void run_all(job *jobs, int fails_rank, int fault_rank, int fault_number) {
    pthread_t threads[RANKS];
    memset(&world, 0, sizeof world);
    assert_int_equal(pthread_mutex_init(&world.mutex, NULL), 0);
    assert_int_equal(pthread_cond_init(&world.changed, NULL), 0);
    world.num_live = RANKS;
    world.fault_rank = fault_rank;
    world.fault_number = fault_number;
    for (int r = 0; r < RANKS; r++) {
        jobs[r] = (job){.rank = r, .fails = fails_rank};
        assert_int_equal(pthread_create(&threads[r], NULL, run, &jobs[r]), 0);
    }
    for (int r = 0; r < RANKS; r++) {
        assert_int_equal(pthread_join(threads[r], NULL), 0);
    }
    pthread_cond_destroy(&world.changed);
    pthread_mutex_destroy(&world.mutex);
    if (world.is_stuck) {
        fail_msg("ranks wait for ever: rank %d fails, and call %d of rank %d", fails_rank,
                 fault_number, fault_rank);
    }
    assert_true(world.first == NULL || world.is_aborted); /* no message is left */
    while (world.posted != NULL) {
        message *const next = world.posted->next_posted;
        free(world.posted->copy);
        free(world.posted);
        world.posted = next;
    }
}

/* ---- tests --------------------------------------------------------------------------------- */

static void verdicts_are_those_of_all(void **state) {
    job jobs[RANKS];
    (void)state;
    run_all(jobs, NOBODY, NOBODY, 0);
    for (int r = 0; r < RANKS; r++) {
        assert_int_equal(jobs[r].status, PSPEC_OK);
        assert_int_equal(jobs[r].heard[0], 'v');
        assert_int_equal(jobs[r].heard[BYTES - 1], 'v');
    }
    for (int who = 0; who < RANKS; who++) {
        run_all(jobs, who, NOBODY, 0);
        for (int r = 0; r < RANKS; r++) {
            assert_int_equal(jobs[r].status, PSPEC_ERROR_INPUT);
            assert_int_equal(jobs[r].error.status, PSPEC_ERROR_INPUT);
            char sentence[32];
            snprintf(sentence, sizeof sentence, "rank %d: no points", who);
            assert_string_equal(jobs[r].error.message,
                                sentence + (who == 0 ? strlen("rank 0: ") : 0));
        }
    }
}

/* The rank whose call fails says so, or what it was going to say; the others, too, or they have all
 * that they need. */
static void calls_fail_one_by_one(void **state) {
    job jobs[RANKS];
    (void)state;
    int num_faults = 0;
    for (int who = NOBODY; who < RANKS; who++) {
        for (int rank = 0; rank < RANKS; rank++) {
            bool has_failed = true;
            for (int number = 1; has_failed; number++) {
                run_all(jobs, who, rank, number);
                has_failed = world.num_calls[rank] >= number;
                for (int r = 0; r < RANKS; r++) {
                    assert_true(jobs[r].status == PSPEC_OK || jobs[r].error.message[0] != '\0');
                }
                if (has_failed) {
                    assert_int_not_equal(jobs[rank].status, PSPEC_OK);
                    num_faults++;
                }
            }
        }
    }
    assert_true(num_faults > 4 * RANKS * 4); /* calls of a rank in three rounds */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(verdicts_are_those_of_all),
        cmocka_unit_test(calls_fail_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
