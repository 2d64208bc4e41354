#include "engines/nufft/fft.h"

#include "base/memory.h"
#include "device/reals.h"
#include "engines/nufft/cycles.h"
#include "math/pi.h"

#include <math.h>
#include <stdlib.h>

/* Large radices first: the fewest passes over memory. Additions and multiplications (a fused
 * operation is two) of each butterfly as kernels/nufft/transform/butterfly.h writes it. */
static const struct {
    uint32_t radix;
    double flops;
} butterflies[] = {{8, 60}, {7, 96}, {5, 52}, {4, 16}, {3, 18}, {2, 4}};
enum { NUM_BUTTERFLIES = sizeof butterflies / sizeof butterflies[0] };

/* A twiddle factor: two products and two fused operations. */
static const double flops_per_twiddle = 6;

static uint64_t without_small_factors(uint64_t n) {
    static const uint32_t primes[] = {2, 3, 5, 7};
    for (size_t i = 0; i < sizeof primes / sizeof primes[0]; i++) {
        while (n % primes[i] == 0) {
            n /= primes[i];
        }
    }
    return n;
}

uint32_t ps_fft_length(uint64_t least) {
    uint64_t n = least > 0 ? least : 1;
    while (n <= UINT32_MAX && without_small_factors(n) != 1) {
        n++;
    }
    return n <= UINT32_MAX ? (uint32_t)n : 0;
}

bool ps_fft_radices(uint32_t length, uint32_t radices[PS_FFT_MAX_PASSES]) {
    size_t num = 0;
    uint32_t rest = length;
    for (size_t i = 0; i < NUM_BUTTERFLIES && length > 0; i++) {
        while (rest % butterflies[i].radix == 0) {
            radices[num++] = butterflies[i].radix;
            rest /= butterflies[i].radix;
        }
    }
    radices[num] = 0;
    return rest == 1;
}

unsigned ps_fft_passes(uint32_t length) {
    uint32_t radices[PS_FFT_MAX_PASSES];
    unsigned num = 0;
    ps_fft_radices(length, radices);
    while (radices[num] != 0) {
        num++;
    }
    return num;
}

double ps_fft_flops(uint32_t length) {
    uint32_t radices[PS_FFT_MAX_PASSES];
    double flops = 0;
    if (!ps_fft_radices(length, radices)) {
        return HUGE_VAL;
    }
    for (const uint32_t *radix = radices; *radix != 0; radix++) {
        double each = radix[1] != 0 ? flops_per_twiddle * (*radix - 1) : 0;
        for (size_t i = 0; i < NUM_BUTTERFLIES; i++) {
            each += butterflies[i].radix == *radix ? butterflies[i].flops : 0;
        }
        flops += each * (double)length / *radix;
    }
    return flops;
}

double ps_fft_passed(uint32_t length) {
    return (double)ps_fft_passes(length) * length;
}

double ps_fft_cycles(uint32_t length) {
    return ps_nufft_cycles[PS_NUFFT_OPERATION] * ps_fft_flops(length) +
           ps_nufft_cycles[PS_NUFFT_PASSED] * ps_fft_passed(length);
}

/* Lengths from least to last, visited in any order: 2^a times every product of 3, 5 and 7 that is
 * small enough. Going through the integers instead took 14 ms for a plan of 32768 frequencies. */
typedef struct lengths {
    uint64_t least, last, odd;
    uint64_t threes, fives; /* of odd: the powers that it ends with */
} lengths;

/* Advances to the next odd part and returns its first length, 0 when none is left. */
static uint64_t next_length(lengths *self) {
    if (self->odd == 0) {
        self->odd = self->threes = self->fives = 1;
    } else if (3 * self->odd <= self->last) {
        self->odd *= 3;
        self->threes *= 3;
    } else if (5 * (self->odd / self->threes) <= self->last) {
        self->odd = 5 * (self->odd / self->threes);
        self->fives *= 5;
        self->threes = 1;
    } else {
        self->odd = 7 * (self->odd / self->threes / self->fives);
        self->threes = self->fives = 1;
    }
    uint64_t length = self->odd;
    while (length < self->least) {
        length *= 2;
    }
    return self->odd <= self->last ? length : 0;
}

/* The smallest of them; powers of 2 are among them. */
static uint64_t least_length(uint64_t least) {
    lengths all = {.least = least, .last = 2 * least};
    uint64_t smallest = UINT64_MAX;
    for (uint64_t n = next_length(&all); n != 0; n = next_length(&all)) {
        smallest = n < smallest ? n : smallest;
    }
    return smallest;
}

uint32_t ps_fft_good_length(uint64_t least) {
    const uint32_t beyond_share = 4; /* a quarter longer costs more in any case */
    const uint64_t first = least_length(least > 0 ? least : 1);
    lengths all = {.least = first, .last = first + first / beyond_share};
    uint64_t best = 0;
    double least_cycles = HUGE_VAL;
    for (uint64_t n = next_length(&all); n != 0; n = next_length(&all)) {
        const bool is_long = n > all.last || n > UINT32_MAX;
        const double cycles = is_long ? HUGE_VAL : ps_fft_cycles((uint32_t)n);
        if (cycles < least_cycles || (cycles == least_cycles && n > best && !is_long)) {
            least_cycles = cycles;
            best = n;
        }
    }
    return (uint32_t)best;
}

