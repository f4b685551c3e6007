/* What goes along with the garment: meshes that follow it, its morphs, and its answers to morphs of the avatar. Each is
   written beside the garment: x.obj has x.follower-0.obj, x.garment-morph-0.obj and x.target-morph-0.obj, the morphs at
   weight 1. */
#ifndef FOLLOW_H
#define FOLLOW_H

#include "inputs.h"
#include "options.h"
#include "output.h"
#include "session.h"

/* Reads the files and hands them to the library. False, with a message in the session, where one cannot be used. */
bool follow_set(Session *session, Inputs *inputs, const Options *options);

/* Solves the answers to the avatar's morphs, where there are any. */
bool follow_solve(Session *session, const Options *options);

/* How many files there are at most. */
size_t follow_count(const Options *options);

/* Writes them whole, but under other names. `outputs` has room for all. A morph without an answer has no file. */
bool follow_write(Output *outputs, Session *session, const Inputs *inputs, const Options *options);

#endif
