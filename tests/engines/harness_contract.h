/* Problems of every kind for every engine that takes them: what the contract of engines is tried
 * with. */
#ifndef TESTS_ENGINES_HARNESS_CONTRACT_H
#define TESTS_ENGINES_HARNESS_CONTRACT_H

#include "harness.h"

/* Numbers of points at and beside vectors and chunks, none at all, and many beside the others. */
enum {
    CONTRACT_SETS = 14,
    CONTRACT_ODD_SET = 9,
    CONTRACT_LONGEST_SET = 13,
    CONTRACT_ODD = 33,
    CONTRACT_LONGEST = 700
};

typedef struct contract_case {
    const char *name;
    unsigned dimension;    /* 0: degrees on the sphere */
    int32_t max_frequency; /* or degree */
    bool is_part;          /* a ball, or even degrees */
    bool is_list;          /* of some frequencies */
    ps_measure measure;
    double tolerances[3];    /* by precision; 0: not asked in this one */
    uint64_t planned_points; /* many choose another variant; 0: as many as the longest set has */
    const char *says;        /* of torus_nufft: part of its description, where it is this variant */
} contract_case;

/* An engine made for a case. */
typedef struct contract_way {
    const contract_case *what;
    const ps_engine *engine;
    ps_precision precision;
    ps_device *device;
    ps_frequencies frequencies;
    ps_problem problem; /* in the units of the engine */
    pspec_pattern sets[CONTRACT_SETS];
    const double *expected; /* powers of all sets in one batch */
    const char *law;        /* for what is said when it fails */
} contract_way;

typedef void contract_law(const contract_way *way);
typedef struct contract_named_law {
    const char *name;
    contract_law *law;
} contract_named_law;

/* Every case by every engine in every precision that takes it: the law is called. Returns how many
 * times. engine: NULL: every one. */
size_t contract_walk(ps_device *device, const ps_engine *engine, contract_law *law);

/* The same sets by engines made with other problems, in batches: powers of [set][frequency], freed
 * by the caller. */
double *contract_powers(const contract_way *way, const ps_problem *problem,
                        const pspec_pattern *patterns, size_t num, size_t batch);
/* For batches of all sets; the caller destroys it. */
void *contract_state(const contract_way *way);
/* (L + 1)(L + 2) or pairs for each frequency, freed by the caller; powers beside them unless
 * NULL. */
double *contract_coefficients(const contract_way *way, void *state, const pspec_pattern *set,
                              double *powers);
/* The power of frequency or degree i, of coefficients. */
double contract_power_of(const contract_way *way, const double *c, size_t i);
/* Error of a set whose powers are `found`, in the units of the problem, against sums in extended
 * precision; and what the engine announces for it. */
double contract_error(const contract_way *way, void *state, const pspec_pattern *set,
                      const double *found, double *bound);
size_t contract_row_bytes(const contract_way *way);
/* Of buffers that there are, and the most there were since this was set. */
extern double contract_bytes, contract_most_bytes;
/* The test fails where bits of num rows differ; found is freed. */
void contract_check_rows(const contract_way *way, const char *what, size_t num, double *found,
                         const double *expected);
#define CONTRACT_FAIL(way, format, ...)                                                            \
    fail_msg("%s, %s, %s, %s: " format, (way)->law, (way)->engine->name,                           \
             ps_precision_name((way)->precision), (way)->what->name, __VA_ARGS__)

#endif
