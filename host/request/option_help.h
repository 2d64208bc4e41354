/* What --help says of an option in the help of one command, without what is about others. */
#ifndef PS_REQUEST_OPTION_HELP_H
#define PS_REQUEST_OPTION_HELP_H

/* The longest text in the table with the names of its values has less. */
enum { PS_OPTION_HELP_BYTES = 512 };

/* A text has parts in braces, "(default {check:as saved}{:1024})": of those that touch only the
 * first is told that has the command before its colon, "check" or "pairs,quadrature", or
 * nothing. */
void ps_option_help(char out[PS_OPTION_HELP_BYTES], const char *help, const char *command);

#endif
