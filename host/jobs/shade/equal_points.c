#include "jobs/shade/shade_job.h"
#include "rules/truncation.h"

#include <math.h>
#include <stdlib.h>

typedef struct fibonacci {
    const ps_light *light;
    const ps_quadrature_question *rules;
    pspec_pattern pattern;
} fibonacci;

static pspec_status give(void *payload, uint64_t realization, pspec_pattern *out, bool *has_set,
                         ps_error *error) {
    (void)error;
    *out = ((const fibonacci *)payload)->pattern;
    *has_set = realization == 0;
    return PSPEC_OK;
}

/* (Q5) of the pattern: nothing is moved. */
static pspec_status predict(fibonacci *self, double *out, ps_error *error) {
    static const char *const name = "points";
    const double tolerance = 1e-10; /* of E^2, as `quadrature` has it */
    ps_given_set given = {.name = name, .next = give, .payload = self, .num = 1};
    ps_quadrature_question rules = *self->rules;
    ps_shade_job shade; /* has nothing to free: it measures nothing */
    ps_quadrature_job *job = NULL;
    rules.paths = &name;
    rules.num_paths = 1;
    rules.point_options = (ps_point_options){.domain = PS_DOMAIN_SPHERE, .given = {&given, 1}};
    rules.max_degree = self->light->max_degree;
    rules.accuracy.tolerance = tolerance;
    rules.limits.constraints.precision = -1;
    rules.limits.constraints.engine = self->rules->open_device != NULL ? NULL : "host_direct";
    PS_TRY(ps_shade_job_make(&shade, self->light, 0, 0, &rules, error));
    PS_TRY(ps_quadrature_job_create(&job, &rules, error));
    const pspec_status status = ps_quadrature_job_run(job, error);
    *out = sqrt(shade.predicted.mean);
    ps_quadrature_job_destroy(job);
    return status;
}

static pspec_status find_error(void *payload, size_t num_points, double *out, ps_error *error) {
    fibonacci *const self = payload;
    double *points = NULL;
    PS_TRY(ps_fibonacci_rule(&points, num_points, ps_brdf_morph(self->rules->brdf), error));
    self->pattern = (pspec_pattern){PS_SPHERE_DIMENSION, num_points, points, NULL};
    const pspec_status status = predict(self, out, error);
    free(points);
    return status;
}

pspec_status ps_shade_equal_points(const ps_light *light, const ps_quadrature_question *rules,
                                   const double *errors, size_t num, double *points,
                                   ps_error *error) {
    ps_quadrature_question silent = *rules;
    fibonacci self = {.light = light, .rules = &silent};
    ps_equal_error equal = {.error_of = find_error, .payload = &self};
    const bool has_rule = ps_brdf_morph(rules->brdf).kind != PS_MORPH_NONE;
    silent.watch = (ps_watch){0};
    for (size_t l = 0; l < num; l++) {
        points[l] = NAN;
        PS_TRY(ps_watch_tell(&rules->watch, "degrees", l, num, NULL, error));
        if (has_rule && errors[l] > 0) {
            PS_TRY(ps_equal_error_points(&equal, errors[l], &points[l], error));
        }
    }
    return PSPEC_OK;
}
