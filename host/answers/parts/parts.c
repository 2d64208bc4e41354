/* Which parts a job has. */
#include "answers/parts/parts.h"

#include "files/output_file.h"
#include "spectra/sum_nodes.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

/* ---- ranges ---------------------------------------------------------------------------------- */

ps_dealt ps_parts_deal(uint64_t num_things, uint64_t num_takers, uint64_t taker) {
    const uint64_t each = num_things / num_takers;
    const uint64_t more = num_things % num_takers; /* takers that have one more */
    return (ps_dealt){taker * each + (taker < more ? taker : more), each + (taker < more)};
}

uint64_t ps_parts_most(uint64_t num_realizations) {
    return num_realizations / PS_SUM_BLOCK + (num_realizations % PS_SUM_BLOCK > 0);
}

ps_realization_range ps_parts_range(uint64_t num_realizations, uint64_t num_parts, uint64_t part) {
    const ps_dealt blocks = ps_parts_deal(ps_parts_most(num_realizations), num_parts, part);
    const uint64_t end = (blocks.first + blocks.num) * PS_SUM_BLOCK;
    return (ps_realization_range){blocks.first * PS_SUM_BLOCK,
                                  end < num_realizations ? end : num_realizations};
}

/* ---- checkpoints that are there -------------------------------------------------------------- */

/* Is *at that word? It is behind it then. */
static bool take_word(const char **at, const char *word, size_t length) {
    const bool is_there = strncmp(*at, word, length) == 0;
    *at += is_there ? length : 0;
    return is_there;
}

/* The same of a word and a number, from 1, of few digits. */
static bool take_number(const char **at, const char *word, uint64_t *out) {
    enum { MOST_DIGITS = 9 };
    const char *digits = *at;
    uint64_t number = 0;
    if (!take_word(&digits, word, strlen(word)) || *digits < '1' || *digits > '9') {
        return false;
    }
    const char *end = digits;
    for (; *end >= '0' && *end <= '9' && end - digits < MOST_DIGITS; end++) {
        number = 10 * number + (uint64_t)(*end - '0');
    }
    *at = end;
    *out = number;
    return true;
}

/* Of which number of parts a file is the checkpoint of one, or its lock; 0: it is none. Each
 * question of a part has one. */
static uint64_t find_num_parts(const char *file, const char *name) {
    const char *const ending = ps_output_ending(name);
    const char *at = file;
    uint64_t part = 0;
    uint64_t num_parts = 0;
    uint64_t question = 0;
    if (!take_word(&at, name, strlen(name) - strlen(ending)) ||
        !take_number(&at, "-part-", &part) || !take_number(&at, "-of-", &num_parts) ||
        part > num_parts) {
        return 0;
    }
    (void)take_number(&at, "-", &question);
    return take_word(&at, ending, strlen(ending)) && (*at == '\0' || strcmp(at, ".lock") == 0)
               ? num_parts
               : 0;
}

static pspec_status fail_folder(const char *path, int reason, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_IO, "cannot read the folder of the checkpoint \"%s\": %s",
                   path, strerror(reason));
}

static pspec_status look_into(uint64_t *num_parts, DIR *folder, const char *path, const char *name,
                              ps_error *error) {
    errno = 0;
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        const uint64_t found = find_num_parts(entry->d_name, name);
        if (found > 0 && *num_parts > 0 && found != *num_parts) {
            return ps_fail(error, PSPEC_ERROR_INPUT,
                           "there are checkpoints \"%s\" of a job of %llu part%s, and of one of "
                           "%llu parts: one of them has to be removed",
                           path, (unsigned long long)*num_parts, *num_parts == 1 ? "" : "s",
                           (unsigned long long)found);
        }
        *num_parts = found > 0 ? found : *num_parts;
    }
    return errno == 0 ? PSPEC_OK
                      : fail_folder(path, errno, error); /* readdir leaves it alone at the end */
}

pspec_status ps_parts_find(uint64_t *num_parts, const char *path, ps_error *error) {
    const char *const slash = strrchr(path, '/');
    const char *const name = slash != NULL ? slash + 1 : path;
    ps_text place = {0};
    *num_parts = access(path, F_OK) == 0;
    ps_text_append_bytes(&place, path, (size_t)(name - path));
    ps_text_append(&place, "."); /* that of "" is the folder of the process */
    const pspec_status named = ps_text_check(&place, error);
    DIR *const folder = named == PSPEC_OK ? opendir(ps_text_string(&place)) : NULL;
    const int reason = errno;
    ps_text_free(&place);
    PS_TRY(named);
    if (folder == NULL) { /* where there is none to look into, the first checkpoint fails, too */
        return reason == ENOENT || reason == ENOTDIR || reason == EACCES
                   ? PSPEC_OK
                   : fail_folder(path, reason, error);
    }
    const pspec_status status = look_into(num_parts, folder, path, name, error);
    closedir(folder);
    return status;
}
