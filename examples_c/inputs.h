/* The files that the command line names, read and handed to the library. */
#ifndef INPUTS_H
#define INPUTS_H

#include "obj.h"
#include "options.h"
#include "rig.h"
#include "session.h"

/* What is needed again when the results are written. */
typedef struct Inputs {
    Obj garment;
    Obj avatar;
    /* Where there are none, they have no joints. */
    Rig source_rig;
    Rig target_rig;
    /* Meshes that follow the garment. */
    Obj *followers;
    size_t follower_count;
} Inputs;

/* False, with a message in the session, where a file cannot be read or the library refuses what it holds. Whatever it
   says, inputs_free is to be called afterwards. */
bool inputs_set(Inputs *inputs, Session *session, const Options *options);

void inputs_free(Inputs *inputs);

#endif
