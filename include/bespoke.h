// Bespoke: fits a garment that was modelled on one body to another body, with no triangle through another.
//
// This file is generated from the library's sources, and it is the manual of the C API. include/bespoke.hpp wraps it for
// C++, bindings/csharp for C#. A typical session:
//
//   BespokeSession *session = NULL;
//   bespoke_session_create(&session);
//   bespoke_session_set_garment(session, &positions, &triangles);          // as modelled
//   bespoke_session_set_source_skeleton(session, &joints, &bones);         // the one it encloses
//   bespoke_session_set_target_avatar(session, &positions, &triangles);    // the body to dress
//   bespoke_session_set_target_skeleton(session, &joints, &bones);         // and its skeleton
//   BespokeStatus status = bespoke_session_run(session);                   // or prepare, then step, step, step ...
//   if (status == BESPOKE_STATUS_OK) bespoke_session_read_garment_vertices(session, &result, NULL);
//   else bespoke_session_last_message(session, message, sizeof message, NULL);
//   bespoke_session_destroy(session);
//
// Sessions that have a body or a garment in common may share it: bespoke_avatar_create, bespoke_garment_create.
//
// Optional before it runs: the coordinate systems of both sides, the source avatar, skin weights, fit weights, pins,
// rigid groups, layers, options. The stages are prepare (the avatar is shrunk onto the source skeleton, inside the
// garment), inflate (it grows to its full size, and the garment gives way), fit (the garment is drawn to the avatar)
// and verify. "The paper" is Huang et al.: Intersection-Free Garment Retargeting, SIGGRAPH 2025; docs/glossary.md
// explains the terms.
//
// What holds for all functions:
//
// Status.  A call that can fail returns a status. Unless it is BESPOKE_STATUS_BUSY, a failed call with a session leaves
//   a message for bespoke_session_last_message that says what, where and which element. A call that failed because of
//   its arguments or of the state has changed nothing. Each function lists its errors without their prefix.
// State.  The stage of a session, one of BespokeStage. A function lists the states in which it may be called; in any
//   other it returns BESPOKE_STATUS_INVALID_STATE.
// Pointers.  Null is refused unless noted otherwise; any other pointer points to what is documented, structs with a
//   struct_size to that many bytes. Handles come from the library and are not destroyed yet.
// Ownership.  Apart from handles, which their destroy functions free, nothing of the library's is to be freed by the
//   caller, and no pointer of the caller's is kept after a call.
// Structs.  Those with a struct_size, which the caller sets, may grow at their end: programs and libraries of different
//   versions stay compatible. A struct that is all zeros, but for its struct_size, means the defaults. Fields called
//   reserved are 0.
// Enums.  They are passed as uint32_t and checked. A later library may return numbers that this header does not name.
// Lengths.  They are in the caller's unit, or, where noted, in the normalised space, in which the longest side of each
//   skeleton's bounding box is 2.
// Threads.  "any, one at a time": from any thread, but a second call with the same session while the first runs returns
//   BESPOKE_STATUS_BUSY at once. "any, at any time": no restriction. Different sessions are independent, and nothing is
//   bound to the thread that made it: a host's thread pool may step a session in another thread each time. A session
//   has threads of its own, as many as BespokeReport.threads says, from prepare until it is reset or destroyed. While the
//   avatar grows, one with several has up to as many again, for the distance field; one with one has no other. A host
//   that runs many sessions at once gives each of them one. Where the system starts fewer threads, a session works with
//   those, to the same bits; without any, prepare returns NO_THREAD, and may be called again. The calling thread waits
//   meanwhile, and needs 64 KiB of stack.
// Process.  Sessions share nothing but code, and what they are told to share: several plugins may use the library in one process, or bring a copy each.
//   Signals, locale, environment, standard streams and allocator of the host are not touched; the floating-point mode
//   of the calling thread (rounding, flushing of subnormal numbers, traps) is the default during a call and is restored
//   after it. Loading the library starts no thread, and none is left when all sessions are destroyed; but one that was
//   built over Debian's OpenVDB (build/libbespoke.so, or make install OPENVDB=system) loads log4cplus, which starts four
//   that stay, and ends the process where it cannot. Once loaded, the library stays until the process ends: dlclose is
//   safe after all sessions are destroyed, and the library can be opened again.
// Fork.  Not supported: a process that was forked cannot use the sessions of its parent (INVALID_STATE, and they stay
//   undestroyed) and must make none where the parent made some, unless it calls exec. Progress can be read, and
//   controls and the destroy functions of avatars and garments are harmless there.


#ifndef BESPOKE_H
#define BESPOKE_H

#include <stddef.h>
#include <stdint.h>

/// Number of the binary interface that this header describes. It changes when a program built with another header
/// would no longer work; additions at the end of a struct with a `struct_size` do not change it.
#define BESPOKE_ABI_VERSION 2

/// In place of a joint's number: no joint.
#define BESPOKE_NO_JOINT 4294967295

/// Numbers of a 4 x 4 transform.
#define BESPOKE_TRANSFORM_SIZE 16

/// Bytes of the part in BespokeMappedJoint, its zero byte included.
#define BESPOKE_PART_NAME_SIZE 32

/// The value of a weight in BespokeOptions that switches its term off; 0 means the default.
#define BESPOKE_WEIGHT_OFF -1.0

/// Length of the list of energy terms in BespokeProgress.
#define BESPOKE_MAX_TERMS 12

/// Bytes of the name in BespokeEnergy, its zero byte included.
#define BESPOKE_ENERGY_NAME_SIZE 32

/// What is asked about is no layer but the avatar itself.
#define BESPOKE_NO_LAYER 4294967295

/// Bytes of the message in BespokeDiagnostic, its zero byte included.
#define BESPOKE_MESSAGE_SIZE 512

/// Elements that a BespokeDiagnostic can name.
#define BESPOKE_MAX_ELEMENTS 4

/// The outcome of a call.
enum BespokeStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// The call succeeded.
  BESPOKE_STATUS_OK = 0,
  /// An argument is null, out of range or of the wrong size.
  BESPOKE_STATUS_INVALID_ARGUMENT = 1,
  /// The call does not fit the state of the session.
  BESPOKE_STATUS_INVALID_STATE = 2,
  /// A mesh cannot be used: no vertices, an index out of range, a coordinate that is not finite.
  BESPOKE_STATUS_INVALID_MESH = 3,
  /// A skeleton cannot be used, or the two skeletons do not share a topology.
  BESPOKE_STATUS_INVALID_SKELETON = 4,
  /// Skin or fit weights have the wrong shape or hold bad values.
  BESPOKE_STATUS_INVALID_WEIGHTS = 5,
  /// The garment intersects itself at the start, and the option `strict` is set.
  BESPOKE_STATUS_SELF_INTERSECTION = 6,
  /// The garment does not enclose its skeleton, and no path for it inside the garment was found.
  BESPOKE_STATUS_NOT_ENCLOSED = 7,
  /// The avatar could not be inflated to its full size without an intersection.
  BESPOKE_STATUS_INFLATION_STALLED = 8,
  /// The exact verifier found an intersection in the result.
  BESPOKE_STATUS_NOT_VERIFIED = 9,
  /// Cancelled by the caller.
  BESPOKE_STATUS_CANCELLED = 10,
  /// Another thread is inside a call with the same session. Nothing was done, and the message did not change.
  BESPOKE_STATUS_BUSY = 11,
  /// A defect of this library. The session refuses all further calls and can only be destroyed; other sessions are
  /// not affected.
  BESPOKE_STATUS_INTERNAL = 12,
  /// The session would take more memory than the option `memory_limit` allows.
  BESPOKE_STATUS_MEMORY_LIMIT = 13,
  /// The session could not start even one thread: the process, its user or the machine has as many as it may have. The
  /// call can be made again.
  BESPOKE_STATUS_NO_THREAD = 14,
  /// There is a result, DONE and verified, but it is not as designed: a limb is shut up in the garment or beside it,
  /// or a piece has lost its size. It can be read like any other; the diagnostics name limbs and pieces.
  BESPOKE_STATUS_IMPLAUSIBLE_RESULT = 15,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeStatus BespokeStatus;
#else
typedef uint32_t BespokeStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// How one number of an array is stored. 0 is none of them, so that a forgotten field is noticed.
enum BespokeComponent
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// float
  BESPOKE_COMPONENT_F32 = 1,
  /// double
  BESPOKE_COMPONENT_F64 = 2,
  /// uint16_t
  BESPOKE_COMPONENT_U16 = 3,
  /// uint32_t
  BESPOKE_COMPONENT_U32 = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeComponent BespokeComponent;
#else
typedef uint32_t BespokeComponent;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// The stage of a session.
enum BespokeStage
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Takes inputs; nothing is computed yet.
  BESPOKE_STAGE_SETUP = 0,
  /// Prepare is done: the inputs are checked, and the avatar is shrunk onto the source skeleton.
  BESPOKE_STAGE_PREPARED = 1,
  /// The avatar grows to its full size inside the garment, which gives way.
  BESPOKE_STAGE_INFLATE = 2,
  /// The garment is fitted to the avatar at its full size.
  BESPOKE_STAGE_FIT = 3,
  /// The exact verifier checks the result.
  BESPOKE_STAGE_VERIFY = 4,
  /// The result is final and verified.
  BESPOKE_STAGE_DONE = 5,
  /// A call failed for good. The last garment can be read.
  BESPOKE_STAGE_FAILED = 6,
  /// Cancelled by the caller. The last garment can be read.
  BESPOKE_STAGE_CANCELLED = 7,
  /// Between INFLATE and FIT, where a target rig stands in another pose than the source: the avatar goes from the source's
  /// pose to its own, and takes the garment along.
  BESPOKE_STAGE_REPOSE = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeStage BespokeStage;
#else
typedef uint32_t BespokeStage;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A direction along one axis of the caller's coordinates.
enum BespokeAxis
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// +x
  BESPOKE_AXIS_POSITIVE_X = 1,
  /// -x
  BESPOKE_AXIS_NEGATIVE_X = 2,
  /// +y
  BESPOKE_AXIS_POSITIVE_Y = 3,
  /// -y
  BESPOKE_AXIS_NEGATIVE_Y = 4,
  /// +z
  BESPOKE_AXIS_POSITIVE_Z = 5,
  /// -z
  BESPOKE_AXIS_NEGATIVE_Z = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeAxis BespokeAxis;
#else
typedef uint32_t BespokeAxis;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// The order of a front face's corners, seen from the front.
enum BespokeWinding
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Counter-clockwise.
  BESPOKE_WINDING_COUNTER_CLOCKWISE = 0,
  /// Clockwise.
  BESPOKE_WINDING_CLOCKWISE = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeWinding BespokeWinding;
#else
typedef uint32_t BespokeWinding;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Form of the surface term (Eq. 2 of the paper).
enum BespokeSurfaceForm
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Free for every similarity: scaling the garment as a whole costs nothing.
  BESPOKE_SURFACE_FORM_SIMILARITY = 0,
  /// As printed in the paper.
  BESPOKE_SURFACE_FORM_PRINTED = 1,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeSurfaceForm BespokeSurfaceForm;
