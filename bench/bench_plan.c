/* Are the seconds that `pointspec plan` prints the seconds that the command takes?
 *
 *     bench_plan [PROGRAM [PART]]     all questions, or those whose command line has PART
 *
 * Calibrates first, in a cache of its own, then asks every question of plan_questions.h and runs it six times, the first to
 * build kernels. Beside every run a yardstick is run; times are divided by it and are those of a machine where the
 * yardstick takes what it took beside the calibration. Ends with how many are within a factor of 1.5, and of 3.
 */
#include "bench.h"
#include "plan_questions.h"

#include "base/workers.h"

#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

#ifndef R
#define R 5
#endif
enum { REPEATS = R, MOST_WORDS = 40, LINE = 1024 };

/* ---- the yardstick ------------------------------------------------------------------------- */

typedef struct yard_sums {
    double sums[64];
} yard_sums;

/* Arithmetic that no cache or memory holds up, in every thread. */
static void measure_yard(void *payload, unsigned index, unsigned count) {
    enum { STEPS = 3000000 };
    (void)count;
    double x[8] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    for (int i = 0; i < STEPS; i++) {
        for (int j = 0; j < 8; j++) {
            x[j] = x[j] * 0.999999 + 1e-7 * x[(j + 1) % 8];
        }
    }
    ((yard_sums *)payload)->sums[index % 64] = x[0] + x[3];
}

/* Seconds of one thread, and of as many as there are processors. */
typedef struct yardstick {
    double single, all;
} yardstick;

static yardstick run_yardstick(void) {
    yard_sums of = {{0}};
    const size_t many = (size_t)1 << 40;
    const double begin = bench_seconds();
    measure_yard(&of, 0, 1);
    const double middle = bench_seconds();
    ps_workers_share(many, measure_yard, &of);
    return (yardstick){middle - begin, bench_seconds() - middle};
}

/* ---- commands ------------------------------------------------------------------------------ */

typedef struct command {
    char line[LINE];
    char *words[MOST_WORDS];
} command;

static void split(command *out, const char *program, const char *prefix, const char *line) {
    size_t num = 0;
    snprintf(out->line, sizeof out->line, "%s%s%s", prefix, prefix[0] != '\0' ? " " : "", line);
    out->words[num++] = (char *)program;
    for (char *word = strtok(out->line, " "); word != NULL && num < MOST_WORDS - 1;
         word = strtok(NULL, " ")) {
        out->words[num++] = word;
    }
    out->words[num] = NULL;
}

typedef struct used {
    double seconds, cpu_seconds;
} used;

/* Of all processors, by children that have ended. */
static double children_seconds(void) {
    const double micro = 1e-6;
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           micro * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/* Runs it with its output in a file. */
static used run_command(const char *program, const char *prefix, const char *line,
                        const char *output) {
    command what;
    posix_spawn_file_actions_t actions;
    pid_t pid = 0;
    int status = 0;
    split(&what, program, prefix, line);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output, O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "errors",
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const double cpu = children_seconds();
    const double begin = bench_seconds();
    if (posix_spawn(&pid, program, &actions, NULL, what.words, environ) != 0) {
        bench_die("the program cannot be started");
    }
    waitpid(pid, &status, 0);
    const double seconds = bench_seconds() - begin;
    posix_spawn_file_actions_destroy(&actions);
    if (!WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 3)) {
        fprintf(stderr, "%s %s\n", prefix, line);
        if (prefix[0] == '\0') {
            bench_die("this command failed");
        }
    }
    return (used){seconds, children_seconds() - cpu};
}

/* ---- a question ---------------------------------------------------------------------------- */

typedef struct answer {
    double planned, measured, cpu, yard;
    bool is_at_most;
} answer;

/* "# seconds: 1.2" or "# seconds: at most 1.2", of all jobs. */
static void read_plan(answer *out) {
    char line[8192];
    FILE *file = fopen("plan.csv", "r");
    if (file == NULL) {
        bench_die("there is no plan");
    }
    while (fgets(line, sizeof line, file) != NULL) {
        static const char total[] = "# seconds: ";
        static const char most[] = "at most ";
        if (strncmp(line, total, strlen(total)) == 0) {
            const char *text = line + strlen(total);
            const bool is_at_most = strncmp(text, most, strlen(most)) == 0;
            out->is_at_most = out->is_at_most || is_at_most;
            out->planned += strtod(text + (is_at_most ? strlen(most) : 0), NULL);
        }
    }
    fclose(file);
}

