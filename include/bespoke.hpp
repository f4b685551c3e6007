/* Bespoke for C++17: bespoke.h with owners, typed views of arrays and results that carry their message.

   bespoke.h is the manual: what holds for a function there holds for the method of its name here, and is not said
   again.
   All is in the namespace `bespoke`, in this one file; exceptions and RTTI are not needed.

     auto session = bespoke::Session::create();
     if (!session) return session.error();
     if (auto set = session->set_garment(positions, triangles); !set) return set.error();   // and so on
     if (auto dressed = session->run(); !dressed) return dressed.error();
     auto points = session->read_garment_vertices();        // Result<std::vector<std::array<float, 3>>>

   Results.  A call that can fail returns a Result: a value, or an Error with status and message. Where the compiler has
     exceptions, or_throw() gives the value or throws that Error: session.run().or_throw().
   Empty handles.  A session or control that was moved from, released or never made is empty. Calls on it fail with
     INVALID_ARGUMENT.
   Views.  Points, Triangles, Bones, Indices, Numbers and rows of them are made where they are needed, from containers
     and pointers, and are read during the call only: temporaries are fine as arguments, a view in a variable is good as
     long as what it was made from. How numbers are stored follows from their C++ type; a wrong one does not compile.
   Enums.  A later library may use numbers that these do not name. They arrive as they are: have a `default` in a
     switch.
   Threads.  As in bespoke.h. Moving, releasing and destroying count as calls. */

#ifndef BESPOKE_HPP
#define BESPOKE_HPP

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error "bespoke.hpp needs C++17; bespoke.h does with any C++"
#endif

#include "bespoke.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#if __cplusplus >= 202002L || (defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#if __has_include(<stop_token>)
#include <stop_token>
#endif
#endif

namespace bespoke {

// ---- Enums ----------------------------------------------------------------------------------------------------------

// Begin of the enums: written by `make bindings` from bespoke.h; changes by hand are lost.

/// The outcome of a call: BespokeStatus.
enum class Status : std::uint32_t {
    ok = BESPOKE_STATUS_OK,
    invalid_argument = BESPOKE_STATUS_INVALID_ARGUMENT,
    invalid_state = BESPOKE_STATUS_INVALID_STATE,
    invalid_mesh = BESPOKE_STATUS_INVALID_MESH,
    invalid_skeleton = BESPOKE_STATUS_INVALID_SKELETON,
    invalid_weights = BESPOKE_STATUS_INVALID_WEIGHTS,
    self_intersection = BESPOKE_STATUS_SELF_INTERSECTION,
    not_enclosed = BESPOKE_STATUS_NOT_ENCLOSED,
    inflation_stalled = BESPOKE_STATUS_INFLATION_STALLED,
    not_verified = BESPOKE_STATUS_NOT_VERIFIED,
    cancelled = BESPOKE_STATUS_CANCELLED,
    busy = BESPOKE_STATUS_BUSY,
    internal = BESPOKE_STATUS_INTERNAL,
    memory_limit = BESPOKE_STATUS_MEMORY_LIMIT,
    no_thread = BESPOKE_STATUS_NO_THREAD,
    implausible_result = BESPOKE_STATUS_IMPLAUSIBLE_RESULT,
};

/// How one number of an array is stored: BespokeComponent. 0 is none of them, so that a forgotten field is noticed.
enum class Component : std::uint32_t {
    f32 = BESPOKE_COMPONENT_F32,
    f64 = BESPOKE_COMPONENT_F64,
    u16 = BESPOKE_COMPONENT_U16,
    u32 = BESPOKE_COMPONENT_U32,
};

/// The stage of a session: BespokeStage.
enum class Stage : std::uint32_t {
    setup = BESPOKE_STAGE_SETUP,
    prepared = BESPOKE_STAGE_PREPARED,
    inflate = BESPOKE_STAGE_INFLATE,
    fit = BESPOKE_STAGE_FIT,
    verify = BESPOKE_STAGE_VERIFY,
    done = BESPOKE_STAGE_DONE,
    failed = BESPOKE_STAGE_FAILED,
    cancelled = BESPOKE_STAGE_CANCELLED,
    repose = BESPOKE_STAGE_REPOSE,
};

/// A direction along one axis of the caller's coordinates: BespokeAxis.
enum class Axis : std::uint32_t {
    positive_x = BESPOKE_AXIS_POSITIVE_X,
    negative_x = BESPOKE_AXIS_NEGATIVE_X,
    positive_y = BESPOKE_AXIS_POSITIVE_Y,
    negative_y = BESPOKE_AXIS_NEGATIVE_Y,
    positive_z = BESPOKE_AXIS_POSITIVE_Z,
    negative_z = BESPOKE_AXIS_NEGATIVE_Z,
};

/// The order of a front face's corners, seen from the front: BespokeWinding.
enum class Winding : std::uint32_t {
    counter_clockwise = BESPOKE_WINDING_COUNTER_CLOCKWISE,
    clockwise = BESPOKE_WINDING_CLOCKWISE,
};

/// Form of the surface term (Eq. 2 of the paper): BespokeSurfaceForm.
enum class SurfaceForm : std::uint32_t {
    similarity = BESPOKE_SURFACE_FORM_SIMILARITY,
    printed = BESPOKE_SURFACE_FORM_PRINTED,
};

/// What a diagnostic is about: BespokeDiagnosticKind.
enum class DiagnosticKind : std::uint32_t {
    split_vertices = BESPOKE_DIAGNOSTIC_KIND_SPLIT_VERTICES,
    duplicate_triangle = BESPOKE_DIAGNOSTIC_KIND_DUPLICATE_TRIANGLE,
    degenerate_triangle = BESPOKE_DIAGNOSTIC_KIND_DEGENERATE_TRIANGLE,
    non_manifold_edge = BESPOKE_DIAGNOSTIC_KIND_NON_MANIFOLD_EDGE,
    unused_vertex = BESPOKE_DIAGNOSTIC_KIND_UNUSED_VERTEX,
    loose_piece = BESPOKE_DIAGNOSTIC_KIND_LOOSE_PIECE,
    self_intersection = BESPOKE_DIAGNOSTIC_KIND_SELF_INTERSECTION,
    near_contact = BESPOKE_DIAGNOSTIC_KIND_NEAR_CONTACT,
    avatar_penetrates = BESPOKE_DIAGNOSTIC_KIND_AVATAR_PENETRATES,
    coarse_coordinates = BESPOKE_DIAGNOSTIC_KIND_COARSE_COORDINATES,
    result_intersection = BESPOKE_DIAGNOSTIC_KIND_RESULT_INTERSECTION,
    pin_not_reached = BESPOKE_DIAGNOSTIC_KIND_PIN_NOT_REACHED,
    rigid_group_bent = BESPOKE_DIAGNOSTIC_KIND_RIGID_GROUP_BENT,
    inflation_blocked = BESPOKE_DIAGNOSTIC_KIND_INFLATION_BLOCKED,
    unit_mismatch = BESPOKE_DIAGNOSTIC_KIND_UNIT_MISMATCH,
    facing_mismatch = BESPOKE_DIAGNOSTIC_KIND_FACING_MISMATCH,
    sides_swapped = BESPOKE_DIAGNOSTIC_KIND_SIDES_SWAPPED,
    joint_misplaced = BESPOKE_DIAGNOSTIC_KIND_JOINT_MISPLACED,
    pose_blocked = BESPOKE_DIAGNOSTIC_KIND_POSE_BLOCKED,
    solved_posed = BESPOKE_DIAGNOSTIC_KIND_SOLVED_POSED,
    source_dressed = BESPOKE_DIAGNOSTIC_KIND_SOURCE_DRESSED,
    follower_intersects = BESPOKE_DIAGNOSTIC_KIND_FOLLOWER_INTERSECTS,
    morph_not_solved = BESPOKE_DIAGNOSTIC_KIND_MORPH_NOT_SOLVED,
    morph_intersects = BESPOKE_DIAGNOSTIC_KIND_MORPH_INTERSECTS,
    joints_unsure = BESPOKE_DIAGNOSTIC_KIND_JOINTS_UNSURE,
    weights_contradict = BESPOKE_DIAGNOSTIC_KIND_WEIGHTS_CONTRADICT,
    bones_unclear = BESPOKE_DIAGNOSTIC_KIND_BONES_UNCLEAR,
    foreign_part = BESPOKE_DIAGNOSTIC_KIND_FOREIGN_PART,
    carried_piece = BESPOKE_DIAGNOSTIC_KIND_CARRIED_PIECE,
    settings_adjusted = BESPOKE_DIAGNOSTIC_KIND_SETTINGS_ADJUSTED,
    kept_together = BESPOKE_DIAGNOSTIC_KIND_KEPT_TOGETHER,
    welded_near = BESPOKE_DIAGNOSTIC_KIND_WELDED_NEAR,
    t_junctions = BESPOKE_DIAGNOSTIC_KIND_T_JUNCTIONS,
    rims_not_found = BESPOKE_DIAGNOSTIC_KIND_RIMS_NOT_FOUND,
    untangled = BESPOKE_DIAGNOSTIC_KIND_UNTANGLED,
    opening_cap = BESPOKE_DIAGNOSTIC_KIND_OPENING_CAP,
    limb_misplaced = BESPOKE_DIAGNOSTIC_KIND_LIMB_MISPLACED,
    piece_resized = BESPOKE_DIAGNOSTIC_KIND_PIECE_RESIZED,
    not_converged = BESPOKE_DIAGNOSTIC_KIND_NOT_CONVERGED,
};

/// How much a diagnostic matters: BespokeSeverity.
enum class Severity : std::uint32_t {
    note = BESPOKE_SEVERITY_NOTE,
    warning = BESPOKE_SEVERITY_WARNING,
    error = BESPOKE_SEVERITY_ERROR,
};

/// Which of the inputs an element belongs to: BespokeSubject. Any number from Subject::layer on is a layer, and from
/// Subject::follower on a follower.
enum class Subject : std::uint32_t {
    garment = BESPOKE_SUBJECT_GARMENT,
    target_avatar = BESPOKE_SUBJECT_TARGET_AVATAR,
    source_avatar = BESPOKE_SUBJECT_SOURCE_AVATAR,
    source_skeleton = BESPOKE_SUBJECT_SOURCE_SKELETON,
    target_skeleton = BESPOKE_SUBJECT_TARGET_SKELETON,
    layer = BESPOKE_SUBJECT_LAYER,
    follower = BESPOKE_SUBJECT_FOLLOWER,
};

/// What the index of an element counts: BespokeElementKind.
enum class ElementKind : std::uint32_t {
    vertex = BESPOKE_ELEMENT_KIND_VERTEX,
    triangle = BESPOKE_ELEMENT_KIND_TRIANGLE,
    bone = BESPOKE_ELEMENT_KIND_BONE,
};

/// What a triangle of the avatar is to the garment: BespokePartRole.
enum class PartRole : std::uint32_t {
    automatic = BESPOKE_PART_ROLE_AUTOMATIC,
    body = BESPOKE_PART_ROLE_BODY,
    collision = BESPOKE_PART_ROLE_COLLISION,
    ignored = BESPOKE_PART_ROLE_IGNORED,
};

/// Why a joint is mapped as it is: BespokeJointReason.
enum class JointReason : std::uint32_t {
    nothing = BESPOKE_JOINT_REASON_NOTHING,
    caller = BESPOKE_JOINT_REASON_CALLER,
    name = BESPOKE_JOINT_REASON_NAME,
    structure = BESPOKE_JOINT_REASON_STRUCTURE,
    order = BESPOKE_JOINT_REASON_ORDER,
    same_name = BESPOKE_JOINT_REASON_SAME_NAME,
    ancestor = BESPOKE_JOINT_REASON_ANCESTOR,
};

// End of the enums.

// ---- Constants and versions -----------------------------------------------------------------------------------------

/// The value of a weight that switches its term off; 0 means the default.
inline constexpr double weight_off = BESPOKE_WEIGHT_OFF;

/// As the second joint of a pair: nothing corresponds to the first.
inline constexpr std::uint32_t no_joint = BESPOKE_NO_JOINT;

/// For bespoke_session_read_covered_triangles: the avatar itself.
inline constexpr std::uint32_t no_layer = BESPOKE_NO_LAYER;

/// Length of Progress::energies.
inline constexpr std::size_t max_terms = BESPOKE_MAX_TERMS;

/// The name of a status, such as "BESPOKE_STATUS_BUSY"; "BESPOKE_STATUS_UNKNOWN" for any other number. Threads: any.
inline const char *status_name(Status status) noexcept {
    return bespoke_status_name(static_cast<std::uint32_t>(status));
}

/// The binary interface of the library that is loaded, which Session::create compares with BESPOKE_ABI_VERSION.
/// Threads: any.
inline std::uint32_t abi_version() noexcept { return bespoke_abi_version(); }

/// The version of the library that is loaded, such as "0.1.0". Threads: any.
inline const char *version_text() noexcept { return bespoke_version_text(); }

// ---- Results --------------------------------------------------------------------------------------------------------

/// Why a call failed: a status for programs, and a message for people. What or_throw() throws.
class Error : public std::exception {
public:
    /// An error of the caller's own is made in the same way, so that it goes where those of the library go.
    Error(Status status, std::string message) : status_(status), message_(std::move(message)) {}