#else
typedef uint32_t BespokeSurfaceForm;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What a diagnostic is about.
enum BespokeDiagnosticKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Garment vertices at equal positions, as along UV seams, that are welded. The first of them are named.
  BESPOKE_DIAGNOSTIC_KIND_SPLIT_VERTICES = 1,
  /// A garment triangle with the corners of another, which counts once. Both are named.
  BESPOKE_DIAGNOSTIC_KIND_DUPLICATE_TRIANGLE = 2,
  /// A garment triangle without area.
  BESPOKE_DIAGNOSTIC_KIND_DEGENERATE_TRIANGLE = 3,
  /// A garment edge with more than two triangles. Its vertices are named.
  BESPOKE_DIAGNOSTIC_KIND_NON_MANIFOLD_EDGE = 4,
  /// A garment vertex that no triangle uses.
  BESPOKE_DIAGNOSTIC_KIND_UNUSED_VERTEX = 5,
  /// A small piece of the garment, such as a button, that is attached to the nearest other piece.
  BESPOKE_DIAGNOSTIC_KIND_LOOSE_PIECE = 6,
  /// Two garment triangles that pass through each other, or touch, before anything has moved. They are exempted from
  /// contact until they separate. Also pairs beside each other that are left in the result of a crumpled design: from 15 % of the
  /// area on it is not as designed.
  BESPOKE_DIAGNOSTIC_KIND_SELF_INTERSECTION = 7,
  /// Parts of the garment, or garment and shrunk avatar, that are very near at the start. The garment's vertices are
  /// named.
  BESPOKE_DIAGNOSTIC_KIND_NEAR_CONTACT = 8,
  /// The avatar, shrunk onto the source skeleton, passes through the garment.
  BESPOKE_DIAGNOSTIC_KIND_AVATAR_PENETRATES = 9,
  /// The coordinates in which the result is read are coarse, so the minimum separation is larger than the option's.
  BESPOKE_DIAGNOSTIC_KIND_COARSE_COORDINATES = 10,
  /// Two triangles that intersect in the result and did not at the start.
  BESPOKE_DIAGNOSTIC_KIND_RESULT_INTERSECTION = 11,
  /// A pinned garment vertex ended away from its target.
  BESPOKE_DIAGNOSTIC_KIND_PIN_NOT_REACHED = 12,
  /// A rigid group of garment vertices ended bent, because something is in its way.
  BESPOKE_DIAGNOSTIC_KIND_RIGID_GROUP_BENT = 13,
  /// The inflation stalled, and this part of the avatar, or these two, push against the garment. A garment triangle
  /// is named and the avatar's triangles on its sides, and with one part its bone. The distance is that between the
  /// garment and one part now, or that between two parts at full size, which is 0 where they touch or overlap.
  BESPOKE_DIAGNOSTIC_KIND_INFLATION_BLOCKED = 14,
  /// An input is in another unit than the one that it belongs to: garment or source avatar and the source skeleton, or
  /// target avatar and target skeleton. The message has the factor.
  BESPOKE_DIAGNOSTIC_KIND_UNIT_MISMATCH = 15,
  /// An input is turned against the one that it belongs to, or the target faces another way than the garment, in which
  /// case it is turned while it is solved for. The message has the turn.
  BESPOKE_DIAGNOSTIC_KIND_FACING_MISMATCH = 16,
  /// Left and right of the target are exchanged, or it is mirrored.
  BESPOKE_DIAGNOSTIC_KIND_SIDES_SWAPPED = 17,
  /// A joint is missing or does not lie where the body wants it: the body goes on beyond the end of a bone where no bone
  /// does, such as a head above the joint from which the shoulders branch off, or the joint is outside of the body, as a
  /// root on the floor is. The bone is named; the distance is how far the body goes on, or how far the joint is off. It is
  /// taken to lie where the message says, unless the option strict is set.
  BESPOKE_DIAGNOSTIC_KIND_JOINT_MISPLACED = 18,
  /// The target stands in another pose than the garment was designed in, and the garment does not let it go from that pose
  /// to its own, because parts of it, which are named, meet: the result is in the pose of the design, whose transforms are
  /// read with bespoke_session_read_pose_transforms.
  BESPOKE_DIAGNOSTIC_KIND_POSE_BLOCKED = 30,
  /// With the target in its own pose, which is another one than the garment was designed in, the inflation stalled: it was
  /// posed as in the design, by its own skin weights, dressed there, and brought back. The share of its size at which it
  /// stalled is named, and the angle between the poses.
  BESPOKE_DIAGNOSTIC_KIND_SOLVED_POSED = 34,
  /// The garment was refused (NOT_ENCLOSED, INFLATION_STALLED), and the source avatar passes through it, as a head through its
  /// hat: it was dressed with that body and the garment together as the source avatar, close to the target. The first
  /// triangles that meet in the design are named. With the option strict it is refused.
  BESPOKE_DIAGNOSTIC_KIND_SOURCE_DRESSED = 40,
  /// A mesh that follows the garment (bespoke_session_add_follower) is in the avatar, a layer or the garment in the
  /// result, and was not in the design. Its first such triangle is named, and the one that it passes through.
  BESPOKE_DIAGNOSTIC_KIND_FOLLOWER_INTERSECTS = 35,
  /// A morph of the target avatar (bespoke_session_add_target_morph) to which the garment has no answer, because it gives way
  /// only up to the weight in the message.
  BESPOKE_DIAGNOSTIC_KIND_MORPH_NOT_SOLVED = 36,
  /// The garment's answer to a morph of the target avatar is good at weight 0 and 1, but intersects halfway. The first two
  /// triangles that meet there are named.
  BESPOKE_DIAGNOSTIC_KIND_MORPH_INTERSECTS = 37,
  /// Which joints of the rigs are places of the body, which are named, is a guess, because their names do not say it:
  /// bespoke_session_read_joint_map shows it and bespoke_session_set_joint_pairs mends it.
  BESPOKE_DIAGNOSTIC_KIND_JOINTS_UNSURE = 33,
  /// Skin weights bind vertices of the avatar to joints far away, while another bone is near; the nearest bone decides
  /// for them, unless the option strict is set. The first vertices are named.
  BESPOKE_DIAGNOSTIC_KIND_WEIGHTS_CONTRADICT = 19,
  /// The avatar has no skin weights, and vertices beside each other on its surface, which are named, belong to bones far from
  /// each other on the skeleton, as where a hand and a thigh are one mesh: the garment may be caught there.
  BESPOKE_DIAGNOSTIC_KIND_BONES_UNCLEAR = 38,
  /// A connected piece of the avatar's mesh, or of the source avatar's, seems to be no part of the body, such as a floor or a dome; it
  /// is left out, unless the option strict is set or bespoke_session_set_avatar_parts gives it a role. Its first and last triangles
  /// are named. The distance is the longest side of its bounding box.
  BESPOKE_DIAGNOSTIC_KIND_FOREIGN_PART = 20,
  /// A piece of the garment that is around no bone, such as a cape or a badge, or closed around one without any opening, as a
  /// hat with a filling is, and is carried along with the body beside it. A triangle of it is named and the bone nearest to
  /// it; the distance is that from the source avatar, or from the bone where there is none.
  BESPOKE_DIAGNOSTIC_KIND_CARRIED_PIECE = 22,
  /// The inflation stalled with the caller's settings of the contact, and was done with others, which are named.
  BESPOKE_DIAGNOSTIC_KIND_SETTINGS_ADJUSTED = 26,
  /// Borders of the garment that lie on or beside another part of it, such as the fronts of a placket or a shirt over
  /// trousers, and keep their place there. A vertex is named and the triangle beside it; the distance is the largest.
  BESPOKE_DIAGNOSTIC_KIND_KEPT_TOGETHER = 28,
  /// Open seams of the garment whose sides are within BespokeOptions.weld_distance, which are closed. The first
  /// vertices are named.
  BESPOKE_DIAGNOSTIC_KIND_WELDED_NEAR = 29,
  /// Vertices of the garment lie on the edge of a triangle that does not have them, as where an edge was split on one side
  /// alone: both sides keep together, but may part by a hair. The first vertices are named.
  BESPOKE_DIAGNOSTIC_KIND_T_JUNCTIONS = 39,
  /// A piece of the garment is a closed surface around a bone, as where both sides of the cloth are modelled, and no cuff,
  /// hem or collar of it was found: nothing keeps its openings in their places along the bones. A triangle of it is named,
  /// and a bone that it is around.
  BESPOKE_DIAGNOSTIC_KIND_RIMS_NOT_FOUND = 32,
  /// The garment passed through itself in the design, and begins pulled apart there, wholly or partly: the result has
  /// fewer such pairs of triangles than the design. The first pair is named.
  BESPOKE_DIAGNOSTIC_KIND_UNTANGLED = 27,
  /// Triangles that close an opening of the garment where a bone leaves it: left out while it is fitted, carried along
  /// with their rim, and not verified, for the body passes through them. The bone is named, and the first three of them.
  BESPOKE_DIAGNOSTIC_KIND_OPENING_CAP = 21,
  /// The result is not as designed: a limb that went through an opening of the garment and does not now, that was
  /// outside of the garment and is shut up in it, or that was inside and is beside it. Its bone is named, and a
  /// garment vertex of the opening or an avatar triangle of the limb. So are parts of the body without a bone of their own that are
  /// shut up, such as horns and strands of hair, most of them as a warning.
  BESPOKE_DIAGNOSTIC_KIND_LIMB_MISPLACED = 23,
  /// A piece of the result is far larger or smaller than what it hangs on. A triangle of it is named.
  BESPOKE_DIAGNOSTIC_KIND_PIECE_RESIZED = 24,
  /// The fit ended by the limit of iterations, or where no step made it better, and not by its tolerance.
  BESPOKE_DIAGNOSTIC_KIND_NOT_CONVERGED = 25,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeDiagnosticKind BespokeDiagnosticKind;
#else
typedef uint32_t BespokeDiagnosticKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// How much a diagnostic matters.
enum BespokeSeverity
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// For information.
  BESPOKE_SEVERITY_NOTE = 1,
  /// The result may be worse for it.
  BESPOKE_SEVERITY_WARNING = 2,
  /// There is no result because of it, or, with IMPLAUSIBLE_RESULT, none that should be used unseen.
  BESPOKE_SEVERITY_ERROR = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeSeverity BespokeSeverity;
#else
typedef uint32_t BespokeSeverity;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Which of the inputs an element belongs to. Any number from BESPOKE_SUBJECT_LAYER on is a layer, and from
/// BESPOKE_SUBJECT_FOLLOWER on a follower.
enum BespokeSubject
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// The garment.
  BESPOKE_SUBJECT_GARMENT = 1,
  /// The body to dress.
  BESPOKE_SUBJECT_TARGET_AVATAR = 2,
  /// The body that the garment was designed on.
  BESPOKE_SUBJECT_SOURCE_AVATAR = 3,
  /// The skeleton that the garment was designed on.
  BESPOKE_SUBJECT_SOURCE_SKELETON = 4,
  /// The skeleton of the body to dress.
  BESPOKE_SUBJECT_TARGET_SKELETON = 5,
  /// The first layer that was added with bespoke_session_add_layer; layer k, counted from 0, is this plus k.
  BESPOKE_SUBJECT_LAYER = 256,
  /// The first mesh that was added with bespoke_session_add_follower; follower k, counted from 0, is this plus k.
  BESPOKE_SUBJECT_FOLLOWER = 1073741824,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeSubject BespokeSubject;
