/* The program: finds the command, parses its words, runs it, turns its status into an exit code and
 * its message into one line on standard error. */
#include "base/process/memory_limit.h"
#include "base/text.h"
#include "cli/command.h"
#include "pointspec_version.h"
#include "request/options.h"
#include "store/cache_trust.h"
#include "store/result_cache.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* ---- the process --------------------------------------------------------------------------- */

/* A process may be started with its standard streams closed. Files opened later must not get their
 * numbers, or messages would go into them. The stand-ins refuse what the stream is for: results
 * that cannot be written are an error. */
static void occupy_standard_streams(void) {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++) {
        if (fcntl(descriptor, F_GETFD) == -1 && errno == EBADF) {
            (void)!open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

static void prepare_process(void) {
    occupy_standard_streams();
    ps_signals_prepare();
}

/* ---- messages ------------------------------------------------------------------------------ */

/* One line, whatever control characters came in with a name or value; build logs keep their lines.
 */
static int report(const char *command, pspec_status status, ps_error *error) {
    if (ps_ranks_find_own() > 0) {
        return ps_exit_code(status); /* rank 0 says it */
    }
    const bool nobody_reads = status == PSPEC_ERROR_IO && ps_signals_pipe_closed();
    const int code = nobody_reads ? PS_EXIT_PIPE : ps_exit_code(status);
    ps_signals_end(code);
    if (nobody_reads) {
        return code; /* head(1) has seen enough: no reason for a sentence */
    }
    for (char *c = error->message; *c != '\0' && status != PSPEC_ERROR_BUILD; c++) {
        if ((unsigned char)*c < ' ' || *c == 0x7f) {
            *c = '?';
        }
    }
    fprintf(stderr, "pointspec%s%s: %s\n", command[0] != '\0' ? " " : "", command, error->message);
    return code;
}

/* For texts on standard output: a full disk is an error there too. */
static int finish_output(void) {
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return PS_EXIT_DONE;
    }
    ps_error error = {0};
    return report("", ps_fail(&error, PSPEC_ERROR_IO, "cannot write standard output"), &error);
}

/* ---- commands ------------------------------------------------------------------------------ */

/* A folder that others can write is as good as none, for whatever the command would take from it.
 */
static void trust_cache(const ps_command *command, ps_request *arguments, const char *folder) {
    ps_error reason = {0};
    if (ps_cache_check_folder(folder, &reason) == PSPEC_OK) {
        arguments->limits.cache_folder = folder;
    } else if ((ps_command_takes(command, PS_OPTION_DEVICE) ||
                ps_command_takes(command, PS_OPTION_KEPT_SETS)) &&
               !arguments->quiet) {
        fprintf(stderr, "pointspec: no cache: %s\n", reason.message);
    }
}

/* POINTSPEC_MEMORY counts as if it had been typed, and so it is part of the command that results
 * keep. */
static pspec_status take_memory(const ps_command *command, ps_request *arguments, ps_text *line,
                                ps_error *error) {
    const char *const limit = getenv("POINTSPEC_MEMORY");
    if (limit == NULL || limit[0] == '\0' || arguments->is_given[PS_OPTION_MEMORY] ||
        !ps_command_takes(command, PS_OPTION_MEMORY)) {
        return PSPEC_OK;
    }
    PS_TRY(ps_parse_size(limit, "POINTSPEC_MEMORY", &arguments->limits.constraints.memory_limit,
                         error));
    arguments->is_memory_of_environment = true;
    ps_text_append(line, " --memory");
    ps_text_append_word(line, limit);
    return ps_text_check(line, error);
}

/* The request that the words make, and the whole line, which results keep. */
static pspec_status parse(const ps_command *command, int num_words, char **words,
                          ps_request *arguments, ps_text *line, ps_error *error) {
    ps_text rest = {0};
    ps_text_append(line, "pointspec");
    ps_text_append_word(line, words[0]);
    for (int i = 1; i < num_words; i++) {
        ps_text_append_word(&rest, words[i]); /* before the parser, which cuts words */
    }
    pspec_status status = ps_arguments_parse(arguments, command, num_words - 1, words + 1, error);
    if (status == PSPEC_OK && !arguments->is_given[PS_OPTION_HELP]) {
        status = take_memory(command, arguments, line, error);
    }
    ps_text_append_bytes(line, ps_text_string(&rest), rest.length);
    line->failed = line->failed || rest.failed;
    ps_text_free(&rest);
    arguments->command_line = ps_text_string(line);
    return status == PSPEC_OK ? ps_text_check(line, error) : status;
}

static bool has_output(const ps_command *command, const ps_request *arguments) {
    return !command->makes_folder && !(command->makes_points && ps_request_only_draws(arguments));
}

/* Finds what the words left open: where output goes, the device, and the cache, in *folder. */
static pspec_status complete(const ps_command *command, ps_request *arguments,
                             const ps_ranks *ranks, ps_text *folder, ps_error *error) {
    if (arguments->output == NULL && has_output(command, arguments)) {
        arguments->output = "-"; /* in the library NULL is no output */
    }
    /* Who types a command means it; who is given a scene has not read it. */
    arguments->reading.programs.may_run =
        arguments->is_given[PS_OPTION_ALLOW_EXEC] || ps_request_has_programs(arguments);
    if (ranks == NULL) { /* mpirun has a terminal of its own, whatever the output goes to */
        ps_terminal_settle(command, arguments);
    }
    if (!arguments->is_given[PS_OPTION_DEVICE]) {
        arguments->limits.device = getenv("POINTSPEC_DEVICE");
    }
    const pspec_status status = ps_cache_default_directory(folder, error);
    if (status == PSPEC_OK) {
        trust_cache(command, arguments, ps_text_string(folder));
    }
    return status == PSPEC_ERROR_MEMORY ? status : PSPEC_OK; /* there need not be a cache */
}

/* A signal may make anything fail that was going on (a compiler in the driver, a read): what the
 * user did is the reason, not what it led to. */
static pspec_status blame_signal(pspec_status status, ps_error *error) {
    return status != PSPEC_OK && ps_interrupted && strstr(error->message, "interrupted") == NULL
               ? ps_fail(error, PSPEC_ERROR_CANCELLED, "interrupted")
               : status;
}

/* The module is beside the program where it was built, or where it was installed. */
static pspec_status open_ranks(ps_ranks **out, ps_error *error) {
    char program[PATH_MAX];
    ps_text installed = {0};
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    char *const slash = strrchr(program, '/');
    program[slash != NULL ? slash - program : 0] = '\0';
    ps_text_append(&installed, "%s/%s", program, PS_MODULES_FROM_PROGRAM);
    pspec_status status = ps_text_check(&installed, error);
    if (status == PSPEC_OK) {
        const char *const folders[] = {program, ps_text_string(&installed), NULL};
        status = ps_ranks_open(out, folders, error);
    }
    ps_text_free(&installed);
    if (status == PSPEC_OK && ps_ranks_own(*out) > 0) {
        ps_signals_end(PS_EXIT_INTERRUPTED); /* rank 0 says it, too */
    }
    return status;
}

/* words: those after "pointspec". */
static int run_command(int num_words, char **words, ps_ranks *ranks) {
    ps_error error = {0};
    ps_request arguments;
    ps_text line = {0};
    ps_text folder = {0};
    const ps_command *const command = ps_command_find(words[0], &error);
    if (command == NULL) {
        return report("", error.status, &error);
    }
    pspec_status status = parse(command, num_words, words, &arguments, &line, &error);
    status = ps_ranks_agree(ranks, status, &error);
    const bool wants_help = status == PSPEC_OK && arguments.is_given[PS_OPTION_HELP];
    if (wants_help && ps_ranks_own(ranks) == 0) {
        ps_help_command(stdout, command);
    } else if (status == PSPEC_OK && !wants_help &&
               (status = complete(command, &arguments, ranks, &folder, &error)) == PSPEC_OK) {
        status = blame_signal(ps_shown_run(command, &arguments, ranks, &error), &error);
    }
    ps_arguments_free(&arguments);
    ps_text_free(&folder);
    ps_text_free(&line);
    if (status == PSPEC_OK) {
        ps_signals_end(PS_EXIT_DONE);
    }
    return wants_help           ? finish_output()
           : status == PSPEC_OK ? PS_EXIT_DONE
                                : report(command->name, status, &error);
}

/* name, topic: words that may be NULL. */
static int run_help(const char *name, const char *topic) {
    ps_error error = {0};
    const ps_command *const command = name != NULL ? ps_command_find(name, &error) : NULL;
    if (name != NULL && command == NULL) {
        return report("help", error.status, &error);
    }
    if (topic != NULL && strcmp(topic, "fields") == 0) {
        const pspec_status status = ps_help_fields(stdout, command, &error);
        return status == PSPEC_OK ? finish_output() : report("help", status, &error);
    }
    if (command != NULL) {
        ps_help_command(stdout, command);
    } else {
        ps_help_program(stdout);
    }
    return finish_output();
}

/* Without any argument: what there is, in two lines. */
static int complain_of_nothing(void) {
    fputs("usage: pointspec COMMAND [options] [FILE...]\ncommands:", stderr);
    for (size_t i = 0; ps_commands[i] != NULL; i++) {
        fprintf(stderr, " %s%s", ps_commands[i]->name, ps_commands[i + 1] != NULL ? "," : "");
    }
    fputs("; pointspec --help tells more\n", stderr);
    return PS_EXIT_USAGE;
}

static int fail_program_option(const char *word) {
    ps_error error = {0};
    const char *const name = word + strspn(word, "-");
    const size_t to_version = ps_name_distance(name, "version");
    const size_t to_help = ps_name_distance(name, "help");
    const bool is_version = to_version < to_help;
    return report(
        "",
        ps_fail(&error, PSPEC_ERROR_INVALID_ARGUMENT,
                "unknown option %s%s; options of a command stand after its name", word,
                ps_text_suggest(name, is_version ? "version" : "help",
                                is_version ? to_version : to_help, "; did you mean --", "?")
                    .text),
        &error);
}

/* Below this the end comes in the middle of the work, by SIGSEGV: blocks of files alone are 64 KiB
 * on the stack. */
static pspec_status check_stack(ps_error *error) {
    enum { LEAST_BYTES = 256 << 10 };
    struct rlimit limit;
    return getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
                   limit.rlim_cur >= LEAST_BYTES
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY,
                         "the limit of stacks, %llu KiB (ulimit -s), is below the %d KiB that this "
                         "program and its threads need",
                         (unsigned long long)limit.rlim_cur >> 10, LEAST_BYTES >> 10);
}

