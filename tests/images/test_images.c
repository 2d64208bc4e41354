/* Images: pixels of all kinds of rows and orders of bytes, every file cut short, the sentences of
 * what is refused, and means over the sphere of known maps. */
#include "harness.h"

#include "images/sphere_map.h"
#include "math/pi.h"
#include "test_folder.h"

#include <math.h>

enum { MOST_BYTES = 4096, RGBE = 4 };

/* ---- files that are made here -------------------------------------------------------------- */

typedef struct bytes {
    unsigned char all[MOST_BYTES];
    size_t num;
} bytes;

static void put(bytes *file, const void *from, size_t num) {
    assert_true(file->num + num <= MOST_BYTES);
    memcpy(file->all + file->num, from, num);
    file->num += num;
}

static void put_text(bytes *file, const char *text) {
    put(file, text, strlen(text));
}

/* Byte `component` of pixel (x, y): runs of both kinds, and an exponent that is 0. */
static unsigned char code(size_t x, size_t y, size_t component) {
    const size_t flat = x / 3;
    return (unsigned char)(component < 3         ? (17 * flat + 5 * component + y) % 251
                           : (flat + y) % 5 == 0 ? 0
                                                 : 120 + (flat + y) % 16);
}

/* Value of it, by its definition. */
static float value_of(size_t x, size_t y, size_t component) {
    const int exponent = code(x, y, 3);
    return exponent == 0 ? 0 : (float)(code(x, y, component) * pow(2, exponent - 136));
}

typedef enum rows { FLAT, OLD_RUNS, NEW_RUNS } row_kind;

static size_t run_of(size_t x, size_t y, size_t width, bool all) {
    size_t run = 1;
    while (x + run < width && run < 127) {
        for (size_t i = 0; i < (all ? RGBE : 1u); i++) {
            if (code(x + run, y, i) != code(x, y, i)) {
                return run;
            }
        }
        run++;
    }
    return run;
}

static void put_components(bytes *file, size_t y, size_t width) {
    const unsigned char begin[] = {2, 2, (unsigned char)(width >> 8), (unsigned char)width};
    put(file, begin, sizeof begin);
    for (size_t component = 0; component < RGBE; component++) {
        for (size_t x = 0; x < width;) {
            const size_t left = width - x < 2 ? width - x : 2;
            const unsigned char run[] = {128 + 3, code(x, y, component)};
            const bool is_run = x % 3 == 0 && width - x >= 3;
            unsigned char literal[3] = {(unsigned char)left};
            for (size_t i = 0; i < left; i++) {
                literal[1 + i] = code(x + i, y, component);
            }
            put(file, is_run ? run : literal, is_run ? 2 : 1 + left);
            x += is_run ? 3 : left;
        }
    }
}

static void put_pixels(bytes *file, size_t y, size_t width, bool has_runs) {
    for (size_t x = 0; x < width;) {
        unsigned char pixel[RGBE];
        for (size_t i = 0; i < RGBE; i++) {
            pixel[i] = code(x, y, i);
        }
        put(file, pixel, RGBE);
        const size_t run = has_runs ? run_of(x, y, width, true) : 1;
        const unsigned char again[] = {1, 1, 1, (unsigned char)(run - 1)};
        if (run > 1) {
            put(file, again, RGBE);
        }
        x += run;
    }
}

static void make_hdr(bytes *file, const char *header, size_t width, size_t height, row_kind rows) {
    char size[64];
    file->num = 0;
    put_text(file, header);
    snprintf(size, sizeof size, "\n-Y %zu +X %zu\n", height, width);
    put_text(file, size);
    for (size_t y = 0; y < height; y++) {
        if (rows == NEW_RUNS) {
            put_components(file, y, width);
        } else {
            put_pixels(file, y, width, rows == OLD_RUNS);
        }
    }
}

static const char plain[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";

/* All of an image. */
typedef struct whole_image {
    ps_image size;
    float pixels[MOST_BYTES];
} whole_image;

static pspec_status begin(void *payload, const ps_image *size, ps_error *error) {
    whole_image *const self = payload;
    self->size = *size;
    return size->width * size->height * size->num_channels <= MOST_BYTES
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_MEMORY, "an image of many pixels begins");
}

