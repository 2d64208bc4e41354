#include "engines/sphere/sphere_layout.h"

#include "base/round.h"

#include <math.h>

/* Rows of power kernels are whole vectors, and the last block of degrees may reach behind L. */
enum { ROW_UNIT = 16 };

/* Sums and table of a pass, for one realization: all orders to L = 2000 in single precision. Larger
 * ones would only take memory: a pass costs nothing but its table, which is made anew for every
 * batch then. */
static const double pass_bytes = 64.0 * 1024 * 1024;

/* Points of a slab at most: 50 bytes each. */
enum { SLAB_CHUNKS = 256 };

/* Harmonics of a slab and a pass, as far as a slab has several chunks: nothing stops a kernel, and
 * these take two cores about a second (3e9 to 9e9 in a second, docs/engines/sphere_direct.md). */
static const double launch_harmonics = 4e9;

/* Numbers of a point on the device: of its direction and its weight; besides, its azimuth. */
enum { REALS_PER_POINT = PS_SPHERE_ARRAYS + 1 };

static size_t find_pass_orders(const ps_sphere_layout *layout) {
    const double order_bytes =
        (double)layout->real_bytes *
        ((double)(PS_SPHERE_SUMS * layout->stride) +
         (double)(ps_sphere_blocks(layout->max_degree, 0) * PS_SPHERE_BLOCK_REALS));
    const size_t all = (size_t)layout->max_degree + 1;
    const size_t fit = (size_t)(pass_bytes / order_bytes) / PS_SPHERE_ORDERS * PS_SPHERE_ORDERS;
    const size_t orders = fit > 0 ? fit : PS_SPHERE_ORDERS;
    return orders < all ? orders : all;
}

/* Whole chunks, so that sums do not depend on where slabs begin. */
static size_t find_slab(const ps_sphere_layout *layout, uint64_t num_points) {
    const double point_harmonics = (double)layout->pass_orders * ((double)layout->max_degree + 1);
    const double fit = launch_harmonics / point_harmonics / PS_SPHERE_CHUNK;
    const double chunks = fit < SLAB_CHUNKS ? floor(fit) : SLAB_CHUNKS;
    const uint64_t most = (uint64_t)fmax(chunks, 1) * PS_SPHERE_CHUNK;
    return ps_round_up(num_points < most ? num_points : most, ROW_UNIT);
}

static void count_bytes(ps_sphere_layout *layout) {
    const double real_bytes = (double)layout->real_bytes;
    const double sums =
        (double)(layout->pass_orders * layout->stride * PS_SPHERE_SUMS) * real_bytes;
    const double powers = (double)(layout->stride * PS_SPHERE_POWERS) * real_bytes;
    const double points = (double)layout->slab * (REALS_PER_POINT * real_bytes + sizeof(uint64_t));
    const double table = (double)(layout->pass_blocks * PS_SPHERE_BLOCK_REALS) * real_bytes +
                         (double)(layout->pass_orders * sizeof(uint32_t));
    layout->largest_buffer = table;
    layout->fixed_bytes = 2 * table; /* on the host, too */
    layout->bytes_per_realization = sums + (1 + PS_READINGS) * powers + points;
    layout->coordinate_bytes = (double)layout->slab * PS_SPHERE_DIMENSION * sizeof(double);
    layout->point_bytes = layout->coordinate_bytes + (double)layout->slab * sizeof(double);
    layout->largest_buffer_per_realization = fmax(sums, points + layout->coordinate_bytes);
}

ps_sphere_layout ps_sphere_layout_make(const ps_problem *problem, const ps_device_limits *limits,
                                       ps_precision precision) {
    const uint64_t points = problem->num_points > 0 ? problem->num_points : 1;
    ps_sphere_layout layout = {.max_degree = problem->frequencies->max_frequency,
                               .only_even = problem->frequencies->degree_step == 2,
                               .precision = precision,
                               .lanes = ps_engine_lanes(limits, precision),
                               .prepare_lanes = ps_engine_lanes(limits, PS_DOUBLE),
                               .real_bytes =
                                   precision == PS_SINGLE ? sizeof(float) : sizeof(double)};
    const bool is_gpu = limits->has_dedicated_local_memory;
    layout.group_items = is_gpu ? PS_SPHERE_GPU_ITEMS : 1;
    layout.group_orders = is_gpu ? PS_SPHERE_GPU_ORDERS : PS_SPHERE_ORDERS;
    layout.prepare_lanes =
        layout.prepare_lanes < layout.lanes ? layout.prepare_lanes : layout.lanes;
    layout.stride = ps_round_up((uint64_t)layout.max_degree + 1 + PS_SPHERE_DEGREES, ROW_UNIT);
    layout.pass_orders = find_pass_orders(&layout);
    layout.num_passes = ps_divide_up((uint64_t)layout.max_degree + 1, layout.pass_orders);
    layout.pass_blocks = ps_sphere_all_blocks(layout.max_degree, 0, layout.pass_orders, NULL);
    layout.slab = find_slab(&layout, points);
    count_bytes(&layout);
    return layout;
}

size_t ps_sphere_pass_orders(const ps_sphere_layout *layout, size_t pass) {
    const size_t first = pass * layout->pass_orders;
    const size_t rest = (size_t)layout->max_degree + 1 - first;
    return rest < layout->pass_orders ? rest : layout->pass_orders;
}
