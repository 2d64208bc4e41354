/* What --help says of an option in the help of one command, without what is about others. */
#ifndef PS_REQUEST_OPTION_HELP_H
#define PS_REQUEST_OPTION_HELP_H

#include "request/options.h"

/* The longest text in the table with the names of its values has less. */
enum { PS_OPTION_HELP_BYTES = 512 };

/* A text has parts in braces, "(default {check:as saved}{:1024})": of those that touch only the
 * first is told that has the command before its colon, "check" or "pairs,quadrature", or
 * nothing. */
void ps_option_help(char out[PS_OPTION_HELP_BYTES], const char *help, const char *command);

/* What its row says of the values of an option, for programs that make calls of it. */
typedef struct ps_option_facts {
    const char *type;                   /* flag, integer, integers, number, word or text */
    const char *unit;                   /* "": none */
    const char *file;                   /* "read" or "written" where a value names a file; "" */
    bool is_repeatable;                 /* it may be given several times, and each counts */
    char initial[PS_OPTION_HELP_BYTES]; /* the default, as help has it; "" where it says none */
} ps_option_facts;
/* words: the values that the command admits, NULL for a flag; help: of ps_option_help. */
void ps_option_find_facts(ps_option_facts *out, ps_option_id id, const char *words,
                          const char *help);

#endif
