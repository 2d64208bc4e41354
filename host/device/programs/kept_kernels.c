#define _GNU_SOURCE /* statx, memrchr */

/* Whether the kernels that PoCL keeps on disk are whole. A program is a folder below
 * POCL_CACHE_DIR, AB/CDEFGH...; it has the program as bitcode, and for each kernel that ran, and
 * each kind of work-group, a shared object: KERNEL/64-1-1-goffs0/KERNEL.so (3.1 to 7). Which
 * program is meant PoCL tells nobody, so that all that have a kernel of that name are looked at.
 * The look is a courtesy: what it cannot see it lets pass. */
#include "device/drivers.h"

#include <fcntl.h>
#include <fts.h>
#include <link.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_BYTES = 2048 }; /* PoCL has 1024, of which names below its folder take some 200 */

/* ---- one file ------------------------------------------------------------------------------- */

/* Linkers write the table of sections last, and the texts of their names are one of them. */
static bool is_whole_object(const unsigned char *bytes, size_t num) {
    ElfW(Ehdr) head;
    ElfW(Shdr) names;
    if (num < sizeof head || memcmp(bytes, ELFMAG, SELFMAG) != 0) {
        return false;
    }
    memcpy(&head, bytes, sizeof head);
    if (head.e_shoff > num || (num - head.e_shoff) / sizeof names < head.e_shnum ||
        head.e_shstrndx >= head.e_shnum) {
        return false;
    }
    memcpy(&names, bytes + head.e_shoff + head.e_shstrndx * sizeof names, sizeof names);
    return names.sh_type == SHT_STRTAB;
}

/* A row of blocks, each of which begins with two words, the second its length in words. */
static bool is_whole_bitcode(const unsigned char *bytes, size_t num) {
    static const unsigned char magic[] = {'B', 'C', 0xC0, 0xDE};
    enum { BEGINS_BLOCK = 1, ABBREVIATION = 3 /* the bits of it */ };
    uint32_t words[2];
    size_t at = sizeof magic;
    if (num < sizeof magic || memcmp(bytes, magic, sizeof magic) != 0) {
        return false;
    }
    while (at < num && num - at >= sizeof words) {
        memcpy(words, bytes + at, sizeof words);
        if ((words[0] & ABBREVIATION) != BEGINS_BLOCK) {
            return false;
        }
        at += sizeof words + sizeof words[0] * (size_t)words[1];
    }
    return at == num && at > sizeof magic;
}

static bool is_whole(const char *path, bool (*judge)(const unsigned char *, size_t)) {
    struct stat facts = {.st_size = 1};
    void *bytes = MAP_FAILED;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file >= 0 && fstat(file, &facts) == 0 && facts.st_size > 0) {
        bytes = mmap(NULL, (size_t)facts.st_size, PROT_READ, MAP_PRIVATE, file, 0);
    }
    bool answer = facts.st_size > 0;
    if (bytes != MAP_FAILED) {
        answer = judge(bytes, (size_t)facts.st_size);
        munmap(bytes, (size_t)facts.st_size);
    }
    if (file >= 0) {
        close(file);
    }
    return answer;
}

/* PoCL writes a file elsewhere and moves it into its folder, which is thus changed last. What was
 * changed after that, or is empty, is worth reading. In a copy of all (cp -r) a folder comes first:
 * its file was up to 11 ms younger. */
static bool is_suspect(const char *path) {
    static const double copied_seconds = 0.03;
    struct statx file;
    struct statx moved;
    char folder[PATH_BYTES];
    snprintf(folder, sizeof folder, "%.*s", (int)(strrchr(path, '/') - path), path);
    if (statx(AT_FDCWD, path, 0, STATX_MTIME | STATX_SIZE, &file) != 0 ||
        statx(AT_FDCWD, folder, 0, STATX_MTIME, &moved) != 0) {
        return false;
    }
    const double seconds = (double)(file.stx_mtime.tv_sec - moved.stx_mtime.tv_sec) +
                           1e-9 * ((double)file.stx_mtime.tv_nsec - moved.stx_mtime.tv_nsec);
    return file.stx_size == 0 || seconds > copied_seconds;
}

static pspec_status check_file(const char *path, ps_error *error) {
    const bool is_object = strcmp(strrchr(path, '.'), ".so") == 0;
    return !is_suspect(path) || is_whole(path, is_object ? is_whole_object : is_whole_bitcode)
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_DEVICE,
                         "PoCL cannot take a kernel that it has kept: %s is damaged; remove that "
                         "file, or the folder of all, which PoCL fills again, or name another by "
                         "POCL_CACHE_DIR",
                         path);
}

/* ---- folders -------------------------------------------------------------------------------- */

pspec_status ps_kept_list(glob_t *out, ps_error *error) {
    char pattern[PATH_BYTES];
    ps_text top = {0};
    *out = (glob_t){0};
    const pspec_status status = ps_drivers_pocl_cache(&top, error);
    if (status == PSPEC_OK && top.length > 0) {
        snprintf(pattern, sizeof pattern, "%s/[A-P][A-P]/*/*/", ps_text_string(&top));
        if (glob(pattern, GLOB_NOSORT, NULL, out) != 0) {
            globfree(out);
            *out = (glob_t){0};
        }
    }
    ps_text_free(&top);
    return status;
}

/* Of one kernel of a program: path ends in a slash. */
static pspec_status check_kernel(const char *path, ps_error *error) {
    char program[PATH_BYTES];
    char folder[PATH_BYTES];
    const char *const end = memrchr(path, '/', strlen(path) - 1);
    snprintf(program, sizeof program, "%.*s/program.bc", (int)(end - path), path);
    PS_TRY(check_file(program, error));
    snprintf(folder, sizeof folder, "%.*s", (int)strlen(path) - 1, path);
    FTS *const walk = fts_open((char *[]){folder, NULL}, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    FTSENT *entry = walk != NULL ? fts_read(walk) : NULL;
    pspec_status status = PSPEC_OK;
    for (; entry != NULL && status == PSPEC_OK; entry = fts_read(walk)) {
        const bool is_object = entry->fts_info == FTS_F && entry->fts_namelen > 3 &&
                               strcmp(entry->fts_name + entry->fts_namelen - 3, ".so") == 0;
        status = is_object ? check_file(entry->fts_path, error) : PSPEC_OK;
    }
    if (walk != NULL) {
        fts_close(walk);
    }
    return status;
}

/* Whether the last folder of path, which ends in a slash, has that name. */
static bool is_of(const char *path, const char *kernel) {
    const size_t rest = strlen(path) - 1;
    const size_t length = strlen(kernel);
    return rest > length && path[rest - length - 1] == '/' &&
           strncmp(path + rest - length, kernel, length) == 0;
}

pspec_status ps_kept_check(const glob_t *kept, const char *kernel, ps_error *error) {
    for (size_t i = 0; i < kept->gl_pathc; i++) {
        if (kernel == NULL || is_of(kept->gl_pathv[i], kernel)) {
            PS_TRY(check_kernel(kept->gl_pathv[i], error));
        }
    }
    return PSPEC_OK;
}
