/* A coordinate system as a word of the command line: right, up and forward, the unit, and whether it is trusted. */
#ifndef SPACE_H
#define SPACE_H

#include "bespoke.h"
#include "text.h"

/* `option` names the option in the message. */
bool space_read(BespokeCoordinateSystem *space, const char *option, const char *value, Message *message);

#endif
