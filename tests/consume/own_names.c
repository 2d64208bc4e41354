/* A program that has names like those inside of the library, and nothing to do with them. */
#include <pointspec/pointspec.h>
#include <stdio.h>

extern int ps_fail;
int ps_device_open(void);

int ps_fail = 1;

int ps_device_open(void) {
    return ps_fail;
}

int main(void) {
    pspec_context *const context = pspec_context_create();
    const int has_context = context != NULL;
    pspec_context_destroy(context);
    printf("%d %d\n", ps_device_open(), has_context);
    return 0;
}