#else
typedef uint32_t BespokeSubject;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What the index of an element counts.
enum BespokeElementKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Vertices of a mesh.
  BESPOKE_ELEMENT_KIND_VERTEX = 1,
  /// Triangles of a mesh.
  BESPOKE_ELEMENT_KIND_TRIANGLE = 2,
  /// Bones of a skeleton.
  BESPOKE_ELEMENT_KIND_BONE = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeElementKind BespokeElementKind;
#else
typedef uint32_t BespokeElementKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// What a triangle of the avatar is to the garment.
enum BespokePartRole
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Body, unless its connected piece is recognised as no part of the body, such as a floor or a dome: then it is
  /// ignored, and a diagnostic says so. The default.
  BESPOKE_PART_ROLE_AUTOMATIC = 0,
  /// Body: the garment is fitted to it and does not pass through it. It is left out in no case.
  BESPOKE_PART_ROLE_BODY = 1,
  /// The garment does not pass through it, but is not drawn to it, such as hair that hangs over a coat.
  BESPOKE_PART_ROLE_COLLISION = 2,
  /// It takes no part: the garment may pass through it, and it is not verified.
  BESPOKE_PART_ROLE_IGNORED = 3,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokePartRole BespokePartRole;
#else
typedef uint32_t BespokePartRole;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// Why a joint is mapped as it is.
enum BespokeJointReason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  /// Nothing corresponds to it: a control, a prop, or above all that was recognised.
  BESPOKE_JOINT_REASON_NOTHING = 0,
  /// The caller said so.
  BESPOKE_JOINT_REASON_CALLER = 1,
  /// The names of both say that they are the same part of the body.
  BESPOKE_JOINT_REASON_NAME = 2,
  /// At least for one of the two, its place among the others says so.
  BESPOKE_JOINT_REASON_STRUCTURE = 3,
  /// Of several joints in spine or neck, it has the same place in the order.
  BESPOKE_JOINT_REASON_ORDER = 4,
  /// Both have the same name, which stands for no part of the body.
  BESPOKE_JOINT_REASON_SAME_NAME = 5,
  /// It has no counterpart and goes with the joint above it.
  BESPOKE_JOINT_REASON_ANCESTOR = 6,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum BespokeJointReason BespokeJointReason;
#else
typedef uint32_t BespokeJointReason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/// A body to dress, for many sessions. Opaque.
typedef struct BespokeAvatar BespokeAvatar;

/// Cancellation and progress of one session; a handle of its own that may outlive the session. Opaque.
typedef struct BespokeControl BespokeControl;

/// A garment to fit, for many sessions. Opaque.
typedef struct BespokeGarment BespokeGarment;

/// The fitting of one garment to one avatar. Opaque.
typedef struct BespokeSession BespokeSession;

/// An array of the caller that is read during a call and never kept. Alignment does not matter.
///
/// An element is what the parameter is said to hold: a point (x, y, z), a triangle (three vertices, from 0), a bone
/// (two joints, from 0), a number.
typedef struct BespokeView {
  /// The first element. May be null where `count` is 0.
  const void *data;
  /// Elements.
  size_t count;
  /// Bytes from one element to the next; 0: they are packed.
  size_t stride;
  /// One of BespokeComponent.
  uint32_t component;
} BespokeView;

/// A coordinate system. Zero in a field means its default; handedness follows from the axes, which must be along three
/// different coordinates.
///
/// Right, up, forward and unit of some: Unreal +y, +z, +x, 0.01; Unity +x, +y, +z, 1; Godot and glTF as by default;
/// Maya as by default but 0.01; Blender +x, +z, +y, 1.
typedef struct BespokeCoordinateSystem {
  /// sizeof(BespokeCoordinateSystem).
  uint32_t struct_size;
  /// The axis that points to the right, one of BespokeAxis. Default: +x.
  uint32_t right;
  /// The axis that points up, one of BespokeAxis. Default: +y.
  uint32_t up;
  /// The axis that points forward, away from the viewer, one of BespokeAxis. Default: -z.
  uint32_t forward;
  /// Length of the unit in metres [1e-9, 1e9]. Default: 1.
  double metres_per_unit;
  /// Of front faces, one of BespokeWinding. Default: counter-clockwise.
  uint32_t winding;
  /// 1: it is right as it is. What is given in it is not compared with the rest for unit, axes, facing and sides, and
  /// neither turned nor refused for them. Default 0.
  uint32_t trusted;
} BespokeCoordinateSystem;

/// A joint of a rig.
typedef struct BespokeJoint {
  /// Its name, UTF-8, as the tool has it; ends with a zero byte. Null: it has none.
  const char *name;
  /// The joint that moves it, from 0, in any order; BESPOKE_NO_JOINT for a root.
  uint32_t parent;
  /// 0.
  uint32_t reserved;
  /// The bind transform: from the joint's own space to that in which the mesh is given, in the pose in which the mesh is
  /// given. 4 x 4 numbers, column after column, so that numbers 12 to 14 (from 0) are the joint's place: the memory of
  /// glTF, OpenGL, Unity and Unreal, and the inverse of an inverse bind matrix.
  double bind[BESPOKE_TRANSFORM_SIZE];
} BespokeJoint;

/// A joint of the source rig and what corresponds to it in the target rig.
typedef struct BespokeMappedJoint {
  /// The target rig's joint; BESPOKE_NO_JOINT where there is none.
  uint32_t target;
  /// One of BespokeJointReason.
  uint32_t reason;
  /// From 0, a guess, to 1, sure.
  double confidence;
  /// The part of the body, such as "left upper arm"; ends with a zero byte. Empty where it is none.
  char part[BESPOKE_PART_NAME_SIZE];
} BespokeMappedJoint;

/// Of two garments of an outfit that meet, which is worn beneath the other.
typedef struct BespokeWornPair {
  /// The garment beneath, by its number.
  uint32_t inner;
  /// The garment above it.
  uint32_t outer;
  /// From 0, as much speaks for the other order, to 1, nothing does; at most 0.5 where neither encloses the other and the
  /// distance from the source avatar decides.
  double confidence;
  /// 1 where the order does not follow this pair, for with surer pairs it would have gone around in a circle, else 0.
  uint32_t is_overruled;
  /// Always 0.
  uint32_t reserved;
} BespokeWornPair;

/// An array of the caller that points, or what else the parameter is said to hold, are written to. Bytes between them stay
/// as they are.
typedef struct BespokeBuffer {
  /// The first element. May be null where `capacity` is 0.
  void *data;
  /// Elements that fit.
  size_t capacity;
  /// Bytes from one element to the next; 0: they are packed.
  size_t stride;
  /// BESPOKE_COMPONENT_F32 or BESPOKE_COMPONENT_F64.
  uint32_t component;
} BespokeBuffer;

/// The options of a session. Zero in a field means its default. Unless noted otherwise, lengths are in the normalised
/// space, in which the longest side of the skeleton's bounding box is 2. Weights are finite and not negative, or
/// BESPOKE_WEIGHT_OFF where that is said; other ranges are in brackets. Artists' options come first; from
/// surface_weight on ("Expert."), the fields tune the solver.
typedef struct BespokeOptions {
  /// sizeof(BespokeOptions).
  uint32_t struct_size;
  /// Threads of this session [1, 1024], of which at most as many are started as the process may use cores (its affinity
  /// and its container decide). Default: all of these. BespokeReport.threads says how many work.
  uint32_t threads;
  /// Weight of the fit term, higher is tighter. Default 2. BESPOKE_WEIGHT_OFF: no fit.
  double fit_weight;
  /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point of
  /// the garment had on it, in proportion to the limb there [up to 2]. Default 1, as designed. BESPOKE_WEIGHT_OFF:
  /// tight, as without a source avatar.
  double designed_clearance;
  /// Clearance to aim at everywhere, in addition to the designed one, in the target's unit, from 0 to half the size
  /// of the target skeleton. What is nearer is pushed away, what is farther is drawn in. Default 0.
  double offset;
  /// Where a source avatar is given and no fit weights: what was designed farther away from it than this fits less, and not
  /// at all from twice this distance on. Default 0.1. BESPOKE_WEIGHT_OFF: the garment fits as a whole.
  double fit_distance;
  /// Weight of pins (bespoke_session_set_pinned_vertices), which are springs. Default 1000.
  double pin_weight;
  /// Weld distance: open seams of the garment whose sides are nearer than this share of its mean edge are closed [up to
  /// 0.25]. Default 0.01. BESPOKE_WEIGHT_OFF: only vertices at equal positions are welded.
  double weld_distance;
  /// Bytes that the session may take at most. Default: no limit. What a session needs is estimated from the sizes of
  /// its meshes before it begins, and checked again during the run.
  uint64_t memory_limit;
  /// 1: a garment that intersects itself at the start is refused. Default 0: the triangles that do so are exempted
  /// from contact until they separate and named by bespoke_session_read_diagnostics; none are added later. So is a target
  /// that faces another way than the source, which is turned by default.
  uint32_t strict;
  /// 1: triangles that close an opening where a bone leaves the garment, as at neck, waist, cuffs and hems, stay, and the
  /// garment is refused for them. Default 0: they are left out while it is fitted, go with their rim, and are named by
  /// bespoke_session_read_diagnostics. They are not verified: the body passes through them.
  uint32_t keep_caps;
  /// Expert. Weight of the surface term, which keeps the design's shape. Default 1.
  double surface_weight;
  /// Expert. Weight of the curvature of boundary curves. Default 2.5. BESPOKE_WEIGHT_OFF possible.
  double curvature_weight;
  /// Expert. Weight of the torsion of boundary curves. Default 2.5. BESPOKE_WEIGHT_OFF possible.
  double torsion_weight;
  /// Expert. Weight of the positions of cuffs, hems and collars along their bones. Default 10. BESPOKE_WEIGHT_OFF
  /// possible.
  double position_weight;
  /// Expert. Weight of the contact barrier, on squared distances [1, 1e14]. Default 1e8.
  double barrier_weight;
  /// Expert. Distance at which the barrier begins [1e-5, 0.1]. Default 0.002.
  double dhat;
  /// Expert. While the avatar grows: distance to it at which the barrier begins [1e-5, 0.1]. Default 0.01.
  double inflation_dhat;
  /// Expert. While the avatar grows: weight of the contact barrier [1, 1e14]. Default 1e4.
  double inflation_barrier_weight;
  /// Expert. Edge of a voxel of the distance field [1e-3, 0.2]. Default 0.01.
  double voxel_size;
  /// Expert. Minimum separation: distance that no contact pair ever falls below [1e-8, 0.01], less than half of
  /// `dhat` and of `inflation_dhat`. Default 1e-5.
  double min_separation;
  /// Expert. The fit ends where two Newton steps in turn have a squared Newton decrement, twice what the step promises to
  /// gain, below this share of the objective [1e-12, 1]. Default 1e-3.
  double tolerance;
  /// Expert. Largest number of Newton iterations of each stage. Default 500.
  uint32_t max_iterations;
  /// Expert. One of BespokeSurfaceForm. Default BESPOKE_SURFACE_FORM_SIMILARITY.
  uint32_t surface_form;
  /// Expert. Distance across two triangles at which they weigh their area in the surface term [up to 1]. Smaller ones weigh
  /// more, so that the fit is the same at every resolution of the garment. Default 0.048. BESPOKE_WEIGHT_OFF: all weigh
  /// their area, as printed in the paper.
  double surface_length;
  /// Expert. Distance along a boundary curve between the points from which the curvature and torsion terms read its bends
  /// [up to 1], a share of its length at most. So a V stays a V at every resolution of the garment. Default 0.08.
  /// BESPOKE_WEIGHT_OFF: from its vertices, as printed in the paper.
  double curve_chord;
} BespokeOptions;

