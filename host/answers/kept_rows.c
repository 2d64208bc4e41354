#include "answers/kept_rows.h"

#include "files/digest.h"
#include "math/larger.h"
#include "spectra/spectrum_state_places.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Places in state_range, and in state_track, which has one for each job of the command. */
enum { FIRST, END, ALL, RANGE_NUMBERS };
enum { MOST_JOBS = 1 << 16 }; /* of a command; many more than there are */
enum {
    PART,
    WHOLE,
    NUM,
    ROWS_OF_ALL,
    ROW_BYTES,
    MEASURED,
    TRACK_NUMBERS = MEASURED + PS_MOST_LARGEST
};
static const char range_name[] = "state_range", inputs_name[] = "state_inputs",
                  track_stem[] = "state_track", rows_stem[] = "state_rows";

const ps_field_row ps_fields_kept_rows[] = {
    {range_name, "", PS_STATE, 0, "-o FILE.npz with --range", "A, B and M of the range"},
    {inputs_name, "", PS_STATE, 0, "-o FILE.npz with --range and files that options name",
     "digests of these files, a text"},
    {track_stem, "", PS_STATE, 0, "-o FILE.npz with --range",
     "one for each job of the command: its number, 1 where every part has all of its rows, how "
     "many "
     "it has, how many the whole job has, bytes of a row, the largest numbers that were measured"},
    {rows_stem, "", PS_STATE, 0, "-o FILE.npz with --range", "its rows, bytes of this machine"},
    {.name = NULL}};

/* ---- what merge reads again ------------------------------------------------------------------ */

/* Memory of a caller has a path, too. */
static bool is_memory(const char *path) {
    static const char folder[] = "/proc/self/fd/";
    return strncmp(path, folder, sizeof folder - 1) == 0;
}

static pspec_status check_input(void *payload, const ps_request_file *input, ps_error *error) {
    const ps_realization_range *const range = payload;
    return ps_request_file_comes_once(input) || is_memory(input->path)
               ? ps_range_refuse(range, "is of files and samplers, which merge can read again",
                                 error)
               : PSPEC_OK;
}

pspec_status ps_kept_rows_begin(ps_row_tape *tape, ps_request *request, const ps_kind *kind,
                                ps_error *error) {
    *tape = (ps_row_tape){.range = request->range, .is_part = true};
    if (kind->look_at_shares == NULL || request->range.end == 0) {
        return PSPEC_OK;
    }
    request->limits.checkpoint.tape = tape;
    if (request->reading.given.num > 0 || request->integrands_given.num > 0) {
        return ps_range_refuse(&request->range,
                               "is of files and samplers, for merge cannot ask a caller", error);
    }
    return ps_request_visit_inputs(request, check_input, &request->range, error);
}

static pspec_status add_input(void *payload, const ps_request_file *input, ps_error *error) {
    char digest[PS_DIGEST_BYTES];
    PS_TRY(ps_digest_file(input->path, digest, error));
    ps_text_append(payload, "%s %s %s\n", digest, input->option.text, input->path);
    return PSPEC_OK;
}

/* Lines of the digests of all files that options name. */
static pspec_status list_inputs(ps_text *out, const ps_request *request, ps_error *error) {
    PS_TRY(ps_request_visit_option_inputs(request, add_input, out, error));
    return ps_text_check(out, error);
}

/* Both are lists of the same options and paths, or the parts are of other commands. */
static pspec_status compare_inputs(const char *own, const char *kept, const char *name,
                                   ps_error *error) {
    while (*own != '\0' && *kept != '\0') {
        const size_t length = strcspn(own, "\n") + 1;
        if (strncmp(own, kept, length) != 0) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "%s is of another content of %.*s", name,
                           (int)(length - 1 - PS_DIGEST_BYTES), own + PS_DIGEST_BYTES);
        }
        own += length;
        kept += length;
    }
    return *own == *kept ? PSPEC_OK
                         : ps_fail(error, PSPEC_ERROR_INPUT, "%s is of other files", name);
}

/* ---- written --------------------------------------------------------------------------------- */