static answer ask(const char *program, const char *line, const yardstick *usual) {
    answer out = {0};
    double seconds[REPEATS];
    double yards[REPEATS];
    double cpus[REPEATS];
    run_command(program, "plan", line, "plan.csv");
    read_plan(&out);
    run_command(program, "", line, "ignored");
    yardstick before = run_yardstick();
    for (int i = 0; i < REPEATS; i++) {
        const double many = 1.4; /* processors at work: threads were */
        const used time = run_command(program, "", line, "ignored");
        const yardstick after = run_yardstick();
        const double single = (before.single + after.single) / 2 / usual->single;
        const double all = (before.all + after.all) / 2 / usual->all;
        yards[i] = time.cpu_seconds > many * time.seconds ? all : single;
        seconds[i] = time.seconds / yards[i];
        cpus[i] = time.cpu_seconds;
        before = after;
    }
    out.measured = bench_median(seconds, REPEATS);
    out.yard = bench_median(yards, REPEATS);
    out.cpu = bench_median(cpus, REPEATS);
    return out;
}

/* ---- the folder ---------------------------------------------------------------------------- */

static void enter_folder(char *folder) {
    if (mkdtemp(folder) == NULL || chdir(folder) != 0) {
        bench_die("no folder can be made");
    }
}

static yardstick calibrate(const char *program) {
    enum { YARDS = 2 * REPEATS };
    double single[YARDS];
    double all[YARDS];
    for (int i = 0; i < YARDS; i++) {
        if (i == YARDS / 2 && getenv("BENCH_PLAN_CALIBRATED") == NULL) {
            setenv("POINTSPEC_CACHE_DIR", "cache", 1);
            run_command(program, "", "bench --calibrate", "calibration.csv");
        }
        const yardstick yard = run_yardstick();
        single[i] = yard.single;
        all[i] = yard.all;
    }
    return (yardstick){bench_median(single, YARDS), bench_median(all, YARDS)};
}

static void find_program(char *path, const char *self) {
    char beside[PATH_MAX];
    snprintf(beside, sizeof beside, "%s", self);
    char *const slash = strrchr(beside, '/');
    snprintf(slash != NULL ? slash : beside, 32, "%s", "/../pointspec");
    if (realpath(beside, path) == NULL) {
        bench_die("there is no program beside this one");
    }
}

int main(int argc, char **argv) {
    const double good = 1.5;
    const double bad = 3;
    char program[PATH_MAX];
    char folder[] = "/tmp/bench_plan.XXXXXX";
    size_t num = 0;
    size_t num_good = 0;
    size_t num_bad = 0;
    if (argc > 1) {
        if (realpath(argv[1], program) == NULL) {
            bench_die("no such program");
        }
    } else {
        find_program(program, argv[0]);
    }
    enter_folder(folder);
    const yardstick usual = calibrate(program);
    for (size_t i = 0; plan_files[i] != NULL; i++) {
        run_command(program, "", plan_files[i], "ignored");
    }
    printf("| question | planned, s | measured, s | ratio | yardstick | processors "
           "|\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; plan_questions[i] != NULL; i++) {
        if (argc > 2 && strstr(plan_questions[i], argv[2]) == NULL) {
            continue;
        }
        const answer found = ask(program, plan_questions[i], &usual);
        const double ratio = found.planned / found.measured;
        const double off = found.is_at_most ? 1 / ratio : fmax(ratio, 1 / ratio);
        printf("| `%s` | %s%.3f | %.3f | %.2f | %.2f | %.1f |%s\n", plan_questions[i],
               found.is_at_most ? "at most " : "", found.planned, found.measured, ratio, found.yard,
               found.cpu / (found.measured * found.yard),
               off > bad    ? " !!"
               : off > good ? " !"
                            : "");
        fflush(stdout);
        num++;
        num_good += off <= good;
        num_bad += off > bad;
    }
    printf("\n%zu of %zu within a factor of %.1f, %zu beyond %.0f\n", num_good, num, good, num_bad,
           bad);
    return 0;
}