static pspec_status take(void *payload, const ps_image *size, size_t y, const float *row,
                         ps_error *error) {
    whole_image *const self = payload;
    const size_t num = size->width * size->num_channels;
    (void)error;
    memcpy(self->pixels + y * num, row, num * sizeof *row);
    return PSPEC_OK;
}

static pspec_status read_bytes(whole_image *out, void **state, const bytes *file, ps_error *error) {
    char path[TEST_PATH_BYTES];
    assert_true(test_write_file(test_path(*state, "image", path), file->all, file->num));
    return ps_image_read(path, &(ps_image_taker){out, begin, take}, error);
}

/* ---- pixels -------------------------------------------------------------------------------- */

static void check_hdr(void **state, size_t width, size_t height, row_kind rows) {
    bytes file;
    whole_image image;
    make_hdr(&file, plain, width, height, rows);
    assert_ok(read_bytes(&image, state, &file, error));
    assert_int_equal(image.size.width, width);
    assert_int_equal(image.size.height, height);
    assert_int_equal(image.size.num_channels, 3);
    for (size_t i = 0; i < width * height * 3; i++) {
        assert_true(image.pixels[i] == value_of(i / 3 % width, i / 3 / width, i % 3));
    }
}

static void rows_of_all_kinds(void **state) {
    for (size_t width = 1; width < 40; width += width < 10 ? 1 : 7) {
        check_hdr(state, width, 3, FLAT);
        check_hdr(state, width, 3, OLD_RUNS);
        if (width >= 8) {
            check_hdr(state, width, 3, NEW_RUNS);
        }
    }
}

/* 1,1,1,n after another such is n times 256. */
static void long_runs_of_the_old_kind(void **state) {
    static const unsigned char row[] = {9, 8, 7, 129, 1, 1, 1, 43, 1, 1, 1, 1};
    bytes file = {.num = 0};
    whole_image image;
    put_text(&file, "#?RGBE\n\n-Y 1 +X 300\n");
    put(&file, row, sizeof row);
    assert_ok(read_bytes(&image, state, &file, error));
    for (size_t i = 0; i < 900; i++) {
        assert_true(image.pixels[i] == ldexpf((float)row[i % 3], -7));
    }
}

/* Rows from below, from the right, and light times exposures. */
static void headers_are_followed(void **state) {
    enum { WIDTH = 5, HEIGHT = 2 };
    bytes file;
    whole_image image;
    make_hdr(&file, "#?RADIANCE\n# made\r\nEXPOSURE= 2\nEXPOSURE=.25\nGAMMA=1\n", WIDTH, HEIGHT,
             FLAT);
    char *const size = strstr((char *)file.all, "-Y 2 +X 5");
    size[0] = '+';
    size[5] = '-';
    assert_ok(read_bytes(&image, state, &file, error));
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT * 3; i++) {
        const size_t x = i / 3 % WIDTH;
        const size_t y = i / 3 / WIDTH;
        assert_true(image.pixels[i] == 2 * value_of(WIDTH - 1 - x, HEIGHT - 1 - y, i % 3));
    }
}

static void floats_of_both_orders(void **state) {
    static const float numbers[] = {1.5f, -2, 0.25f, 1e30f, 0, 7};
    for (int big = 0; big < 2; big++) {
        for (unsigned channels = 1; channels <= 3; channels += 2) {
            bytes file = {.num = 0};
            whole_image image;
            put_text(&file, channels == 3 ? "PF\n1 2\n" : "Pf 3\t2\r\n");
            put_text(&file, big != 0 ? "1.0\n" : "-2e0\n");
            for (size_t i = 0; i < 6; i++) {
                unsigned char number[4];
                memcpy(number, &numbers[i], sizeof number); /* of a little-endian machine */
                const unsigned char turned[] = {number[3], number[2], number[1], number[0]};
                put(&file, big != 0 ? turned : number, sizeof number);
            }
            assert_ok(read_bytes(&image, state, &file, error));
            assert_int_equal(image.size.num_channels, channels);
            for (size_t i = 0; i < 6; i++) { /* the lowest row comes first */
                assert_true(image.pixels[i] == numbers[(i + 3) % 6]);
            }
        }
    }
}

