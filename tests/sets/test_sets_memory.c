/* Memory that samplers take while they make sets: a limit refuses one, or makes fewer at a time. */
#include "sets/sets.h"

#include "base/workers.h"
#include "test_samplers.h"

#include <stdatomic.h>
#include <time.h>

enum { NUM = 128 };

static void a_limit_below_what_a_set_takes_is_refused(void **state) {
    (void)state;
    const ps_sampler_request request = make_request("ccvt:M=1024", NUM, 2);
    const ps_sets_options options = {{NULL, 0}, 1 << 20, 0, NULL, 0};
    ps_sets *sets = NULL;
    ps_error error = {0};
    assert_int_equal(ps_sets_create(&sets, &request, 4, &options, &error), PSPEC_ERROR_MEMORY);
    assert_null(sets);
    assert_string_equal(error.message, "sampler ccvt: a set of 128 points takes 7.054M of memory "
                                       "while it is made, above the limit of 1M");
}

/* Of a sampler of the test's own: makers at work, and the most there were. */
static atomic_uint at_work, most_at_work;
enum { WORK_BYTES = 1 << 20 };

static pspec_status make_slowly(const ps_sampler_request *request, uint64_t realization,
                                double *points, ps_error *error) {
    const struct timespec a_while = {.tv_nsec = 1000000};
    const unsigned now = atomic_fetch_add(&at_work, 1) + 1;
    unsigned most = atomic_load(&most_at_work);
    (void)error;
    while (now > most && !atomic_compare_exchange_weak(&most_at_work, &most, now)) {
    }
    nanosleep(&a_while, NULL);
    for (size_t i = 0; i < request->num_points * request->dimension; i++) {
        points[i] = (double)realization / (double)(i + 1);
    }
    atomic_fetch_sub(&at_work, 1);
    return PSPEC_OK;
}

static double a_second(const ps_sampler_request *request) {
    (void)request;
    return 1;
}

static double take_much(const ps_sampler_request *request) {
    (void)request;
    return WORK_BYTES;
}

/* What the rest of the job takes leaves less; a 16th is of sets that are made ahead. */
static void as_many_are_made_at_once_as_the_limit_allows(void **state) {
    (void)state;
    enum { MANY = 24 };
    static const struct {
        uint64_t limit, taken;
        unsigned expected;
    } cases[] = {{WORK_BYTES, 0, 1},
                 {2 * WORK_BYTES, 0, 1},
                 {3 * WORK_BYTES, 0, 2},
                 {3 * WORK_BYTES, WORK_BYTES, 1},
                 {3 * WORK_BYTES, 4 * WORK_BYTES, 1},
                 {8 * WORK_BYTES, WORK_BYTES, 6}};
    ps_sampler_request request = make_request("white", NUM, 2);
    ps_sampler slow = *request.sampler;
    double points[2 * NUM];
    size_t num = 0;
    slow.generate = make_slowly;
    slow.seconds = a_second;
    slow.work_bytes = take_much;
    request.sampler = &slow;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const ps_sets_options options = {{NULL, 0}, cases[i].limit, 0, NULL, cases[i].taken};
        const unsigned processors = ps_workers_most();
        const unsigned most = cases[i].expected < processors ? cases[i].expected : processors;
        ps_sets *sets = NULL;
        atomic_store(&most_at_work, 0);
        assert_int_equal(ps_sets_makers(&request, &options, MANY), most);
        assert_int_equal(ps_sets_create(&sets, &request, MANY, &options, NULL), PSPEC_OK);
        for (uint64_t r = 0; r < MANY; r++) {
            assert_int_equal(ps_sets_next(sets, points, &num, NULL, NULL), PSPEC_OK);
            assert_true(points[1] == (double)r / 2);
        }
        ps_sets_destroy(sets);
        assert_in_range(atomic_load(&most_at_work), 1, most);
    }
    const ps_sets_options none = {{NULL, 0}, 0, 0, NULL, 0};
    assert_int_equal(ps_sets_makers(&request, &none, MANY),
                     ps_workers_most() < MANY ? ps_workers_most() : MANY);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_below_what_a_set_takes_is_refused),
        cmocka_unit_test(as_many_are_made_at_once_as_the_limit_allows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
