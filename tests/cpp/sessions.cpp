/* Sessions: who owns the handle, the whole way against the C API, and what is read on it. */
#include "check.hpp"

#include <atomic>
#include <thread>

namespace {

using namespace bespoke;

static_assert(!std::is_copy_constructible_v<Session> && !std::is_copy_assignable_v<Session>);
static_assert(!std::is_copy_constructible_v<Control> && !std::is_copy_assignable_v<Control>);
static_assert(!std::is_copy_constructible_v<Avatar> && !std::is_copy_constructible_v<Garment>);
static_assert(std::is_nothrow_move_constructible_v<Avatar> && std::is_nothrow_move_constructible_v<Garment>);
static_assert(std::is_nothrow_move_constructible_v<Session> && std::is_nothrow_move_assignable_v<Session>);
static_assert(std::is_nothrow_move_constructible_v<Control> && std::is_nothrow_move_assignable_v<Control>);
static_assert(!std::is_convertible_v<BespokeSession *, Session> && !std::is_convertible_v<Session, bool>);

/// Every call on an empty session is refused, and none of them crashes.
void empty(Session &session) {
    const Scene scene;
    const auto &points = scene.body.points;
    const auto &triangles = scene.body.triangles;
    const auto refused = [](const auto &outcome) {
        CHECK(!outcome && outcome.status() == Status::invalid_argument);
        CHECK(outcome.message().find("session is empty") != std::string::npos);
    };
    CHECK(!session && session.get() == nullptr);
    refused(session.destroy());
    refused(session.reset());
    refused(session.set_garment(points, triangles));
    refused(session.set_source_skeleton(scene.joints, scene.bones));
    refused(session.set_target_avatar(points, triangles));
    refused(session.set_target_skeleton(scene.joints, scene.bones));
    refused(session.set_source_avatar(points, triangles));
    refused(session.set_target_skin_weights({std::vector<float>(4), 2}));
    refused(session.set_target_skin_influences(triangles, points, 3));
    refused(session.set_target_skin_influences(scene.bones, points, 3));
    refused(session.set_source_rig({Joint()}));
    refused(session.set_target_rig({}));
    refused(session.set_source_skin_influences(triangles, points, 3));
    refused(session.set_garment_skin_influences(scene.bones, points, 3));
    refused(session.set_joint_pairs(scene.bones));
    refused(session.read_joint_map());
    refused(session.set_source_coordinate_system(CoordinateSystem()));
    refused(session.set_target_coordinate_system(CoordinateSystem()));
    refused(session.set_vertex_fit_weights(std::vector<float>(4)));
    refused(session.set_no_fit_vertices(std::vector<std::uint32_t>(4)));
    refused(session.set_pinned_vertices(std::vector<std::uint32_t>(4)));
    refused(session.set_pinned_vertices(std::vector<std::uint32_t>(4), std::vector<float>(12)));
    refused(session.add_rigid_group(std::vector<std::uint32_t>(4)));
    refused(session.clear_rigid_groups());
    refused(session.add_curve(std::vector<std::uint32_t>(4), true));
    refused(session.clear_curves());
    refused(session.add_layer(points, std::vector<std::uint32_t>(4)));
    refused(session.clear_layers());
    refused(session.set_options(Options()));
    refused(session.prepare());
    refused(session.step());
    refused(session.run());
    refused(session.run(StopToken()));
    refused(session.run([](const Progress &) { CHECK(false); }));
    refused(session.verify());
    refused(session.cancel());
    refused(session.read_progress());
    refused(session.create_control());
    refused(session.create_avatar());
    refused(session.create_garment());
    refused(session.use_avatar(Avatar()));
    refused(session.use_garment(Garment()));
    std::vector<float> room(12);
    refused(session.read_garment_vertices(room));
    refused(session.read_garment_vertices());
    refused(session.read_avatar_vertices(room));
    refused(session.read_avatar_vertices());
    refused(session.read_distortion(room));
    refused(session.read_distortion());
    refused(session.read_garment_normals());
    refused(session.add_garment_morph("wide", points));
    refused(session.clear_garment_morphs());
    refused(session.read_garment_morph(0));
    refused(session.add_target_morph("wide", points));
    refused(session.clear_target_morphs());
    refused(session.solve_target_morphs());
    refused(session.set_target_morph_weight(0, 1.0));
    refused(session.read_target_morph(0));
    refused(session.add_follower(points, triangles));
    refused(session.clear_followers());
    refused(session.read_follower_vertices(0));
    refused(session.read_follower_skin_influences(0, 4));
    refused(session.add_outfit_garment(points, triangles));
    refused(session.clear_outfit());
    refused(session.read_outfit_order());
    refused(session.read_worn_pairs());
    refused(session.find_intersections(points, triangles));
    refused(session.find_intersections(points, triangles, points, triangles));
    refused(session.add_key_pose("bent", {}));
    refused(session.clear_key_poses());
    refused(session.solve_pose_corrections(4));
    refused(session.read_pose_correction(0));
    refused(session.read_report());
    refused(session.read_energy(0));
    refused(session.read_energies());
    refused(session.read_diagnostics());
}

void owners() {
    Session none;
    empty(none);
    Session first = Session::create().value();
    BespokeSession *const handle = first.get();
    CHECK(first && handle != nullptr);
    Session second = std::move(first);
    CHECK(second.get() == handle);
    empty(first);
    // A session that is replaced is freed; the sanitizers would tell.
    second = Session::create().value();
    CHECK(second && second.get() != nullptr);
    second = Session();
    empty(second);
    first = Session::create().value();
    Session again(first.release());
    empty(first);
    ACCEPTED(again.reset());
    ACCEPTED(again.destroy());
    empty(again);
    Control control;
    CHECK(!control && control.get() == nullptr);
    REFUSED(control.cancel(), Status::invalid_argument, "control is empty");
    REFUSED(control.read_progress(), Status::invalid_argument, "control is empty");
    again = Session::create().value();
    control = again.create_control().value();
    Control taken = std::move(control);
    REFUSED(control.cancel(), Status::invalid_argument, "control is empty");
    bespoke_control_destroy(taken.release());
    REFUSED(taken.read_progress(), Status::invalid_argument, "control is empty");
}

/// What the C API makes of the same scene.
std::vector<Triple<float>> by_c(const Scene &scene) {
    BespokeSession *session = nullptr;
    CHECK(bespoke_session_create(&session) == BESPOKE_STATUS_OK);
    BespokeOptions options{};
    options.struct_size = sizeof options;
    options.threads = 2;
    options.voxel_size = 0.1;
    const auto floats = [](const auto &p) { return BespokeView{p.data(), p.size(), 0, BESPOKE_COMPONENT_F32}; };
    const auto indices = [](const auto &t) { return BespokeView{t.data(), t.size(), 0, BESPOKE_COMPONENT_U32}; };
    const BespokeView points = floats(scene.garment.points), triangles = indices(scene.garment.triangles);
    const BespokeView body = floats(scene.body.points), faces = indices(scene.body.triangles);
    const BespokeView joints{scene.joints.data(), 3, 0, BESPOKE_COMPONENT_F64};
    const BespokeView bones{scene.bones.data(), 2, 0, BESPOKE_COMPONENT_U16};
    CHECK(bespoke_session_set_options(session, &options) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_set_garment(session, &points, &triangles) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_set_target_avatar(session, &body, &faces) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_set_source_skeleton(session, &joints, &bones) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_set_target_skeleton(session, &joints, &bones) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_run(session) == BESPOKE_STATUS_OK);
    std::vector<Triple<float>> result(scene.garment.points.size());
    const BespokeBuffer room{result.data(), result.size(), 0, BESPOKE_COMPONENT_F32};
    CHECK(bespoke_session_read_garment_vertices(session, &room, nullptr) == BESPOKE_STATUS_OK);
    CHECK(bespoke_session_destroy(session) == BESPOKE_STATUS_OK);
    return result;
}

void the_whole_way() {
    const Scene scene;
    const auto expected = by_c(scene);
    // At once.
    Session session = session_with(scene);
    ACCEPTED(session.run());
    CHECK(same_bits(session.read_garment_vertices().value(), expected));
    REFUSED(session.run(), Status::invalid_state, "reset");
    REFUSED(session.run([](const Progress &) {}), Status::invalid_state, "reset");
    // Step by step.
    ACCEPTED(session.reset());
    ACCEPTED(session.prepare());
    CHECK(session.read_progress()->stage == Stage::prepared);
    int steps = 0;
    for (auto stage = session.step({1, 0}); stage.value() != Stage::done; stage = session.step({1, 0})) {
        CHECK(session.read_garment_vertices()->size() == expected.size());
        CHECK(++steps < 10000);
    }
    CHECK(steps > 5 && same_bits(session.read_garment_vertices().value(), expected));
    // With a token or a callable.
    ACCEPTED(session.reset());
    std::vector<Stage> stages;
    double t = 0.0;
    ACCEPTED(session.run([&](const Progress &progress) {
        if (stages.empty() || stages.back() != progress.stage) stages.push_back(progress.stage);
        CHECK(progress.t >= t && progress.t <= 1.0);
        t = progress.t;
        return true;
    }));
    CHECK(stages.front() == Stage::setup && stages[1] == Stage::prepared && stages.back() == Stage::done && t == 1.0);
    CHECK(same_bits(session.read_garment_vertices().value(), expected));
}

void what_is_read() {
    const Scene scene;
    Session session = session_with(scene);
    CHECK(session.read_diagnostics()->empty());
    ACCEPTED(session.run());
    const std::size_t vertices = scene.garment.points.size(), triangles = scene.garment.triangles.size();

    // Into the caller's memory, with room to spare, beside other things; into new memory, in another shape.
    const auto expected = session.read_garment_vertices().value();
    struct Corner {
        std::uint32_t colour;
        float position[3];
    };
    std::vector<Corner> structs(vertices + 1, {7, {9, 9, 9}});
    CHECK(session.read_garment_vertices({structs, &Corner::position}).value() == vertices);
    for (std::size_t v = 0; v < vertices; v++) {
        CHECK(structs[v].colour == 7 && std::memcmp(structs[v].position, &expected[v], sizeof expected[v]) == 0);
    }
    CHECK(structs[vertices].position[0] == 9);
    std::vector<float> flat(3 * vertices);
    CHECK(session.read_garment_vertices(flat).value() == vertices);
    CHECK(std::memcmp(flat.data(), expected.data(), flat.size() * sizeof(float)) == 0);
    std::vector<float> small(3 * vertices - 3);
    REFUSED(session.read_garment_vertices(small), Status::invalid_argument, std::to_string(vertices));
    struct Vec3 {
        float x, y, z;
    };
    const auto named = session.read_garment_vertices<Vec3>().value();
    CHECK(named.size() == vertices && std::memcmp(named.data(), expected.data(), flat.size() * sizeof(float)) == 0);
    const auto avatar = session.read_avatar_vertices<Triple<double>>().value();
    CHECK(avatar.size() == scene.body.points.size());
    CHECK(std::abs(avatar[0][2] - static_cast<double>(scene.body.points[0][2])) < 1e-12);
    std::vector<float> large(3 * avatar.size() + 3, 9.0f);
    CHECK(session.read_avatar_vertices(large).value() == avatar.size() && large.back() == 9.0f);
    CHECK(large[2] == scene.body.points[0][2]);

    const auto distortion = session.read_distortion().value();
    const auto doubles = session.read_distortion<double>().value();
    CHECK(distortion.size() == triangles && doubles.size() == triangles && doubles[0] > 0);
    for (std::size_t k = 0; k < triangles; k++) CHECK(distortion[k] == static_cast<float>(doubles[k]));
    std::vector<double> room(triangles);
    CHECK(session.read_distortion(room).value() == triangles && same_bits(room, doubles));

    REFUSED(session.read_garment_morph(0), Status::invalid_argument, "garment morph 0");
    REFUSED(session.read_follower_vertices(0), Status::invalid_argument, "follower 0");
    REFUSED(session.read_target_morph(0), Status::invalid_argument, "target morph 0");
    const auto normals = session.read_garment_normals().value();
    CHECK(normals.normals.size() == vertices && normals.tangents.empty());
    RenderMesh drawn;
    drawn.triangles = scene.garment.triangles;
    drawn.normals = normals.normals;
    const std::vector<std::array<double, 4>> along(vertices, {0, 1, 0, -1});
    drawn.tangents = along;
    const auto turned = session.read_garment_normals(drawn).value();
    CHECK(turned.normals.size() == vertices && turned.tangents.size() == vertices && turned.tangents[0][3] == -1.0f);
    drawn.normals = std::vector<float>(4);
    REFUSED(session.read_garment_normals(drawn), Status::invalid_argument, "garment normals: there are 4 numbers");

    for (const Component precision : {Component::f32, Component::f64}) {
        const auto found = session.verify(precision);
        CHECK(found && found->garment_garment == 0 && found->garment_avatar == 0);
    }
    const auto report = session.read_report();
    CHECK(report && report->is_verified == 1 && report->threads == 2 && report->garment_vertices == vertices);
    const auto energies = session.read_energies();
    CHECK(energies && energies->size() == report->energy_count && energies->size() > 3);
    double sum = 0.0;
    bool has_surface = false;
    for (const Energy &energy : *energies) {
        sum += energy.weight * energy.value;
        has_surface |= energy.name == "surface";
    }
    CHECK(has_surface);
    const auto progress = session.read_progress();
    CHECK(progress->stage == Stage::done && progress->energy_count == energies->size());
    CHECK(std::abs(progress->energy - sum) <= 1e-9 * std::abs(sum));
    CHECK(std::abs(progress->energies[0] - (*energies)[0].weight * (*energies)[0].value) <= 1e-9 * std::abs(sum));
    CHECK(progress->prepare_seconds > 0 && progress->inflate_seconds > 0 && progress->fit_seconds > 0);
    CHECK(progress->verify_seconds > 0 && progress->iteration > 0 && progress->min_distance > 0);
    CHECK(progress->active_contacts == report->active_contacts && progress->gradient_norm == report->gradient_norm);
    REFUSED(session.read_energy(100), Status::invalid_argument, "100");
}

/// Whatever is wrong with a garment is reported with its elements.
void diagnostics() {
    Scene scene;
    scene.garment.triangles.push_back(scene.garment.triangles[7]);
    scene.garment.points.push_back({9, 9, 9});
    const auto unused = static_cast<std::uint32_t>(scene.garment.points.size() - 1);
    const auto copy = static_cast<std::uint32_t>(scene.garment.triangles.size() - 1);
    Session session = session_with(scene);
    ACCEPTED(session.prepare());
    int found = 0;
    for (const Diagnostic &diagnostic : *session.read_diagnostics()) {
        CHECK(!diagnostic.message.empty() && diagnostic.message.find('\0') == std::string::npos);
        if (diagnostic.kind == DiagnosticKind::unused_vertex) {
            CHECK(diagnostic.elements.size() == 1 && diagnostic.elements[0].index == unused);
            found++;
        }
        if (diagnostic.kind == DiagnosticKind::duplicate_triangle) {
            CHECK(diagnostic.elements.size() == 2 && diagnostic.elements[0].kind == ElementKind::triangle);
            CHECK(diagnostic.elements[0].index == copy || diagnostic.elements[1].index == copy);
            CHECK(std::isnan(diagnostic.distance));
            found++;
        }
    }
    CHECK(found == 2);
}

/// A session that is made on one thread, set on a second and run on a third.
void several_threads() {
    const Scene scene;
    const auto expected = by_c(scene);
    Session session;
    std::thread([&] { session = session_with(scene); }).join();
    std::thread([&] { ACCEPTED(session.run()); }).join();
    CHECK(same_bits(session.read_garment_vertices().value(), expected));
}

/// Two sessions over one body and one garment, whose owners are gone before these run.
void shared() {
    const Scene scene;
    const auto expected = by_c(scene);
    Session from = session_with(scene);
    Avatar avatar = from.create_avatar().value();
    Garment garment = from.create_garment().value();
    CHECK(avatar && avatar.get() != nullptr && garment && garment.get() != nullptr);
    ACCEPTED(from.destroy());
    std::array<Session, 2> sessions;
    for (Session &session : sessions) {
        session = Session::create().value();
        REFUSED(session.create_avatar(), Status::invalid_state, "set_target_avatar");
        REFUSED(session.create_garment(), Status::invalid_state, "set_garment");
        REFUSED(session.use_avatar(Avatar()), Status::invalid_argument, "null");
        REFUSED(session.use_garment(Garment()), Status::invalid_argument, "null");
        ACCEPTED(session.set_options(coarse_options()));
        ACCEPTED(session.use_avatar(avatar));
        ACCEPTED(session.use_garment(garment));
    }
    Avatar taken = std::move(avatar);
    CHECK(!avatar && avatar.get() == nullptr);
    bespoke_avatar_destroy(taken.release());
    bespoke_garment_destroy(garment.release());
    std::thread other([&] { ACCEPTED(sessions[0].run()); });
    ACCEPTED(sessions[1].run());
    other.join();
    for (Session &session : sessions) CHECK(same_bits(session.read_garment_vertices().value(), expected));
    REFUSED(sessions[0].use_avatar(Avatar(nullptr)), Status::invalid_argument, "null");
}

/// While a C function is inside of a session: others are busy, and a destructor takes nothing away.
void one_at_a_time() {
    Scene scene;
    scene.garment = Tube(0.3, 0.5, 60, 80);
    std::optional<Session> session = session_with(scene);
    BespokeSession *const handle = session->get();
    std::atomic<bool> has_ended{false};
    BespokeStatus status = BESPOKE_STATUS_OK;
    std::thread other([&] {
        status = bespoke_session_run(handle);
        has_ended = true;
    });
    while (session->read_progress()->stage < Stage::inflate) CHECK(!has_ended);
    REFUSED(session->reset(), Status::busy, "another thread");
    REFUSED(session->read_garment_vertices(), Status::busy, "another thread");
    REFUSED(session->destroy(), Status::busy, "another thread");
    CHECK(session->get() == handle);
    session.reset();
    other.join();
    CHECK(status == BESPOKE_STATUS_CANCELLED);
    Session(handle).reset().value();
}

} // namespace

void sessions() {
    owners();
    the_whole_way();
    what_is_read();
    diagnostics();
    several_threads();
    shared();
    one_at_a_time();
}
