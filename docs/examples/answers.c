/* What the program computes, asked for by its own words: the spectrum of a sampler, then whether
 * another sampler has the same, and what the first bins are.
 *
 *     cc answers.c $(pkg-config --cflags --libs pointspec) && ./a.out
 */
#include <pointspec/pointspec.h>

#include <stdio.h>

#define COUNT(options) (sizeof(options) / sizeof(options)[0])

static void warn(const char *sentence, void *payload) {
    fprintf(payload, "# %s\n", sentence);
}

/* pointspec power --sampler jittered --points 256 --realizations 16 --max-frequency 16 --output
 * answers.npz */
static pspec_status print_power(pspec_context *context) {
    const pspec_option options[] = {{"sampler", "jittered"},
                                    {"points", "256"},
                                    {"realizations", "16"},
                                    {"max-frequency", "16"},
                                    {"output", "answers.npz"}};
    pspec_table *table = NULL;
    const pspec_status status = pspec_answer(&table, context, "power", options, COUNT(options));
    if (status != PSPEC_OK) {
        return status;
    }
    const size_t bin = pspec_table_find_column(table, "bin");
    const size_t power = pspec_table_find_column(table, "power");
    printf("# engine %s\n", pspec_table_find_entry(table, "engine").text);
    for (size_t row = 0; row < pspec_table_num_rows(table); row++) {
        printf("%lld %g\n", (long long)pspec_table_cell(table, row, bin).integer,
               pspec_table_cell(table, row, power).number);
    }
    pspec_table_destroy(table);
    return PSPEC_OK;
}

/* pointspec check --against answers.npz --sampler SAMPLER --seed 2 */
static pspec_status print_check(pspec_context *context, const char *sampler) {
    const pspec_option options[] = {
        {"against", "answers.npz"}, {"sampler", sampler}, {"seed", "2"}};
    pspec_table *table = NULL;
    const pspec_status status = pspec_answer(&table, context, "check", options, COUNT(options));
    if (status == PSPEC_OK) {
        const char *const verdict = pspec_table_verdict(table);
        printf("# %s: %s\n", sampler, verdict[0] != '\0' ? verdict : "the same spectrum");
        pspec_table_destroy(table);
    }
    return status;
}

int main(void) {
    pspec_context *context = pspec_context_create();
    pspec_context_set_warnings(context, warn, stderr);
    if (print_power(context) != PSPEC_OK || print_check(context, "jittered") != PSPEC_OK ||
        print_check(context, "white") != PSPEC_OK) {
        fprintf(stderr, "%s\n", pspec_context_message(context));
        return 1;
    }
    pspec_context_destroy(context);
    return 0;
}
