/* Tables in NPZ files: what is read has no more cells than bytes. After a first byte 0 the input is
 * the file. Else it is what tables are made of, and gets the records and the digest that hardly an
 * input would have: arrays, each the length of its texts, its kind, rank and extents, a byte each,
 * and its bytes; the first two have the names of those beside columns, the others those of spectra.
 * */
#include "answers/check/saved_spectrum.h"
#include "files/packed/npz_records.h"
#include "fuzz.h"
#include "store/figures_file.h"
#include "fields/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

static void put_array(ps_text *out, ps_npz_records *records, const ps_npz_array *array) {
    char header[PS_NPY_HEADER_BYTES];
    const size_t header_bytes = ps_npz_make_header(header, array);
    size_t bytes = 0;
    if (!ps_npz_count_bytes(array, &bytes)) {
        fuzz_fail("bytes that are there are too many");
    }
    const ps_npz_member one = {
        .name = array->name, .name_bytes = strlen(array->name), .size = header_bytes + bytes};
    ps_npz_put_member(out, records, &one);
    ps_text_append_bytes(out, header, header_bytes);
    ps_text_append_bytes(out, array->data, bytes);
    records->position = out->length;
}

/* false: the input has no further array. */
static bool take_array(ps_npz_array *array, size_t *shape, fuzz_bytes *input) {
    static const char kinds[] = "fiucU";
    const size_t sizes[] = {8, 8, 1, 16, 4 * (size_t)fuzz_take(input)};
    const size_t kind = fuzz_take(input) % (sizeof kinds - 1);
    size_t bytes = 0;
    array->kind = kinds[kind];
    array->element_bytes = sizes[kind];
    array->rank = fuzz_take(input) % 3;
    array->shape = shape;
    for (unsigned axis = 0; axis < array->rank; axis++) {
        shape[axis] = fuzz_take(input);
    }
    array->data = input->data;
    if (!ps_npz_count_bytes(array, &bytes) || bytes > input->size) {
        return false;
    }
    input->data += bytes;
    input->size -= bytes;
    return true;
}

/* Of column i, from the list of fields; "x": there are fewer. */
static void find_name(char name[16], const ps_npz_array *fields, size_t num_bytes, size_t i) {
    const char *const bytes = fields->data;
    snprintf(name, 16, "x");
    for (size_t at = 1; at + 1 < num_bytes; at++) {
        if (bytes[at - 1] == '\0' && bytes[at] == 'c' && i-- == 0) {
            snprintf(name, 16, "%.*s", (int)strnlen(bytes + at + 1, num_bytes - at - 1),
                     bytes + at + 1);
            return;
        }
    }
}

static void make_file(ps_text *out, fuzz_bytes input) {
    ps_npz_records all = {.limit = PS_NPZ_LIMIT};
    size_t shape[PS_NPY_MAX_RANK];
    char name[16];
    ps_npz_array array;
    ps_npz_array fields = {0};
    size_t num_bytes = 0;
    for (size_t i = 0; input.size > 0 && take_array(&array, shape, &input); i++) {
        if (i == 0) {
            fields = array;
            (void)ps_npz_count_bytes(&fields, &num_bytes);
        } else if (i > 1) {
            find_name(name, &fields, num_bytes, i - 2);
        }
        array.name = i == 0 ? "fields" : i == 1 ? "cell_kinds" : name;
        put_array(out, &all, &array);
    }
    const XXH128_hash_t digest = XXH3_128bits(ps_text_string(out), out->length);
    const size_t num = sizeof digest / sizeof(int64_t);
    put_array(out, &all, &(ps_npz_array){PS_NPZ_DIGEST, 'i', sizeof(int64_t), 1, &num, &digest});
    ps_text_append_bytes(out, ps_text_string(&all.directory), all.directory.length);
    all.position = out->length;
    ps_npz_put_end(out, &all, all.directory.length);
    ps_text_free(&all.directory);
}

/* As long a text as a file has bytes, so that memory shows in the time. */
static void check_table(const ps_table *table, size_t num_bytes) {
    if (ps_table_num_rows(table) * ps_table_num_columns(table) > num_bytes) {
        fuzz_fail("more cells than bytes");
    }
    for (size_t row = 0; row < ps_table_num_rows(table); row++) {
        for (size_t column = 0; column < ps_table_num_columns(table); column++) {
            const ps_cell cell = ps_table_cell(table, row, column);
            if ((cell.kind == PS_CELL_TEXT) != (cell.text != NULL)) {
                fuzz_fail("a text without a text, or the other way round");
            }
        }
    }
}

