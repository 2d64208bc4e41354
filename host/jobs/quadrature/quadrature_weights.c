/* How optimal weights are made, in words. */
#include "rules/kernel/kernel_product.h"
#include "jobs/quadrature/quadrature_rules.h"

#include <stdio.h>

void ps_rules_plan_weights(const ps_quadrature_question *question, size_t num_points,
                           const ps_device *device, char *text, size_t size) {
    const uint64_t limit = question->limits.constraints.memory_limit;
    const double dense = (double)ps_kernel_system_bytes(num_points, true);
    const double sparse = (double)ps_kernel_system_bytes(num_points, false);
    text[0] = '\0';
    if (question->weights.kind != PS_WEIGHTS_OPTIMAL) {
        return;
    }
    if (ps_kernel_system_is_dense(num_points, limit)) {
        snprintf(text, size, "optimal, by Cholesky; a matrix of %zu x %zu, %.4g bytes", num_points,
                 num_points, dense);
        return;
    }
    snprintf(text, size,
             "optimal, by conjugate gradients with products %s, %.4g bytes; a matrix would take "
             "%.4g bytes, and %s",
             ps_kernel_product_is_possible(device) ? "on the device" : "in threads", sparse, dense,
             num_points > PS_KERNEL_MOST_DENSE ? "matrices are made for 20000 points and fewer"
                                               : "--memory is less");
}

void ps_rule_facts_name_weights(const ps_rule_facts *facts, char *text, size_t size) {
    if (facts->most_steps == 0) {
        snprintf(text, size, "Cholesky");
        return;
    }
    snprintf(text, size, "%sconjugate gradients, %zu steps to a residual of %.2g, at most",
             facts->has_matrices ? "Cholesky, and " : "", facts->most_steps,
             facts->largest_residual);
}
