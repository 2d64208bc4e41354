/* Meshes: corners of all ways to write a face, the camera of the Cornell box, limits, the sentences
 * of what is refused, and every text cut short. */
#include "harness.h"

#include "meshes/mesh.h"
#include "test_folder.h"

#include <math.h>
#include <unistd.h>

static pspec_status read_text(ps_mesh *out, const test_folder *folder, const char *text,
                              size_t length, ps_error *error) {
    char path[TEST_PATH_BYTES];
    assert_true(test_write_file(test_path(folder, "a.obj", path), text, length));
    return ps_mesh_read(out, path, error);
}

static void check_triangles(const test_folder *folder, const char *text,
                            const double (*expected)[3][3], size_t num) {
    ps_mesh mesh;
    assert_ok(read_text(&mesh, folder, text, strlen(text), error));
    assert_int_equal(mesh.num_triangles, num);
    for (size_t t = 0; t < num; t++) {
        for (size_t i = 0; i < 3; i++) {
            for (size_t axis = 0; axis < 3; axis++) {
                assert_true(mesh.triangles[t][i][axis] == expected[t][i][axis]);
            }
        }
    }
    ps_mesh_free(&mesh);
}

/* The same two triangles, which are a fan about the first corner. */
static void faces(void **state) {
    static const double square[][3][3] = {{{0, 0, 0}, {2, 0, 0}, {2, 1.5, 0}},
                                          {{0, 0, 0}, {2, 1.5, 0}, {0, 1.5, -1e-3}}};
    static const char *const texts[] = {
        "v 0 0 0\nv 2 0 0\nv 2 1.5 0\nv 0 1.5 -1e-3\nf 1 2 3 4\n",
        ("# a square\r\no a\r\nv 0 0 0 1\r\nv 2 0 0\r\n\r\nv 2 1.5 0 .5 .5 .5\r\nv 0 1.5 -1e-3\r\n"
         "vn 0 0 1\r\nvt 0 0\r\nusemtl b\r\ns off\r\nf 1//1 2//1 3//1 4//1 # end\r\n"),
        "v 0 0 0\nv 2 0 0\nv 2 1.5 0\nv 0 1.5 -1e-3\nf -4/1 -3/2/1 3/1 4\n",
        "v 0 0 \\\n0\nv 2 0 0\\\n\nv 2 1.5 0\nv 0 1.5 -1e-3\nf 1 \\\r\n 2 3\\\n4",
        ("# C:\\\nv 0 0 0 # C:\\\nmtllib C:\\\nv 2 0 0\nvn 0 \\\n0 1\nv 2 1.5 0\n \t#\\\r\n"
         "v 0 1.5 -1e-3\nusemtl a \\\r\nf 1 2 \\\n3 4 # \\\no \\"),
        "v 9 9 9\nv 0 0 0\nv 2 0 0\nv 2 1.5 0\nf 2 3 4\nv 0 1.5 -1e-3\nfo 2 4 5\n",
        "quad \\\no white \\\n0 0 0  2 0 0  2 1.5 0  0 1.5 -1e-3\nrgb white 1 1 1\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        check_triangles(*state, texts[i], square, 2);
    }
}

static void cameras(void **state) {
    static const char text[] = "camera position 1 2 -3 direction 0 0 2 up 0 1 0 focal 0.5 width 1 "
                               "height 1\nquad a b 0 0 0 1 0 0 1 1 0 0 1 0\n";
    double axes[3][3];
    ps_mesh mesh;
    assert_ok(read_text(&mesh, *state, text, strlen(text), error));
    assert_true(mesh.has_camera && mesh.camera.width == 2 && mesh.camera.position[2] == -3);
    assert_true(ps_camera_axes(&mesh.camera, axes));
    assert_true(axes[0][0] == -1 && axes[1][1] == 1 && axes[2][2] == 1);
    mesh.camera.up[1] = 0;
    mesh.camera.up[2] = -7;
    assert_false(ps_camera_axes(&mesh.camera, axes));
    /* All corners are in front of a camera that fits, within its width. */
    const ps_camera fit = ps_camera_fit(&mesh);
    assert_true(ps_camera_axes(&fit, axes));
    for (size_t i = 0; i < 3 * mesh.num_triangles; i++) {
        double at[3] = {0, 0, 0};
        for (size_t k = 0; k < 9; k++) {
            at[k / 3] += axes[k / 3][k % 3] *
                         ((&mesh.triangles[0][0][0])[3 * i + k % 3] - fit.position[k % 3]);
        }
        assert_true(at[2] > 0 && fabs(at[0]) < at[2] * fit.width / 2 &&
                    fabs(at[1]) < at[2] * fit.width / 2);
    }
    ps_mesh_free(&mesh);
}