/* [cosine, sine] of -2 pi t / n, the angle reduced to an eighth of a turn so that symmetric
 * factors are equal to the bit. */
static void put_root(uint32_t t, uint32_t n, double out[2]) {
    const uint64_t eighths = 8 * (uint64_t)t;
    const uint64_t octant = eighths / n;
    const uint64_t quarter = (octant + 1) / 2; /* nearest quarter turn */
    const long double rest =
        (long double)(int64_t)(4 * (uint64_t)t - quarter * n); /* quarters / n */
    const long double angle = PS_PI_L / 2 * rest / n;
    const long double c = cosl(angle);
    const long double s = sinl(angle);
    const long double cosines[4] = {c, -s, -c, s};
    const long double sines[4] = {s, c, -s, -c};
    out[0] = (double)cosines[quarter % 4];
    out[1] = (double)-sines[quarter % 4];
}

pspec_status ps_fft_roots_create(ps_buffer *out, uint32_t length, ps_precision precision,
                                 ps_device *device, ps_error *error) {
    double *roots = NULL;
    PS_TRY(PS_NEW(&roots, 2 * (size_t)length, "roots of unity", error));
    for (uint32_t i = 0; i < length; i++) {
        put_root(i, length, roots + 2 * (size_t)i);
    }
    const pspec_status status =
        ps_reals_upload(device, out, precision, roots, 2 * (size_t)length, "roots of unity", error);
    free(roots);
    return status;
}

/* [pass][t][j - 1]: as the passes read them. */
static void fill_twiddles(uint32_t length, const uint32_t *radices, double *out) {
    uint32_t step = 1; /* of twiddles of the whole length */
    for (uint32_t rest = length; *radices != 0; radices++) {
        const uint32_t radix = *radices;
        rest /= radix;
        for (uint32_t t = 0; t < rest; t++) {
            for (uint32_t j = 1; j < radix; j++) {
                put_root((uint32_t)((uint64_t)t * j * step % length), length, out);
                out += 2;
            }
        }
        step *= radix;
    }
}

static pspec_status upload_twiddles(ps_fft_plan *plan, const uint32_t *radices,
                                    ps_precision precision, ps_device *device, ps_error *error) {
    double *twiddles = NULL;
    const size_t count = 2 * ((size_t)plan->length - 1); /* n - n/r_1 + n/r_1 - n/(r_1 r_2) + ... */
    PS_TRY(PS_NEW(&twiddles, count, "twiddle factors", error));
    fill_twiddles(plan->length, radices, twiddles);
    const pspec_status status = ps_reals_upload(device, &plan->twiddles, precision, twiddles, count,
                                                "twiddle factors", error);
    free(twiddles);
    return status;
}

/* Frequency k = k_1 + r_1 (k_2 + r_2 (...)) ends in cell k_1 n/r_1 + k_2 n/(r_1 r_2) + ... */
uint32_t ps_fft_position(uint32_t length, const uint32_t *radices, uint32_t k) {
    uint32_t position = 0;
    for (uint32_t rest = length; *radices != 0; radices++) {
        rest /= *radices;
        position += k % *radices * rest;
        k /= *radices;
    }
    return position;
}

static pspec_status upload_positions(ps_fft_plan *plan, const uint32_t *radices, ps_device *device,
                                     ps_error *error) {
    uint32_t *positions = NULL;
    const size_t bytes = plan->length * sizeof(uint32_t);
    PS_TRY(PS_NEW(&positions, plan->length, "positions", error));
    for (uint32_t k = 0; k < plan->length; k++) {
        positions[k] = ps_fft_position(plan->length, radices, k);
    }
    const pspec_status status =
        ps_buffer_upload(device, &plan->position, positions, bytes, "positions", error);
    free(positions);
    return status;
}

pspec_status ps_fft_plan_create(ps_fft_plan *out, uint32_t length, ps_precision precision,
                                ps_device *device, ps_error *error) {
    uint32_t radices[PS_FFT_MAX_PASSES] = {0};
    *out = (ps_fft_plan){.length = length};
    if (!ps_fft_radices(length, radices)) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no transform of length %lu: it has a prime factor above 7",
                       (unsigned long)length);
    }
    PS_TRY(ps_buffer_upload(device, &out->radices, radices, sizeof radices, "radices", error));
    PS_TRY(upload_positions(out, radices, device, error));
    return upload_twiddles(out, radices, precision, device, error);
}

void ps_fft_plan_free(ps_fft_plan *plan) {
    PS_BUFFERS_RELEASE(&plan->radices, &plan->twiddles, &plan->position);
    *plan = (ps_fft_plan){0};
}
