/* The report of a run as JSON. */
#ifndef REPORT_H
#define REPORT_H

#include <stdio.h>

#include "session.h"

/* Writes how the run ended, `status` as a name and `said` as a message, and what the session did until then. What cannot
   be known yet, as the distortion of a garment that has not moved, is left out. */
bool report_write(const Session *session, const char *status, const char *said, FILE *file, Message *message);

#endif
