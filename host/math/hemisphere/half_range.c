#include "math/hemisphere/half_range.h"

#include "base/memory.h"
#include "math/gauss_legendre.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* sqrt(2l+1) P_l(x), l = 0 .. max_degree. */
static void fill_legendre(size_t max_degree, double x, double *values) {
    double before = 0;
    double value = 1;
    for (size_t l = 0; l <= max_degree; l++) {
        const double degree = (double)l;
        values[l] = sqrt(2 * degree + 1) * value;
        const double next = ((2 * degree + 1) * x * value - degree * before) / (degree + 1);
        before = value;
        value = next;
    }
}

static void add_node(size_t max_from, size_t max_to, double factor, const double *from_values,
                     const double *to_values, double *matrix) {
    for (size_t i = 0; i <= max_from; i++) {
        double *const row = matrix + i * (max_to + 1);
        const double left = factor * from_values[i];
        for (size_t l = i; l <= max_to; l++) { /* 0 before */
            row[l] += left * to_values[l];
        }
    }
}

pspec_status ps_half_range_matrix(size_t max_from, size_t max_to, double *matrix, ps_error *error) {
    const size_t num_nodes = (max_from + max_to) / 2 + 1;
    double *nodes = NULL;
    PS_TRY(PS_NEW(&nodes, 2 * num_nodes + max_from + max_to + 2, "hemispherical harmonics", error));
    double *const weights = nodes + num_nodes;
    double *const from_values = weights + num_nodes;
    double *const to_values = from_values + max_from + 1;
    ps_gauss_legendre(num_nodes, nodes, weights);
    memset(matrix, 0, (max_from + 1) * (max_to + 1) * sizeof *matrix);
    for (size_t i = 0; i < num_nodes; i++) {
        fill_legendre(max_from, 2 * nodes[i] - 1, from_values);
        fill_legendre(max_to, nodes[i], to_values);
        add_node(max_from, max_to, weights[i] * sqrt(0.5), from_values, to_values, matrix);
    }
    free(nodes);
    return PSPEC_OK;
}
