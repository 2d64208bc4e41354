/* What answers have is what their kinds declare: every entry and column of the answers below is a
 * row of pspec_fields_table, and every row is of one of them. */
#include "harness_public.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINE = 512, MOST_FIELDS = 512 };

static char folder[] = "/tmp/test_fields_XXXXXX";

/* A kind, then its options as name=value, a flag as its name; in their order, for some read what
 * others wrote. The engine is the one without a device; after "engine=default" the program's choice. Few points: a line
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
    "power files=corner.txt max-frequency=8 engine=default",
    "power sampler=white dimension=6 points=4 frequencies=six.txt output=list.npz",
    "power sampler=sobol dimension=3 points=4 per-ring=2 max-frequency=2 output=rings.npz",
    "angular sampler=white-sphere points=8 max-degree=3 coefficients=lm.npy",
    "angular sampler=white-sphere points=64 max-degree=32 realizations=8 fit=auto plot=b.svg",
    "angular sampler=white-sphere points=8 realizations=9 max-degree=2 output=sphere.npz",
    "angular files=long.txt max-degree=2 output=long.npz",
    "angular files=points.txt lift=hemisphere morph=glossy:n=3 max-degree=2",
    "pairs sampler=white-sphere points=8 max-degree=2 plot=c.svg",
    "pairs sampler=white-sphere points=8 max-degree=2 output=pairs.npz",
    "power sampler=white points=4 max-frequency=1 realizations=129 range=0:128 output=range.npz",
    "pairs sampler=white-sphere points=4 max-degree=1 realizations=129 range=128:129 "
    "output=last.npz",
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
    "quadrature sampler=white-hemisphere points=4 max-degree=2 brdf=diffuse realizations=9 "
    "range=0:2 output=rows.npz",
    "interpolation sampler=white-sphere points=4 realizations=3 range=0:2 "
    "integrand=coefficients:file=light.txt output=inputs.npz engine=default",
    "quadrature files=near.txt brdf=diffuse weights=optimal drop-below-horizon max-degree=2",
    "truncation brdf=glossy:n=4 max-degree=2 integrand=map:file=light.pfm",
    "shade sampler=white-hemisphere sampler=fibonacci-hemisphere points=4,8 brdf=diffuse "
    "integrand=coefficients:file=light.txt shifts=3",
    "shade files=above.txt brdf=diffuse integrand=coefficients:file=light.txt shifts=3 view=60",
    "interpolation sampler=white-sphere sampler=fibonacci points=4,8 "
    "integrand=coefficients:file=light.txt integrand=map:file=light.pfm smoothness=1.1,1.5 "
    "output=maps.npz engine=default",
    "interpolation files=above.txt integrand=map:file=light.pfm engine=default",
    "light integrand=map:file=light.pfm integrand=square max-degree=2 output=light.npz "
    "engine=default",
    "occlusion mesh=corner.obj image=4x3 reference=4 sampler=white-sphere points=4,8 "
    "image-out=image.npy engine=default",
    "occlusion mesh=corner.obj image=4x3 reference=4 files=above.txt radius=2 engine=default",
    "measure sampler=white sampler=jittered points=4,9 max-frequency=2 engine=default",
    "measure files=unequal.txt max-frequency=2 output=measures.npz engine=default",
    "measure sampler=white-sphere points=4 max-degree=2 engine=default",
    "check against=saved.npz sampler=white seed=1",
    "check against=saved.npz files=saved.npz engine=default",
    "check against=sphere.npz sampler=white-sphere",
    "check homogeneous sampler=white points=4 max-frequency=2 realizations=40",
    "plan power sampler=white sampler=jittered points=4,9 max-frequency=2",
    "plan angular sampler=white-sphere points=4 max-degree=2",
    "plan quadrature sampler=fibonacci-hemisphere points=8 brdf=diffuse weights=optimal",
    "plan shade files=above.txt brdf=diffuse integrand=coefficients:file=light.txt view=80",
    "plan run files=scene.yaml engine=default",
    "devices engine=default",
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

static const char *text(const pspec_answer *table, size_t row, const char *column) {
    return ((const char *const *)test_public_field(table, column, PSPEC_TEXT)->data)[row];
}

static size_t count_rows(const pspec_answer *table) {
    return pspec_answer_field(table, 0)->num;
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
    pspec_answer *table = NULL;
    assert_int_equal(pspec_fields_table(&table, context, kind), PSPEC_OK);
    for (size_t row = 0; row < count_rows(table); row++) {
        field *const it =
            find(text(table, row, "field"), text(table, row, "group"), text(table, row, "meaning"));
        snprintf(it->when, sizeof it->when, "%s", text(table, row, "when"));
    }
    pspec_answer_destroy(table);
    pspec_context_destroy(context);
}

/* ---- what there is --------------------------------------------------------------------------- */

