#include "answers/devices/devices_work.h"

#include "answers/devices/crew.h"
#include "answers/devices/device_team.h"
#include "answers/output_check.h"
#include "answers/parts/sharing.h"
#include "base/memory.h"
#include "device/kind.h"
#include "spectra/sum_nodes.h"

#include <stdlib.h>
#include <string.h>

/* ---- which devices --------------------------------------------------------------------------- */

/* Of one kind are those whose results have the same bits. */
static pspec_status compare_kinds(const ps_device_limits *a, const ps_device_limits *b,
                                  ps_error *error) {
    const ps_device_kind kinds[] = {ps_device_kind_of(a), ps_device_kind_of(b)};
    return strcmp(kinds[0].text, kinds[1].text) == 0
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                         "devices of different kinds have results of other bits: \"%s\" (%s) and "
                         "\"%s\" (%s); --mixed lets them share the work",
                         a->name, kinds[0].text, b->name, kinds[1].text);
}

/* The names of all devices, each once. */
static pspec_status look_at_devices(ps_text *names, const ps_selectors *selectors,
                                    const ps_device_limits *limits, size_t num_devices,
                                    bool may_be_mixed, ps_error *error) {
    const ps_device_limits *first = NULL;
    for (size_t i = 0; i < selectors->num; i++) {
        size_t index = 0;
        PS_TRY(ps_device_choose(limits, num_devices, selectors->of[i].text, &index, error));
        const ps_device_limits *const one = &limits[index];
        first = first != NULL ? first : one;
        PS_TRY(may_be_mixed ? PSPEC_OK : compare_kinds(first, one, error));
        ps_text_append_once(names, one->name, " + ");
    }
    return ps_text_check(names, error);
}

static pspec_status find_devices(ps_selectors *out, ps_text *names, const ps_request *request,
                                 ps_error *error) {
    ps_device_limits *limits = NULL;
    size_t num = 0;
    PS_TRY(ps_device_list(&limits, &num, error));
    pspec_status status = ps_selectors_find(out, limits, num, request->limits.device, error);
    if (status == PSPEC_OK) {
        status = look_at_devices(names, out, limits, num, request->limits.mixed, error);
    }
    free(limits);
    return status;
}

pspec_status ps_devices_of_rank(ps_text *out, const char *selector, size_t own, size_t num,
                                ps_error *error) {
    ps_selectors all;
    ps_device_limits *limits = NULL;
    size_t num_devices = 0;
    PS_TRY(ps_device_list(&limits, &num_devices, error));
    const pspec_status status = ps_selectors_find(&all, limits, num_devices, selector, error);
    free(limits);
    PS_TRY(status);
    const size_t step = num > 0 && num < all.num ? num : all.num;
    for (size_t i = own % step; i < all.num; i += step) {
        ps_text_append(out, "%s%s", out->length > 0 ? "," : "", all.of[i].text);
    }
    return ps_text_check(out, error);
}

/* ---- which parts ----------------------------------------------------------------------------- */

/* So many of a device that the last ones leave few idle, and what each begins with (a plan, an
 * engine) is little of its work: two halves of a CPU do 0.83 to 0.92 of twice what one processor
 * does (docs/user/scaling.md). */
enum { PARTS_OF_DEVICE = 4 };

/* The parts, or why the first device does it all; "": it does not. */
static pspec_status plan(ps_crew_task *task, ps_error *why, ps_error *error) {
    const ps_request *const request = task->request;
    ps_outlook outlook = {.counts = request->range.end == 0};
    ps_table_format format = PS_FORMAT_CSV;
    uint64_t found = 0;
    ps_sharing_look(why, task->kind, request);
    if (why->message[0] == '\0') {
        PS_TRY(ps_sharing_find_begun(&found, why, request, error));
    }
    if (why->message[0] != '\0') {
        return PSPEC_OK;
    }
    PS_TRY(ps_answer_check_outputs(&format, task->kind, request, task->hooks, error));
    const pspec_status status = task->kind->look_ahead(&outlook, request, task->hooks, error);
    ps_text_free(&outlook.alike);
    PS_TRY(status);
    task->num_jobs = outlook.num_jobs;
    task->num_realizations =
        outlook.counts ? outlook.num_realizations : request->range.end - request->range.first;
    ps_sharing_look_at_job(why, &outlook, task->num_realizations);
    return why->message[0] != '\0'
               ? PSPEC_OK
               : ps_sharing_choose_parts(&task->num_parts, found,
                                         PARTS_OF_DEVICE * (uint64_t)task->selectors->num,
                                         task->num_realizations, error);
}

