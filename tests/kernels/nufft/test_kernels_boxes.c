/* nufft/boxes.cl alone, against sums of windows in double precision: in the plane and in space,
 * boxes from one for the whole grid to as small as they become, all colours one after the other, a
 * grid in one buffer and in two. Points stand at the borders of cells and boxes and at both ends of
 * the torus, too; what was on the grid stays there.
 */
#include "harness_kernels.h"
#include "window_cells.h"

#include "engines/torus/nufft/local.h"
#include "engines/torus/nufft/variant.h"
#include "nufft/boxes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ps_device *device;
static uint64_t seed = 12;

/* Of two parts, whose places have a gap between them; the first fills chunks and a piece of one. */
enum { NUM_PARTS = 2, CLUSTER = 21, FIRST_POINTS = 44, SECOND_POINTS = 19, GAP_POINTS = 4 };
enum { NUM_PLACES = FIRST_POINTS + GAP_POINTS + SECOND_POINTS };
static const uint64_t part_begin[NUM_PARTS] = {0, FIRST_POINTS + GAP_POINTS};
static const uint64_t part_points[NUM_PARTS] = {FIRST_POINTS, SECOND_POINTS};

typedef struct boxes_case {
    unsigned precision, lanes, dimension;
    bool is_alone, has_pairs;
    uint32_t n[PS_NUFFT_MAX_AXES];
    unsigned widths[PS_NUFFT_MAX_AXES];
    unsigned halvings;
    uint32_t slab_rows; /* of the first buffer; the rest is in a second one */
    size_t num_groups;  /* how many work-group sizes */
} boxes_case;

/* precision, lanes, dimension, alone, pairs, cells, widths, halvings, rows of the first buffer,
 * work-group sizes. One box for all, boxes of unequal lengths, windows wider than boxes, which need
 * three colours; along rows windows of 2 to 8, 9 to 12 and up to 16 cells. */
static const boxes_case cases[] = {
    {32, 16, 2, true, true, {20, 26}, {4, 6}, 0, 20, 1},
    {32, 1, 2, false, false, {27, 23}, {2, 3}, 2, 20, 3},
    {32, 4, 2, false, true, {33, 45}, {7, 13}, 1, 33, 2},
    {64, 8, 2, true, false, {33, 45}, {8, 9}, 1, 17, 1},
    {64, 4, 2, false, true, {13, 15}, {11, 12}, 0, 13, 2},
    {64, 1, 2, false, false, {31, 33}, {5, 16}, 2, 31, 1},
    {32, 16, 3, true, false, {13, 9, 18}, {3, 5, 4}, 1, 13, 1},
    {32, 4, 3, false, true, {14, 13, 16}, {4, 3, 2}, 2, 8, 3},
    {64, 8, 3, true, true, {9, 12, 17}, {6, 2, 10}, 1, 5, 1},
    {64, 1, 3, false, false, {10, 9, 16}, {5, 4, 13}, 2, 10, 1},
};

typedef struct place {
    uint64_t x[PS_NUFFT_MAX_AXES];
    double weight;
} place;

typedef struct boxes_data {
    ps_nufft_layout layout;
    unsigned degrees[PS_NUFFT_MAX_AXES];
    double *coefficients[PS_NUFFT_MAX_AXES];
    place places[NUM_PLACES];
    uint32_t *starts; /* [part][box + 2] */
    size_t num_cells, row_cells;
    double *before, *sums, *allowed; /* [cell] */
} boxes_data;

static unsigned first_axis(const boxes_case *one) {
    return PS_NUFFT_MAX_AXES - one->dimension;
}

/* ---- points ------------------------------------------------------------------------------ */

/* Borders of boxes, borders of cells, ends of the torus; else anywhere. */
static uint64_t random_coordinate(const ps_nufft_axis *axis, uint32_t boxes, uint32_t per_cell) {
    enum { KINDS = 6 };
    const uint64_t less = test_uniform(&seed) < 0.5 ? 1 : 0; /* just before the border */
    switch ((int)(test_uniform(&seed) * KINDS)) {
    case 0:
        return 0 - less;
    case 1:
        return first_in_cell(axis, (uint32_t)(test_uniform(&seed) * axis->n)) - less;
    case 2:
        return first_in_cell(axis, box_begin((uint32_t)(test_uniform(&seed) * boxes), per_cell)) -
               less;
    default:
        return random_u64(&seed);
    }
}

