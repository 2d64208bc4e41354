/* State of a range of the realizations of a job: its nodes, written and read. */
#include "spectra/spectrum_state.h"
#include "spectra/spectrum_state_places.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(ps_sums) == SUM_SIZE * sizeof(double), "sums are four doubles");
_Static_assert(PART_SIZE == PART_TOTALS + PS_NUM_TOTALS * SUM_SIZE, "places of all totals");

/* Arrays of the sums of nodes. */
static const char *const stems[PS_NUM_NODE_SUMS] = {[PS_NODE_BINS] = "state_part_bins",
                                                    [PS_NODE_POWERS] = "state_part_powers",
                                                    [PS_NODE_C2] = "state_part_c2"};

/* ---- write ----------------------------------------------------------------------------------- */

static pspec_status put(ps_table *table, const char *stem, size_t question, unsigned rank,
                        const size_t *shape, double **data, ps_error *error) {
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, rank, shape, false, error));
    *data = array.data;
    return ps_table_add_array(table, ps_state_name_of(stem, question).text, true, &array, error);
}

static pspec_status put_range(ps_table *table, size_t question, const ps_spectrum_sums *sums,
                              ps_error *error) {
    const size_t shape[] = {RANGE_SIZE};
    double *data = NULL;
    PS_TRY(put(table, "state_range", question, 1, shape, &data, error));
    data[RANGE_FIRST] = (double)ps_spectrum_sums_first(sums);
    data[RANGE_END] = (double)ps_spectrum_sums_end(sums);
    data[RANGE_ALL] = (double)sums->num_all;
    data[RANGE_SINGLE_BINS] = sums->nodes.is_single[PS_NODE_BINS];
    data[RANGE_SINGLE_POWERS] = sums->nodes.is_single[PS_NODE_POWERS];
    data[RANGE_TOLERANCE] = sums->tolerance;
    data[RANGE_AMPLITUDE_ERROR] = sums->amplitude_error;
    data[RANGE_SHARE] = sums->largest_share;
    data[RANGE_POWER] = sums->largest_power;
    data[RANGE_PLANS] = (double)sums->planned.num;
    data[RANGE_PLANNED_POWER] = sums->planned.mean_power;
    data[RANGE_PLANNED_SHARE] = sums->planned.weight_share;
    data[RANGE_PLANNED_POINTS] = (double)sums->planned.num_points;
    return PSPEC_OK;
}

static pspec_status put_parts(ps_table *table, size_t question, const ps_sum_nodes *nodes,
                              ps_error *error) {
    const size_t shape[] = {nodes->num, PART_SIZE};
    double *data = NULL;
    PS_TRY(put(table, "state_parts", question, 2, shape, &data, error));
    for (size_t n = 0; n < nodes->num; n++, data += PART_SIZE) {
        data[PART_FIRST] = (double)nodes->nodes[n].first;
        data[PART_NUM] = (double)nodes->nodes[n].num;
        memcpy(data + PART_TOTALS, nodes->nodes[n].sums[PS_NODE_TOTALS],
               PS_NUM_TOTALS * sizeof(ps_sums));
    }
    return PSPEC_OK;
}

pspec_status ps_spectrum_state_add_range(ps_table *table, size_t question,
                                         const ps_spectrum_sums *sums, ps_error *error) {
    const ps_sum_nodes *const nodes = &sums->nodes;
    PS_TRY(put_range(table, question, sums, error));
    PS_TRY(put_parts(table, question, nodes, error));
    for (int which = 0; which < PS_NODE_TOTALS; which++) {
        const size_t size = nodes->sizes[which];
        const size_t shape[] = {nodes->num, size, SUM_SIZE};
        double *data = NULL;
        if (size == 0) {
            continue;
        }
        PS_TRY(put(table, stems[which], question, 3, shape, &data, error));
        for (size_t n = 0; n < nodes->num; n++) {
            memcpy(data + n * size * SUM_SIZE, nodes->nodes[n].sums[which], size * sizeof(ps_sums));
        }
    }
    return PSPEC_OK;
}

/* ---- read ------------------------------------------------------------------------------------ */

typedef struct reader {
    const ps_table *table;
    size_t question;
    const char *name;
    ps_error *error;
} reader;

static pspec_status fail(const reader *in, const char *what) {
    return ps_fail(in->error, PSPEC_ERROR_INPUT, "%s holds no sums of a range: its array %s %s",
                   in->name, what, "is missing, of another shape, or has numbers that none has");
}

static pspec_status find(const reader *in, const char *stem, unsigned rank, const size_t *shape,
                         const ps_npy_array **out) {
    const ps_state_name name = ps_state_name_of(stem, in->question);
    const ps_npy_array *const array = ps_table_find_array(in->table, name.text);
    *out = array;
    return array != NULL && !array->is_complex && array->rank == rank &&
                   memcmp(array->shape, shape, rank * sizeof *shape) == 0
               ? PSPEC_OK
               : fail(in, name.text);
}

static bool is_count(double x) {
    return x >= 0 && x <= 0x1p53 && x == floor(x);
}

static bool is_flag(double x) {
    return x == 0 || x == 1;
}

static bool is_range(const double *numbers) {
    return is_count(numbers[RANGE_FIRST]) && is_count(numbers[RANGE_END]) &&
           is_count(numbers[RANGE_ALL]) && numbers[RANGE_FIRST] < numbers[RANGE_END] &&
           numbers[RANGE_END] <= numbers[RANGE_ALL] && is_flag(numbers[RANGE_SINGLE_BINS]) &&
           is_flag(numbers[RANGE_SINGLE_POWERS]) && numbers[RANGE_TOLERANCE] > 0 &&
           numbers[RANGE_AMPLITUDE_ERROR] >= 0 && numbers[RANGE_SHARE] >= 0 &&
           numbers[RANGE_POWER] >= 0 && is_count(numbers[RANGE_PLANS]) &&
           numbers[RANGE_PLANNED_POWER] >= 0 && numbers[RANGE_PLANNED_SHARE] >= 0 &&
           is_count(numbers[RANGE_PLANNED_POINTS]);
}