    /// Not Status::ok.
    Status status() const noexcept { return status_; }

    /// What, where and which element, in UTF-8. Never empty where the library failed.
    const std::string &message() const noexcept { return message_; }

    /// The message.
    const char *what() const noexcept override { return message_.c_str(); }

private:
    Status status_;
    std::string message_;
};

namespace detail {

/// Ends a program that uses a value or an error that is not there: a message on the standard error output, then abort.
[[noreturn]] inline void refuse(const char *mistake, const std::string &message) noexcept {
    std::fprintf(stderr, "bespoke: %s%s%s\n", mistake, message.empty() ? "" : ": ", message.c_str());
    std::abort();
}

} // namespace detail

/// What a call gave: a value, or an Error. To be looked at: the compiler warns where one is dropped.
///
/// `if (result)` asks whether there is a value. value(), * and -> of a failure, and error() of a success, end the
/// program with a message (std::abort), in release builds too. Of a temporary result, value(), * and or_throw() give
/// the value itself and no reference, so that `for (const auto &entry : session.read_diagnostics().value())` is sound.
template <class T> class [[nodiscard]] Result {
public:
    Result(T value) : value_(std::move(value)), error_(Status::ok, {}) {}
    Result(Error error) : error_(std::move(error)) {}

    explicit operator bool() const noexcept { return value_.has_value(); }

    /// The value; ends the program where there is none, as do * and ->.
    T &value() & { return require(), *value_; }
    const T &value() const & { return require(), *value_; }
    T value() && { return require(), std::move(*value_); }

    T &operator*() & { return value(); }
    const T &operator*() const & { return value(); }
    T operator*() && { return std::move(*this).value(); }
    T *operator->() { return &value(); }
    const T *operator->() const { return &value(); }

    /// The value, or this one where there is none.
    template <class U> T value_or(U &&other) const & { return value_ ? *value_ : T(std::forward<U>(other)); }
    template <class U> T value_or(U &&other) && { return value_ ? std::move(*value_) : T(std::forward<U>(other)); }

    /// Status::ok where there is a value.
    Status status() const noexcept { return error_.status(); }
    /// Empty where there is a value.
    const std::string &message() const noexcept { return error_.message(); }

    /// The error; ends the program where there is none.
    const Error &error() const {
        if (value_) detail::refuse("error() of a result without an error", {});
        return error_;
    }

    /// `next(value)`, which returns a Result, or this error.
    template <class Next> auto and_then(Next &&next) && -> std::invoke_result_t<Next, T &&> {
        if (!value_) return std::move(error_);
        return std::forward<Next>(next)(std::move(*value_));
    }

#ifdef __cpp_exceptions
    /// The value; throws the Error where there is none.
    T or_throw() && {
        if (!value_) throw std::move(error_);
        return std::move(*value_);
    }
    const T &or_throw() const & {
        if (!value_) throw error_;
        return *value_;
    }
#endif

private:
    void require() const {
        if (!value_) detail::refuse("value of a result without a value", error_.message());
    }

    std::optional<T> value_;
    Error error_;
};

/// What a call gave that has nothing to give but its success.
template <> class [[nodiscard]] Result<void> {
public:
    Result() : error_(Status::ok, {}) {}
    Result(Error error) : error_(std::move(error)) {}

    explicit operator bool() const noexcept { return error_.status() == Status::ok; }

    /// Ends the program with a message where the call failed.
    void value() const {
        if (!*this) detail::refuse("value of a result without a value", error_.message());
    }

    /// Status::ok where the call succeeded.
    Status status() const noexcept { return error_.status(); }
    /// Empty where the call succeeded.
    const std::string &message() const noexcept { return error_.message(); }

    /// The error; ends the program where there is none.
    const Error &error() const {
        if (*this) detail::refuse("error() of a result without an error", {});
        return error_;
    }

    /// `next()`, which returns a Result, or this error.
    template <class Next> auto and_then(Next &&next) && -> std::invoke_result_t<Next> {
        if (!*this) return std::move(error_);
        return std::forward<Next>(next)();
    }

#ifdef __cpp_exceptions
    /// Throws the Error where the call failed.
    void or_throw() const {
        if (!*this) throw error_;
    }
#endif

private:
    Error error_;
};

// ---- Layouts of elements --------------------------------------------------------------------------------------------

/// An element of `Width` numbers, one after the other, `Offset` bytes from its beginning.
template <class Number, std::size_t Width, std::size_t Offset = 0> struct Packed {
    using Component = Number;
    static constexpr std::size_t width = Width;
    static constexpr std::size_t offset = Offset;
};

namespace detail {

template <class Member> struct MemberType;
template <class Class, class Type> struct MemberType<Type Class::*> {
    using type = std::remove_cv_t<Type>;
};
/// The type of a data member, from the pointer to it; none for functions.
template <class Member>
using MemberNumber =
    std::enable_if_t<std::is_member_object_pointer_v<Member>, typename MemberType<std::remove_cv_t<Member>>::type>;

/// What is not known to hold numbers.
using NoLayout = Packed<void, 0>;

// Structs whose members x, y, z, w are numbers of one type, one after the other: two of them, three or all. Further
// members may follow. Once for each way of writing the names.
#define BESPOKE_HPP_NAMED_MEMBERS(Name, x, y, z, w)                                                                    \
    template <class T, class = void> struct Name##Z : std::false_type {};                                             \
    template <class T>                                                                                                 \
    struct Name##Z<T, std::enable_if_t<std::is_same_v<MemberNumber<decltype(&T::x)>, MemberNumber<decltype(&T::z)>>>> \
        : std::true_type {};                                                                                           \
    template <class T, class = void> struct Name##W : std::false_type {};                                             \
    template <class T>                                                                                                 \
    struct Name##W<T, std::enable_if_t<std::is_same_v<MemberNumber<decltype(&T::x)>, MemberNumber<decltype(&T::w)>>>> \
        : std::true_type {};                                                                                           \
    template <class T> constexpr std::size_t Name##_width() {                                                          \
        constexpr std::size_t first = offsetof(T, x), size = sizeof(MemberNumber<decltype(&T::x)>);                    \
        if constexpr (offsetof(T, y) != first + size) {                                                                \
            return 0;                                                                                                  \
        } else if constexpr (!Name##Z<T>::value) {                                                                     \
            return 2;                                                                                                  \
        } else if constexpr (offsetof(T, z) != first + 2 * size) {                                                     \
            return 0;                                                                                                  \
        } else if constexpr (!Name##W<T>::value) {                                                                     \
            return 3;                                                                                                  \
        } else {                                                                                                       \
            return offsetof(T, w) == first + 3 * size ? 4 : 0;                                                         \
        }                                                                                                              \
    }                                                                                                                  \
    template <class T, class = void> struct Name : NoLayout {};                                                        \
    template <class T>                                                                                                 \
    struct Name<T, std::enable_if_t<std::is_standard_layout_v<T> &&                                                    \
                                    std::is_same_v<MemberNumber<decltype(&T::x)>, MemberNumber<decltype(&T::y)>>>>     \
        : Packed<MemberNumber<decltype(&T::x)>, Name##_width<T>(), offsetof(T, x)> {};
BESPOKE_HPP_NAMED_MEMBERS(Lower, x, y, z, w)
BESPOKE_HPP_NAMED_MEMBERS(Upper, X, Y, Z, W)
#undef BESPOKE_HPP_NAMED_MEMBERS

template <class T, bool is_class = std::is_class_v<T>> struct LayoutOf : NoLayout {};
template <class T> struct LayoutOf<T, true> : std::conditional_t<Lower<T>::width != 0, Lower<T>, Upper<T>> {};

} // namespace detail

/// How an element of a caller's array is made up. Known are numbers, T[n], std::array<T, n> and std::pair<T, T> of
/// them, and structs of standard layout that have members x and y (and z, and w), or X, Y, Z, W, of one type and in a
/// row. Others are declared like this:
///
///     template <> struct bespoke::Layout<Eigen::Vector3f> : bespoke::Packed<float, 3> {};
template <class T> struct Layout
    : std::conditional_t<std::is_arithmetic_v<T>, Packed<T, 1>, detail::LayoutOf<T>> {};
template <class T, std::size_t Width> struct Layout<T[Width]> : Packed<T, std::is_arithmetic_v<T> ? Width : 0> {};
template <class T, std::size_t Width>
struct Layout<std::array<T, Width>> : Packed<T, std::is_arithmetic_v<T> ? Width : 0> {};
template <class T> struct Layout<std::pair<T, T>> : Packed<T, std::is_arithmetic_v<T> ? 2 : 0> {};

// ---- Views of the caller's arrays -----------------------------------------------------------------------------------

