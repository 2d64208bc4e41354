#include "store/checkpoint.h"

#include "base/clock.h"
#include "base/memory.h"
#include "files/output_file.h"
#include "files/packed/npz.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const char key_name[] = "checkpoint_key";

/* The first comes after so many seconds, and the next after a hundred times what it took, but no
 * sooner than that again: short jobs have none. */
static const double FIRST_SECONDS = 10;
static const double MOST_SHARE = 0.01;

struct ps_snapshot {
    ps_npz *to; /* NULL: it is read */
    const ps_npz_file *from;
};

struct ps_checkpoint {
    ps_text path, lock_path, key;
    uint64_t interval;
    ps_log log;
    int lock;
    ps_npz_file *file; /* that was there */
    ps_snapshot found;
    double begun, taken; /* clock at the last one, and seconds that it took */
    bool is_saved, has_failed;
    bool is_read_only; /* another member of the team writes it */
};

/* ---- state ----------------------------------------------------------------------------------- */

bool ps_snapshot_is_read(const ps_snapshot *snapshot) {
    return snapshot->to == NULL;
}

static pspec_status move(ps_snapshot *self, const char *name, char kind, size_t element_bytes,
                         void *data, size_t num, ps_error *error) {
    const ps_npz_array array = {name, kind, element_bytes, 1, &num, data};
    if (num == 0) {
        return PSPEC_OK;
    }
    if (self->to != NULL) {
        return ps_npz_add(self->to, &array, error);
    }
    const ps_npz_array *const found = ps_npz_find(self->from, name);
    if (found == NULL || found->kind != kind || found->rank != 1 || found->shape[0] != num) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is no checkpoint of this job: \"%s\" is %s",
                       ps_npz_name(self->from), name,
                       found == NULL ? "not there" : "of another size");
    }
    memcpy(data, found->data, num * element_bytes);
    return PSPEC_OK;
}

pspec_status ps_snapshot_doubles(ps_snapshot *snapshot, const char *name, double *data, size_t num,
                                 ps_error *error) {
    return move(snapshot, name, 'f', sizeof *data, data, num, error);
}

pspec_status ps_snapshot_gather(ps_snapshot *snapshot, const char *name, double *const *numbers,
                                size_t num, ps_error *error) {
    double all[PS_MOST_GATHERED] = {0};
    for (size_t i = 0; i < num; i++) {
        all[i] = *numbers[i];
    }
    PS_TRY(ps_snapshot_doubles(snapshot, name, all, num, error));
    for (size_t i = 0; i < num; i++) {
        *numbers[i] = all[i];
    }
    return PSPEC_OK;
}

pspec_status ps_snapshot_counts(ps_snapshot *snapshot, const char *name, uint64_t *data, size_t num,
                                ps_error *error) {
    return move(snapshot, name, 'i', sizeof *data, data, num, error);
}

pspec_status ps_snapshot_bytes(ps_snapshot *snapshot, const char *name, void *data, size_t num,
                               ps_error *error) {
    return move(snapshot, name, 'u', 1, data, num, error);
}

/* ---- the lock -------------------------------------------------------------------------------- */

/* Whoever held the lock before may have taken its name away: then it is no lock. */
static bool has_name(int descriptor, const char *path) {
    struct stat file;
    struct stat named;
    return fstat(descriptor, &file) == 0 && stat(path, &named) == 0 &&
           file.st_dev == named.st_dev && file.st_ino == named.st_ino;
}

static pspec_status take_lock(ps_checkpoint *self, ps_error *error) {
    enum { READABLE = 0644 };
    const char *const path = ps_text_string(&self->lock_path);
    do {
        if (self->lock >= 0) {
            close(self->lock);
        }
        self->lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, READABLE);
        if (self->lock < 0) {
            return ps_fail(error, PSPEC_ERROR_IO, "cannot write \"%s\": %s", path, strerror(errno));
        }
        if (flock(self->lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            return ps_fail(error, PSPEC_ERROR_INPUT, "\"%s\" is the checkpoint of a job that runs",
                           ps_text_string(&self->path));
        }
    } while (!has_name(self->lock, path));
    return PSPEC_OK;
}

/* ---- what is there --------------------------------------------------------------------------- */

/* Is that a line of the text? */
static bool has_line(const char *text, const char *line, size_t length) {
    while (*text != '\0' && (strncmp(text, line, length) != 0 || text[length] != '\n')) {
        text += strcspn(text, "\n");
        text += *text == '\n' ? 1 : 0;
    }
    return *text != '\0';
}

/* The first line of a that b does not have; "": there is none. */
static void add_missing(ps_text *out, const char *a, const char *b) {
    size_t length = 0;
    for (; *a != '\0'; a += length + 1) {
        length = strcspn(a, "\n");
        if (!has_line(b, a, length)) {
            ps_text_append_bytes(out, a, length);
            return;
        }
    }
}

