#include "answers/lead.h"

#include "pointspec_version.h"

#include <string.h>

enum { MOST_LEAD = 2, MOST_COLUMNS = MOST_LEAD + PS_MOST_COLUMNS_AFTER_LEAD };

static void add(ps_lead *lead, const char *name, ps_cell cell) {
    lead->names[lead->num] = name;
    lead->cells[lead->num++] = cell;
}

ps_lead ps_lead_make(const ps_request *request, size_t question) {
    ps_lead out = {0};
    if (request->num_sources > 1) {
        add(&out, "sampler", PS_TEXT(ps_request_name(request, question)));
    }
    if (request->num_counts > 1) {
        add(&out, "points", PS_INTEGER(ps_request_points(request, question)));
    }
    return out;
}

pspec_status ps_lead_add_origin(ps_table *table, const char *command_line, ps_error *error) {
    const ps_meta entries[] = {
        {"pointspec_version", PS_TEXT(PS_VERSION)},
        {"schema", PS_INTEGER(PS_TABLE_SCHEMA)},
        {"command", PS_TEXT(command_line)},
    };
    const size_t num = sizeof entries / sizeof entries[0];
    return ps_table_add_metas(table, entries, command_line != NULL ? num : num - 1, error);
}

pspec_status ps_lead_add_source(ps_table *table, const ps_request *request, size_t question,
                                ps_error *error) {
    return request->num_sources == 0
               ? PSPEC_OK
               : ps_table_add_meta(table, "sampler", PS_TEXT(ps_request_name(request, question)),
                                   error);
}

pspec_status ps_lead_create_table(ps_table **out, const char *command, const ps_lead *lead,
                                  const char *const *columns, size_t num, ps_error *error) {
    const char *all[MOST_COLUMNS];
    memcpy(all, lead->names, lead->num * sizeof *all);
    memcpy(all + lead->num, columns, num * sizeof *all);
    return ps_table_create(out, command, all, lead->num + num, error);
}

pspec_status ps_lead_add_row(ps_table *table, const ps_lead *lead, const ps_cell *cells, size_t num,
                             ps_error *error) {
    ps_cell all[MOST_COLUMNS];
    memcpy(all, lead->cells, lead->num * sizeof *all);
    memcpy(all + lead->num, cells, num * sizeof *all);
    return ps_table_add_row(table, all, error);
}
