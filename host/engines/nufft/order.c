#include "engines/nufft/order.h"

#include "base/round.h"
#include "device/reals.h"
#include "engines/nufft/axis.h"
#include "nufft/numbers.h"

/* ---- sizes ------------------------------------------------------------------------------- */

/* Digits that kernels/nufft/order.cl sorts tiles by. */
enum { DIGITS = 16 };

/* Tiles fill 48 KB of local memory, whose places fit into ORDER_PLACE_BITS; a group of fewer items
 * than two of NVIDIA's warps leaves a multiprocessor idle, however small its tile. */
enum { MOST_TILE = 1 << ORDER_PLACE_BITS, LEAST_TILE = 64, LEAST_WORKERS = 64 };

/* Bits beside a place in 32. */
enum { MOST_DIRECT_BITS = 32 - ORDER_PLACE_BITS };

/* Room for n numbers with gaps: AT of order.cl. */
static size_t with_gaps(size_t n) {
    return n + n / DIGITS;
}

static uint32_t workers_of(uint32_t tile) {
    return tile / DIGITS > LEAST_WORKERS ? tile / DIGITS : LEAST_WORKERS;
}

/* Local memory of order_tiles, argument by argument. */
typedef struct tile_local {
    size_t data, counters, tops;
} tile_local;

static tile_local local_of(uint32_t tile) {
    const size_t workers = workers_of(tile);
    return (tile_local){.data = 2 * with_gaps(tile) * sizeof(uint32_t),
                        .counters = with_gaps(DIGITS * workers) * sizeof(uint16_t),
                        .tops = with_gaps(workers) * sizeof(uint16_t)};
}

static bool fits(uint32_t tile, const ps_device_limits *limits) {
    const tile_local local = local_of(tile);
    return local.data + local.counters + local.tops <= limits->local_bytes;
}

static uint32_t choose_tile(const ps_device_limits *limits, size_t most_points) {
    uint32_t tile = MOST_TILE;
    while (tile > LEAST_TILE && (!fits(tile, limits) || tile / 2 >= most_points)) {
        tile /= 2;
    }
    return tile;
}

static uint32_t bits_of(uint32_t num) {
    uint32_t bits = 0;
    while (bits < 32 && num >> bits != 0) {
        bits++;
    }
    return bits;
}

/* Digits have at most twice as many values as tiles have keys: a row of them then takes less than
 * what another digit would read and write of the points. */
static void choose_digits(ps_nufft_order_sizes *sizes, uint32_t num_keys) {
    const uint32_t bits = bits_of(num_keys - 1);
    sizes->is_direct = sizes->tiles == 1 && bits <= MOST_DIRECT_BITS;
    const uint32_t most = sizes->is_direct ? MOST_DIRECT_BITS : bits_of(sizes->tile);
    sizes->num_digits = bits > most ? (uint32_t)ps_divide_up(bits, most) : 1;
    sizes->digit_bits = (uint32_t)ps_divide_up(bits, sizes->num_digits);
    sizes->row = sizes->is_direct         ? sizes->starts_row
                 : sizes->num_digits == 1 ? num_keys + 1
                                          : (1U << sizes->digit_bits) + 1;
}

ps_nufft_order_sizes ps_nufft_order_measure(const ps_device_limits *limits, size_t most_points,
                                            uint32_t num_keys, uint32_t starts_row) {
    ps_nufft_order_sizes sizes = {.starts_row = starts_row, .points = most_points};
    if (limits->has_dedicated_local_memory) {
        sizes.tile = choose_tile(limits, most_points);
        sizes.workers = workers_of(sizes.tile);
        sizes.tiles = most_points > 0 ? (uint32_t)ps_divide_up(most_points, sizes.tile) : 1;
        choose_digits(&sizes, num_keys);
    }
    return sizes;
}

static size_t num_orders(const ps_nufft_order_sizes *sizes) {
    return sizes->is_direct ? 1 : sizes->num_digits == 1 ? 2 : 3;
}

static uint64_t firsts_bytes(const ps_nufft_order_sizes *sizes) {
    return sizes->is_direct ? 0 : (uint64_t)sizes->tiles * sizes->row * sizeof(uint32_t);
}

static uint64_t sums_bytes(const ps_nufft_order_sizes *sizes) {
    return sizes->is_direct ? 0 : (uint64_t)ORDER_SEGMENTS * sizes->row * sizeof(uint32_t);
}

