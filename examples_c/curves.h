/* Curves of the garment that keep their shape and place, from a file. */
#ifndef CURVES_H
#define CURVES_H

#include "session.h"

/* A line a curve: open or closed, its two weights, and its vertices (from 0) in order. False, with a message in the
   session, where the file cannot be read or the library refuses a curve. */
bool curves_add(Session *session, const char *path);

#endif
