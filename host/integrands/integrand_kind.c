#include "integrands/integrand_kind.h"

#include "base/text.h"

#include <stdio.h>
#include <string.h>

enum { WHAT_BYTES = 128 };

pspec_status ps_integrand_number(const ps_integrand *integrand, const char *key, const char *text,
                                 double least, double most, double *out, ps_error *error) {
    char what[WHAT_BYTES];
    snprintf(what, sizeof what, "%s of integrand %s", key, integrand->kind->name);
    return ps_parse_number(text, what, least, most, out, error);
}

pspec_status ps_integrand_vector(const ps_integrand *integrand, const char *key, const char *text,
                                 double least, double most, double *out, ps_error *error) {
    enum { MOST_DIGITS = 64 };
    const unsigned dimension = integrand->place.dimension;
    unsigned num = 0;
    for (const char *at = text;; at++) {
        char digits[MOST_DIGITS];
        const size_t length = strcspn(at, "x");
        if (num == dimension || length >= sizeof digits) {
            num = dimension + 1;
            break;
        }
        memcpy(digits, at, length);
        digits[length] = '\0';
        PS_TRY(ps_integrand_number(integrand, key, digits, least, most, &out[num], error));
        num++;
        at += length;
        if (*at == '\0') {
            break;
        }
    }
    if (num != 1 && num != dimension) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "integrand %s: %s=%s is not one number, nor %u with x between them",
                       integrand->kind->name, key, text, dimension);
    }
    for (unsigned i = num; i < dimension; i++) {
        out[i] = out[0];
    }
    return PSPEC_OK;
}

pspec_status ps_integrand_fail(const ps_integrand *integrand, const char *key, const char *text,
                               const char *why, ps_error *error) {
    return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "integrand %s: %s=%s: %s",
                   integrand->kind->name, key, text, why);
}

void ps_integrand_images(const double *x, unsigned dimension,
                         void (*add)(void *payload, const double *image), void *payload) {
    double image[PS_MAX_DIMENSION];
    unsigned num = 1;
    for (unsigned i = 0; i < dimension; i++) {
        num *= 3;
    }
    for (unsigned code = 0; code < num; code++) {
        unsigned rest = code;
        for (unsigned i = 0; i < dimension; i++) {
            image[i] = x[i] - rint(x[i]) + (int)(rest % 3) - 1;
            rest /= 3;
        }
        add(payload, image);
    }
}

double ps_integrand_norm(const int32_t *k, unsigned dimension) {
    double norm2 = 0;
    for (unsigned i = 0; i < dimension; i++) {
        norm2 += (double)k[i] * k[i];
    }
    return sqrt(norm2);
}

double ps_integrand_sinc(int32_t k, size_t side) {
    const double n = (double)side;
    const double rest = fmod(k, n); /* exact */
    const double t = PS_PI * k / n;
    const double sine = sin(PS_PI * rest / n) * (fmod((k - rest) / n, 2) != 0 ? -1 : 1);
    return k == 0 ? 1 : sine / t;
}
