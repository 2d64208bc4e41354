/* The parser of the command line: forms of options, limits, and the sentences for what is wrong. */
#include "cli/command.h"

#include "request/options.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { MOST_WORDS = 24, MOST_BYTES = 256 };

/* A command with every option, and one with three: --device, --output and --format. */
static const ps_command large = {.name = "large", .takes = UINT32_MAX};
static const ps_command small = {
    .name = "small", .takes = PS_COMMAND_BIT(devices), .formats = "utk-text|npy"};

/* The words of a line that was parsed; the arguments point into them. */
typedef struct line {
    char bytes[MOST_BYTES];
    char *words[MOST_WORDS];
    int num_words;
    ps_request arguments;
    ps_error error;
} line;

/* text: words separated by single blanks. */
static pspec_status parse(line *out, const ps_command *command, const char *text) {
    *out = (line){0};
    assert_true(strlen(text) < MOST_BYTES);
    strcpy(out->bytes, text);
    for (char *word = strtok(out->bytes, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(out->num_words < MOST_WORDS);
        out->words[out->num_words++] = word;
    }
    return ps_arguments_parse(&out->arguments, command, out->num_words, out->words, &out->error);
}

static void must_parse(line *out, const char *text) {
    if (parse(out, &large, text) != PSPEC_OK) {
        fail_msg("%s: %s", text, out->error.message);
    }
}

static void table_is_complete(void **state) {
    (void)state;
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        assert_non_null(ps_options[id].name);
        assert_non_null(ps_options[id].help);
        assert_non_null(ps_options[id].set);
        for (int other = 0; other < id; other++) {
            assert_string_not_equal(ps_options[id].name, ps_options[other].name);
            assert_true(ps_options[id].letter == 0 ||
                        ps_options[id].letter != ps_options[other].letter);
        }
    }
}

static void nothing_leaves_the_defaults(void **state) {
    (void)state;
    line l;
    must_parse(&l, "");
    assert_int_equal(l.arguments.num_counts, 1);
    assert_int_equal(l.arguments.counts[0], 1024);
    assert_int_equal(l.arguments.num_realizations, 1);
    assert_int_equal(l.arguments.dimension, 2);
    assert_int_equal(l.arguments.seed, 1);
    assert_int_equal(l.arguments.limits.constraints.precision, -1);
    assert_true(l.arguments.accuracy.tolerance == 1e-6);
    assert_null(l.arguments.output);
    for (int id = 0; id < PS_NUM_OPTIONS; id++) {
        assert_false(l.arguments.is_given[id]);
    }
    ps_arguments_free(&l.arguments);
}

static void every_form_of_a_value_is_read(void **state) {
    (void)state;
    static const char *const forms[] = {"-n 4096",          "-n4096",     "--points 4096",
                                        "--points=4096",    "-n 4.096e3", "-n 7 -n 4096",
                                        "-n 7,8,9 -n 4096", "a -n 4096 b"};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        line l;
        must_parse(&l, forms[i]);
        assert_int_equal(l.arguments.num_counts, 1);
        assert_int_equal(l.arguments.counts[0], 4096);
        assert_true(l.arguments.is_given[PS_OPTION_POINTS]);
        ps_arguments_free(&l.arguments);
    }
}

static void every_option_finds_its_field(void **state) {
    (void)state;
    line l;
    must_parse(&l, "-m 3 -d 4 -s 18446744073709551615 --sampler a --sampler b:c=d -k 268435456 "
                   "--tol 0.5 --floor 1e-4 --precision double --normalize effective --no-skip");
    assert_int_equal(l.arguments.num_realizations, 3);
    assert_int_equal(l.arguments.dimension, 4);
    assert_true(l.arguments.seed == UINT64_MAX);
    assert_int_equal(l.arguments.num_sources, 2);
    assert_string_equal(l.arguments.sources[0].sampler, "a");
    assert_string_equal(l.arguments.sources[1].sampler, "b:c=d");
    assert_int_equal(l.arguments.frequencies.max_frequency, 1 << 28);
    assert_true(l.arguments.accuracy.tolerance == 0.5 && l.arguments.accuracy.floor == 1e-4);
    assert_int_equal(l.arguments.limits.constraints.precision, 1);
    assert_true(l.arguments.normalization == PSPEC_NORMALIZATION_EFFECTIVE &&
                l.arguments.accuracy.no_skip && !l.arguments.accuracy.no_self_check);
    ps_arguments_free(&l.arguments);
    must_parse(&l,
               "--bins width=4/6 --homogenize --wrap --no-self-check --profile --quiet --verbose "
               "--format json --input-format npy --precision auto -o out=1 --plot= x");
    assert_true(l.arguments.frequencies.bins.kind == PS_BINS_WIDTH &&
                l.arguments.frequencies.bins.numerator == 2 &&
                l.arguments.frequencies.bins.denominator == 3 && l.arguments.homogenize &&
                l.arguments.reading.wrap);
    assert_true(l.arguments.accuracy.no_self_check && l.arguments.limits.profile);
    assert_true(l.arguments.quiet && l.arguments.verbose && !l.arguments.accuracy.no_skip);
    assert_string_equal(l.arguments.format, "json");
    assert_string_equal(l.arguments.reading.format, "npy");
    assert_string_equal(l.arguments.output, "out=1");
    assert_string_equal(l.arguments.plot, "");
    assert_int_equal(l.arguments.limits.constraints.precision, -1);
    ps_arguments_free(&l.arguments);
}

