/* Views and buffers: from which types they are made and from which not, and where they say that the elements lie. */
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>
#if __cplusplus >= 202002L
#include <span>
#include <stop_token>
#endif

// As windows.h has them; bespoke.hpp has to live with these.
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define ERROR 0
#define DELETE 0x10000

#include "check.hpp"

namespace {

struct Vec2 {
    std::uint32_t x, y;
};
struct Vec3 {
    float x, y, z;
};
struct Vec4 {
    float x, y, z, w;
};
struct alignas(16) Padded {
    double x, y, z;
};
struct Upper {
    double X, Y, Z;
};
struct IndexTriple {
    std::int32_t X, Y, Z;
};
// As glm has it.
struct United {
    union {
        float x, r;
    };
    union {
        float y, g;
    };
    union {
        float z, b;
    };
};
struct Shuffled {
    float z, y, x;
};
struct Mixed {
    float x;
    double y;
    float z;
};
struct Gap {
    float x, y, hole, z;
};
class Hidden {
    float x, y, z;

public:
    float sum() const { return x + y + z; }
};
struct Functions {
    float x() const;
    float y() const;
    float z() const;
};
/// Numbers and more in one struct, with its position first.
struct Flat {
    float x, y, z, u, v;
};
struct Vertex {
    std::uint32_t colour;
    Vec3 normal;
    float position[3];
    std::array<double, 3> place;
    std::uint16_t joints[4];
    Vec4 weights;
    double fit;
    std::uint32_t pin;
    int label[3];
};
struct Derived : Vertex {};

/// As Eigen has it: nothing to see from outside.
class Opaque {
public:
    float operator[](int k) const { return numbers_[k]; }

private:
    float numbers_[3] = {};
};

/// As the Unreal Engine has it.
template <class T> struct TArray {
    std::vector<T> inside;
    T *GetData() { return inside.data(); }
    const T *GetData() const { return inside.data(); }
    std::int32_t Num() const { return static_cast<std::int32_t>(inside.size()); }
};

} // namespace

template <> struct bespoke::Layout<Opaque> : bespoke::Packed<float, 3> {};