namespace detail {

/// The numbers of positions, weights and distances: float, double.
struct Real {
    template <class T> static constexpr bool holds = std::is_same_v<T, float> || std::is_same_v<T, double>;
    static constexpr Component first = Component::f32;
};

/// The numbers that count vertices and joints: 16-bit unsigned integers, and those of 32 bits, also where their type is
/// signed: a negative one is an index that no mesh has, and is refused.
struct Index {
    template <class T>
    static constexpr bool holds =
        std::is_same_v<T, unsigned short> ||
        (sizeof(std::conditional_t<std::is_void_v<T>, char, T>) == 4 &&
         (std::is_same_v<T, unsigned> || std::is_same_v<T, int> || std::is_same_v<T, unsigned long> ||
          std::is_same_v<T, long>));
    static constexpr Component first = Component::u32;
};

template <class T> constexpr std::uint32_t component_of() {
    constexpr auto component = std::is_same_v<T, double>  ? Component::f64
                               : std::is_same_v<T, float> ? Component::f32
                               : sizeof(T) == 2           ? Component::u16
                                                          : Component::u32;
    return static_cast<std::uint32_t>(component);
}

/// Elements side by side: std::vector, std::array, std::span, arrays of C and their like, TArray of the Unreal Engine.
template <class Container> constexpr auto data_of(Container &container) -> decltype(std::data(container)) {
    return std::data(container);
}
template <class Container> constexpr auto data_of(Container &container) -> decltype(container.GetData()) {
    return container.GetData();
}
template <class Container>
constexpr auto size_of(Container &container) -> decltype(static_cast<std::size_t>(std::size(container))) {
    return static_cast<std::size_t>(std::size(container));
}
template <class Container>
constexpr auto size_of(Container &container) -> decltype(static_cast<std::size_t>(container.Num())) {
    return static_cast<std::size_t>(container.Num());
}

/// The type of a container's elements, const where they cannot be written.
template <class Container, class = decltype(size_of(std::declval<Container &>()))>
using ElementOf = std::remove_pointer_t<decltype(data_of(std::declval<Container &>()))>;

/// The type of a member as it is seen in objects of this type; none where they have no such member.
template <class Object, class Class, class Member>
using MemberOf = std::enable_if_t<std::is_base_of_v<Class, Object>,
                                  std::conditional_t<std::is_const_v<Object>, const Member, Member>>;

template <class T> using LayoutFor = Layout<std::remove_cv_t<T>>;
template <class T> using NumberFor = typename LayoutFor<T>::Component;

/// Where the array lies, for both kinds of it: `Void` is const void where it is read, void where it is written.
template <class Family, class Void> class Strided {
public:
    /// What a whole number of elements leaves over of a flat array, and how many numbers that has.
    std::size_t left_over() const noexcept { return left_over_; }
    std::size_t numbers() const noexcept { return numbers_; }

    /// The array as the C API takes it: a BespokeView, or a BespokeBuffer where it is written.
    auto get() const noexcept {
        if constexpr (std::is_const_v<Void>) {
            return BespokeView{data_, count_, stride_, component_};
        } else {
            return BespokeBuffer{data_, count_, stride_, component_};
        }
    }

protected:
    template <class T>
    static constexpr bool holds =
        (std::is_const_v<Void> || !std::is_const_v<T>) && Family::template holds<NumberFor<T>>;

    Strided() = default;

    template <class T> void set(T *first, std::size_t count, std::size_t stride) {
        using Bytes = std::conditional_t<std::is_const_v<Void>, const unsigned char, unsigned char>;
        data_ = first == nullptr ? nullptr : reinterpret_cast<Bytes *>(first) + LayoutFor<T>::offset;
        count_ = count;
        stride_ = stride;
        component_ = component_of<NumberFor<T>>();
    }

    /// Numbers without further structure, `width` for each element.
    template <class T> void set_flat(T *first, std::size_t numbers, std::size_t width) {
        set(first, width == 0 ? 0 : numbers / width, 0);
        numbers_ = numbers;
        left_over_ = width == 0 ? numbers : numbers % width;
    }

    template <class Object, class Class, class Member>
    void set_member(Object *first, std::size_t count, Member Class::*member) {
        set(first == nullptr || count == 0 ? nullptr : &(first->*member), count, sizeof(Object));
    }

private:
    Void *data_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    std::uint32_t component_ = static_cast<std::uint32_t>(Family::first);
    std::size_t numbers_ = 0;
    std::size_t left_over_ = 0;
};

/// Elements of `Width` numbers each. See the names below for what can be made of what.
template <class Family, std::size_t Width, class Void> class Elements : public Strided<Family, Void> {
    using Base = Strided<Family, Void>;
    template <class T> static constexpr bool is_element = Base::template holds<T> && LayoutFor<T>::width == Width;
    template <class T> static constexpr bool is_number = Base::template holds<T> && std::is_arithmetic_v<T>;

public:
    static constexpr std::size_t width = Width;

    /// None.
    Elements() = default;

    /// A container of elements, or of numbers, `Width` for each element.
    template <class Container, class T = ElementOf<Container>,
              class = std::enable_if_t<is_element<T> || is_number<T>>>
    Elements(Container &container) {
        take(data_of(container), size_of(container));
    }
    template <class Container, class T = ElementOf<const Container>,
              class = std::enable_if_t<is_element<T> || is_number<T>>>
    Elements(const Container &container) {
        take(data_of(container), size_of(container));
    }

    /// `count` elements, one after the other.
    template <class T, class = std::enable_if_t<is_element<T>>>
    Elements(T *first, std::size_t count) {
        this->set(first, count, sizeof(T));
    }

    /// `count` elements, `stride` bytes apart (0: one after the other). `first` may also point to the first number of
    /// the first element. The stride is required: without it, `count` could be meant as a count of numbers.
    template <class T, class = std::enable_if_t<is_element<T> || is_number<T>>>
    Elements(T *first, std::size_t count, std::size_t stride) {
        constexpr std::size_t packed = LayoutFor<T>::width == Width ? sizeof(T) : 0;
        this->set(first, count, stride == 0 ? packed : stride);
    }

    /// One member of each of `count` structs.
    template <class Object, class Class, class Member,
              class = std::enable_if_t<is_element<MemberOf<Object, Class, Member>>>>
    Elements(Object *first, std::size_t count, Member Class::*member) {
        this->set_member(first, count, member);
    }

    /// One member of each of a container's structs.
    template <class Container, class Class, class Member, class Object = ElementOf<Container>,
              class = std::enable_if_t<is_element<MemberOf<Object, Class, Member>>>>
    Elements(Container &container, Member Class::*member) {
        this->set_member(data_of(container), size_of(container), member);
    }
    template <class Container, class Class, class Member, class Object = ElementOf<const Container>,
              class = std::enable_if_t<is_element<MemberOf<Object, Class, Member>>>>
    Elements(const Container &container, Member Class::*member) {
        this->set_member(data_of(container), size_of(container), member);
    }

private:
    template <class T> void take(T *first, std::size_t count) {
        if constexpr (LayoutFor<T>::width == Width) {
            this->set(first, count, sizeof(T));
        } else {
            this->set_flat(first, count, Width);
        }
    }
};

/// Rows of numbers, as many in each.
template <class Family> class Rows : public Strided<Family, const void> {
    using Base = Strided<Family, const void>;
    template <class T> static constexpr bool is_row = Base::template holds<T> && LayoutFor<T>::width != 0;
    template <class T> static constexpr bool is_number = Base::template holds<T> && std::is_arithmetic_v<T>;

public:
    /// None.
    Rows() = default;

    /// A container of rows: of std::array, for example.
    template <class Container, class T = ElementOf<const Container>,
              class = std::enable_if_t<is_row<T> && !is_number<T>>>
    Rows(const Container &container) : columns_(LayoutFor<T>::width) {
        this->set(data_of(container), size_of(container), sizeof(T));
    }

    /// A container of numbers, row after row, `columns` in each.
    template <class Container, class T = ElementOf<const Container>, class = std::enable_if_t<is_number<T>>>
    Rows(const Container &container, std::size_t columns) : columns_(columns) {
        this->set_flat(data_of(container), size_of(container), columns);
    }

    /// `rows` rows of `columns` numbers, `stride` bytes apart (0: one after the other).
    template <class T, class = std::enable_if_t<is_number<T>>>
    Rows(const T *first, std::size_t rows, std::size_t columns, std::size_t stride = 0) : columns_(columns) {
        this->set(first, rows, stride);
    }

    /// One member of each of `count` structs.
    template <class Object, class Class, class Member,
              class = std::enable_if_t<is_row<MemberOf<const Object, Class, Member>>>>
    Rows(const Object *first, std::size_t count, Member Class::*member) : columns_(LayoutFor<Member>::width) {
        this->set_member(first, count, member);
    }

    /// One member of each of a container's structs.
    template <class Container, class Class, class Member, class Object = ElementOf<const Container>,
              class = std::enable_if_t<is_row<MemberOf<Object, Class, Member>>>>
    Rows(const Container &container, Member Class::*member) : columns_(LayoutFor<Member>::width) {
        this->set_member(data_of(container), size_of(container), member);
    }

    /// Numbers in each row.
    std::size_t columns() const noexcept { return columns_; }

private:
    std::size_t columns_ = 0;
};

} // namespace detail

/// Points (x, y, z): float or double. From
/// - a container of elements: std::vector<std::array<float, 3>>, MyVec3[n], TArray<FVector> ... (see Layout);
/// - a container of numbers, three for each point: std::vector<float>, std::span<const double> ...;
/// - pointer and count of elements: {first, count};
/// - pointer to an element or to its first number, count of elements and stride in bytes: {first, count, stride};
/// - a member of structs: {vertices, &MyVertex::position}, {first, count, &MyVertex::position}.
/// Numbers that are left over when three make a point are an error of the call, not cut off.
using Points = detail::Elements<detail::Real, 3, const void>;

/// Triangles, three vertices each, counted from 0: std::uint16_t, std::uint32_t or std::int32_t. Made as Points are.
using Triangles = detail::Elements<detail::Index, 3, const void>;

/// Bones, two joints each, counted from 0, of the types of Triangles. Made as Points are.
using Bones = detail::Elements<detail::Index, 2, const void>;

/// Pairs of joints, the first of the source rig and the second of the target rig, counted from 0, of the types of
/// Triangles. no_joint (65535 in std::uint16_t, -1 in std::int32_t) as the second: nothing corresponds to the first.
/// Made as Points are.
using JointPairs = detail::Elements<detail::Index, 2, const void>;

/// Vertices, counted from 0, of the types of Triangles. Made as Points are.
using Indices = detail::Elements<detail::Index, 1, const void>;

/// Numbers: float or double. Made as Points are.
using Numbers = detail::Elements<detail::Real, 1, const void>;

/// Tangents (x, y, z and the handedness of the bitangent): float or double. Made as Points are.
using Tangents = detail::Elements<detail::Real, 4, const void>;

/// Rows of numbers, float or double. From
/// - a container of rows: std::vector<std::array<float, 4>>, MyVec4[n] ... (see Layout);
/// - a container of numbers and how many there are in a row: {weights, columns};
/// - pointer, rows and columns: {first, rows, columns}, and {first, rows, columns, stride in bytes};
/// - a member of structs: {vertices, &MyVertex::weights}, {first, count, &MyVertex::weights}.
using NumberRows = detail::Rows<detail::Real>;

/// Rows of joints, counted from 0, of the types of Triangles. Made as NumberRows are.
using IndexRows = detail::Rows<detail::Index>;

/// Room for points that are written: made as Points are, of what can be written and is not a temporary.
using PointBuffer = detail::Elements<detail::Real, 3, void>;

/// Room for numbers that are written: made as PointBuffer is.
using NumberBuffer = detail::Elements<detail::Real, 1, void>;

// ---- Structs --------------------------------------------------------------------------------------------------------

/// A coordinate system: BespokeCoordinateSystem. Handedness follows from the axes.
struct CoordinateSystem {
    /// The axis that points to the right.
    Axis right = Axis::positive_x;
    /// The axis that points up.
    Axis up = Axis::positive_y;
    /// The axis that points forward, away from the viewer.
    Axis forward = Axis::negative_z;
    /// Length of the unit in metres.
    double metres_per_unit = 1.0;
    /// The order of a front face's corners, seen from the front.
    Winding winding = Winding::counter_clockwise;
    /// It is right as it is: what is given in it is neither turned nor refused for unit, axes, facing and sides.
    bool trusted = false;

    /// As the C API takes it.
    BespokeCoordinateSystem get() const noexcept {
        BespokeCoordinateSystem made{};
        made.struct_size = sizeof made;
        made.right = static_cast<std::uint32_t>(right);
        made.up = static_cast<std::uint32_t>(up);
        made.forward = static_cast<std::uint32_t>(forward);
        made.metres_per_unit = metres_per_unit;
        made.winding = static_cast<std::uint32_t>(winding);
        made.trusted = trusted ? 1 : 0;
        return made;
    }
};

// Begin of the options: written by `make bindings` from bespoke.h; changes by hand are lost.

