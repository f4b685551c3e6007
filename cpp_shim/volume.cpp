// The one translation unit that includes OpenVDB: its headers take most of a C++ build.
#include "volume.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <vector>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/task_arena.h>

struct BespokeVolume {
    openvdb::FloatGrid::Ptr grid;
};

namespace {

// Lattice coordinates are 32-bit, and the voxeliser adds to them, so the limit is well below theirs.
constexpr float MAX_COORDINATE = 1e8f;

// OpenVDB's library has the voxeliser instantiated for the adapter and the interrupter below: with other types this
// file would take five times as long to build.
using Soup = openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>;

// Stays interrupted once it was, so that an incomplete grid is never taken for a complete one.
class Interrupter final : public openvdb::util::NullInterrupter {
public:
    Interrupter(BespokeVolumeCancelled cancelled, const void* context)
        : cancelled_(cancelled), context_(context) {}

    bool wasInterrupted(int = -1) override {
        if (!stopped_.load(std::memory_order_relaxed) && cancelled_ && cancelled_(context_) != 0) {
            stopped_.store(true, std::memory_order_relaxed);
        }
        return stopped_.load(std::memory_order_relaxed);
    }

private:
    BespokeVolumeCancelled cancelled_;
    const void* context_;
    std::atomic<bool> stopped_{false};
};

int fail(int code, const char* text, char* message, size_t capacity) {
    if (message && capacity > 0) {
        std::strncpy(message, text, capacity - 1);
        message[capacity - 1] = '\0';
    }
    return code;
}

const char* defect(const float* points, size_t point_count, const uint32_t* triangles, size_t triangle_count,
                   float outside_band, float inside_band) {
    if (!points || !triangles || triangle_count == 0) {
        return "there are no triangles";
    }
    if (!(outside_band >= 1.0f && std::isfinite(outside_band) && inside_band >= 1.0f && std::isfinite(inside_band))) {
        return "a band is narrower than one voxel or not finite";
    }
    for (size_t i = 0; i < 3 * point_count; ++i) {
        if (!(std::fabs(points[i]) <= MAX_COORDINATE)) {
            return "a point lies outside the lattice";
        }
    }
    for (size_t i = 0; i < 3 * triangle_count; ++i) {
        if (triangles[i] >= point_count) {
            return "a triangle has an index out of range";
        }
    }
    return nullptr;
}

} // namespace

int bespoke_volume_build(const float* points, size_t point_count, const uint32_t* triangles,
                         size_t triangle_count, float outside_band, float inside_band, uint32_t threads,
                         BespokeVolumeCancelled cancelled, const void* context, BespokeVolume** volume,
                         char* message, size_t message_capacity) {
    if (!volume) {
        return fail(BESPOKE_VOLUME_INVALID, "there is no place for the volume", message, message_capacity);
    }
    *volume = nullptr;
    if (const char* text = defect(points, point_count, triangles, triangle_count, outside_band, inside_band)) {
        return fail(BESPOKE_VOLUME_INVALID, text, message, message_capacity);
    }
    try {
        // openvdb::initialize() would only register types by name for reading files, and link all of them.
        std::vector<openvdb::Vec3s> positions(point_count);
        for (size_t i = 0; i < point_count; ++i) {
            positions[i] = openvdb::Vec3s(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        }
        std::vector<openvdb::Vec3I> corners(triangle_count);
        for (size_t i = 0; i < triangle_count; ++i) {
            corners[i] = openvdb::Vec3I(triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]);
        }
        const Soup soup(positions, corners);
        Interrupter interrupter(cancelled, context);
        openvdb::util::NullInterrupter& any_interrupter = interrupter;
        const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
        openvdb::FloatGrid::Ptr grid;
        // With more threads than the machine has, TBB would print a warning to the standard error of the host.
        const int most = tbb::this_task_arena::max_concurrency();
        tbb::task_arena arena(std::clamp(static_cast<int>(std::min(threads, 1024u)), 1, std::max(most, 1)));
        arena.execute([&] {
            // Renormalisation would move the surface by a fraction of a voxel.
            grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(any_interrupter, soup, *transform, outside_band,
                                                                    inside_band,
                                                                    openvdb::tools::DISABLE_RENORMALIZATION);
        });
        if (interrupter.wasInterrupted()) {
            return fail(BESPOKE_VOLUME_CANCELLED, "cancelled", message, message_capacity);
        }
        *volume = new BespokeVolume{grid};
        return BESPOKE_VOLUME_OK;
    } catch (const std::exception& e) {
        return fail(BESPOKE_VOLUME_FAILED, e.what(), message, message_capacity);
    } catch (...) {
        return fail(BESPOKE_VOLUME_FAILED, "an unknown C++ exception", message, message_capacity);
    }
}

void bespoke_volume_read_block(const BespokeVolume* volume, const int32_t origin[3], float* values) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    static_assert(Leaf::DIM == BESPOKE_VOLUME_BLOCK, "a block is one leaf");
    const openvdb::Coord at(origin[0], origin[1], origin[2]);
    const openvdb::FloatTree& tree = volume->grid->constTree();
    if (const Leaf* leaf = tree.probeConstLeaf(at)) {
        for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
            values[i] = leaf->getValue(i);
        }
        return;
    }
    // No leaf: one tile or the background covers the whole block.
    std::fill_n(values, Leaf::SIZE, tree.getValue(at));
}

uint64_t bespoke_volume_memory(const BespokeVolume* volume) { return volume->grid->memUsage(); }

void bespoke_volume_destroy(BespokeVolume* volume) { delete volume; }
