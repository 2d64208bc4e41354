/* What answers have is what their kinds declare: every entry and column of the answers below is a
 * row of pspec_fields_table, and every row is of one of them. */
#include "answers/kind.h"
#include "harness_public.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_OPTIONS = 24, LINE = 512, MOST_FIELDS = 512 };

static char folder[] = "/tmp/test_fields_XXXXXX";

/* A kind, then its options as name=value, a flag as its name; in their order, for some read what
 * others wrote. The engine is the one without a device; after "engine=" the program's choice. Few points: a line
 * takes some hundredths of a second. */
static const char *const questions[] = {
    "power sampler=sobol sampler=white points=8,16 max-frequency=2 homogenize output=two.npz",
    "power sampler=white points=144 max-frequency=6 realizations=8 fit=auto bins=floor "
    "plot=a.svg",
    "power sampler=white points=8 max-frequency=2 realizations=9 scatter=1,1 output=saved.npz",
    "power sampler=white points=8 realizations=2 max-frequency=2 full=full.npy",
    "power sampler=white points=4 max-frequency=1 standard-error=0.9 realizations=40",
    "power files=unequal.txt max-frequency=2 coefficients=c.npy",
    "power files=points.txt files=unequal.txt box=0,2,0,1 max-frequency=2",
    "power files=a.xyz files=b.xyz max-frequency=2",
    "power files=corner.txt max-frequency=8 engine=",
    "power sampler=white dimension=6 points=4 frequencies=six.txt output=list.npz",
    "power sampler=sobol dimension=3 points=4 per-ring=2 max-frequency=2 output=rings.npz",
    "angular sampler=white-sphere points=8 max-degree=3 coefficients=lm.npy",
    "angular sampler=white-sphere points=64 max-degree=32 realizations=8 fit=auto plot=b.svg",
    "angular sampler=white-sphere points=8 realizations=9 max-degree=2 output=sphere.npz",
    "angular files=long.txt max-degree=2 output=long.npz",
    "angular files=points.txt lift=hemisphere morph=glossy:n=3 max-degree=2",
    "pairs sampler=white-sphere points=8 max-degree=2 plot=c.svg",
    "pairs sampler=white-sphere points=8 max-degree=2 output=pairs.npz",
    "variance sampler=white sampler=jittered points=4,9 max-frequency=2 realizations=8 "
    "integrand=disk integrand=gaussian rates=auto rank bounds=auto paper-formula "
    "tail=0.9",
    "variance sampler=jittered points=8 max-frequency=2 integrand=disk shifts=0 bins=shells",
    "variance files=points.txt max-frequency=2 integrand=disk shifts=2",
    "quadrature sampler=white-hemisphere sampler=fibonacci-hemisphere points=4,8 brdf=diffuse",
    "quadrature sampler=white-hemisphere points=4 max-degree=2 brdf=glossy:n=4 realizations=20 "
    "standard-error=0.9",
    "quadrature sampler=fibonacci-hemisphere points=8 brdf=diffuse weights=optimal "
    "weights-out=w.npy",
    "quadrature files=near.txt brdf=diffuse weights=optimal drop-below-horizon max-degree=2",
    "truncation brdf=glossy:n=4 max-degree=2",
    "check against=saved.npz sampler=white seed=1",
    "check against=saved.npz files=saved.npz engine=",
    "check against=sphere.npz sampler=white-sphere",
    "check homogeneous sampler=white points=4 max-frequency=2 realizations=40",
    "plan power sampler=white sampler=jittered points=4,9 max-frequency=2",
    "plan angular sampler=white-sphere points=4 max-degree=2",
    "plan quadrature sampler=fibonacci-hemisphere points=8 brdf=diffuse weights=optimal",
    "plan run files=scene.yaml engine=",
    "devices engine=",
};

/* ---- what is declared ------------------------------------------------------------------------ */

/* A row of the tables, once for all kinds that share it. */
typedef struct field {
    char name[48], group[8], when[64], meaning[256];
    bool is_seen;
} field;

static field fields[MOST_FIELDS];
static size_t num_fields;
static size_t num_wrong; /* what is no row, or no answer has; all are shown */

static const char *text(const pspec_table *table, size_t row, const char *column) {
    const pspec_cell cell = pspec_table_cell(table, row, pspec_table_find_column(table, column));
    return cell.text != NULL ? cell.text : "";
}

static field *find(const char *name, const char *group, const char *meaning) {
    size_t i = 0;
    while (i < num_fields &&
           (strcmp(fields[i].name, name) != 0 || strcmp(fields[i].group, group) != 0 ||
            strcmp(fields[i].meaning, meaning) != 0)) {
        i++;
    }
    if (i == num_fields) {
        assert_true(num_fields < MOST_FIELDS);
        num_fields++;
        snprintf(fields[i].name, sizeof fields[i].name, "%s", name);
        snprintf(fields[i].group, sizeof fields[i].group, "%s", group);
        snprintf(fields[i].meaning, sizeof fields[i].meaning, "%s", meaning);
    }
    return &fields[i];
}