/// Pairs of triangles that touch or cross each other.
typedef struct BespokeIntersections {
  /// Of the garment with itself.
  uint64_t garment_garment;
  /// Those of them that intersected or touched at the start, too: a garment with initial self-intersections may keep
  /// some of them.
  uint64_t initial;
  /// Of the garment with the avatar or its layers.
  uint64_t garment_avatar;
} BespokeIntersections;

/// Progress of a session, a snapshot. Lengths are in the normalised space, in which the longest side of the skeleton's
/// bounding box is 2.
typedef struct BespokeProgress {
  /// sizeof(BespokeProgress).
  uint32_t struct_size;
  /// One of BespokeStage.
  uint32_t stage;
  /// Iterations of this stage so far.
  uint32_t iteration;
  /// How many of `energies` are in use.
  uint32_t energy_count;
  /// Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
  double t;
  /// The objective: the sum of `energies`.
  double energy;
  /// Euclidean norm of the objective's gradient.
  double gradient_norm;
  /// Smallest distance of a contact pair; infinite where no pair is near.
  double min_distance;
  /// Contact pairs closer than dhat.
  uint64_t active_contacts;
  /// Seconds in prepare so far.
  double prepare_seconds;
  /// Seconds in inflate so far.
  double inflate_seconds;
  /// Seconds in fit so far.
  double fit_seconds;
  /// Seconds in the verifier so far.
  double verify_seconds;
  /// Each term with its weight, in the order of bespoke_session_read_energy.
  double energies[BESPOKE_MAX_TERMS];
} BespokeProgress;

/// The cost of one stage.
typedef struct BespokeStageReport {
  /// Wall-clock seconds.
  double seconds;
  /// Newton iterations.
  uint32_t iterations;
  /// Numeric factorisations.
  uint32_t factorisations;
  /// Symbolic factorisations.
  uint32_t symbolic_factorisations;
  /// 0.
  uint32_t reserved;
} BespokeStageReport;

/// Measurements of a session so far. Lengths are in the normalised space, in which the longest side of the skeleton's
/// bounding box is 2.
typedef struct BespokeReport {
  /// sizeof(BespokeReport).
  uint32_t struct_size;
  /// Threads that the session works with: as many as were asked for, but not more than there are cores for the process,
  /// nor than could be started.
  uint32_t threads;
  /// Cost of prepare.
  struct BespokeStageReport prepare;
  /// Cost of inflate.
  struct BespokeStageReport inflate;
  /// Cost of fit.
  struct BespokeStageReport fit;
  /// Wall-clock seconds of the exact verifier.
  double verify_seconds;
  /// Seconds until the distance field was built, in parallel with inflate.
  double field_seconds;
  /// Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
  double t;
  /// Euclidean norm of the objective's gradient.
  double gradient_norm;
  /// Smallest distance of the garment to itself; infinite where no pair is near.
  double garment_distance;
  /// Smallest distance of the garment to the avatar and its layers; infinite where no pair is near.
  double avatar_distance;
  /// Contact pairs closer than dhat.
  uint64_t active_contacts;
  /// Intersecting pairs within the garment that the verifier found.
  uint64_t garment_intersections;
  /// Intersecting pairs of garment and avatar, its layers included, that the verifier found.
  uint64_t avatar_intersections;
  /// Vertices of the garment.
  uint64_t garment_vertices;
  /// Triangles of the garment.
  uint64_t garment_triangles;
  /// Vertices of the target avatar, here and below without its layers.
  uint64_t avatar_vertices;
  /// Triangles of the target avatar.
  uint64_t avatar_triangles;
  /// Vertices of the target avatar once its triangles over several bones are split.
  uint64_t subdivided_avatar_vertices;
  /// Triangles of the target avatar once those over several bones are split.
  uint64_t subdivided_avatar_triangles;
  /// The minimum separation in force: the option's; less while something is nearer than that, more where the
  /// coordinates of the result are coarse.
  double min_separation;
  /// 1 where the verifier has checked the result, else 0.
  uint32_t is_verified;
  /// 1 where the fit ended by its tolerance, 0 where by the limit of iterations, where no step made it better, or not at all.
  uint32_t is_converged;
  /// Number of energy terms; see bespoke_session_read_energy.
  uint32_t energy_count;
  /// Always 0.
  uint32_t reserved;
  /// Bytes that the session's arrays take, without what the threads and the allocator add.
  uint64_t memory_bytes;
  /// Intersecting or touching pairs within the garment at the start, which are exempted from contact until they
  /// separate.
  uint64_t initial_self_intersections;
  /// Cost of repose, where the target is brought back from the pose of the design to its own; its seconds have those in which
  /// the body there was prepared.
  struct BespokeStageReport repose;
  /// Wall-clock seconds in which two rigs were read and matched, and the target was posed; they are part of prepare's.
  double rig_seconds;
} BespokeReport;

/// One term of the objective.
typedef struct BespokeEnergy {
  /// sizeof(BespokeEnergy).
  uint32_t struct_size;
  /// Always 0.
  uint32_t reserved;
  /// Name, such as "surface"; ends with a zero byte.
  char name[BESPOKE_ENERGY_NAME_SIZE];
  /// Value without its weight.
  double value;
  /// Weight; the term adds weight * value to the objective.
  double weight;
} BespokeEnergy;

/// A joint of the garment's own, which follows on those of the target rig.
typedef struct BespokeAddedJoint {
  /// The joint of the source rig that it is.
  uint32_t source;
  /// The joint that moves it: one of the target rig, or an added one, which are numbered on from there; BESPOKE_NO_JOINT
  /// for a root.
  uint32_t parent;
  /// Its bind transform in the coordinate system of the target, as in BespokeJoint.
  double bind[BESPOKE_TRANSFORM_SIZE];
} BespokeAddedJoint;

/// Pairs of triangles that pass through each other in a key pose and not in the result's own, counted by the exact verifier.
typedef struct BespokePoseIntersections {
  /// Of the garment with itself.
  uint64_t garment_garment;
  /// Of the garment with the avatar or its layers, where these do not pass through themselves.
  uint64_t garment_avatar;
  /// Of the garment with the avatar or its layers where these do, so that nothing can lie between.
  uint64_t in_folds;
} BespokePoseIntersections;

/// A vertex, triangle or bone of an input.
typedef struct BespokeElement {
  /// One of BespokeSubject, BESPOKE_SUBJECT_LAYER plus the number of a layer, BESPOKE_SUBJECT_FOLLOWER plus that of a follower;
  /// 0 where there is no element.
  uint32_t subject;
  /// One of BespokeElementKind.
  uint32_t kind;
  /// The caller's index, from 0.
  uint32_t index;
} BespokeElement;

/// A diagnostic about the inputs or the result.
typedef struct BespokeDiagnostic {
  /// sizeof(BespokeDiagnostic).
  uint32_t struct_size;
  /// One of BespokeDiagnosticKind.
  uint32_t kind;
  /// One of BespokeSeverity.
  uint32_t severity;
  /// Elements in use.
  uint32_t element_count;
  /// The elements that it is about, for a tool to select.
  struct BespokeElement elements[BESPOKE_MAX_ELEMENTS];
  /// A distance in the normalised space, in which the longest side of the skeleton's bounding box is 2; NaN where it
  /// has none.
  double distance;
  /// One sentence, UTF-8; ends with a zero byte.
  char message[BESPOKE_MESSAGE_SIZE];
} BespokeDiagnostic;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/// The name of a status, such as "BESPOKE_STATUS_BUSY"; "BESPOKE_STATUS_UNKNOWN" for any other number.
///
/// `status`: one of BespokeStatus. Ownership: the text is part of the library, never freed. Threads: any, at any time.
const char *bespoke_status_name(uint32_t status);

/// The binary interface of the library that is loaded. Compare with BESPOKE_ABI_VERSION before anything else.
///
/// Threads: any, at any time.
uint32_t bespoke_abi_version(void);

/// The version of the library that is loaded, such as "0.1.0".
///
/// Ownership: the text is part of the library, never freed. Threads: any, at any time.
const char *bespoke_version_text(void);

/// Makes an empty session and stores its handle in `*session`; stores null where it fails.
///
/// `*session`: where the handle goes. It has no threads and takes little memory before bespoke_session_prepare. Ownership: the
/// caller destroys it with bespoke_session_destroy. Errors: INVALID_ARGUMENT (null), INTERNAL. Threads: any, at any time.
BespokeStatus bespoke_session_create(struct BespokeSession **session);

/// Ends a session and frees all it holds. A null session is fine. Controls made from it stay usable. When it returns,
/// no thread of the session is left; after a call that was cancelled, that may take a moment.
///
/// State: any. Errors: BUSY where another thread is inside a call with it, INVALID_STATE in a forked process; it is not
/// destroyed then. INTERNAL where it ended by a panic. Threads: any, and no other call with this session may begin from here
/// on.
BespokeStatus bespoke_session_destroy(struct BespokeSession *session);

/// Takes a session back to SETUP: inputs, coordinate systems and options stay, results and a request to cancel are
/// dropped. Like bespoke_session_destroy, it waits for work that a cancelled call has left.
///
/// State: any. Errors: INVALID_ARGUMENT, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_reset(struct BespokeSession *session);

/// Copies the message of the last call with this session that failed (UTF-8, empty where none did).
///
/// `buffer`: room for `capacity` bytes. A longer message is cut at a character; a zero byte always ends it. May be null
/// where `capacity` is 0. `*needed`, unless null: the size of the whole message with its zero byte. State: any, a
/// failed session included. Errors: INVALID_ARGUMENT (null session, or a null buffer with a capacity). Threads: any, at
/// any time, also while another call runs.
BespokeStatus bespoke_session_last_message(const struct BespokeSession *session,
                                           char *buffer,
                                           size_t capacity,
                                           size_t *needed);

