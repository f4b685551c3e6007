/* Which joints of two rigs correspond, as a text file. */
#ifndef JOINT_MAP_H
#define JOINT_MAP_H

#include "inputs.h"
#include "session.h"

/* One line for each joint of the source rig: both joints with their names, why, how sure that is, and the part of the body. */
bool joint_map_write(Session *session, const Inputs *inputs, const char *path);

#endif