/// What may be tuned: BespokeOptions. Zero means the default, which is what a new Options has everywhere; `weight_off`
/// switches a term off where that is possible. Lengths are in the normalised space, in which the longest side of the
/// skeleton's bounding box is 2.
struct Options {
    /// Threads of this session [1, 1024], of which at most as many are started as the process may use cores (its
    /// affinity and its container decide). Default: all of these. Report.threads says how many work.
    std::uint32_t threads = 0;
    /// Weight of the fit term, higher is tighter. Default 2. weight_off: no fit.
    double fit_weight = 0.0;
    /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point of
    /// the garment had on it, in proportion to the limb there [up to 2]. Default 1, as designed. weight_off: tight, as
    /// without a source avatar.
    double designed_clearance = 0.0;
    /// Clearance to aim at everywhere, in addition to the designed one, in the target's unit, from 0 to half the size
    /// of the target skeleton. What is nearer is pushed away, what is farther is drawn in. Default 0.
    double offset = 0.0;
    /// Where a source avatar is given and no fit weights: what was designed farther away from it than this fits less,
    /// and not at all from twice this distance on. Default 0.1. weight_off: the garment fits as a whole.
    double fit_distance = 0.0;
    /// Weight of pins (Session::set_pinned_vertices), which are springs. Default 1000.
    double pin_weight = 0.0;
    /// Weld distance: open seams of the garment whose sides are nearer than this share of its mean edge are closed [up
    /// to 0.25]. Default 0.01. weight_off: only vertices at equal positions are welded.
    double weld_distance = 0.0;
    /// Bytes that the session may take at most. Default: no limit. What a session needs is estimated from the sizes of
    /// its meshes before it begins, and checked again during the run.
    std::uint64_t memory_limit = 0;
    /// True: a garment that intersects itself at the start is refused. Default false: the triangles that do so are
    /// exempted from contact until they separate and named by Session::read_diagnostics; none are added later. So is a
    /// target that faces another way than the source, which is turned by default.
    bool strict = false;
    /// True: triangles that close an opening where a bone leaves the garment, as at neck, waist, cuffs and hems, stay,
    /// and the garment is refused for them. Default false: they are left out while it is fitted, go with their rim, and
    /// are named by Session::read_diagnostics. They are not verified: the body passes through them.
    bool keep_caps = false;
    /// Expert. Weight of the surface term, which keeps the design's shape. Default 1.
    double surface_weight = 0.0;
    /// Expert. Weight of the curvature of boundary curves. Default 2.5. weight_off possible.
    double curvature_weight = 0.0;
    /// Expert. Weight of the torsion of boundary curves. Default 2.5. weight_off possible.
    double torsion_weight = 0.0;
    /// Expert. Weight of the positions of cuffs, hems and collars along their bones. Default 10. weight_off possible.
    double position_weight = 0.0;
    /// Expert. Weight of the contact barrier, on squared distances [1, 1e14]. Default 1e8.
    double barrier_weight = 0.0;
    /// Expert. Distance at which the barrier begins [1e-5, 0.1]. Default 0.002.
    double dhat = 0.0;
    /// Expert. While the avatar grows: distance to it at which the barrier begins [1e-5, 0.1]. Default 0.01.
    double inflation_dhat = 0.0;
    /// Expert. While the avatar grows: weight of the contact barrier [1, 1e14]. Default 1e4.
    double inflation_barrier_weight = 0.0;
    /// Expert. Edge of a voxel of the distance field [1e-3, 0.2]. Default 0.01.
    double voxel_size = 0.0;
    /// Expert. Minimum separation: distance that no contact pair ever falls below [1e-8, 0.01], less than half of
    /// `dhat` and of `inflation_dhat`. Default 1e-5.
    double min_separation = 0.0;
    /// Expert. The fit ends where two Newton steps in turn have a squared Newton decrement, twice what the step
    /// promises to gain, below this share of the objective [1e-12, 1]. Default 1e-3.
    double tolerance = 0.0;
    /// Expert. Largest number of Newton iterations of each stage. Default 500.
    std::uint32_t max_iterations = 0;
    /// Expert. One of SurfaceForm. Default SurfaceForm::similarity.
    SurfaceForm surface_form = SurfaceForm::similarity;
    /// Expert. Distance across two triangles at which they weigh their area in the surface term [up to 1]. Smaller ones
    /// weigh more, so that the fit is the same at every resolution of the garment. Default 0.048. weight_off: all weigh
    /// their area, as printed in the paper.
    double surface_length = 0.0;
    /// Expert. Distance along a boundary curve between the points from which the curvature and torsion terms read its
    /// bends [up to 1], a share of its length at most. So a V stays a V at every resolution of the garment. Default
    /// 0.08. weight_off: from its vertices, as printed in the paper.
    double curve_chord = 0.0;

    /// As the C API takes them.
    BespokeOptions get() const noexcept {
        BespokeOptions options{};
        options.struct_size = sizeof options;
        options.threads = threads;
        options.fit_weight = fit_weight;
        options.designed_clearance = designed_clearance;
        options.offset = offset;
        options.fit_distance = fit_distance;
        options.pin_weight = pin_weight;
        options.weld_distance = weld_distance;
        options.memory_limit = memory_limit;
        options.strict = strict ? 1 : 0;
        options.keep_caps = keep_caps ? 1 : 0;
        options.surface_weight = surface_weight;
        options.curvature_weight = curvature_weight;
        options.torsion_weight = torsion_weight;
        options.position_weight = position_weight;
        options.barrier_weight = barrier_weight;
        options.dhat = dhat;
        options.inflation_dhat = inflation_dhat;
        options.inflation_barrier_weight = inflation_barrier_weight;
        options.voxel_size = voxel_size;
        options.min_separation = min_separation;
        options.tolerance = tolerance;
        options.max_iterations = max_iterations;
        options.surface_form = static_cast<std::uint32_t>(surface_form);
        options.surface_length = surface_length;
        options.curve_chord = curve_chord;
        return options;
    }

    /// The defaults written out: bespoke_options_read_defaults. Errors: INVALID_ARGUMENT, where the library does not
    /// know this header. Threads: any.
    static Result<Options> read_defaults() {
        BespokeOptions read{};
        read.struct_size = sizeof read;
        const auto status = static_cast<Status>(bespoke_options_read_defaults(&read));
        if (status != Status::ok) {
            return Error(status, "the library refuses to write into a BespokeOptions of this header's size");
        }
        Options options;
        options.threads = read.threads;
        options.fit_weight = read.fit_weight;
        options.designed_clearance = read.designed_clearance;
        options.offset = read.offset;
        options.fit_distance = read.fit_distance;
        options.pin_weight = read.pin_weight;
        options.weld_distance = read.weld_distance;
        options.memory_limit = read.memory_limit;
        options.strict = read.strict != 0;
        options.keep_caps = read.keep_caps != 0;
        options.surface_weight = read.surface_weight;
        options.curvature_weight = read.curvature_weight;
        options.torsion_weight = read.torsion_weight;
        options.position_weight = read.position_weight;
        options.barrier_weight = read.barrier_weight;
        options.dhat = read.dhat;
        options.inflation_dhat = read.inflation_dhat;
        options.inflation_barrier_weight = read.inflation_barrier_weight;
        options.voxel_size = read.voxel_size;
        options.min_separation = read.min_separation;
        options.tolerance = read.tolerance;
        options.max_iterations = read.max_iterations;
        options.surface_form = static_cast<SurfaceForm>(read.surface_form);
        options.surface_length = read.surface_length;
        options.curve_chord = read.curve_chord;
        return options;
    }
};

// End of the options.

/// How far a step goes; 0 is no limit. With neither, it goes to the end.
struct Budget {
    /// Newton iterations.
    std::uint32_t iterations = 0;
    /// Checked after each iteration, so that a step may take somewhat longer.
    std::uint32_t milliseconds = 0;
};

/// Progress of a session, a snapshot: BespokeProgress. Lengths are in the normalised space.
struct Progress {
    Stage stage = Stage::setup;
    /// Iterations of this stage so far.
    std::uint32_t iteration = 0;
    /// How many of `energies` are in use.
    std::uint32_t energy_count = 0;
    /// Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
    double t = 0.0;
    /// The objective: the sum of `energies`.
    double energy = 0.0;
    /// Euclidean norm of the objective's gradient.
    double gradient_norm = 0.0;
    /// Smallest distance of a contact pair; infinite where no pair is near.
    double min_distance = 0.0;
    /// Contact pairs closer than dhat.
    std::uint64_t active_contacts = 0;
    /// Seconds in each stage so far.
    double prepare_seconds = 0.0;
    double inflate_seconds = 0.0;
    double fit_seconds = 0.0;
    double verify_seconds = 0.0;
    /// Each term with its weight, in the order of Session::read_energies.
    std::array<double, max_terms> energies{};
};

/// Pairs of triangles that touch or cross each other.
using Intersections = BespokeIntersections;

/// The cost of one stage.
using StageReport = BespokeStageReport;

/// Measurements of a session so far.
using Report = BespokeReport;

/// One term of the objective, to which it adds weight * value.
struct Energy {
    /// Such as "surface".
    std::string name;
    /// Value without its weight.
    double value = 0.0;
    double weight = 0.0;
};

/// A vertex, triangle or bone of an input: BespokeElement.
struct Element {
    Subject subject;
    ElementKind kind;
    /// The caller's index, from 0.
    std::uint32_t index;

    /// Which layer it belongs to, from 0; none where it is no layer's.
    std::optional<std::uint32_t> layer() const noexcept {
        if (subject < Subject::layer || subject >= Subject::follower) return std::nullopt;
        return static_cast<std::uint32_t>(subject) - static_cast<std::uint32_t>(Subject::layer);
    }

    /// Which follower it belongs to, from 0; none where it is no follower's.
    std::optional<std::uint32_t> follower() const noexcept {
        if (subject < Subject::follower) return std::nullopt;
        return static_cast<std::uint32_t>(subject) - static_cast<std::uint32_t>(Subject::follower);
    }
};

/// A joint of a rig: BespokeJoint.
struct Joint {
    /// Its name, UTF-8, as the tool has it; empty: it has none.
    std::string name;
    /// The joint that moves it, from 0, in any order; none for a root.
    std::optional<std::uint32_t> parent;
    /// The bind transform: from the joint's own space to that in which the mesh is given, in the pose in which the mesh
    /// is given. Column after column: numbers 12 to 14 (from 0) are the joint's place.
    std::array<double, BESPOKE_TRANSFORM_SIZE> bind{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
};

/// A joint of the source rig and what corresponds to it in the target rig: BespokeMappedJoint.
struct MappedJoint {
    /// The target rig's joint, where there is one.
    std::optional<std::uint32_t> target;
    /// Why.
    JointReason reason;
    /// From 0, a guess, to 1, sure.
    double confidence;
    /// The part of the body, such as "left upper arm"; empty where it is none.
    std::string part;
};

/// Skin weights of a result: Session::read_garment_skin_influences.
struct GarmentSkin {
    /// Joints a vertex.
    std::size_t influences;
    /// Joints of the target rig and added joints together.
    std::size_t joint_count;
    /// `influences` joints for each vertex of the garment, the one with the largest weight first.
    std::vector<std::uint32_t> joints;
    /// As many weights, of sum 1 for each vertex.
    std::vector<float> weights;
};

/// Of two garments of an outfit that meet, which is worn beneath the other: BespokeWornPair.
struct WornPair {
    /// The garment beneath, by its number.
    std::uint32_t inner;
    /// The garment above it.
    std::uint32_t outer;
    /// From 0, as much speaks for the other order, to 1, nothing does.
    double confidence;
    /// The order does not follow this pair, for with surer ones it would have gone around in a circle.
    bool is_overruled;
};

/// Offsets of the garment in a key pose, and what they are good for.
template <class Point> struct PoseCorrection {
    /// One for each vertex of the garment, from the result, in the coordinate system of the target; added before skin weights.
    std::vector<Point> offsets;
    /// What passes through what in that pose by the weights alone.
    BespokePoseIntersections before;
    /// The same with the offsets.
    BespokePoseIntersections after;
};

/// What counts as covered by a garment.
struct Covering {
    /// The layer that is asked about; none: the avatar.
    std::optional<std::uint32_t> layer;
    /// So many rings of triangles are left beside those that are not covered.
    std::uint32_t margin = 1;
    /// The share of directions, from 0 to 1, in which a covered triangle may be seen all the same.
    double openness = 0.0;
};

/// A joint of the garment's own: BespokeAddedJoint.
struct AddedJoint {
    /// The joint of the source rig that it is.
    std::uint32_t source;
    /// A joint of the target rig, or an added one, which are numbered on from there; none for a root.
    std::optional<std::uint32_t> parent;
    /// Its bind transform in the coordinate system of the target, as in Joint.
    std::array<double, BESPOKE_TRANSFORM_SIZE> bind;
};

/// A garment as it is drawn, for Session::read_garment_normals; what is not given there is null in the C API.
struct RenderMesh {
    /// The garment's triangles in their order, by render vertices; none: the garment's vertices are those that are drawn.
    std::optional<Triangles> triangles;
    /// Normals of the design, one for each render vertex; none: they follow from the triangles.
    std::optional<Points> normals;
    /// Tangents of the design, one for each render vertex.
    std::optional<Tangents> tangents;
};

/// Normals of a result: Session::read_garment_normals.
struct GarmentNormals {
    /// One for each render vertex, of unit length.
    std::vector<std::array<float, 3>> normals;
    /// As many, where some were given.
    std::vector<std::array<float, 4>> tangents;
};

/// A diagnostic about the inputs or the result: BespokeDiagnostic.
struct Diagnostic {
    DiagnosticKind kind;
    Severity severity;
    /// What it is about, for a tool to select.
    std::vector<Element> elements;
    /// In the normalised space; NaN where it has none.
    double distance;
    /// One sentence, UTF-8.
    std::string message;
};

namespace detail {

inline Error empty_handle(const char *what) {
    return Error(Status::invalid_argument,
                 std::string("the ") + what + " is empty: it was moved from, released, destroyed or never made");
}

/// Success, or the failure of a call without a session's message.
inline Result<void> outcome(BespokeStatus status, const char *message) {
    if (status == BESPOKE_STATUS_OK) return {};
    const auto typed = static_cast<Status>(status);
    return Error(typed, std::string(status_name(typed)) + ": " + message);
}

/// Progress of a session or a control. It fails only where the library does not know the struct.
template <class Handle>
Result<Progress> read_progress(BespokeStatus (*read)(const Handle *, BespokeProgress *), const Handle *handle) {
    BespokeProgress from{};
    from.struct_size = sizeof from;
    const auto done =
        outcome(read(handle, &from), "the library refuses to write into a BespokeProgress of this header's size");
    if (!done) return done.error();
    Progress to;
    to.stage = static_cast<Stage>(from.stage);
    to.iteration = from.iteration;
    to.energy_count = from.energy_count;
    to.t = from.t;
    to.energy = from.energy;
    to.gradient_norm = from.gradient_norm;
    to.min_distance = from.min_distance;
    to.active_contacts = from.active_contacts;
    to.prepare_seconds = from.prepare_seconds;
    to.inflate_seconds = from.inflate_seconds;
    to.fit_seconds = from.fit_seconds;
    to.verify_seconds = from.verify_seconds;
    for (std::size_t k = 0; k < max_terms; k++) to.energies[k] = from.energies[k];
    return to;
}

/// The text up to its zero byte, or to the end of its room.
template <std::size_t Size> std::string text_of(const char (&text)[Size]) {
    std::size_t length = 0;
    while (length < Size && text[length] != '\0') length++;
    return std::string(text, length);
}

} // namespace detail

// ---- Cancel ---------------------------------------------------------------------------------------------------------

/// Cancellation and progress of one session; an object of its own that may outlive the session. Move-only.
class Control {
public:
    /// Empty.
    Control() = default;

