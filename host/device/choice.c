/* Which devices a selector means. */
#include "device/choice.h"

#include "device/device_private.h"

#include "base/memory.h"
#include "base/text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- one ----------------------------------------------------------------------------------- */

static bool contains_ignoring_case(const char *text, const char *part) {
    if (part[0] == '\0') {
        return true;
    }
    for (; *text != '\0'; text++) {
        size_t i = 0;
        while (part[i] != '\0' &&
               tolower((unsigned char)text[i]) == tolower((unsigned char)part[i])) {
            i++;
        }
        if (part[i] == '\0') {
            return true;
        }
    }
    return false;
}

static bool device_matches(const ps_device_limits *limits, const char *selector) {
    if (strcasecmp(selector, "gpu") == 0) {
        return limits->is_gpu;
    }
    if (strcasecmp(selector, "cpu") == 0) {
        return limits->is_cpu;
    }
    if (strcasecmp(selector, "accelerator") == 0) {
        return !limits->is_gpu && !limits->is_cpu;
    }
    return contains_ignoring_case(limits->name, selector);
}

bool ps_device_is_simulator(const ps_device_limits *limits) {
    return contains_ignoring_case(limits->platform, "oclgrind") ||
           contains_ignoring_case(limits->name, "oclgrind");
}

bool ps_device_is_pocl(const ps_device_limits *limits) {
    return strcmp(limits->platform, "Portable Computing Language") == 0;
}

/* First device that matches selector, rather no simulator; num_devices when none does. */
static size_t find_match(const ps_device_limits *limits, size_t num_devices, const char *selector) {
    size_t simulator = num_devices;
    for (size_t i = 0; i < num_devices; i++) {
        if (!device_matches(&limits[i], selector)) {
            continue;
        }
        if (!ps_device_is_simulator(&limits[i])) {
            return i;
        }
        simulator = simulator < num_devices ? simulator : i;
    }
    return simulator;
}

/* A simulator calls itself GPU and CPU at once, and is slower than either by a factor of thousands:
 * the last choice. */
static size_t choose_default(const ps_device_limits *limits, size_t num_devices) {
    static const char *const kinds[] = {"gpu", "cpu", ""}; /* any name contains the last */
    size_t index = 0;
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; kind++) {
        index = find_match(limits, num_devices, kinds[kind]);
        if (index < num_devices && !ps_device_is_simulator(&limits[index])) {
            return index;
        }
    }
    return index; /* there are only simulators */
}

/* The one that `base` means; whole: the selector as it was given. */
static pspec_status choose(size_t *index, const ps_device_limits *limits, size_t num_devices,
                           const char *base, const char *whole, ps_error *error) {
    if (base[0] == '\0') {
        *index = choose_default(limits, num_devices);
        return PSPEC_OK;
    }
    if (base[strspn(base, "0123456789")] == '\0') {
        const unsigned long long number = strtoull(base, NULL, 10);
        *index = number < num_devices ? (size_t)number : num_devices;
    } else {
        *index = find_match(limits, num_devices, base);
    }
    if (*index < num_devices) {
        return PSPEC_OK;
    }
    ps_text names = {0};
    for (size_t i = 0; i < num_devices; i++) {
        ps_text_append(&names, "%snumber %zu, \"%s\"", i > 0 ? "; " : "", i, limits[i].name);
    }
    ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "no OpenCL device fits \"%s\"; %s %s", whole,
            num_devices == 1 ? "the only one is" : "there are", ps_text_string(&names));
    ps_text_free(&names);
    return PSPEC_ERROR_INVALID_ARGUMENT;
}

/* ---- several ------------------------------------------------------------------------------- */

/* A member of a list. */
typedef struct member {
    char base[128]; /* which device, "" the default */
    bool is_all;    /* all that fit */
    bool has_share; /* one share of num_shares, else each of them */
    uint64_t num_shares, share;
} member;

static const char all[] = ":all";
static const char split[] = ":split=";

static pspec_status read_split(member *out, char *text, ps_error *error) {
    char *const slash = strchr(text, '/');
    out->has_share = slash != NULL;
    if (slash != NULL) {
        *slash = '\0';
    }
    PS_TRY(ps_parse_count(text, "the number of shares of a device", 1, PS_SELECTORS_MOST,
                          &out->num_shares, error));
    return slash == NULL ? PSPEC_OK
                         : ps_parse_count(slash + 1, "the share of a device", 0,
                                          out->num_shares - 1, &out->share, error);
}

