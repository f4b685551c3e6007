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

#include "team.h"

namespace {

// Lattice coordinates are 32-bit, and the voxeliser adds to them, so the limit is well below theirs.
constexpr float MAX_COORDINATE = 1e8f;

// OpenVDB's library has the voxeliser instantiated for the adapter and the interrupter below: with other types this
// file would take five times as long to build.
using Soup = openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>;

using Tree = openvdb::FloatTree;
using Leaf = Tree::LeafNodeType;
static_assert(Leaf::DIM == BESPOKE_VOLUME_BLOCK, "a block is one leaf");

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

int fail(int code, const char* text, char* message, size_t capacity) noexcept {
    if (message && capacity > 0) {
        std::strncpy(message, text, capacity - 1);
        message[capacity - 1] = '\0';
    }
    return code;
}

// The only way from C to OpenVDB and oneTBB: all that `work` does, destructors included, happens within a team, so that no
// parallel loop makes TBB start a thread of its own, and what is thrown ends here.
// `work` returns a code; what it says besides goes to its argument.
template <class Work>
int guarded(unsigned threads, char* message, size_t capacity, const Work& work) noexcept {
    try {
        int code = BESPOKE_VOLUME_FAILED;
        const char* text = "";
        Team(threads).run([&] { code = work(text); });
        return fail(code, text, message, capacity);
    } catch (const std::exception& e) {
        return fail(BESPOKE_VOLUME_FAILED, e.what(), message, capacity);
    } catch (...) {
        return fail(BESPOKE_VOLUME_FAILED, "an unknown C++ exception", message, capacity);
    }
}

const char* defect(const float* points, size_t point_count, const uint32_t* triangles, size_t triangle_count,
                   float band) {
    if (!points || !triangles || triangle_count == 0) {
        return "there are no triangles";
    }
    if (!(band >= 1.0f && std::isfinite(band))) {
        return "the band is narrower than one voxel or not finite";
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

openvdb::FloatGrid::Ptr voxelise(const float* points, size_t point_count, const uint32_t* triangles,
                                 size_t triangle_count, float band, Interrupter& interrupter) {
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
    openvdb::util::NullInterrupter& any_interrupter = interrupter;
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    // Renormalisation would move the surface by a fraction of a voxel.
    return openvdb::tools::meshToVolume<openvdb::FloatGrid>(any_interrupter, soup, *transform, band, band,
                                                            openvdb::tools::DISABLE_RENORMALIZATION);
}

void hand_over(const Tree& tree, BespokeVolumeCube cube, void* cubes) {
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        uint64_t inside[BESPOKE_VOLUME_BLOCK] = {};
        bool any = false;
        for (openvdb::Index n = 0; n < Leaf::SIZE; ++n) {
            const bool is_inside = leaf->getValue(n) < 0.0f;
            inside[n / 64] |= uint64_t{is_inside} << n % 64;
            any |= is_inside;
        }
        if (any) {
            cube(cubes, leaf->origin().data(), BESPOKE_VOLUME_BLOCK, inside);
        }
    }
    // One number for a cube of many nodes: what is far from the surface.
    const uint64_t whole[BESPOKE_VOLUME_BLOCK] = {~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull};
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        if (tile.getValue() < 0.0f) {
            const openvdb::CoordBBox box = tile.getBoundingBox();
            const auto side = static_cast<uint32_t>(box.dim().x());
            cube(cubes, box.min().data(), side, side == BESPOKE_VOLUME_BLOCK ? whole : nullptr);
        }
    }
}

} // namespace

int bespoke_volume_build(const float* points, size_t point_count, const uint32_t* triangles, size_t triangle_count,
                         float band, uint32_t threads, BespokeVolumeCancelled cancelled, const void* context,
                         BespokeVolumeCube cube, void* cubes, char* message, size_t message_capacity) {
    return guarded(threads, message, message_capacity, [&](const char*& text) -> int {
        text = cube ? defect(points, point_count, triangles, triangle_count, band) : "there is no place for the result";
        if (text) {
            return BESPOKE_VOLUME_INVALID;
        }
        Interrupter interrupter(cancelled, context);
        const auto grid = voxelise(points, point_count, triangles, triangle_count, band, interrupter);
        if (interrupter.wasInterrupted()) {
            text = "cancelled";
            return BESPOKE_VOLUME_CANCELLED;
        }
        hand_over(grid->constTree(), cube, cubes);
        text = "";
        return BESPOKE_VOLUME_OK;
    });
}
