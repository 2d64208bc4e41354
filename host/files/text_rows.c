#include "files/text_rows.h"

#include <stdlib.h>
#include <string.h>

/* Below this it takes longer to wake the others than to do their work (some 20 us here, 2 cores of
 * an EPYC, 2026-11; a thread parses 1.6 bytes per ns). */
enum { LEAST_BYTES = 1 << 18 };

/* Numbers that a worker has room for: half of a buffer of short ones, "0 1 ". Memory that is not
 * used is not there. */
enum { SPARE_VALUES = 1 << 20 };

/* The part of one thread: lines from begin to end, at most capacity rows; stop is where it stopped.
 */
typedef struct piece {
    const char *begin, *end, *stop;
    double *rows;
    size_t capacity, num_rows;
} piece;

typedef struct parse_task {
    const ps_row_parser *parser;
    piece pieces[PS_MOST_PARSERS];
} parse_task;

static void parse_piece(void *payload, unsigned index) {
    parse_task *const task = payload;
    const ps_row_parser *const parser = task->parser;
    piece *const part = &task->pieces[index];
    const char *at = part->begin;
    while (at < part->end && part->num_rows < part->capacity) {
        double *const row = part->rows + part->num_rows * parser->columns;
        const char *const line_end = ps_row_parse(at, parser->separator, parser->columns, row);
        if (line_end == NULL) {
            break;
        }
        part->num_rows++;
        at = line_end + 1;
    }
    part->stop = at;
}

/* Threads and their memory, if there is any: without, the caller parses alone. */
static void start(ps_row_parser *parser) {
    parser->has_tried = true;
    const unsigned most = parser->most_threads;
    parser->workers =
        ps_workers_create(most > 0 && most < PS_MOST_PARSERS ? most : PS_MOST_PARSERS);
    parser->spare_rows = SPARE_VALUES / parser->columns;
    for (unsigned i = 1; i < ps_workers_count(parser->workers); i++) {
        parser->spare[i] = malloc(SPARE_VALUES * sizeof(double));
        if (parser->spare[i] == NULL) {
            ps_workers_destroy(parser->workers);
            parser->workers = NULL;
        }
    }
}

void ps_row_parser_free(ps_row_parser *parser) {
    ps_workers_destroy(parser->workers);
    for (unsigned i = 0; i < PS_MOST_PARSERS; i++) {
        free(parser->spare[i]);
    }
    *parser = (ps_row_parser){0};
}

static const char *parse_alone(const ps_row_parser *parser, const char *text, const char *end,
                               double *rows, size_t capacity, size_t *num_rows) {
    parse_task task = {parser, {{.begin = text, .end = end, .rows = rows, .capacity = capacity}}};
    parse_piece(&task, 0);
    *num_rows = task.pieces[0].num_rows;
    return task.pieces[0].stop;
}

/* Cuts the text at ends of lines into a piece for each thread. */
static void cut(const ps_row_parser *parser, const char *text, const char *end, parse_task *task) {
    const unsigned count = ps_workers_count(parser->workers);
    const char *begin = text;
    for (unsigned i = 0; i < count; i++) {
        const char *cut_at = text + (size_t)(end - text) / count * (i + 1);
        if (i + 1 == count) {
            cut_at = end;
        } else if (cut_at <= begin) {
            cut_at = begin;
        } else {
            cut_at = (const char *)memchr(cut_at - 1, '\n', (size_t)(end - cut_at) + 1) + 1;
        }
        task->pieces[i].begin = begin;
        task->pieces[i].end = begin = cut_at;
        task->pieces[i].rows = parser->spare[i];
        task->pieces[i].capacity = parser->spare_rows;
    }
}

/* Joins the pieces up to the first that stopped early, or that there is no room for. */
static const char *join(const parse_task *task, unsigned count, double *rows, size_t capacity,
                        size_t *num_rows) {
    const unsigned columns = task->parser->columns;
    const char *stop = task->pieces[0].stop;
    *num_rows = task->pieces[0].num_rows;
    for (unsigned i = 1; i < count; i++) {
        const piece *const part = &task->pieces[i];
        if (stop != part->begin || part->num_rows > capacity - *num_rows) {
            break;
        }
        memcpy(rows + *num_rows * columns, part->rows, part->num_rows * columns * sizeof *rows);
        *num_rows += part->num_rows;
        stop = part->stop;
    }
    return stop;
}

/* Text for about capacity rows: what does not fit would be parsed in vain. */
static const char *shorten(const ps_row_parser *parser, const char *text, const char *end,
                           size_t capacity) {
    const size_t num_bytes = (size_t)(end - text);
    const size_t wanted = parser->row_bytes * (capacity - capacity / 16);
    if (parser->row_bytes == 0 || wanted >= num_bytes) {
        return end;
    }
    return (const char *)memchr(text + wanted, '\n', num_bytes - wanted) + 1;
}

const char *ps_rows_parse(ps_row_parser *parser, const char *text, const char *end, double *rows,
                          size_t capacity, size_t *num_rows) {
    end = shorten(parser, text, end, capacity);
    if (end - text < LEAST_BYTES) {
        return parse_alone(parser, text, end, rows, capacity, num_rows);
    }
    if (!parser->has_tried && parser->most_threads != 1) {
        start(parser);
    }
    if (parser->workers == NULL) {
        return parse_alone(parser, text, end, rows, capacity, num_rows);
    }
    parse_task task = {.parser = parser};
    cut(parser, text, end, &task);
    task.pieces[0].rows = rows;
    task.pieces[0].capacity = capacity;
    ps_workers_run(parser->workers, parse_piece, &task);
    const char *const stop =
        join(&task, ps_workers_count(parser->workers), rows, capacity, num_rows);
    parser->row_bytes = *num_rows > 0 ? (size_t)(stop - text) / *num_rows : 0;
    return stop;
}
