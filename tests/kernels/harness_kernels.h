/* Kernels on their own: buffers between guards, numbers of either precision, launches. */
#ifndef TESTS_HARNESS_KERNELS_H
#define TESTS_HARNESS_KERNELS_H

#include "harness.h"

/* Device memory with a guard before and behind it. Memory without data and guards begin as bytes
 * 0xFF: NaN in either precision, so that a stray read shows in the results, and a stray write or a
 * result that was not written shows when the memory is read back. On Oclgrind, which sees strays
 * itself, there are no guards: they would hide them from it. */
typedef struct test_memory {
    ps_device *device;
    ps_buffer whole, buffer; /* buffer is what kernels are given */
    size_t bytes, guard_bytes;
    void *original; /* what it began as */
} test_memory;

/* data NULL: bytes 0xFF. */
test_memory test_memory_create(ps_device *device, const void *data, size_t bytes);
/* The bytes, which the caller frees; fails the test when a guard has changed. */
void *test_memory_read(const test_memory *memory);
/* Fails the test when anything has changed, then frees the memory: for what kernels only read. */
void test_memory_free_unchanged(test_memory *memory);
void test_memory_free(test_memory *memory);

/* The same for numbers of the given precision, 32 or 64 bits, as doubles; a NULL array is 0xFF. */
test_memory test_reals_create(ps_device *device, unsigned precision, const double *values,
                              size_t num);
double *test_reals_read(const test_memory *memory, unsigned precision);

/* A kernel; options as for printf. */
ps_kernel *test_kernel(ps_device *device, const char *source, const char *name, const char *options,
                       ...) PS_PRINTF(4, 5);

/* Launches over `first` work-items (rounded up) x second x third in groups of `group`. */
#define TEST_LAUNCH(device, kernel, group, first, second, third, ...)                              \
    do {                                                                                           \
        ps_device_set_group_size((device), (group));                                               \
        const ps_range test_range = ps_range_light((device), (first), (second), (third), 0, 0);    \
        assert_ok(PS_LAUNCH((device), (kernel), &test_range, error, __VA_ARGS__));                 \
    } while (0)

/* Work-group sizes that every kernel is tried with. */
#define TEST_GROUP_SIZES ((const size_t[]){1, 3, test_group(64)})

/* Whole numbers |i| <= largest, as doubles. */
double *test_whole_numbers(uint64_t *seed, size_t num, double largest);

/* True for precision 32, and for 64 where the device has it. */
bool test_has_precision(const ps_device *device, unsigned precision);

#endif
