/* What a job is planned once more for, when its powers were measured. */
#ifndef PS_PLAN_REPLAN_H
#define PS_PLAN_REPLAN_H

#include <stdint.h>

/* The largest of all realizations, as members of ps_problem and ps_accuracy. */
typedef struct ps_replan {
    uint64_t num; /* of the plan; 0: it is the first, which nothing was measured for */
    double mean_power, weight_share;
    uint64_t num_points;
} ps_replan;

/* The second plan has powers and points; one more, should another engine measure larger ones. */
enum { PS_MOST_REPLANS = 2 };

#endif
