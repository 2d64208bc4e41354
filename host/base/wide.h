/* Loops compiled a second time for wider vectors than those that every x86-64 has, for processors
 * that have them: the binary formats are read at the speed of memory, and checked at half of it
 * otherwise.
 *
 *     PS_WIDE_BODY(bool, are_inside, (const double *values, size_t count)) { ... the loop ... }
 *     PS_WIDE(bool, are_inside, (const double *values, size_t count), (values, count))
 *
 * makes a function are_inside. Nothing else may be in such a loop: results must be the same to the
 * bit.
 */
#ifndef PS_BASE_WIDE_H
#define PS_BASE_WIDE_H

#if defined(__x86_64__) && defined(__GNUC__)
#define PS_WIDE_BODY(type, name, parameters)                                                       \
    static inline __attribute__((always_inline)) type name##_body parameters
#define PS_WIDE(type, name, parameters, arguments)                                                 \
    __attribute__((target("avx2"))) static type name##_wide parameters {                           \
        return name##_body arguments;                                                              \
    }                                                                                              \
    static type name parameters {                                                                  \
        return __builtin_cpu_supports("avx2") ? name##_wide arguments : name##_body arguments;     \
    }
#else
#define PS_WIDE_BODY(type, name, parameters) static inline type name##_body parameters
#define PS_WIDE(type, name, parameters, arguments)                                                 \
    static type name parameters {                                                                  \
        return name##_body arguments;                                                              \
    }
#endif

#endif
