/* Rows of a team are those that one process has, in order, whatever the members, the end of the
 * realizations, and how many are taken at a time; members that are not alike are refused by all. So
 * are rows of ranges that a tape keeps, and plays. */
#include "harness.h"

#include "jobs/rows/row_stream.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_MEMBERS = 5, ROWS = 403, BATCH = 3 };

/* ---- a team of threads ---------------------------------------------------------------------- */

static struct {
    pthread_barrier_t barrier;
    void *slots[MOST_MEMBERS];
} world;

static pspec_status exchange(const ps_team *team, pspec_status status, void *slots, size_t bytes,
                             ps_error *error) {
    (void)error;
    world.slots[team->own] = slots;
    pthread_barrier_wait(&world.barrier);
    for (size_t i = 0; i < team->num; i++) {
        if (i != team->own) {
            memcpy((char *)slots + i * bytes, (char *)world.slots[i] + i * bytes, bytes);
        }
    }
    pthread_barrier_wait(&world.barrier);
    return status;
}

/* ---- a job: row i is (i, i^2) --------------------------------------------------------------- */

typedef struct row {
    uint64_t number;
    double square;
} row;

typedef struct job {
    ps_row_stream stream;
    ps_team team;
    uint64_t at;       /* of its source */
    uint64_t num_made; /* by this member */
    uint64_t most;     /* rows that are taken at a time */
    uint64_t begin;    /* the number of its first row */
    double largest;
    bool has_nan;
    bool is_slow; /* so that others make more */
    uint64_t num_taken;
    bool is_in_order;
    pspec_status status;
    ps_error error;
} job;

static pspec_status make(void *payload, uint64_t first, size_t most, void *rows, size_t *num,
                         ps_error *error) {
    job *const self = payload;
    row *const out = rows;
    (void)error;
    const struct timespec a_while = {.tv_nsec = 40000000};
    self->is_in_order = self->is_in_order && first == self->at && most <= BATCH;
    if (self->is_slow) {
        nanosleep(&a_while, NULL);
    }
    for (*num = 0; *num < most && self->at < ROWS; (*num)++) {
        const double number = (double)self->at;
        out[*num] = (row){self->at++, number * number};
        self->num_made++;
    }
    return PSPEC_OK;
}

static pspec_status pass(void *payload, uint64_t num, uint64_t *passed, ps_error *error) {
    job *const self = payload;
    const uint64_t left = ROWS - self->at;
    (void)error;
    *passed = num < left ? num : left;
    self->at += *passed;
    return PSPEC_OK;
}

/* The largest row that this member has made. */
static pspec_status measure(void *payload, double *numbers, ps_error *error) {
    const job *const self = payload;
    (void)error;
    numbers[0] = (double)self->num_made;
    numbers[1] = self->has_nan ? NAN : (double)self->at;
    return PSPEC_OK;
}

static void take_largest(void *payload, const double *numbers) {
    job *const self = payload;
    self->largest = numbers[1];
}

static void *run(void *payload) {
    job *const self = payload;
    size_t num = 1;
    self->status = ps_row_stream_begin(
        &self->stream, self->begin - ps_row_tape_first(self->stream.tape), &self->error);
    while (self->status == PSPEC_OK && num > 0) {
        self->status = ps_row_stream_next(&self->stream, self->most, &num, &self->error);
        for (size_t i = 0; self->status == PSPEC_OK && i < num; i++) {
            const row *const one = ps_row_stream_row(&self->stream, i);
            const uint64_t number = self->begin + self->num_taken++;
            self->is_in_order = self->is_in_order && one->number == number &&
                                one->square == (double)number * (double)number;
        }
    }
    ps_row_stream_free(&self->stream);
    return NULL;
}

static void begin(job *self, size_t own, size_t num, uint64_t total, uint64_t most) {
    *self = (job){
        .most = most, .is_in_order = true, .team = {.own = own, .num = num, .exchange = exchange}};
    self->stream = (ps_row_stream){.job = self,
                                   .make = make,
                                   .pass = pass,
                                   .measure = measure,
                                   .take_largest = take_largest,
                                   .num_largest = 2,
                                   .row_bytes = sizeof(row),
                                   .batch = BATCH,
                                   .total = total,
                                   .team = num > 1 ? &self->team : NULL};
}

static void run_all(job *jobs, size_t num) {
    pthread_t threads[MOST_MEMBERS];
    assert_int_equal(pthread_barrier_init(&world.barrier, NULL, (unsigned)num), 0);
    for (size_t i = 0; i < num; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, run, &jobs[i]), 0);
    }
    for (size_t i = 0; i < num; i++) {
        pthread_join(threads[i], NULL);
    }
    pthread_barrier_destroy(&world.barrier);
}

/* ---- laws ----------------------------------------------------------------------------------- */

