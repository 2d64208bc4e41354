#include "jobs/quadrature/quadrature_job.h"

#include "jobs/point_phases.h"
#include "jobs/spectrum/power_phases.h"
#include "plan/cost_model.h"
#include "rules/distance_split.h"
#include "rules/kernel/kernel_product.h"

#include <math.h>

/* Conjugate gradients take 10 to 18 steps for most sets, 34 to 43 where s is near its limits
 * (docs/user/quadrature.md). */
static const double most_steps = 18, most_steps_of_powers = 43;

static bool needs_powers(double smoothness) {
    return smoothness != 1.5;
}

/* Of a sum with a power of every distance; other sums take ps_cost_rule_seconds. */
static const double power_seconds = 4e-9;

/* Of a pair on a GPU, which has each of them twice: 40 operations in double precision, roots most
 * of them, at a third of the peak of an H200; counted, not measured. */
static const double gpu_pair_seconds = 4e-12;

void ps_phases_lobe(ps_phases *phases, const ps_representer *representer) {
    const double tries = 3; /* degrees grow by half until they are enough: 1 + 2/3 + 4/9 + .. */
    const double coefficient_seconds = 3.5e-8;
    ps_phases_add(phases, "lobe", tries * (double)representer->max_degree * coefficient_seconds);
    ps_phases_say(phases, "lobe", "%zu coefficients", representer->max_degree + 1);
}

void ps_phases_kappa(ps_phases *phases, const char *name, double points, double terms,
                     double sets) {
    ps_phases_share(phases, name, points * terms, ps_cost_rule_seconds(0, 1), sets);
}

void ps_phases_distances(ps_phases *phases, const char *name, double smoothness, double distances,
                         double sets) {
    ps_phases_share(phases, name, distances,
                    needs_powers(smoothness) ? power_seconds : ps_cost_rule_seconds(1, 0), sets);
}

/* Realizations that are made; of files as many as their size suggests. */
static double add_points(const ps_quadrature_setup *setup, const ps_quadrature_question *question,
                         ps_phases *phases) {
    const double each = (double)setup->problem.num_points;
    const double planned = (double)setup->planned_realizations;
    if (question->sampler != NULL) {
        const ps_sets_options sets = ps_limits_sets(&question->limits, question->accuracy.no_skip);
        ps_phases_sample(phases, question->sampler, planned > 0 ? planned : 1, &sets);
        return planned > 0 ? planned : 1;
    }
    const double points =
        ps_phases_read(phases, question->paths, question->num_paths, &question->point_options, 3);
    return fmax(1, nearbyint(points / each));
}

/* The factor of the kernel matrix and its entries; or conjugate gradients, where one step is a
 * product, and so are the condition, the residual and what the kernel form does. */
void ps_phases_kernel_system(ps_phases *phases, const char *name, double smoothness, double points,
                             double solutions, bool is_dense, const ps_device *device,
                             double sets) {
    const double operation_seconds = 1.25e-11; /* of the factor */
    const double entry_seconds = 25e-9;        /* made, summed, and solved with */
    const double product_seconds = 0.8e-9;     /* a pair, in a product by the device */
    const double others = 3;                   /* products */
    const double factor_seconds = 6e-9;        /* a pair, in what makes steps few, by the host */
    const bool powers = needs_powers(smoothness);
    const double square = points * points;
    if (is_dense) {
        ps_phases_share(phases, name, square,
                        points / 3 * operation_seconds + solutions * entry_seconds, sets);
        ps_phases_say(phases, name, "Cholesky of %.6g x %.6g", points, points);
    } else {
        const double steps = powers ? most_steps_of_powers : most_steps;
        const double products = (solutions * steps + others) * square;
        if (ps_kernel_product_is_on_gpu(device)) {
            ps_phases_add(phases, name, sets * products * gpu_pair_seconds);
            ps_phases_share(phases, name, square, factor_seconds, sets);
        } else {
            ps_phases_share(phases, name, products, powers ? power_seconds : product_seconds, sets);
        }
        ps_phases_say(phases, name, "conjugate gradients, %g steps", steps);
        ps_phases_limit(phases, name);
    }
}

/* The sum of the weights is imposed by a second system of equations. */
static void add_weights(const ps_quadrature_question *question, double points, double sets,
                        const ps_device *device, ps_phases *phases) {
    const bool is_dense = ps_kernel_system_is_dense((size_t)points, ps_kernel_most_dense(device),
                                                    question->limits.constraints.memory_limit);
    ps_phases_kernel_system(phases, "weights", question->smoothness, points,
                            question->weights.sum_to_one ? 2 : 1, is_dense, device, sets);
}

static void add_rules(const ps_quadrature_setup *setup, const ps_quadrature_question *question,
                      double sets, ps_phases *phases) {
    const double points = (double)setup->problem.num_points;
    const double terms = (double)setup->representer.num_terms;
    ps_phases_kappa(phases, "kappa", points, terms, sets);
    ps_phases_say(phases, "kappa", "%.4g points, %.4g terms", sets * points, terms);
    if (question->weights.kind == PS_WEIGHTS_OPTIMAL) {
        add_weights(question, points, sets, setup->device, phases);
    }
    const double distances =
        setup->num_distances > 0 ? setup->num_distances : ps_distance_count(points);
    if (question->weights.kind != PS_WEIGHTS_OPTIMAL &&
        ps_kernel_distances_pay(setup->device, setup->problem.num_points)) {
        ps_phases_add(phases, "worst-case error", sets * points * points * gpu_pair_seconds);
    } else {
        ps_phases_distances(phases, "worst-case error", question->smoothness, distances, sets);
    }
    ps_phases_say(phases, "worst-case error", "%.4g distances of pairs of points, %.3g bytes",
                  sets * distances, (double)ps_distance_bytes(setup->problem.num_points));
}

double ps_quadrature_job_phases(const ps_quadrature_job *job, ps_phases *phases) {
    const ps_quadrature_setup *const setup = &job->setup;
    const ps_candidate *const chosen = setup->plan.chosen;
    const ps_device_limits *const limits = ps_device_get_limits(setup->device);
    ps_phases_start(phases, chosen, limits);
    /* coefficients come by another build of the engine's last kernel */
    ps_phases_load_programs(phases, chosen != NULL && !setup->by_pairs ? 1 : 0);
    ps_phases_lobe(phases, &setup->representer);
    const double sets = add_points(setup, job->question, phases);
    const double planned = (double)setup->problem.num_realizations;
    const double repeats = planned > 0 ? 1 : sets;
    add_rules(setup, job->question, sets, phases);
    if (chosen != NULL) {
        const double points = (double)setup->problem.num_points;
        const ps_phases_load load = {.seconds = chosen->seconds * repeats,
                                     .coordinates = sets * points * PS_SPHERE_DIMENSION,
                                     .bytes = (double)ps_distance_bytes(setup->problem.num_points)};
        ps_phases_run(phases, chosen, limits, &load);
    }
    if (setup->by_pairs) {
        ps_phases_sum_zonal(phases, sets * (double)setup->problem.num_points,
                            (double)setup->max_degree);
        ps_phases_say(phases, "averages", "zonal sums");
    }
    ps_phases_tabulate(phases, (double)setup->max_degree);
    if (job->question->observer.add_phases != NULL) {
        job->question->observer.add_phases(job->question->observer.payload, job, phases);
    }
    return repeats;
}
