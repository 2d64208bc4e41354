/* Plans of verbs. */
#include "commands/verb.h"
#include "store/host_figures.h"

#include "pointspec_version.h"

static pspec_status fill(ps_planner *planner, const ps_verb *verb, const ps_request *request,
                         const ps_answer_hooks *hooks, ps_error *error) {
    ps_figures host;
    ps_table *const table = planner->table;
    planner->host = &host;
    PS_TRY(ps_table_add_meta(table, "pointspec_version", PS_TEXT(PS_VERSION), error));
    PS_TRY(ps_table_add_meta(table, "schema", PS_INTEGER(PS_TABLE_SCHEMA), error));
    PS_TRY(ps_table_add_meta(table, "command", PS_TEXT(request->command_line), error));
    /* the total stands before the parts, of which a scene may have hundreds */
    PS_TRY(ps_table_add_meta(table, "seconds", PS_MISSING, error));
    PS_TRY(ps_host_figures_read(&host, request->limits.cache_folder, error));
    PS_TRY(ps_table_add_meta(table, "host_figures", PS_TEXT(host.note), error));
    const size_t num_single = ps_table_num_meta(table);
    PS_TRY(verb->kind != NULL ? verb->kind->plan(planner, request, error)
                              : verb->plan(planner, request, hooks, error));
    PS_TRY(ps_plan_table_end(planner, error));
    for (size_t i = num_single; i < ps_table_num_meta(table); i++) { /* of every question */
        const char *key = NULL;
        ps_table_meta(table, i, &key);
        ps_table_set_repeated(table, key);
    }
    return PSPEC_OK;
}

pspec_status ps_verb_plan(ps_table **out, const ps_verb *verb, const ps_request *request,
                          const ps_answer_hooks *hooks, ps_error *error) {
    ps_planner planner = {.device = hooks->device,
                          .lead = verb == &ps_verb_run ? ps_plan_table_lead("")
                                                       : ps_lead_make(request, 0)};
    *out = NULL;
    PS_TRY(ps_plan_table_create(&planner.table, &planner.lead, error));
    const pspec_status status = fill(&planner, verb, request, hooks, error);
    if (status != PSPEC_OK) {
        ps_table_destroy(planner.table);
        return status;
    }
    *out = planner.table;
    return PSPEC_OK;
}