/* Number n of them: the one behind those before, of realizations that can be a node. */
static pspec_status add_part(const reader *in, ps_spectrum_sums *sums, const double *part,
                             const ps_npy_array *const *arrays, size_t n, uint64_t *at) {
    const ps_sum_nodes *const nodes = &sums->nodes;
    ps_sum_node *node = NULL;
    if (!is_count(part[PART_FIRST]) || !is_count(part[PART_NUM]) ||
        part[PART_FIRST] != (double)*at ||
        !ps_sum_node_is_possible(*at, (uint64_t)part[PART_NUM])) {
        return fail(in, "state_parts");
    }
    PS_TRY(ps_sum_nodes_add(&sums->nodes, *at, (uint64_t)part[PART_NUM], &node, in->error));
    memcpy(node->sums[PS_NODE_TOTALS], part + PART_TOTALS, PS_NUM_TOTALS * sizeof(ps_sums));
    for (int which = 0; which < PS_NODE_TOTALS; which++) {
        const size_t size = nodes->sizes[which];
        if (size > 0) {
            memcpy(node->sums[which], arrays[which]->data + n * size * SUM_SIZE,
                   size * sizeof(ps_sums));
        }
    }
    *at += node->num;
    return PSPEC_OK;
}

static pspec_status read_parts(const reader *in, ps_spectrum_sums *sums, const double *numbers) {
    const ps_npy_array *parts = NULL;
    const ps_npy_array *arrays[PS_NUM_NODE_SUMS] = {0};
    uint64_t at = (uint64_t)numbers[RANGE_FIRST];
    const ps_state_name name = ps_state_name_of("state_parts", in->question);
    const ps_npy_array *const any = ps_table_find_array(in->table, name.text);
    const size_t num = any != NULL ? any->shape[0] : 0;
    PS_TRY(find(in, "state_parts", 2, (size_t[]){num, PART_SIZE}, &parts));
    for (int which = 0; which < PS_NODE_TOTALS; which++) {
        const size_t shape[] = {num, sums->nodes.sizes[which], SUM_SIZE};
        if (shape[1] > 0) {
            PS_TRY(find(in, stems[which], 3, shape, &arrays[which]));
        }
    }
    for (size_t n = 0; n < num; n++) {
        PS_TRY(add_part(in, sums, parts->data + n * PART_SIZE, arrays, n, &at));
    }
    const bool is_open = at % PS_SUM_BLOCK != 0; /* only the end of the job is */
    return (double)at == numbers[RANGE_END] && (!is_open || (double)at == numbers[RANGE_ALL])
               ? PSPEC_OK
               : fail(in, "state_parts");
}

/* *numbers: state_range; NULL: the table is of no range. */
static pspec_status read_numbers(const reader *in, ps_spectrum_sums *sums, const double **numbers) {
    const ps_npy_array *range = NULL;
    *numbers = NULL;
    if (ps_table_find_array(in->table, ps_state_name_of("state_range", in->question).text) ==
        NULL) {
        return PSPEC_OK;
    }
    PS_TRY(find(in, "state_range", 1, (size_t[]){RANGE_SIZE}, &range));
    const double *const found = *numbers = range->data;
    if (!is_range(found)) {
        return fail(in, "state_range");
    }
    sums->num_all = (uint64_t)found[RANGE_ALL];
    sums->tolerance = found[RANGE_TOLERANCE];
    sums->amplitude_error = found[RANGE_AMPLITUDE_ERROR];
    sums->largest_share = found[RANGE_SHARE];
    sums->largest_power = found[RANGE_POWER];
    sums->planned = (ps_replan){(uint64_t)found[RANGE_PLANS], found[RANGE_PLANNED_POWER],
                                found[RANGE_PLANNED_SHARE], (uint64_t)found[RANGE_PLANNED_POINTS]};
    return PSPEC_OK;
}

pspec_status ps_spectrum_state_read_errors_of_range(ps_spectrum_sums *sums, const ps_table *table,
                                                    size_t question, const char *name,
                                                    ps_error *error) {
    const reader in = {table, question, name, error};
    const double *numbers = NULL;
    return read_numbers(&in, sums, &numbers);
}

pspec_status ps_spectrum_state_read_range(ps_spectrum_sums *sums, const ps_table *table,
                                          size_t question, const char *name, ps_error *error) {
    const reader in = {table, question, name, error};
    const double *numbers = NULL;
    PS_TRY(read_numbers(&in, sums, &numbers));
    if (numbers == NULL) {
        return PSPEC_OK;
    }
    sums->nodes = (ps_sum_nodes){
        .sizes = {[PS_NODE_BINS] = sums->num_bins,
                  [PS_NODE_POWERS] = sums->powers != NULL ? sums->frequencies.num : 0,
                  [PS_NODE_C2] = sums->c2 != NULL ? sums->frequencies.num : 0,
                  [PS_NODE_TOTALS] = PS_NUM_TOTALS},
        .is_single = {[PS_NODE_BINS] = numbers[RANGE_SINGLE_BINS] > 0,
                      [PS_NODE_POWERS] = numbers[RANGE_SINGLE_POWERS] > 0}};
    return read_parts(&in, sums, numbers);
}
