/* The public library: answers, which are tables seen as fields. */
#include "api/public_objects.h"
#include "base/memory.h"
#include "base/text.h"
#include "fields/table_vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct pspec_answer {
    ps_table *table; /* owned */
    ps_text verdict;
    size_t num_fields, num_rows;
    pspec_field *fields; /* [num_fields]: columns, arrays, entries */
    ps_cell *entries;    /* what data of these points to */
    ps_table_vector *columns;
};

/* ---- fields ------------------------------------------------------------------------------ */

static pspec_type type_of(ps_cell_kind kind) {
    return kind == PS_CELL_TEXT ? PSPEC_TEXT : kind == PS_CELL_INTEGER ? PSPEC_I64 : PSPEC_F64;
}

static pspec_status add_columns(pspec_answer *self, ps_error *error) {
    const size_t num = ps_table_num_columns(self->table);
    PS_TRY(PS_NEW(&self->columns, num, "columns", error));
    for (size_t i = 0; i < num; i++) {
        ps_table_vector *const vector = &self->columns[i];
        PS_TRY(ps_table_vector_make(vector, self->table, i, error));
        self->fields[self->num_fields++] =
            (pspec_field){.name = ps_table_column_name(self->table, i),
                          .group = PSPEC_COLUMN,
                          .type = type_of(vector->kind),
                          .rank = 1,
                          .shape = &self->num_rows,
                          .num = self->num_rows,
                          .data = vector->values};
    }
    return PSPEC_OK;
}

static void add_arrays(pspec_answer *self) {
    for (size_t i = 0; i < ps_table_num_arrays(self->table); i++) {
        pspec_field *const field = &self->fields[self->num_fields++];
        bool is_state = false;
        const ps_npy_array *const array = ps_table_array(self->table, i, &field->name, &is_state);
        field->group = is_state ? PSPEC_STATE : PSPEC_ARRAY;
        field->type = array->is_complex ? PSPEC_C128 : PSPEC_F64;
        field->rank = array->rank;
        field->shape = array->shape;
        field->num = array->num;
        field->data = array->data;
    }
}

static pspec_status add_entries(pspec_answer *self, ps_error *error) {
    const size_t num = ps_table_num_meta(self->table);
    PS_TRY(PS_NEW(&self->entries, num, "entries", error));
    for (size_t i = 0; i < num; i++) {
        pspec_field *const field = &self->fields[self->num_fields++];
        ps_cell *const cell = &self->entries[i];
        *cell = ps_table_meta(self->table, i, &field->name);
        field->group = PSPEC_ENTRY;
        field->type = type_of(cell->kind);
        field->num = 1;
        if (field->type == PSPEC_F64) {
            cell->number = ps_cell_number(*cell);
            field->data = &cell->number;
        } else {
            field->data = field->type == PSPEC_I64 ? (const void *)&cell->integer : &cell->text;
        }
    }
    return PSPEC_OK;
}

/* The unit is that of the row that declares the field. */
static void finish_field(pspec_field *field, const ps_field_row *const *lists) {
    static const ps_field_group groups[] = {[PSPEC_COLUMN] = PS_FIELD_COLUMN,
                                            [PSPEC_ARRAY] = PS_FIELD_ARRAY,
                                            [PSPEC_STATE] = PS_FIELD_STATE,
                                            [PSPEC_ENTRY] = PS_FIELD_ENTRY};
    field->struct_size = sizeof *field;
    field->unit = "";
    for (; lists != NULL && *lists != NULL; lists++) {
        for (const ps_field_row *row = *lists; row->name != NULL; row++) {
            if (row->group == groups[field->group] && strcmp(row->name, field->name) == 0) {
                field->unit = row->unit;
                return;
            }
        }
    }
}

static pspec_status make(pspec_answer *self, const ps_field_row *const *lists, ps_error *error) {
    const ps_table *const table = self->table;
    self->num_rows = ps_table_num_rows(table);
    PS_TRY(
        PS_NEW(&self->fields,
               ps_table_num_columns(table) + ps_table_num_arrays(table) + ps_table_num_meta(table),
               "fields", error));
    PS_TRY(add_columns(self, error));
    add_arrays(self);
    PS_TRY(add_entries(self, error));
    for (size_t i = 0; i < self->num_fields; i++) {
        finish_field(&self->fields[i], lists);
    }
    return ps_text_check(&self->verdict, error);
}

/* ---- making ------------------------------------------------------------------------------ */