static void warn(const ps_crew_task *task, const ps_error *why) {
    const size_t num = task->selectors->num;
    if (why->message[0] != '\0') {
        ps_answer_warn(task->hooks, "the first of %zu devices works alone: %s", num, why->message);
    } else if (task->num_parts < num) {
        ps_answer_warn(task->hooks,
                       "%zu of %zu devices have nothing to do: realizations are shared in blocks "
                       "of %d, of which there are %llu",
                       num - (size_t)task->num_parts, num, PS_SUM_BLOCK,
                       (unsigned long long)task->num_parts);
    }
}

/* ---- all of it ------------------------------------------------------------------------------- */

/* ps_answer_make, or ps_answer_produce. */
typedef pspec_status answer_one(ps_answer *out, const ps_kind *kind, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error);

/* A job and what its parts came to; parts NULL: the first device is to do it all, unless it is done
 * by a team. */
typedef struct sharing {
    bool is_done;
    ps_selectors selectors;
    ps_text names;      /* of the devices */
    ps_request request; /* with the plans that the parts follow */
    ps_replan *replans; /* of its questions; NULL: those that they make themselves */
    ps_crew_task task;
    ps_crew_part *parts;
} sharing;

/* What the parts came to; *is_again: their powers need other plans, which the request has now. */
static pspec_status merge(ps_answer *out, sharing *self, bool *is_again, ps_pool *memory,
                          ps_error *error) {
    const size_t num = (size_t)self->task.num_parts;
    const ps_table **tables = NULL;
    const char **names = NULL;
    PS_TRY(PS_POOL_NEW(memory, &tables, num, "answers", error));
    PS_TRY(PS_POOL_NEW(memory, &names, num, "answers", error));
    for (size_t part = 0; part < num; part++) {
        ps_text name = {0};
        ps_text_append(&name, "part %zu", part + 1);
        PS_TRY(ps_text_keep(&names[part], memory, &name, error));
        tables[part] = self->parts[part].answer.table;
    }
    PS_TRY(ps_parts_plan_again(is_again, self->replans, ps_request_num_questions(&self->request),
                               tables, names, num, error));
    return *is_again ? PSPEC_OK : ps_parts_merge(out, &self->request, tables, names, num, error);
}

/* Checkpoints of parts are there until the answer is. */
static void end_parts(sharing *self, bool is_written) {
    for (uint64_t part = 0; part < self->task.num_parts; part++) {
        ps_answer_free(&self->parts[part].answer);
        ps_part_end(&self->parts[part].part, is_written);
    }
}

static pspec_status answer_parts(ps_answer *out, sharing *self, ps_error *error) {
    const size_t num_questions = ps_request_num_questions(&self->request);
    bool is_again = true;
    PS_TRY(PS_NEW(&self->parts, self->task.num_parts, "parts of a job", error));
    PS_TRY(PS_NEW(&self->replans, num_questions, "plans", error));
    while (is_again) {
        ps_pool memory = {0};
        PS_TRY(ps_crew_answer(self->parts, &self->task, error));
        const pspec_status status = merge(out, self, &is_again, &memory, error);
        ps_pool_free(&memory);
        PS_TRY(status);
        if (is_again) {
            end_parts(self, false);
            self->request.replans = self->replans;
        }
    }
    return PSPEC_OK;
}

