/* The record of a run: the scene as JSON, which can be run again, with what it gave, by what, and
 * where. */
#include "pointspec_version.h"
#include "scene/run/run.h"

#include <stdlib.h>
#include <string.h>

static void print_pair(const char *key, const char *value, ps_text *out) {
    ps_text_append(out, ",\n    \"%s\": ", key);
    ps_scene_print_text(value, out);
}

static const char *meta_text(const ps_table *table, const char *key) {
    return ps_cell_text(ps_table_find_meta(table, key));
}

/* "(torus_nufft" of "(torus_nufft precision=single ..)". */
static bool begin_alike(const char *a, const char *b) {
    const size_t length = strcspn(a, " )");
    return length == strcspn(b, " )") && strncmp(a, b, length) == 0;
}

/* A question of several samplers and numbers of points has such an entry for each of them: nothing
 * unless all name the same, and the name alone where the rest differs. */
static void print_common(const ps_table *table, const char *wanted, ps_text *out) {
    const char *const first = meta_text(table, wanted);
    bool is_common = first[0] != '\0';
    bool is_same = true;
    for (size_t i = 0; i < ps_table_num_meta(table); i++) {
        const char *key = NULL;
        const ps_cell cell = ps_table_meta(table, i, &key);
        if (strcmp(key, wanted) == 0 && cell.kind == PS_CELL_TEXT) {
            is_common = is_common && begin_alike(cell.text, first);
            is_same = is_same && strcmp(cell.text, first) == 0;
        }
    }
    if (is_common && is_same) {
        ps_text_append(out, ", \"%s\": ", wanted);
        ps_scene_print_text(first, out);
    } else if (is_common) { /* "(torus_nufft precision=single ..)" */
        ps_text_append(out, ", \"%s\": \"%.*s)\"", wanted, (int)strcspn(first, " )"), first);
    }
}

/* The devices that results say they were made on; that of the first with one. */
static const char *find_device(const ps_run *run) {
    for (size_t i = 0; i < run->num_results; i++) {
        const char *const device = meta_text(run->results[i].questions[0].answer.table, "device");
        if (device[0] != '\0' && strcmp(device, "none") != 0) {
            return device;
        }
    }
    return "none";
}

static void print_question(const ps_run_question *question, ps_text *out) {
    const ps_table *const table = question->answer.table;
    ps_text_append(out, "\n      {\"command\": ");
    ps_scene_print_text(question->asked.request.command_line, out);
    print_common(table, "engine", out);
    print_common(table, "precision", out);
    ps_text_append(out, ", \"skipped\": ");
    ps_scene_print_text(meta_text(table, "skipped"), out);
    ps_text_append(out, ", \"seed\": \"%llu\", \"seconds\": \"%.6f\", \"from_cache\": \"%s\"}",
                   (unsigned long long)question->asked.request.seed, question->seconds,
                   question->is_cached ? "true" : "false");
}

/* What a question was answered with, for each in their order. */
static void print_all(const ps_run *run, bool are_digests, ps_text *out) {
    for (size_t i = 0; i < run->num_questions; i++) {
        ps_text_append(out, "%s", i > 0 ? "," : "");
        if (are_digests) {
            ps_text_append(out, "\n      \"%s\"", run->questions[i].digest);
        } else {
            print_question(&run->questions[i], out);
        }
    }
}

/* Paths of the record are those of the scene: this is the folder they are relative to, wherever the
 * record lies. */
static pspec_status print_folder(const ps_run *run, ps_text *out, ps_error *error) {
    const char *const folder = run->scene->folder;
    char *const absolute = realpath(folder[0] != '\0' ? folder : ".", NULL);
    if (absolute == NULL) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot find the folder of the scene \"%s\"",
                       run->scene->path);
    }
    ps_text path = {0};
    ps_text_append(&path, "%s/", absolute);
    print_pair("folder", ps_text_string(&path), out);
    out->failed = out->failed || path.failed;
    ps_text_free(&path);
    free(absolute);
    return PSPEC_OK;
}

pspec_status ps_run_record(const ps_run *run, ps_text *out, ps_error *error) {
    ps_scene_print(run->scene, out);
    ps_text_append(out, ",\n  \"record\": {\n    \"pointspec_version\": ");
    ps_scene_print_text(PS_VERSION, out);
    print_pair("device", find_device(run), out);
    print_pair("kind", run->kind.text, out);
    /* version and digest of the program; platform, name, driver and lanes of the device */
    print_pair("identity", ps_text_string(&run->identity), out);
    print_pair("command", run->arguments->command_line, out);
    PS_TRY(print_folder(run, out, error));
    ps_text_append(out, ",\n    \"questions\": [");
    print_all(run, false, out);
    ps_text_append(out, "\n    ],\n    \"files\": [");
    ps_run_print_files(run, out);
    ps_text_append(out, "\n    ],\n    \"digests\": [");
    print_all(run, true, out);
    ps_text_append(out, "\n    ]\n  }\n}\n");
    return ps_text_check(out, error);
}
