#include "jobs/spectrum/power_phases.h"

#include "engines/error_units.h"
#include "jobs/point_phases.h"
#include "jobs/self_check.h"
#include "jobs/spectrum/power_job_private.h"
#include "plan/cost_model.h"
#include "spectra/phases/shift_products.h"
#include "spectra/phases/turn_products.h"

#include <math.h>
#include <string.h>

/* ---- beginning ----------------------------------------------------------------------------- */

/* Its bit among those whose kernels are loaded. */
static unsigned bit_of(const ps_engine *engine) {
    unsigned index = 0;
    while (ps_engines[index] != engine && ps_engines[index] != NULL) {
        index++;
    }
    return 1U << index;
}

static const char start_name[] = "start";

void ps_phases_load_programs(ps_phases *phases, double programs) {
    const double seconds_of_one = 34e-3; /* PoCL's preprocessor, whatever the text is */
    ps_phases_add(phases, start_name, programs * seconds_of_one);
}

/* Each once in a process. */
void ps_phases_start(ps_phases *phases, const ps_candidate *chosen,
                     const ps_device_limits *limits) {
    const double program_seconds = 2.2e-3;
    const double driver_seconds = 32e-3; /* OpenCL's libraries, and its compiler's */
    const double gpu_seconds = 0.2;      /* what pairs of 100 small sets took more on an H200 */
    ps_begun first = {false, false, 0};
    ps_begun *const begun = phases->begun != NULL ? phases->begun : &first;
    ps_phases_add(phases, start_name, begun->program ? 0 : program_seconds);
    begun->program = true;
    ps_phases_say(phases, start_name, "libraries");
    if (chosen != NULL && chosen->engine->needs_device) {
        const unsigned bit = bit_of(chosen->engine);
        const bool is_there = (begun->engines & bit) != 0;
        const bool is_gpu = limits->has_dedicated_local_memory;
        ps_phases_add(phases, start_name,
                      begun->driver ? 0 : driver_seconds + (is_gpu ? gpu_seconds : 0));
        ps_phases_load_programs(phases, is_there ? 0 : chosen->programs);
        ps_phases_say(phases, start_name, "driver and kernels, which the driver's cache has");
        begun->driver = true;
        begun->engines |= bit;
    }
}

/* Whether a candidate's memory is not that of the host. */
static bool has_own_memory(const ps_candidate *chosen, const ps_device_limits *limits) {
    return chosen->engine->needs_device && !limits->is_cpu && !limits->has_unified_memory;
}

/* On an H200 a coordinate took the host 4 ns
 * more than kernels, about half of it on its way: cuFINUFFT's, as they are, went at 6 GB/s. */
void ps_phases_run(ps_phases *phases, const ps_candidate *chosen, const ps_device_limits *limits,
                   const ps_phases_load *load) {
    static const char name[] = "transfer";
    const double coordinate_seconds = 2.5e-9;
    const double bytes_per_second = 6e9;
    const double bytes = load->coordinates * sizeof(uint64_t);
    (chosen->engine->needs_device ? ps_phases_add_seconds : ps_phases_add)(phases, "powers",
                                                                           load->seconds);
    ps_phases_say(phases, "powers", "%s in %s precision", chosen->engine->name,
                  ps_precision_name(chosen->precision));
    if (has_own_memory(chosen, limits)) {
        ps_phases_add(phases, name, load->coordinates * coordinate_seconds);
        ps_phases_add_seconds(phases, name,
                              bytes / ps_figures_sent_bytes(limits->figures, bytes_per_second));
        ps_phases_say(phases, name, "%.3g bytes to the device", bytes);
    }
    ps_phases_touch(phases, (has_own_memory(chosen, limits) ? chosen->host_bytes : chosen->bytes) +
                                load->bytes);
}

/* ---- parts --------------------------------------------------------------------------------- */

/* Realizations, and points of all of them. */
typedef struct amounts {
    double sets, points;
} amounts;

