/* pointspec doctor: what works here, and what does not. */
#include "cli/command.h"
#include "commands/doctor.h"
#include "store/result_cache.h"

#include <stdio.h>

static void print(ps_finding_kind kind, const char *topic, const char *sentence, void *payload) {
    (void)payload;
    printf("%-6s %-8s ", ps_finding_words[kind], topic);
    for (; *sentence != '\0'; sentence++) { /* names of files may hold anything */
        putchar((unsigned char)*sentence < ' ' || *sentence == 0x7f ? '?' : *sentence);
    }
    putchar('\n');
}

static pspec_status run(ps_answer *out, const ps_request *arguments, const ps_answer_hooks *hooks,
                        ps_error *error) {
    (void)out, (void)hooks;
    if (arguments->num_files > 0) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no file is read, but %s was given",
                       arguments->files[0]);
    }
    ps_text folder = {0}; /* also one that is not trusted, which is then a finding */
    ps_error ignored = {0};
    const bool has_folder = ps_cache_default_directory(&folder, &ignored) == PSPEC_OK;
    const ps_doctor doctor = {.device = arguments->limits.device,
                              .cache_folder = has_folder ? ps_text_string(&folder) : NULL,
                              .hear = print};
    const pspec_status status = ps_doctor_examine(&doctor, error);
    ps_text_free(&folder);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return ps_fail(error, PSPEC_ERROR_IO, "cannot write standard output");
    }
    return status;
}

const ps_command ps_command_doctor = {
    .name = "doctor",
    .purpose = "say what works here: drivers, devices, caches, memory, threads, gnuplot",
    .usage = "doctor [options]",
    .description =
        "Looks at what pointspec depends on and says what it finds, a sentence a line: the OpenCL "
        "drivers and why one does not load, whether a kernel builds on every device and computes "
        "what is known, the folders of caches and what they hold, limits of memory, processors, "
        "gnuplot. Lines begin "
        "with ok, with note where something is missing that can be done without, or with WRONG. "
        "The exit status is 0 when the default device works, 3 when it does not.",
    .takes = PS_COMMAND_BIT(doctor),
    .examples = {"pointspec doctor", "pointspec doctor --device cpu"},
    .run = run,
};