/* Lines end in newlines. */
static pspec_status refuse(const ps_checkpoint *self, const char *key, ps_error *error) {
    const char *const own = ps_text_string(&self->key);
    ps_text theirs = {0};
    ps_text ours = {0};
    add_missing(&theirs, key, own);
    add_missing(&ours, own, key);
    ps_fail(error, PSPEC_ERROR_INPUT,
            "\"%s\" is the checkpoint of another job: it has \"%s\", and this one \"%s\"",
            ps_text_string(&self->path), ps_text_string(&theirs), ps_text_string(&ours));
    ps_text_free(&theirs);
    ps_text_free(&ours);
    return PSPEC_ERROR_INPUT;
}

/* Bytes that were not written here need not end in a newline. */
static pspec_status check_key(const ps_checkpoint *self, ps_error *error) {
    const ps_npz_array *const key = ps_npz_find(self->file, key_name);
    ps_text theirs = {0};
    if (key == NULL || key->kind != 'u' || key->rank != 1) {
        return ps_fail(error, PSPEC_ERROR_INPUT, "%s is no checkpoint", ps_npz_name(self->file));
    }
    ps_text_append_bytes(&theirs, key->data, key->shape[0]);
    ps_text_append(&theirs, "\n");
    pspec_status status = ps_text_check(&theirs, error);
    if (status == PSPEC_OK && (key->shape[0] != self->key.length ||
                               memcmp(key->data, self->key.data, self->key.length) != 0)) {
        status = refuse(self, ps_text_string(&theirs), error);
    }
    ps_text_free(&theirs);
    return status;
}

static pspec_status read_file(ps_checkpoint *self, ps_error *error) {
    const char *const path = ps_text_string(&self->path);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return errno == ENOENT ? PSPEC_OK
                               : ps_fail(error, PSPEC_ERROR_IO, "cannot read \"%s\": %s", path,
                                         strerror(errno));
    }
    const pspec_status status = ps_npz_read(&self->file, descriptor, path, PS_NPZ_LIMIT, error);
    close(descriptor);
    PS_TRY(status);
    PS_TRY(check_key(self, error));
    self->found.from = self->file;
    self->is_saved = true;
    return PSPEC_OK;
}

/* ---- open and close -------------------------------------------------------------------------- */

pspec_status ps_checkpoint_path(ps_text *out, const char *path, unsigned part, ps_error *error) {
    const char *const ending = ps_output_ending(path);
    ps_text_append_bytes(out, path, strlen(path) - strlen(ending)); /* which need not be of path */
    if (part > 0) {
        ps_text_append(out, "-%u", part + 1);
    }
    ps_text_append(out, "%s", ending);
    return ps_text_check(out, error);
}

static pspec_status begin(ps_checkpoint *self, const ps_checkpoint_spec *spec, const char *more,
                          ps_error *error) {
    PS_TRY(ps_checkpoint_path(&self->path, spec->path, spec->part, error));
    ps_text_append(&self->lock_path, "%s.lock", ps_text_string(&self->path));
    ps_text_append(&self->key, "%spart %u\n%s", spec->key, spec->part, more);
    PS_TRY(ps_text_check(&self->lock_path, error));
    PS_TRY(ps_text_check(&self->key, error));
    PS_TRY(self->is_read_only ? PSPEC_OK : take_lock(self, error));
    return read_file(self, error);
}

