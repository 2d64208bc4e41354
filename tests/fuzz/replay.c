/* replay CORPUS: runs the files CORPUS/TARGET/... through their targets. replay TARGET FILE...:
 * runs these, for a look at a crash with any compiler and debugger. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_BYTES = 1 << 20, PATH_BYTES = 4096 };

/* Into memory of exactly its size, so that a sanitizer sees reading beyond. */
static void run_file(const fuzz_target *target, const char *path) {
    FILE *const stream = fopen(path, "rb");
    if (stream == NULL) {
        fuzz_fail("cannot read %s", path);
    }
    printf("%s\n", path);
    fflush(stdout); /* the last line names the culprit */
    uint8_t *const read = fuzz_allocate(NULL, MOST_BYTES, 1);
    const size_t size = fread(read, 1, MOST_BYTES, stream);
    fclose(stream);
    uint8_t *const exact = malloc(size > 0 ? size : 1);
    if (exact == NULL) {
        fuzz_fail("no memory for %s", path);
    }
    memcpy(exact, read, size);
    free(read);
    target->run(target->argument, (fuzz_bytes){exact, size});
    free(exact);
}

static void run_folder(const fuzz_target *target, const char *corpus) {
    char path[PATH_BYTES];
    size_t num_files = 0;
    snprintf(path, sizeof path, "%s/%s", corpus, target->name);
    DIR *const folder = opendir(path);
    for (struct dirent *entry = folder != NULL ? readdir(folder) : NULL; entry != NULL;
         entry = readdir(folder)) {
        if (entry->d_name[0] != '.') {
            snprintf(path, sizeof path, "%s/%s/%s", corpus, target->name, entry->d_name);
            run_file(target, path);
            num_files++;
        }
    }
    if (num_files == 0) {
        fuzz_fail("no files for the target %s in %s", target->name, corpus);
    }
    closedir(folder);
}

int main(int argc, char **argv) {
    struct stat facts;
    const fuzz_target *const target = argc > 2 ? fuzz_target_find(argv[1]) : NULL;
    if (argc == 2 && stat(argv[1], &facts) == 0 && S_ISDIR(facts.st_mode)) {
        for (const fuzz_target *each = fuzz_targets; each->name != NULL; each++) {
            run_folder(each, argv[1]);
        }
        return EXIT_SUCCESS;
    }
    if (target == NULL) {
        fprintf(stderr, "usage: %s CORPUS | TARGET FILE...\n", argv[0]);
        return EXIT_FAILURE;
    }
    for (int i = 2; i < argc; i++) {
        run_file(target, argv[i]);
    }
    return EXIT_SUCCESS;
}
