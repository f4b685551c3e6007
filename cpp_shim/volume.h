// Voxelisation of a triangle soup by OpenVDB behind a C interface: the sign of the distance at lattice nodes.
//
// Coordinates are in voxels: the lattice node (i, j, k) is the point (i, j, k).
#ifndef BESPOKE_CPP_SHIM_VOLUME_H
#define BESPOKE_CPP_SHIM_VOLUME_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    BESPOKE_VOLUME_OK = 0,
    // `cancelled` returned non-zero; there is no volume.
    BESPOKE_VOLUME_CANCELLED = 1,
    // OpenVDB or the standard library threw; the message is the exception's.
    BESPOKE_VOLUME_FAILED = 2,
    // A null pointer, an index out of range, a coordinate outside the lattice, a bad width.
    BESPOKE_VOLUME_INVALID = 3
};

// Nodes along one side of the cubes that are read at once.
enum { BESPOKE_VOLUME_BLOCK = 8 };

typedef struct BespokeVolume BespokeVolume;

// Returns non-zero to stop. Called from several threads at once; must not throw.
typedef int (*BespokeVolumeCancelled)(const void* context);

// Builds a volume from `point_count` points (x, y, z each; single precision is enough for the sign) and
// `triangle_count` index triples. Distances are kept up to `outside_band` and `inside_band` voxels from the surface,
// the sign everywhere.
// At most `threads` threads work (at least one). On failure `*volume` is null, and `message` (of
// `message_capacity` bytes, may be null with 0) holds a terminated string. Nothing is ever thrown.
int bespoke_volume_build(const float* points, size_t point_count, const uint32_t* triangles,
                         size_t triangle_count, float outside_band, float inside_band, uint32_t threads,
                         BespokeVolumeCancelled cancelled, const void* context, BespokeVolume** volume,
                         char* message, size_t message_capacity);

// Reads the 8 x 8 x 8 nodes from `origin` on (each coordinate a multiple of 8) into `values`. Node (i, j, k) of the
// block is entry 64 i + 8 j + k.
// A value is in voxels, negative inside; beyond the band it is the width of that band.
// Safe from several threads at once.
void bespoke_volume_read_block(const BespokeVolume* volume, const int32_t origin[3], float* values);

// Memory held by the volume, in bytes.
uint64_t bespoke_volume_memory(const BespokeVolume* volume);

// Frees a volume; null is ignored.
void bespoke_volume_destroy(BespokeVolume* volume);

#ifdef __cplusplus
}
#endif

#endif