static void files_are_all_other_words(void **state) {
    (void)state;
    line l;
    must_parse(&l, "a --quiet - b -o - -- -n --points");
    assert_int_equal(l.arguments.num_files, 5);
    assert_string_equal(l.arguments.files[0], "a");
    assert_string_equal(l.arguments.files[1], "-");
    assert_string_equal(l.arguments.files[4], "--points");
    assert_string_equal(l.arguments.output, "-");
    assert_false(l.arguments.is_given[PS_OPTION_POINTS]);
    ps_arguments_free(&l.arguments);
}

/* Also for a command whose list does not name it, and whatever follows. */
static void help_ends_the_line(void **state) {
    (void)state;
    static const char *const lines[] = {"--help", "-h", "-h --bogus", "x --help -n -1"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        line l;
        assert_int_equal(parse(&l, &small, lines[i]), PSPEC_OK);
        assert_true(l.arguments.is_given[PS_OPTION_HELP]);
        ps_arguments_free(&l.arguments);
    }
}

typedef struct bad_line {
    const char *text, *message;
} bad_line;

static void must_refuse(const ps_command *command, const bad_line *bad, size_t num) {
    for (size_t i = 0; i < num; i++) {
        line l;
        const pspec_status status = parse(&l, command, bad[i].text);
        ps_arguments_free(&l.arguments);
        if (status != PSPEC_ERROR_INVALID_ARGUMENT ||
            strcmp(l.error.message, bad[i].message) != 0) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", bad[i].text, (int)status,
                     l.error.message, bad[i].message);
        }
    }
}

static void numbers_have_limits(void **state) {
    (void)state;
    static const bad_line bad[] = {
        {"-n 1.5", "-n: \"1.5\" is not a whole number"},
        {"-n 0", "-n: 0 is not between 1 and 10000000000"},
        {"-n 1e30", "-n: 1e30 is not between 1 and 10000000000"},
        {"-n 99999999999999999999", "-n: 99999999999999999999 is not between 1 and 10000000000"},
        {"-n -5", "-n: -5 is not between 1 and 10000000000"},
        {"-n nan", "-n: \"nan\" is not a whole number"},
        {"-n 10k", "-n: \"10k\" is not a whole number"},
        {"--points 0", "--points: 0 is not between 1 and 10000000000"},
        {"-n5 --points=-1", "--points: -1 is not between 1 and 10000000000"},
        {"--points 5 -n0", "-n: 0 is not between 1 and 10000000000"},
        {"--max-frequency 0", "--max-frequency: 0 is not between 1 and 268435456"},
        {"-l 0", "-l: 0 leaves no degree, the first is 1"},
        {"-l 2.5", "-l: \"2.5\" is not a whole number"},
        {"--max-degree -1", "--max-degree: -1 leaves no degree, the first is 1"},
        {"--max-degree 32769",
         "--max-degree: degree 32769 is above 32768, where the coefficients of one set take 8 GiB"},
        {"--memory 4X", "--memory: \"4X\" is not a size above 0, such as 400M, 1.5G or 2e9"},
        {"--per-ring 1", "--per-ring: 1 is not between 2 and 536870912"},
        {"--smoothness x", "--smoothness: \"x\" is not a finite number"},
        {"--standard-error 2", "--standard-error: 2 is not above 0 and at most 1"},
        {"--false-alarm-rate 1",
         "--false-alarm-rate: 1 is not above 0 and below 1: every check would fail"},
        {"--false-alarm-rate 1.5",
         "--false-alarm-rate: 1.5 is not above 0 and below 1: every check would fail"},
        {"--false-alarm-rate 0", "--false-alarm-rate: 0 is not above 0 and below 1"},
        {"--shells", "unknown option --shells; it is --bins shells now"},
        {"--points=", "--points: \"\" is not a whole number"},
        {"-m 2e12", "-m: 2e12 is not between 1 and 1000000000000"},
        {"-d 7", "-d: 7 is not between 1 and 6"},
        {"-d0", "-d: 0 is not between 1 and 6"},
        {"-k -3", "-k: -3 is not between 1 and 268435456"},
        {"-k 268435457", "-k: 268435457 is not between 1 and 268435456"},
        {"-s 18446744073709551616",
         "-s: 18446744073709551616 is not between 0 and 18446744073709551615"},
        {"-s -1", "-s: -1 is not between 0 and 18446744073709551615"},
        {"--tol 0", "--tol: 0 is not above 0 and at most 1"},
        {"--tol 2", "--tol: 2 is not above 0 and at most 1"},
        {"--tol -1e-3", "--tol: -1e-3 is not above 0 and at most 1"},
        {"--tol 1e-999", "--tol: 1e-999 is not above 0 and at most 1"},
        {"--tol nan", "--tol: \"nan\" is not a finite number"},
        {"--tol -inf", "--tol: \"-inf\" is not a finite number"},
        {"--floor 0", "--floor: 0 is not above 0"},
        {"--floor 1e999", "--floor: \"1e999\" is not a finite number"},
    };
    must_refuse(&large, bad, sizeof bad / sizeof bad[0]);
}

