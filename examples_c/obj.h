/* Wavefront OBJ: the geometry of a file, and the file itself again with moved vertices.

   Read: v (x y z, further numbers are kept but not used), f (polygons become fans, v/vt/vn in all forms, negative
   indices), l (polylines become segments). All else is carried along unread.

   Written: the same lines in the same order, with the moved coordinates in the v lines. Vertex normals are computed
   afresh, since the surface has moved: each corner of a face keeps sharing its normal with the corners it shared it
   with (same v and same vn), so hard edges stay hard. They are written in front of the first face, in the order of
   their first use, and the faces count them so. */
#ifndef OBJ_H
#define OBJ_H

#include "output.h"
#include "text.h"

#define OBJ_NO_NORMAL UINT32_MAX

typedef struct Corner {
    uint32_t vertex;
    uint32_t normal; /* which of the normals to be written, or OBJ_NO_NORMAL */
} Corner;

typedef struct Obj {
    Text text;
    float *positions; /* three a vertex */
    size_t vertex_count;
    uint32_t *triangles; /* three vertices each */
    size_t triangle_count;
    uint32_t *segments; /* two vertices each */
    size_t segment_count;
    Corner *corners; /* of all faces, one after another */
    size_t corner_count;
    uint32_t *face_sizes; /* corners of each face */
    size_t face_count;
    size_t normal_count;
} Obj;

/* False, with a message that has the path and the line, where the file cannot be used; nothing is to free then. */
bool obj_read(Obj *obj, const char *path, Message *message);

/* Writes the file with other positions (three floats a vertex, in the order of the v lines); `comment`, unless null, is a
   line on top. */
bool obj_write(const Obj *obj, const float *positions, const char *comment, FILE *file, Message *message);

void obj_free(Obj *obj);

#endif