/// The garment as it was modelled, enclosing the source skeleton.
///
/// `positions`: points, F32 or F64; the result is verified in this precision. `triangles`: three vertices each, U16
/// or U32. It may be open and in pieces. Ownership: copied during the call. State: SETUP; a second call replaces the
/// first. Errors: INVALID_ARGUMENT, INVALID_MESH (no vertices, no triangles, an index out of range, a coordinate that
/// is not finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_garment(struct BespokeSession *session,
                                          const struct BespokeView *positions,
                                          const struct BespokeView *triangles);

/// The skeleton that the garment was modelled around, in the coordinate system of the garment.
///
/// `joints`: points, F32 or F64. `bones`: two joints each, U16 or U32; order and direction are free. Ownership: copied
/// during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_SKELETON, INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
BespokeStatus bespoke_session_set_source_skeleton(struct BespokeSession *session,
                                                  const struct BespokeView *joints,
                                                  const struct BespokeView *bones);

/// The body to dress. It may be open, non-manifold, in pieces, and may intersect itself.
///
/// `positions`: points, F32 or F64. `triangles`: three vertices each, U16 or U32. Ownership: copied during the call.
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_target_avatar(struct BespokeSession *session,
                                                const struct BespokeView *positions,
                                                const struct BespokeView *triangles);

/// The skeleton of the body to dress, in its coordinate system and in the pose of the source skeleton. Joint i
/// corresponds to joint i of the source skeleton, and the same pairs of joints are bones.
///
/// `joints`, `bones`: as for the source skeleton. Ownership: copied during the call. State: SETUP. Errors:
/// INVALID_ARGUMENT, INVALID_SKELETON (another topology may be found only by bespoke_session_prepare), INVALID_STATE,
/// BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_target_skeleton(struct BespokeSession *session,
                                                  const struct BespokeView *joints,
                                                  const struct BespokeView *bones);

/// Optional: the body on which the garment was designed, in the coordinate system of the garment. With it, the fit aims
/// at the clearance of the design. Where the garment is refused (NOT_ENCLOSED, INFLATION_STALLED) and this body passes through
/// it, as a head through its hat, it is tried once more with the garment as a part of this body, unless the option strict is
/// set: see BESPOKE_DIAGNOSTIC_KIND_SOURCE_DRESSED. A floor, a dome or another figure in its mesh is left out, with a diagnostic
/// (BESPOKE_DIAGNOSTIC_KIND_FOREIGN_PART), unless the option strict is set.
///
/// `positions`, `triangles`: as for the target avatar. Ownership: copied during the call. State: SETUP. Errors:
/// INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_source_avatar(struct BespokeSession *session,
                                                const struct BespokeView *positions,
                                                const struct BespokeView *triangles);

/// Optional: skin weights of the target avatar as a full matrix, one row a joint. They only assign each vertex to one
/// joint: the one with its largest weight, the lowest of several. Without them, and for a vertex whose weights are all
/// 0, the nearest bone decides.
///
/// `rows`: one element for each joint, F32 or F64, each of them `vertices` numbers; its stride leads from row to row.
/// Weights are finite and not negative; those of a vertex need not sum to 1. Ownership: copied during the call. State:
/// SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be found only by bespoke_session_prepare),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_target_skin_weights(struct BespokeSession *session,
                                                      const struct BespokeView *rows,
                                                      size_t vertices);

/// Optional: skin weights of the target avatar as engines keep them, a few joints with their weights for each vertex.
/// Only the joint with the largest weight of a vertex is used, so one influence with weight 1 for each vertex is
/// enough.
///
/// `joints`: one element for each vertex, U16 or U32, each of them `influences` joints (from 0). `weights`: the same
/// with F32 or F64. The weights of a joint that is listed twice are added; one with weight 0 is ignored. `joint_count`:
/// joints of the target skeleton. All else as for bespoke_session_set_target_skin_weights, which this replaces.
BespokeStatus bespoke_session_set_target_skin_influences(struct BespokeSession *session,
                                                         const struct BespokeView *joints,
                                                         const struct BespokeView *weights,
                                                         size_t influences,
                                                         size_t joint_count);

/// Optional: the coordinate system of garment, source skeleton and source avatar; by default right-handed, in metres, y
/// up.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null, struct_size, two axes along one coordinate, a unit outside [1e-9, 1e9]
/// metres), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_source_coordinate_system(struct BespokeSession *session,
                                                           const struct BespokeCoordinateSystem *coordinate_system);

/// Optional: the coordinate system of target avatar and target skeleton, and so of the vertices that are read.
///
/// State, errors, threads: as for bespoke_session_set_source_coordinate_system.
BespokeStatus bespoke_session_set_target_coordinate_system(struct BespokeSession *session,
                                                           const struct BespokeCoordinateSystem *coordinate_system);

/// In place of a source skeleton: the rig of the body on which the garment was designed, in the coordinate system of the
/// garment. With a rig on both sides no skeletons have to correspond: which joints do follows from their names, from their
/// places and from bespoke_session_set_joint_pairs, and can be read with bespoke_session_read_joint_map. A skeleton beside
/// a rig is read as a rig without names.
///
/// `joints`: `count` of them, at most 65535. Ownership: copied during the call. State: SETUP; the later one of skeleton and
/// rig counts. Errors: INVALID_ARGUMENT, INVALID_SKELETON (no joints, a parent that is no joint, parents in a circle, a
/// number that is not finite, a last row that is not 0, 0, 0, 1; that nothing corresponds is found by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_source_rig(struct BespokeSession *session,
                                             const struct BespokeJoint *joints,
                                             size_t count);

/// In place of a target skeleton: the rig of the body to dress, in its coordinate system and in the pose in which it is given.
/// The weights of bespoke_session_set_target_skin_weights and _influences are then on its joints. That source and target
/// stand in different poses, such as an A-pose and a T-pose, needs nothing.
///
/// `joints`: `count` of them, at most 65535. Ownership: copied during the call. State: SETUP; the later one of skeleton and
/// rig counts. Errors: as for bespoke_session_set_source_rig. Threads: any, one at a time.
BespokeStatus bespoke_session_set_target_rig(struct BespokeSession *session,
                                             const struct BespokeJoint *joints,
                                             size_t count);

/// Optional: skin weights of the source avatar on the source rig. They tell which of its joints move nothing, and where the
/// top of the head is in a rig that has no joint there.
///
/// `joints`, `weights`, `influences`, `joint_count`: as for bespoke_session_set_target_skin_influences. Ownership: copied
/// during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be found only by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_source_skin_influences(struct BespokeSession *session,
                                                         const struct BespokeView *joints,
                                                         const struct BespokeView *weights,
                                                         size_t influences,
                                                         size_t joint_count);

/// Optional: skin weights of the garment as it was modelled, on the source rig.
///
/// `joints`, `weights`, `influences`, `joint_count`: as for bespoke_session_set_target_skin_influences, one element for each
/// vertex of the garment. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a
/// wrong size may be found only by bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_garment_skin_influences(struct BespokeSession *session,
                                                          const struct BespokeView *joints,
                                                          const struct BespokeView *weights,
                                                          size_t influences,
                                                          size_t joint_count);

/// Optional: joints of the two rigs that correspond. They win over names and places. Replaces earlier pairs.
///
/// `pairs`: a joint of the source rig and one of the target rig each, U16 or U32; BESPOKE_NO_JOINT (65535 in U16) as the
/// second: nothing corresponds to it. Each joint is in one pair at most. Ownership: copied during the call. State: SETUP.
/// Errors: INVALID_ARGUMENT (a joint that a rig does not have, or one in two pairs, is found by bespoke_session_prepare and
/// bespoke_session_read_joint_map), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_joint_pairs(struct BespokeSession *session,
                                              const struct BespokeView *pairs);

/// Writes which joint of the target rig corresponds to each joint of the source rig, why, and how sure that is: for an editor
/// to show, and for a caller to mend with bespoke_session_set_joint_pairs.
///
/// `joints`: room for `capacity` of them, one for each joint of the source rig in its order; the first that fit are written.
/// May be null where `capacity` is 0. `*count`, unless null: how many there are. State: any, with rig or skeleton set on
/// both sides; the map is that of what is set. Errors: INVALID_ARGUMENT (null with a capacity, a pair that suits no
/// joints), INVALID_WEIGHTS (weights that do not suit their rig), INVALID_STATE (a rig is missing), BUSY, INTERNAL.
/// Threads: any, one at a time.
BespokeStatus bespoke_session_read_joint_map(const struct BespokeSession *session,
                                             struct BespokeMappedJoint *joints,
                                             size_t capacity,
                                             size_t *count);

/// Optional: how strongly each garment vertex is drawn to the body, relative to the others. 1 everywhere by default;
/// 0: not at all.
///
/// `weights`: one number for each garment vertex, F32 or F64, finite and not negative. Ownership: copied during the
/// call. State: SETUP, and for bespoke_session_refit DONE. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be
/// found only by bespoke_session_prepare or bespoke_session_refit), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_vertex_fit_weights(struct BespokeSession *session,
                                                     const struct BespokeView *weights);

/// Optional: the garment vertices that are not drawn to the body. The same as bespoke_session_set_vertex_fit_weights, which
/// this replaces, with 0 for these vertices and 1 for all others: triangles with all three corners listed do not fit.
///
/// `vertices`: garment vertices, from 0, in any order, U16 or U32. Ownership: copied during the call. State: SETUP, with
/// the garment set. Errors: INVALID_ARGUMENT (a vertex out of range as well), INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
BespokeStatus bespoke_session_set_no_fit_vertices(struct BespokeSession *session,
                                                  const struct BespokeView *vertices);

/// Optional: garment vertices that are held at targets. Replaces earlier pins.
///
/// `vertices`: garment vertices, from 0, each once, U16 or U32; none: no pins. `targets`: null, or one point for each
/// of them in the target's coordinate system, F32 or F64. Without targets, a vertex keeps its position relative to the
/// nearest bone: its coordinate along the bone and its distance from it, so with equal skeletons it stays where it is.
/// A pin is a stiff spring (see BespokeOptions.pin_weight): one that cannot reach its target, because the body is in
/// the way, is reported as a diagnostic. Ownership: copied during the call. State: SETUP, and for bespoke_session_refit DONE.
/// Errors: INVALID_ARGUMENT (a vertex that the garment does not have is found by bespoke_session_prepare or
/// bespoke_session_refit), INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
BespokeStatus bespoke_session_set_pinned_vertices(struct BespokeSession *session,
                                                  const struct BespokeView *vertices,
                                                  const struct BespokeView *targets);

/// Optional: garment vertices that stay one rigid body, such as a button, a buckle or an armour plate: it moves, turns
/// and keeps its shape. Its size scales with the skeletons. Each call adds a group; they are numbered from 0.
///
/// `vertices`: garment vertices, from 0, in any order, U16 or U32; at least one, none of another group. A group that
/// contact keeps from becoming rigid up to rounding is reported as a diagnostic. Ownership: copied during the call.
/// State: SETUP. Errors: INVALID_ARGUMENT (a vertex that the garment does not have is found by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_add_rigid_group(struct BespokeSession *session, const struct BespokeView *vertices);

/// Removes all rigid groups.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_rigid_groups(struct BespokeSession *session);