static void words_are_checked(void **state) {
    (void)state;
    static const bad_line bad[] = {
        {"--precision half", "--precision: \"half\" is not one of auto, single, double, extended"},
        {"--normalize Power", "--normalize: \"Power\" is not one of power, effective, integral"},
        {"--format cs", "--format: \"cs\" is not one of csv, json, npy, npz, jsonl, text"},
        {"--format csv|json",
         "--format: \"csv|json\" is not one of csv, json, npy, npz, jsonl, text"},
        {"--format=", "--format: \"\" is not one of csv, json, npy, npz, jsonl, text"},
        {"--input-format exr",
         "--input-format: \"exr\" is not one of utk-text, csv, psa-text, gbn, "
         "edat, eps, utk-binary, rps, npy, openquad, utk1, lammps, xyz, ply, obj"},
        {"--to-columns xy", "--to-columns: \"xy\" is not one of xyz, xyzw, theta-phi, theta-phi-w, "
                            "phi-theta, phi-theta-w, lon-lat, lon-lat-w, theta-phi:degrees, "
                            "theta-phi-w:degrees, phi-theta:degrees, phi-theta-w:degrees"},
        {"--domain plane", "--domain: \"plane\" is not one of torus, sphere"},
    };
    static const bad_line bad_small[] = {
        {"--format csv", "--format: \"csv\" is not one of utk-text, npy"}};
    must_refuse(&large, bad, sizeof bad / sizeof bad[0]);
    must_refuse(&small, bad_small, 1);
}

static void ranges_have_ends(void **state) {
    (void)state;
    static const struct {
        const char *text;
        uint64_t first, last;
    } good[] = {{"3..7", 3, 7},
                {"3", 3, 3},
                {"3..", 3, UINT64_MAX},
                {"..7", 1, 7},
                {"1e3..2e3", 1000, 2000}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        line l;
        char text[64];
        snprintf(text, sizeof text, "--select-sets %s --select-points=%s", good[i].text,
                 good[i].text);
        must_parse(&l, text);
        assert_int_equal(l.arguments.reading.sets.first, good[i].first);
        assert_int_equal(l.arguments.reading.sets.last, good[i].last);
        assert_int_equal(l.arguments.points.first, good[i].first);
        assert_int_equal(l.arguments.points.last, good[i].last);
        ps_arguments_free(&l.arguments);
    }
    static const bad_line bad[] = {
        {"--select-sets ..", "--select-sets: \"..\" says neither end: A..B, or A, A.., ..B"},
        {"--select-sets=", "--select-sets: \"\" says neither end: A..B, or A, A.., ..B"},
        {"--select-points 7..3", "--select-points: \"7..3\": the first number is the larger one"},
        {"--select-points 0..3", "--select-points: 0 is not between 1 and 18446744073709551614"},
        {"--select-points 1..2..3", "--select-points: \"2..3\" is not a whole number"},
        {"--select-points 1-3", "--select-points: \"1-3\" is not a whole number"},
    };
    must_refuse(&large, bad, sizeof bad / sizeof bad[0]);
}

