#include "harness_rings.h"

#include "harness.h"

#include "math/pi.h"

#include <math.h>
#include <string.h>

void test_rings_make(test_rings *rings, size_t num, double side, uint64_t num_realizations,
                     test_power_at *power, double relative_error) {
    assert_true(num <= TEST_MOST_RINGS);
    memset(rings, 0, sizeof *rings);
    rings->spectrum = (ps_spectrum){.frequencies = {.kind = PS_FREQUENCIES_BOX, .dimension = 2},
                                    .num_realizations = num_realizations,
                                    .num_bins = num,
                                    .bins = rings->bins};
    for (size_t b = 0; b < num; b++) {
        ps_spectrum_bin *const bin = &rings->bins[b];
        bin->key = (int64_t)b + 1;
        bin->frequency = (double)(b + 1);
        bin->normalized_frequency = bin->frequency / side;
        bin->count = 2 * (uint64_t)lround(PS_PI * bin->frequency);
        bin->num_computed = bin->count;
        bin->power = power(bin->normalized_frequency);
        bin->standard_error = bin->power * relative_error;
        bin->anisotropy_db = NAN;
    }
}

void test_rings_add_noise(test_rings *rings, uint64_t *state) {
    const double num = (double)rings->spectrum.num_realizations;
    for (size_t b = 0; b < rings->spectrum.num_bins; b++) {
        ps_spectrum_bin *const bin = &rings->bins[b];
        double sum = 0;
        double squares = 0;
        for (uint64_t r = 0; r < rings->spectrum.num_realizations; r++) {
            double power = 0;
            for (uint64_t i = 0; i < bin->count / 2; i++) {
                power -= log(1 - test_uniform(state));
            }
            power *= 2 * bin->power / (double)bin->count;
            sum += power;
            squares += power * power;
        }
        bin->power = sum / num;
        bin->standard_error = sqrt((squares - sum * sum / num) / (num - 1) / num);
    }
}

double test_power_one(double nu) {
    (void)nu;
    return 1;
}

double test_power_raised(double nu) {
    return 0.006935 * (1 + 12 * nu * nu);
}

double test_power_jittered(double nu) {
    enum { NUM_DIRECTIONS = 64 };
    double sum = 0;
    for (int i = 0; i < NUM_DIRECTIONS; i++) {
        const double angle = (i + 0.5) * PS_PI / 2 / NUM_DIRECTIONS;
        const double x = PS_PI * nu * cos(angle);
        const double y = PS_PI * nu * sin(angle);
        sum += 1 - pow(sin(x) / x * sin(y) / y, 2);
    }
    return sum / NUM_DIRECTIONS;
}

double test_power_fourth(double nu) {
    return pow(nu, 4);
}