/* The next member of the list, after which *at is the one behind it, or NULL. */
static pspec_status next_member(member *out, const char **at, ps_error *error) {
    const size_t length = strcspn(*at, ",");
    *out = (member){0};
    if (length >= sizeof out->base) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT,
                       "no device has a name of %zu characters: \"%s\"", length, *at);
    }
    memcpy(out->base, *at, length);
    *at = (*at)[length] == ',' ? *at + length + 1 : NULL;
    const size_t ending = length < sizeof all ? 0 : length - (sizeof all - 1);
    if (ending > 0 && strcasecmp(out->base + ending, all) == 0) {
        out->is_all = true;
        out->base[ending] = '\0';
    }
    char *const shares = strstr(out->base, split);
    if (shares == NULL) {
        return PSPEC_OK;
    }
    *shares = '\0';
    return read_split(out, shares + sizeof split - 1, error);
}

bool ps_selector_is_list(const char *selector) {
    return selector != NULL && (strchr(selector, ',') != NULL || strstr(selector, all) != NULL ||
                                strstr(selector, split) != NULL);
}

static pspec_status add(ps_selectors *out, const member *named, size_t index, size_t share,
                        ps_error *error) {
    if (out->num == PS_SELECTORS_MOST) {
        return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "a job has %d devices at most",
                       PS_SELECTORS_MOST);
    }
    struct ps_one_selector *const one = &out->of[out->num];
    if (named->num_shares > 0) {
        snprintf(one->text, sizeof one->text, "%zu%s%zu/%zu", index, split,
                 (size_t)named->num_shares, share);
    } else {
        snprintf(one->text, sizeof one->text, "%zu", index);
    }
    for (size_t i = 0; i < out->num; i++) {
        if (strcmp(out->of[i].text, one->text) == 0) {
            return ps_fail(error, PSPEC_ERROR_INVALID_ARGUMENT, "device %s is named twice",
                           one->text);
        }
    }
    out->num++;
    return PSPEC_OK;
}

static pspec_status add_shares(ps_selectors *out, const member *named, size_t index,
                               ps_error *error) {
    const size_t first = named->has_share ? named->share : 0;
    const size_t end = named->has_share || named->num_shares == 0 ? first + 1 : named->num_shares;
    for (size_t share = first; share < end; share++) {
        PS_TRY(add(out, named, index, share, error));
    }
    return PSPEC_OK;
}

/* All devices that fit, the simulators among them only where they are meant. */
static pspec_status add_all(ps_selectors *out, const member *named, const ps_device_limits *limits,
                            size_t num_devices, size_t first, ps_error *error) {
    const bool may_simulate = ps_device_is_simulator(&limits[first]);
    for (size_t i = 0; i < num_devices; i++) {
        if (device_matches(&limits[i], named->base) &&
            ps_device_is_simulator(&limits[i]) == may_simulate) {
            PS_TRY(add_shares(out, named, i, error));
        }
    }
    return PSPEC_OK;
}

pspec_status ps_selectors_find(ps_selectors *out, const ps_device_limits *limits,
                               size_t num_devices, const char *selector, ps_error *error) {
    out->num = 0;
    for (const char *at = selector != NULL ? selector : ""; at != NULL;) {
        member named;
        size_t index = 0;
        PS_TRY(next_member(&named, &at, error));
        PS_TRY(choose(&index, limits, num_devices, named.base, selector, error));
        PS_TRY(named.is_all ? add_all(out, &named, limits, num_devices, index, error)
                            : add_shares(out, &named, index, error));
    }
    return PSPEC_OK;
}

/* ---- the first ----------------------------------------------------------------------------- */

pspec_status ps_device_choose_share(ps_choice *out, const ps_device_limits *limits,
                                    size_t num_devices, const char *selector, ps_error *error) {
    const char *at = selector != NULL ? selector : "";
    member named;
    PS_TRY(next_member(&named, &at, error));
    *out = (ps_choice){.num_shares = (size_t)named.num_shares, .share = (size_t)named.share};
    return choose(&out->index, limits, num_devices, named.base, selector, error);
}

pspec_status ps_device_choose(const ps_device_limits *limits, size_t num_devices,
                              const char *selector, size_t *index, ps_error *error) {
    ps_choice choice;
    PS_TRY(ps_device_choose_share(&choice, limits, num_devices, selector, error));
    *index = choice.index;
    return PSPEC_OK;
}