static void declare(const char *kind) {
    pspec_context *const context = test_public_context();
    pspec_table *table = NULL;
    assert_int_equal(pspec_fields_table(&table, context, kind), PSPEC_OK);
    for (size_t row = 0; row < pspec_table_num_rows(table); row++) {
        field *const it =
            find(text(table, row, "field"), text(table, row, "group"), text(table, row, "meaning"));
        snprintf(it->when, sizeof it->when, "%s", text(table, row, "when"));
    }
    pspec_table_destroy(table);
    pspec_context_destroy(context);
}

/* ---- what there is --------------------------------------------------------------------------- */

/* The rows of the kind of that name and group; one at most. */
static void see(const pspec_table *declared, const char *name, const char *group,
                const char *question) {
    size_t num = 0;
    for (size_t row = 0; row < pspec_table_num_rows(declared); row++) {
        if (strcmp(text(declared, row, "field"), name) == 0 &&
            strcmp(text(declared, row, "group"), group) == 0) {
            find(name, group, text(declared, row, "meaning"))->is_seen = true;
            num++;
        }
    }
    if (num != 1) {
        print_error("%s: the %s %s is declared %zu times\n", question, group, name, num);
        num_wrong++;
    }
}

/* A key comes once for a question where it is not declared as repeated. */
static void see_entry(const pspec_table *answer, const pspec_table *declared, size_t entry,
                      const char *question) {
    const char *key = NULL;
    const char *other = NULL;
    size_t num = 0;
    pspec_table_entry(answer, entry, &key);
    see(declared, key, "entry", question);
    for (size_t i = 0; i < pspec_table_num_entries(answer); i++) {
        pspec_table_entry(answer, i, &other);
        num += strcmp(other, key) == 0;
    }
    for (size_t row = 0; row < pspec_table_num_rows(declared); row++) {
        const bool is_it = strcmp(text(declared, row, "field"), key) == 0 &&
                           strcmp(text(declared, row, "group"), "entry") == 0;
        if (is_it && num > 1 && strcmp(text(declared, row, "repeated"), "yes") != 0) {
            print_error("%s: %s is there %zu times\n", question, key, num);
            num_wrong++;
        }
    }
}

/* Arrays are files that an option names: "--full" of the row is full=FILE of the question. */
static void see_arrays(const pspec_table *declared, const char *question) {
    for (size_t row = 0; row < pspec_table_num_rows(declared); row++) {
        char option[LINE];
        snprintf(option, sizeof option, " %s=", text(declared, row, "when") + strlen("--"));
        if (strcmp(text(declared, row, "group"), "array") == 0 &&
            strstr(question, option) != NULL) {
            see(declared, text(declared, row, "field"), "array", question);
        }
    }
}

/* What an NPZ file has besides: state, of the second question "NAME_2"; and merged, it names its
 * parts. */
static void see_state(const pspec_table *declared, const char *question) {
    static const char option[] = "output=";
    char path[LINE];
    char shown[LINE];
    const char *const output = strstr(question, option);
    ps_error error = {0};
    ps_table *table = NULL;
    ps_answer merged = {0};
    if (output == NULL || strstr(output, ".npz") == NULL) {
        return;
    }
    snprintf(path, sizeof path, "%s", output + strlen(option));
    path[strcspn(path, " ")] = '\0';
    assert_int_equal(ps_table_read_npz(&table, path, &error), PSPEC_OK);
    for (size_t i = 0; i < ps_table_num_arrays(table); i++) {
        const char *name = NULL;
        bool is_state = false;
        ps_table_array(table, i, &name, &is_state);
        snprintf(shown, sizeof shown, "%s", name);
        const size_t length = strlen(shown);
        if (length > 2 && shown[length - 2] == '_' && strchr("234", shown[length - 1]) != NULL) {
            shown[length - 2] = '\0';
        }
        see(declared, shown, is_state ? "state" : "array", question);
    }
    const ps_table *const part = table;
    const char *const name = path;
    if (ps_answer_merge(&merged, &(ps_parts){&part, &name, 1, "merge"}, &error) == PSPEC_OK &&
        ps_table_find_meta(merged.table, "merged").kind == PS_CELL_TEXT) {
        see(declared, "merged", "entry", question);
    }
    ps_answer_free(&merged);
    ps_table_destroy(table);
}