static pspec_status put(ps_table *table, const char *name, size_t num, double **data,
                        ps_error *error) {
    ps_npy_array array;
    PS_TRY(ps_npy_make_array(&array, 1, &num, false, error));
    *data = array.data;
    return ps_table_add_array(table, name, true, &array, error);
}

static pspec_status put_inputs(ps_table *table, const ps_request *request, ps_error *error) {
    ps_text lines = {0};
    double *data = NULL;
    pspec_status status = list_inputs(&lines, request, error);
    if (status == PSPEC_OK && lines.length > 0) { /* with zeros behind */
        status = put(table, inputs_name, lines.length / sizeof *data + 1, &data, error);
    }
    if (data != NULL) {
        memcpy(data, ps_text_string(&lines), lines.length);
    }
    ps_text_free(&lines);
    return status;
}

static pspec_status put_track(ps_table *table, const ps_row_track *track, size_t number,
                              ps_error *error) {
    const size_t bytes = (size_t)(track->num * track->row_bytes);
    double *data = NULL;
    PS_TRY(put(table, ps_state_name_of(track_stem, number).text, TRACK_NUMBERS, &data, error));
    data[PART] = track->part;
    data[WHOLE] = track->is_whole;
    data[NUM] = (double)track->num;
    data[ROWS_OF_ALL] = (double)track->all;
    data[ROW_BYTES] = (double)track->row_bytes;
    memcpy(data + MEASURED, track->largest, sizeof track->largest);
    PS_TRY(put(table, ps_state_name_of(rows_stem, number).text,
               (bytes + sizeof *data - 1) / sizeof *data, &data, error));
    if (bytes > 0) {
        memcpy(data, track->rows, bytes);
    }
    return PSPEC_OK;
}

/* Jobs may have one row fewer than others, of files of which some are measured. */
static uint64_t count_all(const ps_row_tape *tape) {
    uint64_t all = 0;
    for (size_t i = 0; i < tape->num; i++) {
        const ps_row_track *const track = &tape->tracks[i];
        all = !track->is_whole && track->all > all ? track->all : all;
    }
    return all;
}

pspec_status ps_kept_rows_add(ps_table *table, const ps_request *request, ps_error *error) {
    const ps_row_tape *const tape = request->limits.checkpoint.tape;
    char text[80];
    double *data = NULL;
    if (tape == NULL || !tape->is_part) {
        return PSPEC_OK;
    }
    const uint64_t all = count_all(tape);
    snprintf(text, sizeof text, "%" PRIu64 ":%" PRIu64 " of %" PRIu64, tape->range.first,
             tape->range.end, all);
    PS_TRY(ps_table_add_meta(table, "range", PS_TEXT(text), error));
    PS_TRY(put(table, range_name, RANGE_NUMBERS, &data, error));
    data[FIRST] = (double)tape->range.first;
    data[END] = (double)tape->range.end;
    data[ALL] = (double)all;
    PS_TRY(put_inputs(table, request, error));
    for (size_t i = 0; i < tape->num; i++) {
        PS_TRY(put_track(table, &tape->tracks[i], i, error));
    }
    return PSPEC_OK;
}

/* ---- read ------------------------------------------------------------------------------------ */

/* NULL: there is none of so many numbers; 0: of any. */
static const double *find(const ps_table *table, const char *name, size_t num, size_t *found) {
    const ps_npy_array *const array = ps_table_find_array(table, name);
    if (array == NULL || array->is_complex || (num > 0 && array->num != num)) {
        return NULL;
    }
    *found = array->num;
    return array->data;
}

static bool are_counts(const double *numbers, size_t num) {
    size_t i = 0;
    while (i < num && numbers[i] >= 0 && numbers[i] < 0x1p53 && numbers[i] == floor(numbers[i])) {
        i++;
    }
    return i == num;
}

static pspec_status fail_damaged(const char *name, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INPUT,
                   "%s is no answer to a range, or is damaged: -o FILE.npz with --range A:B makes "
                   "one",
                   name);
}

/* Rows that a job has of the range. */
static double count_rows(const double *numbers, const ps_realization_range *range) {
    const double all = numbers[ROWS_OF_ALL];
    return numbers[WHOLE] > 0 ? all
                              : fmin((double)range->end, all) - fmin((double)range->first, all);
}