uint64_t ps_nufft_order_bytes(const ps_nufft_order_sizes *sizes) {
    return sizes->tile == 0 ? 0
                            : (1 + num_orders(sizes)) * sizes->points * sizeof(uint32_t) +
                                  firsts_bytes(sizes) + sums_bytes(sizes);
}

uint64_t ps_nufft_order_largest(const ps_nufft_order_sizes *sizes) {
    const uint64_t firsts = firsts_bytes(sizes), sums = sums_bytes(sizes);
    return sizes->tile == 0 ? 0 : firsts > sums ? firsts : sums;
}

double ps_nufft_order_launches(const ps_nufft_order_sizes *sizes) {
    enum { KEYS_TILES_MOVE = 3, KEYS_START_MOVE = 3, OF_DIGIT = 4 };
    return sizes->tile == 0   ? 1
           : sizes->is_direct ? KEYS_TILES_MOVE
                              : KEYS_START_MOVE + (double)OF_DIGIT * sizes->num_digits;
}

/* ---- create ------------------------------------------------------------------------------ */

static pspec_status create_kernels(ps_nufft_order *self, unsigned dimension, ps_precision precision,
                                   ps_error *error) {
    const struct {
        ps_kernel **kernel;
        const char *name;
    } wanted[] = {{&self->tiles, "order_tiles"},  {&self->segments, "order_segments"},
                  {&self->sum, "order_sums"},     {&self->scatter, "order_scatter"},
                  {&self->start, "order_starts"}, {&self->move, "order_move"}};
    ps_defines defines = ps_defines_of(ps_real_bytes(precision), 1);
    ps_defines_add(&defines, "-DDIMENSION=%u", dimension);
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++) {
        PS_TRY(ps_kernel_get(self->device, wanted[i].kernel, "nufft/order.cl", wanted[i].name,
                             defines.text, error));
    }
    return PSPEC_OK;
}

pspec_status ps_nufft_order_create(ps_nufft_order *out, const ps_nufft_order_sizes *sizes,
                                   size_t num_sets, unsigned dimension, ps_precision precision,
                                   ps_device *device, ps_error *error) {
    const size_t orders = num_sets * sizes->points * sizeof(uint32_t);
    *out = (ps_nufft_order){.sizes = *sizes, .device = device};
    PS_TRY(create_kernels(out, dimension, precision, error));
    PS_TRY(ps_buffer_create(device, &out->keys, orders, "keys of points", error));
    for (size_t i = 0; i < num_orders(sizes); i++) {
        PS_TRY(ps_buffer_create(device, &out->orders[i], orders, "orders of points", error));
    }
    if (sizes->is_direct) {
        return PSPEC_OK;
    }
    PS_TRY(ps_buffer_create(device, &out->firsts, num_sets * firsts_bytes(sizes), "keys of tiles",
                            error));
    return ps_buffer_create(device, &out->sums, num_sets * sums_bytes(sizes), "sums of keys",
                            error);
}

void ps_nufft_order_free(ps_nufft_order *order) {
    for (size_t i = 0; i < sizeof order->orders / sizeof order->orders[0]; i++) {
        ps_buffer_release(&order->orders[i]);
    }
    PS_BUFFERS_RELEASE(&order->keys, &order->firsts, &order->sums);
    *order = (ps_nufft_order){0};
}

/* ---- run --------------------------------------------------------------------------------- */

static order_numbers numbers_of(const ps_nufft_order_sizes *sizes, uint32_t digit) {
    return (order_numbers){.tile = sizes->tile,
                           .tiles = sizes->tiles,
                           .workers = sizes->workers,
                           .shift = digit * sizes->digit_bits,
                           .bits = sizes->digit_bits,
                           .is_first = digit == 0,
                           .row = sizes->row};
}

/* A word of every point of every set, `times` of them, is what a launch touches at least. */
static double word_bytes(const ps_nufft_order *self, size_t num_sets, double times) {
    return times * sizeof(uint32_t) * (double)(num_sets * self->sizes.points);
}

static pspec_status sort_tiles(ps_nufft_order *self, const order_numbers *numbers,
                               const ps_buffer *offsets, const ps_buffer *before,
                               const ps_buffer *firsts, size_t num_sets, ps_error *error) {
    const tile_local local = local_of(self->sizes.tile);
    const ps_range range =
        ps_range_shared(self->device, self->sizes.workers, self->sizes.tiles, num_sets, 0,
                        word_bytes(self, num_sets, numbers->is_first ? 2 : 3));
    return PS_LAUNCH(self->device, self->tiles, &range, error, PS_STRUCT(*numbers),
                     PS_BUFFER(*offsets), PS_BUFFER(self->keys), PS_BUFFER(*before),
                     PS_BUFFER(self->orders[0]), PS_BUFFER(*firsts), PS_LOCAL(local.data),
                     PS_LOCAL(local.counters), PS_LOCAL(local.tops));
}

