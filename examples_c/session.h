/* A session of the library, and what went wrong last: a call of the library, or a file. */
#ifndef SESSION_H
#define SESSION_H

#include "bespoke.h"
#include "text.h"

typedef struct Session {
    BespokeSession *handle;
    BespokeControl *control;
    /* Of the call that failed; OK where none did, as with a file that cannot be read. */
    BespokeStatus status;
    Message message;
    double start;
} Session;

/* False, with a message, where the library cannot be used. session_close is to be called in either case. */
bool session_open(Session *session);
void session_close(Session *session);

/* Whether the call went well; if not, keeps its status and message, with the file that it is about where there is one. */
bool session_good(Session *session, BespokeStatus status, const char *path);

/* Seconds since session_open. */
double session_seconds(const Session *session);

/* A packed array. */
BespokeView view_of(const void *data, size_t count, uint32_t component);

#endif