/* Words that are answered without a command. */
static bool is_about_program(const char *word) {
    static const char *const words[] = {"--version", "-V", "--help", "-h", "help"};
    size_t i = 0;
    while (i < sizeof words / sizeof words[0] && strcmp(word, words[i]) != 0) {
        i++;
    }
    return i < sizeof words / sizeof words[0];
}

int main(int argc, char **argv) {
    ps_error error = {0};
    prepare_process();
    if (argc < 2) {
        return complain_of_nothing();
    }
    const char *const first = argv[1];
    if (ps_ranks_find_own() > 0 && is_about_program(first)) {
        return PS_EXIT_DONE; /* rank 0 says it */
    }
    if (strcmp(first, "--version") == 0 || strcmp(first, "-V") == 0) {
        printf("pointspec %s\n", pspec_version());
        return finish_output();
    }
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0) {
        return run_help(NULL, NULL);
    }
    if (strcmp(first, "help") == 0) {
        return run_help(argc > 2 ? argv[2] : NULL, argc > 3 ? argv[3] : NULL);
    }
    if (first[0] == '-') {
        return fail_program_option(first);
    }
    ps_ranks *ranks = NULL;
    if (check_stack(&error) != PSPEC_OK || open_ranks(&ranks, &error) != PSPEC_OK) {
        return report("", error.status, &error);
    }
    const int code = run_command(argc - 1, argv + 1, ranks);
    ps_ranks_close(ranks);
    return code;
}
