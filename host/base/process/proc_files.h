/* Numbers out of the files of /proc and of cgroups. Names are below a folder root, "" for this
 * machine. False: the file, or what is looked for, is not there or is no number. */
#ifndef PS_BASE_PROCESS_PROC_FILES_H
#define PS_BASE_PROCESS_PROC_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PS_PROC_PATH = 1024 };

/* path = folder + name, which has its '/'; false when it is too long. */
bool ps_proc_join(char path[PS_PROC_PATH], const char *folder, const char *name);

/* The number that is all of a file ("max" is none). */
bool ps_proc_number(const char *root, const char *name, uint64_t *out);

/* The number behind a key at the beginning of a line. */
bool ps_proc_entry(const char *root, const char *name, const char *key, uint64_t *out);

/* The text behind a key, blanks and a colon at the beginning of a line, as much as there is room
 * for. */
bool ps_proc_text(const char *name, const char *key, char *out, size_t size);

/* Number `column` of the first line, counted from 0. */
bool ps_proc_column(const char *root, const char *name, unsigned column, uint64_t *out);

/* The folder of this process's memory cgroup, of version 2 or 1; its first `mounted` letters are
 * where the hierarchy is mounted. */
bool ps_proc_cgroup(const char *root, bool is_second, char group[PS_PROC_PATH], size_t *mounted);

#endif
