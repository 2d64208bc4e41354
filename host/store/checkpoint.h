/* A job that averages realizations, on the disk, from where it goes on after it was killed.
 *
 * A checkpoint is an NPZ file (files/packed/npz.h) with a key, "checkpoint_key", which says what
 * the job is, and the state of the job as arrays. It appears under its name only when it is
 * complete and on the disk, so that there is a good one whenever the process ends. One job at a
 * time has the lock beside it, PATH.lock. Where one cannot be written (a full disk, a folder that
 * is gone) that is said once, the job goes on, and the last good one stays.
 */
#ifndef PS_STORE_CHECKPOINT_H
#define PS_STORE_CHECKPOINT_H

#include "base/log.h"
#include "base/process/team.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- state ----------------------------------------------------------------------------------- */

/* State on its way to a file or from one: who has state walks through it once, for both. */
typedef struct ps_snapshot ps_snapshot;

/* Is the state read, rather than written? */
bool ps_snapshot_is_read(const ps_snapshot *snapshot);
/* Numbers under a name that no others have. Read numbers that are not there, or not so many, are
 * PSPEC_ERROR_INPUT. */
pspec_status ps_snapshot_doubles(ps_snapshot *snapshot, const char *name, double *data, size_t num,
                                 ps_error *error) PS_MUST_CHECK;
/* The same of numbers that lie apart, PS_MOST_GATHERED at most. */
enum { PS_MOST_GATHERED = 8 };
pspec_status ps_snapshot_gather(ps_snapshot *snapshot, const char *name, double *const *numbers,
                                size_t num, ps_error *error) PS_MUST_CHECK;
pspec_status ps_snapshot_counts(ps_snapshot *snapshot, const char *name, uint64_t *data, size_t num,
                                ps_error *error) PS_MUST_CHECK;
/* What is neither, by a machine of the same kind. */
pspec_status ps_snapshot_bytes(ps_snapshot *snapshot, const char *name, void *data, size_t num,
                               ps_error *error) PS_MUST_CHECK;

typedef pspec_status ps_snapshot_walk(void *payload, ps_snapshot *snapshot, ps_error *error);

/* ---- the file -------------------------------------------------------------------------------- */

/* What is asked for. Texts are borrowed. */
typedef struct ps_checkpoint_spec {
    const char *path;   /* NULL: there is none */
    unsigned part;      /* of several jobs of a command, each with a file: PATH, PATH-2, .. */
    unsigned num_parts; /* of the command; 0: not known yet */
    const char *key;    /* lines of "what value" that jobs of the same bits have alike */
    uint64_t interval;  /* seconds between two; UINT64_MAX: at most a hundredth of the time */
    ps_log log;         /* hears of what went wrong */
    /* Who does the job together: each reads what is there, and the first writes. NULL: nobody else
     */
    const ps_team *team;
    struct ps_row_tape *tape; /* what keeps or gives rows (spectra/row_tape.h); NULL: nothing */
} ps_checkpoint_spec;

typedef struct ps_checkpoint ps_checkpoint;

/* The file of a part: its number stands before the ending. */
pspec_status ps_checkpoint_path(ps_text *out, const char *path, unsigned part,
                                ps_error *error) PS_MUST_CHECK;

/* Takes the lock, and reads what is there. more: lines of the key that only the job knows. A
 * checkpoint of another job, one that is damaged, or in use, is PSPEC_ERROR_INPUT. */
pspec_status ps_checkpoint_open(ps_checkpoint **out, const ps_checkpoint_spec *spec,
                                const char *more, ps_error *error) PS_MUST_CHECK;
void ps_checkpoint_close(ps_checkpoint *checkpoint); /* NULL is allowed */

/* The state that was there, to be walked through; NULL: the job begins. */
ps_snapshot *ps_checkpoint_found(ps_checkpoint *checkpoint);
/* Gives its memory back. */
void ps_checkpoint_forget(ps_checkpoint *checkpoint);

/* Is it time for the next one? */
bool ps_checkpoint_is_due(const ps_checkpoint *checkpoint);
/* Writes one in place of the last. An error is one of the walk, and no fault of the file. */
pspec_status ps_checkpoint_save(ps_checkpoint *checkpoint, ps_snapshot_walk *walk, void *payload,
                                ps_error *error) PS_MUST_CHECK;
/* For jobs between two realizations: writes one where it is time, and where all are done and there
 * is one already, whose job need not do them again. */
pspec_status ps_checkpoint_keep(ps_checkpoint *checkpoint, bool is_complete, ps_snapshot_walk *walk,
                                void *payload, ps_error *error) PS_MUST_CHECK;
/* Where a job was cancelled after so many realizations: writes one, whatever the time, and says so
 * in the error. walk NULL: the job is in the middle of one, and keeps the last. Returns status. */
pspec_status ps_checkpoint_keep_cancelled(ps_checkpoint *checkpoint, pspec_status status,
                                          uint64_t num_done, ps_snapshot_walk *walk, void *payload,
                                          ps_error *error);

/* Sets that a checkpoint has are left out where its job goes on: PSPEC_ERROR_INPUT where there were
 * fewer to leave out. */
pspec_status ps_checkpoint_check_sets(uint64_t num, uint64_t wanted, ps_error *error) PS_MUST_CHECK;

/* Removes the files of so many parts from one on, whose answer is written. */
void ps_checkpoint_remove(const char *path, unsigned first, unsigned num);

#endif
