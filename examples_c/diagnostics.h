/* The library's diagnostics about inputs and result, element by element. */
#ifndef DIAGNOSTICS_H
#define DIAGNOSTICS_H

#include <stdio.h>

#include "bespoke.h"
#include "text.h"

/* Prints a line for some of those that are at least this severe, the worst first, and how many more there are. */
void diagnostics_print(const BespokeSession *session, uint32_t least, FILE *file);

/* Writes all of them as a JSON array. */
bool diagnostics_write(const BespokeSession *session, FILE *file, Message *message);

#endif