/* The first ones in one cell, the last of the torus. Between the parts is nothing to look at. */
static place make_place(const boxes_case *one, const ps_nufft_layout *layout, size_t j) {
    place made = {.weight = (double)(float)(2 * test_uniform(&seed) - 1)};
    if (j >= FIRST_POINTS && j < part_begin[1]) {
        return (place){{UINT64_MAX, UINT64_MAX, UINT64_MAX}, NAN};
    }
    for (unsigned i = 0; i < one->dimension; i++) {
        const ps_nufft_axis *axis = &layout->choice.axes[i];
        const unsigned own = first_axis(one) + i;
        made.x[i] = j < CLUSTER ? first_in_cell(axis, axis->n - 1) + random_u64(&seed) / axis->n
                                : random_coordinate(axis, layout->boxes.num[own],
                                                    layout->boxes.per_cell[own]);
    }
    return made;
}

static size_t box_of_place(const boxes_case *one, const ps_nufft_layout *layout,
                           const place *point) {
    size_t box = 0;
    for (unsigned i = 0; i < one->dimension; i++) {
        const unsigned own = first_axis(one) + i;
        double fraction = 0;
        const uint32_t cell = first_cell(&layout->choice.axes[i], point->x[i], &fraction);
        box = box * layout->boxes.num[own] + box_of(cell, layout->boxes.per_cell[own]);
    }
    return box;
}

/* Brings the points of a part into the order of their boxes. */
static void sort_part(const boxes_case *one, boxes_data *data, size_t part) {
    const size_t num_boxes = ps_nufft_boxes_count(&data->layout.boxes);
    uint32_t *const starts = data->starts + part * (num_boxes + 2);
    place *const places = data->places + part_begin[part];
    size_t at = 0;
    for (size_t box = 0; box < num_boxes; box++) {
        starts[box] = (uint32_t)at;
        for (size_t j = at; j < part_points[part]; j++) {
            if (box_of_place(one, &data->layout, &places[j]) == box) {
                const place found = places[j];
                places[j] = places[at];
                places[at++] = found;
            }
        }
    }
    assert_int_equal(at, part_points[part]);
    starts[num_boxes] = starts[num_boxes + 1] = (uint32_t)at;
}

/* ---- what is expected -------------------------------------------------------------------- */

/* Of a window's value: polynomials and rounding. */
static double window_error(const boxes_case *one) {
    return one->precision == 32 ? 3e-7 : 3e-15;
}

/* Adds a point to the cells whose indices on the axes before i are `at`; value and largest: the
 * product of its weight and of windows on these axes, and what that may be with errors. */
static void add_point(const boxes_case *one, boxes_data *data, const place *point, unsigned i,
                      size_t at, double value, double largest) {
    if (i == one->dimension) {
        data->sums[at] += value;
        data->allowed[at] += largest - fabs(value);
        return;
    }
    const ps_nufft_axis *axis = &data->layout.choice.axes[i];
    double fraction = 0;
    const uint32_t first = first_cell(axis, point->x[i], &fraction);
    for (unsigned bin = 0; bin < axis->window.width; bin++) {
        const double t = bin + 1 - axis->window.width / 2.0 - fraction;
        const double window = ps_nufft_window_value(&axis->window, t);
        add_point(one, data, point, i + 1, at * axis->n + (first + bin) % axis->n, value * window,
                  largest * (window + window_error(one)));
    }
}

static void make_sums(const boxes_case *one, boxes_data *data) {
    const double roundoff = one->precision == 32 ? 0x1p-24 : 0x1p-53;
    data->before = test_whole_numbers(&seed, data->num_cells, 0x1p10);
    data->sums = calloc(data->num_cells, sizeof *data->sums);
    data->allowed = calloc(data->num_cells, sizeof *data->allowed);
    for (size_t i = 0; i < data->num_cells; i++) { /* a plain number would lose what is added */
        data->before[i] *= one->has_pairs ? 0x1p10 : 0x1p-10;
        data->allowed[i] = one->has_pairs ? 0 : 16 * roundoff;
    }
    for (size_t j = 0; j < NUM_PLACES; j++) {
        const place *point = &data->places[j];
        if (!isnan(point->weight)) {
            add_point(one, data, point, 0, 0, point->weight, fabs(point->weight));
        }
    }
}

/* Windows that do not vanish at their edges. */
static void make_axes(const boxes_case *one, boxes_data *data) {
    ps_nufft_choice *const choice = &data->layout.choice;
    choice->num_axes = one->dimension;
    choice->variant = &ps_nufft_large;
    for (unsigned i = 0; i < one->dimension; i++) {
        ps_nufft_axis *const axis = &choice->axes[i];
        const int32_t K = (int32_t)(one->n[i] * 2 / 5);
        *axis = (ps_nufft_axis){.axis = i, .factor = 1, .max_frequency = K, .n = one->n[i]};
        axis->window = ps_nufft_window_make(one->widths[i], K, one->n[i]);
        const uint32_t bins = ps_nufft_bins(axis);
        data->degrees[i] = ps_nufft_window_degree(&axis->window, window_error(one) / 100);
        data->coefficients[i] = calloc((data->degrees[i] + 1) * (size_t)bins, sizeof(double));
        assert_non_null(data->coefficients[i]);
        ps_nufft_window_polynomials(&axis->window, data->degrees[i], bins, data->coefficients[i]);
    }
}