/* The rows of the kind of that name and group; one at most. */
static void see(const pspec_answer *declared, const char *name, const char *group,
                const char *question) {
    size_t num = 0;
    for (size_t row = 0; row < count_rows(declared); row++) {
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
static void see_repeated(const pspec_answer *answer, const pspec_answer *declared, const char *key,
                         const char *question) {
    size_t num = 0;
    for (size_t i = 0; i < pspec_answer_num_fields(answer); i++) {
        const pspec_field *const other = pspec_answer_field(answer, i);
        num += other->group == PSPEC_ENTRY && strcmp(other->name, key) == 0;
    }
    for (size_t row = 0; row < count_rows(declared); row++) {
        const bool is_it = strcmp(text(declared, row, "field"), key) == 0 &&
                           strcmp(text(declared, row, "group"), "entry") == 0;
        if (is_it && num > 1 && strcmp(text(declared, row, "repeated"), "yes") != 0) {
            print_error("%s: %s is there %zu times\n", question, key, num);
            num_wrong++;
        }
    }
}

static bool is_declared(const pspec_answer *declared, const char *name, const char *group) {
    size_t row = 0;
    while (row < count_rows(declared) && (strcmp(text(declared, row, "field"), name) != 0 ||
                                          strcmp(text(declared, row, "group"), group) != 0)) {
        row++;
    }
    return row < count_rows(declared);
}

/* State of the second question is called NAME_2; some arrays, of pictures, are state, too. */
static void see_state(const pspec_answer *answer, const pspec_answer *declared,
                      const char *question) {
    for (size_t i = 0; i < pspec_answer_num_fields(answer); i++) {
        const pspec_field *const has = pspec_answer_field(answer, i);
        char name[LINE];
        snprintf(name, sizeof name, "%s", has->name);
        const size_t length = strlen(name);
        if (length > 2 && name[length - 2] == '_' && strchr("234", name[length - 1]) != NULL) {
            name[length - 2] = '\0';
        }
        if (has->group == PSPEC_STATE) {
            see(declared, name, is_declared(declared, name, "array") ? "array" : "state", question);
        }
    }
}

/* What an NPZ file has besides; and merged, it names its parts. */
static void see_file(pspec_context *context, const pspec_answer *declared, const char *question) {
    static const char option[] = "output=";
    char path[LINE];
    const char *const output = strstr(question, option);
    pspec_answer *part = NULL;
    pspec_answer *merged = NULL;
    if (output == NULL || strstr(output, ".npz") == NULL) {
        return;
    }
    snprintf(path, sizeof path, "%s", output + strlen(option));
    path[strcspn(path, " ")] = '\0';
    assert_int_equal(pspec_answer_load(&part, context, path), PSPEC_OK);
    see_state(part, declared, question);
    const pspec_answer *const parts[] = {part};
    if (pspec_answer_merge(&merged, context, parts, 1) == PSPEC_OK &&
        pspec_answer_find(merged, "merged") != NULL) {
        see(declared, "merged", "entry", question);
    }
    pspec_answer_destroy(merged);
    pspec_answer_destroy(part);
}

static pspec_answer *answer_of(pspec_context *context, const char *line) {
    static const char plan[] = "plan ";
    if (strncmp(line, plan, sizeof plan - 1) != 0) {
        return test_public_ask(context, line, NULL, 0);
    }
    pspec_question *const asked = test_public_question(context, line + sizeof plan - 1);
    pspec_answer *answer = NULL;
    if (pspec_question_plan(&answer, asked) != PSPEC_OK) {
        fail_msg("%s: %s", line, pspec_context_message(context));
    }
    pspec_question_destroy(asked);
    return answer;
}

static void ask(const char *question) {
    static const char *const groups[] = {"column", "array", "state", "entry"};
    char line[LINE];
    const bool has_engine =
        strstr(question, " engine=default") != NULL || strncmp(question, "truncation", 10) == 0;
    pspec_context *const context = test_public_context();
    pspec_answer *declared = NULL;
    const char *const any = strstr(question, " engine=default");
    snprintf(line, sizeof line, "%.*s%s", any != NULL ? (int)(any - question) : LINE, question,
             has_engine ? "" : " engine=host_direct");
    pspec_answer *const answer = answer_of(context, line);
    snprintf(line, sizeof line, "%.*s", (int)strcspn(question, " "), question);
    assert_int_equal(pspec_fields_table(&declared, context, line), PSPEC_OK);
    for (size_t i = 0; i < pspec_answer_num_fields(answer); i++) {
        const pspec_field *const has = pspec_answer_field(answer, i);
        if (has->group != PSPEC_STATE) {
            see(declared, has->name, groups[has->group], question);
        }
        if (has->group == PSPEC_ENTRY) {
            see_repeated(answer, declared, has->name, question);
        }
    }
    see_state(answer, declared, question);
    see_file(context, declared, question);
    pspec_answer_destroy(declared);
    pspec_answer_destroy(answer);
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
    write_file("light.txt", "0,0,1,0\n1,0,1,0\n");
    write_file("above.txt", "0 0 1\n0.6 0 0.8\n#\n0 0 1\n");
    write_file("light.pfm", "Pf 1 1 -1\nABC<");
    write_file("corner.obj", "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
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

/* What pictures are made of is declared, too. */
static void pictures_are_of_fields(void **state) {
    static const char *const parts[] = {"x", "y", "error", "low", "high", "panels"};
    size_t num = 0;
    (void)state;
    pspec_context *const context = test_public_context();
    for (size_t i = 0; pspec_answer_kind(i) != NULL; i++) {
        const char *const kind = pspec_answer_kind(i);
        pspec_answer *pictures = NULL;
        num_fields = 0;
        declare(kind);
        assert_int_equal(pspec_pictures_table(&pictures, context, kind), PSPEC_OK);
        for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
            const pspec_field *const column = pspec_answer_find(pictures, parts[k]);
            for (size_t row = 0; column->type == PSPEC_TEXT && row < column->num; row++) {
                const char *const name = ((const char *const *)column->data)[row];
                size_t j = 0;
                while (j < num_fields && strcmp(fields[j].name, name) != 0) {
                    j++;
                }
                num += name[0] != '\0';
                assert_true(name[0] == '\0' || j < num_fields);
            }
        }
        pspec_answer_destroy(pictures);
    }
    assert_true(num > 40);
    pspec_context_destroy(context);
}

static void kinds_are_named(void **state) {
    (void)state;
    pspec_context *const context = test_public_context();
    pspec_answer *table = NULL;
    assert_int_equal(pspec_fields_table(&table, context, "powers"), PSPEC_ERROR_INVALID_ARGUMENT);
    assert_non_null(strstr(pspec_context_message(context), "did you mean power?"));
    assert_null(table);
    assert_int_equal(pspec_pictures_table(&table, context, "powers"), PSPEC_ERROR_INVALID_ARGUMENT);
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
        cmocka_unit_test(pictures_are_of_fields),
        cmocka_unit_test(kinds_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
