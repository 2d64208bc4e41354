#include "base/process/proc_files.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- lines --------------------------------------------------------------------------------- */

enum { BUFFER_BYTES = 4096 };

/* Lines of a file; of those that are longer than the buffer only the beginning. */
typedef struct reader {
    int descriptor;
    char buffer[BUFFER_BYTES + 1];
    size_t begin, end; /* bytes that are not yet taken */
    bool is_inside;    /* of a line whose beginning was taken */
} reader;

bool ps_proc_join(char path[PS_PROC_PATH], const char *folder, const char *name) {
    const int length = snprintf(path, PS_PROC_PATH, "%s%s", folder, name);
    return length >= 0 && length < PS_PROC_PATH;
}

static bool open_file(reader *in, const char *root, const char *name) {
    char path[PS_PROC_PATH];
    in->begin = in->end = 0;
    in->is_inside = false;
    in->descriptor =
        ps_proc_join(path, root, name) ? open(path, O_RDONLY | O_NOCTTY | O_CLOEXEC) : -1;
    return in->descriptor >= 0;
}

static void fill(reader *in) {
    memmove(in->buffer, in->buffer + in->begin, in->end - in->begin);
    in->end -= in->begin;
    in->begin = 0;
    ssize_t count = 1;
    while (in->end < BUFFER_BYTES && count > 0 && memchr(in->buffer, '\n', in->end) == NULL) {
        count = read(in->descriptor, in->buffer + in->end, BUFFER_BYTES - in->end);
        in->end += count > 0 ? (size_t)count : 0;
    }
}

/* Takes what is there up to the next end of a line, which it cuts off; *is_whole: there was one. */
static char *take_line(reader *in, bool *is_whole) {
    char *const line = in->buffer + in->begin;
    char *const newline = memchr(line, '\n', in->end - in->begin);
    *is_whole = newline != NULL;
    if (newline == NULL) {
        in->buffer[in->end] = '\0';
        in->begin = in->end;
    } else {
        *newline = '\0';
        in->begin = (size_t)(newline - in->buffer) + 1;
    }
    return line;
}

/* The next line without its end, NULL at the end of the file; valid until the next call. */
static char *next_line(reader *in) {
    bool is_whole = false;
    do { /* the rest of a line that was too long */
        if (memchr(in->buffer + in->begin, '\n', in->end - in->begin) == NULL) {
            fill(in);
        }
        if (in->begin == in->end) {
            return NULL;
        }
        const bool is_rest = in->is_inside;
        char *const line = take_line(in, &is_whole);
        in->is_inside = !is_whole;
        if (!is_rest) {
            return line;
        }
    } while (true);
}

/* ---- numbers ------------------------------------------------------------------------------- */

static bool parse_number(const char *text, uint64_t *out) {
    char *end = NULL;
    text += strspn(text, " \t");
    if (*text < '0' || *text > '9') { /* strtoull would take a minus */
        return false;
    }
    const unsigned long long number = strtoull(text, &end, 10);
    if (*end != '\0' && *end != ' ' && *end != '\t') {
        return false;
    }
    *out = number;
    return true;
}

bool ps_proc_entry(const char *root, const char *name, const char *key, uint64_t *out) {
    reader in;
    bool is_found = false;
    const size_t length = strlen(key);
    if (!open_file(&in, root, name)) {
        return false;
    }
    for (const char *line; !is_found && (line = next_line(&in)) != NULL;) {
        is_found = strncmp(line, key, length) == 0 && parse_number(line + length, out) &&
                   (length == 0 || line[length] == ' ' || line[length] == '\t');
    }
    close(in.descriptor);
    return is_found;
}

bool ps_proc_text(const char *name, const char *key, char *out, size_t size) {
    reader in;
    bool is_found = false;
    const size_t length = strlen(key);
    if (!open_file(&in, "", name)) {
        return false;
    }
    for (const char *line; !is_found && (line = next_line(&in)) != NULL;) {
        is_found = strncmp(line, key, length) == 0;
        if (is_found) {
            snprintf(out, size, "%s", line + length + strspn(line + length, " \t:"));
        }
    }
    close(in.descriptor);
    return is_found;
}

bool ps_proc_number(const char *root, const char *name, uint64_t *out) {
    return ps_proc_column(root, name, 0, out);
}

