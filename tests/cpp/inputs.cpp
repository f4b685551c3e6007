/* Inputs of a session: every setter, in every shape of arrays, what they refuse, options and coordinate systems. */
#include "check.hpp"

namespace {

using namespace bespoke;

struct Vertex {
    std::uint32_t colour;
    float position[3];
    std::uint16_t joints[2];
    float weights[2];
    float fit;
};

/// The garment's vertices after the whole way.
std::vector<Triple<float>> dressed(Session &session) {
    ACCEPTED(session.run());
    return session.read_garment_vertices().value();
}

/// The same scene from other arrays gives the same bits.
void shapes_of_arrays() {
    const Scene scene;
    Session plain = session_with(scene);
    const auto expected = dressed(plain);

    std::vector<float> flat;
    std::vector<Vertex> structs;
    for (const auto &p : scene.garment.points) flat.insert(flat.end(), p.begin(), p.end());
    for (const auto &p : scene.body.points) structs.push_back({7, {p[0], p[1], p[2]}, {0, 1}, {1, 0}, 1});
    std::vector<std::uint16_t> corners;
    for (const auto &t : scene.garment.triangles) {
        for (const std::uint32_t v : t) corners.push_back(static_cast<std::uint16_t>(v));
    }
    const std::int32_t bones[2][2] = {{0, 1}, {1, 2}};
    Session other = Session::create().value();
    ACCEPTED(other.set_options(coarse_options()));
    ACCEPTED(other.set_garment(flat, corners));
    ACCEPTED(other.set_source_skeleton({&scene.joints[0][0], 3, sizeof scene.joints[0]}, bones));
    ACCEPTED(other.set_target_avatar({structs, &Vertex::position}, scene.body.triangles));
    ACCEPTED(other.set_target_skeleton({scene.joints.data(), scene.joints.size()}, {&bones[0][0], 2, 0}));
    CHECK(same_bits(dressed(other), expected));
    // Temporaries are fine.
    ACCEPTED(other.reset());
    ACCEPTED(other.set_garment(std::vector<float>(flat), std::vector<std::uint16_t>(corners)));
    CHECK(same_bits(dressed(other), expected));
}

void wrong_shapes() {
    const Scene scene;
    Session session = session_with(scene);
    const std::vector<float> ten(10);
    const std::vector<std::uint32_t> seven(7);
    REFUSED(session.set_garment(ten, seven), Status::invalid_argument, "garment positions: there are 10 numbers");
    REFUSED(session.set_garment(scene.garment.points, seven), Status::invalid_argument, "garment triangles: there are");
    REFUSED(session.set_target_avatar(ten, seven), Status::invalid_argument, "target avatar positions");
    REFUSED(session.set_source_avatar(scene.body.points, seven), Status::invalid_argument, "source avatar triangles");
    REFUSED(session.set_source_skeleton(ten, seven), Status::invalid_argument, "source skeleton joints");
    REFUSED(session.set_target_skeleton(scene.joints, seven), Status::invalid_argument, "elements of 2 each: 1 would");
    REFUSED(session.set_pinned_vertices(seven, ten), Status::invalid_argument, "targets of pins");
    REFUSED(session.add_layer(scene.body.points, seven), Status::invalid_argument, "layer triangles");
    REFUSED(session.set_target_skin_weights({ten, 4}), Status::invalid_argument, "elements of 4 each: 2 would");
    REFUSED(session.set_target_skin_weights({ten, 0}), Status::invalid_argument, "target skin weights");
    const IndexRows joints(seven, 7);
    REFUSED(session.set_target_skin_influences(joints, {ten, 10}, 3), Status::invalid_argument, "7 joints, but 10");
    ACCEPTED(session.prepare());
    std::vector<float> room(3 * scene.garment.points.size() + 1);
    REFUSED(session.read_garment_vertices(room), Status::invalid_argument, "room for garment vertices");
    CHECK(room[0] == 0);
}

/// What the library refuses comes with its status and its message.
void refusals() {
    const Scene scene;
    Session session = session_with(scene);
    auto broken = scene.garment;
    broken.triangles[33][2] = 9000;
    REFUSED(session.set_garment(broken.points, broken.triangles), Status::invalid_mesh, "triangle 33");
    const std::array<std::int32_t, 3> negative{0, 1, -1};
    REFUSED(session.set_garment(broken.points, negative), Status::invalid_mesh, "4294967295");
    broken.points[5][1] = NAN;
    REFUSED(session.set_target_avatar(broken.points, scene.garment.triangles), Status::invalid_mesh, "vertex 5");
    REFUSED(session.set_garment(Points(), Triangles()), Status::invalid_mesh, "garment");
    REFUSED(session.set_vertex_fit_weights(std::array{1.0f, -1.0f}), Status::invalid_weights, "1");
    REFUSED(session.set_no_fit_vertices(std::array{0u, 100000u}), Status::invalid_argument, "100000");
    const std::array<std::uint16_t, 2> bone{0, 9};
    REFUSED(session.set_source_skeleton(scene.joints, bone), Status::invalid_skeleton, "9");
    REFUSED(session.add_rigid_group({}), Status::invalid_argument, "rigid group 0");
    REFUSED(session.add_curve(std::array{40u, 41u}, true), Status::invalid_argument, "curve 0");
    ACCEPTED(session.set_target_skeleton(scene.joints, std::array<std::uint16_t, 4>{0, 2, 2, 1}));
    REFUSED(session.prepare(), Status::invalid_skeleton, "skeleton");
    REFUSED(session.step(), Status::invalid_state, "prepare");
    REFUSED(session.read_garment_vertices(), Status::invalid_state, "prepare");
    REFUSED(session.verify(Component::u16), Status::invalid_argument, "component");
    CoordinateSystem system;
    system.up = Axis::negative_x;
    REFUSED(session.set_source_coordinate_system(system), Status::invalid_argument, "x");
    Options options;
    options.dhat = 5.0;
    REFUSED(session.set_options(options), Status::invalid_argument, "dhat");
    // After all that, it works as before.
    ACCEPTED(session.set_target_skeleton(scene.joints, scene.bones));
    ACCEPTED(session.run());
}

void optional_inputs() {
    const Scene scene;
    const Tube mannequin(0.2, 0.9, 14, 15);
    Session session = session_with(scene);
    ACCEPTED(session.set_source_avatar(mannequin.points, mannequin.triangles));
    // Skin weights as rows, as structs, and as a matrix, which replaces them.
    std::vector<Vertex> vertices(scene.body.points.size());
    std::vector<double> matrix(3 * vertices.size());
    for (std::size_t v = 0; v < vertices.size(); v++) {
        const std::size_t joint = 3 * v / vertices.size();
        vertices[v].joints[0] = static_cast<std::uint16_t>(joint);
        vertices[v].weights[0] = 1;
        matrix[joint * vertices.size() + v] = 1;
    }
    ACCEPTED(session.set_target_skin_influences({vertices, &Vertex::joints}, {vertices, &Vertex::weights}, 3));
    ACCEPTED(session.set_target_skin_weights({matrix, vertices.size()}));
    std::vector<float> fit(scene.garment.points.size(), 1.0f);
    ACCEPTED(session.set_vertex_fit_weights(fit));
    ACCEPTED(session.set_no_fit_vertices(std::array<std::uint16_t, 3>{0, 1, 2}));
    ACCEPTED(session.set_pinned_vertices(std::array{0u, 70u}));
    ACCEPTED(session.set_pinned_vertices({}));
    ACCEPTED(session.add_rigid_group(std::array{40u, 41u, 56u}));
    ACCEPTED(session.clear_rigid_groups());
    ACCEPTED(session.add_curve(std::array{40u, 41u}, false, 2.0, 0.5));
    ACCEPTED(session.clear_curves());
    ACCEPTED(session.add_layer(scene.body.points, scene.body.triangles));
    ACCEPTED(session.clear_layers());
    ACCEPTED(session.run());
    CHECK(session.read_report()->is_verified == 1);
}

double distance(const Triple<float> &a, const Triple<float> &b) {
    return std::hypot(std::hypot(static_cast<double>(a[0] - b[0]), static_cast<double>(a[1] - b[1])),
                      static_cast<double>(a[2] - b[2]));
}

void pins_groups_and_layers() {
    const Scene scene;
    Session session = session_with(scene);
    const std::array<Triple<float>, 2> targets{{{0.55f, -0.45f, 0.1f}, {0, 0.05f, 0}}};
    const std::array group{100u, 101u, 116u};
    ACCEPTED(session.set_pinned_vertices(std::array{0u, 70u}, targets));
    ACCEPTED(session.add_rigid_group(group));
    const auto inner = dressed(session);
    CHECK(distance(inner[0], targets[0]) < 0.01);
    // The other target is inside the body.
    CHECK(distance(inner[70], targets[1]) > 0.2);
    bool is_reported = false;
    for (const Diagnostic &diagnostic : session.read_diagnostics().value()) {
        if (diagnostic.kind != DiagnosticKind::pin_not_reached) continue;
        is_reported = true;
        CHECK(diagnostic.severity == Severity::warning && diagnostic.distance > 0 && !diagnostic.message.empty());
        CHECK(diagnostic.elements.size() == 1 && diagnostic.elements[0].index == 70);
        CHECK(diagnostic.elements[0].subject == Subject::garment && diagnostic.elements[0].kind == ElementKind::vertex);
        CHECK(!diagnostic.elements[0].layer());
    }
    CHECK(is_reported);
    for (std::size_t k = 0; k < 3; k++) {
        const std::size_t v = group[k], w = group[(k + 1) % 3];
        const double designed = distance(scene.garment.points[v], scene.garment.points[w]);
        CHECK(std::abs(distance(inner[v], inner[w]) - designed) < 1e-4);
    }
    // Over it goes another, and is outside.
    Session outer = session_with(scene);
    ACCEPTED(outer.add_layer(inner, scene.garment.triangles));
    double radius[2] = {};
    for (const auto &p : dressed(outer)) radius[0] += std::hypot(p[0], p[2]);
    for (const auto &p : inner) radius[1] += std::hypot(p[0], p[2]);
    CHECK(radius[0] > radius[1]);
    const auto found = outer.verify();
    CHECK(found && found->garment_garment == 0 && found->garment_avatar == 0);
    CHECK((Element{static_cast<Subject>(BESPOKE_SUBJECT_LAYER + 2), ElementKind::vertex, 0}).layer() == 2u);
}

/// Every field arrives in its own place.
void fields_of_options() {
    Options options;
    CHECK(options.get().struct_size == sizeof(BespokeOptions) && options.get().fit_weight == 0.0);
    double value = 0.0;
    for (double *field : {&options.fit_weight, &options.designed_clearance, &options.surface_weight,
                          &options.curvature_weight, &options.torsion_weight, &options.position_weight,
                          &options.barrier_weight, &options.dhat, &options.inflation_dhat,
                          &options.inflation_barrier_weight, &options.voxel_size, &options.min_separation,
                          &options.tolerance, &options.offset, &options.fit_distance, &options.pin_weight,
                          &options.weld_distance, &options.surface_length, &options.curve_chord}) {
        *field = ++value;
    }
    options.threads = 21;
    options.max_iterations = 22;
    options.memory_limit = 23;
    options.surface_form = SurfaceForm::printed;
    options.strict = true;
    options.keep_caps = true;
    const BespokeOptions c = options.get();
    value = 0.0;
    for (const double field :
         {c.fit_weight, c.designed_clearance, c.surface_weight, c.curvature_weight, c.torsion_weight, c.position_weight,
          c.barrier_weight, c.dhat, c.inflation_dhat, c.inflation_barrier_weight, c.voxel_size, c.min_separation,
          c.tolerance, c.offset, c.fit_distance, c.pin_weight, c.weld_distance, c.surface_length, c.curve_chord}) {
        CHECK(field == ++value);
    }
    CHECK(c.threads == 21 && c.max_iterations == 22 && c.memory_limit == 23 && c.strict == 1);
    CHECK(c.surface_form == BESPOKE_SURFACE_FORM_PRINTED && c.keep_caps == 1);

#if __cplusplus >= 202002L
    const BespokeOptions named = Options{.threads = 3, .voxel_size = 0.1}.get();
    CHECK(named.threads == 3 && named.voxel_size == 0.1 && named.dhat == 0.0);
#endif

    // The defaults, read and handed back, are those that the library wrote.
    BespokeOptions written{};
    written.struct_size = sizeof written;
    CHECK(bespoke_options_read_defaults(&written) == BESPOKE_STATUS_OK && written.fit_weight == 2.0);
    const BespokeOptions back = Options::read_defaults()->get();
    CHECK(std::memcmp(&back, &written, sizeof back) == 0);
}

/// A new coordinate system is the default; centimetres, z up and a mirrored winding give the same garment.
void coordinate_systems() {
    const BespokeCoordinateSystem plain = CoordinateSystem().get();
    CHECK(plain.struct_size == sizeof plain && plain.right == BESPOKE_AXIS_POSITIVE_X);
    CHECK(plain.up == BESPOKE_AXIS_POSITIVE_Y && plain.forward == BESPOKE_AXIS_NEGATIVE_Z && plain.trusted == 0);
    CHECK(plain.metres_per_unit == 1.0 && plain.winding == BESPOKE_WINDING_COUNTER_CLOCKWISE);

    const Scene scene;
    Session metres = session_with(scene);
    const auto expected = dressed(metres);
    ACCEPTED(metres.reset());
    ACCEPTED(metres.set_source_coordinate_system(CoordinateSystem()));
    ACCEPTED(metres.set_target_coordinate_system(CoordinateSystem()));
    CHECK(same_bits(dressed(metres), expected));

    CoordinateSystem system;
    system.up = Axis::positive_z;
    system.forward = Axis::positive_y;
    system.metres_per_unit = 0.01;
    system.winding = Winding::clockwise;
    const auto turned = [](const auto &p) {
        return Triple<float>{100 * static_cast<float>(p[0]), -100 * static_cast<float>(p[2]),
                             100 * static_cast<float>(p[1])};
    };
    std::vector<Triple<float>> body, joints;
    for (const auto &p : scene.body.points) body.push_back(turned(p));
    for (const auto &p : scene.joints) joints.push_back(turned(p));
    Session session = session_with(scene);
    ACCEPTED(session.set_target_coordinate_system(system));
    ACCEPTED(session.set_target_avatar(body, scene.body.triangles));
    ACCEPTED(session.set_target_skeleton(joints, scene.bones));
    const auto points = dressed(session);
    for (std::size_t v = 0; v < points.size(); v++) CHECK(distance(points[v], turned(expected[v])) < 0.5);
}

} // namespace

void inputs() {
    shapes_of_arrays();
    wrong_shapes();
    refusals();
    optional_inputs();
    pins_groups_and_layers();
    fields_of_options();
    coordinate_systems();
}