static boxes_data make_data(const boxes_case *one) {
    boxes_data data = {.layout = {.real_bytes = one->precision / 8}, .row_cells = 1};
    make_axes(one, &data);
    data.layout.boxes = ps_nufft_boxes_measure(&data.layout.choice, one->halvings);
    const size_t num_boxes = ps_nufft_boxes_count(&data.layout.boxes);
    data.starts = calloc(NUM_PARTS * (num_boxes + 2), sizeof *data.starts);
    for (unsigned i = 1; i < one->dimension; i++) {
        data.row_cells *= one->n[i];
    }
    data.num_cells = one->n[0] * data.row_cells;
    for (size_t j = 0; j < NUM_PLACES; j++) {
        data.places[j] = make_place(one, &data.layout, j);
    }
    sort_part(one, &data, 0);
    sort_part(one, &data, 1);
    make_sums(one, &data);
    return data;
}

static void free_data(boxes_data *data) {
    for (unsigned i = 0; i < PS_NUFFT_MAX_AXES; i++) {
        free(data->coefficients[i]);
    }
    free(data->starts);
    free(data->before);
    free(data->sums);
    free(data->allowed);
}

/* ---- launches ---------------------------------------------------------------------------- */

/* What the kernel only reads. */
enum { PLACES, SORTED, HEIGHTS, STARTS, WINDOWS, NUM_INPUTS = WINDOWS + PS_NUFFT_MAX_AXES };

static void upload(const boxes_case *one, const boxes_data *data, test_memory in[NUM_INPUTS]) {
    const size_t num_starts = NUM_PARTS * (ps_nufft_boxes_count(&data->layout.boxes) + 2);
    uint64_t points[NUM_PLACES * PS_NUFFT_MAX_AXES];
    double weights[NUM_PLACES];
    for (size_t j = 0; j < NUM_PLACES; j++) {
        memcpy(points + j * one->dimension, data->places[j].x, one->dimension * sizeof *points);
        weights[j] = data->places[j].weight;
    }
    in[PLACES] = test_memory_create(device, part_begin, sizeof part_begin);
    in[SORTED] = test_memory_create(device, points, NUM_PLACES * one->dimension * sizeof *points);
    in[HEIGHTS] = test_reals_create(device, one->precision, weights, NUM_PLACES);
    in[STARTS] = test_memory_create(device, data->starts, num_starts * sizeof(uint32_t));
    for (unsigned i = 0; i < one->dimension; i++) {
        const size_t bins = ps_nufft_bins(&data->layout.choice.axes[i]);
        in[WINDOWS + first_axis(one) + i] = test_reals_create(
            device, one->precision, data->coefficients[i], (data->degrees[i] + 1) * bins);
    }
    if (first_axis(one) > 0) { /* not looked at */
        in[WINDOWS] = test_reals_create(device, one->precision, NULL, 1);
    }
}

static boxes_numbers numbers_of(const boxes_case *one, const boxes_data *data, uint32_t colour) {
    const ps_nufft_boxes *boxes = &data->layout.boxes;
    const unsigned first = first_axis(one);
    boxes_numbers numbers = {
        .axes = {{.window = {.n = 1, .width = 1, .bins = 1}, .boxes = 1, .colours = 1}},
        .rows = boxes->sides[1],
        .pitch = boxes->sides[2],
        .num_parts = NUM_PARTS};
    for (unsigned i = BOX_AXES; i-- > first;) {
        const ps_nufft_axis *axis = &data->layout.choice.axes[i - first];
        numbers.axes[i] = (box_axis){
            .window = {axis->n, axis->window.width, data->degrees[i - first], ps_nufft_bins(axis)},
            .boxes = boxes->num[i],
            .per_cell = boxes->per_cell[i],
            .colours = boxes->colours[i],
            .colour = colour % boxes->colours[i]};
        colour /= boxes->colours[i];
    }
    return numbers;
}

/* Some rows of cells of the first axis, which have buffers of their own. */
typedef struct slab {
    uint32_t first_row, num_rows;
    test_memory high, low;
} slab;

