/* Fields of several kinds of answers. */
#include "answers/kind.h"

#define OF(name) PS_COMMAND_BIT(name)
#define TORUS (OF(power) | OF(check) | OF(variance))
#define SPHERE (OF(angular) | OF(pairs) | OF(check) | OF(variance))
#define SPECTRA (TORUS | SPHERE)
#define RULES (OF(quadrature) | OF(shade))
#define SETS (RULES | OF(interpolation) | OF(occlusion) | OF(measure))

const char *const ps_field_groups[] = {[PS_FIELD_ENTRY] = "entry",
                                       [PS_FIELD_COLUMN] = "column",
                                       [PS_FIELD_ARRAY] = "array",
                                       [PS_FIELD_STATE] = "state"};

const ps_field_row ps_fields_asked[] = {
    {"pointspec_version", "", PS_ENTRY, 0, "", "version of the program"},
    {"schema", "", PS_ENTRY, 0, "", "number of the format of the table"},
    {"command", "", PS_ENTRY, 0, "", "the command line"},
    {"normalization", "", PS_ENTRY, SPECTRA | RULES, "",
     "what power means, and how weights and numbers of points count in it"},
    {"seed", "", PS_ENTRY, SPECTRA | SETS | OF(sample), "samplers, --per-ring",
     "seed of the random numbers"},
    {"homogenize", "", PS_ENTRY, SPECTRA, "samplers",
     "yes or no: was every realization moved at random?"},
    {"false_alarm_rate", "", PS_ENTRY, OF(check) | OF(variance), "check, --rates, --rank",
     "probability that anything differs by chance"},
    {"brdf", "", PS_ENTRY, RULES | OF(truncation), "", "the lobe"},
    {"smoothness", "", PS_ENTRY, RULES | OF(truncation), "", "s of the space of integrands"},
    {"note", "", PS_ENTRY, RULES | OF(truncation) | OF(check), "where there is one",
     "what else there is to know: of a lobe, or of a seed that both sides of a check have"},
    {.name = NULL}};

const ps_field_row ps_fields_points[] = {
    {"sampler", "", PS_ENTRIES, SPECTRA | SETS | OF(sample), "samplers, --set",
     "the sampler, or the name of the set of files"},
    {"sampler_note", "", PS_ENTRIES, SPECTRA | OF(sample), "some samplers",
     "what else there is to know of its points"},
    {"input", "", PS_ENTRIES, SPECTRA | SETS, "several files",
     "how many files, and how many realizations make the one average; of variance how many of them "
     "predict"},
    {"input_format", "", PS_ENTRIES, SPECTRA, "files", "the format that files were read as"},
    {"input_columns", "", PS_ENTRIES, SPECTRA, "files", "what their columns were taken for"},
    {"box", "", PS_ENTRIES, SPECTRA | SETS, "files in a box",
     "the box of the first set, as --box has it, where it is not [0,1)^d"},
    {"box_changes", "", PS_ENTRIES, TORUS, "files in boxes that differ",
     "edges of the boxes of the sets, from the shortest to the longest of each axis"},
    {"lift", "", PS_ENTRIES, SPHERE | SETS, "files, --lift",
     "where points of the plane were lifted to, sphere or hemisphere"},
    {"morph", "", PS_ENTRIES, SPHERE | SETS, "files, --lift hemisphere",
     "the lobe whose density the lifted points have"},
    {"points", "", PS_ENTRIES, SPECTRA | SETS | OF(sample), "",
     "N; of sets with different N their mean"},
    {"points_smallest", "", PS_ENTRIES, SPECTRA | SETS, "sets with different N",
     "N of the smallest set"},
    {"points_largest", "", PS_ENTRIES, SPECTRA | SETS, "sets with different N",
     "N of the largest set"},
    {"realizations", "", PS_ENTRIES, SPECTRA | SETS | OF(sample), "",
     "M, how many sets were averaged"},
    {"standard_error", "", PS_ENTRIES, SPECTRA, "one realization",
     "that there is none, or of what it is with --per-ring"},
    {"noise_level_db", "dB", PS_ENTRIES, TORUS, "several realizations",
     "-10 log10(M), the anisotropy that M random sets leave"},
    {"weight_sum", "", PS_ENTRIES, SPECTRA | RULES, "",
     "sum of the weights, mean over the realizations"},
    {"different_points", "", PS_ENTRIES, SPECTRA & ~OF(pairs), "N that differ by more than a tenth",
     "how sets of different N count"},
    {"relative_standard_error", "", PS_ENTRIES,
     OF(power) | OF(angular) | OF(pairs) | OF(quadrature), "--standard-error",
     "asked for, reached or not, and the largest, with and without the correction"},
    {"empty", "", PS_ENTRIES, TORUS, "files with a gap",
     "a piece of an axis where the first set has no point: points of a smaller box"},
    {"vectors", "", PS_ENTRIES, SPHERE, "files of vectors",
     "how far from 1 the lengths were that vectors were divided by"},
    {"domain", "", PS_ENTRIES, SPHERE | OF(sample) | OF(measure), "on the sphere",
     "sphere, or hemisphere, even degrees; of points also torus"},
    {"max_degree", "", PS_ENTRIES, SPHERE | RULES | OF(measure), "on the sphere",
     "L, the last degree; on the hemisphere the last even one"},
    {"dimension", "", PS_ENTRIES, TORUS | OF(sample) | OF(measure), "on the torus", "d"},
    {"max_frequency", "", PS_ENTRIES, TORUS | OF(measure), "on the torus",
     "K; of a list of frequencies its largest |k_i|"},
    {"rings", "", PS_ENTRIES, OF(power) | OF(check), "boxes that are no cubes",
     "what |k| is there, and how large single |k_i| are"},
    {"bins", "", PS_ENTRIES, OF(power) | OF(check), "--bins",
     "the rule of the rings, where it is not rounding"},
    {"per_ring", "", PS_ENTRIES, OF(power) | OF(check), "--per-ring",
     "most frequencies of the half lattice that were computed of a ring"},
    {"computed", "", PS_ENTRIES, OF(power) | OF(check), "--per-ring",
     "how many frequencies were computed, of how many"},
    {"sampler", "", PS_COLUMN, (SPECTRA & ~OF(check)) | SETS, "several samplers, --set",
     "the sampler, or the name of the set of files"},
    {"integrand", "", PS_COLUMN, OF(variance) | OF(interpolation), "several integrands",
     "the integrand"},
    {"points", "", PS_COLUMN, (SPECTRA & ~OF(check)) | RULES | OF(occlusion) | OF(measure),
     "several numbers of points",
     "N as it was asked for; of variance, where it is always there, the mean where sets differ"},
    {.name = NULL}};

