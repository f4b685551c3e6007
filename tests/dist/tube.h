/* Dresses one tube with a sleeve through a library that was opened by its path, as a host opens a plugin. */
#ifndef BESPOKE_TESTS_DIST_TUBE_H
#define BESPOKE_TESTS_DIST_TUBE_H

#include <stdint.h>

/* Opens the library at `path` with these flags of dlopen; ends the program where that fails. */
void *tube_open(const char *path, int flags);

/* Room for a message. */
#define TUBE_MESSAGE 1000

/* Dresses with this many threads. Gives the status of the run, with the library's message where it failed, else with what
   tube_dress says. */
unsigned tube_try(void *library, unsigned thread_count, uint64_t *hash, char message[TUBE_MESSAGE]);

/* Dresses, and says what came out: FNV-1a of the 32-bit coordinates. Ends the program where the library refuses. */
uint64_t tube_dress(void *library);

/* Ends the program with a sentence. */
void tube_fail(const char *format, ...);

#endif