/* ---- what is refused ----------------------------------------------------------------------- */

static void refuse(void **state, const bytes *file, const char *piece) {
    whole_image image;
    ps_error error = {0};
    const pspec_status status = read_bytes(&image, state, file, &error);
    assert_int_equal(status, PSPEC_ERROR_INPUT);
    if (strstr(error.message, piece) == NULL) {
        fail_msg("\"%s\" has no \"%s\"", error.message, piece);
    }
}

static void every_prefix_is_refused(void **state) {
    bytes file;
    for (int i = FLAT; i <= NEW_RUNS; i++) {
        make_hdr(&file, plain, 11, 2, (row_kind)i);
        const size_t whole = file.num;
        for (file.num = 1; file.num < whole; file.num++) {
            refuse(state, &file, "image");
        }
        file.num = whole;
        put_text(&file, "x");
        refuse(state, &file, "bytes follow");
    }
}

static void refuse_text(void **state, const char *text, const char *piece) {
    bytes file = {.num = 0};
    put_text(&file, text);
    refuse(state, &file, piece);
}

static void nonsense_is_one_sentence(void **state) {
    static const unsigned char exr[] = {0x76, 0x2f, 0x31, 1, 2, 0};
    bytes file = {.num = 0};
    put(&file, exr, sizeof exr);
    refuse(state, &file, "OpenEXR is not read; convert it");
    refuse_text(state, "\x89PNG\r\n", "PNG is not read");
    refuse_text(state, "P6 1 1 255 abc", "no image in Radiance HDR");
    refuse_text(state, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", "xyze is not read");
    refuse_text(state, "#?RADIANCE\nEXPOSURE=-1\n\n-Y 1 +X 1\nabcd", "is no exposure");
    refuse_text(state, "#?RADIANCE\n\n+X 1 -Y 1\nabcd", "no size that is read");
    refuse_text(state, "#?RADIANCE\n\n-Y 1.5 +X 1\nabcd", "no size that is read");
    refuse_text(state, "#?RADIANCE\n\n-Y 1e9 +X 1e9\nabcd",
                "there may be 268435456 of them, and 65536");
    refuse_text(state, "#?RADIANCE\n\n-Y 0 +X 9\nabcd", "there may be");
    refuse_text(state, "#?RADIANCE\n\n-Y 16384 +X 16384\nabcd", "take at least 1044480 bytes");
    refuse_text(state, "#?RADIANCE\n\n-Y 1 +X 2\n\x01\x01\x01\x01", "does not fit its row");
    refuse_text(state, "#?RADIANCE\n\n-Y 1 +X 2\nabcd\x01\x01\x01\x09", "does not fit its row");
    refuse_text(state, "PF 1.5 2 -1\n            ", "there may be");
    refuse_text(state, "PF 1 1 one\n            ", "\"one\" is no scale");
    refuse_text(state, "PF 2 1 -1\nabcd", "take at least 24 bytes");
    memset(&file, 0, sizeof file);
    put_text(&file, "#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02");
    put(&file, "\0\x09", 2);
    refuse(state, &file, "says that it has 9 pixels, not 8");
}

/* ---- light --------------------------------------------------------------------------------- */

static void light_is_neither_negative_nor_nan(void **state) {
    static const float numbers[] = {1, -1, NAN, INFINITY, 3, 0.5f};
    char path[TEST_PATH_BYTES];
    bytes file = {.num = 0};
    ps_sphere_map map;
    put_text(&file, "Pf 3 2 -1\n");
    put(&file, numbers, sizeof numbers);
    assert_true(test_write_file(test_path(*state, "map", path), file.all, file.num));
    ps_error failure = {0};
    ps_channel_source source = {.path = path, .channel = PS_MAP_RED};
    assert_int_equal(ps_sphere_map_read(&map, &source, &failure), PSPEC_ERROR_INPUT);
    ps_sphere_map_free(&map);
    assert_non_null(strstr(failure.message, "row 1, column 1, from 0, is -1"));
    source.may_clamp = true;
    assert_ok(ps_sphere_map_read(&map, &source, error));
    assert_int_equal(map.num_clamped, 3);
    assert_true(map.rows[3] == 0 && map.rows[4] == 3 && map.rows[5] == 0.5 && map.rows[6] == 1 &&
                map.rows[7] == 0 && map.rows[8] == 0);
    assert_true(fabs(map.rows[0] - 3.5 / 3) < 1e-15);
    assert_true(fabs(map.rows[9] - 1.0 / 3) < 1e-15);
    ps_sphere_map_free(&map);
}

static pspec_status begin_any(void *payload, const ps_image *size, ps_error *error) {
    (void)error;
    *(ps_image *)payload = *size;
    return PSPEC_OK;
}

static pspec_status take_none(void *payload, const ps_image *size, size_t y, const float *row,
                              ps_error *error) {
    (void)payload;
    (void)size;
    (void)row;
    return ps_fail(error, PSPEC_ERROR_IO, "row %zu came", y);
}

/* Through a pipe nobody knows what comes: a row is handed over when it is there. */
static void pipes_promise_in_vain(void **state) {
    static const char *const headers[] = {"#?RADIANCE\n\n-Y 16384 +X 16384\nabcd",
                                          "PF 16384 16384 -1\nabcd"};
    (void)state;
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++) {
        int ends[2];
        char path[64];
        ps_image image = {0};
        ps_error failure = {0};
        assert_int_equal(pipe(ends), 0);
        assert_true(write(ends[1], headers[i], strlen(headers[i])) > 0);
        close(ends[1]);
        snprintf(path, sizeof path, "/proc/self/fd/%d", ends[0]);
        assert_int_equal(
            ps_image_read(path, &(ps_image_taker){&image, begin_any, take_none}, &failure),
            PSPEC_ERROR_INPUT);
        assert_int_equal(image.height, 16384);
        close(ends[0]);
    }
}

