/* What parts of the avatar are to the garment, told by the names that its file gives them. */
#ifndef PARTS_H
#define PARTS_H

#include "obj.h"
#include "options.h"
#include "session.h"

/* Hands the roles over that the command line gives to objects (o), groups (g) and materials (usemtl) of the avatar; nothing
   where it gives none. False, with a message in the session, where a name is not in the file or the library refuses. */
bool parts_set(Session *session, const Obj *avatar, const Options *options);

#endif
