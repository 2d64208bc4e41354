#include "sets/files_ahead.h"

#include "base/memory.h"
#include "base/workers.h"
#include "sets/ahead.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

/* Sets that are ahead take so many bytes, or the share of a limit that was typed that those of
 * samplers take (sets.c). */
enum { ROOM_BYTES = 1 << 27, SHARE_OF_LIMIT = 16 };

/* A file is handed over in 50 us, in which one with less is opened and read (two cores of an EPYC,
 * 2026-11); where a process may have fewer files open than this, the driver needs them. */
enum { LEAST_BYTES = 1 << 16, LEAST_DESCRIPTORS = 256 };

/* Read first, to learn how much memory a point takes. */
enum { FIRST_POINTS = 1024 };

/* reader NULL: the file was left alone, or was taken. */
typedef struct begun_file {
    ps_point_reader *reader;
    ps_point_set set;
    bool ends;
} begun_file;

struct ps_files_ahead {
    ps_files_plan plan;
    ps_point_options options;
    ps_ahead *ahead;
    size_t num_waited; /* files that were waited for */
    unsigned num_slots;
    unsigned parsers;  /* threads that read a file: the files share the processors */
    begun_file *begun; /* [num_slots] */
};

/* ---- sets ------------------------------------------------------------------------------------ */

size_t ps_points_fitting(const ps_point_set *set, uint64_t bytes) {
    const size_t columns = set->dimension + (set->has_weights ? 1 : 0);
    const size_t num = (size_t)(bytes / (columns * sizeof(double)));
    return num > FIRST_POINTS ? num : FIRST_POINTS;
}

pspec_status ps_points_read_on(ps_point_reader *reader, ps_point_set *set, size_t max_points,
                               bool *ends, const ps_watch *watch, ps_error *error) {
    const size_t before = set->num_points;
    bool has_block = true;
    *ends = false;
    while (has_block && !*ends && set->num_points - before < max_points) {
        PS_TRY(ps_watch_tell(watch, "points", set->num_points, 0, NULL, error));
        PS_TRY(ps_points_next_block(reader, set, max_points - (set->num_points - before),
                                    &has_block, ends, error));
    }
    *ends = *ends || !has_block;
    return PSPEC_OK;
}

pspec_status ps_points_fill(ps_point_reader *reader, ps_point_set *set, uint64_t bytes, bool *ends,
                            const ps_watch *watch, ps_error *error) {
    *ends = false;
    if (set->num_points < FIRST_POINTS) {
        PS_TRY(ps_points_read_on(reader, set, FIRST_POINTS - set->num_points, ends, watch, error));
    }
    const size_t most = *ends ? 0 : ps_points_fitting(set, bytes);
    return set->num_points >= most
               ? PSPEC_OK
               : ps_points_read_on(reader, set, most - set->num_points, ends, watch, error);
}

/* ---- makers ---------------------------------------------------------------------------------- */

/* Not what waits for somebody who writes it, nor what a caller gives to one thread. */
static bool is_plain_file(const ps_files_ahead *self, const char *path) {
    struct stat facts;
    return strcmp(path, "-") != 0 && ps_given_sets_find(&self->options.given, path) == NULL &&
           stat(path, &facts) == 0 && S_ISREG(facts.st_mode);
}

/* Of sets that lie scattered over a file the reader keeps many. */
static pspec_status begin_file(const ps_files_ahead *self, begun_file *file, const char *path,
                               const ps_watch *watch, ps_error *error) {
    file->set.num_points = 0;
    file->ends = false;
    PS_TRY(ps_points_open(&file->reader, path, &self->options, error));
    ps_points_limit_threads(file->reader, self->parsers);
    return ps_points_are_scattered(file->reader)
               ? PSPEC_OK
               : ps_points_fill(file->reader, &file->set, self->plan.most_bytes, &file->ends, watch,
                                error);
}

static void leave_alone(begun_file *file) {
    ps_points_close(file->reader);
    file->reader = NULL;
}

