/* Every point format but UTK text and NPY, which have tests of their own: small files as the tools of
 * the field write them, what is refused, and round trips through all of them. */
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
    /* EDAT */
    {"a.edat", "0 0\n1 1\n0.5 0.25\n#\n0 0.75\n", {0}, "edat", "xy", 2, 2, 0.75, NONE},
    {"a.edat", "-1 2\n1 4\n0.5 2.25\n0 3.5\n", {0}, "edat", "xy", 1, 2, 0.75, NONE},
    {"a.edat",
     "0 0\n1 1\n.5 .25 7\n0 .75 8\n",
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

static void refuses_bad_files(void **state) {
    static const struct {
        const char *name, *text;
        ps_point_options options;
        const char *message;
    } cases[] = {
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
         "line 2: 3 columns after a count; --columns xyw"},
        {"a.txt",
         "99999999999999999999\n0.5 0.25\n",
         {0},
         "begins with 1e+20, which is not a number of"},
        {"a.txt", "2 2\n0.5 0.25\n0 0.5\n", {.wrap = true}, "--input-format utk-text or gbn"},
        {"a.txt",
         "2 9\n.1 .2 .3\n",
         {.format = "gbn"},
         "begins with 9, which is not a number of dim"},
        {"a.txt", "2 3\n.1 .2 .3\n.4 .5\n", {0}, "promises 2 points, and point 2 is not there"},
        {"a.txt",
         "2 3\n.1 .2 .3\n.4 .5 .6",
         {.dimension = 2},
         "3 columns, but the dimension asked"},
        {"a.eps", "%!PS\nshowpage\n", {0}, "a.eps holds no points"},
        {"a.eps", "0.5 0.5 p\n", {0}, "a.eps ends in .eps, but does not begin like eps"},
        {"a.npy", "0.5 0.5\n", {0}, "a.npy ends in .npy, but does not begin like npy"},
        {"a.bin", "0.5 0.5\n", {0}, "a.bin ends in .bin, but does not begin like utk-binary"},
        {"a.txt", "0.5,0.5\n0.5\n", {0}, "line 2: 1 column, where line 1 has 2"},
        {"a.txt", "0.5,0.5,\n", {0}, "line 1: \"\" is not a number"},
        {"a.edat", "0 0\n", {0}, "a.edat holds no points"},
        {"a.edat", "0 0\n1 1 1\n0.5 0.5\n", {0}, "line 2: not a corner of the domain"},
        {"a.edat", "0 0\n1 0\n0.5 0.5\n", {0}, "the corners 0 and 0 of the domain enclose nothing"},
        {"a.edat", "0 0\n1 1\n.5 .5 .5 .5\n", {0}, "line 3: 4 columns in a domain of dimension 2"},
        {"a.txt", "0.6 0 -0.8\n", {0}, "line 1: coordinate -0.8 is outside [0,1); a unit vector?"},
        {"a.txt",
         "0 0 1\n.1 .2 .3\n",
         {ANY},
         "line 2: (0.1, 0.2, 0.3) is not a unit vector; --norm"},
        {"a.txt",
         "0 0 1\n0 0 0\n",
         {ANY, .normalize_vectors = true},
         "line 2: (0, 0, 0) has no dir"},
        {"a.txt",
         "0 0 1e999\n",
         {ANY, .normalize_vectors = true},
         "line 1: (0, 0, inf) has no dir"},
        {"a.txt",
         ".1 .2\n",
         {.domain = PS_DOMAIN_SPHERE},
         "line 1: 2 columns; which angles are they?"},
        {"a.txt",
         ".1\n",
         {.domain = PS_DOMAIN_SPHERE},
         "1 column; points of the sphere have 2 to 4"},
        {"a.txt",
         ".1 .2\n",
         {.columns = "theta-phi"},
         "columns theta-phi are points of the sphere"},
        {"a.txt",
         ".1 .2\n",
         {.domain = PS_DOMAIN_SPHERE, .columns = "xy"},
         "are points of the torus"},
        {"a.txt", ".1 .2\n", {.columns = "xyw"}, "line 1: 2 columns, but xyw means 3"},
        {"a.txt", ".1 .2\n", {.columns = "xy", .weight_column = true}, "columns xy have no weight"},
        {"a.txt",
         "4 0\n",
         {ANY, .columns = "theta-phi"},
         "line 1: 4, 0 are not theta (0 to pi) and"},
        {"a.txt",
         "0 4\n",
         {ANY, .columns = "phi-theta"},
         "line 1: 0, 4 are not phi (up to 2 pi) and"},
        {"a.txt", "0 91\n", {ANY, .columns = "lon-lat"}, "0, 91 are not longitude and latitude"},
        {"a.txt",
         "0 9 1e999\n",
         {ANY, .columns = "lon-lat-w"},
         "weight inf is not a finite number"},
        {"a.txt", ".1 .2\n", {.sets = {2, 3}}, "a.txt holds 1 set; set 2 is asked for"},
        {"a.rps", "123456789", {0}, "a.rps: 9 bytes are not whole points of 2 float32"},
        {"a.rps", "0000000011111111", {.points_per_set = 3}, "2 points are not whole sets of 3"},
        {"a.bin", "UTK!", {0}, "a.bin does not begin with the header of UTK binary"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        test_points all;
        test_write_file(test_path(*state, cases[i].name, path), cases[i].text,
                        strlen(cases[i].text));
        const pspec_status status = test_points_read(&all, path, &cases[i].options, &error);
        test_points_free(&all);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i].message) == NULL) {
            fail_msg("%s: status %d, \"%s\", expected \"%s\"", cases[i].text, (int)status,
                     error.message, cases[i].message);
        }
    }
}