bool ps_proc_column(const char *root, const char *name, unsigned column, uint64_t *out) {
    reader in;
    if (!open_file(&in, root, name)) {
        return false;
    }
    const char *word = next_line(&in);
    for (unsigned i = 0; word != NULL && i < column; i++) {
        word = strchr(word, ' ');
        word += word != NULL;
    }
    const bool is_number = word != NULL && parse_number(word, out);
    close(in.descriptor);
    return is_number;
}

/* ---- cgroups ------------------------------------------------------------------------------- */

/* Is word one of a list that commas separate? */
static bool has_word(const char *list, const char *word) {
    const size_t length = strlen(word);
    while (*list != '\0') {
        const size_t here = strcspn(list, ",");
        if (here == length && strncmp(list, word, length) == 0) {
            return true;
        }
        list += here + (list[here] == ',');
    }
    return false;
}

/* "9:memory:/group", or "0::/group" of version 2. */
static bool find_path(const char *root, bool is_second, char path[PS_PROC_PATH]) {
    reader in;
    bool is_found = false;
    if (!open_file(&in, root, "/proc/self/cgroup")) {
        return false;
    }
    for (char *line; !is_found && (line = next_line(&in)) != NULL;) {
        char *const controllers = strchr(line, ':');
        char *const group = controllers != NULL ? strchr(controllers + 1, ':') : NULL;
        if (group != NULL && group[1] == '/') {
            *group = '\0';
            is_found =
                (is_second ? strcmp(line, "0:") == 0 : has_word(controllers + 1, "memory")) &&
                ps_proc_join(path, group + 1, "");
        }
    }
    close(in.descriptor);
    return is_found;
}

/* Blanks and backslashes of names stand there as three octal digits. */
static void decode(char *name) {
    char *out = name;
    for (const char *in = name; *in != '\0'; out++) {
        const bool is_octal = in[0] == '\\' && strspn(in + 1, "01234567") >= 3;
        *out = is_octal ? (char)((in[1] - '0') * 64 + (in[2] - '0') * 8 + (in[3] - '0')) : *in;
        in += is_octal ? 4 : 1;
    }
    *out = '\0';
}

/* "36 35 98:0 /root /mounted rw,noatime shared:1 - cgroup cgroup rw,memory": false for other
 * mounts. */
static bool parse_mount(char *line, bool is_second, char **mount_root, char **mounted) {
    enum { FIRST_WORDS = 5 };
    char *words[FIRST_WORDS];
    char *const type = strstr(line, " - ");
    if (type == NULL) {
        return false;
    }
    const char *const options = strrchr(type, ' ') + 1;
    const bool is_ours = is_second ? strncmp(type, " - cgroup2 ", strlen(" - cgroup2 ")) == 0
                                   : strncmp(type, " - cgroup ", strlen(" - cgroup ")) == 0 &&
                                         has_word(options, "memory");
    *type = '\0';
    for (int i = 0; is_ours && i < FIRST_WORDS; i++) {
        words[i] = line;
        line = strchr(line, ' ');
        if (line == NULL) {
            return false;
        }
        *line++ = '\0';
    }
    if (is_ours) {
        *mount_root = words[FIRST_WORDS - 2];
        *mounted = words[FIRST_WORDS - 1];
        decode(*mount_root);
        decode(*mounted);
    }
    return is_ours;
}

/* The part of a group's path below the root of a mount; a container may see a group from outside,
 * and then its mount is the group. */
static const char *below(const char *path, const char *mount_root) {
    const size_t length = strcmp(mount_root, "/") == 0 ? 0 : strlen(mount_root);
    const bool is_below = strncmp(path, mount_root, length) == 0 &&
                          (path[length] == '/' || path[length] == '\0') &&
                          strncmp(path, "/..", strlen("/..")) != 0;
    const char *const rest = is_below ? path + length : "";
    return strcmp(rest, "/") == 0 ? "" : rest;
}

bool ps_proc_cgroup(const char *root, bool is_second, char group[PS_PROC_PATH], size_t *mounted) {
    reader in;
    char path[PS_PROC_PATH];
    bool is_found = false;
    if (!find_path(root, is_second, path) || !open_file(&in, root, "/proc/self/mountinfo")) {
        return false;
    }
    for (char *line; !is_found && (line = next_line(&in)) != NULL;) {
        char *mount_root = NULL;
        char *folder = NULL;
        if (parse_mount(line, is_second, &mount_root, &folder)) {
            *mounted = strlen(folder);
            is_found = ps_proc_join(group, folder, below(path, mount_root));
        }
    }
    close(in.descriptor);
    return is_found;
}
