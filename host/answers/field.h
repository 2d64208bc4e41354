/* What answers have, declared once: a row for every header entry, column and array that any answer
 * of a kind may have. pspec_fields_table, the manual pages and docs/user/fields.md are made of the
 * rows, and a test (tests/api/test_fields.c) finds what answers have and no row declares, and the
 * reverse. */
#ifndef PS_ANSWERS_FIELD_H
#define PS_ANSWERS_FIELD_H

#include "request/options.h"
#include "fields/table.h"

typedef enum ps_field_group {
    PS_FIELD_ENTRY = 0, /* of the header */
    PS_FIELD_COLUMN,
    PS_FIELD_ARRAY, /* of its own shape, in NPZ or a file of its own */
    PS_FIELD_STATE  /* what an answer is merged by: arrays that NPZ alone has */
} ps_field_group;

/* Their names, "entry", "column", "array", "state". */
extern const char *const ps_field_groups[];

typedef struct ps_field_row {
    const char *name; /* NULL ends a list */
    const char *unit; /* "": none */
    ps_field_group group;
    /* The key of an entry may come several times, as for several samplers; state of the second
     * question is NAME_2 */
    bool is_repeated;
    ps_command_set kinds; /* 0: all that have the list */
    const char *when;     /* options and cases in which it is there; "": always */
    const char *meaning;  /* one sentence */
} ps_field_row;

/* Group and repetition, as rows have them. */
#define PS_ENTRY PS_FIELD_ENTRY, false
#define PS_ENTRIES PS_FIELD_ENTRY, true
#define PS_COLUMN PS_FIELD_COLUMN, false
#define PS_ARRAY PS_FIELD_ARRAY, false
#define PS_STATE PS_FIELD_STATE, true

/* Of several kinds: the request's record, points, frequencies, device and engine. */
extern const ps_field_row ps_fields_asked[], ps_fields_points[], ps_fields_ranges[],
    ps_fields_computed[], ps_fields_device[];

/* Creates a table of a command whose columns are those of the rows, which NULL ends. */
pspec_status ps_fields_create_table(ps_table **out, const char *command, const ps_field_row *rows,
                                    ps_error *error) PS_MUST_CHECK;

typedef struct ps_command ps_kind;

/* Calls visit for every row of the kind, in the order of its lists, until it fails. */
pspec_status ps_kind_visit_fields(const ps_kind *kind,
                                  pspec_status (*visit)(const ps_field_row *row, void *payload,
                                                        ps_error *error),
                                  void *payload, ps_error *error) PS_MUST_CHECK;

#endif