/* ---- UTK binary -------------------------------------------------------------------------- */

static size_t make_utk(unsigned char *file, unsigned type, uint32_t m, uint32_t n, uint32_t d,
                       const void *values, size_t num_bytes) {
    const uint32_t counts[] = {m, n, d}; /* this machine is little-endian */
    memset(file, 0, 20);
    memcpy(file, "UTK!", 4);
    file[4] = (unsigned char)type;
    memcpy(file + 8, counts, sizeof counts);
    memcpy(file + 20, values, num_bytes);
    return 20 + num_bytes;
}

static pspec_status read_utk(void **state, const unsigned char *file, size_t num_bytes,
                             const ps_point_options *options, test_points *all, ps_error *error) {
    char path[TEST_PATH_BYTES];
    assert_true(test_write_file(test_path(*state, "a.bin", path), file, num_bytes));
    return test_points_read(all, path, options, error);
}

static void reads_every_type_of_utk(void **state) {
    static const double doubles[] = {0.5, 0.25, 0, 0.75};
    static const float floats[] = {0.5F, 0.25F, 0, 0.75F};
    static const uint32_t zeros[8] = {0};
    static const struct {
        unsigned type;
        const void *values;
        size_t num_bytes;
    } cases[] = {{0, zeros, 16}, {1, zeros, 32},  {2, zeros, 16},
                 {3, zeros, 32}, {4, floats, 16}, {5, doubles, 32}};
    for (size_t i = 0; i < 6; i++) {
        unsigned char file[64];
        ps_error error = {0};
        test_points all;
        const ps_point_options options = {0};
        const size_t num_bytes =
            make_utk(file, cases[i].type, 1, 2, 2, cases[i].values, cases[i].num_bytes);
        assert_int_equal(read_utk(state, file, num_bytes, &options, &all, &error), PSPEC_OK);
        assert_int_equal(all.num_points, 2);
        assert_true(is_same(all.points[3], i < 4 ? 0 : 0.75));
        test_points_free(&all);
    }
}