static slab make_slab(const boxes_case *one, const boxes_data *data, uint32_t first_row,
                      uint32_t num_rows) {
    const size_t num = num_rows * data->row_cells;
    double *const zeros = calloc(num, sizeof *zeros);
    const slab made = {
        .first_row = first_row,
        .num_rows = num_rows,
        .high = test_reals_create(device, one->precision,
                                  data->before + first_row * data->row_cells, num),
        .low = test_reals_create(device, one->precision, one->has_pairs ? zeros : NULL, num)};
    free(zeros);
    return made;
}

static void spread(const boxes_case *one, const boxes_data *data, size_t group, ps_kernel *kernel,
                   test_memory in[NUM_INPUTS], const slab *grid) {
    const ps_nufft_boxes *boxes = &data->layout.boxes;
    const uint32_t colours = boxes->colours[0] * boxes->colours[1] * boxes->colours[2];
    const ps_nufft_local local = ps_nufft_boxes_local(&data->layout);
    for (uint32_t colour = 0; colour < colours; colour++) {
        boxes_numbers numbers = numbers_of(one, data, colour);
        numbers.first_row = grid->first_row;
        numbers.num_rows = grid->num_rows;
        TEST_LAUNCH(device, kernel, group, 1, ps_nufft_boxes_of_colour(boxes), 1,
                    PS_STRUCT(numbers), PS_BUFFER(in[PLACES].buffer), PS_BUFFER(in[SORTED].buffer),
                    PS_BUFFER(in[HEIGHTS].buffer), PS_BUFFER(in[STARTS].buffer),
                    PS_BUFFER(in[WINDOWS].buffer), PS_BUFFER(in[WINDOWS + 1].buffer),
                    PS_BUFFER(in[WINDOWS + 2].buffer), PS_BUFFER(grid->high.buffer),
                    PS_BUFFER(grid->low.buffer), PS_LOCAL(local.rows), PS_LOCAL(local.windows),
                    PS_LOCAL(local.cells));
    }
}

/* Frees the slab, too. */
static void check_slab(const boxes_case *one, const boxes_data *data, size_t group, slab *found) {
    const size_t begin = found->first_row * data->row_cells;
    double *const high = test_reals_read(&found->high, one->precision);
    double *const low = one->has_pairs ? test_reals_read(&found->low, one->precision) : NULL;
    for (size_t i = 0; i < found->num_rows * data->row_cells; i++) {
        const double sum = (high[i] - data->before[begin + i]) + (low != NULL ? low[i] : 0);
        const double off = fabs(sum - data->sums[begin + i]);
        if (!(off <= data->allowed[begin + i])) {
            fail_msg("dimension %u, precision %u, lanes %u, %u halvings, groups of %zu: cell %zu "
                     "of %zu is off by %g, allowed %g",
                     one->dimension, one->precision, one->lanes, one->halvings, group, begin + i,
                     data->num_cells, off, data->allowed[begin + i]);
        }
    }
    free(high);
    free(low);
    test_memory_free(&found->high);
    (one->has_pairs ? test_memory_free : test_memory_free_unchanged)(&found->low);
}

static void run_case(const boxes_case *one, const boxes_data *data, size_t group) {
    /* As in engines CPUs alone have groups of one item; nor does Oclgrind know of prefetching. */
    const bool is_alone =
        one->is_alone && !ps_device_get_limits(device)->has_dedicated_local_memory;
    ps_kernel *kernel =
        test_kernel(device, "nufft/boxes.cl", "nufft_boxes",
                    "-DPRECISION=%u -DLANES=%u -DPAIRS=%u -DALONE=%u -DDIMENSION=%u",
                    one->precision, one->lanes, one->has_pairs, is_alone, one->dimension);
    test_memory in[NUM_INPUTS];
    upload(one, data, in);
    for (uint32_t row = 0; row < one->n[0]; row += one->slab_rows) {
        const uint32_t rest = one->n[0] - row;
        slab own = make_slab(one, data, row, rest < one->slab_rows ? rest : one->slab_rows);
        spread(one, data, group, kernel, in, &own);
        check_slab(one, data, group, &own);
    }
    for (size_t i = 0; i < NUM_INPUTS; i++) {
        test_memory_free_unchanged(&in[i]);
    }
}

static void sums_of_windows(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        const boxes_case *one = &cases[c];
        boxes_data data = make_data(one);
        const bool can_run = test_has_precision(device, one->precision);
        for (size_t g = 0; g < one->num_groups && can_run; g++) {
            run_case(one, &data, TEST_GROUP_SIZES[g]);
        }
        free_data(&data);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_of_windows)};
    device = test_open_device();
    const int failures = cmocka_run_group_tests_name("kernels_boxes", tests, NULL, NULL);
    ps_device_close(device);
    return failures;
}
