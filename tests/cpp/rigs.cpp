/* Rigs: joints in and the map of joints out, pairs in every type of index, and what is refused. */
#include "check.hpp"

#include <algorithm>

namespace {

using namespace bespoke;

struct Weighted {
    std::uint16_t joints[2];
    float weights[2];
};

Joint joint(std::string name, std::optional<std::uint32_t> parent, const Triple<double> &place) {
    Joint made;
    made.name = std::move(name);
    made.parent = parent;
    std::copy(place.begin(), place.end(), &made.bind[12]);
    return made;
}

/// Two legs and what is above them, in the names of one tool, `scale` tall. A child may come before its parent.
std::vector<Joint> rig(double scale, const std::string &hips, const std::array<std::string, 3> &leg, bool reversed) {
    const std::array<std::string, 2> sides = leg[0] == "UpLeg" ? std::array<std::string, 2>{"Left", "Right"}
                                                               : std::array<std::string, 2>{"left", "right"};
    std::vector<Joint> joints{joint(hips, std::nullopt, {0, scale, 0})};
    for (std::size_t side = 0; side < 2; side++) {
        const double x = scale * (side == 0 ? 0.1 : -0.1);
        for (std::uint32_t k = 0; k < 3; k++) {
            const auto parent = static_cast<std::uint32_t>(k == 0 ? 0 : joints.size() - 1);
            joints.push_back(joint(sides[side] + leg[k], parent, {x, scale * (0.95 - 0.45 * k), 0}));
        }
    }
    if (!reversed) return joints;
    std::reverse(joints.begin(), joints.end());
    const auto last = static_cast<std::uint32_t>(joints.size() - 1);
    for (Joint &one : joints) {
        if (one.parent) one.parent = last - *one.parent;
    }
    return joints;
}

std::vector<Joint> source_rig() { return rig(1.0, "Hips", {"UpLeg", "Leg", "Foot"}, false); }
std::vector<Joint> target_rig() { return rig(1.3, "hips", {"UpperLeg", "LowerLeg", "Foot"}, true); }

/// By names, in another order and with another naming; the caller's pairs win.
void maps() {
    Session session = Session::create().value();
    REFUSED(session.read_joint_map(), Status::invalid_state, "source rig");
    ACCEPTED(session.set_source_rig(source_rig()));
    REFUSED(session.read_joint_map(), Status::invalid_state, "target rig");
    ACCEPTED(session.set_target_rig(target_rig()));
    const auto map = session.read_joint_map().value();
    CHECK(map.size() == 7);
    for (std::uint32_t k = 0; k < 7; k++) {
        CHECK(map[k].target == 6 - k && map[k].reason == JointReason::name);
        CHECK(map[k].confidence > 0.5 && map[k].confidence <= 1.0);
    }
    CHECK(map[0].part == "hips" && map[1].part == "left upper leg" && map[6].part == "right foot");

    // The last pairs count, in each type.
    ACCEPTED(session.set_joint_pairs(std::array<std::uint32_t, 4>{1, 5, 6, no_joint}));
    ACCEPTED(session.set_joint_pairs(std::array<std::int32_t, 4>{3, 4, 6, -1}));
    ACCEPTED(session.set_joint_pairs(std::array<std::uint16_t, 4>{3, 4, 6, 65535}));
    const auto mended = session.read_joint_map().value();
    CHECK(mended[3].target == 4u && mended[3].reason == JointReason::caller && mended[3].confidence == 1.0);
    CHECK(!mended[6].target && mended[6].reason == JointReason::caller);
    CHECK(mended[1].target == 5u && mended[1].reason == JointReason::name);
    ACCEPTED(session.set_joint_pairs({}));
    CHECK(session.read_joint_map().value()[3].target == 3u);
}

/// A shirt under a jacket, and what passes through what.
void outfits() {
    const Scene scene;
    std::vector<Triple<double>> jacket, shirt;
    for (const auto &p : scene.garment.points) {
        jacket.push_back({p[0], p[1], p[2]});
        shirt.push_back({0.8 * p[0], p[1], 0.8 * p[2]});
    }
    Session session = Session::create().value();
    ACCEPTED(session.add_outfit_garment(jacket, scene.garment.triangles));
    ACCEPTED(session.clear_outfit());
    CHECK(session.read_outfit_order().value().empty() && session.read_worn_pairs().value().empty());
    ACCEPTED(session.add_outfit_garment(jacket, scene.garment.triangles));
    ACCEPTED(session.add_outfit_garment(shirt, scene.garment.triangles));
    CHECK((session.read_outfit_order().value() == std::vector<std::uint32_t>{1, 0}));
    const auto pairs = session.read_worn_pairs().value();
    CHECK(pairs.size() == 1 && pairs[0].inner == 1 && pairs[0].outer == 0 && !pairs[0].is_overruled);
    const auto &corners = scene.garment.triangles;
    CHECK(session.find_intersections(jacket, corners, shirt, corners).value().empty());
    CHECK(session.find_intersections(jacket, corners).value().empty());
    const std::vector<Triple<double>> across{{-3, 0.011, -3}, {9, 0.012, -3}, {-3, 0.013, 9}};
    const std::vector<Triple<std::uint32_t>> one{{0, 1, 2}}, wrong{{0, 1, 7}};
    const auto cut = session.find_intersections(jacket, corners, across, one).value();
    CHECK(!cut.empty() && cut[0][1] == 0);
    REFUSED(session.find_intersections(jacket, corners, across, wrong), Status::invalid_mesh, "second mesh");
}

void key_poses() {
    std::vector<std::array<double, BESPOKE_TRANSFORM_SIZE>> still(7);
    for (auto &transform : still) {
        for (std::size_t k = 0; k < transform.size(); k += 5) transform[k] = 1.0;
    }
    Session session = Session::create().value();
    REFUSED(session.add_key_pose("still", still), Status::invalid_state, "target rig");
    ACCEPTED(session.set_target_rig(target_rig()));
    ACCEPTED(session.add_key_pose("still", still));
    REFUSED(session.solve_pose_corrections(4), Status::invalid_state, "result");
    REFUSED(session.read_pose_correction(0), Status::invalid_state, "still");
    still.resize(2);
    REFUSED(session.add_key_pose("short", still), Status::invalid_argument, "2 joints");
    REFUSED(session.add_key_pose("none", {}), Status::invalid_argument, "0 joints");
    ACCEPTED(session.clear_key_poses());
}

void rigs_refused() {
    Session session = Session::create().value();
    REFUSED(session.set_source_rig({}), Status::invalid_skeleton, "source rig");
    REFUSED(session.read_added_joints(), Status::invalid_state, "result");
    REFUSED(session.read_garment_skin_influences(4), Status::invalid_state, "prepare");
    REFUSED(session.read_covered_triangles(), Status::invalid_state, "result");
    REFUSED(session.read_covered_triangles({0u, 2, 0.5}), Status::invalid_state, "result");
    REFUSED(session.read_pose_transforms(), Status::invalid_state, "target rig");
    auto joints = source_rig();
    joints[2].parent = 70;
    REFUSED(session.set_source_rig(joints), Status::invalid_skeleton, "joint 2");
    joints[2].parent = 3;
    REFUSED(session.set_target_rig(joints), Status::invalid_skeleton, "circle");
    joints[2].parent = 1;
    joints[2].bind[13] = NAN;
    REFUSED(session.set_target_rig(joints), Status::invalid_skeleton, "\"LeftLeg\"");
    const std::array<std::uint32_t, 3> odd{0, 1, 2};
    REFUSED(session.set_joint_pairs(odd), Status::invalid_argument, "joint pairs: there are 3 numbers");
    const std::vector<float> ten(10);
    REFUSED(session.set_source_skin_influences({odd, 3}, {ten, 10}, 3), Status::invalid_argument, "source skin");
    REFUSED(session.set_garment_skin_influences({odd, 3}, {ten, 5}, 3), Status::invalid_argument, "garment skin");
    // Refused for what the rig does not have, when both are known.
    ACCEPTED(session.set_source_rig(source_rig()));
    ACCEPTED(session.set_target_rig(target_rig()));
    ACCEPTED(session.set_joint_pairs(std::array<std::uint32_t, 2>{0, 9}));
    REFUSED(session.read_joint_map(), Status::invalid_argument, "joint 9 of the target rig");
}

/// A skeleton beside a rig is a rig without names; weights are counted.
void skeletons_and_skins() {
    const Scene scene;
    Session session = session_with(scene);
    const std::vector<Joint> joints{joint("", std::nullopt, scene.joints[1]), joint("", 0, scene.joints[0]),
                                    joint("", 0, scene.joints[2])};
    ACCEPTED(session.set_source_rig(joints));
    CHECK(session.read_joint_map().value().size() == 3);
    std::vector<Weighted> vertices(scene.garment.points.size());
    for (Weighted &v : vertices) v = {{0, 1}, {0.5f, 0.5f}};
    ACCEPTED(session.set_garment_skin_influences({vertices, &Weighted::joints}, {vertices, &Weighted::weights}, 3));
    ACCEPTED(session.set_source_skin_influences({vertices, &Weighted::joints}, {vertices, &Weighted::weights}, 3));
    ACCEPTED(session.set_garment_skin_influences({vertices, &Weighted::joints}, {vertices, &Weighted::weights}, 4));
    REFUSED(session.prepare(), Status::invalid_weights, "garment skin weights");
    // The skeleton takes the rig's place, as before.
    ACCEPTED(session.set_source_skeleton(scene.joints, scene.bones));
    ACCEPTED(session.run());
}

} // namespace

void rigs() {
    maps();
    rigs_refused();
    skeletons_and_skins();
    outfits();
    key_poses();
}