pspec_status ps_checkpoint_open(ps_checkpoint **out, const ps_checkpoint_spec *spec,
                                const char *more, ps_error *error) {
    ps_checkpoint *self = NULL;
    *out = NULL;
    PS_TRY(PS_NEW(&self, 1, "a checkpoint", error));
    self->lock = -1;
    self->interval = spec->interval;
    self->log = spec->log;
    self->is_read_only = !ps_team_is_led_here(spec->team);
    self->begun = ps_clock_seconds();
    const pspec_status status = begin(self, spec, more, error);
    if (status != PSPEC_OK) {
        ps_checkpoint_close(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_checkpoint_close(ps_checkpoint *checkpoint) {
    if (checkpoint == NULL) {
        return;
    }
    ps_npz_free(checkpoint->file);
    if (checkpoint->lock >= 0) {
        const char *const path = ps_text_string(&checkpoint->lock_path);
        if (has_name(checkpoint->lock, path)) {
            (void)unlink(path);
        }
        close(checkpoint->lock);
    }
    ps_text_free(&checkpoint->path);
    ps_text_free(&checkpoint->lock_path);
    ps_text_free(&checkpoint->key);
    free(checkpoint);
}

ps_snapshot *ps_checkpoint_found(ps_checkpoint *checkpoint) {
    return checkpoint->file != NULL ? &checkpoint->found : NULL;
}

void ps_checkpoint_forget(ps_checkpoint *checkpoint) {
    ps_npz_free(checkpoint->file);
    checkpoint->file = NULL;
}

void ps_checkpoint_remove(const char *path, unsigned first, unsigned num) {
    for (unsigned part = first; part < first + num; part++) {
        ps_text name = {0};
        if (ps_checkpoint_path(&name, path, part, NULL) == PSPEC_OK) {
            (void)unlink(ps_text_string(&name));
        }
        ps_text_free(&name);
    }
}

pspec_status ps_checkpoint_check_sets(uint64_t num, uint64_t wanted, ps_error *error) {
    return num == wanted
               ? PSPEC_OK
               : ps_fail(error, PSPEC_ERROR_INPUT,
                         "there are fewer sets than the %" PRIu64 " that the checkpoint has",
                         wanted);
}

/* ---- the next one ---------------------------------------------------------------------------- */

bool ps_checkpoint_is_due(const ps_checkpoint *checkpoint) {
    const double share = checkpoint->taken / MOST_SHARE;
    const double automatic = share > FIRST_SECONDS ? share : FIRST_SECONDS;
    const double interval =
        checkpoint->interval < UINT64_MAX ? (double)checkpoint->interval : automatic;
    return ps_clock_seconds() - checkpoint->begun >= interval;
}

/* *walked: what the walk itself came to, whose errors are not those of the file. */
static pspec_status write_file(const ps_checkpoint *self, ps_snapshot_walk *walk, void *payload,
                               pspec_status *walked, ps_error *error) {
    const ps_npz_array key = {key_name, 'u', 1, 1, &self->key.length, ps_text_string(&self->key)};
    ps_snapshot snapshot = {.to = NULL};
    PS_TRY(ps_npz_open(&snapshot.to, ps_text_string(&self->path), PS_NPZ_LIMIT, error));
    pspec_status status = ps_npz_add(snapshot.to, &key, error);
    if (status == PSPEC_OK) {
        status = *walked = walk(payload, &snapshot, error);
    }
    if (status != PSPEC_OK) {
        ps_npz_discard(&snapshot.to);
        return status;
    }
    return ps_npz_commit(&snapshot.to, error);
}

pspec_status ps_checkpoint_save(ps_checkpoint *checkpoint, ps_snapshot_walk *walk, void *payload,
                                ps_error *error) {
    const double begun = ps_clock_seconds();
    pspec_status walked = PSPEC_OK;
    ps_error reason = {0};
    if (checkpoint->is_read_only) {
        return PSPEC_OK;
    }
    const pspec_status status = write_file(checkpoint, walk, payload, &walked, &reason);
    checkpoint->begun = ps_clock_seconds();
    checkpoint->taken = checkpoint->begun - begun;
    checkpoint->is_saved = checkpoint->is_saved || status == PSPEC_OK;
    if (walked != PSPEC_OK && walked != PSPEC_ERROR_IO && walked != PSPEC_ERROR_MEMORY) {
        return ps_fail(error, walked, "%s", reason.message);
    }
    if (status != PSPEC_OK && !checkpoint->has_failed) {
        checkpoint->has_failed = true;
        ps_log_say(&checkpoint->log, "the checkpoint \"%s\" stays as it was: %s",
                   ps_text_string(&checkpoint->path), reason.message);
    }
    return PSPEC_OK;
}

pspec_status ps_checkpoint_keep(ps_checkpoint *checkpoint, bool is_complete, ps_snapshot_walk *walk,
                                void *payload, ps_error *error) {
    const bool is_last = is_complete && checkpoint != NULL && checkpoint->is_saved;
    return checkpoint != NULL && (is_last || ps_checkpoint_is_due(checkpoint))
               ? ps_checkpoint_save(checkpoint, walk, payload, error)
               : PSPEC_OK;
}

/* Engines say no more than that they were cancelled. */
static void name_realizations(ps_error *error, uint64_t num_done) {
    static const char reason[] = "interrupted";
    if (strncmp(error->message, reason, sizeof reason - 1) != 0) {
        ps_fail(error, PSPEC_ERROR_CANCELLED, "%s after %" PRIu64 " realizations", reason,
                num_done);
    }
}

pspec_status ps_checkpoint_keep_cancelled(ps_checkpoint *checkpoint, pspec_status status,
                                          uint64_t num_done, ps_snapshot_walk *walk, void *payload,
                                          ps_error *error) {
    ps_error none;
    if (status != PSPEC_ERROR_CANCELLED || checkpoint == NULL || error == NULL) {
        return status;
    }
    if (walk != NULL && ps_checkpoint_save(checkpoint, walk, payload, &none) != PSPEC_OK) {
        return status;
    }
    if (!checkpoint->is_saved) {
        return status;
    }
    name_realizations(error, num_done);
    const ps_error said = *error;
    return ps_fail(error, status, "%s; the same command goes on from \"%s\"", said.message,
                   ps_text_string(&checkpoint->path));
}