static amounts add_points(const ps_power_job *job, ps_phases *phases) {
    const ps_power_question *const question = job->question;
    const double each = job->num_points > 0 ? (double)job->num_points : 1;
    const double checked_seconds = 20e-9; /* of a point */
    amounts out;
    if (question->sampler != NULL) {
        out.sets = job->problem.num_realizations > 0 ? (double)job->problem.num_realizations : 1;
        out.points = out.sets * each;
        const ps_sets_options sets = ps_limits_sets(&question->limits, question->accuracy.no_skip);
        if (!ps_power_job_leaves_points(job)) { /* a GPU makes them in no time */
            ps_phases_sample(phases, &job->request, out.sets, &sets);
        }
    } else {
        const bool has_weights = job->sets.next.has_weights;
        out.points =
            ps_phases_read(phases, question->paths, question->num_paths, &question->point_options,
                           job->dimension + (has_weights ? 1 : 0));
        out.sets = question->num_sets > 0 ? (double)question->num_sets
                                          : fmax(1, nearbyint(out.points / each));
        out.points = out.sets * each;
    }
    const bool is_checked =
        (question->on_sphere || job->problem.has_weights) && !ps_power_job_leaves_points(job);
    ps_phases_add(phases, "points", is_checked ? out.points * checked_seconds : 0);
    return out;
}

static void add_frequencies(const ps_power_job *job, ps_phases *phases) {
    static const char name[] = "frequencies";
    const ps_frequencies *const set = &job->frequencies;
    const double num = (double)set->num;
    const double listed_seconds = 300e-9;  /* of one of a random subset */
    const double lattice_seconds = 20e-9;  /* of one of a grid: its bin and its mean */
    const double counted_seconds = 0.3e-9; /* of a step of counting the points of rings */
    if (set->kind == PS_FREQUENCIES_DEGREES) {
        return;
    }
    ps_phases_add(phases, name,
                  num * (set->kind == PS_FREQUENCIES_LIST ? listed_seconds : lattice_seconds));
    if (job->question->frequencies.per_ring >
        0) { /* rings are counted axis by axis: frequencies/frequency_sample.h */
        const double k = set->max_frequency;
        ps_phases_add(phases, name, job->dimension * k * k * k * counted_seconds);
    }
    ps_phases_say(phases, name, "%.4g of them, and their rings", num);
}

/* Of large sets the engine makes powers of the beginning, too: as long as its share of what all
 * points take. */
static double beginning_seconds(const ps_power_job *job) {
    const ps_candidate *const chosen = job->plan.chosen;
    if (chosen == NULL || !chosen->engine->needs_device ||
        job->problem.num_points <= PS_SELF_CHECK_POINTS) {
        return 0;
    }
    const ps_device_limits *const limits = ps_device_get_limits(job->device);
    ps_problem all = ps_engine_problem(chosen->engine, &job->problem);
    all.planned_points = (uint64_t)ps_planned_points(&all);
    ps_problem beginning = all;
    beginning.num_points = PS_SELF_CHECK_POINTS;
    const ps_survey whole = chosen->engine->survey(&all, limits, chosen->precision);
    const ps_survey part = chosen->engine->survey(&beginning, limits, chosen->precision);
    return whole.why_not != NULL || part.why_not != NULL
               ? 0
               : chosen->seconds * ps_cost_typical(&part.work, limits, chosen->precision) /
                     ps_cost_typical(&whole.work, limits, chosen->precision);
}

static void add_check(const ps_power_job *job, ps_phases *phases) {
    const double degree_seconds = 20e-9; /* a point, a degree and an order */
    const double phase_seconds = ps_cost_seconds(&(ps_work){.phases = 1}, NULL, PS_EXTENDED);
    bool is_of_degrees = false;
    if (job->question->accuracy.no_self_check) {
        return;
    }
    const double terms = ps_self_check_count(&job->frequencies, job->num_points, &is_of_degrees);
    const double steps = is_of_degrees ? PS_SELF_CHECK_DEGREE_STEPS : PS_SELF_CHECK_STEPS;
    ps_phases_share(phases, "self-check", terms * steps,
                    (is_of_degrees ? degree_seconds : phase_seconds) / steps, 1);
    ps_phases_add_seconds(phases, "self-check", beginning_seconds(job));
    ps_phases_say(phases, "self-check", "%.3g terms in long double", terms);
}

void ps_phases_sum_zonal(ps_phases *phases, double points, double degrees) {
    const double term_seconds = 1e-9;
    ps_phases_share(phases, "averages", points * degrees, term_seconds, 1);
}

