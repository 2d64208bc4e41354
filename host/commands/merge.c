/* pointspec merge: answers to one question of other realizations, saved as NPZ, as one answer. */
#include "answers/kind.h"
#include "answers/output_check.h"
#include "base/memory.h"
#include "base/text.h"

typedef struct parts {
    size_t num;
    ps_table **tables;  /* [num] */
    const char **names; /* [num], in quotes */
    ps_pool memory;     /* of these */
} parts;

static void discard(parts *self) {
    for (size_t i = 0; i < self->num; i++) {
        ps_table_destroy(self->tables[i]);
    }
    ps_pool_free(&self->memory);
}

static pspec_status load(parts *self, const ps_request *request, ps_error *error) {
    const size_t num = request->num_files;
    PS_TRY(PS_POOL_NEW(&self->memory, &self->tables, num, "answers", error));
    PS_TRY(PS_POOL_NEW(&self->memory, &self->names, num, "answers", error));
    self->num = num;
    for (size_t i = 0; i < num; i++) {
        ps_text name = {0};
        ps_text_append(&name, "\"%s\"", request->files[i]);
        PS_TRY(ps_text_keep(&self->names[i], &self->memory, &name, error));
        PS_TRY(ps_table_read_npz(&self->tables[i], request->files[i], error));
    }
    return PSPEC_OK;
}

static pspec_status merge(ps_answer *out, parts *self, const ps_request *request,
                          const ps_answer_hooks *hooks, ps_error *error) {
    PS_TRY(load(self, request, error));
    const ps_parts all = {.tables = (const ps_table *const *)self->tables,
                          .names = self->names,
                          .num = self->num,
                          .command_line = request->command_line,
                          .device = request->limits.device,
                          .cache_folder = request->limits.cache_folder,
                          .hooks = hooks};
    return ps_answer_merge(out, &all, error);
}

/* Parts that are missing at the end, or the beginning, may be forgotten. */
static void warn_of_range(const ps_answer *answer, const ps_answer_hooks *hooks) {
    const ps_cell range = ps_table_find_meta(answer->table, "range");
    if (range.kind == PS_CELL_TEXT) {
        ps_answer_warn(hooks,
                       "these are the realizations %s: an answer for merge again, which has its "
                       "sums where the output is NPZ",
                       range.text);
    }
}

/* An output NULL is none. */
static pspec_status run(ps_answer *out, const ps_request *request, const ps_answer_hooks *hooks,
                        ps_error *error) {
    ps_table_format format = PS_FORMAT_CSV;
    parts self = {0};
    if (request->num_files == 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "there are no answers to merge: pointspec merge A.npz B.npz");
    }
    PS_TRY(ps_outputs_check(request, true, error));
    PS_TRY(ps_table_choose_format(&format, request->format, request->output, error));
    pspec_status status = merge(out, &self, request, hooks, error);
    discard(&self);
    if (status == PSPEC_OK) {
        warn_of_range(out, hooks);
    }
    if (status == PSPEC_OK && request->output != NULL) {
        ps_table_set_view(out->table, &request->view);
        status = ps_table_write(out->table, request->output, format, error);
    }
    return status;
}

const ps_command ps_command_merge = {
    .name = "merge",
    .purpose = "the answer of the realizations of several answers",
    .usage = "merge [options] FILE...",
    .description =
        "Reads answers of power, angular or pairs to one question, which -o FILE.npz saved with "
        "their sums over realizations, or ranges of one job of these and of quadrature, variance, "
        "shade, interpolation, occlusion and measure, and prints the answer of all their "
        "realizations, of the first file first: what one job would have printed, but for last "
        "digits of the sums. "
        "Dimension, frequencies, rings, normalization, and samplers where there are several, must "
        "be the same; numbers of points, engines and tolerances may differ. Realizations of one "
        "sampler and seed are the same in every answer: give each part a seed of its own, or a "
        "range of the realizations of one job (--range). Ranges may come in any order; when they "
        "are all of the job, the answer has the bits of the job, and exit status 3 says that its "
        "powers need a more exact plan. Ranges that overlap, or leave a gap, are refused. The "
        "output is merged again where it is NPZ.",
    .takes = PS_COMMAND_BIT(merge),
    .examples = {"for s in 1 2; do pointspec power --sampler white -n 64 -k 4 -m 8 --seed $s -o "
                 "part$s.npz; done && pointspec merge part1.npz part2.npz",
                 "pointspec merge part1.npz part2.npz -o both.npz"},
    .speaker = "pointspec merge",
    .run = run,
};