/* Means over the sphere that others found in the files themselves, weighted by sin theta. */
static void known_maps(void **state) {
    static const struct {
        const char *name;
        double means[4]; /* luminance, red, green, blue */
    } maps[] = {{"pisa_1024x512", {.1790, .2066, .1721, .1651}},
                {"uffizi_512x256", {.8816, .8941, .8673, .9869}},
                {"wells_256x128", {.2410, .2848, .2316, .2048}},
                {"royal_esplanade_1k", {.8089, .9572, .7773, .6852}},
                {"quarry_01_1k", {.6682, .7632, .6594, .4752}},
                {"StageEnvLatLong", {3.496, 2.769, 3.56, 5.003}}};
    const char *const folder = getenv("POINTSPEC_TEST_DATA");
    size_t num = 0;
    (void)state;
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++) {
        char path[TEST_PATH_BYTES];
        snprintf(path, sizeof path, "%s/env/%s.hdr", folder != NULL ? folder : ".", maps[i].name);
        for (int channel = PS_MAP_LUMINANCE; channel <= PS_MAP_BLUE && access(path, R_OK) == 0;
             channel++) {
            ps_sphere_map map;
            ps_map_moments moments;
            const ps_channel_source source = {.path = path, .channel = (ps_map_channel)channel};
            assert_ok(ps_sphere_map_read(&map, &source, error));
            assert_ok(ps_sphere_map_moments(&moments, &map, false, error));
            assert_true(fabs(moments.integral / PS_FOUR_PI / maps[i].means[channel] - 1) < 4e-4);
            ps_sphere_map_free(&map);
            num++;
        }
    }
    if (num == 0) {
        print_message("no maps of light in POINTSPEC_TEST_DATA\n");
        skip();
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_all_kinds),
        cmocka_unit_test(long_runs_of_the_old_kind),
        cmocka_unit_test(headers_are_followed),
        cmocka_unit_test(floats_of_both_orders),
        cmocka_unit_test(every_prefix_is_refused),
        cmocka_unit_test(nonsense_is_one_sentence),
        cmocka_unit_test(light_is_neither_negative_nor_nan),
        cmocka_unit_test(pipes_promise_in_vain),
        cmocka_unit_test(known_maps),
    };
    return cmocka_run_group_tests_name("images", tests, test_folder_create, test_folder_remove);
}
