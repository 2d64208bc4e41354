#define _DEFAULT_SOURCE /* MAP_PRIVATE */

/* Whether the kernels that PoCL keeps on disk are whole. A program is a folder below
 * POCL_CACHE_DIR, AB/CDEFGH...; it has the program as bitcode, and for each kernel that ran, and
 * each kind of work-group, a shared object: KERNEL/64-1-1-goffs0/KERNEL.so (3.1 to 7). */
#include "device/drivers.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

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

static bool is_whole(int file, bool (*judge)(const unsigned char *, size_t)) {
    struct stat facts;
    if (fstat(file, &facts) != 0 || facts.st_size <= 0) {
        return false;
    }
    const size_t num = (size_t)facts.st_size;
    void *const bytes = mmap(NULL, num, PROT_READ, MAP_PRIVATE, file, 0);
    const bool answer = bytes != MAP_FAILED && judge(bytes, num);
    if (bytes != MAP_FAILED) {
        munmap(bytes, num);
    }
    return answer;
}

/* What is not there is made. */
static pspec_status check_file(const char *path, bool (*judge)(const unsigned char *, size_t),
                               ps_error *error) {
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    const int reason = file < 0 ? errno : 0;
    const bool is_good = reason == ENOENT || (file >= 0 && is_whole(file, judge));
    if (file >= 0) {
        close(file);
    }
    return is_good ? PSPEC_OK
                   : ps_fail(error, PSPEC_ERROR_DEVICE,
                             "PoCL cannot take a kernel that it has kept: %s %s; remove that "
                             "file, or the folder of all, which PoCL fills again, or name another "
                             "by POCL_CACHE_DIR",
                             path, reason != 0 ? strerror(reason) : "is damaged");
}

/* ---- folders -------------------------------------------------------------------------------- */

/* The next name that does not begin with a dot; NULL: there is none. */
static const char *next_name(DIR *folder) {
    const struct dirent *found = NULL;
    do {
        found = readdir(folder);
    } while (found != NULL && found->d_name[0] == '.');
    return found != NULL ? found->d_name : NULL;
}

/* Adds what is in a folder, with a zero after each path. A folder that cannot be read is PoCL's
 * concern. */
static void add_names(const char *path, size_t letters, ps_text *out) {
    DIR *const folder = opendir(path);
    const char *name = NULL;
    while (folder != NULL && (name = next_name(folder)) != NULL) {
        if (letters == 0 || strlen(name) == letters) {
            ps_text_append(out, "%s/%s", path, name);
            ps_text_append_bytes(out, "", 1);
        }
    }
    if (folder != NULL) {
        closedir(folder);
    }
}

static const char *next_path(const ps_text *paths, const char *path) {
    const char *const next = path == NULL ? paths->data : path + strlen(path) + 1;
    return next != NULL && next < paths->data + paths->length ? next : NULL;
}

pspec_status ps_kept_programs(ps_text *out, ps_error *error) {
    enum { LETTERS = 2 }; /* other names are not PoCL's: somebody may keep kernels in a home */
    ps_text top = {0};
    ps_text groups = {0};
    pspec_status status = ps_drivers_pocl_cache(&top, error);
    if (status == PSPEC_OK && top.length > 0) {
        add_names(ps_text_string(&top), LETTERS, &groups);
        for (const char *path = NULL; (path = next_path(&groups, path)) != NULL;) {
            add_names(path, 0, out);
        }
        status = groups.failed ? ps_text_check(&groups, error) : ps_text_check(out, error);
    }
    ps_text_free(&top);
    ps_text_free(&groups);
    return status;
}

/* The folder of one kernel of a program. */
static pspec_status check_kernel(const char *path, ps_error *error) {
    const char *const name = strrchr(path, '/') + 1;
    ps_text folders = {0};
    ps_text file = {0};
    add_names(path, 0, &folders);
    pspec_status status = ps_text_check(&folders, error);
    if (folders.length > 0) {
        ps_text_append(&file, "%.*s/program.bc", (int)(name - 1 - path), path);
        status = check_file(ps_text_string(&file), is_whole_bitcode, error);
    }
    for (const char *folder = NULL;
         status == PSPEC_OK && (folder = next_path(&folders, folder)) != NULL;) {
        ps_text_free(&file);
        ps_text_append(&file, "%s/%s.so", folder, name);
        status = check_file(ps_text_string(&file), is_whole_object, error);
    }
    ps_text_free(&folders);
    ps_text_free(&file);
    return status;
}

pspec_status ps_kept_check(const ps_text *programs, const char *kernel, ps_error *error) {
    pspec_status status = PSPEC_OK;
    for (const char *program = NULL;
         status == PSPEC_OK && (program = next_path(programs, program)) != NULL;) {
        ps_text kernels = {0};
        if (kernel != NULL) {
            ps_text_append(&kernels, "%s/%s", program, kernel);
            ps_text_append_bytes(&kernels, "", 1);
        } else {
            add_names(program, 0, &kernels);
        }
        status = ps_text_check(&kernels, error);
        for (const char *path = NULL;
             status == PSPEC_OK && (path = next_path(&kernels, path)) != NULL;) {
            status = check_kernel(path, error);
        }
        ps_text_free(&kernels);
    }
    return status;
}
