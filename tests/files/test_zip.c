/* Arrays of zip archives: as numpy writes them, as streams write them, and damaged. */
#include "harness_points.h"

#include "files/npy_array.h"
#include "points/lists/weight_list.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include <cmocka.h>

enum { NUM_POINTS = 20000, ROOM = 1 << 20, METHOD_STORED = 0, METHOD_DEFLATED = 8 };

/* ---- archives ---------------------------------------------------------------------------- */

typedef struct bytes {
    unsigned char *data;
    size_t num;
} bytes;

static void put(bytes *out, uint64_t value, unsigned num_bytes) {
    for (unsigned i = 0; i < num_bytes; i++) {
        out->data[out->num++] = (unsigned char)(value >> 8 * i);
    }
}

static void put_bytes(bytes *out, const void *data, size_t num) {
    memcpy(out->data + out->num, data, num);
    out->num += num;
}

/* How an archive is written. */
typedef struct style {
    unsigned method, flags;
    bool is_zip64;    /* sizes and offset stand in extra fields, the directory in a zip64 record */
    bool is_streamed; /* the head of a member has no sizes */
    const char *comment;
} style;

typedef struct member {
    const char *name;
    bytes content;
    size_t offset, compressed;
} member;

static void put_member(bytes *out, const style *how, member *one) {
    const uint32_t crc = (uint32_t)crc32(0, one->content.data, (uInt)one->content.num);
    unsigned char *const packed = malloc(ROOM);
    z_stream stream = {0};
    one->offset = out->num;
    one->compressed = one->content.num;
    if (how->method == METHOD_DEFLATED) {
        deflateInit2(&stream, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
        stream.next_in = one->content.data;
        stream.avail_in = (uInt)one->content.num;
        stream.next_out = packed;
        stream.avail_out = ROOM;
        assert_int_equal(deflate(&stream, Z_FINISH), Z_STREAM_END);
        one->compressed = stream.total_out;
        deflateEnd(&stream);
    } else {
        memcpy(packed, one->content.data, one->content.num);
    }
    put_bytes(out, "PK\3\4", 4);
    put(out, 20, 2);
    put(out, how->flags | (how->is_streamed ? 8 : 0), 2);
    put(out, how->method, 2);
    put(out, 0, 4); /* time */
    put(out, how->is_streamed ? 0 : crc, 4);
    put(out, how->is_streamed ? 0 : how->is_zip64 ? UINT32_MAX : one->compressed, 4);
    put(out, how->is_streamed ? 0 : how->is_zip64 ? UINT32_MAX : one->content.num, 4);
    put(out, strlen(one->name), 2);
    put(out, how->is_zip64 ? 20 : 0, 2);
    put_bytes(out, one->name, strlen(one->name));
    if (how->is_zip64) {
        put(out, 1, 2);
        put(out, 16, 2);
        put(out, one->content.num, 8);
        put(out, one->compressed, 8);
    }
    put_bytes(out, packed, one->compressed);
    if (how->is_streamed) {
        put_bytes(out, "PK\7\10", 4);
        put(out, crc, 4);
        put(out, one->compressed, 4);
        put(out, one->content.num, 4);
    }
    free(packed);
}

static void put_entry(bytes *out, const style *how, const member *one) {
    const uint32_t crc = (uint32_t)crc32(0, one->content.data, (uInt)one->content.num);
    put_bytes(out, "PK\1\2", 4);
    put(out, 20, 2);
    put(out, 20, 2);
    put(out, how->flags | (how->is_streamed ? 8 : 0), 2);
    put(out, how->method, 2);
    put(out, 0, 4);
    put(out, crc, 4);
    put(out, how->is_zip64 ? UINT32_MAX : one->compressed, 4);
    put(out, how->is_zip64 ? UINT32_MAX : one->content.num, 4);
    put(out, strlen(one->name), 2);
    put(out, how->is_zip64 ? 4 + 28 + 5 : 0, 2);
    put(out, 3, 2); /* a comment */
    put(out, 0, 2 + 2 + 4);
    put(out, how->is_zip64 ? UINT32_MAX : one->offset, 4);
    put_bytes(out, one->name, strlen(one->name));
    if (how->is_zip64) {
        put(out, 0x5455, 2); /* a time comes first */
        put(out, 1, 2);
        put(out, 0, 1);
        put(out, 1, 2);
        put(out, 28, 2);
        put(out, one->content.num, 8);
        put(out, one->compressed, 8);
        put(out, one->offset, 8);
        put(out, 0, 4);
    }
    put_bytes(out, "abc", 3);
}

static bytes make_archive(const style *how, member *members, size_t num) {
    bytes out = {malloc(2 * ROOM), 0};
    for (size_t i = 0; i < num; i++) {
        put_member(&out, how, &members[i]);
    }
    const size_t directory = out.num;
    for (size_t i = 0; i < num; i++) {
        put_entry(&out, how, &members[i]);
    }
    const size_t end = out.num;
    if (how->is_zip64) {
        put_bytes(&out, "PK\6\6", 4);
        put(&out, 44, 8);
        put(&out, 45 << 16 | 45, 4);
        put(&out, 0, 8);
        put(&out, num, 8);
        put(&out, num, 8);
        put(&out, end - directory, 8);
        put(&out, directory, 8);
        put_bytes(&out, "PK\6\7", 4);
        put(&out, 0, 4);
        put(&out, end, 8);
        put(&out, 1, 4);
    }
    put_bytes(&out, "PK\5\6", 4);
    put(&out, 0, 4);
    put(&out, how->is_zip64 ? UINT16_MAX : num, 2);
    put(&out, how->is_zip64 ? UINT16_MAX : num, 2);
    put(&out, how->is_zip64 ? UINT32_MAX : end - directory, 4);
    put(&out, how->is_zip64 ? UINT32_MAX : directory, 4);
    put(&out, how->comment != NULL ? strlen(how->comment) : 0, 2);
    put_bytes(&out, how->comment != NULL ? how->comment : "",
              how->comment != NULL ? strlen(how->comment) : 0);
    return out;
}

/* ---- arrays ------------------------------------------------------------------------------ */

static double value_of(size_t i) {
    return (double)(i * 2654435761U % 65536) / 65536;
}

/* NUM_POINTS points of the plane, in format 1.0. */
static bytes make_array(size_t num_points) {
    bytes out = {malloc(ROOM), 0};
    char header[128];
    const int length =
        snprintf(header, sizeof header,
                 "{'descr': '<f8', 'fortran_order': False, 'shape': (%zu, 2), }", num_points);
    put_bytes(&out, "\x93NUMPY\1\0", 8);
    put(&out, 118, 2);
    put_bytes(&out, header, (size_t)length);
    while (out.num < 127) {
        put(&out, ' ', 1);
    }
    put(&out, '\n', 1);
    for (size_t i = 0; i < 2 * num_points; i++) {
        const double value = value_of(i);
        put_bytes(&out, &value, sizeof value);
    }
    return out;
}

static void check_points(void **state, const bytes *archive, size_t num_points) {
    char path[TEST_PATH_BYTES];
    ps_error error = {0};
    for (size_t block = 0; block <= 999; block += 999) {
        test_points found = {0};
        assert_true(test_write_file(test_path(*state, "a.npz", path), archive->data, archive->num));
        if (test_points_read_blocks(&found, path, &(ps_point_options){0}, block, &error) !=
            PSPEC_OK) {
            fail_msg("%s", error.message);
        }
        assert_string_equal(found.format, "npy");
        assert_int_equal(found.num_points, num_points);
        for (size_t i = 0; i < 2 * num_points; i++) {
            assert_true(found.points[i] == value_of(i));
        }
        test_points_free(&found);
    }
}

static const style styles[] = {
    {.method = METHOD_STORED},
    {.method = METHOD_DEFLATED},
    {.method = METHOD_STORED, .is_zip64 = true},
    {.method = METHOD_DEFLATED, .is_zip64 = true, .comment = "PK\5\6 is not here"},
    {.method = METHOD_DEFLATED, .is_streamed = true, .comment = "x"},
};
enum { NUM_STYLES = sizeof styles / sizeof styles[0] };

static void reads_arrays(void **state) {
    bytes other = make_array(3);
    bytes points = make_array(NUM_POINTS);
    for (size_t i = 0; i < NUM_STYLES; i++) {
        member alone[] = {{.name = "arr_0.npy", .content = points}};
        member several[] = {{.name = "x.npy", .content = other},
                            {.name = "points.npy", .content = points},
                            {.name = "point.npy", .content = other}};
        bytes archive = make_archive(&styles[i], alone, 1);
        check_points(state, &archive, NUM_POINTS);
        free(archive.data);
        archive = make_archive(&styles[i], several, 3);
        check_points(state, &archive, NUM_POINTS);
        free(archive.data);
    }
    free(other.data);
    free(points.data);
}

/* The array "weights" of an archive with points, too. */
static void check_weights(void **state, bytes weights, const style *packed) {
    char path[TEST_PATH_BYTES];
    double *found = NULL;
    size_t num = 0;
    ps_error error = {0};
    bytes points = make_array(2);
    member members[] = {{.name = "points.npy", .content = points},
                        {.name = "weights.npy", .content = weights}};
    bytes archive = make_archive(packed, members, 2);
    assert_true(test_write_file(test_path(*state, "w.npz", path), archive.data, archive.num));
    assert_int_equal(ps_read_weights(path, 2, &found, &num, &error), PSPEC_OK);
    assert_int_equal(num, 2);
    assert_true(found[0] == 0.5 && found[1] == 2);
    free(found);
    free(archive.data);
    free(points.data);
}

/* As numpy.savez writes them, and as text that somebody put there. */
static void reads_weights(void **state) {
    static unsigned char text[] = "0.5\n2\n";
    static double values[] = {0.5, 2};
    const ps_npy_array weights = {1, {2}, 2, false, values};
    char path[TEST_PATH_BYTES];
    bytes array = {0};
    ps_error error = {0};
    assert_int_equal(ps_npy_write_array(test_path(*state, "w.npy", path), &weights, &error),
                     PSPEC_OK);
    array.data = (unsigned char *)test_read_file(path, &array.num);
    assert_non_null(array.data);
    for (size_t i = 0; i < sizeof styles / sizeof styles[0]; i++) {
        check_weights(state, array, &styles[i]);
    }
    check_weights(state, (bytes){text, sizeof text - 1}, &styles[1]);
    free(array.data);
}

/* ---- refusals ---------------------------------------------------------------------------- */

static void refuse(void **state, const bytes *archive, const char *part) {
    char path[TEST_PATH_BYTES];
    test_points found = {0};
    ps_error error = {0};
    assert_true(test_write_file(test_path(*state, "bad.npz", path), archive->data, archive->num));
    assert_int_equal(test_points_read(&found, path, &(ps_point_options){0}, &error),
                     PSPEC_ERROR_INPUT);
    if (strstr(error.message, part) == NULL || strstr(error.message, "bad.npz") == NULL) {
        fail_msg("not \"%s\": %s", part, error.message);
    }
    test_points_free(&found);
}

static void refuses_what_cannot_be_read(void **state) {
    bytes points = make_array(50);
    member two[] = {{.name = "a.npy", .content = points}, {.name = "b\33.npy", .content = points}};
    bytes archive = make_archive(&styles[0], two, 2);
    refuse(state, &archive, "holds several arrays (a.npy, b?.npy), none of them called \"points\"");
    free(archive.data);
    archive = make_archive(&(style){.method = METHOD_STORED, .flags = 1}, two, 1);
    refuse(state, &archive, "encrypted");
    free(archive.data);
    archive = make_archive(&(style){.method = 12}, two, 1);
    refuse(state, &archive, "compressed otherwise than by deflate");
    free(archive.data);
    free(points.data);
}

/* Every prefix, and every byte changed: an error or, where the byte says nothing, the same points;
 * never others. */
static void refuses_damage(void **state) {
    enum { FEW = 5, MOST = 600 };
    bytes points = make_array(FEW);
    for (size_t i = 0; i < NUM_STYLES; i++) {
        member one[] = {{.name = "points.npy", .content = points}};
        bytes archive = make_archive(&styles[i], one, 1);
        const size_t comment = styles[i].comment != NULL ? strlen(styles[i].comment) : 0;
        size_t num_refused = 0;
        for (size_t num = 4; num < archive.num - comment; num++) {
            const bytes prefix = {archive.data, num};
            refuse(state, &prefix, "");
        }
        for (size_t at = 4; at < archive.num; at++) {
            char path[TEST_PATH_BYTES];
            test_points found = {0};
            ps_error error = {0};
            archive.data[at] ^= 0x55;
            assert_true(
                test_write_file(test_path(*state, "a.npz", path), archive.data, archive.num));
            if (test_points_read(&found, path, &(ps_point_options){0}, &error) == PSPEC_OK) {
                assert_int_equal(found.num_points, FEW);
                for (size_t j = 0; j < 2 * (size_t)FEW; j++) {
                    assert_true(found.points[j] == value_of(j));
                }
            } else {
                assert_true(error.message[0] != '\0');
                num_refused++;
            }
            test_points_free(&found);
            archive.data[at] ^= 0x55;
        }
        assert_true(num_refused > points.num / 2);
        free(archive.data);
    }
    free(points.data);
}

#define TEST_IN_FOLDER(test)                                                                       \
    cmocka_unit_test_setup_teardown(test, test_folder_create, test_folder_remove)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST_IN_FOLDER(reads_arrays),
        TEST_IN_FOLDER(reads_weights),
        TEST_IN_FOLDER(refuses_what_cannot_be_read),
        TEST_IN_FOLDER(refuses_damage),
    };
    return cmocka_run_group_tests_name("zip", tests, NULL, NULL);
}