/// Optional: a curve along edges of the garment, such as a neckline, a seam line or the rim of a lined sleeve, that keeps
/// its shape and its place along the bones. Each call adds one; they are numbered from 0. One that runs through the
/// vertices of a boundary curve, in their order either way around, takes its place: so a neckline can be held more, and a
/// cuff less.
///
/// `vertices`: garment vertices, from 0, in the order of the curve, each once, U16 or U32; of vertices in one place any
/// will do. `closed`: 1 where the last is joined to the first, else 0. `curve_weight`: factor on
/// BespokeOptions.curvature_weight and torsion_weight, up to 1e6: 1 as for a boundary curve, 0 for none.
/// `position_weight`: the same for BespokeOptions.position_weight. A closed curve keeps its place along the bone that
/// goes through it, or the mean of several; each vertex of an open one, and of one that is too small and too far from
/// the bones to be an opening, keeps its place along the bone nearest to it. On a piece that is held to another one, or
/// carried, it has no place of its own. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT (fewer
/// than two vertices, or three where it is closed, one listed twice, a weight out of range; found by
/// bespoke_session_prepare: a vertex that the garment does not have, two in a row that no edge joins, a place passed
/// twice, an earlier curve once more), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_add_curve(struct BespokeSession *session,
                                        const struct BespokeView *vertices,
                                        uint32_t closed,
                                        double curve_weight,
                                        double position_weight);

/// Removes all curves that were added.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_curves(struct BespokeSession *session);

/// Optional: a garment that the avatar wears already, such as one that was read from another session. It joins the avatar as
/// an obstacle that keeps its shape: the garment of this session fits over avatar and layers, and is verified against both.
/// Each call adds one layer; they are numbered from 0, and stay until bespoke_session_clear_layers, also when another avatar
/// is set and after bespoke_session_reset.
///
/// `positions`: points, F32 or F64, in the coordinate system of the target avatar; used exactly as they are.
/// `triangles`: three vertices each, U16 or U32. Skin weights are those of the avatar beneath, where it has any. What
/// is read or counted as the avatar does not include its layers. Ownership: copied during the call. State: SETUP.
/// Errors: INVALID_ARGUMENT, INVALID_MESH (no vertices, no triangles, an index out of range, a coordinate that is not
/// finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_add_layer(struct BespokeSession *session,
                                        const struct BespokeView *positions,
                                        const struct BespokeView *triangles);

/// Takes all layers off the avatar.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_layers(struct BespokeSession *session);

/// Optional: a garment of an outfit as it was modelled, so that the order in which the outfit is worn can be read:
/// bespoke_session_read_outfit_order. Each call adds one; they are numbered from 0. All of the outfit is added, also what is
/// dressed in this session; none of it takes part in the run.
///
/// To dress an outfit: add its garments and read the order; then for each garment from the innermost outwards,
/// bespoke_session_reset, bespoke_session_set_garment, run, read the result, and add it as a layer with bespoke_session_add_layer.
///
/// `positions`: points in the coordinate system of the garment and the source avatar, F32 or F64. `triangles`: three vertices
/// each, U16 or U32. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE,
/// BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_add_outfit_garment(struct BespokeSession *session,
                                                 const struct BespokeView *positions,
                                                 const struct BespokeView *triangles);

/// Removes all garments of the outfit.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_outfit(struct BespokeSession *session);

/// Writes the order in which the garments of the outfit are worn, from the innermost outwards, as their geometry tells: of two
/// garments the inner one is that of which more lies in the other, and where neither does, that which is nearer to the source
/// avatar, if one is set. Of garments that do not meet, the one that was added first comes first.
///
/// `order`: room for `capacity` numbers of garments; the first that fit are written. May be null where `capacity` is 0.
/// `*count`, unless null: garments of the outfit. State: any. Errors: INVALID_ARGUMENT (null with a capacity), CANCELLED (the
/// state does not change), NO_THREAD, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_outfit_order(struct BespokeSession *session,
                                                uint32_t *order,
                                                size_t capacity,
                                                size_t *count);

/// Writes what the order of bespoke_session_read_outfit_order is made of: the pairs of garments that meet, the surest first, so
/// that an editor can show where it is a guess.
///
/// `pairs`: room for `capacity` of them; the first that fit are written. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. All else as for bespoke_session_read_outfit_order.
BespokeStatus bespoke_session_read_worn_pairs(struct BespokeSession *session,
                                              struct BespokeWornPair *pairs,
                                              size_t capacity,
                                              size_t *count);

/// Finds the pairs of triangles of two meshes that touch or cross each other, such as two garments that hang beside each other, or
/// those within one mesh; by the exact verifier. The inputs and the result of the session have no part in it.
///
/// `positions`, `triangles`: a mesh. `other_positions`, `other_triangles`: another one in the same coordinate system; both null:
/// pairs within the first. There, triangles that share a vertex count where they touch elsewhere too, and vertices in one place
/// with different indices are a contact. `pairs`: room for `capacity` pairs, two numbers each: the triangle of the first
/// mesh and that of the other, ascending; the first that fit are written. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. Ownership: copied during the call. State: any. Errors: INVALID_ARGUMENT (null with a capacity, one of
/// the second mesh null), INVALID_MESH, CANCELLED (the state does not change), NO_THREAD, BUSY, INTERNAL. Threads: any, one at a
/// time.
BespokeStatus bespoke_session_find_intersections(const struct BespokeSession *session,
                                                 const struct BespokeView *positions,
                                                 const struct BespokeView *triangles,
                                                 const struct BespokeView *other_positions,
                                                 const struct BespokeView *other_triangles,
                                                 uint32_t *pairs,
                                                 size_t capacity,
                                                 size_t *count);

/// Optional: what each triangle of the avatar is to the garment. Without it, or with BESPOKE_PART_ROLE_AUTOMATIC, the library
/// leaves out pieces that are no part of the body, with a diagnostic, and takes all else for body. With the option strict
/// it leaves nothing out.
///
/// `roles`: one BespokePartRole for each triangle of the avatar, U16 or U32; null takes all roles back. Whatever their
/// role, vertices keep their numbers, and BespokeReport counts the triangles that take part. Ownership: copied during
/// the call. State: SETUP; they stay with another avatar and after bespoke_session_reset. Errors: INVALID_ARGUMENT (no
/// role has that number; another count than the avatar's may be found only by bespoke_session_prepare, as may
/// INVALID_MESH where no body is left), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_avatar_parts(struct BespokeSession *session,
                                               const struct BespokeView *roles);

/// Optional: a morph of the garment as it was modelled, which goes over to the result: bespoke_session_read_garment_morph. Each
/// call adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `offsets`: one for each vertex of the garment, in its coordinate system, F32 or F64.
/// Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT (a number that is not finite; another number of
/// offsets than the garment has vertices is found by bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any,
/// one at a time.
BespokeStatus bespoke_session_add_garment_morph(struct BespokeSession *session,
                                                const char *name,
                                                const struct BespokeView *offsets);

/// Removes all morphs of the garment.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_garment_morphs(struct BespokeSession *session);

/// Writes a morph of the garment as it is now: each offset turned, stretched and scaled as the surface around its vertex has
/// been, in the target's coordinate system. Where the garment moves rigidly, or all of it is scaled, that is exact.
///
/// `morph`: its number. `offsets`: where to, one for each vertex of the garment, F32 or F64. With null data and capacity 0
/// nothing is written. `*count`, unless null: vertices of the garment, also where they do not fit. State: PREPARED or later;
/// until DONE it is that of a preview. Errors: INVALID_ARGUMENT (no such morph, too small a capacity; nothing is written then),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_garment_morph(const struct BespokeSession *session,
                                                 uint32_t morph,
                                                 const struct BespokeBuffer *offsets,
                                                 size_t *count);

/// Optional: a morph of the target avatar, such as a heavier body, to which the garment is to have an answer:
/// bespoke_session_solve_target_morphs. Each call adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `offsets`: one for each vertex of the target avatar, in its coordinate system, F32 or
/// F64. All else as for bespoke_session_add_garment_morph.
BespokeStatus bespoke_session_add_target_morph(struct BespokeSession *session,
                                               const char *name,
                                               const struct BespokeView *offsets);

/// Removes all morphs of the target avatar.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_target_morphs(struct BespokeSession *session);

/// How much of a target morph the avatar is to have from the next bespoke_session_refit on: the body changes its shape, takes the
/// garment along, with no triangle through another on the way, and the garment is fitted to it. Morphs add up, and layers go along
/// with the body beneath them. At first, and after bespoke_session_reset, all weights are 0: the avatar as it was set.
///
/// `morph`: its number. `weight`: any finite number; 0.5 is half of the morph. State: DONE, or FIT after bespoke_session_refit. Errors:
/// INVALID_ARGUMENT (no such morph, not finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_target_morph_weight(struct BespokeSession *session,
                                                      uint32_t morph,
                                                      double weight);

/// Finds what the garment answers to each morph of the target avatar with: from the result on, the body goes to the morph at
/// weight 1 and takes the garment along, with no triangle through another on the way, and the garment is fitted there, which
/// takes about as long as the fit. The result stays as it is. Layers go along with the body beneath them. A morph without an
/// answer is told by the diagnostic MORPH_NOT_SOLVED, and one whose answer intersects halfway by MORPH_INTERSECTS. Answers that
/// are there already are not sought again. Meanwhile the progress is in the stages REPOSE, with the weight as t, and FIT.
///
/// State: DONE, but not where the result is in the pose of the design (POSE_BLOCKED). Errors: INVALID_ARGUMENT (also a morph that is far larger than the body), INVALID_STATE,
/// CANCELLED (the state stays DONE, and what was found is kept), MEMORY_LIMIT, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_solve_target_morphs(struct BespokeSession *session);

/// Writes the garment's answer to a morph of the target avatar: a morph of the garment, as offsets from the result. With both at
/// weight 1 the garment is verified as the result is, in the precision in which it was set.
///
/// `morph`: the number of the avatar's morph. `offsets`, `count`: as for bespoke_session_read_garment_morph. State: DONE, after
/// bespoke_session_solve_target_morphs. Errors: INVALID_ARGUMENT (no such morph, too small a capacity; nothing is written then),
/// INVALID_STATE (also where the garment has no answer), BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_target_morph(const struct BespokeSession *session,
                                                uint32_t morph,
                                                const struct BespokeBuffer *offsets,
                                                size_t *count);

/// Optional: a mesh that follows the garment without being solved, such as a level of detail, a trim, a badge or a collision
/// proxy. It is bound to the nearest points of the garment as it was modelled and carried to the result. Each call adds one;
/// they are numbered from 0. Where one passes through the avatar or the garment in the result, and did not in the design, the
/// diagnostic FOLLOWER_INTERSECTS says so.
///
/// `positions`: points in the coordinate system of the garment, F32 or F64. `triangles`: three vertices each, U16 or U32.
/// Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL.
/// Threads: any, one at a time.
BespokeStatus bespoke_session_add_follower(struct BespokeSession *session,
                                           const struct BespokeView *positions,
                                           const struct BespokeView *triangles);

/// Removes all followers.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_followers(struct BespokeSession *session);

