/* Questions of the library: arrays that the caller gives are those of files, and arrays that a
 * program writes to files are in the answer. */
#include "files/npy_array.h"
#include "harness_public.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SETS = 2, N = 24, PLANE = 2 };

static char folder[] = "/tmp/test_question_arrays_XXXXXX";
static pspec_context *context; /* of the test that runs */
static double plane[SETS][N][PLANE], weights[N];

/* ---- numbers of the caller ------------------------------------------------------------------- */

static pspec_field field(const char *name, pspec_type type, unsigned rank, const size_t *shape,
                         const void *data) {
    size_t num = 1;
    for (unsigned axis = 0; axis < rank; axis++) {
        num *= shape[axis];
    }
    return (pspec_field){.struct_size = sizeof(pspec_field),
                         .name = name,
                         .type = type,
                         .rank = rank,
                         .shape = shape,
                         .num = num,
                         .data = data};
}

static void compare_array(const char *line, const char *option, const pspec_field *array,
                          const char *with_file) {
    pspec_question *const question = test_public_question(context, line);
    test_public_refused(context, pspec_question_set_array(question, option, array), PSPEC_OK, "");
    pspec_answer *const answer = test_public_answer(context, question);
    pspec_question_destroy(question);
    pspec_answer *const expected = test_public_ask(context, with_file, NULL, 0);
    assert_true(test_public_same(answer, expected));
    pspec_answer_destroy(answer);
    pspec_answer_destroy(expected);
}

static void arrays_are_files(void **state) {
    (void)state;
    const int64_t k[3][PLANE] = {{1, 0}, {0, 1}, {12, -5}};
    const double lobe[3][2] = {{-1, 0}, {0, 0}, {1, 1.0 / 3}}; /* in increasing order */
    const double image[2][2] = {{0.1, 1}, {2.5, -3}};
    const size_t list[] = {3, PLANE}, table[] = {3, 2}, square[] = {2, 2}, flat[] = {N};
    const pspec_field vectors = field("", PSPEC_I64, 2, list, k);
    const pspec_field zonal = field("zonal", PSPEC_F64, 2, table, lobe);
    const pspec_field pixels = field("pixels", PSPEC_F64, 2, square, image);
    const pspec_field own = field("", PSPEC_F64, 1, flat, weights);
#define POINTS " sampler=white points=24 engine=host_direct"
    compare_array("power" POINTS, "frequencies", &vectors, "power" POINTS " frequencies=k.txt");
    compare_array("power max-frequency=3 files=bare.txt engine=host_direct", "weights", &own,
                  "power max-frequency=3 files=bare.txt weights=w.txt engine=host_direct");
    compare_array("truncation max-degree=3", "brdf", &zonal,
                  "truncation max-degree=3 brdf=zonal:file=zonal.txt");
    compare_array(
        "variance max-frequency=2 realizations=2" POINTS, "integrand", &pixels,
        "variance max-frequency=2 realizations=2 integrand=pixels:file=pixels.npy" POINTS);
    pspec_question *const question = test_public_question(context, "power");
    const pspec_field none = field("", PSPEC_TEXT, 1, flat, weights);
    test_public_refused(context, pspec_question_set_array(question, "frequencies", &none),
                        PSPEC_ERROR_INVALID_ARGUMENT, "no field of numbers");
    const size_t wraps[] = {SIZE_MAX / 2 + 1 + N / 2, 2}; /* to N */
    pspec_field huge = field("", PSPEC_I64, 1, flat, k);
    huge.rank = 2;
    huge.shape = wraps;
    test_public_refused(context, pspec_question_set_array(question, "frequencies", &huge),
                        PSPEC_ERROR_INVALID_ARGUMENT, "its shape more than");
    test_public_refused(context, pspec_question_set_array(question, "bins", &own),
                        PSPEC_ERROR_INVALID_ARGUMENT, "takes no array");
    pspec_question_destroy(question);
}