    /// Takes over a handle from bespoke_session_create_control; null is empty.
    explicit Control(BespokeControl *handle) noexcept : handle_(handle) {}

    /// Whether there is a control in it.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// Cancels the session: bespoke_control_cancel. Errors: INVALID_ARGUMENT (empty). Threads: any, at any time; a
    /// signal handler may call it where the control is not empty.
    Result<void> cancel() const {
        if (!handle_) return detail::empty_handle("control");
        return detail::outcome(bespoke_control_cancel(handle_.get()), "the request to stop was refused");
    }

    /// The session's current progress, or its last: bespoke_control_read_progress. Errors: INVALID_ARGUMENT (empty).
    /// Threads: any, at any time.
    Result<Progress> read_progress() const {
        if (!handle_) return detail::empty_handle("control");
        return detail::read_progress<BespokeControl>(bespoke_control_read_progress, handle_.get());
    }

    /// The handle for the C API, which stays this object's; null where it is empty.
    BespokeControl *get() const noexcept { return handle_.get(); }

    /// Hands the handle over to the caller, to be given to bespoke_control_destroy, and is empty.
    [[nodiscard]] BespokeControl *release() noexcept { return handle_.release(); }

private:
    struct Destroy {
        void operator()(BespokeControl *handle) const noexcept { bespoke_control_destroy(handle); }
    };

    std::unique_ptr<BespokeControl, Destroy> handle_;
};

/// A body to dress that many sessions use, from Session::create_avatar: sessions keep what they use, so it may be destroyed at any time. It can be moved, not copied.
class Avatar {
public:
    /// Empty.
    Avatar() = default;

    /// Takes over a handle from bespoke_avatar_create; null is empty.
    explicit Avatar(BespokeAvatar *handle) noexcept : handle_(handle) {}

    /// Whether there is one in it.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The handle for the C API, which stays this object's; null where it is empty.
    const BespokeAvatar *get() const noexcept { return handle_.get(); }

    /// Hands the handle over to the caller, to be given to bespoke_avatar_destroy, and is empty.
    [[nodiscard]] BespokeAvatar *release() noexcept { return handle_.release(); }

private:
    struct Destroy {
        void operator()(BespokeAvatar *handle) const noexcept { bespoke_avatar_destroy(handle); }
    };

    std::unique_ptr<BespokeAvatar, Destroy> handle_;
};

/// A garment to fit that many sessions use, from Session::create_garment: sessions keep what they use, so it may be destroyed at any time. It can be moved, not copied.
class Garment {
public:
    /// Empty.
    Garment() = default;

    /// Takes over a handle from bespoke_garment_create; null is empty.
    explicit Garment(BespokeGarment *handle) noexcept : handle_(handle) {}

    /// Whether there is one in it.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The handle for the C API, which stays this object's; null where it is empty.
    const BespokeGarment *get() const noexcept { return handle_.get(); }

    /// Hands the handle over to the caller, to be given to bespoke_garment_destroy, and is empty.
    [[nodiscard]] BespokeGarment *release() noexcept { return handle_.release(); }

private:
    struct Destroy {
        void operator()(BespokeGarment *handle) const noexcept { bespoke_garment_destroy(handle); }
    };

    std::unique_ptr<BespokeGarment, Destroy> handle_;
};

namespace detail {

/// The state that sources and tokens of one request to stop share: the request, and the sessions that run with it.
class StopState {
public:
    bool is_requested() const noexcept { return is_requested_.load(std::memory_order_acquire); }

    /// Cancels every session that runs with it. Returns whether this was the first request.
    bool request() {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (is_requested_.exchange(true, std::memory_order_acq_rel)) return false;
        for (const BespokeSession *session : sessions_) bespoke_session_cancel(session);
        return true;
    }

    /// The caller checks the token afterwards, for a request that came before.
    void enter(const BespokeSession *session) {
        const std::lock_guard<std::mutex> lock(mutex_);
        sessions_.push_back(session);
    }

    void leave(const BespokeSession *session) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (auto entry = sessions_.begin(); entry != sessions_.end(); ++entry) {
            if (*entry == session) {
                sessions_.erase(entry);
                return;
            }
        }
    }

private:
    std::atomic<bool> is_requested_{false};
    std::mutex mutex_;
    std::vector<const BespokeSession *> sessions_;
};

/// While it lives, a request to stop reaches the session at once. Tokens that are not known here are only polled.
template <class Token> class StopLink {
public:
    StopLink(const Token &, const BespokeSession *) {}
};

} // namespace detail

/// Whether a stop was requested. Comes from a StopSource, and copies are cheap; for one that was made without a source
/// it never is. Threads: any, at any time.
class StopToken {
public:
    /// Of no source.
    StopToken() = default;

    /// Whether a stop was requested.
    bool stop_requested() const noexcept { return state_ && state_->is_requested(); }

private:
    friend class StopSource;
    friend class detail::StopLink<StopToken>;
    explicit StopToken(std::shared_ptr<detail::StopState> state) noexcept : state_(std::move(state)) {}

    std::shared_ptr<detail::StopState> state_;
};

/// Cancels the sessions that run with its tokens: session.run(source.get_token()). Copies share the request, which
/// cannot be withdrawn. Threads: any, at any time; not from a signal handler, which a Control is for.
class StopSource {
public:
    /// A source without a request yet.
    StopSource() : state_(std::make_shared<detail::StopState>()) {}

    /// A token of this source.
    StopToken get_token() const noexcept { return StopToken(state_); }

    /// Whether a stop was requested.
    bool stop_requested() const noexcept { return state_ && state_->is_requested(); }

    /// Requests a stop: the sessions that run with a token of this source return CANCELLED within 100 ms, whatever they
    /// are doing. Returns whether it was the first request.
    bool request_stop() const { return state_ && state_->request(); }

private:
    std::shared_ptr<detail::StopState> state_;
};

namespace detail {

template <> class StopLink<StopToken> {
public:
    StopLink(const StopToken &token, const BespokeSession *session) : state_(token.state_), session_(session) {
        if (state_) state_->enter(session_);
    }
    ~StopLink() {
        if (state_) state_->leave(session_);
    }
    StopLink(const StopLink &) = delete;
    StopLink &operator=(const StopLink &) = delete;

private:
    std::shared_ptr<StopState> state_;
    const BespokeSession *session_;
};

#ifdef __cpp_lib_jthread
template <> class StopLink<std::stop_token> {
public:
    StopLink(const std::stop_token &token, const BespokeSession *session) : callback_(token, Cancel{session}) {}

private:
    struct Cancel {
        const BespokeSession *session;
        void operator()() const noexcept { bespoke_session_cancel(session); }
    };

    std::stop_callback<Cancel> callback_;
};
#endif

template <class T, class = void> inline constexpr bool is_stop_token = false;
template <class T>
inline constexpr bool
    is_stop_token<T, std::void_t<decltype(static_cast<bool>(std::declval<const T &>().stop_requested()))>> = true;

template <class T> inline constexpr bool is_progress_callable = std::is_invocable_v<T &, const Progress &>;

/// Calls `on_progress`. Returns whether to go on: what the callable returns, or true where it returns nothing.
template <class OnProgress> bool report_progress(OnProgress &on_progress, const Progress &progress) {
    if constexpr (std::is_void_v<std::invoke_result_t<OnProgress &, const Progress &>>) {
        on_progress(progress);
        return true;
    } else {
        return static_cast<bool>(on_progress(progress));
    }
}

/// Milliseconds of a step between two checks of token and progress.
inline constexpr std::uint32_t check_interval = 20;

} // namespace detail

// ---- Session --------------------------------------------------------------------------------------------------------

/// The fitting of one garment to one avatar. Move-only; the destructor frees all it holds.
///
/// What a method does, which state it needs, its errors and threads are those of the function of its name in bespoke.h,
/// with bespoke_session_ before it. In addition, each of them fails with INVALID_ARGUMENT where the session is empty,
/// or where an array of numbers does not divide into whole elements.
class Session {
public:
    /// Empty: a place to move a session to.
    Session() = default;

    /// Takes over a handle from bespoke_session_create; null is empty.
    explicit Session(BespokeSession *handle) noexcept : handle_(handle) {}

    /// A new session: bespoke_session_create. Errors: INVALID_STATE where the library that is loaded has another binary
    /// interface than this header; INTERNAL. Threads: any, at any time.
    static Result<Session> create() {
        if (bespoke_abi_version() != BESPOKE_ABI_VERSION) {
            return Error(Status::invalid_state, "the bespoke library that is loaded, version " +
                                                    std::string(bespoke_version_text()) + ", has binary interface " +
                                                    std::to_string(bespoke_abi_version()) +
                                                    ", but this program was compiled for " +
                                                    std::to_string(BESPOKE_ABI_VERSION) +
                                                    "; load the library that belongs to the header, or compile anew");
        }
        BespokeSession *handle = nullptr;
        const auto made = detail::outcome(bespoke_session_create(&handle), "no session could be made");
        if (!made) return made.error();
        return Session(handle);
    }

    /// Whether there is a session in it.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The handle for the C API, which stays this object's; null where it is empty.
    BespokeSession *get() const noexcept { return handle_.get(); }

    /// Hands the handle over to the caller, to be given to bespoke_session_destroy, and is empty.
    [[nodiscard]] BespokeSession *release() noexcept { return handle_.release(); }

    /// Frees the session now; then it is empty. With BUSY another thread is inside a call with it, and it stays as it
    /// is. The destructor cannot report that: it cancels the other call and gives the handle up, so that the memory is
    /// leaked, but stays valid for that call. Threads: any, and no other call with this session may begin from here on.
    Result<void> destroy() {
        if (!handle_) return detail::empty_handle("session");
        const BespokeStatus status = bespoke_session_destroy(handle_.get());
        if (status == BESPOKE_STATUS_BUSY) return failure(handle_.get(), status);
        static_cast<void>(handle_.release());
        return detail::outcome(status, "the session was not freed as a whole");
    }

    /// Back to SETUP: inputs, coordinate systems and options stay, results and a request to cancel are dropped.
    Result<void> reset() { return call(bespoke_session_reset); }

    // ---- Inputs

    /// The garment as it was modelled, enclosing the source skeleton.
    Result<void> set_garment(Points positions, Triangles triangles) {
        return set(bespoke_session_set_garment, "garment positions", positions, "garment triangles", triangles);
    }

    /// The skeleton that the garment was modelled around, in the coordinate system of the garment.
    Result<void> set_source_skeleton(Points joints, Bones bones) {
        return set(bespoke_session_set_source_skeleton, "source skeleton joints", joints, "source skeleton bones",
                   bones);
    }

    /// The body to dress.
    Result<void> set_target_avatar(Points positions, Triangles triangles) {
        return set(bespoke_session_set_target_avatar, "target avatar positions", positions, "target avatar triangles",
                   triangles);
    }