namespace {

using namespace bespoke;
template <class View, class... From> constexpr bool takes = (std::is_convertible_v<From, View> && ...);
template <class View, class... From> constexpr bool refuses = (!std::is_constructible_v<View, From> && ...);
template <class View, class... From> constexpr bool made_of = std::is_constructible_v<View, From...>;

static_assert(takes<Points, std::vector<float>, const std::vector<double> &, std::array<float, 12> &, float (&)[12],
                    const float (&)[4][3], std::vector<std::array<double, 3>>, std::vector<Vec3>, std::vector<Padded>,
                    std::vector<Upper>, std::vector<United>, std::vector<Flat>, std::vector<Opaque>, TArray<Upper>,
                    TArray<float> &, const TArray<double> &, std::array<Vec3, 4>, Vec3 (&)[4]>);
static_assert(refuses<Points, std::vector<int>, std::vector<std::uint32_t>, std::vector<long double>, std::vector<char>,
                      std::vector<bool>, std::string, std::vector<std::string>, std::list<float>,
                      std::vector<std::vector<float>>, std::vector<std::array<float, 2>>,
                      std::vector<std::array<int, 3>>, std::vector<float *>, std::vector<Vec2>, std::vector<Vec4>,
                      std::vector<IndexTriple>, std::vector<Shuffled>, std::vector<Mixed>, std::vector<Gap>,
                      std::vector<Hidden>, std::vector<Functions>, std::vector<Vertex>, float *, float, int, std::nullptr_t, Triangles,
                      Numbers, std::array<std::array<std::array<float, 3>, 3>, 3>, TArray<int>>);
static_assert(takes<Triangles, std::vector<std::uint16_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                    std::vector<std::array<std::uint16_t, 3>>, TArray<std::int32_t>, std::vector<IndexTriple>,
                    const std::uint32_t (&)[2][3]>);
static_assert(refuses<Triangles, std::vector<float>, std::vector<std::int16_t>, std::vector<std::uint8_t>,
                      std::vector<std::size_t>, std::vector<std::int64_t>, std::vector<char16_t>, std::vector<char32_t>,
                      std::vector<wchar_t>, std::vector<bool>, std::vector<Vec3>, std::vector<Vec2>, Bones, Points>);
static_assert(takes<Bones, std::vector<Vec2>, std::vector<std::array<std::uint32_t, 2>>, std::vector<std::uint16_t>,
                    std::vector<std::pair<std::uint16_t, std::uint16_t>>>);
static_assert(refuses<Bones, std::vector<std::array<std::uint32_t, 3>>, std::vector<double>,
                      std::vector<std::pair<int, float>>, std::vector<std::pair<float, float>>>);
static_assert(takes<Indices, std::vector<std::uint32_t>, std::array<std::uint16_t, 2>, std::vector<int>>);
static_assert(refuses<Indices, std::vector<float>, std::vector<Vec2>>);
static_assert(takes<Numbers, std::vector<float>, std::vector<double>>);
static_assert(refuses<Numbers, std::vector<int>, std::vector<Vec3>>);

// Pointers count elements; a member has to be what an element is.
static_assert(made_of<Points, const std::array<float, 3> *, std::size_t> && made_of<Points, Vec3 *, std::size_t> &&
              made_of<Points, const double *, std::size_t, std::size_t> &&
              made_of<Triangles, std::uint16_t *, std::size_t, int> && made_of<Numbers, const float *, std::size_t>);
// Without a stride, a count of numbers may be meant.
static_assert(!made_of<Points, const float *, std::size_t> && !made_of<Points, const Vec2 *, std::size_t> &&
              !made_of<Points, const int *, std::size_t, std::size_t> &&
              !made_of<Triangles, const float *, std::size_t> && !made_of<Points, const void *, std::size_t>);
using Vertices = std::vector<Vertex>;
static_assert(made_of<Points, Vertices &, decltype(&Vertex::position)> &&
              made_of<Points, const Vertices &, decltype(&Vertex::place)> &&
              made_of<Points, Vertices, decltype(&Vertex::normal)> &&
              made_of<Points, const Vertex *, std::size_t, decltype(&Vertex::normal)> &&
              made_of<Points, const Derived *, std::size_t, decltype(&Vertex::normal)> &&
              made_of<Numbers, Vertices, decltype(&Vertex::fit)> &&
              made_of<Indices, Vertices, decltype(&Vertex::pin)> &&
              made_of<Triangles, Vertices, decltype(&Vertex::label)>);
static_assert(!made_of<Points, Vertices, decltype(&Vertex::label)> &&
              !made_of<Points, Vertices, decltype(&Vertex::fit)> &&
              !made_of<Points, Vertices, decltype(&Vertex::weights)> &&
              !made_of<Triangles, Vertices, decltype(&Vertex::position)> &&
              !made_of<Points, std::vector<float>, decltype(&Vertex::position)>);

// Rows: their length follows from the type, or has to be given.
static_assert(takes<NumberRows, std::vector<std::array<float, 4>>, std::vector<Vec4>, double (&)[4][2]>);
static_assert(refuses<NumberRows, std::vector<float>, std::vector<std::array<int, 4>>>);
static_assert(takes<IndexRows, std::vector<std::array<std::uint16_t, 8>>> && refuses<IndexRows, std::vector<Vec4>>);
static_assert(made_of<NumberRows, std::vector<float>, std::size_t> &&
              made_of<NumberRows, double *, std::size_t, std::size_t> &&
              made_of<IndexRows, Vertices, decltype(&Vertex::joints)> &&
              made_of<NumberRows, const Vertex *, std::size_t, decltype(&Vertex::weights)>);
static_assert(!made_of<NumberRows, std::vector<int>, std::size_t> &&
              !made_of<IndexRows, float *, std::size_t, std::size_t> &&
              !made_of<NumberRows, Vertices, decltype(&Vertex::joints)>);

// What is written can be written, and is still there afterwards.
static_assert(takes<PointBuffer, std::vector<float> &, std::vector<Vec3> &, float (&)[12], TArray<Upper> &>);
static_assert(refuses<PointBuffer, const std::vector<float> &, std::vector<float>, const float (&)[12],
                      std::array<float, 3>, std::vector<int> &, const TArray<Upper> &, TArray<Upper>>);
static_assert(made_of<PointBuffer, Vertices &, decltype(&Vertex::position)> &&
              !made_of<PointBuffer, const Vertices &, decltype(&Vertex::position)> &&
              !made_of<PointBuffer, Vertices, decltype(&Vertex::position)> &&
              made_of<PointBuffer, float *, std::size_t, std::size_t> &&
              !made_of<PointBuffer, const float *, std::size_t, std::size_t>);
static_assert(takes<NumberBuffer, std::vector<double> &> && refuses<NumberBuffer, std::vector<Vec3> &>);
#if __cplusplus >= 202002L
static_assert(takes<Points, std::span<const float>, std::span<Vec3, 4>> && refuses<Points, std::span<int>>);
static_assert(takes<PointBuffer, std::span<float>> && refuses<PointBuffer, std::span<const float>>);
#endif

/// It says that `count` elements lie from `data` on, `stride` bytes apart.
template <class View>
bool lies(const View &view, const void *data, std::size_t count, std::size_t stride, std::uint32_t component) {
    const BespokeView got = view.get();
    return got.data == data && got.count == count && got.stride == stride && got.component == component &&
           view.left_over() == 0;
}

void elements() {
    const std::vector<float> flat(12);
    CHECK(lies(Points(flat), flat.data(), 4, 0, BESPOKE_COMPONENT_F32));
    CHECK(lies(Points(flat.data(), 4, 0), flat.data(), 4, 0, BESPOKE_COMPONENT_F32));
    CHECK(lies(Points(flat.data(), 2, 24), flat.data(), 2, 24, BESPOKE_COMPONENT_F32));
    CHECK(lies(Numbers(flat), flat.data(), 12, 4, BESPOKE_COMPONENT_F32));
    const double rows[4][3] = {};
    CHECK(lies(Points(rows), rows, 4, 24, BESPOKE_COMPONENT_F64));
    const std::vector<Padded> padded(3);
    CHECK(lies(Points(padded), padded.data(), 3, 32, BESPOKE_COMPONENT_F64));
    CHECK(lies(Points(padded.data(), 2), padded.data(), 2, 32, BESPOKE_COMPONENT_F64));
    CHECK(lies(Points(padded.data(), 2, 64), padded.data(), 2, 64, BESPOKE_COMPONENT_F64));
    const std::vector<Flat> wide(3);
    CHECK(lies(Points(wide), wide.data(), 3, 20, BESPOKE_COMPONENT_F32));
    const std::vector<Opaque> opaque(3);
    CHECK(lies(Points(opaque), opaque.data(), 3, 12, BESPOKE_COMPONENT_F32));
    const TArray<Upper> unreal{std::vector<Upper>(5)};
    CHECK(lies(Points(unreal), unreal.inside.data(), 5, 24, BESPOKE_COMPONENT_F64));
    const std::vector<IndexTriple> corners(2);
    CHECK(lies(Triangles(corners), corners.data(), 2, 12, BESPOKE_COMPONENT_U32));
    const std::uint16_t shorts[] = {0, 1, 1, 2};
    CHECK(lies(Bones(shorts), shorts, 2, 0, BESPOKE_COMPONENT_U16));
    const std::vector<std::pair<int, int>> pairs(3);
    CHECK(lies(Bones(pairs), pairs.data(), 3, 8, BESPOKE_COMPONENT_U32));
    CHECK(lies(Indices(shorts), shorts, 4, 2, BESPOKE_COMPONENT_U16));
    CHECK(lies(Points(), nullptr, 0, 0, BESPOKE_COMPONENT_F32));
    CHECK(lies(Triangles({}), nullptr, 0, 0, BESPOKE_COMPONENT_U32));
    const Vec3 *nothing = nullptr;
    CHECK(lies(Points(nothing, 0), nullptr, 0, 12, BESPOKE_COMPONENT_F32));
}

void members() {
    Vertices vertices(6);
    constexpr std::size_t stride = sizeof(Vertex);
    CHECK(lies(Points(vertices, &Vertex::position), vertices[0].position, 6, stride, BESPOKE_COMPONENT_F32));
    CHECK(lies(Points(vertices, &Vertex::place), &vertices[0].place, 6, stride, BESPOKE_COMPONENT_F64));
    CHECK(lies(Points(vertices.data() + 1, 4, &Vertex::normal), &vertices[1].normal, 4, stride, BESPOKE_COMPONENT_F32));
    CHECK(lies(Indices(vertices, &Vertex::pin), &vertices[0].pin, 6, stride, BESPOKE_COMPONENT_U32));
    CHECK(lies(Points(Vertices(), &Vertex::normal), nullptr, 0, stride, BESPOKE_COMPONENT_F32));
    const Derived derived[2] = {};
    CHECK(lies(Points(derived, &Vertex::place), &derived[0].place, 2, sizeof(Derived), BESPOKE_COMPONENT_F64));
    // Where x is not the first member of the element.
    struct Tagged {
        std::uint64_t tag;
        float x, y, z;
    };
    const std::vector<Tagged> tagged(3);
    CHECK(lies(Points(tagged), &tagged[0].x, 3, sizeof(Tagged), BESPOKE_COMPONENT_F32));
}

void rows() {
    const std::vector<float> matrix(12);
    const NumberRows three(matrix, 4);
    CHECK(lies(three, matrix.data(), 3, 0, BESPOKE_COMPONENT_F32) && three.columns() == 4);
    CHECK(NumberRows(matrix, 5).left_over() == 2 && NumberRows(matrix, 0).left_over() == 12);
    const NumberRows apart(matrix.data(), 2, 3, 24);
    CHECK(lies(apart, matrix.data(), 2, 24, BESPOKE_COMPONENT_F32) && apart.columns() == 3);
    const std::vector<std::array<std::uint16_t, 4>> joints(7);
    CHECK(lies(IndexRows(joints), joints.data(), 7, 8, BESPOKE_COMPONENT_U16) && IndexRows(joints).columns() == 4);
    const Vertices vertices(6);
    const IndexRows influences(vertices, &Vertex::joints);
    CHECK(lies(influences, vertices[0].joints, 6, sizeof(Vertex), BESPOKE_COMPONENT_U16) && influences.columns() == 4);
    const NumberRows weights(vertices.data(), 6, &Vertex::weights);
    CHECK(lies(weights, &vertices[0].weights, 6, sizeof(Vertex), BESPOKE_COMPONENT_F32) && weights.columns() == 4);
    const IndexRows rigid(vertices, &Vertex::pin);
    CHECK(rigid.columns() == 1);
}

void buffers() {
    std::vector<Upper> room(4);
    const BespokeBuffer whole = PointBuffer(room).get();
    CHECK(whole.data == room.data() && whole.capacity == 4 && whole.stride == 24);
    CHECK(whole.component == BESPOKE_COMPONENT_F64);
    Vertices vertices(3);
    const BespokeBuffer member = PointBuffer(vertices, &Vertex::position).get();
    CHECK(member.data == vertices[0].position && member.capacity == 3 && member.stride == sizeof(Vertex));
    std::vector<float> flat(11);
    CHECK(PointBuffer(flat).left_over() == 2 && PointBuffer(flat).numbers() == 11);
    CHECK(PointBuffer(flat).get().capacity == 3);
}

} // namespace

void views() {
    elements();
    members();
    rows();
    buffers();
}
