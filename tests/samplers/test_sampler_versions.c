/* A version of a sampler stands for the bits of its sets, by which sets are kept. */
#include "test_samplers.h"

#include <string.h>

#include <xxhash.h>

enum { NUM = 128, ROOM = 1 << 14 };

/* Who changes an algorithm finds this red, and raises the version of its row. */
static void versions_stand_for_bits(void **state) {
    (void)state;
    static const struct {
        const char *text;
        unsigned dimension, version;
        uint64_t hash;
    } known[] = {
        {"poisson-disk", 2, 1, UINT64_C(0x84e0a99bc71d7d7e)},
        {"poisson-disk", 3, 1, UINT64_C(0x8145a48f4fe177e1)},
        {"bridson", 2, 2, UINT64_C(0x2745482dc8ab881e)},
        {"bridson", 4, 2, UINT64_C(0xdcd60ec5c220bff3)},
        {"poisson-disk-sphere", 3, 1, UINT64_C(0x8a52475f59d7013f)},
        {"bnot", 2, 1, UINT64_C(0xdb0b703c6b38706a)},
        {"fpo", 2, 1, UINT64_C(0x6ccc9a3147f8efcc)},
        {"ccvt", 2, 1, UINT64_C(0xc1e5432d365dcec7)},
        {"ccvt-sphere", 3, 3, UINT64_C(0xe6487e0e47606ae4)},
        {"gaussian-blue-noise", 2, 2, UINT64_C(0x36e8b9f0915103fb)},
        {"step", 2, 2, UINT64_C(0x9845960c79215b36)},
    };
    enum { NUM_KNOWN = sizeof known / sizeof known[0], REALIZATION = 3 };
    static double points[ROOM];
    size_t num_points = 0;
    for (unsigned i = 0; i < NUM_KNOWN; i++) {
        ps_sampler_request request = parse_request(known[i].text, NUM, known[i].dimension);
        assert_int_equal(ps_sampler_resolve(&request, NULL), PSPEC_OK);
        assert_true(ps_sampler_most_points(&request) * request.dimension <= ROOM);
        if (ps_sampler_check_device(&request, NULL, NULL) != PSPEC_OK) {
            print_message("%s is not looked at: there is no device for it\n", known[i].text);
            continue;
        }
        assert_int_equal(
            ps_sampler_generate(&request, REALIZATION, points, &num_points, NULL, NULL), PSPEC_OK);
        const uint64_t hash = XXH3_64bits(points, num_points * request.dimension * sizeof(double));
        if (hash != known[i].hash || request.sampler->version != known[i].version) {
            fail_msg("%s, d = %u: version %u has the hash 0x%016llx", known[i].text,
                     known[i].dimension, request.sampler->version, (unsigned long long)hash);
        }
    }
    for (unsigned i = 0; ps_samplers[i] != NULL; i++) {
        bool is_known = ps_samplers[i]->version == 0;
        for (unsigned k = 0; k < NUM_KNOWN; k++) {
            is_known = is_known || strcmp(ps_samplers[i]->name, known[k].text) == 0;
        }
        assert_true(is_known);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(versions_stand_for_bits)};
    return cmocka_run_group_tests_name("sampler_versions", tests, NULL, NULL);
}