static void weights_are_words_where_no_file_is_taken(void **state) {
    (void)state;
    static const ps_command words_only = {
        .name = "words", .takes = PS_COMMAND_BIT(convert), .weights = "equal|column"};
    static const bad_line bad[] = {
        {"--weights file.txt", "--weights: \"file.txt\" is not one of equal, column"}};
    line l;
    must_refuse(&words_only, bad, 1);
    must_parse(&l, "--weights file.txt");
    assert_int_equal(l.arguments.weights.kind, PS_WEIGHTS_FILE);
    assert_string_equal(l.arguments.weights.path, "file.txt");
    ps_arguments_free(&l.arguments);
}

static void unknown_options_name_the_nearest(void **state) {
    (void)state;
    static const bad_line bad[] = {
        {"--pionts 5", "unknown option --pionts; did you mean --points?"},
        {"--pionts=5", "unknown option --pionts; did you mean --points?"},
        {"--dim 2", "unknown option --dim; did you mean --dimension?"},
        {"--tolerance 1", "unknown option --tolerance; did you mean --tol?"},
        {"--no-skips", "unknown option --no-skips; did you mean --no-skip?"},
        {"-quiet", "unknown option -quiet; did you mean --quiet?"},
        {"-N 5", "unknown option -N; did you mean -n?"},
        {"-q", "unknown option -q; did you mean --quiet?"},
        {"--quiet=yes", "--quiet takes no value"},
        {"-hx", "-h takes no value"},
    };
    static const bad_line bad_small[] = {
        {"--devise 0", "unknown option --devise; did you mean --device?"},
        {"--full x", "--full is not an option of this command"},
        {"--full=x", "--full is not an option of this command"},
        {"-n 5", "-n is not an option of this command"},
        {"-n5", "-n is not an option of this command"},
        {"--input-format x", "--input-format is not an option of this command"},
        {"--zebra", "unknown option --zebra"},
        {"-z", "unknown option -z"},
    };
    must_refuse(&large, bad, sizeof bad / sizeof bad[0]);
    must_refuse(&small, bad_small, sizeof bad_small / sizeof bad_small[0]);
}

static void missing_values_are_said(void **state) {
    (void)state;
    static const bad_line bad[] = {
        {"-n", "-n needs a value: -n N"},
        {"--points", "--points needs a value: --points N"},
        {"--sampler", "--sampler needs a value: --sampler NAME[:key=value,...]"},
        {"-o --quiet", "-o needs a value: -o FILE, but the option --quiet follows"},
        {"--plot -n 5", "--plot needs a value: --plot FILE, but the option -n follows"},
    };
    must_refuse(&large, bad, sizeof bad / sizeof bad[0]);
}

static void many_samplers_fit_and_one_more_does_not(void **state) {
    (void)state;
    ps_request arguments;
    ps_error error;
    char word[] = "--sampler=white";
    char *words[PS_MAX_SAMPLERS + 1];
    for (size_t i = 0; i <= PS_MAX_SAMPLERS; i++) {
        words[i] = word;
    }
    assert_int_equal(ps_arguments_parse(&arguments, &large, PS_MAX_SAMPLERS, words, &error),
                     PSPEC_OK);
    assert_int_equal(arguments.num_sources, PS_MAX_SAMPLERS);
    ps_arguments_free(&arguments);
    assert_int_equal(ps_arguments_parse(&arguments, &large, PS_MAX_SAMPLERS + 1, words, &error),
                     PSPEC_ERROR_INVALID_ARGUMENT);
    ps_arguments_free(&arguments);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_is_complete),
        cmocka_unit_test(nothing_leaves_the_defaults),
        cmocka_unit_test(every_form_of_a_value_is_read),
        cmocka_unit_test(every_option_finds_its_field),
        cmocka_unit_test(files_are_all_other_words),
        cmocka_unit_test(help_ends_the_line),
        cmocka_unit_test(numbers_have_limits),
        cmocka_unit_test(words_are_checked),
        cmocka_unit_test(ranges_have_ends),
        cmocka_unit_test(weights_are_words_where_no_file_is_taken),
        cmocka_unit_test(unknown_options_name_the_nearest),
        cmocka_unit_test(missing_values_are_said),
        cmocka_unit_test(many_samplers_fit_and_one_more_does_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