/* What is no file is in the answer; numbers keep their bits. */
static void answers_have_arrays(void **state) {
    (void)state;
    pspec_question *const question = test_public_question(
        context,
        "power sampler=white points=24 realizations=3 max-frequency=3 engine=host_direct full");
    assert_int_equal(pspec_question_set_number(question, "tol", 1.0 / 3e6), PSPEC_OK);
    pspec_answer *answer = test_public_answer(context, question);
    pspec_question_destroy(question);
    pspec_answer *loaded = NULL;
    assert_int_equal(pspec_answer_write(answer, context, "full.npz", NULL), PSPEC_OK);
    assert_int_equal(pspec_answer_load(&loaded, context, "full.npz"), PSPEC_OK);
    assert_true(test_public_same(answer, loaded));
    assert_string_equal(test_public_text(loaded, "engine"), test_public_text(answer, "engine"));
    pspec_answer_destroy(loaded);
    test_public_refused(context, pspec_answer_load(&loaded, context, "bare.txt"), PSPEC_ERROR_INPUT,
                        "");
    const pspec_field *const full = test_public_field(answer, "full", PSPEC_F64);
    assert_true(full->rank == 2 && full->shape[0] == 7 && full->shape[1] == 7 && full->num == 49);
    assert_true(((const double *)full->data)[24] == 24); /* DC */
    pspec_answer *const filed =
        test_public_ask(context,
                        "power sampler=white points=24 realizations=3 max-frequency=3 "
                        "engine=host_direct full=full.npy",
                        NULL, 0);
    const pspec_field *const errors = test_public_field(answer, "full_standard_error", PSPEC_F64);
    const pspec_field *const others = test_public_field(filed, "full_standard_error", PSPEC_F64);
    assert_true(errors->rank == 2 && errors->num == 49 && ((const double *)errors->data)[0] > 0);
    assert_memory_equal(errors->data, others->data, 49 * sizeof(double));
    pspec_answer_destroy(filed);
    assert_true(*test_public_numbers(answer, "tolerance") == 1.0 / 3e6);
    pspec_answer_destroy(answer);
    answer = test_public_ask(context, "sample sampler=white points=24 realizations=2", NULL, 0);
    const pspec_field *const points = test_public_field(answer, "coordinates", PSPEC_F64);
    assert_true(points->rank == 3 && points->shape[0] == 2 && points->shape[1] == N);
    assert_memory_equal(points->data, &plane[0][0][0], 2 * sizeof plane[0]);
    pspec_answer_destroy(answer);
    answer = test_public_ask(context,
                             "angular sampler=fibonacci points=30 max-degree=4 coefficients "
                             "engine=host_direct",
                             NULL, 0);
    assert_int_equal(test_public_field(answer, "coefficients", PSPEC_C128)->num, 15);
    pspec_answer_destroy(answer);
    answer = test_public_ask(context,
                             "quadrature brdf=diffuse sampler=fibonacci-hemisphere points=24 "
                             "weights=optimal max-degree=2 weights-out engine=host_direct",
                             NULL, 0);
    assert_int_equal(test_public_field(answer, "weights", PSPEC_F64)->num, N);
    assert_null(pspec_answer_find(answer, "nothing"));
    assert_null(pspec_answer_field(answer, pspec_answer_num_fields(answer)));
    pspec_answer_destroy(answer);
}

/* ---- all ------------------------------------------------------------------------------------- */

static void write_numbers(const char *path, size_t num, size_t columns, const double *numbers) {
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < num; i++) {
        fprintf(file, "%.17g%c", numbers[i], (i + 1) % columns == 0 ? '\n' : ' ');
    }
    assert_int_equal(fclose(file), 0);
}

static int make_folder(void **state) {
    (void)state;
    ps_error error = {0};
    uint64_t random = 3;
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(setenv("POINTSPEC_CACHE_DIR", folder, 1), 0);
    unsetenv("POINTSPEC_MEMORY");
    context = test_public_context();
    for (size_t i = 0; i < N; i++) {
        weights[i] = 0.5 + test_uniform(&random);
    }
    pspec_answer *const answer =
        test_public_ask(context, "sample sampler=white points=24 realizations=2", NULL, 0);
    memcpy(plane, test_public_numbers(answer, "coordinates"), sizeof plane);
    pspec_answer_destroy(answer);
    write_numbers("bare.txt", (size_t)N * PLANE, PLANE, &plane[0][0][0]);
    write_numbers("w.txt", N, 1, weights);
    write_numbers("k.txt", 6, 2, (const double[]){1, 0, 0, 1, 12, -5});
    write_numbers("zonal.txt", 6, 2, (const double[]){-1, 0, 0, 0, 1, 1.0 / 3});
    const ps_npy_array pixels = {2, {2, 2}, 4, false, (double[]){0.1, 1, 2.5, -3}};
    assert_int_equal(ps_npy_write_array("pixels.npy", &pixels, &error), PSPEC_OK);
    return 0;
}

static int remove_folder(void **state) {
    (void)state;
    char command[64];
    pspec_context_destroy(context);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_are_files),
        cmocka_unit_test(answers_have_arrays),
    };
    return cmocka_run_group_tests_name("question_arrays", tests, make_folder, remove_folder);
}
