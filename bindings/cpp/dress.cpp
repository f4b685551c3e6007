/* dress: dresses a body in a garment that was modelled on another, by bespoke.hpp. OBJ in, OBJ out; Ctrl-C stops it.

     c++ -std=c++17 -Iinclude bindings/cpp/dress.cpp -Lbuild -lbespoke -Wl,-rpath,build -o dress
     ./dress garment.obj skeleton.obj avatar.obj avatar_skeleton.obj dressed.obj

   It is the same with -fno-exceptions and -fno-rtti: all that can fail returns a Result. */

#include "bespoke.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using bespoke::Result;

struct Point {
    float x, y, z;
};

/// What a session takes of an OBJ file: lines `v`, `f` and `l`.
struct Obj {
    std::vector<Point> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> bones;
};

/// The vertex that a corner such as "7", "7/1/3" or "-1" names, from 0; none for what is not a number. Whether the mesh
/// has it is for the library to say.
std::optional<std::uint32_t> vertex_of(const std::string &corner, std::size_t vertices) {
    std::istringstream text(corner);
    long number = 0;
    if (!(text >> number) || number == 0) return std::nullopt;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : static_cast<long>(vertices) + number);
}

using Path = std::filesystem::path;

/// UTF-8 on every system.
std::string name_of(const Path &path) {
    const auto text = path.u8string();
    return {text.begin(), text.end()};
}

Result<Obj> read_obj(const Path &path) {
    std::ifstream file(path);
    Obj obj;
    std::string line;
    const auto broken = [&](std::size_t number, const char *what) {
        return bespoke::Error(bespoke::Status::invalid_argument,
                              name_of(path) + ", line " + std::to_string(number) + ": " + what);
    };
    if (!file.is_open()) return bespoke::Error(bespoke::Status::invalid_argument, name_of(path) + ": cannot be opened");
    for (std::size_t number = 1; std::getline(file, line); number++) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            Point p{};
            if (!(words >> p.x >> p.y >> p.z)) return broken(number, "a vertex needs three coordinates");
            obj.points.push_back(p);
        } else if (key == "f" || key == "l") {
            std::vector<std::uint32_t> corners;
            for (std::string corner; words >> corner;) {
                const auto vertex = vertex_of(corner, obj.points.size());
                if (!vertex) return broken(number, "a corner is no number of a vertex");
                corners.push_back(*vertex);
            }
            for (std::size_t k = 1; key == "l" && k < corners.size(); k++) {
                obj.bones.push_back({corners[k - 1], corners[k]});
            }
            // A polygon is a fan of triangles.
            for (std::size_t k = 2; key == "f" && k < corners.size(); k++) {
                obj.triangles.push_back({corners[0], corners[k - 1], corners[k]});
            }
        }
    }
    return obj;
}

Result<void> write_obj(const Path &path, const Obj &obj) {
    std::ofstream file(path, std::ios::binary);
    file.precision(9);
    for (const Point &p : obj.points) file << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    for (const auto &[a, b, c] : obj.triangles) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    file.close();
    if (!file) return bespoke::Error(bespoke::Status::invalid_argument, name_of(path) + ": cannot be written");
    return {};
}

/// What Ctrl-C stops. A signal handler may not do more than this call.
std::atomic<BespokeControl *> running{nullptr};

void on_interrupt(int) {
    if (BespokeControl *control = running.load()) bespoke_control_cancel(control);
}

/// The current or next stage of a run.
const char *name_of(bespoke::Stage stage) {
    switch (stage) {
    case bespoke::Stage::setup: return "prepare";
    case bespoke::Stage::prepared:
    case bespoke::Stage::inflate: return "inflate";
    case bespoke::Stage::fit: return "fit";
    case bespoke::Stage::verify: return "verify";
    case bespoke::Stage::done: return "done";
    default: return "";
    }
}

Result<void> dress(const Path *paths) {
    auto garment = read_obj(paths[0]), skeleton = read_obj(paths[1]);
    auto avatar = read_obj(paths[2]), avatar_skeleton = read_obj(paths[3]);
    for (const auto *obj : {&garment, &skeleton, &avatar, &avatar_skeleton}) {
        if (!*obj) return obj->error();
    }
    auto made = bespoke::Session::create();
    if (!made) return made.error();
    bespoke::Session &session = *made;
    const auto control = session.create_control();
    if (!control) return control.error();
    running = control->get();
    std::signal(SIGINT, on_interrupt);

    // A line for each part of the way.
    std::string shown;
    const auto show = [&](const bespoke::Progress &progress) {
        if (shown == name_of(progress.stage)) return;
        shown = name_of(progress.stage);
        std::printf("%s\n", shown.c_str());
        std::fflush(stdout);
    };
    Result<void> dressed =
        session.set_garment(garment->points, garment->triangles)
            .and_then([&] { return session.set_source_skeleton(skeleton->points, skeleton->bones); })
            .and_then([&] { return session.set_target_avatar(avatar->points, avatar->triangles); })
            .and_then([&] { return session.set_target_skeleton(avatar_skeleton->points, avatar_skeleton->bones); })
            .and_then([&] { return session.run(show); });
    running = nullptr;
    if (const auto diagnostics = session.read_diagnostics()) {
        for (const auto &diagnostic : *diagnostics) std::printf("%s\n", diagnostic.message.c_str());
    }
    if (!dressed) return dressed;

    const auto found = session.verify();
    if (!found) return found.error();
    std::printf("intersections: %llu of the garment with itself, %llu with the avatar\n",
                static_cast<unsigned long long>(found->garment_garment),
                static_cast<unsigned long long>(found->garment_avatar));
    if (const auto read = session.read_garment_vertices(garment->points); !read) return read.error();
    return write_obj(paths[4], *garment);
}

int run(const std::vector<Path> &words) {
    if (words.size() != 6) {
        std::fprintf(stderr, "usage: dress GARMENT SOURCE_SKELETON AVATAR TARGET_SKELETON OUTPUT (OBJ files)\n");
        return 2;
    }
    const auto dressed = dress(&words[1]);
    if (!dressed) std::fprintf(stderr, "dress: %s\n", dressed.message().c_str());
    return dressed ? 0 : dressed.status() == bespoke::Status::cancelled ? 130 : 1;
}

} // namespace

#ifdef _WIN32
/* What main is given has only the characters of the machine's language. MinGW takes this one with -municode. */
extern "C" int wmain(int count, wchar_t **arguments) {
    return run({arguments, arguments + count});
}
#else
int main(int count, char **arguments) {
    return run({arguments, arguments + count});
}
#endif