/// Writes the vertices of a follower where the result takes them, in the order in which they were set, in the target's coordinate
/// system.
///
/// `follower`: its number. `points`: where to, F32 or F64. With null data and capacity 0 nothing is written. `*count`, unless
/// null: its vertices, also where they do not fit. State: DONE. Errors: INVALID_ARGUMENT (no such follower, too small a
/// capacity; nothing is written then), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_follower_vertices(const struct BespokeSession *session,
                                                     uint32_t follower,
                                                     const struct BespokeBuffer *points,
                                                     size_t *count);

/// Writes skin weights of a follower, on the same joints as those of bespoke_session_read_garment_skin_influences: those of the
/// garment where the follower is bound to it.
///
/// `follower`: its number. `influences`, `joints`, `weights`, `joint_count`: as there. `vertices`: those that there is room for,
/// at least the follower's. State: DONE, with skin weights of the target avatar set. Errors: INVALID_ARGUMENT (no such follower,
/// null, no influences, too little room), INVALID_STATE, INVALID_WEIGHTS, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_follower_skin_influences(const struct BespokeSession *session,
                                                            uint32_t follower,
                                                            size_t influences,
                                                            uint32_t *joints,
                                                            float *weights,
                                                            size_t vertices,
                                                            size_t *joint_count);

/// Makes an avatar that many sessions use: of all that was set of the target in `session`, which are mesh, skeleton or rig, skin
/// weights, parts, layers, morphs and coordinate system. What such sessions need of it alone, above all the distance field, is
/// computed by the first of them and taken by the others, at once in any threads.
///
/// A session with it gives the same bits as one in which all was set anew. With the option memory_limit each session counts what
/// it shares as if it were its own. `session` itself shares it only once bespoke_session_use_avatar says so.
///
/// `*avatar`: where the handle goes; null where it fails. Ownership: the caller destroys it with bespoke_avatar_destroy; nothing is copied.
/// State: any, with the target avatar set. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_avatar_create(const struct BespokeSession *session,
                                    struct BespokeAvatar **avatar);

/// Dresses this avatar: it takes the place of all that was set of a target. What is set of the target afterwards holds for this
/// session alone, and another target avatar ends the sharing. A session keeps what it uses, also after bespoke_session_reset.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time; the avatar may be used by
/// other sessions meanwhile.
BespokeStatus bespoke_session_use_avatar(struct BespokeSession *session,
                                         const struct BespokeAvatar *avatar);

/// Frees an avatar. Sessions that use it go on, and what they share is freed with the last of them. A null avatar is fine.
///
/// Threads: any; no other call with this avatar may run or begin.
void bespoke_avatar_destroy(struct BespokeAvatar *avatar);

/// Makes a garment that many sessions use, as bespoke_avatar_create does an avatar: of all that was set of the garment in
/// `session`, which are mesh, source skeleton or rig, source avatar and the skin weights of both, fit weights, pins, rigid groups, curves,
/// morphs, followers and the source coordinate system. It is checked and welded once, and the body that it was made for is looked at
/// once; most of the work depends on the avatar, too, so less is saved than with a shared avatar.
///
/// `*garment`: where the handle goes; null where it fails. Ownership: the caller destroys it with bespoke_garment_destroy; nothing
/// is copied. State: any, with the garment set. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_garment_create(const struct BespokeSession *session,
                                     struct BespokeGarment **garment);

/// Fits this garment: it takes the place of all that was set of a garment and its source. What is set of them afterwards holds for
/// this session alone, and another garment ends the sharing. A session keeps what it uses, also after bespoke_session_reset.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time; the garment may be used by
/// other sessions meanwhile.
BespokeStatus bespoke_session_use_garment(struct BespokeSession *session,
                                          const struct BespokeGarment *garment);

/// Frees a garment. Sessions that use it go on, and what they share is freed with the last of them. A null garment is fine.
///
/// Threads: any; no other call with this garment may run or begin.
void bespoke_garment_destroy(struct BespokeGarment *garment);

/// Replaces all options by these.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null, struct_size, or an option out of its range, which the message names),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_set_options(struct BespokeSession *session, const struct BespokeOptions *options);

/// Fills a struct of options with the defaults written out. The caller sets `struct_size` first.
///
/// Errors: INVALID_ARGUMENT (null or struct_size). Threads: any, at any time.
BespokeStatus bespoke_options_read_defaults(struct BespokeOptions *options);

/// Checks the inputs against each other and shrinks the avatar onto the source skeleton. SETUP becomes PREPARED; where
/// it fails or is cancelled, the session stays in SETUP and keeps its inputs. Diagnostics about the inputs can be read
/// with bespoke_session_read_diagnostics, also where it fails.
///
/// State: SETUP, with garment, both skeletons and target avatar set. Errors: INVALID_STATE, INVALID_ARGUMENT (a voxel too
/// small for the avatar), INVALID_MESH (also: too far from the origin for its precision), INVALID_SKELETON (another
/// topology), INVALID_WEIGHTS (a wrong size), SELF_INTERSECTION (with the option strict), NOT_ENCLOSED, MEMORY_LIMIT,
/// NO_THREAD, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_prepare(struct BespokeSession *session);

/// Continues the run until it ends or the budget is spent, whichever is first.
///
/// `max_iterations`, `max_milliseconds`: the budget, 0 = no limit. It is checked after each iteration, so a step does
/// at least one and may take somewhat longer. `*stage`, unless null: the stage afterwards, one of BespokeStage, also
/// where the step failed (but not with BUSY or a null session). With OK and DONE the result is verified; until then
/// what can be read is a preview. With IMPLAUSIBLE_RESULT the stage is DONE, too: the result is verified, but no longer
/// as designed. State: PREPARED, INFLATE or FIT. Errors: INVALID_STATE (a session that has ended
/// continues only after bespoke_session_reset), INFLATION_STALLED, NOT_VERIFIED, IMPLAUSIBLE_RESULT, MEMORY_LIMIT,
/// CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_step(struct BespokeSession *session,
                                   uint32_t max_iterations,
                                   uint32_t max_milliseconds,
                                   uint32_t *stage);

/// Fits a result again: with other options, and with the fit weights, pins and target morph weights that were set since. bespoke_session_step or
/// bespoke_session_run then go on from the result, to another one with the same guarantee, in a small part of the time where
/// little has changed. It is the minimum near to the result that was there; for that from the beginning, call
/// bespoke_session_reset and run.
///
/// `options`: all of them, as in bespoke_session_set_options. Those that are used before the fit have to stay as they were:
/// threads, weld_distance, memory_limit, strict, keep_caps, curve_chord, dhat, inflation_dhat, inflation_barrier_weight,
/// voxel_size, min_separation, surface_form, surface_length. Pieces that the body carries keep their places. DONE becomes
/// FIT; it may be called again before that has ended. What was read of the result (normals, weights, morphs, followers) has
/// to be read again. State: DONE, or FIT after it. Errors: INVALID_ARGUMENT (null, struct_size, an option out of its range or
/// one that has to stay, a pin of a vertex that the garment does not have), INVALID_WEIGHTS (a wrong size), INVALID_STATE
/// (also: the result is in the pose of the design), INFLATION_STALLED (the garment does not let the avatar take the shape that its morph
/// weights ask for), after all of which the result stays; MEMORY_LIMIT, CANCELLED, BUSY,
/// INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_refit(struct BespokeSession *session,
                                    const struct BespokeOptions *options);

/// Runs a session to its end: prepares where needed, then steps. OK means DONE: the result is verified.
/// IMPLAUSIBLE_RESULT means DONE, too, see bespoke_session_step.
///
/// State: as for bespoke_session_prepare or bespoke_session_step. Errors: all of both. Threads: any, one at a time.
BespokeStatus bespoke_session_run(struct BespokeSession *session);

/// Counts the intersections of the vertices as they would be read now, with exact predicates.
///
/// `component`: the precision of reading, BESPOKE_COMPONENT_F32 or BESPOKE_COMPONENT_F64. A session that is DONE has,
/// in the precision of its garment, no others than initial self-intersections. State: PREPARED or later. Errors:
/// INVALID_ARGUMENT, INVALID_STATE, CANCELLED (by a request that no call has answered yet; the stage does not change),
/// BUSY, INTERNAL; `*intersections` is written with OK only. Threads: any, one at a time.
BespokeStatus bespoke_session_verify(const struct BespokeSession *session,
                                     uint32_t component,
                                     struct BespokeIntersections *intersections);

/// Cancels a session. The call that runs, if it is prepare, step, run or verify, returns CANCELLED within 100 ms,
/// whatever it is doing; otherwise the next one does. The request stays until bespoke_session_reset.
///
/// What can be read afterwards is the last complete iteration. Work that cannot be interrupted ends later in a thread
/// of the library; bespoke_session_reset and bespoke_session_destroy wait for it.
///
/// State: any. Errors: INVALID_ARGUMENT (null). Threads: any, at any time, also while another call runs; a signal handler may
/// call it.
BespokeStatus bespoke_session_cancel(const struct BespokeSession *session);

/// Fills a struct with the progress of a session as of its last iteration. The caller sets `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null or struct_size); the session's message does not change. Threads: any, at any
/// time, also while another call runs.
BespokeStatus bespoke_session_read_progress(const struct BespokeSession *session,
                                            struct BespokeProgress *progress);

/// Makes a control of a session and stores its handle in `*control`; stores null where it fails.
///
/// Ownership: the caller destroys it with bespoke_control_destroy, before or after the session. State: any. Errors:
/// INVALID_ARGUMENT (null). Threads: any, at any time, also while another call runs.
BespokeStatus bespoke_session_create_control(const struct BespokeSession *session, struct BespokeControl **control);

/// The same as bespoke_session_cancel. Without effect once the session is destroyed.
///
/// Errors: INVALID_ARGUMENT (null). Threads: any, at any time; a signal handler may call it.
BespokeStatus bespoke_control_cancel(const struct BespokeControl *control);

/// The same as bespoke_session_read_progress. Once the session is destroyed, the last progress stays.
///
/// Errors: INVALID_ARGUMENT (null or struct_size). Threads: any, at any time.
BespokeStatus bespoke_control_read_progress(const struct BespokeControl *control, struct BespokeProgress *progress);

/// Frees a control. The session runs on, and a request to cancel stays. A null control is fine.
///
/// Threads: any; no other call with this control may run or begin.
void bespoke_control_destroy(struct BespokeControl *control);

/// Writes the garment's current vertices, in the order in which they were set, in the target's coordinate system.
///
/// `points`: where to, F32 or F64. With null data and capacity 0 nothing is written. `*count`, unless null: vertices of
/// the garment, also where they do not fit. State: PREPARED or later. With DONE it is verified in this precision;
/// otherwise it is a preview. Errors: INVALID_ARGUMENT (a capacity that is too small as well; nothing is written then),
/// INVALID_STATE, NOT_VERIFIED (DONE, but clean only in the precision in which the garment was set; nothing is
/// written), BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_garment_vertices(const struct BespokeSession *session,
                                                    const struct BespokeBuffer *points,
                                                    size_t *count);

