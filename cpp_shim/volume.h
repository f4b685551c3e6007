// Voxelisation of a triangle soup by OpenVDB behind a C interface: the sign of the distance at lattice nodes.
//
// Coordinates are in voxels: the lattice node (i, j, k) is the point (i, j, k).
//
// One call does it all, and hands over plain numbers: nothing of OpenVDB or oneTBB is left when it returns, neither
// memory nor threads. Whatever either of them throws becomes what the call returns.
#ifndef BESPOKE_CPP_SHIM_VOLUME_H
#define BESPOKE_CPP_SHIM_VOLUME_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    BESPOKE_VOLUME_OK = 0,
    // `cancelled` returned non-zero.
    BESPOKE_VOLUME_CANCELLED = 1,
    // OpenVDB or the standard library threw; the message is the exception's.
    BESPOKE_VOLUME_FAILED = 2,
    // A null pointer, an index out of range, a coordinate outside the lattice, a bad width.
    BESPOKE_VOLUME_INVALID = 3
};

// Nodes along one side of a block.
enum { BESPOKE_VOLUME_BLOCK = 8 };

// Returns non-zero to stop. Called from several threads at once; must not throw.
typedef int (*BespokeVolumeCancelled)(const void* context);

// Takes a cube of `side` nodes along each axis, the lowest of which is `origin`, that lies inside in whole or in part.
// Its coordinates are multiples of `side`. A block (side 8) comes with its nodes: bit 8 j + k of `inside[i]` is set where
// node (i, j, k) of the block lies inside. A larger cube lies inside as a whole, and `inside` is null.
// Called from one thread, for each cube once; must not throw.
typedef void (*BespokeVolumeCube)(void* cubes, const int32_t origin[3], uint32_t side, const uint64_t* inside);

// Voxelises `point_count` points (x, y, z each; single precision is enough for the sign) and `triangle_count` index
// triples, and hands every cube with nodes inside to `cube`. `band` is the width, in voxels, of the layer on either side
// of the surface in which OpenVDB computes distances, at least 1.
// The calling thread works, and up to `threads - 1` others that are started for it and end with the call; where they
// cannot be started, fewer do.
// On failure `message` (of `message_capacity` bytes, may be null with 0) holds a terminated string. Nothing is ever
// thrown.
int bespoke_volume_build(const float* points, size_t point_count, const uint32_t* triangles, size_t triangle_count,
                         float band, uint32_t threads, BespokeVolumeCancelled cancelled, const void* context,
                         BespokeVolumeCube cube, void* cubes, char* message, size_t message_capacity);

#ifdef __cplusplus
}
#endif

#endif
