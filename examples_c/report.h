/* The report of a run as JSON. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "bespoke.h"
#include "text.h"

/* Writes what the session did. `seconds` is the time of the whole run, files included. */
bool report_write(const BespokeSession *session, double seconds, FILE *file, Message *message);

#endif