/* Cuts line into options. */
static size_t split(pspec_option *options, char *line) {
    size_t num = 0;
    bool has_engine = strncmp(line, "truncation", strlen("truncation")) == 0;
    for (char *word = strtok(strchr(line, ' '), " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(num + 1 < MOST_OPTIONS);
        char *const equals = strchr(word, '=');
        options[num] = (pspec_option){word, equals != NULL ? equals + 1 : NULL};
        if (equals != NULL) {
            *equals = '\0';
        }
        has_engine = has_engine || strcmp(word, "engine") == 0;
        num += strcmp(word, "engine") != 0 || equals[1] != '\0';
    }
    if (!has_engine) {
        options[num++] = (pspec_option){"engine", "host_direct"};
    }
    return num;
}

/* "plan power sampler=white" is a plan of the second word. */
static pspec_status answer_of(pspec_table **out, pspec_context *context, const char *question,
                              const pspec_option *options, size_t num) {
    char word[LINE];
    const bool is_plan = strncmp(question, "plan ", strlen("plan ")) == 0;
    const char *const begin = question + (is_plan ? strlen("plan ") : 0);
    snprintf(word, sizeof word, "%.*s", (int)strcspn(begin, " "), begin);
    return is_plan ? pspec_plan_table(out, context, word, options + 1, num - 1)
           : strcmp(word, "devices") == 0 ? pspec_devices(out, context)
                                          : pspec_answer(out, context, word, options, num);
}

static void ask(const char *question) {
    char line[LINE];
    char kind[LINE];
    pspec_option options[MOST_OPTIONS];
    pspec_context *const context = test_public_context();
    pspec_table *answer = NULL;
    pspec_table *declared = NULL;
    snprintf(line, sizeof line, "%s", question);
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(question, " "), question);
    const size_t num = split(options, line);
    if (answer_of(&answer, context, question, options, num) != PSPEC_OK) {
        print_error("%s: %s\n", question, pspec_context_message(context));
        num_wrong++;
        pspec_context_destroy(context);
        return;
    }
    assert_int_equal(pspec_fields_table(&declared, context, kind), PSPEC_OK);
    for (size_t i = 0; i < pspec_table_num_columns(answer); i++) {
        see(declared, pspec_table_column_name(answer, i), "column", question);
    }
    for (size_t i = 0; i < pspec_table_num_entries(answer); i++) {
        see_entry(answer, declared, i, question);
    }
    see_arrays(declared, question);
    see_state(declared, question);
    pspec_table_destroy(declared);
    pspec_table_destroy(answer);
    pspec_context_destroy(context);
}

static void write_file(const char *path, const char *content) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(content, file) >= 0 && fclose(file) == 0);
}

/* So close together that powers are near their number, which needs a second plan, and that most of
 * the axes is empty. */
static void write_corner(void) {
    enum { NUM = 300 };
    FILE *const file = fopen("corner.txt", "w");
    assert_non_null(file);
    for (int i = 0; i < NUM; i++) {
        fprintf(file, "%g %g\n", 0.5 + 1e-4 * (i % 17), 0.5 + 1e-4 * (i % 19));
    }
    assert_int_equal(fclose(file), 0);
}

static void fields_are_declared(void **state) {
    (void)state;
    write_file("points.txt", "0.1 0.2\n0.3 0.9\n0.8 0.4\n");
    write_file("unequal.txt", "0.1 0.2\n0.3 0.9\n0.8 0.4\n#\n0.5 0.1\n");
    write_file("a.xyz", "2\nLattice=\"2 0 0 0 1 0 0 0 1\"\nAr 0 .1 .5\nKr .1 .9 .1\n");
    write_file("b.xyz", "2\nLattice=\"3 0 0 0 1 0 0 0 1\"\nAr 0 .1 .5\nKr .1 .9 .1\n");
    write_file("six.txt", "1 0 0 0 0 1\n");
    write_file("long.txt", "0 0 1.0000005\n0 1 0\n1 0 0\n");
    write_file("near.txt", "0 0 1\n0 1 0\n1 0 0\n1 1e-13 0\n0.6 0 -0.8\n");
    write_file("scene.yaml",
               "scene: 1\nresults:\n  - {result: power, samplers: [white], points: 8, "
               "max-frequency: 2}\n");
    write_corner();
    for (size_t i = 0; pspec_answer_kind(i) != NULL; i++) {
        declare(pspec_answer_kind(i));
    }
    declare("plan");
    declare("devices");
    for (size_t i = 0; i < sizeof questions / sizeof questions[0]; i++) {
        ask(questions[i]);
    }
    for (size_t i = 0; i < num_fields; i++) {
        /* where there is a device nobody says why there is none */
        if (!fields[i].is_seen && strcmp(fields[i].name, "no_device") != 0) {
            print_error("no answer has the %s %s (%s): %s\n", fields[i].group, fields[i].name,
                        fields[i].when, fields[i].meaning);
            num_wrong++;
        }
    }
    assert_int_equal(num_wrong, 0);
}

static void kinds_are_named(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    pspec_table *table = NULL;
    assert_int_equal(pspec_fields_table(&table, context, "powers"), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(pspec_context_message(context), "did you mean power?"));
    assert_null(table);
    pspec_context_destroy(context);
}

int main(void) {
    if (mkdtemp(folder) == NULL || chdir(folder) != 0) {
        return 1;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_are_declared),
        cmocka_unit_test(kinds_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
