// What is set before a session runs. All of it needs the stage Setup.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    public sealed partial class Session
    {
        /// <summary>
        /// The garment as it was modelled, enclosing the source skeleton. It may be open and in pieces. The result is
        /// verified in the precision of its positions. A second call replaces the first.
        /// </summary>
        /// <param name="positions">Points.</param>
        /// <param name="triangles">Three vertices each, from 0.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh (no vertices, no triangles, an index out of
        /// range, a coordinate that is not finite), InvalidState, Busy, Internal.</exception>
        public unsafe void SetGarment(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "garment: positions");
                NativeView corners = triangles.Pinned(t, 3, "garment: triangles");
                triangles.RefuseNegative(3, Status.InvalidMesh, "garment", "triangle");
                Check(Native.bespoke_session_set_garment(handle, &points, &corners));
            }
        }

        /// <summary>
        /// The skeleton that the garment was modelled around, in the coordinate system of the garment.
        /// </summary>
        /// <param name="joints">Points.</param>
        /// <param name="bones">Two joints each, from 0; order and direction are free.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidSkeleton, InvalidState, Busy,
        /// Internal.</exception>
        public unsafe void SetSourceSkeleton(FloatView joints, IndexView bones)
        {
            fixed (byte* j = &MemoryMarshal.GetReference(joints.Bytes))
            fixed (byte* b = &MemoryMarshal.GetReference(bones.Bytes))
            {
                NativeView points = joints.Pinned(j, 3, "source skeleton: joints");
                NativeView ends = bones.Pinned(b, 2, "source skeleton: bones");
                bones.RefuseNegative(2, Status.InvalidSkeleton, "source skeleton", "bone");
                Check(Native.bespoke_session_set_source_skeleton(handle, &points, &ends));
            }
        }

        /// <summary>
        /// The body to dress. It may be open, non-manifold, in pieces, and may intersect itself.
        /// </summary>
        /// <param name="positions">Points.</param>
        /// <param name="triangles">Three vertices each, from 0.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh, InvalidState, Busy, Internal.</exception>
        public unsafe void SetTargetAvatar(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "target avatar: positions");
                NativeView corners = triangles.Pinned(t, 3, "target avatar: triangles");
                triangles.RefuseNegative(3, Status.InvalidMesh, "target avatar", "triangle");
                Check(Native.bespoke_session_set_target_avatar(handle, &points, &corners));
            }
        }

        /// <summary>
        /// The skeleton of the body to dress, in its coordinate system and in the pose of the source skeleton. Joint i
        /// corresponds to joint i of the source skeleton, and the same pairs of joints are bones.
        /// </summary>
        /// <param name="joints">Points.</param>
        /// <param name="bones">Two joints each, from 0; order and direction are free.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidSkeleton (another topology may be found only by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetTargetSkeleton(FloatView joints, IndexView bones)
        {
            fixed (byte* j = &MemoryMarshal.GetReference(joints.Bytes))
            fixed (byte* b = &MemoryMarshal.GetReference(bones.Bytes))
            {
                NativeView points = joints.Pinned(j, 3, "target skeleton: joints");
                NativeView ends = bones.Pinned(b, 2, "target skeleton: bones");
                bones.RefuseNegative(2, Status.InvalidSkeleton, "target skeleton", "bone");
                Check(Native.bespoke_session_set_target_skeleton(handle, &points, &ends));
            }
        }

        /// <summary>
        /// Optional: the body on which the garment was designed, in the coordinate system of the garment. With it, the
        /// fit aims at the clearance of the design.
        /// </summary>
        /// <param name="positions">Points.</param>
        /// <param name="triangles">Three vertices each, from 0.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh, InvalidState, Busy, Internal.</exception>
        public unsafe void SetSourceAvatar(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "source avatar: positions");
                NativeView corners = triangles.Pinned(t, 3, "source avatar: triangles");
                triangles.RefuseNegative(3, Status.InvalidMesh, "source avatar", "triangle");
                Check(Native.bespoke_session_set_source_avatar(handle, &points, &corners));
            }
        }

        /// <summary>
        /// Optional: skin weights of the target avatar as a full matrix, one row a joint. They only assign each vertex
        /// to one joint: the one with its largest weight, the lowest of several. Without them, and for a vertex whose
        /// weights are all 0, the nearest bone decides. Weights are finite and not negative; those of a vertex need not
        /// sum to 1.
        /// </summary>
        /// <param name="rows">For each joint, <paramref name="vertices"/> numbers.</param>
        /// <param name="vertices">Vertices of the target avatar.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidWeights (a wrong size may be found only by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetTargetSkinWeights(FloatView rows, int vertices)
        {
            AtLeastOne(vertices, nameof(vertices));
            fixed (byte* r = &MemoryMarshal.GetReference(rows.Bytes))
            {
                NativeView matrix = rows.Pinned(r, vertices, "target skin weights");
                Check(Native.bespoke_session_set_target_skin_weights(handle, &matrix, (UIntPtr)(uint)vertices));
            }
        }

        /// <summary>
        /// Optional: skin weights of the target avatar as engines keep them, a few joints with their weights for each
        /// vertex. Only the joint with the largest weight of a vertex is used; one with weight 0 is ignored. All else
        /// as for <see cref="SetTargetSkinWeights"/>, which this replaces.
        /// </summary>
        /// <param name="joints">For each vertex, <paramref name="influences"/> joints, from 0.</param>
        /// <param name="weights">For each vertex, as many weights.</param>
        /// <param name="influences">Joints of a vertex, such as 4.</param>
        /// <param name="jointCount">Joints of the target skeleton.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidWeights, InvalidState, Busy,
        /// Internal.</exception>
        public unsafe void SetTargetSkinInfluences(IndexView joints, FloatView weights, int influences, int jointCount)
        {
            AtLeastOne(influences, nameof(influences));
            AtLeastOne(jointCount, nameof(jointCount));
            fixed (byte* j = &MemoryMarshal.GetReference(joints.Bytes))
            fixed (byte* w = &MemoryMarshal.GetReference(weights.Bytes))
            {
                NativeView indices = joints.Pinned(j, influences, "target skin joints");
                NativeView numbers = weights.Pinned(w, influences, "target skin weights");
                joints.RefuseNegative(influences, Status.InvalidWeights, "target skin joints", "vertex", weights);
                Check(Native.bespoke_session_set_target_skin_influences(
                    handle, &indices, &numbers, (UIntPtr)(uint)influences, (UIntPtr)(uint)jointCount));
            }
        }

        /// <summary>
        /// Optional: the coordinate system of garment, source skeleton and source avatar; by default right-handed, in
        /// metres, y up.
        /// </summary>
        /// <param name="coordinateSystem">The coordinate system.</param>
        /// <exception cref="BespokeException">InvalidArgument (two axes along one coordinate, a unit outside
        /// 1e-9 to 1e9 metres), InvalidState, Busy, Internal.</exception>
        public unsafe void SetSourceCoordinateSystem(CoordinateSystem coordinateSystem)
        {
            NativeCoordinateSystem native = NotNull(coordinateSystem, nameof(coordinateSystem)).ToNative();
            Check(Native.bespoke_session_set_source_coordinate_system(handle, &native));
        }

        /// <summary>
        /// Optional: the coordinate system of target avatar and target skeleton, and so of the vertices that are read.
        /// </summary>
        /// <param name="coordinateSystem">The coordinate system.</param>
        /// <exception cref="BespokeException">As for <see cref="SetSourceCoordinateSystem"/>.</exception>
        public unsafe void SetTargetCoordinateSystem(CoordinateSystem coordinateSystem)
        {
            NativeCoordinateSystem native = NotNull(coordinateSystem, nameof(coordinateSystem)).ToNative();
            Check(Native.bespoke_session_set_target_coordinate_system(handle, &native));
        }

        /// <summary>
        /// Optional: how strongly each garment vertex is drawn to the body, relative to the others. 1 everywhere by
        /// default; 0: not at all.
        /// </summary>
        /// <param name="weights">One number for each garment vertex, finite and not negative.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidWeights (a wrong size may be found only by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetVertexFitWeights(FloatView weights)
        {
            fixed (byte* w = &MemoryMarshal.GetReference(weights.Bytes))
            {
                NativeView numbers = weights.Pinned(w, 1, "fit weights");
                Check(Native.bespoke_session_set_vertex_fit_weights(handle, &numbers));
            }
        }

        /// <summary>
        /// Optional: the garment vertices that are not drawn to the body. The same as <see cref="SetVertexFitWeights"/>,
        /// which this replaces, with 0 for these vertices and 1 for all others: triangles with all three corners listed
        /// do not fit. State: Setup, with the garment set.
        /// </summary>
        /// <param name="vertices">Garment vertices, from 0, in any order.</param>
        /// <exception cref="BespokeException">InvalidArgument (a vertex out of range as well), InvalidState, Busy,
        /// Internal.
        /// </exception>
        public unsafe void SetNoFitVertices(IndexView vertices)
        {
            fixed (byte* v = &MemoryMarshal.GetReference(vertices.Bytes))
            {
                NativeView indices = vertices.Pinned(v, 1, "no-fit vertices");
                vertices.RefuseNegative(1, Status.InvalidArgument, "no-fit vertices", "element");
                Check(Native.bespoke_session_set_no_fit_vertices(handle, &indices));
            }
        }

        /// <summary>
        /// Optional: garment vertices that keep their positions relative to the nearest bone: the coordinate along the
        /// bone and the distance from it. Replaces earlier pins; none: no pins. A pin is a stiff spring (see
        /// <see cref="Options.PinWeight"/>): one that cannot reach its target, because the body is in the way, is
        /// reported as a diagnostic.
        /// </summary>
        /// <param name="vertices">Garment vertices, from 0, each once.</param>
        /// <exception cref="BespokeException">InvalidArgument (a vertex that the garment does not have is found by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetPinnedVertices(IndexView vertices)
        {
            fixed (byte* v = &MemoryMarshal.GetReference(vertices.Bytes))
            {
                NativeView indices = vertices.Pinned(v, 1, "pinned vertices");
                vertices.RefuseNegative(1, Status.InvalidArgument, "pinned vertices", "element");
                Check(Native.bespoke_session_set_pinned_vertices(handle, &indices, null));
            }
        }

        /// <summary>
        /// The same as <see cref="SetPinnedVertices(IndexView)"/>, with a target for each of them.
        /// </summary>
        /// <param name="vertices">Garment vertices, from 0, each once.</param>
        /// <param name="targets">One point for each of them, in the target's coordinate system.</param>
        /// <exception cref="BespokeException">As there.</exception>
        public unsafe void SetPinnedVertices(IndexView vertices, FloatView targets)
        {
            fixed (byte* v = &MemoryMarshal.GetReference(vertices.Bytes))
            fixed (byte* p = &MemoryMarshal.GetReference(targets.Bytes))
            {
                NativeView indices = vertices.Pinned(v, 1, "pinned vertices");
                NativeView points = targets.Pinned(p, 3, "pinned vertices: targets");
                vertices.RefuseNegative(1, Status.InvalidArgument, "pinned vertices", "element");
                Check(Native.bespoke_session_set_pinned_vertices(handle, &indices, &points));
            }
        }

        /// <summary>
        /// Optional: garment vertices that stay one rigid body, such as a button, a buckle or an armour plate: it
        /// moves, turns and keeps its shape. Its size scales with the skeletons. Each call adds a group; they are
        /// numbered from 0. A group that contact keeps from becoming rigid up to rounding is reported as a diagnostic.
        /// </summary>
        /// <param name="vertices">Garment vertices, from 0, in any order; at least one, none of another group.</param>
        /// <exception cref="BespokeException">InvalidArgument (a vertex that the garment does not have is found by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void AddRigidGroup(IndexView vertices)
        {
            fixed (byte* v = &MemoryMarshal.GetReference(vertices.Bytes))
            {
                NativeView indices = vertices.Pinned(v, 1, "rigid group");
                vertices.RefuseNegative(1, Status.InvalidArgument, "rigid group", "element");
                Check(Native.bespoke_session_add_rigid_group(handle, &indices));
            }
        }

        /// <summary>Removes all rigid groups.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearRigidGroups()
        {
            Check(Native.bespoke_session_clear_rigid_groups(handle));
        }

        /// <summary>
        /// Optional: a curve along edges of the garment, such as a neckline, a seam line or the rim of a lined sleeve, that
        /// keeps its shape and its place along the bones. Each call adds a curve; they are numbered from 0. One that runs
        /// through the vertices of a boundary curve takes its place.
        /// </summary>
        /// <param name="vertices">Garment vertices, from 0, in the order of the curve, each once.</param>
        /// <param name="closed">Whether the last is joined to the first.</param>
        /// <param name="curveWeight">Factor on <see cref="Options.CurvatureWeight"/> and
        /// <see cref="Options.TorsionWeight"/>, up to 1e6: 1 as for a boundary curve, 0 for none.</param>
        /// <param name="positionWeight">Factor on <see cref="Options.PositionWeight"/>. A closed curve keeps its place along
        /// the bone that goes through it, each vertex of an open one along the bone nearest to it.</param>
        /// <exception cref="BespokeException">InvalidArgument (a vertex that the garment does not have, and two in a row
        /// that no edge joins, are found by <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void AddCurve(IndexView vertices, bool closed, double curveWeight = 1, double positionWeight = 1)
        {
            fixed (byte* v = &MemoryMarshal.GetReference(vertices.Bytes))
            {
                NativeView indices = vertices.Pinned(v, 1, "curve");
                vertices.RefuseNegative(1, Status.InvalidArgument, "curve", "element");
                Check(Native.bespoke_session_add_curve(
                    handle, &indices, closed ? 1u : 0u, curveWeight, positionWeight));
            }
        }

        /// <summary>Removes all curves that were added.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearCurves()
        {
            Check(Native.bespoke_session_clear_curves(handle));
        }

        /// <summary>
        /// Optional: what each triangle of the avatar is to the garment. Without it, or with
        /// <see cref="PartRole.Automatic"/>, pieces that are no part of the body are left out with a diagnostic, and all else
        /// is body.
        /// </summary>
        /// <param name="roles">A number of <see cref="PartRole"/> for each triangle of the avatar.</param>
        /// <exception cref="BespokeException">InvalidArgument (no role has that number; another count than the avatar's
        /// may be found only by <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetAvatarParts(IndexView roles)
        {
            fixed (byte* r = &MemoryMarshal.GetReference(roles.Bytes))
            {
                NativeView numbers = roles.Pinned(r, 1, "avatar parts");
                roles.RefuseNegative(1, Status.InvalidArgument, "avatar parts", "element");
                Check(Native.bespoke_session_set_avatar_parts(handle, &numbers));
            }
        }

        /// <summary>
        /// Optional: a garment that the avatar wears already, such as one that was read from another session. It joins
        /// the avatar as an obstacle that keeps its shape: the garment of this session fits over avatar and layers, and
        /// is verified against both. Each call adds one layer; they are numbered from 0, and stay until
        /// <see cref="ClearLayers"/>, also when another avatar is set and after <see cref="Reset"/>. Skin weights are
        /// those of the avatar beneath, where it has any. What is read or counted as the avatar does not include its
        /// layers.
        /// </summary>
        /// <param name="positions">Points in the coordinate system of the target avatar; used exactly as they
        /// are.</param>
        /// <param name="triangles">Three vertices each, from 0.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh (no vertices, no triangles, an index out of
        /// range, a coordinate that is not finite), InvalidState, Busy, Internal.</exception>
        public unsafe void AddLayer(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "layer: positions");
                NativeView corners = triangles.Pinned(t, 3, "layer: triangles");
                triangles.RefuseNegative(3, Status.InvalidMesh, "layer", "triangle");
                Check(Native.bespoke_session_add_layer(handle, &points, &corners));
            }
        }

        /// <summary>Takes all layers off the avatar.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearLayers()
        {
            Check(Native.bespoke_session_clear_layers(handle));
        }

        /// <summary>Replaces all options by these.</summary>
        /// <param name="options">The options; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument (an option out of its range, which the message names),
        /// InvalidState, Busy, Internal.</exception>
        public unsafe void SetOptions(Options options)
        {
            NativeOptions native = NotNull(options, nameof(options)).ToNative();
            Check(Native.bespoke_session_set_options(handle, &native));
        }

        private static T NotNull<T>(T argument, string name) where T : class
        {
            if (argument == null)
            {
                throw new ArgumentNullException(name);
            }
            return argument;
        }

        private static void AtLeastOne(int number, string name)
        {
            if (number < 1)
            {
                throw new ArgumentOutOfRangeException(name, "There is at least one.");
            }
        }
    }
}