/* Powers of realizations, by the host or, on a GPU, by kernels that read them twice: 429 million
 * took a prototype that reads them once 0.6 ms on an H200. */
static void add_averages(const ps_power_job *job, const amounts *amount, ps_phases *phases) {
    const double num = (double)job->frequencies.num;
    const double power_seconds = 0.5e-9, gpu_power_seconds = 4e-12;
    const ps_candidate *const chosen = job->plan.chosen;
    if (chosen != NULL && chosen->engine->needs_device && !chosen->engine->rows_on_host &&
        ps_device_get_limits(job->device)->has_dedicated_local_memory) {
        ps_phases_add_seconds(phases, "averages", num * amount->sets * gpu_power_seconds);
    } else {
        ps_phases_share(phases, "averages", num * amount->sets, power_seconds, 1);
    }
    if (job->question->wants_pair_sums) {
        ps_phases_sum_zonal(phases, amount->points, job->frequencies.max_frequency);
    }
    ps_phases_say(phases, "averages", "%.4g powers of %.4g realizations", num, amount->sets);
}

static void add_products(const ps_power_job *job, double sets, ps_phases *phases) {
    static const char name[] = "phases";
    const ps_frequencies *const set = &job->frequencies;
    const bool on_sphere = job->question->on_sphere;
    const double shift_seconds = 85e-9; /* a number of a grid */
    const double turn_seconds = 3.3e-9; /* a node, a degree and an order */
    if (!job->question->keeps_sets) {
        return;
    }
    const double steps =
        on_sphere ? ps_turn_products_steps(set->max_frequency) : ps_shift_products_cells(set);
    ps_phases_add(phases, name, steps * sets * (on_sphere ? turn_seconds : shift_seconds));
    ps_phases_say(phases, name, "products of %.4g coefficients of %.4g realizations",
                  (double)ps_num_coefficients_at(set) / 2, sets);
}

/* The whole array has its corners and both signs. */
static void add_results(const ps_power_job *job, ps_phases *phases) {
    const ps_power_question *const question = job->question;
    const double k = job->frequencies.max_frequency;
    const double number_seconds = 60e-9; /* of an array in a file */
    ps_phases_tabulate(phases, k);
    if (question->wants_full_array && !question->on_sphere) {
        ps_phases_add(phases, "results", pow(2 * k + 1, job->dimension) * number_seconds);
    }
    if (question->harmonics != PS_NO_HARMONICS) {
        ps_phases_add(phases, "results", (k + 1) * (k + 2) / 2 * number_seconds);
    }
    ps_phases_say(phases, "results", "tables and arrays");
}

/* Seconds beside those of the engine, which is measured on sets that stay in caches; these do not,
 * where they lie in no order (measured: 1e6 white points of the sphere, L = 64 .. 1000; on the
 * torus there is no such difference). */
static double scatter_seconds(const ps_power_job *job, const amounts *amount) {
    const double point_seconds = 200e-9;
    enum { MANY_POINTS = 1 << 18, MANY_DEGREES = 300 };
    const bool is_large = job->question->on_sphere && job->num_points >= MANY_POINTS &&
                          job->frequencies.max_frequency >= MANY_DEGREES;
    return is_large && job->plan.chosen->engine->needs_device &&
                   !ps_device_get_limits(job->device)->has_dedicated_local_memory
               ? amount->points * point_seconds
               : 0;
}

double ps_power_job_phases(const ps_power_job *job, ps_phases *phases) {
    const ps_candidate *const chosen = job->plan.chosen;
    const bool is_known = job->problem.num_realizations > 0;
    const ps_device_limits *const limits = ps_device_get_limits(job->device);
    ps_phases_start(phases, chosen, limits);
    const amounts all = add_points(job, phases);
    const double repeats = is_known ? 1 : all.sets;
    add_frequencies(job, phases);
    if (chosen != NULL) {
        const ps_phases_load load = {
            .seconds = chosen->seconds * repeats,
            .coordinates = ps_power_job_leaves_points(job) ? 0 : all.points * job->dimension};
        ps_phases_run(phases, chosen, limits, &load);
        ps_phases_add(phases, "powers", scatter_seconds(job, &all));
    }
    add_averages(job, &all, phases);
    add_check(job, phases);
    add_products(job, all.sets, phases);
    add_results(job, phases);
    return repeats;
}
