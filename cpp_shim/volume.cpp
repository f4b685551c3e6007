// The one translation unit that includes OpenVDB: its headers take most of a C++ build.
#include "volume.h"

#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/task_arena.h>

struct BespokeVolume {
    openvdb::FloatGrid::Ptr grid;
};

namespace {

// Lattice coordinates are 32-bit, and the voxeliser adds to them; far below the limit is far enough.
constexpr double MAX_COORDINATE = 1e8;

struct Soup {
    const double* points;
    const uint32_t* triangles;
    size_t point_total;
    size_t triangle_total;

    size_t polygonCount() const { return triangle_total; }
    size_t pointCount() const { return point_total; }
    size_t vertexCount(size_t) const { return 3; }
    void getIndexSpacePoint(size_t polygon, size_t corner, openvdb::Vec3d& position) const {
        const double* p = points + 3 * size_t(triangles[3 * polygon + corner]);
        position = openvdb::Vec3d(p[0], p[1], p[2]);
    }
};

// Remembers that it was asked to stop, so that a half-built grid is never taken for a whole one.
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

const char* defect(const Soup& soup, float outside_band, float inside_band) {
    if (!soup.points || !soup.triangles || soup.triangle_total == 0) {
        return "there are no triangles";
    }
    if (!(outside_band >= 1.0f && std::isfinite(outside_band) && inside_band >= 1.0f && std::isfinite(inside_band))) {
        return "a band is narrower than one voxel or not finite";
    }
    for (size_t i = 0; i < 3 * soup.point_total; ++i) {
        if (!(std::fabs(soup.points[i]) <= MAX_COORDINATE)) {
            return "a point lies outside the lattice";
        }
    }
    for (size_t i = 0; i < 3 * soup.triangle_total; ++i) {
        if (soup.triangles[i] >= soup.point_total) {
            return "a triangle has an index out of range";
        }
    }
    return nullptr;
}

std::once_flag initialised;

} // namespace

int bespoke_volume_build(const double* points, size_t point_count, const uint32_t* triangles,
                         size_t triangle_count, float outside_band, float inside_band, uint32_t threads,
                         BespokeVolumeCancelled cancelled, const void* context, BespokeVolume** volume,
                         char* message, size_t message_capacity) {
    if (!volume) {
        return fail(BESPOKE_VOLUME_INVALID, "there is no place for the volume", message, message_capacity);
    }
    *volume = nullptr;
    const Soup soup{points, triangles, point_count, triangle_count};
    if (const char* text = defect(soup, outside_band, inside_band)) {
        return fail(BESPOKE_VOLUME_INVALID, text, message, message_capacity);
    }
    try {
        std::call_once(initialised, [] { openvdb::initialize(); });
        Interrupter interrupter(cancelled, context);
        const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
        openvdb::FloatGrid::Ptr grid;
        tbb::task_arena arena(threads > 0 ? static_cast<int>(threads) : 1);
        arena.execute([&] {
            // Renormalisation would move the surface by a fraction of a voxel.
            grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(interrupter, soup, *transform, outside_band,
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

void bespoke_volume_read_block(const BespokeVolume* volume, const int32_t origin[3], float* values,
                               uint8_t* active) {
    using Leaf = openvdb::FloatTree::LeafNodeType;
    static_assert(Leaf::DIM == BESPOKE_VOLUME_BLOCK, "a block is one leaf");
    const openvdb::Coord at(origin[0], origin[1], origin[2]);
    const openvdb::FloatTree& tree = volume->grid->constTree();
    if (const Leaf* leaf = tree.probeConstLeaf(at)) {
        for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
            values[i] = leaf->getValue(i);
            if (active) {
                active[i] = leaf->isValueOn(i) ? 1 : 0;
            }
        }
        return;
    }
    // No leaf: one tile or the background covers the whole block.
    float value = 0.0f;
    const bool on = tree.probeValue(at, value);
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
        values[i] = value;
        if (active) {
            active[i] = on ? 1 : 0;
        }
    }
}

uint64_t bespoke_volume_active_count(const BespokeVolume* volume) { return volume->grid->activeVoxelCount(); }

uint64_t bespoke_volume_memory(const BespokeVolume* volume) { return volume->grid->memUsage(); }

void bespoke_volume_destroy(BespokeVolume* volume) { delete volume; }
