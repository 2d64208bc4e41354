/* Where the name of a file stands in the value of an option. */
#include "request/option_inputs.h"

#include <string.h>

const char *ps_input_all(const char *words, const char *value) {
    (void)words;
    return value;
}

const char *ps_input_of_weights(const char *words, const char *value) {
    return ps_weights_find(words, value) == PS_WEIGHTS_FILE ? value : NULL;
}

const char *ps_input_of_named(const char *words, const char *value) {
    static const char key[] = "file=";
    const char *const found = strstr(value, key);
    (void)words;
    return found != NULL ? found + strlen(key) : NULL;
}