/* Of kinds that ranges of realizations are put together of. */
const ps_field_row ps_fields_ranges[] = {
    {"merged", "", PS_ENTRIES, 0, "pointspec merge", "the command line of a part"},
    {"range", "", PS_ENTRIES, 0, "--range",
     "A:B of M: the realizations A to B - 1 of a job of M, a part for merge"},
    {.name = NULL}};

const ps_field_row ps_fields_computed[] = {
    {"device", "", PS_ENTRIES, 0, "", "what computed it; host or none without OpenCL"},
    {"engine", "", PS_ENTRIES, 0, "", "the engine, and how it was set up"},
    {"precision", "", PS_ENTRIES, 0, "", "arithmetic of the engine, single or double"},
    {"tolerance", "", PS_ENTRIES, SPECTRA | RULES | OF(truncation), "",
     "largest numerical error that was allowed (--tol)"},
    {"predicted_error", "", PS_ENTRIES, SPECTRA | RULES | OF(truncation) | OF(measure), "",
     "bound on the numerical error, in the same unit"},
    {"planned_twice", "", PS_ENTRIES, SPECTRA, "large powers",
     "that a more exact engine was needed after the first run"},
    {"self_check", "", PS_ENTRIES, SPECTRA | RULES | OF(truncation), "",
     "how far a part of it is from what another algorithm gives"},
    {"skipped", "", PS_ENTRIES, 0, "",
     "what was not computed because the question does not need it"},
    {.name = NULL}};

const ps_field_row ps_fields_device[] = {
    {"device", "", PS_ENTRY, 0, "", "what was tried; none without OpenCL"},
    {"platform", "", PS_ENTRY, 0, "", "as its driver says"},
    {"driver", "", PS_ENTRY, 0, "", "its version, as it says"},
    {.name = NULL}};

pspec_status ps_fields_create_table(ps_table **out, const char *command, const ps_field_row *rows,
                                    ps_error *error) {
    enum { MOST_COLUMNS = 32 };
    const char *columns[MOST_COLUMNS];
    size_t num = 0;
    for (; rows->name != NULL; rows++) {
        if (rows->group == PS_FIELD_COLUMN && num < MOST_COLUMNS) {
            columns[num++] = rows->name;
        }
    }
    return ps_table_create(out, command, columns, num, error);
}

static bool belongs(const ps_field_row *row, const ps_kind *kind) {
    return row->kinds == 0 || (row->kinds & kind->takes) != 0;
}

pspec_status ps_kind_visit_fields(const ps_kind *kind,
                                  pspec_status (*visit)(const ps_field_row *row, void *payload,
                                                        ps_error *error),
                                  void *payload, ps_error *error) {
    for (const ps_field_row *const *list = kind->fields; *list != NULL; list++) {
        for (const ps_field_row *row = *list; row->name != NULL; row++) {
            if (belongs(row, kind)) {
                PS_TRY(visit(row, payload, error));
            }
        }
    }
    return PSPEC_OK;
}