pspec_status ps_public_answer(pspec_answer **out, ps_answer *made,
                              const ps_field_row *const *fields, ps_error *error) {
    pspec_answer *self = NULL;
    pspec_status status = PS_NEW(&self, 1, "an answer", error);
    if (status == PSPEC_OK && made->table == NULL) { /* of commands that write files alone */
        status = ps_table_create(&made->table, "files", NULL, 0, error);
    }
    if (status == PSPEC_OK) {
        self->table = made->table;
        made->table = NULL;
        ps_text_append(&self->verdict, "%s", made->verdict.message);
        status = make(self, fields, error);
    }
    ps_answer_free(made);
    if (status != PSPEC_OK) {
        pspec_answer_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void pspec_answer_destroy(pspec_answer *answer) {
    if (answer == NULL) {
        return;
    }
    for (size_t i = 0; answer->columns != NULL && i < ps_table_num_columns(answer->table); i++) {
        free(answer->columns[i].values);
    }
    free(answer->columns);
    free(answer->entries);
    free(answer->fields);
    ps_text_free(&answer->verdict);
    ps_table_destroy(answer->table);
    free(answer);
}

/* ---- reading ----------------------------------------------------------------------------- */

size_t pspec_answer_num_fields(const pspec_answer *answer) {
    return answer->num_fields;
}

const pspec_field *pspec_answer_field(const pspec_answer *answer, size_t i) {
    return i < answer->num_fields ? &answer->fields[i] : NULL;
}

const pspec_field *pspec_answer_find(const pspec_answer *answer, const char *name) {
    size_t i = 0;
    while (i < answer->num_fields && (name == NULL || strcmp(answer->fields[i].name, name) != 0)) {
        i++;
    }
    return pspec_answer_field(answer, i);
}

const char *pspec_answer_verdict(const pspec_answer *answer) {
    return ps_text_string(&answer->verdict);
}

static const ps_field_row *const *fields_of(const char *command) {
    size_t i = 0;
    while (ps_kinds[i] != NULL && strcmp(ps_kinds[i]->name, command) != 0) {
        i++;
    }
    return ps_kinds[i] != NULL ? ps_kinds[i]->fields : NULL;
}

pspec_status pspec_answer_load(pspec_answer **out, pspec_context *context, const char *path) {
    ps_answer made = {0};
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    *out = NULL;
    if (path == NULL) {
        return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no name of a file");
    }
    PS_TRY(ps_table_read_npz(&made.table, path, &context->error));
    return ps_public_answer(out, &made, fields_of(ps_table_command(made.table)), &context->error);
}

static pspec_status merge(ps_answer *out, pspec_context *context, const pspec_answer *const *parts,
                          size_t num, const ps_table **tables, ps_text *names, const char **shown) {
    for (size_t i = 0; i < num; i++) {
        if (parts[i] == NULL) {
            return ps_fail(&context->error, PSPEC_ERROR_INVALID_ARGUMENT,
                           "answer %zu of those to merge is NULL", i + 1);
        }
        tables[i] = parts[i]->table;
        ps_text_append(&names[i], "answer %zu", i + 1);
        shown[i] = ps_text_string(&names[i]);
        PS_TRY(ps_text_check(&names[i], &context->error));
    }
    const ps_parts all = {.tables = tables,
                          .names = shown,
                          .num = num,
                          .command_line = "pspec_answer_merge",
                          .device = context->selector};
    return ps_answer_merge(out, &all, &context->error);
}

pspec_status pspec_answer_merge(pspec_answer **out, pspec_context *context,
                                const pspec_answer *const *parts, size_t num) {
    ps_answer made = {0};
    const ps_table **tables = NULL;
    const char **shown = NULL;
    ps_text *names = NULL;
    pspec_status status = PSPEC_OK;
    if (out == NULL || context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    *out = NULL;
    if (parts == NULL || num == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there are no answers to merge");
    }
    PS_TRY_OUT(status, PS_NEW(&tables, num, "answers to merge", error));
    PS_TRY_OUT(status, PS_NEW(&shown, num, "answers to merge", error));
    PS_TRY_OUT(status, PS_NEW(&names, num, "answers to merge", error));
    status = merge(&made, context, parts, num, tables, names, shown);
out:
    for (size_t i = 0; names != NULL && i < num; i++) {
        ps_text_free(&names[i]);
    }
    free(names);
    free(shown);
    free(tables);
    if (status != PSPEC_OK) {
        ps_answer_free(&made);
        return status;
    }
    return ps_public_answer(out, &made, fields_of(ps_table_command(made.table)), error);
}

pspec_status pspec_answer_write(const pspec_answer *answer, pspec_context *context,
                                const char *path, const char *format) {
    ps_table_format chosen = PS_FORMAT_CSV;
    if (context == NULL) {
        return PSPEC_ERROR_INVALID_ARGUMENT;
    }
    ps_error *const error = &context->error;
    if (answer == NULL) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "there is no answer to write");
    }
    if (path == NULL || strcmp(path, "-") == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "an answer is written to a file, and standard output is none");
    }
    PS_TRY(ps_table_choose_format(&chosen, format, path, error));
    return ps_table_write(answer->table, path, chosen, error);
}
