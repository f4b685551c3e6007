/* Rigs and skin weights on them, as text files. */
#ifndef RIG_H
#define RIG_H

#include <stdio.h>

#include "bespoke.h"
#include "text.h"

/* One line a joint: joint NAME PARENT m0 .. m15. The name may hold blanks; the parent is a joint counted from 0, or -1; the
   bind transform goes column after column. Everything after a # at the beginning of a word is a comment. */
typedef struct Rig {
    BespokeJoint *joints; /* their names are in `names` */
    size_t count;
    char *names;
} Rig;

bool rig_read(Rig *rig, const char *path, Message *message);
void rig_free(Rig *rig);

/* One line of such a file. */
void rig_write_joint(FILE *file, const char *name, uint32_t parent, const double bind[BESPOKE_TRANSFORM_SIZE]);

/* One line a vertex: pairs of a joint and its weight. */
typedef struct Influences {
    uint32_t *joints; /* `width` for each vertex, those that its line lacks with weight 0 */
    float *weights;
    size_t count;
    size_t width;
} Influences;

bool influences_read(Influences *influences, const char *path, Message *message);
void influences_free(Influences *influences);

#endif
