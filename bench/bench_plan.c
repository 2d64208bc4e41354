/* Are the seconds that `pointspec plan` prints the seconds that the command takes?
 *
 *     bench_plan [PROGRAM [PART]]     all questions, or those whose command line has PART
 *     bench_plan --quick PROGRAM      a few, for the tests: with the built-in figures, twice each, within a factor of 4
 *
 * Calibrates first, in a cache of its own, then asks every question of plan_questions.h and runs it
 * six times, the first to build kernels. Beside every run a yardstick is run; times are divided by
 * it and are those of a machine where the yardstick takes what it took beside the calibration. Ends
 * with how many are within a factor of 1.5, and of 3; a plan that says "at most" has to be at most
 * 1.5 times too low.
 */
#include "bench.h"
#include "plan_questions.h"

#include "base/workers.h"

#include <fcntl.h>
#include <ftw.h>
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

enum { REPEATS = 5, QUICK_REPEATS = 2, MOST_WORDS = 40, LINE = 1024 };

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

/* Of the machine that the built-in figures are of: see host/plan/phases.c. */
static const double usual_single = 14e-3, usual_all = 16e-3;

/* Seconds of one thread, and of as many as there are processors. */
typedef struct yardstick {
    double single, all;
} yardstick;

/* The best of three: a processor that slept takes milliseconds to wake up. */
static yardstick run_yardstick(void) {
    enum { TRIES = 3 };
    yardstick out = {HUGE_VAL, HUGE_VAL};
    for (int i = 0; i < TRIES; i++) {
        yard_sums sums = {{0}};
        const size_t many = (size_t)1 << 40;
        const double begin = bench_seconds();
        measure_yard(&sums, 0, 1);
        const double middle = bench_seconds();
        ps_workers_share(many, measure_yard, &sums);
        out.single = fmin(out.single, middle - begin);
        out.all = fmin(out.all, bench_seconds() - middle);
    }
    return out;
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

/* What takes the old file away when a new one takes its place is no part of a plan. */
static void remove_output(const char *line) {
    const char *const place = strstr(line, " -o "); /* the last words of a question */
    if (place != NULL) {
        unlink(place + strlen(" -o "));
    }
}

/* The middle of so many runs; of two the better. */
static answer ask(const char *program, const char *line, const yardstick *usual, int repeats) {
    const double many = 1.4; /* processors at work: threads were */
    answer out = {0};
    double seconds[REPEATS];
    double yards[REPEATS];
    double cpus[REPEATS];
    run_command(program, "plan", line, "plan.csv");
    read_plan(&out);
    run_command(program, "", line, "ignored");
    yardstick before = run_yardstick();
    for (int i = 0; i < repeats; i++) {
        remove_output(line);
        const used time = run_command(program, "", line, "ignored");
        const yardstick after = run_yardstick();
        const double single = (before.single + after.single) / 2 / usual->single;
        const double all = (before.all + after.all) / 2 / usual->all;
        yards[i] = time.cpu_seconds > many * time.seconds ? all : single;
        seconds[i] = time.seconds / yards[i];
        cpus[i] = time.cpu_seconds / time.seconds;
        before = after;
    }
    out.measured = bench_median(seconds, (size_t)repeats);
    out.measured = repeats < REPEATS ? seconds[0] : out.measured;
    out.yard = bench_median(yards, (size_t)repeats);
    out.cpu = bench_median(cpus, (size_t)repeats);
    return out;
}

/* ---- the folder ---------------------------------------------------------------------------- */

static void enter_folder(char *folder) {
    if (mkdtemp(folder) == NULL || chdir(folder) != 0) {
        bench_die("no folder can be made");
    }
}

static int remove_one(const char *path, const struct stat *what, int kind, struct FTW *at) {
    (void)what, (void)kind, (void)at;
    return remove(path);
}

static void remove_folder(const char *folder) {
    enum { DESCRIPTORS = 16 };
    nftw(folder, remove_one, DESCRIPTORS, FTW_DEPTH | FTW_PHYS);
}

static void make_scenes(void) {
    for (size_t i = 0; i < sizeof plan_scenes / sizeof plan_scenes[0]; i++) {
        FILE *const file = fopen(plan_scenes[i].name, "w");
        if (file == NULL || fputs(plan_scenes[i].text, file) == EOF || fclose(file) != 0) {
            bench_die("a scene cannot be written");
        }
    }
}

/* Calibrates, and makes the files of the questions. Returns what the yardstick takes just after:
 * the middle, as figures are those of middle runs, and after a command each, as beside the
 * questions, since a processor that was busy runs at another speed (measured: 1.2 times as long in
 * a row of yardsticks). */
static yardstick prepare(const char *program, bool is_calibrated) {
    enum { FILES = sizeof plan_files / sizeof plan_files[0] - 1 };
    double single[FILES];
    double all[FILES];
    if (is_calibrated) {
        run_command(program, "", "bench --calibrate", "calibration.csv");
    }
    make_scenes();
    for (size_t i = 0; i < FILES; i++) {
        run_command(program, "", plan_files[i], "ignored");
        const yardstick found = run_yardstick();
        single[i] = found.single;
        all[i] = found.all;
    }
    return is_calibrated ? (yardstick){bench_median(single, FILES), bench_median(all, FILES)}
                         : (yardstick){usual_single, usual_all};
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

/* ---- all ----------------------------------------------------------------------------------- */

typedef struct battery {
    const char *program, *part; /* part: of the command lines that are asked; "" for all */
    const char *const *questions;
    yardstick usual;
    int repeats;
    double good, bad; /* factors */
    size_t num, num_good, num_bad;
} battery;

static double factor_of(const answer *found) {
    const double ratio = found->planned / found->measured;
    return found->is_at_most ? 1 / ratio : fmax(ratio, 1 / ratio);
}

static void ask_all(battery *series) {
    printf("        planned measured  ratio    yardstick processors  question\n");
    for (size_t i = 0; series->questions[i] != NULL; i++) {
        const char *const line = series->questions[i];
        if (strstr(line, series->part) == NULL) {
            continue;
        }
        const answer found = ask(series->program, line, &series->usual, series->repeats);
        const double off = factor_of(&found);
        const char *const mark = off > series->bad ? "!!" : off > series->good ? "!" : "";
        printf("%7s %7.3g %8.3g %6.2f %-2s %9.2f %10.1f  %s\n", found.is_at_most ? "at most" : "",
               found.planned, found.measured, found.planned / found.measured, mark, found.yard,
               found.cpu, line);
        fflush(stdout);
        series->num++;
        series->num_good += off <= series->good;
        series->num_bad += !(off <= series->bad);
    }
    printf("# %zu of %zu within a factor of %g, %zu beyond %g\n", series->num_good, series->num,
           series->good, series->num_bad, series->bad);
}

int main(int argc, char **argv) {
    const bool is_quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    const int first = is_quick ? 2 : 1;
    char program[PATH_MAX];
    char folder[] = "/tmp/bench_plan.XXXXXX";
    battery all = {.program = program,
                   .part = argc > first + 1 ? argv[first + 1] : "",
                   .questions = is_quick ? plan_quick : plan_questions,
                   .repeats = is_quick ? QUICK_REPEATS : REPEATS,
                   .good = is_quick ? 4 : 1.5,
                   .bad = is_quick ? 4 : 3};
    if (argc <= first) {
        find_program(program, argv[0]);
    } else if (realpath(argv[first], program) == NULL) {
        bench_die("no such program");
    }
    enter_folder(folder);
    setenv("POINTSPEC_CACHE_DIR", "cache", 1);
    all.usual = prepare(program, !is_quick);
    if (!is_quick) {
        printf("# yardstick beside the calibration: %.3g s of one thread, %.3g s of all\n",
               all.usual.single, all.usual.all);
    }
    ask_all(&all);
    remove_folder(folder);
    return is_quick && all.num_bad > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
