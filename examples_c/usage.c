#include "options.h"

const char usage_begin[] =
    "usage: retarget --garment g.obj --source-skeleton s.obj --avatar a.obj --target-skeleton t.obj [options] -o out.obj\n"
    "\n"
    "Fits a garment that was modelled on one body to another body, with no triangle through another.\n"
    "\n";

const char usage_end[] =
    "\n"
    "What the library has to say about garment and avatar goes to standard error: warnings, and where there is no result\n"
    "errors and notes as well; at most eight lines, three of a kind. --report lists all, with vertices and triangles.\n"
    "\n"
    "OBJ files are read with 32-bit coordinates. The output is the garment's file with moved vertices: order, faces,\n"
    "UVs, groups and materials stay. Vertex normals are computed afresh; corners that shared one still share one, and\n"
    "the faces count them in the order of their first use. Polygons are fans when it comes to contacts.\n"
    "\n"
    "Exit: 0 with a verified result, 1 without one, 2 for a wrong command line, 3 with a verified result that is not worn\n"
    "as designed (a limb shut up in it or beside it, a piece that lost its size), 128 + n when stopped by signal n\n"
    "(130 for Ctrl-C). Files appear whole or not at all.\n";