static ps_table *take_table(fuzz_bytes input) {
    ps_text made = {0};
    ps_table *table = NULL;
    ps_error error = {0};
    if (fuzz_take(&input) == 0) {
        ps_text_append_bytes(&made, (const char *)input.data, input.size);
    } else {
        make_file(&made, input);
    }
    fuzz_file file =
        fuzz_file_make((fuzz_bytes){(const uint8_t *)ps_text_string(&made), made.length});
    const pspec_status status = ps_table_read_npz(&table, file.path, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if ((status == PSPEC_OK) != (table != NULL)) {
        fuzz_fail("a table that was refused, or none that was taken");
    }
    if (table != NULL) {
        check_table(table, made.length);
    }
    fuzz_file_close(&file);
    ps_text_free(&made);
    return table;
}

void fuzz_table(const char *argument, fuzz_bytes input) {
    (void)argument;
    ps_table_destroy(take_table(input));
}

/* ---- saved spectra: what is taken is what the comparison counts on --------------------------- */

static void check_bins(const ps_saved_spectrum *saved) {
    const int64_t least = saved->on_sphere ? 1 : 0; /* boxes have frequencies below 1/2 */
    for (size_t b = 0; b < saved->num_bins; b++) {
        const ps_saved_bin *const bin = &saved->bins[b];
        if (bin->key < least || (b > 0 && bin->key <= saved->bins[b - 1].key)) {
            fuzz_fail("bin %zu is out of place", b);
        }
        if (!(bin->power >= 0 && isfinite(bin->power)) ||
            (saved->num_realizations > 1 && !(bin->standard_error >= 0))) {
            fuzz_fail("bin %zu has no power", b);
        }
    }
}

void fuzz_saved(const char *argument, fuzz_bytes input) {
    (void)argument;
    ps_table *const table = take_table(input);
    ps_saved_spectrum saved = {0};
    ps_error error = {0};
    if (table == NULL) {
        return;
    }
    const pspec_status status = ps_saved_table_take(&saved, table, "saved", &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (status == PSPEC_OK) {
        check_bins(&saved);
        if (saved.num_bins == 0 || saved.num_realizations == 0 || saved.max_frequency < 1 ||
            saved.dimension < 1 || !(saved.error >= 0) ||
            saved.smallest_points > saved.largest_points) {
            fuzz_fail("a question that nobody asks");
        }
    }
    ps_saved_spectrum_free(&saved);
    ps_table_destroy(table);
}

/* ---- figures of devices ---------------------------------------------------------------------- */

static void check_range(double value, double least, double most) {
    if (value != 0 && !(value >= least && value <= most)) {
        fuzz_fail("%g is no figure of a device", value);
    }
}

static void check_figures(const ps_figures *figures) {
    if (figures->num_engines > PS_FIGURES_ENGINES) {
        fuzz_fail("%zu engines", figures->num_engines);
    }
    check_range(figures->flops[0], 1e3, 1e18);
    check_range(figures->flops[1], 1e3, 1e18);
    check_range(figures->copied_bytes, 1e3, 1e18);
    for (size_t i = 0; i < figures->num_engines; i++) {
        for (unsigned p = 0; p < PS_FIGURES_PRECISIONS; p++) {
            check_range(figures->engines[i].scales[p], 1e-3, 1e3);
            const double scale = ps_figures_scale(figures, figures->engines[i].engine, p);
            if (!(scale > 0 && isfinite(scale))) {
                fuzz_fail("times %g", scale);
            }
        }
    }
}

void fuzz_figures(const char *argument, fuzz_bytes input) {
    (void)argument;
    ps_table *const table = take_table(input);
    ps_figures figures;
    ps_error error = {0};
    if (table == NULL) {
        return;
    }
    const pspec_status status = ps_figures_take(&figures, table, &error);
    fuzz_check_error(status, &error, FUZZ_PRINTABLE);
    if (figures.is_measured != (status == PSPEC_OK)) {
        fuzz_fail("refused, and yet measured");
    }
    check_figures(&figures);
    ps_table_destroy(table);
}
