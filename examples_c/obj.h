/* Wavefront OBJ: the geometry of a file, and the file itself again with moved vertices.

   Read: v (x y z, further numbers are kept but not used), f (polygons become fans, v/vt/vn in all forms, negative
   indices), l (polylines become segments). All else is carried along unread.

   Written: the same lines in the same order, with the moved coordinates in the v lines. Vertex normals are those that are
   given, or computed afresh, since the surface has moved: each corner of a face keeps sharing its normal with the corners it shared it
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
    uint32_t *normal_vn; /* for each normal to be written, the vn of the file that it is, from 0 */
    float *vn;           /* three for each vn line; 0 where it has no three numbers */
    size_t vn_count;
} Obj;

/* False, with a message that has the path and the line, where the file cannot be used; nothing is to free then. */
bool obj_read(Obj *obj, const char *path, Message *message);

/* Writes the file with other positions (three floats a vertex, in the order of the v lines) and, unless null, with these
   normals, three floats each; `comment`, unless null, is a line on top. */
bool obj_write(const Obj *obj, const float *positions, const float *normals, const char *comment, FILE *file,
               Message *message);

/* The triangles by vertices that are split where normals differ, three each: number k has normal k of those to be written,
   and after these there is one for each vertex, for corners without a normal. `normals` gets the file's own, three for each
   of both, 0 where there is none. */
void obj_render_mesh(const Obj *obj, uint32_t *triangles, float *normals);

void obj_free(Obj *obj);

#endif
