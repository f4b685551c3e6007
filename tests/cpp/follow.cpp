/* What goes along with a garment: morphs in and out, the answer to a morph of the body, and a mesh that follows. */
#include "check.hpp"

#include <cmath>

namespace {

using namespace bespoke;

double length(const std::array<float, 3> &p) { return std::sqrt(double(p[0]) * p[0] + double(p[2]) * p[2]); }

void morphs_and_followers() {
    const Scene scene;
    Session session = session_with(scene);
    const auto &points = scene.garment.points;
    ACCEPTED(session.add_garment_morph("lost", points));
    ACCEPTED(session.clear_garment_morphs());
    ACCEPTED(session.add_garment_morph("as large", points));
    auto heavier = scene.body.points;
    for (auto &p : heavier) p = {p[0] * 0.2f, 0.0f, p[2] * 0.2f};
    ACCEPTED(session.add_target_morph("lost", heavier));
    ACCEPTED(session.clear_target_morphs());
    ACCEPTED(session.add_target_morph("heavier", heavier));
    ACCEPTED(session.add_follower(points, scene.garment.triangles));
    ACCEPTED(session.clear_followers());
    ACCEPTED(session.add_follower(points, scene.garment.triangles));
    REFUSED(session.add_target_morph("odd", std::vector<float>(4)), Status::invalid_argument, "target morph: there are 4");
    REFUSED(session.read_follower_vertices(0), Status::invalid_state, "follower 0");
    REFUSED(session.solve_target_morphs(), Status::invalid_state, "target morph");
    ACCEPTED(session.run());

    const auto garment = session.read_garment_vertices().value();
    const auto followed = session.read_follower_vertices(0).value();
    const auto large = session.read_garment_morph(0).value();
    CHECK(followed.size() == garment.size() && large.size() == garment.size());
    for (std::size_t k = 0; k < garment.size(); k++) {
        for (std::size_t n = 0; n < 3; n++) CHECK(std::abs(followed[k][n] - garment[k][n]) < 1e-5f);
        CHECK(length(large[k]) > 0.5 * length(points[k]));
    }
    REFUSED(session.read_follower_skin_influences(0, 4), Status::invalid_state, "skin weights");
    REFUSED(session.read_target_morph(0), Status::invalid_state, "solve_target_morphs");
    ACCEPTED(session.solve_target_morphs());
    const auto answer = session.read_target_morph<std::array<double, 3>>(0).value();
    const auto again = session.read_garment_vertices().value();
    CHECK(answer.size() == garment.size() && same_bits(again, garment));
    double sum = 0;
    for (std::size_t k = 0; k < answer.size(); k++) {
        sum += (answer[k][0] * garment[k][0] + answer[k][2] * garment[k][2]) / length(garment[k]);
    }
    CHECK(sum / double(answer.size()) > 0.04);
    const Element element{Subject(BESPOKE_SUBJECT_FOLLOWER + 3u), ElementKind::triangle, 5};
    CHECK(element.follower() == 3u && !element.layer());

    // The body takes half of the shape, and the garment goes along.
    REFUSED(session.set_target_morph_weight(1, 0.5), Status::invalid_argument, "target morph 1");
    ACCEPTED(session.set_target_morph_weight(0, 0.5));
    ACCEPTED(session.refit(coarse_options()));
    ACCEPTED(session.run());
    const auto body = session.read_avatar_vertices().value(), own = scene.body.points;
    for (std::size_t k = 0; k < own.size(); k++) CHECK(std::abs(length(body[k]) - 1.1 * length(own[k])) < 1e-5);
    const auto wider = session.read_garment_vertices().value();
    double more = 0;
    for (std::size_t k = 0; k < wider.size(); k++) more += length(wider[k]) - length(garment[k]);
    CHECK(more / double(wider.size()) > 0.02 && session.read_report()->is_verified == 1);
}

} // namespace

void follow() { morphs_and_followers(); }
