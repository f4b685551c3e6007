/* What the tests of bespoke.hpp share: checks that end the program, a small scene, and a session with it. */
#ifndef BESPOKE_TESTS_CPP_CHECK_HPP
#define BESPOKE_TESTS_CPP_CHECK_HPP

#include "bespoke.hpp"

#include <cmath>
#include <cstring>

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                       \
            std::exit(1);                                                                                              \
        }                                                                                                              \
    } while (0)

/// The call succeeded; otherwise its message is shown.
#define ACCEPTED(call)                                                                                                 \
    do {                                                                                                               \
        const auto accepted_outcome = (call);                                                                          \
        if (!accepted_outcome) {                                                                                       \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, accepted_outcome.message().c_str());               \
            std::exit(1);                                                                                              \
        }                                                                                                              \
    } while (0)

/// The call was refused with this status and a message with this word.
#define REFUSED(call, expected, word)                                                                                  \
    do {                                                                                                               \
        const auto refused_outcome = (call);                                                                           \
        if (refused_outcome || refused_outcome.status() != (expected) ||                                               \
            refused_outcome.message().find(word) == std::string::npos) {                                               \
            std::fprintf(stderr, "%s:%d: %s \"%s\"\n", __FILE__, __LINE__,                                             \
                         bespoke::status_name(refused_outcome.status()), refused_outcome.message().c_str());           \
            std::exit(1);                                                                                              \
        }                                                                                                              \
    } while (0)

template <class Number> using Triple = std::array<Number, 3>;

/// An open tube around the y axis.
struct Tube {
    std::vector<Triple<float>> points;
    std::vector<Triple<std::uint32_t>> triangles;

    Tube(double radius, double reach, std::uint32_t around, std::uint32_t rings) {
        for (std::uint32_t k = 0; k < rings * around; k++) {
            const double angle = 6.283185307179586 * (k % around) / around;
            points.push_back({static_cast<float>(radius * std::sin(angle)),
                              static_cast<float>(reach * (2.0 * (k / around) / (rings - 1) - 1.0)),
                              static_cast<float>(radius * std::cos(angle))});
        }
        for (std::uint32_t k = 0; k < (rings - 1) * around; k++) {
            const std::uint32_t ring = k / around * around, a = k, b = ring + (k + 1) % around;
            triangles.push_back({a, b, b + around});
            triangles.push_back({a, b + around, a + around});
        }
    }
};

/// A garment, a thicker body, and the skeleton of both.
struct Scene {
    Tube garment{0.3, 0.5, 16, 9};
    Tube body{0.4, 0.9, 14, 15};
    std::vector<Triple<double>> joints{{0, -1, 0}, {0, 0, 0}, {0, 1, 0}};
    std::array<std::array<std::uint16_t, 2>, 2> bones{{{0, 1}, {2, 1}}};
};

inline bespoke::Options coarse_options() {
    bespoke::Options options;
    options.threads = 2;
    options.voxel_size = 0.1;
    return options;
}

/// A session in SETUP with all that has to be set.
inline bespoke::Session session_with(const Scene &scene) {
    bespoke::Session session = bespoke::Session::create().value();
    ACCEPTED(session.set_options(coarse_options()));
    ACCEPTED(session.set_garment(scene.garment.points, scene.garment.triangles));
    ACCEPTED(session.set_source_skeleton(scene.joints, scene.bones));
    ACCEPTED(session.set_target_avatar(scene.body.points, scene.body.triangles));
    ACCEPTED(session.set_target_skeleton(scene.joints, scene.bones));
    return session;
}

/// Both hold the same bits.
template <class T> bool same_bits(const std::vector<T> &left, const std::vector<T> &right) {
    return left.size() == right.size() && std::memcmp(left.data(), right.data(), left.size() * sizeof(T)) == 0;
}

void views();
void results();
void inputs();
void rigs();
void follow();
void sessions();
void stops();

/// Does what ends the program, by the name of the mistake.
void mistake(const char *name);

#endif