/* Numbers of keys in tiles become sums over tiles. */
static pspec_status sum_tiles(ps_nufft_order *self, const order_numbers *numbers, size_t num_sets,
                              ps_error *error) {
    const double bytes = (double)num_sets * (double)firsts_bytes(&self->sizes);
    const ps_range segments =
        ps_range_light(self->device, numbers->row, ORDER_SEGMENTS, num_sets, 0, bytes);
    const ps_range sums =
        ps_range_light(self->device, numbers->row, ORDER_SEGMENTS, num_sets, 0, 2 * bytes);
    PS_TRY(PS_LAUNCH(self->device, self->segments, &segments, error, PS_STRUCT(*numbers),
                     PS_BUFFER(self->firsts), PS_BUFFER(self->sums)));
    return PS_LAUNCH(self->device, self->sum, &sums, error, PS_STRUCT(*numbers),
                     PS_BUFFER(self->sums), PS_BUFFER(self->firsts));
}

/* Orders by one digit more. */
static pspec_status add_digit(ps_nufft_order *self, uint32_t digit, const ps_buffer *offsets,
                              const ps_buffer *before, const ps_buffer *after, size_t num_sets,
                              ps_error *error) {
    const order_numbers numbers = numbers_of(&self->sizes, digit);
    const ps_range range =
        ps_range_light(self->device, self->sizes.points, 1, num_sets, 0,
                       word_bytes(self, num_sets, digit == 0 ? 2 : 3) +
                           (double)num_sets * (double)firsts_bytes(&self->sizes));
    PS_TRY(sort_tiles(self, &numbers, offsets, before, &self->firsts, num_sets, error));
    PS_TRY(sum_tiles(self, &numbers, num_sets, error));
    return PS_LAUNCH(self->device, self->scatter, &range, error, PS_STRUCT(numbers),
                     PS_BUFFER(*offsets), PS_BUFFER(*before), PS_BUFFER(self->orders[0]),
                     PS_BUFFER(self->firsts), PS_BUFFER(*after));
}

static pspec_status move(ps_nufft_order *self, const ps_nufft_order_points *points,
                         const ps_buffer *order, size_t num_sets, ps_error *error) {
    const uint32_t mask = self->sizes.is_direct ? (1U << ORDER_PLACE_BITS) - 1 : UINT32_MAX;
    const size_t places = ps_round_up(self->sizes.points, PS_NUFFT_PLACE_UNIT);
    const double bytes = (double)(points->sorted->bytes + points->heights->bytes);
    const ps_range range = ps_range_light(self->device, places, 1, num_sets, 0, 2 * bytes);
    return PS_LAUNCH(self->device, self->move, &range, error, PS_U32(mask),
                     PS_U32(points->has_weights), PS_BUFFER(*points->offsets),
                     PS_BUFFER(*points->places), PS_BUFFER(*order), PS_BUFFER(*points->points),
                     PS_BUFFER(*points->weights), PS_BUFFER(*points->sorted),
                     PS_BUFFER(*points->heights));
}

pspec_status ps_nufft_order_run(ps_nufft_order *order, const ps_nufft_order_points *points,
                                size_t num_sets, ps_error *error) {
    const ps_nufft_order_sizes *const sizes = &order->sizes;
    const ps_buffer *before = &order->keys; /* not looked at: a kernel wants a buffer */
    if (sizes->is_direct) {
        const order_numbers numbers = numbers_of(sizes, 0);
        PS_TRY(
            sort_tiles(order, &numbers, points->offsets, before, points->starts, num_sets, error));
        return move(order, points, &order->orders[0], num_sets, error);
    }
    for (uint32_t digit = 0; digit < sizes->num_digits; digit++) {
        const ps_buffer *const after = &order->orders[1 + digit % 2];
        PS_TRY(add_digit(order, digit, points->offsets, before, after, num_sets, error));
        before = after;
    }
    const ps_range starts = ps_range_light(order->device, sizes->starts_row, 1, num_sets, 0, 0);
    PS_TRY(PS_LAUNCH(order->device, order->start, &starts, error, PS_U32(sizes->starts_row),
                     PS_BUFFER(*points->offsets), PS_BUFFER(order->keys), PS_BUFFER(*before),
                     PS_BUFFER(*points->starts)));
    return move(order, points, before, num_sets, error);
}