    /// The skeleton of the body to dress, in the pose of the source skeleton and with its joints and bones.
    Result<void> set_target_skeleton(Points joints, Bones bones) {
        return set(bespoke_session_set_target_skeleton, "target skeleton joints", joints, "target skeleton bones",
                   bones);
    }

    /// Optional: the body on which the garment was designed, in the coordinate system of the garment.
    Result<void> set_source_avatar(Points positions, Triangles triangles) {
        return set(bespoke_session_set_source_avatar, "source avatar positions", positions, "source avatar triangles",
                   triangles);
    }

    /// Optional: skin weights of the target avatar as a full matrix: a row for each joint, in it a number for each
    /// vertex. Only the joint with the largest weight of a vertex is used.
    Result<void> set_target_skin_weights(NumberRows rows) {
        return set(bespoke_session_set_target_skin_weights, "target skin weights", rows, rows.columns());
    }

    /// Optional: skin weights of the target avatar as engines keep them: a row for each vertex, in it a few joints, and
    /// in `weights` the weights of these. Only the joint with the largest weight of a vertex is used.
    Result<void> set_target_skin_influences(IndexRows joints, NumberRows weights, std::size_t joint_count) {
        return set_influences(bespoke_session_set_target_skin_influences, "target skin", joints, weights, joint_count);
    }

    /// In place of a source skeleton: the rig of the body on which the garment was designed.
    Result<void> set_source_rig(const std::vector<Joint> &joints) {
        return set_rig(bespoke_session_set_source_rig, joints);
    }

    /// In place of a target skeleton: the rig of the body to dress, in the pose in which it is given.
    Result<void> set_target_rig(const std::vector<Joint> &joints) {
        return set_rig(bespoke_session_set_target_rig, joints);
    }

    /// Optional: skin weights of the source avatar on the source rig, as in set_target_skin_influences.
    Result<void> set_source_skin_influences(IndexRows joints, NumberRows weights, std::size_t joint_count) {
        return set_influences(bespoke_session_set_source_skin_influences, "source skin", joints, weights, joint_count);
    }

    /// Optional: skin weights of the garment as it was modelled, on the source rig, as in set_target_skin_influences.
    Result<void> set_garment_skin_influences(IndexRows joints, NumberRows weights, std::size_t joint_count) {
        return set_influences(bespoke_session_set_garment_skin_influences, "garment skin", joints, weights,
                              joint_count);
    }

    /// Optional: joints of the two rigs that correspond. They win over names and places. Replaces earlier pairs.
    Result<void> set_joint_pairs(JointPairs pairs) {
        return set(bespoke_session_set_joint_pairs, "joint pairs", pairs);
    }

    /// Optional: the coordinate system of garment, source skeleton and source avatar.
    Result<void> set_source_coordinate_system(const CoordinateSystem &coordinate_system) {
        const BespokeCoordinateSystem given = coordinate_system.get();
        return call(bespoke_session_set_source_coordinate_system, &given);
    }

    /// Optional: the coordinate system of target avatar and target skeleton, and so of the vertices that are read.
    Result<void> set_target_coordinate_system(const CoordinateSystem &coordinate_system) {
        const BespokeCoordinateSystem given = coordinate_system.get();
        return call(bespoke_session_set_target_coordinate_system, &given);
    }

    /// Optional: how strongly each garment vertex is drawn to the body.
    Result<void> set_vertex_fit_weights(Numbers weights) {
        return set(bespoke_session_set_vertex_fit_weights, "fit weights", weights);
    }

    /// Optional: the garment vertices that are not drawn to the body.
    Result<void> set_no_fit_vertices(Indices vertices) {
        return set(bespoke_session_set_no_fit_vertices, "vertices that do not fit", vertices);
    }

    /// Optional: garment vertices that keep their designed positions relative to the nearest bone.
    Result<void> set_pinned_vertices(Indices vertices) {
        return set(bespoke_session_set_pinned_vertices, "pinned vertices", vertices, nullptr);
    }

    /// Optional: garment vertices that are held at these targets, one for each.
    Result<void> set_pinned_vertices(Indices vertices, Points targets) {
        return set(bespoke_session_set_pinned_vertices, "pinned vertices", vertices, "targets of pins", targets);
    }

    /// Optional: garment vertices that stay one rigid body. Each call adds a group.
    Result<void> add_rigid_group(Indices vertices) {
        return set(bespoke_session_add_rigid_group, "rigid group", vertices);
    }

    /// Removes all rigid groups.
    Result<void> clear_rigid_groups() { return call(bespoke_session_clear_rigid_groups); }

    /// Optional: a curve along edges of the garment, its vertices in order, that keeps its shape and its place along the
    /// bones; the weights are factors, 1 as for a boundary curve. Each call adds a curve.
    Result<void> add_curve(Indices vertices, bool closed, double curve_weight = 1.0, double position_weight = 1.0) {
        return set(bespoke_session_add_curve, "curve", vertices, closed ? 1u : 0u, curve_weight, position_weight);
    }

    /// Removes all curves that were added.
    Result<void> clear_curves() { return call(bespoke_session_clear_curves); }

    /// Optional: what each triangle of the avatar is to the garment, a number of PartRole for each.
    Result<void> set_avatar_parts(Indices roles) {
        return set(bespoke_session_set_avatar_parts, "avatar parts", roles);
    }

    /// Optional: a morph of the garment, which goes over to the result. Each call adds one, counted from 0.
    Result<void> add_garment_morph(const std::string &name, Points offsets) {
        return add_morph(bespoke_session_add_garment_morph, name, "garment morph", offsets);
    }

    /// Removes all morphs of the garment.
    Result<void> clear_garment_morphs() { return call(bespoke_session_clear_garment_morphs); }

    /// Optional: a morph of the target avatar, to which the garment is to have an answer. Each call adds one, counted from 0.
    Result<void> add_target_morph(const std::string &name, Points offsets) {
        return add_morph(bespoke_session_add_target_morph, name, "target morph", offsets);
    }

    /// Removes all morphs of the target avatar.
    Result<void> clear_target_morphs() { return call(bespoke_session_clear_target_morphs); }

    /// Optional: a pose of the target rig in which the garment is to keep out of the body: for each joint how it moves what it moves
    /// from the bind pose, column after column. Each call adds one, counted from 0; before prepare, or after the end.
    Result<void> add_key_pose(const std::string &name,
                              const std::vector<std::array<double, BESPOKE_TRANSFORM_SIZE>> &transforms) {
        if (!handle_) return detail::empty_handle("session");
        std::vector<double> numbers(1);
        numbers.reserve(transforms.size() * BESPOKE_TRANSFORM_SIZE + 1);
        numbers.clear();
        for (const auto &transform : transforms) numbers.insert(numbers.end(), transform.begin(), transform.end());
        return call(bespoke_session_add_key_pose, name.c_str(), static_cast<const double *>(numbers.data()),
                    transforms.size());
    }

    /// Removes all key poses.
    Result<void> clear_key_poses() { return call(bespoke_session_clear_key_poses); }

    /// Finds the correction of each key pose, for so many joints a vertex; after the end. The result stays as it is.
    Result<void> solve_pose_corrections(std::size_t influences) {
        return call(bespoke_session_solve_pose_corrections, influences);
    }

    /// The correction of a key pose, after solve_pose_corrections.
    template <class Point = std::array<float, 3>>
    Result<PoseCorrection<Point>> read_pose_correction(std::uint32_t pose) const {
        std::size_t count = 0;
        PoseCorrection<Point> correction{};
        const BespokeBuffer nowhere{nullptr, 0, 0, BESPOKE_COMPONENT_F64};
        const auto counted = call(bespoke_session_read_pose_correction, pose, &nowhere, &count, &correction.before,
                                  &correction.after);
        if (!counted) return counted.error();
        correction.offsets.resize(count);
        const BespokeBuffer buffer = PointBuffer(correction.offsets).get();
        BespokePoseIntersections *const none = nullptr;
        const auto done = call(bespoke_session_read_pose_correction, pose, &buffer, &count, none, none);
        if (!done) return done.error();
        return correction;
    }

    /// Optional: a mesh that follows the garment without being solved. Each call adds one, counted from 0.
    Result<void> add_follower(Points positions, Triangles triangles) {
        return set(bespoke_session_add_follower, "follower positions", positions, "follower triangles", triangles);
    }

    /// Removes all followers.
    Result<void> clear_followers() { return call(bespoke_session_clear_followers); }

    /// Optional: a garment that the avatar wears already. Each call adds a layer.
    Result<void> add_layer(Points positions, Triangles triangles) {
        return set(bespoke_session_add_layer, "layer positions", positions, "layer triangles", triangles);
    }

    /// Takes all layers off the avatar.
    Result<void> clear_layers() { return call(bespoke_session_clear_layers); }

    /// Optional: a garment of an outfit as it was modelled, for read_outfit_order. Each call adds one, counted from 0.
    Result<void> add_outfit_garment(Points positions, Triangles triangles) {
        return set(bespoke_session_add_outfit_garment, "outfit garment positions", positions,
                   "outfit garment triangles", triangles);
    }

    /// Removes all garments of the outfit.
    Result<void> clear_outfit() { return call(bespoke_session_clear_outfit); }

    /// The garments of the outfit from the innermost outwards, by their numbers; in any state.
    Result<std::vector<std::uint32_t>> read_outfit_order() {
        std::uint32_t *const nowhere = nullptr;
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_outfit_order, nowhere, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<std::uint32_t> order(count);
        if (const auto done = call(bespoke_session_read_outfit_order, order.data(), order.size(), &count); !done) {
            return done.error();
        }
        if (count < order.size()) order.resize(count);
        return order;
    }

    /// The pairs of garments of the outfit that meet, the surest first; in any state.
    Result<std::vector<WornPair>> read_worn_pairs() {
        BespokeWornPair *const nowhere = nullptr;
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_worn_pairs, nowhere, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<BespokeWornPair> read(count);
        if (const auto done = call(bespoke_session_read_worn_pairs, read.data(), read.size(), &count); !done) {
            return done.error();
        }
        if (count < read.size()) read.resize(count);
        std::vector<WornPair> pairs;
        pairs.reserve(read.size());
        for (const BespokeWornPair &from : read) {
            pairs.push_back(WornPair{from.inner, from.outer, from.confidence, from.is_overruled != 0});
        }
        return pairs;
    }

