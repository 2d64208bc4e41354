/* What the doctor finds as a table. */
#include "commands/doctor.h"
#include "store/result_cache.h"

#include "pointspec_version.h"

typedef struct list {
    ps_table *table;
    pspec_status status; /* of the rows so far */
    ps_error *error;
} list;

static void add(ps_finding_kind kind, const char *topic, const char *sentence, void *payload) {
    list *const found = payload;
    const ps_cell cells[] = {PS_TEXT(ps_finding_words[kind]), PS_TEXT(topic), PS_TEXT(sentence)};
    if (found->status == PSPEC_OK) {
        found->status = ps_table_add_row(found->table, cells, found->error);
    }
}

static pspec_status fill(ps_answer *out, const char *device, ps_error *error) {
    ps_table *const table = out->table;
    ps_text folder = {0}; /* also one that is not trusted, which is then a finding */
    ps_error ignored = {0};
    list found = {table, PSPEC_OK, error};
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(PS_VERSION), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(PS_TABLE_SCHEMA), error));
    const bool has_folder = ps_cache_default_directory(&folder, &ignored) == PSPEC_OK;
    const ps_doctor doctor = {.device = device,
                              .cache_folder = has_folder ? ps_text_string(&folder) : NULL,
                              .hear = add,
                              .payload = &found};
    pspec_status status = ps_doctor_examine(&doctor, &out->verdict);
    ps_text_free(&folder);
    if (status != PSPEC_OK && status != PSPEC_ERROR_CHECK) {
        *error = out->verdict;
        return status;
    }
    return found.status;
}

pspec_status ps_doctor_tabulate(ps_answer *out, const char *device, ps_error *error) {
    static const char *const columns[] = {"finding", "topic", "sentence"};
    PS_TRY(
        ps_table_create(&out->table, "doctor", columns, sizeof columns / sizeof columns[0], error));
    return fill(out, device, error);
}
