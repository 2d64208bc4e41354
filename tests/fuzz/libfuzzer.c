/* libFuzzer's entry. --target=NAME chooses the target, --list names all with their dictionaries. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const fuzz_target *chosen;

static void list_targets(void) {
    for (const fuzz_target *target = fuzz_targets; target->name != NULL; target++) {
        printf("%s %s\n", target->name, target->dictionary != NULL ? target->dictionary : "-");
    }
}

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    static const char option[] = "--target=";
    for (int i = 1; i < *argc; i++) {
        const char *const word = (*argv)[i];
        if (strcmp(word, "--list") == 0) {
            list_targets();
            exit(EXIT_SUCCESS);
        }
        if (strncmp(word, option, sizeof option - 1) == 0) {
            chosen = fuzz_target_find(word + sizeof option - 1);
        }
    }
    if (chosen == NULL) {
        fprintf(stderr, "--target=NAME with one of the names that --list prints\n");
        exit(EXIT_FAILURE);
    }
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    chosen->run(chosen->argument, (fuzz_bytes){data, size});
    return 0;
}
