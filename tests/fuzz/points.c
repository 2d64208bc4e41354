/* Point files. The first bytes of the input are options, the rest is the file:
 *
 *   0  domain (2 bits), weight column, ignore weights, wrap, normalize, keep angles, whole read by pipe
 *   1  columns: 0 none, else one of PS_POINT_COLUMNS, or behind these numbers or names of columns,
 *      or behind these a selection, or a box
 *   2  dimension (3 bits), blocks by pipe, blocks are kept, the writer is told the counts,
 *      --header or --transpose (2 bits)
 *   3  points per set
 *   4  sets: first (4 bits), last (4 bits); last 0 means all
 *   5  points of a block, less 1
 */
#include "points.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS_BYTES = 24 };

/* Number index, counted from 1, of PS_POINT_COLUMNS; NULL for 0. Columns by number come last. */
static const char *choose_columns(unsigned index, char text[COLUMNS_BYTES], const char **numbers) {
    static const char *const chosen[] = {"2,1", "1,3,2=phi-theta-w", "4,", "y,x"};
    enum { NUM_WORDS = 15, NUM_CHOICES = NUM_WORDS + 4, SELECTION = 0x80 };
    const char *word = PS_POINT_COLUMNS;
    index = index < SELECTION ? index % NUM_CHOICES : 0;
    *numbers = index >= NUM_WORDS ? chosen[index - NUM_WORDS] : NULL;
    if (index == 0 || index >= NUM_WORDS) {
        return NULL;
    }
    for (unsigned i = 1; i < index; i++) {
        word = strchr(word, '|') + 1;
    }
    const size_t length = strcspn(word, "|");
    memcpy(text, word, length);
    text[length] = '\0';
    return text;
}

/* What is behind columns: a selection by a word or a number, or a box. */
enum { SELECTIONS = 0x80, BOX = 0x83 };

static const char *choose_selection(unsigned choice) {
    static const char *const selections[BOX - SELECTIONS] = {"type=1", "element=Ar", "x=0.5"};
    return choice >= SELECTIONS && choice < BOX ? selections[choice - SELECTIONS] : NULL;
}

static void take_choices(fuzz_choices *out, fuzz_bytes *input, const char *format,
                         char columns[COLUMNS_BYTES]) {
    static const ps_domain domains[] = {PS_DOMAIN_TORUS, PS_DOMAIN_SPHERE, PS_DOMAIN_ANY,
                                        PS_DOMAIN_ANY};
    static const char *const headers[] = {NULL, "yes", "no", NULL};
    const uint8_t flags = fuzz_take(input);
    out->options.format = format;
    out->options.domain = domains[flags & 3];
    out->options.weight_column = (flags & 4) != 0;
    out->options.ignore_weights = (flags & 8) != 0;
    out->options.wrap = (flags & 16) != 0;
    out->options.normalize_vectors = (flags & 32) != 0;
    out->options.keep_angles = (flags & 64) != 0;
    out->whole_from_pipe = (flags & 128) != 0;
    const unsigned choice = input->size > 0 ? input->data[0] : 0;
    out->options.select = choose_selection(choice);
    out->options.box = choice == BOX ? (ps_box){2, {0, -1}, {8, 4}} : (ps_box){0};
    out->options.columns = choose_columns(fuzz_take(input), columns, &out->options.column_names);
    const uint8_t more_flags = fuzz_take(input);
    out->options.dimension = more_flags & 7;
    out->blocks_from_pipe = (more_flags & 8) != 0;
    out->keeps_blocks = (more_flags & 16) != 0;
    out->tells_counts = (more_flags & 32) != 0;
    out->options.header = headers[more_flags >> 6];
    out->options.transpose = more_flags >> 6 == 3;
    out->options.points_per_set = fuzz_take(input);
    const uint8_t range = fuzz_take(input);
    out->options.sets.first = range & 15;
    out->options.sets.last = range >> 4;
    out->block_points = (size_t)fuzz_take(input) + 1;
}

static void read_file(fuzz_reading *out, fuzz_bytes content, bool is_pipe,
                      const fuzz_choices *choices, size_t block_points) {
    fuzz_file file = is_pipe ? fuzz_pipe_make(content) : fuzz_file_make(content);
    fuzz_read(out, file.path, choices, block_points);
    fuzz_check_points(out, &choices->options);
    fuzz_file_close(&file);
}

static bool is_good(const fuzz_reading *reading) {
    return reading->status == PSPEC_OK && !reading->was_cut;
}

/* Are both refused, one because the options do not fit the file, which the other has not come to?
 */
static bool met_other_fault(const fuzz_reading *a, const fuzz_reading *b) {
    return a->status != PSPEC_OK && b->status != PSPEC_OK &&
           (a->status == PSPEC_ERROR_INVALID_ARGUMENT || b->status == PSPEC_ERROR_INVALID_ARGUMENT);
}

/* One way to read gives the points of the other. A pipe, whose length is not known, may bring
 * points before it fails; it also cannot hold large arrays in Fortran order. Sentences are not
 * compared: of a file with two faults the size of the blocks decides which is met first. */
static void compare_ways(const fuzz_reading *whole, const fuzz_reading *blocks,
                         const fuzz_choices *choices) {
    const bool same_source = choices->whole_from_pipe == choices->blocks_from_pipe;
    if (same_source && !whole->was_cut && !blocks->was_cut && whole->status != blocks->status &&
        !met_other_fault(whole, blocks)) {
        fuzz_fail("whole: %d (%s), in blocks of %zu: %d (%s)", (int)whole->status,
                  whole->error.message, choices->block_points, (int)blocks->status,
                  blocks->error.message);
    }
    if (is_good(whole) && is_good(blocks) && whole->num_sets != blocks->num_sets) {
        fuzz_fail("%zu sets, in blocks of %zu points %zu sets", whole->num_sets,
                  choices->block_points, blocks->num_sets);
    }
    fuzz_compare(whole, blocks,
                 whole->num_sets < blocks->num_sets ? whole->num_sets : blocks->num_sets,
                 "reading by blocks");
}

void fuzz_points(const char *argument, fuzz_bytes input) {
    char columns[COLUMNS_BYTES];
    fuzz_choices choices = {0};
    fuzz_reading whole = {0};
    fuzz_reading blocks = {0};
    take_choices(&choices, &input, argument, columns);
    read_file(&whole, input, choices.whole_from_pipe, &choices, 0);
    read_file(&blocks, input, choices.blocks_from_pipe, &choices, choices.block_points);
    compare_ways(&whole, &blocks, &choices);
    if (is_good(&whole)) {
        fuzz_write_and_read(&whole, "utk-text", &choices);
        fuzz_write_and_read(&whole, whole.format, &choices);
    }
    fuzz_reading_free(&whole);
    fuzz_reading_free(&blocks);
}
