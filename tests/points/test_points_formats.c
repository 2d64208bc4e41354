/* Point formats of text: small files as the tools of the field write them, and what is refused. */
#include "harness_points.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* ---- what is read ------------------------------------------------------------------------ */

typedef struct good_file {
    const char *name, *text;
    ps_point_options options;
    const char *format, *columns;
    size_t num_sets, num_points;
    double last;        /* coordinate of all */
    double last_weight; /* nan: no weights */
} good_file;

#define ANY .domain = PS_DOMAIN_ANY
#define NONE ((double)NAN)

static const good_file good_files[] = {
    /* PSA and GBN */
    {"a.txt", "2\n0.5 0.25\n0 0.75\n", {0}, "psa-text", "xy", 1, 2, 0.75, NONE},
    {"a.txt", "2\n0.5 0.25\n0 0.75\n9 9 9 9\n", {0}, "psa-text", "xy", 1, 2, 0.75, NONE},
    {"a.txt", "3\n0.5 0.25\n0 0.75 0.1\n\n 0.125\n", {0}, "psa-text", "xy", 1, 3, 0.125, NONE},
    {"a.txt", "1\n0.5 0.25\n", {0}, "psa-text", "xy", 1, 1, 0.25, NONE},
    {"a.txt", "2\r\n0.5 0.25\r\n0 0.75", {0}, "psa-text", "xy", 1, 2, 0.75, NONE},
    {"a.txt", "2 0.5 0.25 0 0.75", {.format = "psa-text"}, "psa-text", "xy", 1, 2, 0.75, NONE},
    {"a.txt", "2\n.5 .25 3\n0 .75 -4\n", {.columns = "xyw"}, "psa-text", "xyw", 1, 2, 0.75, -4},
    {"a.txt", "2\n.5 .25 3\n0 .75 4\n", {.weight_column = true}, "psa-text", "xyw", 1, 2, 0.75, 4},
    {"a.txt", "2 3\n.1 .2 .3\n.4 .5 .6\n", {0}, "gbn", "xyz", 1, 2, 0.6, NONE},
    {"a.txt", "2 2\n.1 .2\n.4 .5\n", {0}, "gbn", "xy", 1, 2, 0.5, NONE},
    {"a.txt", "3 1\n.1\n.2\n.4\n", {0}, "gbn", "x", 1, 3, 0.4, NONE},
    {"a.txt", "2 4\n.1 .2 .3 .4\n.4 .5 .6 .7\n1 1\n", {0}, "gbn", "x1..x4", 1, 2, 0.7, NONE},
    /* pbrt's pspec: tokens, in lines that mean nothing */
    {"pts-a", "0 0 0.5 0.75\n", {.dimension = 2}, "tokens", "xy", 1, 2, 0.75, NONE},
    {"pts-a", "0 0 .5 .5\n#\n0 .5 .5\n.75\n#\n", {.dimension = 2}, "tokens", "xy", 2, 4, .75, NONE},
    {"pts-a", "0 0 .5 .75", {.dimension = 4}, "utk-text", "x1..x4", 1, 1, 0.75, NONE},
    {"pts-a", "0 0 5 .5 .75 6", {.columns = "xyw"}, "tokens", "xyw", 1, 2, 0.75, 6},
    {"pts-a",
     "0 0 1 .6 0 .8",
     {ANY, .columns = "xyz"},
     "tokens",
     "xyz, unit vectors",
     1,
     2,
     .8,
     NONE},
    {"md", "0 0 1 6.25\n", {ANY}, "utk-text", "xyzw, unit vectors", 1, 1, 1, 6.25},
    /* EPS of PSA */
    {"a.eps",
     "%!PS-Adobe-3.0 EPSF-3.0\n/p {moveto} def\n500 500 scale\n0.5 0.25 p\n0 0.75 p\n"
     "showpage\n",
     {0},
     "eps",
     "xy",
     1,
     2,
     0.75,
     NONE},
    /* commas, as Sloane's files in some copies */
    {"a.txt", "0.5,0.25\n0, 0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "0.5 , 0.25\n#\n0 , 0.75\n", {0}, "csv", "xy", 2, 2, 0.75, NONE},
    {"des3-2-1.txt", "0,0,1\n0,0,-1\n", {ANY}, "csv", "xyz, unit vectors", 1, 2, -1, NONE},
    /* semicolons, a byte order mark */
    {"a.csv", "0.5;0.25\n0 ; 0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.txt",
     "\xef\xbb\xbf"
     "0.5 0.25\n0 0.75\n",
     {0},
     "utk-text",
     "xy",
     1,
     2,
     0.75,
     NONE},
    /* names in the first line, as of data frames: with an index and without, by pandas and R */
    {"a.csv", "x,y\n0.5,0.25\n0,0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", ",x,y\n0,0.5,0.25\n1,0,0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", ",0,1\n0,0.5,0.25\n1,0,0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "Unnamed: 0,x,y\n0,0.5,0.25\n1,0,0.75\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "\"u\";\"v\"\r\n0.5;0.25\r\n0;0.75\r\n", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "\xef\xbb\xbf,x,y\n0,0.5,0.25\n1,0,0.75", {0}, "csv", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "# made by hand\nx,y\n0.5,0.25\n#\n0,0.75\n", {0}, "csv", "xy", 2, 2, 0.75, NONE},
    {"a.txt", "x y\n1 0.5 0.25\n2 0 0.75\n", {0}, "utk-text", "xy", 1, 2, 0.75, NONE},
    {"a.txt", "\tx\ty\n0\t0.5\t0.25\n1\t0\t0.75\n", {0}, "utk-text", "xy", 1, 2, 0.75, NONE},
    {"a.csv", "x,y,w\n0.5,0.25,3\n0,0.75,4\n", {0}, "csv", "xyw", 1, 2, 0.75, 4},
    {"a.csv",
     "phi,theta\n1,0.5\n2,0\n",
     {.domain = PS_DOMAIN_SPHERE},
     "csv",
     "phi-theta",
     1,
     2,
     1,
     NONE},
    {"a.csv",
     "id,y,label,x\n1,.25,\"a,b\",.5\n2,0,,.75\n",
     {.column_names = "x,y"},
     "csv",
     "xy",
     1,
     2,
     0,
     NONE},
    {"a.csv",
     "id,y,label,x\n1,.25,a,.5\n#\n2,.75,b,0\n",
     {.column_names = "y,"},
     "csv",
     "x",
     2,
     2,
     0.75,
     NONE},
    /* EDAT */
    {"a.edat",
     "0 0\n1 1\n1\n0.5 0.25\n#\n-1 -1\n1 1\n0\n0 0.5\n",
     {0},
     "edat",
     "xy",
     2,
     2,
     0.75,
     NONE},
    {"a.edat", "-1 2\n1 4\n0\n0.5 2.25\n0 3.5\n", {0}, "edat", "xy", 1, 2, 0.75, NONE},
    {"a.edat", "0\n1\n1\n0.5\n#\n0\n1\n1\n0.75\n#\n", {0}, "edat", "x", 2, 2, 0.75, NONE},
    {"a.edat", "-1\n3\n1\n0\n2\n", {0}, "edat", "x", 1, 2, 0.75, NONE},
    {"a.edat", ".1\n.4\n0\n.2\n", {.format = "edat"}, "edat", "x", 1, 1, 1. / 3, NONE},
    {"a.edat", "0\n3\n1\n2.9999999999999996\n", {0}, "edat", "x", 1, 1, 1 - 0x1p-53, NONE},
    /* the header tells */
    {"a.txt", "0 0\n1 2\n1\n0.5 0.25\n0 1.5\n", {0}, "edat", "xy", 1, 2, 0.75, NONE},
    /* no header, so all lines are points */
    {"a.edat", "0.1 0.2\n0.9 0.95\n0 0.75\n", {0}, "utk-text", "xy", 1, 3, 0.75, NONE},
    {"a.edat", "0.1\n0.9\n0.75\n", {0}, "utk-text", "x", 1, 3, 0.75, NONE},
    {"a.edat", "0.1,0.2\n0.9,0.95\n#\n0,.75\n", {0}, "csv", "xy", 2, 3, 0.75, NONE},
    {"a.edat", "0.5 0.75\n", {0}, "utk-text", "xy", 1, 1, 0.75, NONE},
    {"a.txt", "-1 -1\n1 1\n0.5 0.75\n", {.wrap = true}, "utk-text", "xy", 1, 3, 0.75, NONE},
    {"a.edat",
     "0 0\n1 1\n1\n.5 .25 7\n0 .75 8\n",
     {.weight_column = true},
     "edat",
     "xyw",
     1,
     2,
     .75,
     8},
    /* the sphere: P15, Womersley, Sloane, Graef, HEALPix */
    {"sf009.00002",
     "0 0 1\n0.6 0 -0.8\n",
     {ANY},
     "utk-text",
     "xyz, unit vectors",
     1,
     2,
     -0.8,
     NONE},
    {"md009.00002",
     "0 0 1 6.25\n0.6 0 -0.8 6.5\n",
     {ANY},
     "utk-text",
     "xyzw, unit vectors",
     1,
     2,
     -0.8,
     6.5},
    {"des3-1-1.txt",
     "0.8662468181078206 0.4225186537611115 0.2666354015167047\n",
     {ANY},
     "utk-text",
     "xyz, unit vectors",
     1,
     1,
     0.2666354015167047,
     NONE},
    {"a.dat",
     "0 0\n6.2 3.14159265358979\n",
     {ANY, .columns = "phi-theta", .keep_angles = true},
     "utk-text",
     "phi-theta",
     1,
     2,
     6.2,
     NONE},
    {"a.dat",
     "0 90\n270 -90\n",
     {ANY, .columns = "lon-lat"},
     "utk-text",
     "lon-lat",
     1,
     2,
     -1,
     NONE},
    {"a.dat",
     "0 90 2\n270 -90 3\n",
     {.domain = PS_DOMAIN_SPHERE, .columns = "lon-lat-w"},
     "utk-text",
     "lon-lat-w",
     1,
     2,
     -1,
     3},
    {"a.dat",
     "3 4 0\n0 0 -1e300\n",
     {ANY, .normalize_vectors = true},
     "utk-text",
     "xyz, unit vectors",
     1,
     2,
     -1,
     NONE},
    /* the same numbers may be meant as torus points */
    {"a.dat", "0.6 0 0.8\n.1 .2 .3\n", {ANY, .dimension = 3}, "utk-text", "xyz", 1, 2, 0.3, NONE},
    {"a.dat", "0.1 0.2 0.3\n", {ANY}, "utk-text", "xyz", 1, 1, 0.3, NONE},
    {"a.dat", "0.1 0.2 5\n", {ANY, .columns = "xyw"}, "utk-text", "xyw", 1, 1, 0.2, 5},
    {"a.dat",
     "0.1 0.2 5\n",
     {.columns = "xyw", .ignore_weights = true},
     "utk-text",
     "xyw",
     1,
     1,
     0.2,
     NONE},
    /* some of the sets */
    {"a.dat",
     "0.1 0.2\n#\n0.3 0.4\n#\n0.5 0.6\n",
     {.sets = {2, 2}},
     "utk-text",
     "xy",
     1,
     1,
     0.4,
     NONE},
    {"a.dat",
     "0.1 0.2\n#\n0.3 0.4\n#\n0.5 0.6\n",
     {.sets = {2, UINT64_MAX}},
     "utk-text",
     "xy",
     2,
     2,
     0.6,
     NONE},
};

static bool is_same(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

static void check_good_file(void **state, const good_file *file, size_t block) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    assert_true(
        test_write_file(test_path(*state, file->name, path), file->text, strlen(file->text)));
    const pspec_status status =
        block == 0 ? test_points_read(&all, path, &file->options, &error)
                   : test_points_read_blocks(&all, path, &file->options, block, &error);
    if (status != PSPEC_OK) {
        fail_msg("%s: %s", file->text, error.message);
    }
    if (strcmp(all.format, file->format) != 0 || strcmp(all.columns, file->columns) != 0 ||
        all.num_sets != file->num_sets || all.num_points != file->num_points ||
        !is_same(all.points[all.num_points * all.dimension - 1], file->last) ||
        all.has_weights != !isnan(file->last_weight) ||
        (all.has_weights && !is_same(all.weights[all.num_points - 1], file->last_weight))) {
        fail_msg("%s: read as %s (%s), %zu sets of %zu points, last %.17g", file->text, all.format,
                 all.columns, all.num_sets, all.num_points,
                 all.points[all.num_points * all.dimension - 1]);
    }
    test_points_free(&all);
}

static void reads_the_files_of_the_field(void **state) {
    for (size_t i = 0; i < sizeof good_files / sizeof good_files[0]; i++) {
        for (size_t block = 0; block < 3; block++) {
            check_good_file(state, &good_files[i], block);
        }
    }
}

/* ---- what is refused --------------------------------------------------------------------- */

static const struct bad_file {
    const char *name, *text;
    ps_point_options options;
    const char *message;
} bad_files[] = {
    {"a.txt",
     "3\n0.5 0.25\n0 0.75\n",
     {0},
     "a.txt is truncated: it promises 3 points, and point 3"},
    {"a.txt", "2\n0.5 0.25\n0 x\n", {0}, "line 3: \"x\" is not a number"},
    {"a.txt", "2\n0.5 0.25\n0 nan\n", {0}, "line 3: \"nan\" is not a finite number"},
    {"a.txt", "2\n0.5 0.25\n0 1.5\n", {0}, "set 1, row 2: coordinate 1.5 is outside"},
    {"a.txt",
     "2\n0.5 0.25 1\n0 0.5 2\n",
     {0},
     "line 2: 3 columns after a count; --columns xyz, or xyw"},
    {"a.txt",
     "99999999999999999999\n0.5 0.25\n",
     {0},
     "begins with 1e+20, which is not a number of"},
    {"a.txt", "2 2\n0.5 0.25\n0 0.5\n", {.wrap = true}, "--input-format utk-text or gbn"},
    {"a.txt", "-1\n1\n0\n0.5\n", {.wrap = true}, "--input-format utk-text or edat"},
    {"a.edat", "-1\n1\n0\n0.5\n", {.wrap = true}, "--input-format utk-text or edat"},
    {"a.edat", "0.1\n0.9\n0\n0.5\n", {0}, "--input-format utk-text or edat"},
    {"a.csv", "0.5 0.5\n", {0}, "line 1: no comma between two columns"},
    {"a.txt", "2 9\n.1 .2 .3\n", {.format = "gbn"}, "begins with 9, which is not a number of dim"},
    {"a.txt", "2 3\n.1 .2 .3\n.4 .5\n", {0}, "promises 2 points, and point 2 is not there"},
    {"a.txt", "2 3\n.1 .2 .3\n.4 .5 .6", {.dimension = 2}, "3 columns, but the dimension asked"},
    {"pts-a", "0 0 0.5 0.5\n", {0}, "line 1: 4 numbers and no other line: one point, or one after"},
    {"pts-a",
     "0 0 .5 .5 .1 .2 .3 .4\n#\n",
     {ANY},
     "-d says how many dimensions a point has, as in"},
    {"pts-a", "0 0 .5 .5\n", {.domain = PS_DOMAIN_SPHERE}, "--columns, as in xyz, says what a"},
    {"pts-a", "0 0 .5 .5\n#\n0 .5 .5\n", {.dimension = 2}, "set 2 ends inside a point, after 1 of"},
    {"pts-a", "0 0 .5 .5\n#\n0 .5 # 1\n", {.dimension = 2}, "line 3: a '#' behind numbers"},
    {"pts-a", "0 0 .5 .5\n#\n#\n", {.dimension = 2}, "set 2 has no points"},
    {"pts-a",
     "0 0 .5 .5\n0 0 .5 .5\n",
     {.dimension = 2},
     "4 columns, but the dimension asked for is 2"},
    {"pts-a", "0 0 .5 .5\n#\n0 x\n", {.dimension = 2}, "line 3: \"x\" is not a number"},
    {"pts-a", "0 0 .5 .5 .1\n", {.dimension = 2}, "5 columns, but the dimension asked for is 2"},
    {"a.eps", "%!PS\nshowpage\n", {0}, "a.eps holds no points"},
    {"a.eps", "0.5 0.5 p\n", {0}, "a.eps ends in .eps, but does not begin like eps"},
    {"a.npy", "0.5 0.5\n", {0}, "a.npy ends in .npy, but does not begin like npy"},
    {"a.bin", "0.5 0.5\n", {0}, "a.bin ends in .bin, but does not begin like utk-binary"},
    {"a.txt", "0.5,0.5\n0.5\n", {0}, "line 2: 1 column, where line 1 has 2"},
    {"a.txt", "0.5,0.5,\n", {0}, "line 1: \"\" is not a number"},
    {"a.edat", "0 0\n1 1\n0.5 0.5\n", {0}, "first two lines look like corners of a domain, and"},
    {"a.edat", "0 0\n1 1\n2\n0.5 0.5\n", {0}, "--input-format utk-text reads all lines as points"},
    {"a.edat", "0 0\n1 1\n1\n", {0}, "line 4: set 1 has no points"},
    {"a.edat", "0 0\n1 1\n1\n#\n", {0}, "line 4: set 1 has no points"},
    {"a.edat", "0 0\n1 1 1\n0.5 0.5\n", {0}, "line 2: 3 columns, where line 1 has 2"},
    {"a.edat", "0 0\n1 0\n1\n0.5 0.5\n", {0}, "line 1: the corners of the domain enclose nothing"},
    {"a.edat", "0 0\n1 1\n1\n.5 .5 .5 .5\n", {0}, "4 columns in a domain of dimension 2"},
    {"a.edat",
     "0 0\n1 1\n1\n.5 .5\n#\n.5 .5\n",
     {0},
     "line 6: set 2 does not begin with the three lines of EDAT"},
    {"a.edat", "0 0\n1 1\n1\n.5 .5\n#\n0\n1\n1\n.5\n", {0}, "dimension 1 after one of 2"},
    {"a.edat", "0.1 0.2\n0.9 0.95\n", {.format = "edat"}, "line 1: set 1 does not begin with the"},
    {"a.txt", "0.6 0 -0.8\n", {0}, "line 1: coordinate -0.8 is outside [0,1); a unit vector?"},
    {"a.txt",
     "0.5 0.25 7\n",
     {0},
     "coordinate 7 is outside [0,1); in other units? --box X0,X1 takes [X0,X1) to it (a weight?"},
    {"a.txt", "0.5 1.25\n", {0}, "coordinate 1.25 is outside [0,1); --wrap would reduce it mod 1"},
    {"a.txt", "0.5 -1\n", {0}, "coordinate -1 is outside [0,1); --wrap would reduce it mod 1"},
    {"a.txt", "512.25 10\n", {0}, "coordinate 512.25 is outside [0,1); in other units?"},
    {"a.txt", "0 0 1\n.1 .2 .3\n", {ANY}, "line 2: (0.1, 0.2, 0.3) is not a unit vector; --norm"},
    {"a.txt", "0 0 1\n0 0 0\n", {ANY, .normalize_vectors = true}, "line 2: (0, 0, 0) has no dir"},
    {"a.txt", "0 0 1e999\n", {ANY, .normalize_vectors = true}, "line 1: (0, 0, inf) has no dir"},
    {"a.txt", ".1 .2\n", {.domain = PS_DOMAIN_SPHERE}, "line 1: 2 columns; which angles are they?"},
    {"a.txt", ".1\n", {.domain = PS_DOMAIN_SPHERE}, "1 column; points of the sphere have 2 to 4"},
    {"a.txt", ".1 .2\n", {.columns = "theta-phi"}, "columns theta-phi are points of the sphere"},
    {"a.txt", ".1 .2\n", {.domain = PS_DOMAIN_SPHERE, .columns = "xy"}, "are points of the torus"},
    {"a.txt", ".1 .2\n", {.columns = "xyw"}, "line 1: 2 columns, but xyw means 3"},
    {"a.txt", ".1 .2\n", {.columns = "xy", .weight_column = true}, "columns xy have no weight"},
    {"a.txt", "4 0\n", {ANY, .columns = "theta-phi"}, "line 1: 4, 0 are not theta (0 to pi) and"},
    {"a.txt", "0 4\n", {ANY, .columns = "phi-theta"}, "line 1: 0, 4 are not phi (up to 2 pi) and"},
    {"a.txt", "0 91\n", {ANY, .columns = "lon-lat"}, "0, 91 are not longitude and latitude"},
    {"a.txt", "0 9 1e999\n", {ANY, .columns = "lon-lat-w"}, "weight inf is not a finite number"},
    {"a.txt", ".1 .2\n", {.sets = {2, 3}}, "a.txt holds 1 set; set 2 is asked for"},
    {"a.rps", "123456789", {0}, "a.rps: 9 bytes are not whole points of 2 float32"},
    {"a.rps", "0000000011111111", {.points_per_set = 3}, "2 points are not whole sets of 3"},
    {"a.bin", "UTK!", {0}, "a.bin does not begin with the header of UTK binary"},
};

static void refuses_bad_files(void **state) {
    for (size_t i = 0; i < sizeof bad_files / sizeof bad_files[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        test_points all;
        test_write_file(test_path(*state, bad_files[i].name, path), bad_files[i].text,
                        strlen(bad_files[i].text));
        const pspec_status status = test_points_read(&all, path, &bad_files[i].options, &error);
        test_points_free(&all);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, bad_files[i].message) == NULL) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", bad_files[i].text, (int)status,
                     error.message, bad_files[i].message);
        }
    }
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {IN_FOLDER(reads_the_files_of_the_field),
                                       IN_FOLDER(refuses_bad_files)};
    return cmocka_run_group_tests_name("points_formats", tests, NULL, NULL);
}