static void refuses_bad_utk(void **state) {
    static const double doubles[] = {0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25};
    static const int32_t integers[] = {3, 4};
    static const struct {
        unsigned type;
        uint32_t m, n, d;
        const void *values;
        size_t num_bytes;
        ps_point_options options;
        const char *message;
    } cases[] = {
        {5,
         1,
         2,
         2,
         doubles,
         24,
         {0},
         "is truncated: its header promises 32 bytes of values, there are 24"},
        {5, 1, 2, 2, doubles, 40, {0}, "is too long"},
        {5, 1, 2, 2, doubles, 64, {0}, "holds values of 16 bytes (long double)"},
        {6, 1, 2, 2, doubles, 32, {0}, "have the type 6; 0 to 5 are known"},
        {5, 0, 2, 2, doubles, 32, {0}, "holds no points"},
        {5, UINT32_MAX, UINT32_MAX, 6, doubles, 32, {0}, "its header promises 4294967295 sets"},
        {5, 1, 2, 8, doubles, 32, {0}, "dimension 8; at most 6 are read"},
        {0, 1, 1, 2, integers, 8, {0}, "coordinate 3 is outside [0,1)"},
        {0,
         1,
         1,
         2,
         integers,
         8,
         {.wrap = true},
         "holds whole numbers, which --wrap would all make 0"},
        {5, 2, 2, 2, doubles, 64, {0}, "set 2 repeats set 1, as in files that UTK 2.0.1 wrote"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        unsigned char file[128];
        ps_error error = {0};
        test_points all;
        const size_t num_bytes = make_utk(file, cases[i].type, cases[i].m, cases[i].n, cases[i].d,
                                          cases[i].values, cases[i].num_bytes);
        const pspec_status status =
            read_utk(state, file, num_bytes, &cases[i].options, &all, &error);
        test_points_free(&all);
        if (status != PSPEC_ERROR_INPUT || strstr(error.message, cases[i].message) == NULL) {
            fail_msg("case %zu: status %d, \"%s\"", i, (int)status, error.message);
        }
    }
}

/* Whoever says which sets are meant gets them, equal or not. */
static void reads_repeated_sets_when_told(void **state) {
    static const double doubles[] = {0.5, 0.25, 0.5, 0.25, 0.5, 0.25, 0.5, 0.25};
    unsigned char file[128];
    ps_error error = {0};
    test_points all;
    const ps_point_options first = {.sets = {1, 1}};
    const ps_point_options both = {.sets = {1, 2}};
    const size_t num_bytes = make_utk(file, 5, 2, 2, 2, doubles, sizeof doubles);
    assert_int_equal(read_utk(state, file, num_bytes, &first, &all, &error), PSPEC_OK);
    assert_int_equal(all.num_sets, 1);
    test_points_free(&all);
    assert_int_equal(read_utk(state, file, num_bytes, &both, &all, &error), PSPEC_OK);
    assert_int_equal(all.num_sets, 2);
    test_points_free(&all);
}

/* ---- raw floats and openquad ------------------------------------------------------------- */

static void reads_raw_floats(void **state) {
    static const float values[] = {0.5F, 0.25F, 0, 0.75F, 0.125F, 0.375F, 0.1F, 0.2F};
    static const struct {
        const char *name;
        ps_point_options options;
        size_t num_sets, num_points;
        unsigned dimension;
    } cases[] = {
        {"a.rps", {0}, 1, 4, 2},
        {"stdin.binary", {.points_per_set = 2}, 2, 4, 2},
        {"a.rps", {.points_per_set = 1}, 4, 4, 2},
        {"a.raw", {.format = "rps", .dimension = 4, .points_per_set = 1}, 2, 2, 4},
        {"a.rps", {.points_per_set = 1, .sets = {2, 3}}, 2, 2, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[TEST_PATH_BYTES];
        ps_error error = {0};
        test_points all;
        assert_true(test_write_file(test_path(*state, cases[i].name, path), values, sizeof values));
        assert_int_equal(test_points_read(&all, path, &cases[i].options, &error), PSPEC_OK);
        assert_int_equal(all.num_sets, cases[i].num_sets);
        assert_int_equal(all.num_points, cases[i].num_points);
        assert_int_equal(all.dimension, cases[i].dimension);
        assert_true(cases[i].options.sets.last != 0 || is_same(all.points[7], (double)0.2F));
        test_points_free(&all);
    }
}

static void reads_openquad(void **state) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    enum { NUM = 9 };
    double points[2 * NUM];
    double weights[NUM];
    for (int i = 0; i < NUM; i++) {
        points[2 * i] = 0.3 * i;
        points[2 * i + 1] = 0.7 * i;
        weights[i] = i - 3;
    }
    ps_point_set set = {.coordinates = PS_ANGLES,
                        .dimension = 2,
                        .num_points = NUM,
                        .points = points,
                        .weights = weights,
                        .has_weights = true};
    test_path(*state, "a.npy", path);
    assert_int_equal(test_points_write(path, "openquad", &set, 1, true, NULL, &error), PSPEC_OK);
    const ps_point_options options = {ANY, .keep_angles = true};
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_string_equal(all.format, "openquad");
    assert_string_equal(all.columns, "theta-phi-w");
    assert_int_equal(all.num_points, NUM);
    assert_memory_equal(all.points, points, sizeof points);
    assert_memory_equal(all.weights, weights, sizeof weights);
    test_points_free(&all);
    /* short rows could be points */
    set.num_points = 3;
    assert_int_equal(test_points_write(path, "openquad", &set, 1, true, NULL, &error), PSPEC_OK);
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_ERROR_INPUT);
    assert_non_null(
        strstr(error.message, "shape (3, 3): points, or rows of angles? --input-format"));
    test_points_free(&all);
}