/* Of a kind that has rows; why not is said as of parts. */
static pspec_status answer_as_team(ps_answer *out, sharing *self, answer_one *one,
                                   ps_error *error) {
    const ps_crew_task *const crew = &self->task;
    const ps_device_team_task task = {one,         crew->kind,      crew->request,
                                      crew->hooks, crew->selectors, crew->device};
    ps_error why = {0};
    uint64_t num = 0;
    if (crew->hooks->team != NULL) {
        ps_fail(&why, PSPEC_ERROR_INVALID_ARGUMENT, "ranks share the realizations");
    } else {
        PS_TRY(crew->kind->look_at_shares(&num, &why, crew->request, error));
    }
    self->task.num_parts = crew->selectors->num; /* as parts there is one for each */
    warn(crew, &why);
    self->is_done = why.message[0] == '\0';
    if (self->is_done && num < crew->selectors->num) {
        ps_answer_warn(crew->hooks, "%zu of %zu devices have nothing to do: there is work for %zu",
                       crew->selectors->num - (size_t)num, crew->selectors->num, (size_t)num);
    }
    return self->is_done ? ps_device_team_answer(out, &task, error) : PSPEC_OK;
}

/* *self is given to `end`, also after an error. */
static pspec_status answer(ps_answer *out, sharing *self, const ps_kind *kind,
                           const ps_request *request, const ps_answer_hooks *hooks, answer_one *one,
                           ps_error *error) {
    ps_error why = {0};
    *self = (sharing){.request = *request};
    self->task = (ps_crew_task){
        .kind = kind, .request = &self->request, .hooks = hooks, .selectors = &self->selectors};
    *out = (ps_answer){0};
    if (!ps_selector_is_list(request->limits.device) || kind->is_of_host) {
        return PSPEC_OK;
    }
    PS_TRY(find_devices(&self->selectors, &self->names, request, error));
    self->task.device = ps_text_string(&self->names);
    if (self->selectors.num == 1) {
        return PSPEC_OK;
    }
    if (kind->look_at_shares != NULL) {
        return answer_as_team(out, self, one, error);
    }
    PS_TRY(plan(&self->task, &why, error));
    warn(&self->task, &why);
    return why.message[0] == '\0' ? answer_parts(out, self, error) : PSPEC_OK;
}

static void end(sharing *self, bool is_written) {
    if (self->parts != NULL) {
        end_parts(self, is_written);
    }
    free(self->parts);
    free(self->replans);
    ps_text_free(&self->names);
}

pspec_status ps_devices_make(ps_answer *out, const ps_kind *kind, const ps_request *request,
                             const ps_answer_hooks *hooks, ps_error *error) {
    sharing shared;
    const pspec_status status = answer(out, &shared, kind, request, hooks, ps_answer_make, error);
    const bool is_shared = shared.is_done || shared.parts != NULL;
    end(&shared, status == PSPEC_OK);
    PS_TRY(status);
    return is_shared ? PSPEC_OK : ps_answer_make(out, kind, request, hooks, error);
}

pspec_status ps_devices_produce(ps_answer *out, const ps_kind *kind, const ps_request *request,
                                const ps_answer_hooks *hooks, ps_error *error) {
    sharing shared;
    ps_request own = *request;
    ps_table_format format = PS_FORMAT_CSV;
    if (ps_selector_is_list(own.limits.device)) { /* all that is to be written is asked for */
        PS_TRY(ps_table_choose_format(&format, own.format, own.output, error));
        own.wants_state = own.wants_state || format == PS_FORMAT_NPZ || own.range.end > 0;
    }
    pspec_status status = answer(out, &shared, kind, &own, hooks, ps_answer_produce, error);
    const bool is_shared = shared.is_done || shared.parts != NULL;
    if (status == PSPEC_OK && shared.parts != NULL) {
        ps_answer_end(hooks);
        status = ps_answer_write(out, kind, &own, format, hooks, error);
    }
    end(&shared, status == PSPEC_OK);
    return is_shared || status != PSPEC_OK ? status
                                           : ps_answer_produce(out, kind, request, hooks, error);
}
