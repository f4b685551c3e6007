/* What the library says about inputs and result, element by element. */
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include <stdio.h>

#include "bespoke.h"
#include "text.h"

/* Prints a line for each of the first warnings and errors, and how many more there are. */
void diagnostics_print(const BespokeSession *session, FILE *file);

/* Writes all of them as a JSON array. */
bool diagnostics_write(const BespokeSession *session, FILE *file, Message *message);

#endif
