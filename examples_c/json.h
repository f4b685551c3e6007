/* Values of a JSON file. */
#ifndef JSON_H
#define JSON_H

#include <stdio.h>

/* Infinity and NaN, which JSON does not have, become null. */
void json_number(FILE *file, double value);

/* UTF-8, in quotes. */
void json_text(FILE *file, const char *text);

#endif
