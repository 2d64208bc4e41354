/* Fields of a line of text, between separators and perhaps in quotes. Private to host/points. */
#ifndef PS_POINTS_TEXT_FIELDS_H
#define PS_POINTS_TEXT_FIELDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct ps_field {
    const char *text;
    size_t length;
    bool is_quoted; /* a quote inside is written twice */
    bool is_open;   /* the line ends before the quotes do */
} ps_field;

/* The next field of a line, without quotes and blanks around it; false behind the last. Between
 * blanks, which tabs are unless the separator is one, there are no empty fields. *text is moved
 * behind the field and its separator; *is_more: a separator was there, so that another field
 * follows, which may be empty. */
bool ps_field_next(const char **text, char separator, bool *is_more, ps_field *out);
/* Has the field this text? */
bool ps_field_is(ps_field field, const char *name, size_t length);
unsigned ps_fields_count(const char *line, char separator);
/* Number of the field of this name, from 0, or -1. */
int ps_field_find(const char *names, char separator, const char *name, size_t length);

bool ps_field_is_number(ps_field token);
bool ps_field_is_not_finite(ps_field token);
bool ps_field_is_printable(ps_field token);
/* Printable text that begins with a letter, of any alphabet. */
bool ps_field_is_name(ps_field token);
/* At most 18 digits, which every uint64_t has room for; the value in *out. */
bool ps_field_is_whole(ps_field token, uint64_t *out);

#endif