static void rows_are_those_of_one(void **state) {
    static const uint64_t mosts[] = {1, 2, 7, 100, UINT64_MAX};
    job jobs[MOST_MEMBERS];
    (void)state;
    for (size_t num = 1; num <= MOST_MEMBERS; num++) {
        for (size_t m = 0; m < 2 * sizeof mosts / sizeof *mosts; m++) {
            uint64_t made = 0;
            for (size_t i = 0; i < num; i++) {
                begin(&jobs[i], i, num, m % 2 == 0 ? ROWS : 0, mosts[m / 2]);
            }
            run_all(jobs, num);
            for (size_t i = 0; i < num; i++) {
                assert_int_equal(jobs[i].status, PSPEC_OK);
                assert_true(jobs[i].is_in_order);
                assert_int_equal(jobs[i].num_taken, ROWS);
                made += jobs[i].num_made;
            }
            assert_int_equal(made, ROWS); /* nobody makes what another does */
        }
    }
}

static void members_share_the_work(void **state) {
    job jobs[MOST_MEMBERS];
    (void)state;
    for (size_t i = 0; i < MOST_MEMBERS; i++) {
        begin(&jobs[i], i, MOST_MEMBERS, ROWS, UINT64_MAX);
    }
    run_all(jobs, MOST_MEMBERS);
    for (size_t i = 0; i < MOST_MEMBERS; i++) {
        assert_in_range(jobs[i].num_made, ROWS / MOST_MEMBERS - 8, ROWS / MOST_MEMBERS + 8);
        assert_true(jobs[i].largest == ROWS); /* of whoever made the last one */
    }
}

/* Who makes how many is nobody's business. */
static void a_slow_member_changes_nothing(void **state) {
    enum { MEMBERS = 3 };
    job jobs[MEMBERS];
    uint64_t made = 0;
    (void)state;
    for (size_t i = 0; i < MEMBERS; i++) {
        begin(&jobs[i], i, MEMBERS, 0, UINT64_MAX);
        jobs[i].is_slow = i == 1;
    }
    run_all(jobs, MEMBERS);
    for (size_t i = 0; i < MEMBERS; i++) {
        assert_int_equal(jobs[i].status, PSPEC_OK);
        assert_true(jobs[i].is_in_order);
        assert_int_equal(jobs[i].num_taken, ROWS);
        made += jobs[i].num_made;
    }
    assert_int_equal(made, ROWS);
}

static void jobs_go_on_behind_what_they_have(void **state) {
    enum { MEMBERS = 3 };
    static const uint64_t begins[] = {1, 200, ROWS};
    job jobs[MEMBERS];
    (void)state;
    for (size_t b = 0; b < sizeof begins / sizeof *begins; b++) {
        for (size_t i = 0; i < MEMBERS; i++) {
            begin(&jobs[i], i, MEMBERS, 0, UINT64_MAX);
            jobs[i].begin = begins[b];
        }
        run_all(jobs, MEMBERS);
        for (size_t i = 0; i < MEMBERS; i++) {
            assert_int_equal(jobs[i].status, PSPEC_OK);
            assert_true(jobs[i].is_in_order);
            assert_int_equal(jobs[i].num_taken, ROWS - begins[b]);
        }
    }
}

static void nan_is_the_largest(void **state) {
    job jobs[2];
    (void)state;
    for (size_t who = 0; who < 2; who++) {
        for (size_t i = 0; i < 2; i++) {
            begin(&jobs[i], i, 2, ROWS, UINT64_MAX);
            jobs[i].has_nan = i == who;
        }
        run_all(jobs, 2);
        assert_true(isnan(jobs[0].largest) && isnan(jobs[1].largest));
    }
}

static void members_that_differ_are_refused_by_all(void **state) {
    enum { MEMBERS = 3 };
    job jobs[MEMBERS];
    (void)state;
    for (size_t i = 0; i < MEMBERS; i++) {
        begin(&jobs[i], i, MEMBERS, 0, UINT64_MAX);
        jobs[i].begin = i == 2 ? 9 : 8;
    }
    run_all(jobs, MEMBERS);
    for (size_t i = 0; i < MEMBERS; i++) {
        assert_int_equal(jobs[i].status, PSPEC_ERROR_INPUT);
        assert_string_equal(jobs[i].error.message,
                            "rank 2 has \"9 realizations of a checkpoint\", and rank 0 \"8 "
                            "realizations of a checkpoint\": what they compute would not be one "
                            "result");
        assert_int_equal(jobs[i].num_taken, 0);
    }
}

static void fewer_sets_than_a_checkpoint_has_are_refused(void **state) {
    job one;
    (void)state;
    begin(&one, 0, 1, 0, UINT64_MAX);
    one.begin = ROWS + 1;
    run_all(&one, 1);
    assert_int_equal(one.status, PSPEC_ERROR_INPUT);
    assert_string_equal(one.error.message,
                        "there are fewer sets than the 404 that the checkpoint has");
}

