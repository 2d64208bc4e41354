/* A folder for the files of one test, removed with all of them at the end. */
#ifndef TEST_FOLDER_H
#define TEST_FOLDER_H

#include <dirent.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TEST_PATH_BYTES = 512 };

typedef struct test_folder {
    char path[64];
} test_folder;

static inline int test_folder_create(void **state) {
    test_folder *const folder = calloc(1, sizeof *folder);
    if (folder == NULL) {
        return -1;
    }
    strcpy(folder->path, "/tmp/pointspec-test-XXXXXX");
    *state = folder;
    return mkdtemp(folder->path) != NULL ? 0 : -1;
}

/* "FOLDER/NAME", in a buffer of the caller. */
static inline const char *test_path(const test_folder *folder, const char *name,
                                    char path[TEST_PATH_BYTES]) {
    snprintf(path, TEST_PATH_BYTES, "%s/%s", folder->path, name);
    return path;
}

/* Number of files; with remove, they are gone afterwards. */
static inline size_t test_folder_count(const test_folder *folder, bool remove_files) {
    size_t count = 0;
    DIR *const entries = opendir(folder->path);
    const struct dirent *entry = NULL;
    while (entries != NULL && (entry = readdir(entries)) != NULL) {
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
            char path[TEST_PATH_BYTES];
            count++;
            if (remove_files) {
                remove(test_path(folder, entry->d_name, path));
            }
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
    return count;
}

static inline int test_folder_remove(void **state) {
    test_folder *const folder = *state;
    test_folder_count(folder, true);
    rmdir(folder->path);
    free(folder);
    return 0;
}

static inline bool test_write_file(const char *path, const void *bytes, size_t num_bytes) {
    FILE *const stream = fopen(path, "wb");
    if (stream == NULL) {
        return false;
    }
    const bool is_written = fwrite(bytes, 1, num_bytes, stream) == num_bytes;
    return fclose(stream) == 0 && is_written;
}

/* Writes an NPY array: type as "<f8", order "True" for Fortran's, shape as "(7, 7)". */
static inline bool test_write_array(const char *path, const char *type, const char *order,
                                    const char *shape, const void *data, size_t num_bytes) {
    char text[118];
    FILE *const stream = fopen(path, "wb");
    if (stream == NULL) {
        return false;
    }
    memset(text, ' ', sizeof text);
    const int length = snprintf(text, sizeof text,
                                "{'descr': '%s', 'fortran_order': %s, "
                                "'shape': %s, }",
                                type, order, shape);
    text[length] = ' ';
    text[sizeof text - 1] = '\n';
    const bool is_written = fwrite("\x93NUMPY\x01\x00\x76\x00", 1, 10, stream) == 10 &&
                            fwrite(text, 1, sizeof text, stream) == sizeof text &&
                            fwrite(data, 1, num_bytes, stream) == num_bytes;
    return fclose(stream) == 0 && is_written;
}

/* The whole file with a NUL after it; NULL when it cannot be read. The caller frees it. */
static inline char *test_read_file(const char *path, size_t *num_bytes) {
    enum { STEP = 1 << 16 };
    FILE *const stream = fopen(path, "rb");
    char *bytes = NULL;
    size_t count = 0;
    size_t got = 1;
    while (stream != NULL && got > 0) {
        char *const grown = realloc(bytes, count + STEP + 1);
        if (grown == NULL) {
            break;
        }
        bytes = grown;
        got = fread(bytes + count, 1, STEP, stream);
        count += got;
        bytes[count] = '\0';
    }
    if (stream != NULL) {
        fclose(stream);
    }
    if (num_bytes != NULL) {
        *num_bytes = count;
    }
    return bytes;
}

#endif