static pspec_status make(void *payload, uint64_t index, unsigned slot, const ps_watch *watch,
                         ps_error *error) {
    const ps_files_ahead *const self = payload;
    const char *const path = self->plan.paths[index];
    begun_file *const file = &self->begun[slot];
    (void)error;
    leave_alone(file); /* where nobody has taken it */
    if (is_plain_file(self, path) && begin_file(self, file, path, watch, NULL) != PSPEC_OK) {
        leave_alone(file);
    }
    return PSPEC_OK;
}

/* ---- all of them ----------------------------------------------------------------------------- */

static uint64_t find_room(const ps_point_options *options) {
    const uint64_t limit = options->memory_limit / SHARE_OF_LIMIT;
    return options->memory_limit > 0 && limit < ROOM_BYTES ? limit : ROOM_BYTES;
}

/* One more than there are threads: the file that was taken last has its slot, too. */
static unsigned count_slots(const ps_files_plan *plan, uint64_t room) {
    struct rlimit descriptors;
    const bool are_few =
        getrlimit(RLIMIT_NOFILE, &descriptors) == 0 && descriptors.rlim_cur < LEAST_DESCRIPTORS;
    uint64_t most = ps_workers_most() + 1;
    if (are_few || plan->set_bytes < LEAST_BYTES) {
        return 0;
    }
    most = most < plan->num ? most : plan->num;
    return (unsigned)(most < room / plan->set_bytes ? most : room / plan->set_bytes);
}

static pspec_status begin(ps_files_ahead *self, ps_error *error) {
    const ps_ahead_plan plan = {
        .make = make,
        .payload = self,
        .num_things = self->plan.num,
        .num_slots = self->num_slots,
        .num_threads = self->num_slots - 1,
    };
    PS_TRY(PS_NEW(&self->begun, self->num_slots, "files read ahead", error));
    return ps_ahead_create(&self->ahead, &plan, error);
}

pspec_status ps_files_ahead_create(ps_files_ahead **out, const ps_files_plan *plan,
                                   ps_error *error) {
    const uint64_t room = find_room(plan->options);
    const unsigned num_slots = count_slots(plan, room);
    ps_files_ahead *self = NULL;
    *out = NULL;
    if (num_slots < 2) {
        return PSPEC_OK;
    }
    PS_TRY(PS_NEW(&self, 1, "files read ahead", error));
    self->plan = *plan;
    self->plan.most_bytes =
        room / num_slots < plan->most_bytes ? room / num_slots : plan->most_bytes;
    self->options = *plan->options;
    self->num_slots = num_slots;
    self->parsers = ps_workers_most() / (num_slots - 1);
    const pspec_status status = begin(self, error);
    if (status != PSPEC_OK) {
        ps_files_ahead_destroy(self);
        return status;
    }
    *out = self;
    return PSPEC_OK;
}

void ps_files_ahead_destroy(ps_files_ahead *files) {
    if (files == NULL) {
        return;
    }
    ps_ahead_destroy(files->ahead);
    for (size_t i = 0; files->begun != NULL && i < files->num_slots; i++) {
        leave_alone(&files->begun[i]);
        ps_point_set_free(&files->begun[i].set);
    }
    free(files->begun);
    free(files);
}

pspec_status ps_files_ahead_take(ps_files_ahead *files, size_t index, const ps_watch *watch,
                                 ps_point_reader **reader, ps_point_set *set, bool *ends,
                                 ps_error *error) {
    unsigned slot = 0;
    *reader = NULL;
    while (files->num_waited <= index) {
        const pspec_status status = ps_ahead_next(files->ahead, watch, &slot, NULL);
        if (status != PSPEC_OK) {
            return ps_fail(error, status, "interrupted while %s is read", files->plan.paths[index]);
        }
        files->num_waited++;
    }
    begun_file *const file = &files->begun[slot];
    if (file->reader != NULL) {
        ps_point_set kept = *set;
        if (set->points_capacity > 2 * files->plan.most_bytes / sizeof(double)) {
            ps_point_set_free(&kept); /* of larger sets than there is room for here */
        }
        *reader = file->reader;
        ps_points_limit_threads(*reader, 0);
        *set = file->set;
        *ends = file->ends;
        file->reader = NULL;
        file->set = kept;
    }
    return PSPEC_OK;
}