/* ---- tapes ---------------------------------------------------------------------------------- */

/* The rows of a range, of `num` members, on the tape of the first. */
static void keep(ps_row_tape *tape, size_t num, uint64_t first, uint64_t end, uint64_t total) {
    job jobs[MOST_MEMBERS];
    ps_row_tape others[MOST_MEMBERS];
    for (size_t i = 0; i < num; i++) {
        ps_row_tape *const own = i == 0 ? tape : &others[i];
        *own = (ps_row_tape){.range = {first, end}, .is_part = true};
        begin(&jobs[i], i, num, total, 7);
        jobs[i].begin = first;
        jobs[i].stream.tape = own;
    }
    run_all(jobs, num);
    for (size_t i = 0; i < num; i++) {
        assert_int_equal(jobs[i].status, PSPEC_OK);
        assert_true(jobs[i].is_in_order);
        assert_int_equal(jobs[i].num_taken, end - first);
        assert_true(i == 0 || others[i].num == 0); /* who does not lead keeps nothing */
    }
    assert_int_equal(tape->num, 1);
    assert_int_equal(tape->tracks[0].num, end - first);
    assert_int_equal(tape->tracks[0].all, ROWS);
}

static void ranges_that_are_kept_are_the_job(void **state) {
    static const uint64_t ends[] = {1, 100, 101, 400, ROWS};
    (void)state;
    for (size_t num = 1; num <= MOST_MEMBERS; num += 2) {
        ps_row_tape whole = {.range = {0, ROWS}, .is_played = true};
        ps_row_track *track = NULL;
        job one;
        assert_int_equal(ps_row_tape_track(&track, &whole, 0, NULL), PSPEC_OK);
        track->row_bytes = sizeof(row);
        for (size_t r = 0; r < sizeof ends / sizeof *ends; r++) {
            ps_row_tape part;
            keep(&part, num, r > 0 ? ends[r - 1] : 0, ends[r], r % 2 == 0 ? ROWS : 0);
            assert_int_equal(ps_row_track_add(track, part.tracks[0].rows, part.tracks[0].num, NULL),
                             PSPEC_OK);
            track->largest[1] = fmax(track->largest[1], part.tracks[0].largest[1]);
            ps_row_tape_free(&part);
        }
        begin(&one, 0, 1, ROWS, UINT64_MAX);
        one.stream.tape = &whole;
        run_all(&one, 1);
        assert_int_equal(one.status, PSPEC_OK);
        assert_true(one.is_in_order);
        assert_int_equal(one.num_taken, ROWS);
        assert_int_equal(one.num_made, 0);
        assert_true(one.largest == ROWS);
        ps_row_tape_free(&whole);
    }
}

/* Also where files say no sooner than at their end how many there are. */
static void ranges_beyond_all_realizations_are_refused(void **state) {
    static const ps_realization_range ranges[] = {{0, ROWS + 1}, {ROWS, ROWS + 1}, {900, 901}};
    (void)state;
    for (size_t i = 0; i < 2 * sizeof ranges / sizeof *ranges; i++) {
        ps_row_tape tape = {.range = ranges[i / 2], .is_part = true};
        job one;
        begin(&one, 0, 1, i % 2 == 0 ? ROWS : 0, UINT64_MAX);
        one.begin = tape.range.first;
        one.stream.tape = &tape;
        run_all(&one, 1);
        assert_int_equal(one.status, PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(one.error.message, "goes beyond the realizations, of which there "
                                                  "are 403"));
        ps_row_tape_free(&tape);
    }
}

static void rows_of_another_program_are_not_played(void **state) {
    ps_row_tape tape = {.range = {0, ROWS}, .is_played = true};
    ps_row_track *track = NULL;
    job one;
    (void)state;
    for (size_t bytes = 0; bytes < sizeof(row); bytes += 8) {
        begin(&one, 0, 1, ROWS, UINT64_MAX);
        one.stream.tape = &tape;
        run_all(&one, 1);
        assert_int_equal(one.status, PSPEC_ERROR_INPUT);
        assert_int_equal(ps_row_tape_track(&track, &tape, 0, NULL), PSPEC_OK);
        track->row_bytes = bytes;
    }
    ps_row_tape_free(&tape);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_those_of_one),
        cmocka_unit_test(members_share_the_work),
        cmocka_unit_test(a_slow_member_changes_nothing),
        cmocka_unit_test(jobs_go_on_behind_what_they_have),
        cmocka_unit_test(nan_is_the_largest),
        cmocka_unit_test(members_that_differ_are_refused_by_all),
        cmocka_unit_test(fewer_sets_than_a_checkpoint_has_are_refused),
        cmocka_unit_test(ranges_that_are_kept_are_the_job),
        cmocka_unit_test(ranges_beyond_all_realizations_are_refused),
        cmocka_unit_test(rows_of_another_program_are_not_played),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
