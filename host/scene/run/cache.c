/* Answers in the cache of results: under which key, and what is kept of them. */
#include "answers/checkpoints.h"
#include "scene/run/run.h"

#include <stdlib.h>
#include <string.h>

/* ---- the cache ---------------------------------------------------------------- */

static pspec_status identify_device(ps_run *run, ps_text *out, ps_error *error) {
    ps_device_limits *all = NULL;
    size_t num = 0;
    size_t index = 0;
    ps_error none = {0};
    const pspec_status listed = ps_device_list(&all, &num, &none);
    if (listed == PSPEC_ERROR_NO_DEVICE) {
        run->kind = ps_device_kind_of(NULL);
        ps_device_identify(out, NULL);
        return PSPEC_OK;
    }
    if (listed != PSPEC_OK) {
        *error = none;
        return listed;
    }
    ps_device *opened = NULL; /* where only that tells the kind */
    pspec_status status = ps_device_choose(all, num, run->arguments->limits.device, &index, error);
    if (status == PSPEC_OK && all[index].units == PS_UNITS_UNKNOWN) {
        PS_TRY_OUT(status, ps_device_open(&opened, run->arguments->limits.device, false, error));
        all[index] = *ps_device_get_limits(opened);
    }
    if (status == PSPEC_OK) {
        const ps_device_limits *const limits = &all[index];
        ps_device_identify(out, limits);
        run->kind = ps_device_kind_of(limits);
    }
out:
    ps_device_close(opened);
    free(all);
    return status;
}

/* Not where skips are off. Kernels of somebody's own are not part of the key: their results are not
 * kept. A record is repeated to see whether this machine gives the same bits, which a cache of the
 * run itself would answer by what it wrote. */
const char *ps_run_find_why_uncached(const ps_request *arguments, const ps_scene *scene) {
    return arguments->cache_bytes == 0              ? "--cache 0 keeps no answers"
           : arguments->accuracy.no_skip            ? "--no-skip keeps no answers"
           : arguments->limits.cache_folder == NULL ? "there is no folder to keep answers in"
           : getenv("POINTSPEC_KERNEL_DIR") != NULL
               ? "answers of kernels in POINTSPEC_KERNEL_DIR are not kept"
           : scene->num_digests > 0 ? "answers that repeat a record are not kept"
                                    : NULL;
}

pspec_status ps_run_open_cache(ps_run *run, ps_error *error) {
    const uint64_t most = run->arguments->cache_bytes;
    ps_text folder = {0};
    ps_error reason = {0};
    /* The program is one of the things that results depend on; where the system does not show it,
     * nothing is kept. */
    const bool is_known = ps_answer_identify_program(&run->identity, &reason) == PSPEC_OK;
    PS_TRY(identify_device(run, &run->identity, error));
    PS_TRY(ps_text_check(&run->identity, error));
    if (!is_known || ps_run_find_why_uncached(run->arguments, run->scene) != NULL) {
        return PSPEC_OK;
    }
    ps_text_append(&folder, "%s/results", run->arguments->limits.cache_folder);
    pspec_status status = ps_text_check(&folder, &reason);
    if (status == PSPEC_OK) {
        status = ps_cache_open(&run->cache, ps_text_string(&folder), most, &reason);
    }
    if (status != PSPEC_OK) {
        ps_answer_warn(&run->hooks, "no cache of results: %s", reason.message);
    }
    ps_text_free(&folder);
    return PSPEC_OK;
}

/* ---- keys of the cache ------------------------------------------------------------------- */

/* Everything that the bits of an answer depend on: the program, the device, the question, and what
 * is in the files. */
static pspec_status add_file(void *payload, const ps_request_file *input, ps_error *error) {
    char digest[PS_DIGEST_BYTES];
    ps_text *const key = payload;
    PS_TRY(ps_digest_file(input->path, digest, error));
    ps_text_append(key, "file %s\n", digest);
    return PSPEC_OK;
}

static pspec_status make_key(const ps_run *run, ps_run_question *question, ps_error *error) {
    ps_text *const key = &question->key;
    const ps_request *const request = &question->asked.request;
    ps_text_append(key, "%s%s\npicture %d\narray %d %d\nno-skip %d\n",
                   ps_text_string(&run->identity), request->command_line, request->wants_picture,
                   request->wants_array, request->wants_coefficients, request->accuracy.no_skip);
    PS_TRY(ps_request_visit_inputs(request, add_file, key, error));
    return ps_text_check(key, error);
}

/* ---- to and fro ------------------------------------------------------------------------------ */

void ps_run_warn_of_cache(const ps_run *run, ps_error *reason) {
    if (ps_cache_first_failure(run->cache)) {
        ps_answer_warn(&run->hooks, "the cache of results: %s", reason->message);
    }
    *reason = (ps_error){0};
}

static const char seconds_name[] = "seconds_taken";

/* What another version may have put there is no answer: PSPEC_ERROR_INPUT. */
static pspec_status read_answer(ps_run_question *out, const ps_npz_file *file, ps_error *error) {
    const ps_npz_array *const taken = ps_npz_find(file, seconds_name);
    if (taken == NULL || taken->kind != 'f' || taken->rank != 0) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is no answer", ps_npz_name(file));
    }
    memcpy(&out->seconds, taken->data, sizeof out->seconds);
    return ps_table_take_npz(&out->answer.table, file, error);
}

/* Nobody knows what a program will print. */
static bool is_kept(const ps_run *run, const ps_run_question *question) {
    return run->cache != NULL && !ps_request_has_programs(&question->asked.request);
}

pspec_status ps_run_fetch(ps_run *run, ps_run_question *question, ps_error *error) {
    const ps_text *const key = &question->key;
    ps_npz_file *file = NULL;
    ps_error reason = {0};
    if (!is_kept(run, question)) {
        return PSPEC_OK;
    }
    PS_TRY(make_key(run, question, error));
    pspec_status status = ps_cache_find(run->cache, key->data, key->length, &file, &reason);
    if (file != NULL) {
        status = read_answer(question, file, &reason);
    }
    if (status != PSPEC_OK) {
        ps_run_warn_of_cache(run, &reason);
    }
    question->is_cached = question->answer.table != NULL;
    ps_npz_free(file);
    return PSPEC_OK;
}

static pspec_status write_answer(ps_cache *cache, ps_npz **npz, const ps_run_question *question,
                                 ps_error *error) {
    const double *const seconds = &question->seconds;
    const ps_npz_array taken = {seconds_name, 'f', sizeof *seconds, 0, NULL, seconds};
    PS_TRY(ps_npz_add(*npz, &taken, error));
    PS_TRY(ps_table_add_to_npz(question->answer.table, *npz, error));
    return ps_cache_end(cache, npz, error);
}

void ps_run_keep(ps_run *run, const ps_run_question *question) {
    const ps_text *const key = &question->key;
    ps_npz *npz = NULL;
    ps_error reason = {0};
    if (!is_kept(run, question)) {
        return;
    }
    pspec_status status = ps_cache_begin(run->cache, key->data, key->length, &npz, &reason);
    if (status == PSPEC_OK) {
        status = write_answer(run->cache, &npz, question, &reason);
    }
    ps_npz_discard(&npz);
    if (status != PSPEC_OK) {
        ps_run_warn_of_cache(run, &reason);
    }
}