/* ---- round trips ------------------------------------------------------------------------- */

enum { NUM_POINTS = 1000, NUM_SETS = 3 };

static void fill(double *values, size_t count, uint64_t random, bool narrow) {
    for (size_t i = 0; i < count; i++) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        values[i] = (double)(random >> 11) * 0x1p-53;
        values[i] = narrow ? (double)(float)(values[i] / 2) : values[i];
    }
}

/* Writes the sets, reads them back, compares bits; false when the format cannot hold them. */
static bool makes_round_trip(void **state, const char *format, const ps_point_set *sets,
                             size_t num_sets, bool shape_is_known) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    test_points all;
    const ps_point_options options = {.format = format,
                                      .dimension = sets[0].dimension,
                                      .points_per_set = NUM_POINTS,
                                      .weight_column = sets[0].has_weights};
    test_path(*state, "round", path);
    const pspec_status status =
        test_points_write(path, format, sets, num_sets, shape_is_known, NULL, &error);
    if (status != PSPEC_OK) {
        assert_int_equal(status, PSPEC_ERROR_INVALID_ARGUMENT);
        assert_non_null(strstr(error.message, "hold"));
        assert_int_equal(access(path, F_OK), -1);
        return false;
    }
    if (test_points_read_blocks(&all, path, &options, 333, &error) != PSPEC_OK) {
        fail_msg("%s: %s", format, error.message);
    }
    assert_int_equal(all.num_sets, num_sets);
    assert_int_equal(all.num_points, num_sets * NUM_POINTS);
    for (size_t m = 0; m < num_sets; m++) {
        const size_t count = (size_t)NUM_POINTS * sets[0].dimension;
        assert_memory_equal(all.points + m * count, sets[m].points, count * sizeof(double));
        assert_true(!sets[0].has_weights || memcmp(all.weights + m * NUM_POINTS, sets[m].weights,
                                                   NUM_POINTS * sizeof(double)) == 0);
    }
    test_points_free(&all);
    remove(path);
    return true;
}

