/* The smallest program that uses the installed library. */
#include <pointspec/pointspec.h>

#include <stdio.h>

int main(void) {
    return printf("pointspec %s\n", pspec_version()) > 0 ? 0 : 1;
}
