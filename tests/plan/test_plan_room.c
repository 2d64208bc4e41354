/* What memory is free never changes what is chosen, only how much of it is done at a time, or
 * whether it is done. */
#include "harness_plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ps_memory_room make_room(double bytes) {
    return (ps_memory_room){.bytes = (uint64_t)bytes, .by = "memory.max of this test"};
}

static const double megabyte = 1 << 20;

static void rooms_change_no_choice(void **state) {
    (void)state;
    const ps_frequencies sets[] = {test_lattice(1, 100000), test_lattice(2, 200),
                                   test_lattice(3, 20)};
    const ps_device_limits devices[] = {test_cpu(), test_gpu(true)};
    for (size_t s = 0; s < 3; s++) {
        for (size_t d = 0; d < 2; d++) {
            const ps_problem problem = test_problem(&sets[s], 100000, 1e-5);
            ps_plan all;
            size_t last_batch = 1;
            size_t num_crowded = 0;
            test_make_plan(&all, &problem, &devices[d], &test_any_plan);
            for (double bytes = 1; bytes < 1e12; bytes *= 2) {
                const ps_memory_room room = make_room(bytes);
                const ps_plan_constraints constraints = {.precision = -1, .room = &room};
                ps_plan plan;
                test_make_plan(&plan, &problem, &devices[d], &constraints);
                assert_non_null(plan.chosen);
                assert_true(plan.chosen->engine == all.chosen->engine);
                assert_int_equal(plan.chosen->precision, all.chosen->precision);
                assert_true(plan.chosen->batch >= last_batch);
                assert_true(plan.chosen->batch == 1 || !plan.chosen->is_crowded);
                assert_true(plan.chosen->is_crowded ||
                            plan.chosen->host_bytes + 128 * megabyte <= bytes);
                num_crowded += plan.chosen->is_crowded;
                last_batch = plan.chosen->batch;
                ps_error said = {0};
                assert_int_equal(ps_plan_require(&plan, &problem, &said),
                                 plan.chosen->is_crowded ? PSPEC_ERROR_MEMORY : PSPEC_OK);
                assert_true(!plan.chosen->is_crowded ||
                            strstr(said.message, "memory.max of this test leaves ") != NULL);
            }
            assert_int_equal(last_batch, all.chosen->batch);
            assert_true(num_crowded > 20); /* up to 128 MiB at least */
        }
    }
}

/* A CPU is the same kind of device in a small machine and in a large one; a card with less memory
 * is another. */
static void machines_change_no_choice(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 500);
    const ps_problem problem = test_problem(&set, 10000, 1e-5);
    ps_device_limits cpu = test_cpu();
    ps_device_limits card = test_gpu(true);
    ps_plan large;
    ps_plan small;
    test_make_plan(&large, &problem, &cpu, &test_any_plan);
    cpu.global_bytes = 1 << 20;
    test_make_plan(&small, &problem, &cpu, &test_any_plan);
    assert_true(large.chosen != NULL && small.chosen != NULL);
    assert_true(large.chosen->engine == small.chosen->engine);
    assert_int_equal(large.chosen->precision, small.chosen->precision);
    card.global_bytes = 1 << 20;
    test_make_plan(&small, &problem, &card, &test_any_plan);
    assert_true(large.chosen->engine != small.chosen->engine);
}

/* The sentence names another engine that there is room for, and what it says of --memory is so. */
static void what_helps(void **state) {
    (void)state;
    const ps_frequencies set = test_lattice(2, 2000);
    const ps_problem problem = test_problem(&set, 1000000, 1e-6);
    const ps_device_limits limits = test_cpu();
    size_t num_memory = 0;
    size_t num_nothing = 0;
    for (double bytes = 200 * megabyte; bytes < 8000 * megabyte; bytes *= 1.1) {
        const ps_memory_room room = make_room(bytes);
        ps_plan_constraints constraints = {
            .precision = -1, .room = &room, .offers = PS_OFFER_RINGS};
        ps_plan plan;
        ps_error said = {0};
        test_make_plan(&plan, &problem, &limits, &constraints);
        if (ps_plan_require(&plan, &problem, &said) == PSPEC_OK) {
            continue;
        }
        const char *const memory = strstr(said.message, "; --memory ");
        const char *const engine = strstr(said.message, "; --engine ");
        assert_true(memory == NULL || engine == NULL);
        num_nothing += strstr(said.message, "--per-ring") != NULL;
        if (memory != NULL) {
            uint64_t typed = 0;
            char size[16] = "";
            assert_int_equal(sscanf(memory, "; --memory %15s takes", size), 1);
            assert_ok(ps_parse_size(size, "memory", &typed, error));
            constraints.memory_limit = typed;
            test_make_plan(&plan, &problem, &limits, &constraints);
            assert_ok(ps_plan_require(&plan, &problem, error));
            assert_non_null(strstr(memory, plan.chosen->engine->name));
            num_memory++;
        }
    }
    assert_true(num_memory > 0 && num_nothing > 0);
}

static bool offers_rings(const ps_problem *problem, double bytes, unsigned offers) {
    const ps_memory_room room = make_room(bytes);
    const ps_device_limits limits = test_cpu();
    const ps_plan_constraints constraints = {.precision = -1, .room = &room, .offers = offers};
    ps_plan plan;
    ps_error said = {0};
    test_make_plan(&plan, problem, &limits, &constraints);
    assert_int_equal(ps_plan_require(&plan, problem, &said), PSPEC_ERROR_MEMORY);
    return strstr(said.message, "--per-ring") != NULL;
}

/* A subset is offered where the question may be asked of one, there is one, and frequencies are
 * what there is too much of. */
static void subsets_that_help(void **state) {
    (void)state;
    const ps_frequencies plane = test_lattice(2, 2000);
    const ps_frequencies beyond = test_lattice(2, 2001);
    const ps_frequencies line = test_lattice(1, 20000000);
    const double room = 200 * megabyte;
    const ps_problem few = test_problem(&plane, 1000, 1e-6);
    const ps_problem many = test_problem(&plane, 100000000, 1e-6);
    const ps_problem too_far = test_problem(&beyond, 1000, 1e-6);
    const ps_problem on_line = test_problem(&line, 1000, 1e-6);
    assert_true(offers_rings(&few, room, PS_OFFER_RINGS | PS_OFFER_LISTS));
    assert_false(offers_rings(&few, room, PS_OFFER_LISTS));
    assert_false(offers_rings(&many, room, PS_OFFER_RINGS));
    assert_false(offers_rings(&too_far, room, PS_OFFER_RINGS));
    assert_false(offers_rings(&on_line, room, PS_OFFER_RINGS));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rooms_change_no_choice), cmocka_unit_test(machines_change_no_choice),
        cmocka_unit_test(what_helps), cmocka_unit_test(subsets_that_help)};
    return cmocka_run_group_tests_name("plan_room", tests, NULL, NULL);
}
