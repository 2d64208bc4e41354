#include "answers/checkpoints.h"

#include "files/digest.h"
#include "pointspec_version.h"
#include "request/point_source.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char own_program[] = "/proc/self/exe";

enum { MOST_PATH = 4096 };

/* The file that this code was loaded from: the program, or the library in that of somebody else. */
static void find_file(char path[MOST_PATH]) {
    const uintptr_t here = (uintptr_t)find_file;
    char line[MOST_PATH + 128];
    FILE *const maps = fopen("/proc/self/maps", "r");
    snprintf(path, MOST_PATH, "%s", own_program);
    while (maps != NULL && fgets(line, sizeof line, maps) != NULL) {
        uintptr_t first = 0;
        uintptr_t last = 0;
        int at = 0;
        const int num =
            sscanf(line, "%" SCNxPTR "-%" SCNxPTR " %*s %*s %*s %*s %n", &first, &last, &at);
        if (num == 2 && at > 0 && first <= here && here < last) {
            snprintf(path, MOST_PATH, "%.*s", (int)strcspn(line + at, "\n"), line + at);
        }
    }
    if (maps != NULL) {
        fclose(maps);
    }
}

/* One that was removed meanwhile has no name, but the system shows the program all the same. */
pspec_status ps_answer_identify_program(ps_text *out, ps_error *error) {
    char path[MOST_PATH];
    char digest[PS_DIGEST_BYTES];
    ps_error none;
    find_file(path);
    if (ps_digest_file(path, digest, &none) != PSPEC_OK) {
        PS_TRY(ps_digest_file(own_program, digest, error));
    }
    ps_text_append(out, "pointspec %s %s\n", PS_VERSION, digest);
    return ps_text_check(out, error);
}

/* ---- the question ---------------------------------------------------------------------------- */

static void add_option(ps_text *key, const ps_request *request, ps_option_id id) {
    const ps_option *const option = &ps_options[id];
    const size_t *const num =
        (const size_t *)(const void *)((const char *)request + option->offset_of_number);
    if (option->offset_of_number == 0) {
        ps_text_append(key, "%s %s\n", option->name,
                       request->said[id] != NULL ? request->said[id] : "");
        return;
    }
    const char *const *const texts =
        (const char *const *)(const void *)((const char *)request + option->offset);
    for (size_t i = 0; i < *num; i++) {
        ps_text_append(key, "%s %s\n", option->name, texts[i]);
    }
}

/* In the order of the table, whatever that of the command line was: what belongs to the question,
 * and nothing of how it is computed or what becomes of the answer. */
static void add_question(ps_text *key, const ps_request *request, const ps_kind *kind) {
    ps_text_append(key, "%s\n", kind->name);
    for (size_t i = 0; i < request->num_sources; i++) {
        ps_text_append(key, "sampler %s\n", ps_request_source_name(request, i));
    }
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        const bool is_source = id == PS_OPTION_SAMPLER || id == PS_OPTION_SET;
        const bool is_asked =
            (ps_options[id].questions & kind->takes) != 0 || id == PS_OPTION_RANGE;
        if (request->is_given[id] && !is_source && is_asked) {
            add_option(key, request, (ps_option_id)id);
        }
    }
}

static pspec_status add_file(void *payload, const ps_request_file *input, ps_error *error) {
    ps_text *const key = payload;
    char digest[PS_DIGEST_BYTES];
    if (ps_points_program(input->path) != NULL) {
        return ps_programs_refuse("--checkpoint", error);
    }
    if (ps_request_file_comes_once(input)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "%s \"%s\" comes once, and a job with --checkpoint reads its input again",
                       input->option.text, input->path);
    }
    PS_TRY(ps_digest_file(input->path, digest, error));
    ps_text_append(key, "%s %s, digest %s\n", input->option.text, input->path, digest);
    return PSPEC_OK;
}

/* Of all sets of a caller together. */
static pspec_status add_given(ps_text *key, const ps_given_set *given, ps_error *error) {
    char digest[PS_DIGEST_BYTES] = "none";
    if (given->num == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "checkpoint: sets that a function gives are not known again; files, sets in "
                       "memory and samplers are");
    }
    for (uint64_t i = 0; i < given->num; i++) {
        char points[PS_DIGEST_BYTES];
        char weights[PS_DIGEST_BYTES] = "none";
        char line[4 * PS_DIGEST_BYTES];
        pspec_pattern set = {0};
        bool has_set = false;
        PS_TRY(given->next(given->payload, i, &set, &has_set, error));
        ps_digest_bytes(set.points, set.num_points * set.dimension * sizeof *set.points, points);
        if (set.weights != NULL) {
            ps_digest_bytes(set.weights, set.num_points * sizeof *set.weights, weights);
        }
        snprintf(line, sizeof line, "%s %u %s %s", digest, set.dimension, points, weights);
        ps_digest_bytes(line, strlen(line), digest);
    }
    ps_text_append(key, "set %s, digest %s\n", given->name, digest);
    return PSPEC_OK;
}

/* ---- all of it ------------------------------------------------------------------------------- */

static void say(const char *sentence, void *payload) {
    ps_answer_warn(payload, "%s", sentence);
}

unsigned ps_answer_num_checkpoints(const ps_request *request, const ps_kind *kind) {
    return (unsigned)(kind->count_jobs != NULL ? kind->count_jobs(request)
                                               : ps_request_num_questions(request));
}

pspec_status ps_answer_begin_checkpoints(ps_request *request, const ps_kind *kind, ps_text *key,
                                         const ps_answer_hooks *hooks, ps_error *error) {
    ps_checkpoint_spec *const spec = &request->limits.checkpoint;
    if (spec->path == NULL) {
        return PSPEC_OK;
    }
    spec->num_parts = ps_answer_num_checkpoints(request, kind);
    if (request->integrands_given.num > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "checkpoint: functions of a caller are not known again");
    }
    PS_TRY(ps_answer_identify_program(key, error));
    add_question(key, request, kind);
    PS_TRY(ps_request_visit_inputs(request, add_file, key, error));
    for (size_t i = 0; i < request->reading.given.num; i++) {
        PS_TRY(add_given(key, &request->reading.given.sets[i], error));
    }
    PS_TRY(ps_text_check(key, error));
    spec->key = ps_text_string(key);
    spec->log = (ps_log){say, (void *)hooks};
    return PSPEC_OK;
}

void ps_answer_end_checkpoints(const ps_request *request) {
    const ps_checkpoint_spec *const spec = &request->limits.checkpoint;
    if (spec->path != NULL) {
        ps_checkpoint_remove(spec->path, spec->part, spec->num_parts);
    }
}