/// Writes the target avatar's current vertices, without its layers: shrunk onto the source skeleton at first, as they
/// were set at the end.
///
/// `points`, `count`, state, errors, threads: as for bespoke_session_read_garment_vertices.
BespokeStatus bespoke_session_read_avatar_vertices(const struct BespokeSession *session,
                                                   const struct BespokeBuffer *points,
                                                   size_t *count);

/// Writes how much each garment triangle is distorted now, in the order in which the triangles were set: how
/// differently it and its neighbours deform (Eq. 2 of the paper, in the similarity-invariant form, the mean over its
/// edges with a neighbour), over the ratio of the garment's area to that of the design. A number without unit, 0 or
/// above; 0 for any similarity of the garment as a whole, and for triangles without area or neighbours.
///
/// `values`: where to, one number for each triangle (not three), F32 or F64. With null data and capacity 0 nothing is
/// written. `*count`, unless null: triangles of the garment, also where they do not fit. State: PREPARED or later; until DONE
/// it is that of a preview. Errors: INVALID_ARGUMENT (a capacity that is too small as well; nothing is written then),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_distortion(const struct BespokeSession *session,
                                              const struct BespokeBuffer *values,
                                              size_t *count);

/// Fills a struct with the session's measurements so far. The caller sets `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null or struct_size), BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_report(const struct BespokeSession *session, struct BespokeReport *report);

/// Fills a struct with term `index` of the objective, counted from 0 up to the report's `energy_count`. The caller sets
/// `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null, struct_size, or no such term), BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_energy(const struct BespokeSession *session,
                                          uint32_t index,
                                          struct BespokeEnergy *energy);

/// Writes unit normals of the garment as it is now, and tangents, for the vertices with which it is drawn: those of the design,
/// turned as the surface around them has turned. Vertices in one place whose normals agree in the design, as along a seam of
/// texture coordinates, are turned by all the triangles there and stay smooth; where they differ, the edge stays hard. Where the
/// garment moves rigidly, exactly the given normals come back, turned.
///
/// `triangles`: the garment's triangles in their order, three render vertices each, from 0, U16 or U32; null: the vertices of
/// bespoke_session_set_garment are those that are drawn. `normals`: those of the design, one for each render vertex, in the
/// garment's coordinate system, of any length, F32 or F64. Null: they follow from the triangles, and vertices in one place
/// are smooth where they differ by no more than 60 degrees. `tangents`: four numbers for each render vertex, x, y, z and the
/// handedness of the bitangent, as in glTF; null: none. `result_normals`: where to, three numbers a vertex, F32 or F64, in the
/// target's coordinate system. `result_tangents`: the same with four, perpendicular to the normals; the fourth number is the one
/// given, with the other sign where one coordinate system is the mirror image of the other. Null: none. With null data and
/// capacity 0 nothing is written. `*count`, unless null: render vertices, also where they do not fit. What is given as 0, and
/// without normals what no triangle uses, comes out as 0. Ownership: what is given is read during the call and not kept. State: PREPARED or later; until DONE it is that of a preview. Errors:
/// INVALID_ARGUMENT (a capacity that is too small, arrays of different length, other triangles than the garment's, a
/// number that is not finite, room for tangents without any given), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_garment_normals(const struct BespokeSession *session,
                                                   const struct BespokeView *triangles,
                                                   const struct BespokeView *normals,
                                                   const struct BespokeView *tangents,
                                                   const struct BespokeBuffer *result_normals,
                                                   const struct BespokeBuffer *result_tangents,
                                                   size_t *count);

/// Writes skin weights of the result on the joints of the target rig, or on those of the target skeleton where no rig was
/// set: those of the body beneath, where the garment lies along it, and smoothly on from there where it does not. Vertices
/// of a rigid group have the same. With weights of the garment on its own joints (bespoke_session_set_garment_skin_influences),
/// such as those of a skirt or a cape, these joints come along: see bespoke_session_read_added_joints.
///
/// `influences`: joints a vertex, such as 4 or 8. `joints`, `weights`: `vertices` times `influences` of each, vertex after
/// vertex, the largest weight first; weights are not negative and sum to 1 for each vertex, and what a vertex does not need
/// is joint 0 with weight 0. `vertices`: those that there is room for, at least the garment's. `*joint_count`, unless null:
/// joints of the target rig and added joints together. State: DONE, with skin weights of the target avatar set. Errors:
/// INVALID_ARGUMENT (null, no influences, too little room), INVALID_STATE, INVALID_WEIGHTS (the avatar's weights are all
/// 0), CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_garment_skin_influences(const struct BespokeSession *session,
                                                           size_t influences,
                                                           uint32_t *joints,
                                                           float *weights,
                                                           size_t vertices,
                                                           size_t *joint_count);

/// Writes the garment's own joints: those of the source rig that move the garment, are no part of a body and have no
/// counterpart in the target rig, with what is between them and the first joint above that has one. They are placed where the
/// result has taken what they move.
///
/// `joints`: room for `capacity` of them, in the order of their numbers: the first is the number of joints of the target rig.
/// The first that fit are written. May be null where `capacity` is 0. `*count`, unless null: how many there are. State: DONE,
/// with skin weights of the target avatar set. Errors: INVALID_ARGUMENT (null with a capacity), INVALID_STATE,
/// INVALID_WEIGHTS, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_added_joints(const struct BespokeSession *session,
                                                struct BespokeAddedJoint *joints,
                                                size_t capacity,
                                                size_t *count);

/// Writes how each joint of the target rig moves from its bind pose to the pose that the result is in: 4 x 4 numbers each,
/// column after column, to be multiplied from the left. They are all the identity, but where the diagnostic POSE_BLOCKED says
/// that the result is in the pose of the design: there, garment and avatar that are read are in that pose.
///
/// `transforms`: room for `capacity` times BESPOKE_TRANSFORM_SIZE numbers; the first that fit are written. May be null where
/// `capacity` is 0. `*count`, unless null: joints of the target rig. State: DONE, with a target rig. Errors: INVALID_ARGUMENT
/// (null with a capacity), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_pose_transforms(const struct BespokeSession *session,
                                                   double *transforms,
                                                   size_t capacity,
                                                   size_t *count);

/// Optional: a pose of the target rig in which the garment is to keep out of the body, such as a bent arm or a crouch. Each call
/// adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `transforms`: for each joint of the target rig how it moves what it moves from the bind
/// pose to this pose, in the coordinate system of the target: BESPOKE_TRANSFORM_SIZE numbers each, column after column, to be
/// multiplied from the left. In an engine's words: the joint's posed global transform times its inverse bind matrix.
/// `joint_count`: as many as the target rig has. Ownership: copied during the call. State: SETUP or DONE, with a target rig;
/// in DONE the result stays. Errors: INVALID_ARGUMENT (null, another number of joints, a number that is not finite, a transform
/// without inverse), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_add_key_pose(struct BespokeSession *session,
                                           const char *name,
                                           const double *transforms,
                                           size_t joint_count);

/// Removes all key poses.
///
/// State: SETUP or DONE. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_clear_key_poses(struct BespokeSession *session);

/// Finds the correction of each key pose: offsets of the garment's vertices in the bind pose, a blend shape to be added before the
/// skin weights move them, at full weight in that pose and at none in the bind pose. From the result on, body and garment go to the
/// pose by their skin weights, with no triangle through another on the way, and the garment gives way where it has to. Where the
/// posed body passes through itself, as at the fold of a bent hip, nothing can lie between, and that part of it is left out. The
/// result stays as it is. Corrections that are there already are not sought again. It takes about as long as the fit for each
/// pose in which something passes through something. Meanwhile the progress is in the stage REPOSE.
///
/// `influences`: joints a vertex, as the host will read them with bespoke_session_read_garment_skin_influences. State: DONE, with
/// a target rig and skin weights of the target avatar set; but not where the result is in the pose of the design (POSE_BLOCKED).
/// Errors: INVALID_ARGUMENT (no influences), INVALID_STATE, INVALID_WEIGHTS, CANCELLED (the state stays DONE, and what was found is
/// kept), MEMORY_LIMIT, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_solve_pose_corrections(struct BespokeSession *session,
                                                     size_t influences);

/// Writes the correction of a key pose: offsets from the result, in the coordinate system of the target. They are 0 where the
/// weights alone do, and all of them where nothing passes through anything, or where none was found that is better.
///
/// `pose`: its number. `offsets`: where to, one for each vertex of the garment, F32 or F64. With null data and capacity 0 nothing
/// is written. `*count`, unless null: vertices of the garment, also where they do not fit. `before`, `after`, unless null: what
/// passes through what in that pose by the weights alone, and with the offsets. State: DONE, after
/// bespoke_session_solve_pose_corrections. Errors: INVALID_ARGUMENT (no such pose, too small a capacity; nothing is written
/// then), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_pose_correction(const struct BespokeSession *session,
                                                   uint32_t pose,
                                                   const struct BespokeBuffer *offsets,
                                                   size_t *count,
                                                   struct BespokePoseIntersections *before,
                                                   struct BespokePoseIntersections *after);

/// Writes the triangles of the avatar, or of a layer, that the garment covers: from outside nobody sees them in the pose that the
/// result is in, so that a game may leave them out while the garment is worn. It does not count as covering that a part of the
/// body beyond the garment is in the way, such as a hand before a sleeve.
///
/// `layer`: BESPOKE_NO_LAYER for the avatar, or a layer, numbered from 0; of a layer both sides have to be covered. `margin`: so
/// many rings of triangles are left beside those that are not covered; 1 is for games, 0 is for nothing that moves. `openness`:
/// the share of directions, from 0 to 1, in which a covered triangle may be seen all the same: 0 is for all, more for what
/// nobody looks at, as from the floor into a skirt (0.2). `triangles`: room for `capacity` triangles, which are written
/// ascending, as they were numbered when they were set; the first that fit. May be null where `capacity` is 0. `*count`, unless
/// null: how many there are. State: DONE. Errors: INVALID_ARGUMENT (null with a capacity, no such layer, an openness that is no
/// share), INVALID_STATE, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_covered_triangles(const struct BespokeSession *session,
                                                     uint32_t layer,
                                                     uint32_t margin,
                                                     double openness,
                                                     uint32_t *triangles,
                                                     size_t capacity,
                                                     size_t *count);

/// Writes the diagnostics about the inputs and the result: what prepare found, also where it failed, what holds the
/// garment where the inflation stalled, and what the verifier found in the end. Of one kind, the first thousand or so
/// are listed, and the last one says how many more there are.
///
/// `diagnostics`: room for `capacity` of them; the first that fit are written. The caller sets the `struct_size` of the first,
/// which is the size of each: so far apart they are written. May be null where `capacity` is 0. `*count`, unless null: how
/// many there are. State: any; there are none before prepare. Errors: INVALID_ARGUMENT (null with a capacity, or
/// struct_size), BUSY, INTERNAL. Threads: any, one at a time.
BespokeStatus bespoke_session_read_diagnostics(const struct BespokeSession *session,
                                               struct BespokeDiagnostic *diagnostics,
                                               size_t capacity,
                                               size_t *count);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* BESPOKE_H */