/* A job of the command goes on where the part before ended. */
static pspec_status read_track(ps_row_tape *tape, const ps_realization_range *range,
                               const double *numbers, const double *rows, size_t num_rows,
                               bool is_first, const char *name, ps_error *error) {
    ps_row_track *track = NULL;
    const double bytes = numbers[NUM] * numbers[ROW_BYTES];
    const size_t num_tracks = tape->num;
    if (numbers[PART] >= MOST_JOBS || numbers[NUM] != count_rows(numbers, range)) {
        return fail_damaged(name, error);
    }
    PS_TRY(ps_row_tape_track(&track, tape, (unsigned)numbers[PART], error));
    if (is_first) {
        track->is_whole = numbers[WHOLE] > 0;
        track->row_bytes = (uint64_t)numbers[ROW_BYTES];
        track->all = (uint64_t)numbers[ROWS_OF_ALL];
    }
    if ((tape->num > num_tracks) != is_first || bytes > (double)num_rows * sizeof *rows ||
        track->row_bytes != (uint64_t)numbers[ROW_BYTES] ||
        track->all != (uint64_t)numbers[ROWS_OF_ALL]) {
        return fail_damaged(name, error);
    }
    for (size_t i = 0; i < PS_MOST_LARGEST; i++) {
        track->largest[i] = ps_larger(track->largest[i], numbers[MEASURED + i]);
    }
    return track->is_whole && !is_first
               ? PSPEC_OK
               : ps_row_track_add(track, rows, (uint64_t)numbers[NUM], error);
}

static pspec_status read_tracks(ps_row_tape *tape, const ps_realization_range *range,
                                const ps_table *table, bool is_first, const char *name,
                                ps_error *error) {
    const double *numbers = NULL;
    size_t num = 0;
    size_t number = 0;
    while ((numbers = find(table, ps_state_name_of(track_stem, number).text, TRACK_NUMBERS,
                           &num)) != NULL) {
        const double *const rows = find(table, ps_state_name_of(rows_stem, number++).text, 0, &num);
        if (rows == NULL || !are_counts(numbers, MEASURED)) {
            return fail_damaged(name, error);
        }
        PS_TRY(read_track(tape, range, numbers, rows, num, is_first, name, error));
    }
    return number == tape->num && number > 0 ? PSPEC_OK : fail_damaged(name, error);
}

pspec_status ps_kept_rows_check_inputs(const ps_request *request, const ps_table *table,
                                       const char *name, ps_error *error) {
    size_t num = 0;
    const double *const kept = find(table, inputs_name, 0, &num);
    ps_text lines = {0};
    pspec_status status = list_inputs(&lines, request, error);
    if (status == PSPEC_OK && kept != NULL && memchr(kept, 0, num * sizeof *kept) == NULL) {
        status = fail_damaged(name, error);
    }
    if (status == PSPEC_OK) {
        status = compare_inputs(ps_text_string(&lines), kept != NULL ? (const char *)kept : "",
                                name, error);
    }
    ps_text_free(&lines);
    return status;
}

pspec_status ps_kept_rows_read(ps_row_tape *tape, uint64_t *all, const ps_table *table,
                               const char *const names[2], ps_error *error) {
    size_t num = 0;
    const double *const range = find(table, range_name, RANGE_NUMBERS, &num);
    const bool is_first = tape->range.end == 0;
    if (range == NULL || !are_counts(range, RANGE_NUMBERS) || range[FIRST] >= range[END]) {
        return fail_damaged(names[1], error);
    }
    const ps_realization_range next = {(uint64_t)range[FIRST], (uint64_t)range[END]};
    if (!is_first && *all != (uint64_t)range[ALL]) {
        return ps_fail(error, PSPEC_ERROR_INPUT,
                       "%s is a range of %" PRIu64 " realizations instead of %" PRIu64, names[1],
                       (uint64_t)range[ALL], *all);
    }
    PS_TRY(is_first ? PSPEC_OK : ps_range_check_next(&tape->range, &next, names, error));
    *all = (uint64_t)range[ALL];
    tape->range.first = is_first ? next.first : tape->range.first;
    tape->range.end = next.end;
    return read_tracks(tape, &next, table, is_first, names[1], error);
}