static void round_trips_are_bitwise(void **state) {
    static const struct {
        const char *format;
        unsigned most_dimensions;
        size_t most_sets;
        bool holds_weights;
    } limits[] = {
        {"utk-text", 6, 3, true}, {"csv", 6, 3, true},         {"psa-text", 2, 1, true},
        {"gbn", 6, 1, false},     {"edat", 6, 3, true},        {"eps", 2, 1, false},
        {"rps", 6, 3, false},     {"utk-binary", 6, 3, false}, {"npy", 6, 3, true},
    };
    static double points[NUM_SETS][NUM_POINTS * 6];
    static double weights[NUM_SETS][NUM_POINTS];
    for (size_t f = 0; f < sizeof limits / sizeof limits[0]; f++) {
        for (unsigned combination = 0; combination < 32; combination++) {
            static const unsigned dimensions[] = {1, 2, 3, 6};
            const unsigned d = dimensions[combination % 4];
            const size_t num_sets = combination / 4 % 2 != 0 ? NUM_SETS : 1;
            const bool has_weights = combination / 8 % 2 != 0;
            const bool is_known = combination / 16 % 2 != 0;
            const bool is_psa =
                strcmp(limits[f].format, "psa-text") == 0 || strcmp(limits[f].format, "eps") == 0;
            ps_point_set sets[NUM_SETS];
            for (size_t m = 0; m < num_sets; m++) {
                fill(points[m], (size_t)NUM_POINTS * d, m + combination,
                     strcmp(limits[f].format, "rps") == 0);
                fill(weights[m], NUM_POINTS, m + 77, false);
                sets[m] = (ps_point_set){.dimension = d,
                                         .num_points = NUM_POINTS,
                                         .points = points[m],
                                         .weights = weights[m],
                                         .has_weights = has_weights};
            }
            const bool fits = num_sets <= limits[f].most_sets &&
                              (is_psa ? d == 2 : d <= limits[f].most_dimensions) &&
                              (!has_weights || limits[f].holds_weights);
            if (makes_round_trip(state, limits[f].format, sets, num_sets, is_known) != fits) {
                fail_msg("%s, d = %u, %zu sets, weights %d", limits[f].format, d, num_sets,
                         has_weights);
            }
        }
    }
}

static void says_what_is_lost(void **state) {
    double points[] = {0.1, 0.5, 0.99999999999, 0.25};
    const ps_point_set set = {.dimension = 2, .num_points = 2, .points = points};
    const ps_point_shape shape = {.num_sets = 1, .num_points = 2, .dimension = 2};
    char path[TEST_PATH_BYTES];
    char loss[256];
    ps_error error = {0};
    test_points all;
    ps_point_writer *writer = NULL;
    test_path(*state, "a.rps", path);
    assert_int_equal(ps_points_create(&writer, path, NULL, &shape, &error), PSPEC_OK);
    assert_int_equal(ps_points_write(writer, &set, true, &error), PSPEC_OK);
    ps_points_describe_loss(writer, loss, sizeof loss);
    assert_string_equal(loss, "2 of 4 coordinates were rounded to float32, by at most 6e-08");
    assert_int_equal(ps_points_commit(writer, &error), PSPEC_OK);
    ps_points_discard(writer);
    const ps_point_options options = {0};
    assert_int_equal(test_points_read(&all, path, &options, &error), PSPEC_OK);
    assert_true(all.points[2] < 1); /* never rounded out of the torus */
    test_points_free(&all);
}

int main(void) {
#define IN_FOLDER(test)                                                                            \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)
    const struct CMUnitTest tests[] = {
        IN_FOLDER(reads_the_files_of_the_field),
        IN_FOLDER(refuses_bad_files),
        IN_FOLDER(reads_every_type_of_utk),
        IN_FOLDER(refuses_bad_utk),
        IN_FOLDER(reads_repeated_sets_when_told),
        IN_FOLDER(reads_raw_floats),
        IN_FOLDER(reads_openquad),
        IN_FOLDER(round_trips_are_bitwise),
        IN_FOLDER(says_what_is_lost),
    };
    return cmocka_run_group_tests_name("points_formats", tests, NULL, NULL);
}