    /// The pairs of triangles of two meshes that touch or cross: that of the first and that of the other; in any state. The inputs
    /// of the session have no part in it.
    Result<std::vector<std::array<std::uint32_t, 2>>> find_intersections(Points positions, Triangles triangles,
                                                                         Points other_positions,
                                                                         Triangles other_triangles) const {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides("first mesh positions", positions); !whole) return whole.error();
        if (auto whole = divides("first mesh triangles", triangles); !whole) return whole.error();
        if (auto whole = divides("second mesh positions", other_positions); !whole) return whole.error();
        if (auto whole = divides("second mesh triangles", other_triangles); !whole) return whole.error();
        const BespokeView views[] = {positions.get(), triangles.get(), other_positions.get(), other_triangles.get()};
        return pairs_of(views, views + 2);
    }

    /// The same within one mesh, the lower triangle first.
    Result<std::vector<std::array<std::uint32_t, 2>>> find_intersections(Points positions, Triangles triangles) const {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides("first mesh positions", positions); !whole) return whole.error();
        if (auto whole = divides("first mesh triangles", triangles); !whole) return whole.error();
        const BespokeView views[] = {positions.get(), triangles.get()};
        return pairs_of(views, nullptr);
    }

    /// Replaces all options by these.
    Result<void> set_options(const Options &options) {
        const BespokeOptions given = options.get();
        return call(bespoke_session_set_options, &given);
    }

    // ---- Running

    /// Checks the inputs against each other and shrinks the avatar onto the source skeleton.
    Result<void> prepare() { return call(bespoke_session_prepare); }

    /// Continues the run until it ends or the budget is spent. Returns the stage afterwards; where it failed,
    /// read_progress() has it.
    Result<Stage> step(Budget budget = {}) {
        std::uint32_t stage = BESPOKE_STAGE_SETUP;
        const auto done = call(bespoke_session_step, budget.iterations, budget.milliseconds, &stage);
        if (!done) return done.error();
        return static_cast<Stage>(stage);
    }

    /// Fits a result again, with other options and the fit weights and pins that were set since; step() or run() then go on from
    /// it. Options that are used before the fit have to stay as they were.
    Result<void> refit(const Options &options) {
        const BespokeOptions given = options.get();
        return call(bespoke_session_refit, &given);
    }

    /// Runs the session to its end. A success is DONE: the result is verified.
    Result<void> run() { return call(bespoke_session_run); }

    /// The same with a token or a callable; see below.
    template <class Watcher, class = std::enable_if_t<detail::is_stop_token<std::decay_t<Watcher>> ||
                                                      detail::is_progress_callable<Watcher>>>
    Result<void> run(Watcher &&watcher) {
        if constexpr (detail::is_stop_token<std::decay_t<Watcher>>) {
            return run(watcher, [](const Progress &) {});
        } else {
            return run(StopToken(), watcher);
        }
    }

    /// The same with a token that stops it and a callable that receives its progress.
    ///
    /// `token`: a StopToken or std::stop_token, which stop whatever the session is doing within 100 ms; or anything
    /// else with a `bool stop_requested() const`, which is checked before prepare and after every 20 ms or so from then
    /// on.
    /// `on_progress`: called with a `const Progress &` as often, on this thread, and once more with DONE. It may return
    /// nothing, or false to stop. It may throw, which leaves the session where it is; it must not destroy or move it.
    /// However it is stopped, the run fails with CANCELLED as after cancel(): the request stays until reset().
    template <class Token, class OnProgress, class = std::enable_if_t<detail::is_stop_token<Token>>,
              class = std::enable_if_t<detail::is_progress_callable<OnProgress>>>
    Result<void> run(const Token &token, OnProgress &&on_progress) {
        if (!handle_) return detail::empty_handle("session");
        const detail::StopLink<Token> link(token, handle_.get());
        auto now = read_progress();
        if (!now) return now.error();
        for (Stage stage = now->stage, begun = stage; stage != Stage::done || begun == Stage::done;) {
            const bool goes_on = detail::report_progress(on_progress, *now);
            if (!goes_on || token.stop_requested()) bespoke_session_cancel(handle_.get());
            if (stage == Stage::setup) {
                if (auto prepared = prepare(); !prepared) return prepared;
                stage = Stage::prepared;
            } else {
                const auto stepped = step({0, detail::check_interval});
                if (!stepped) return stepped.error();
                stage = *stepped;
            }
            now = read_progress();
            if (!now) return now.error();
        }
        detail::report_progress(on_progress, *now);
        return {};
    }

    /// Counts the intersections of the vertices as they would be read now, in this precision: f32 or f64.
    Result<Intersections> verify(Component precision = Component::f32) const {
        Intersections found{};
        const auto done = call(bespoke_session_verify, static_cast<std::uint32_t>(precision), &found);
        if (!done) return done.error();
        return found;
    }

    /// Cancels the session. Threads: any, at any time, also while another call runs.
    Result<void> cancel() const {
        if (!handle_) return detail::empty_handle("session");
        return detail::outcome(bespoke_session_cancel(handle_.get()), "the request to stop was refused");
    }

    /// The session's current progress. Threads: any, at any time, also while another call runs.
    Result<Progress> read_progress() const {
        if (!handle_) return detail::empty_handle("session");
        return detail::read_progress<BespokeSession>(bespoke_session_read_progress, handle_.get());
    }

    /// Cancellation and progress for another thread, outliving the session. Threads: any, at any time.
    Result<Control> create_control() const {
        if (!handle_) return detail::empty_handle("session");
        BespokeControl *control = nullptr;
        const auto made =
            detail::outcome(bespoke_session_create_control(handle_.get(), &control), "no control could be made");
        if (!made) return made.error();
        return Control(control);
    }

    // ---- What is shared

    /// The target as it was set so far, for other sessions: bespoke_avatar_create. Errors: INVALID_STATE without a target avatar.
    Result<Avatar> create_avatar() const {
        if (!handle_) return detail::empty_handle("session");
        BespokeAvatar *avatar = nullptr;
        const BespokeStatus status = bespoke_avatar_create(handle_.get(), &avatar);
        if (status != BESPOKE_STATUS_OK) return failure(handle_.get(), status);
        return Avatar(avatar);
    }

    /// The garment and all that was set of it so far, for other sessions: bespoke_garment_create. Errors: INVALID_STATE without a
    /// garment.
    Result<Garment> create_garment() const {
        if (!handle_) return detail::empty_handle("session");
        BespokeGarment *garment = nullptr;
        const BespokeStatus status = bespoke_garment_create(handle_.get(), &garment);
        if (status != BESPOKE_STATUS_OK) return failure(handle_.get(), status);
        return Garment(garment);
    }

    /// Dresses a shared avatar, in place of all that was set of a target. Errors: INVALID_ARGUMENT (empty).
    Result<void> use_avatar(const Avatar &avatar) { return call(bespoke_session_use_avatar, avatar.get()); }

    /// Fits a shared garment, in place of all that was set of a garment and its source. Errors: INVALID_ARGUMENT (empty).
    Result<void> use_garment(const Garment &garment) { return call(bespoke_session_use_garment, garment.get()); }

    // ---- Results

    /// The garment's current vertices, into the caller's memory; returns how many. The buffer may be larger.
    Result<std::size_t> read_garment_vertices(PointBuffer points) const {
        return read(bespoke_session_read_garment_vertices, "room for garment vertices", points);
    }

    /// The same in new memory, in a precision and shape: read_garment_vertices<std::array<double, 3>>().
    template <class Point = std::array<float, 3>> Result<std::vector<Point>> read_garment_vertices() const {
        return read_all<Point, PointBuffer>(bespoke_session_read_garment_vertices);
    }

    /// The target avatar's current vertices, into the caller's memory; returns how many. The buffer may be larger.
    Result<std::size_t> read_avatar_vertices(PointBuffer points) const {
        return read(bespoke_session_read_avatar_vertices, "room for avatar vertices", points);
    }

    /// The same in new memory.
    template <class Point = std::array<float, 3>> Result<std::vector<Point>> read_avatar_vertices() const {
        return read_all<Point, PointBuffer>(bespoke_session_read_avatar_vertices);
    }

    /// How much each garment triangle is distorted now, into the caller's memory; returns how many. The buffer may be
    /// larger.
    Result<std::size_t> read_distortion(NumberBuffer values) const {
        return read(bespoke_session_read_distortion, "room for distortion", values);
    }

    /// The same in new memory, as float or double.
    template <class Number = float> Result<std::vector<Number>> read_distortion() const {
        return read_all<Number, NumberBuffer>(bespoke_session_read_distortion);
    }

    /// How much of a target morph the avatar is to have from the next refit on; after the end.
    Result<void> set_target_morph_weight(std::uint32_t morph, double weight) {
        return call(bespoke_session_set_target_morph_weight, morph, weight);
    }

    /// Finds what the garment answers to each morph of the target avatar with; after the end. Takes about as long as a fit each.
    Result<void> solve_target_morphs() { return call(bespoke_session_solve_target_morphs); }

    /// The garment's answer to a morph of the target avatar: offsets from the result; after solve_target_morphs.
    template <class Point = std::array<float, 3>>
    Result<std::vector<Point>> read_target_morph(std::uint32_t morph) const {
        return read_all_of<Point>(bespoke_session_read_target_morph, morph);
    }

    /// A morph of the garment as it is now: offsets in the target's coordinate system.
    template <class Point = std::array<float, 3>>
    Result<std::vector<Point>> read_garment_morph(std::uint32_t morph) const {
        return read_all_of<Point>(bespoke_session_read_garment_morph, morph);
    }

    /// The vertices of a follower where the result takes them; after the end.
    template <class Point = std::array<float, 3>>
    Result<std::vector<Point>> read_follower_vertices(std::uint32_t follower) const {
        return read_all_of<Point>(bespoke_session_read_follower_vertices, follower);
    }

    /// Skin weights of a follower, with so many joints a vertex; after the end.
    Result<GarmentSkin> read_follower_skin_influences(std::uint32_t follower, std::size_t influences) const {
        const auto vertices = read_follower_vertices<std::array<double, 3>>(follower);
        if (!vertices) return vertices.error();
        GarmentSkin skin{influences, 0, {}, {}};
        // Never empty, so that no influences at all are refused by the library, with its own words.
        skin.joints.resize(vertices->size() * influences + 1);
        skin.weights.resize(vertices->size() * influences + 1);
        const auto done = call(bespoke_session_read_follower_skin_influences, follower, influences, skin.joints.data(),
                               skin.weights.data(), vertices->size(), &skin.joint_count);
        if (!done) return done.error();
        skin.joints.pop_back();
        skin.weights.pop_back();
        return skin;
    }

    /// Normals, and tangents where some are given, of the garment as it is now, for the vertices with which it is drawn.
    Result<GarmentNormals> read_garment_normals(const RenderMesh &mesh = {}) const {
        if (!handle_) return detail::empty_handle("session");
        BespokeView triangles{}, normals{}, tangents{};
        if (mesh.triangles) {
            if (auto whole = divides("triangles of the render vertices", *mesh.triangles); !whole) return whole.error();
            triangles = mesh.triangles->get();
        }
        if (mesh.normals) {
            if (auto whole = divides("garment normals", *mesh.normals); !whole) return whole.error();
            normals = mesh.normals->get();
        }
        if (mesh.tangents) {
            if (auto whole = divides("garment tangents", *mesh.tangents); !whole) return whole.error();
            tangents = mesh.tangents->get();
        }
        const auto read = [&](const BespokeBuffer &to_normals, const BespokeBuffer &to_tangents, std::size_t *count) {
            return call(bespoke_session_read_garment_normals, mesh.triangles ? &triangles : nullptr,
                        mesh.normals ? &normals : nullptr, mesh.tangents ? &tangents : nullptr, &to_normals,
                        mesh.tangents ? &to_tangents : nullptr, count);
        };
        const BespokeBuffer nowhere{nullptr, 0, 0, BESPOKE_COMPONENT_F32};
        std::size_t count = 0;
        if (const auto counted = read(nowhere, nowhere, &count); !counted) return counted.error();
        GarmentNormals found{std::vector<std::array<float, 3>>(count), {}};
        if (mesh.tangents) found.tangents.resize(count);
        const BespokeBuffer to_normals{found.normals.data(), count, 0, BESPOKE_COMPONENT_F32};
        const BespokeBuffer to_tangents{found.tangents.data(), found.tangents.size(), 0, BESPOKE_COMPONENT_F32};
        if (const auto done = read(to_normals, to_tangents, &count); !done) return done.error();
        return found;
    }

    /// Which joint of the target rig corresponds to each joint of the source rig, why, and how sure that is.
    Result<std::vector<MappedJoint>> read_joint_map() const {
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_joint_map, nullptr, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<BespokeMappedJoint> read(count);
        if (const auto done = call(bespoke_session_read_joint_map, read.data(), read.size(), &count); !done) {
            return done.error();
        }
        // Another call may have come in between the two.
        if (count < read.size()) read.resize(count);
        std::vector<MappedJoint> joints;
        joints.reserve(read.size());
        for (const BespokeMappedJoint &from : read) {
            MappedJoint to{{}, static_cast<JointReason>(from.reason), from.confidence, detail::text_of(from.part)};
            if (from.target != BESPOKE_NO_JOINT) to.target = from.target;
            joints.push_back(std::move(to));
        }
        return joints;
    }

    /// Skin weights of the result on the target rig, with so many joints a vertex; after the end.
    Result<GarmentSkin> read_garment_skin_influences(std::size_t influences) const {
        std::size_t vertices = 0;
        const BespokeBuffer nowhere{nullptr, 0, 0, BESPOKE_COMPONENT_F64};
        const auto counted = call(bespoke_session_read_garment_vertices, &nowhere, &vertices);
        // Of a result that is good in the other precision only, there are as many.
        if (!counted && counted.error().status() != Status::not_verified) return counted.error();
        GarmentSkin skin{influences, 0, {}, {}};
        // Never empty, so that no influences at all are refused by the library, with its own words.
        skin.joints.resize(vertices * influences + 1);
        skin.weights.resize(vertices * influences + 1);
        const auto done = call(bespoke_session_read_garment_skin_influences, influences, skin.joints.data(),
                               skin.weights.data(), vertices, &skin.joint_count);
        if (!done) return done.error();
        skin.joints.pop_back();
        skin.weights.pop_back();
        return skin;
    }

    /// The garment's own joints, in the order of their numbers, which follow on those of the target rig; after the end.
    Result<std::vector<AddedJoint>> read_added_joints() const {
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_added_joints, nullptr, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<BespokeAddedJoint> read(count);
        if (const auto done = call(bespoke_session_read_added_joints, read.data(), read.size(), &count); !done) {
            return done.error();
        }
        if (count < read.size()) read.resize(count);
        std::vector<AddedJoint> joints;
        joints.reserve(read.size());
        for (const BespokeAddedJoint &from : read) {
            AddedJoint to{from.source, {}, {}};
            if (from.parent != BESPOKE_NO_JOINT) to.parent = from.parent;
            for (std::size_t k = 0; k < to.bind.size(); k++) to.bind[k] = from.bind[k];
            joints.push_back(to);
        }
        return joints;
    }

    /// The triangles of the avatar, or of a layer, that the garment covers, ascending, so that they need not be drawn while it is
    /// worn; after the end.
    Result<std::vector<std::uint32_t>> read_covered_triangles(const Covering &what = {}) const {
        const std::uint32_t layer = what.layer ? *what.layer : BESPOKE_NO_LAYER;
        std::uint32_t *const nowhere = nullptr;
        std::size_t count = 0;
        const auto counted = call(bespoke_session_read_covered_triangles, layer, what.margin, what.openness, nowhere,
                                  std::size_t{0}, &count);
        if (!counted) return counted.error();
        std::vector<std::uint32_t> triangles(count);
        const auto done = call(bespoke_session_read_covered_triangles, layer, what.margin, what.openness,
                               triangles.data(), triangles.size(), &count);
        if (!done) return done.error();
        if (count < triangles.size()) triangles.resize(count);
        return triangles;
    }

    /// How each joint of the target rig moves from its bind pose to the pose that the result is in; after the end. All are the
    /// identity but where the diagnostic pose_blocked is.
    Result<std::vector<std::array<double, BESPOKE_TRANSFORM_SIZE>>> read_pose_transforms() const {
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_pose_transforms, nullptr, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<double> read(count * BESPOKE_TRANSFORM_SIZE);
        if (const auto done = call(bespoke_session_read_pose_transforms, read.data(), count, &count); !done) {
            return done.error();
        }
        std::vector<std::array<double, BESPOKE_TRANSFORM_SIZE>> transforms(read.size() / BESPOKE_TRANSFORM_SIZE);
        for (std::size_t k = 0; k < read.size(); k++) {
            transforms[k / BESPOKE_TRANSFORM_SIZE][k % BESPOKE_TRANSFORM_SIZE] = read[k];
        }
        return transforms;
    }

    /// The session's measurements so far.
    Result<Report> read_report() const {
        Report report{};
        report.struct_size = sizeof report;
        const auto done = call(bespoke_session_read_report, &report);
        if (!done) return done.error();
        return report;
    }

    /// Term `index` of the objective, from 0 up to the report's energy_count.
    Result<Energy> read_energy(std::uint32_t index) const {
        BespokeEnergy energy{};
        energy.struct_size = sizeof energy;
        const auto done = call(bespoke_session_read_energy, index, &energy);
        if (!done) return done.error();
        return Energy{detail::text_of(energy.name), energy.value, energy.weight};
    }

    /// All terms of the objective.
    Result<std::vector<Energy>> read_energies() const {
        const auto report = read_report();
        if (!report) return report.error();
        std::vector<Energy> energies;
        for (std::uint32_t index = 0; index < report->energy_count; index++) {
            auto energy = read_energy(index);
            if (!energy) return energy.error();
            energies.push_back(std::move(*energy));
        }
        return energies;
    }

    /// Diagnostics about the inputs and the result. None before prepare.
    Result<std::vector<Diagnostic>> read_diagnostics() const {
        std::size_t count = 0;
        if (const auto counted = call(bespoke_session_read_diagnostics, nullptr, std::size_t{0}, &count); !counted) {
            return counted.error();
        }
        std::vector<BespokeDiagnostic> read(count);
        if (count > 0) read.front().struct_size = sizeof(BespokeDiagnostic);
        if (const auto done = call(bespoke_session_read_diagnostics, read.data(), read.size(), &count); !done) {
            return done.error();
        }
        // Another call may have come in between the two.
        if (count < read.size()) read.resize(count);
        std::vector<Diagnostic> diagnostics;
        diagnostics.reserve(read.size());
        for (const BespokeDiagnostic &from : read) {
            Diagnostic to{static_cast<DiagnosticKind>(from.kind), static_cast<Severity>(from.severity), {},
                          from.distance, detail::text_of(from.message)};
            for (std::uint32_t k = 0; k < from.element_count && k < BESPOKE_MAX_ELEMENTS; k++) {
                const BespokeElement &element = from.elements[k];
                to.elements.push_back({static_cast<Subject>(element.subject), static_cast<ElementKind>(element.kind),
                                       element.index});
            }
            diagnostics.push_back(std::move(to));
        }
        return diagnostics;
    }