static void refused(void **state) {
    static const struct {
        const char *text, *part;
    } cases[] = {
        {"", "is empty"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "a mesh without faces"},
        {"v 0 0\n", "line 1: a vertex has 3 numbers, not 2"},
        {"v 0 x 0\n", "line 1: \"x\" is no number"},
        {"v 0 nan 0\n", "\"nan\" is no number"},
        {"v 0 0 1e31\n", "numbers of meshes go up to 1e+30"},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "line 4: a triangle of this face has no area"},
        {"v 0 0 0\nv 1 0 0\nf 1 2 1\n", "no area"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "vertex 4 of a face is none of the 3 before it"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "vertex -4 of a face"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "vertex 0 of a face"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "line 4: a face has 2 corners, not 3 or more"},
        {"v 0 0 0\nf 1.5 1 1\n", "\"1.5\" is no number of a vertex"},
        {"v 0 0 0\nf 1/x 1 1\n", "\"1/x\" is no number of a vertex"},
        {"quad a b 0 0 0 1 0 0 1 1 0 0 1\n", "a quad has 12 numbers, not 11"},
        {"quad a b 0 0 0 1 0 0 1 1 0 0 1 0 2\n", "12 numbers, and has more"},
        {"camera position 0 0 0 direction 0 0 1 up 0 0 1 focal 1 width 1\n", "up beside it"},
        {"camera position 0 0 0 direction 0 0 1 up 0 1 0 focal 0 width 1\n", "positive focal"},
        {"camera lens 1\n", "\"lens\" is no part of a camera"},
        {"ply\n", "\"ply\" is no statement of OBJ"},
        {"v 0 0 0\\\n", "line 1: a backslash continues this line"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        ps_mesh mesh;
        ps_error error = {0};
        assert_int_equal(read_text(&mesh, *state, cases[i].text, strlen(cases[i].text), &error),
                         PSPEC_ERROR_INPUT);
        if (strstr(error.message, cases[i].part) == NULL) {
            fail_msg("not \"%s\": %s", cases[i].part, error.message);
        }
        ps_mesh_free(&mesh);
    }
}

/* As many as there may be, and one more. */
static void limits(void **state) {
    static const char face[] = "f 1 2 3\n";
    static const char vertex[] = "v 1 1 1\n";
    static const char line[] = "\\\n";
    const struct {
        const char *begin, *line, *end, *part;
        size_t most;
    } cases[] = {
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", face, "", "at most 4096 triangles", PS_MESH_MOST_TRIANGLES},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\n", vertex, face, "at most 65536 vertices",
         PS_MESH_MOST_VERTICES - 3},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 ", line, "3\n", "at most 256", 255}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (size_t more = 0; more < 2; more++) {
            const size_t num = cases[i].most + more;
            const size_t bytes = strlen(cases[i].line);
            char *const text = calloc(1, num * bytes + 100);
            size_t length = (size_t)sprintf(text, "%s", cases[i].begin);
            ps_mesh mesh;
            ps_error error = {0};
            assert_non_null(text);
            for (size_t k = 0; k < num; k++, length += bytes) {
                memcpy(text + length, cases[i].line, bytes);
            }
            length += (size_t)sprintf(text + length, "%s", cases[i].end);
            assert_int_equal(read_text(&mesh, *state, text, length, &error),
                             more == 0 ? PSPEC_OK : PSPEC_ERROR_INPUT);
            assert_true(more == 0 || strstr(error.message, cases[i].part) != NULL);
            ps_mesh_free(&mesh);
            free(text);
        }
    }
}

/* A text that ends anywhere is a mesh of what it has, or one sentence. */
static void cut_short(void **state) {
    static const char text[] =
        "v 0 0 0\nv 10 0 0\nv 0 10 \\\n0\nf 1 2 3\nquad a b 0 0 0 1 0 0 1 1 0 "
        "0 1 0\nf -3/1/1 -2/1 -1\n";
    for (size_t length = 0; length <= strlen(text); length++) {
        ps_mesh mesh;
        ps_error error = {0};
        const pspec_status status = read_text(&mesh, *state, text, length, &error);
        assert_true(status == PSPEC_OK ? mesh.num_triangles > 0 && mesh.num_triangles <= 4
                                       : status == PSPEC_ERROR_INPUT && error.message[0] != '\0');
        ps_mesh_free(&mesh);
    }
}

static void cornell_box(void **state) {
    const char *const data = getenv("POINTSPEC_TEST_DATA");
    char path[TEST_PATH_BYTES];
    double middle[3];
    ps_mesh mesh;
    (void)state;
    snprintf(path, sizeof path, "%s/cornell/cornell-box.txt", data != NULL ? data : "");
    if (access(path, R_OK) != 0) {
        print_message("POINTSPEC_TEST_DATA names no folder with the Cornell box: skipped\n");
        skip();
    }
    assert_ok(ps_mesh_read(&mesh, path, error));
    assert_int_equal(mesh.num_triangles, 32);
    assert_true(fabs(mesh.camera.width - 0.025 / 0.035) < 1e-15 && mesh.camera.position[2] == -800);
    assert_true(ps_mesh_extent(&mesh, middle) > 400 && middle[0] == 278);
    ps_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces),     cmocka_unit_test(cameras),
                                       cmocka_unit_test(refused),   cmocka_unit_test(limits),
                                       cmocka_unit_test(cut_short), cmocka_unit_test(cornell_box)};
    return cmocka_run_group_tests(tests, test_folder_create, test_folder_remove);
}