private:
    struct Destroy {
        void operator()(BespokeSession *handle) const noexcept {
            if (bespoke_session_destroy(handle) == BESPOKE_STATUS_BUSY) bespoke_session_cancel(handle);
        }
    };

    /// The error of a call with a session that has just failed.
    static Error failure(const BespokeSession *handle, BespokeStatus status) {
        const auto typed = static_cast<Status>(status);
        if (typed == Status::busy) {
            return Error(typed, "another thread is inside a call with this session; nothing was done");
        }
        std::size_t needed = 0;
        bespoke_session_last_message(handle, nullptr, 0, &needed);
        std::string message(needed, '\0');
        bespoke_session_last_message(handle, &message[0], message.size(), nullptr);
        // Its zero byte; and another failure may have put a shorter message there in between.
        message.resize(std::char_traits<char>::length(message.c_str()));
        if (message.empty()) message = status_name(typed);
        return Error(typed, std::move(message));
    }

    template <class Function, class... Arguments>
    Result<void> call(Function *function, const Arguments &...arguments) const {
        if (!handle_) return detail::empty_handle("session");
        BespokeSession *const handle = handle_.get();
        const BespokeStatus status = function(handle, arguments...);
        if (status != BESPOKE_STATUS_OK) return failure(handle, status);
        return {};
    }

    /// Success, or what is wrong with an array: it does not divide into elements of `width` numbers.
    template <class Family, class Void>
    static Result<void> divides(const char *what, const detail::Strided<Family, Void> &array, std::size_t width) {
        if (array.left_over() == 0) return {};
        return Error(Status::invalid_argument, std::string(what) + ": there are " + std::to_string(array.numbers()) +
                                                   " numbers, which cannot be divided into elements of " +
                                                   std::to_string(width) + " each: " +
                                                   std::to_string(array.left_over()) + " would be left over");
    }
    template <class Family, std::size_t Width, class Void>
    static Result<void> divides(const char *what, const detail::Elements<Family, Width, Void> &array) {
        return divides(what, array, Width);
    }
    template <class Family> static Result<void> divides(const char *what, const detail::Rows<Family> &rows) {
        return divides(what, rows, rows.columns());
    }

    template <class Function, class Array, class... Further>
    Result<void> set(Function *function, const char *what, const Array &array, const Further &...further) {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides(what, array); !whole) return whole;
        const BespokeView view = array.get();
        return call(function, &view, further...);
    }
    template <class Function, class First, class Second, class... Further>
    Result<void> set(Function *function, const char *first_what, const First &first, const char *second_what,
                     const Second &second, const Further &...further) {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides(first_what, first); !whole) return whole;
        return set_second(function, first.get(), second_what, second, further...);
    }
    template <class Function, class Second, class... Further>
    Result<void> set_second(Function *function, const BespokeView &first, const char *what, const Second &second,
                            const Further &...further) {
        if (auto whole = divides(what, second); !whole) return whole;
        const BespokeView view = second.get();
        return call(function, &first, &view, further...);
    }

    using SetInfluences = BespokeStatus(BespokeSession *, const BespokeView *, const BespokeView *, std::size_t,
                                        std::size_t);

    Result<void> set_influences(SetInfluences *function, const std::string &what, const IndexRows &joints,
                                const NumberRows &weights, std::size_t joint_count) {
        if (handle_ && joints.columns() != weights.columns()) {
            return Error(Status::invalid_argument, what + " influences: a vertex has " +
                                                       std::to_string(joints.columns()) + " joints, but " +
                                                       std::to_string(weights.columns()) + " weights");
        }
        return set(function, (what + " joints").c_str(), joints, (what + " weights").c_str(), weights,
                   joints.columns(), joint_count);
    }

    /// Positions and triangles of one mesh, and of another or null.
    Result<std::vector<std::array<std::uint32_t, 2>>> pairs_of(const BespokeView *first, const BespokeView *other) const {
        const BespokeView *const positions = other, *const triangles = other == nullptr ? nullptr : other + 1;
        std::uint32_t *const nowhere = nullptr;
        std::size_t count = 0;
        const auto counted = call(bespoke_session_find_intersections, first, first + 1, positions, triangles, nowhere,
                                  std::size_t{0}, &count);
        if (!counted) return counted.error();
        std::vector<std::array<std::uint32_t, 2>> pairs(count);
        if (count == 0) return pairs;
        const auto done = call(bespoke_session_find_intersections, first, first + 1, positions, triangles,
                               pairs.data()->data(), pairs.size(), &count);
        if (!done) return done.error();
        return pairs;
    }

    using AddMorph = BespokeStatus(BespokeSession *, const char *, const BespokeView *);

    Result<void> add_morph(AddMorph *function, const std::string &name, const char *what, const Points &offsets) {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides(what, offsets); !whole) return whole;
        const BespokeView view = offsets.get();
        return call(function, name.c_str(), &view);
    }

    using ReadOne = BespokeStatus(const BespokeSession *, std::uint32_t, const BespokeBuffer *, std::size_t *);

    /// All points of number `index` in new memory.
    template <class Point> Result<std::vector<Point>> read_all_of(ReadOne *function, std::uint32_t index) const {
        std::size_t count = 0;
        const BespokeBuffer nowhere{nullptr, 0, 0, BESPOKE_COMPONENT_F64};
        if (const auto counted = call(function, index, &nowhere, &count); !counted) return counted.error();
        std::vector<Point> points(count);
        const BespokeBuffer buffer = PointBuffer(points).get();
        if (const auto done = call(function, index, &buffer, &count); !done) return done.error();
        return points;
    }

    using SetRig = BespokeStatus(BespokeSession *, const BespokeJoint *, std::size_t);

    Result<void> set_rig(SetRig *function, const std::vector<Joint> &joints) {
        std::vector<BespokeJoint> given(joints.size());
        for (std::size_t k = 0; k < joints.size(); k++) {
            const Joint &joint = joints[k];
            BespokeJoint &to = given[k];
            to.name = joint.name.c_str();
            to.parent = joint.parent ? *joint.parent : BESPOKE_NO_JOINT;
            to.reserved = 0;
            for (std::size_t n = 0; n < joint.bind.size(); n++) to.bind[n] = joint.bind[n];
        }
        return call(function, given.data(), given.size());
    }

    using Read = BespokeStatus(const BespokeSession *, const BespokeBuffer *, std::size_t *);

    template <class Buffer> Result<std::size_t> read(Read *function, const char *what, const Buffer &room) const {
        if (!handle_) return detail::empty_handle("session");
        if (auto whole = divides(what, room); !whole) return whole.error();
        const BespokeBuffer buffer = room.get();
        std::size_t count = 0;
        const auto done = call(function, &buffer, &count);
        if (!done) return done.error();
        return count;
    }

    template <class Element, class Buffer> Result<std::vector<Element>> read_all(Read *function) const {
        static_assert(std::is_constructible_v<Buffer, std::vector<Element> &> &&
                          detail::LayoutFor<Element>::width == Buffer::width,
                      "the elements have to be made of as many floats or doubles as are read; see bespoke::Layout");
        std::vector<Element> elements;
        const auto count = read(function, "", Buffer(elements));
        if (!count) return count.error();
        elements.resize(*count);
        const auto done = read(function, "", Buffer(elements));
        if (!done) return done.error();
        // Another call may have come in between the two.
        elements.resize(*done);
        return elements;
    }

    std::unique_ptr<BespokeSession, Destroy> handle_;
};

} // namespace bespoke

#endif /* BESPOKE_HPP */
