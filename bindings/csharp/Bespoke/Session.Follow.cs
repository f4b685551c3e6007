// What goes along with a result: normals and tangents, morphs, and meshes that follow.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Bespoke
{
    public sealed partial class Session
    {
        /// <summary>
        /// Writes unit normals of the garment as it is now, and tangents, for the vertices with which it is drawn: those
        /// of the design, turned as the surface around them has turned. Vertices in one place whose normals agree in the
        /// design, as along a seam of texture coordinates, are turned by all the triangles there and stay smooth; where
        /// they differ, the edge stays hard. Where the garment moves rigidly, exactly the given normals come back,
        /// turned. What is given as 0, and without normals what no triangle uses, comes out as 0. State: Prepared or
        /// later; until Done it is that of a preview.
        /// </summary>
        /// <param name="triangles">The garment's triangles in their order, three render vertices each, from 0; empty: the
        /// vertices of <see cref="SetGarment"/> are those that are drawn.</param>
        /// <param name="normals">Those of the design, one for each render vertex, in the garment's coordinate system, of
        /// any length; empty: they follow from the triangles, and vertices in one place are smooth where they differ by
        /// no more than 60 degrees.</param>
        /// <param name="tangents">Four numbers for each render vertex, x, y, z and the handedness of the bitangent;
        /// empty: none.</param>
        /// <param name="resultNormals">Room for three numbers for each render vertex, or more, in the target's coordinate
        /// system; empty: nothing is written.</param>
        /// <param name="resultTangents">The same with four, perpendicular to the normals; the fourth is the one given, with
        /// the other sign where one coordinate system is the mirror image of the other.</param>
        /// <returns>Render vertices.</returns>
        /// <exception cref="BespokeException">InvalidArgument (too small a buffer, arrays of different length, other
        /// triangles than the garment's, a number that is not finite, room for tangents without any given),
        /// InvalidState, Busy, Internal.</exception>
        public unsafe int ReadGarmentNormals(
            IndexView triangles, FloatView normals, FloatView tangents, FloatBuffer resultNormals,
            FloatBuffer resultTangents)
        {
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            fixed (byte* n = &MemoryMarshal.GetReference(normals.Bytes))
            fixed (byte* a = &MemoryMarshal.GetReference(tangents.Bytes))
            fixed (byte* toNormals = &MemoryMarshal.GetReference(resultNormals.Bytes))
            fixed (byte* toTangents = &MemoryMarshal.GetReference(resultTangents.Bytes))
            {
                NativeView corners = triangles.Pinned(t, 3, "triangles of the render vertices");
                NativeView designed = normals.Pinned(n, 3, "garment normals");
                NativeView along = tangents.Pinned(a, 4, "garment tangents");
                NativeBuffer first = resultNormals.Pinned(toNormals, 3, "garment normals");
                NativeBuffer second = resultTangents.Pinned(toTangents, 4, "garment tangents");
                UIntPtr count;
                Check(Native.bespoke_session_read_garment_normals(
                    handle,
                    triangles.Bytes.IsEmpty ? null : &corners,
                    normals.Bytes.IsEmpty ? null : &designed,
                    tangents.Bytes.IsEmpty ? null : &along,
                    &first,
                    resultTangents.Bytes.IsEmpty ? null : &second,
                    &count));
                return checked((int)count);
            }
        }

        /// <summary>
        /// Normals of the garment as it is now for the vertices of <see cref="SetGarment"/>: x, y, z of each. See <see
        /// cref="ReadGarmentNormals(IndexView, FloatView, FloatView, FloatBuffer, FloatBuffer)"/>.
        /// </summary>
        /// <param name="normals">Those of the design; null: they follow from the triangles.</param>
        /// <returns>The numbers.</returns>
        public float[] ReadGarmentNormals(float[] normals)
        {
            float[] result = new float[checked(3 * GarmentVertexCount)];
            ReadGarmentNormals(default(IndexView), normals, default(FloatView), result, default(FloatBuffer));
            return result;
        }

        /// <summary>
        /// Optional: a morph of the garment as it was modelled, which goes over to the result: <see
        /// cref="ReadGarmentMorph"/>. Each call adds one; they are numbered from 0.
        /// </summary>
        /// <param name="name">For messages; null: none.</param>
        /// <param name="offsets">One for each vertex of the garment, in its coordinate system; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument (another number of offsets than the garment has vertices is
        /// found by <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void AddGarmentMorph(string name, FloatView offsets)
        {
            byte[] text = Encoding.UTF8.GetBytes((name ?? "") + "\0");
            fixed (byte* first = text)
            fixed (byte* p = &MemoryMarshal.GetReference(offsets.Bytes))
            {
                NativeView view = offsets.Pinned(p, 3, "garment morph");
                Check(Native.bespoke_session_add_garment_morph(handle, first, &view));
            }
        }

        /// <summary>Removes all morphs of the garment.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearGarmentMorphs()
        {
            Check(Native.bespoke_session_clear_garment_morphs(handle));
        }

        /// <summary>
        /// A morph of the garment as it is now: each offset turned, stretched and scaled as the surface around its vertex
        /// has been, in the target's coordinate system. State: Prepared or later; until Done it is that of a preview.
        /// </summary>
        /// <param name="morph">Its number.</param>
        /// <returns>x, y, z of each vertex of the garment.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such morph), InvalidState, Busy,
        /// Internal.</exception>
        public unsafe float[] ReadGarmentMorph(int morph)
        {
            return ReadPoints(Native.bespoke_session_read_garment_morph, morph, "Morphs");
        }

        /// <summary>
        /// Optional: a morph of the target avatar, such as a heavier body, to which the garment is to have an answer: <see
        /// cref="SolveTargetMorphs"/>. Each call adds one; they are numbered from 0.
        /// </summary>
        /// <param name="name">For messages; null: none.</param>
        /// <param name="offsets">One for each vertex of the target avatar, in its coordinate system; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument (another number of offsets than the avatar has vertices is
        /// found by <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void AddTargetMorph(string name, FloatView offsets)
        {
            byte[] text = Encoding.UTF8.GetBytes((name ?? "") + "\0");
            fixed (byte* first = text)
            fixed (byte* p = &MemoryMarshal.GetReference(offsets.Bytes))
            {
                NativeView view = offsets.Pinned(p, 3, "target morph");
                Check(Native.bespoke_session_add_target_morph(handle, first, &view));
            }
        }

        /// <summary>Removes all morphs of the target avatar.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearTargetMorphs()
        {
            Check(Native.bespoke_session_clear_target_morphs(handle));
        }

        /// <summary>
        /// How much of a target morph the avatar is to have from the next <see cref="Refit"/> on: the body changes its
        /// shape, takes the garment along, with no triangle through another on the way, and the garment is fitted to it.
        /// Morphs add up. At first, and after <see cref="Reset"/>, all weights are 0. State: Done, or Fit after
        /// <see cref="Refit"/>.
        /// </summary>
        /// <param name="morph">Its number.</param>
        /// <param name="weight">Any finite number; 0.5 is half of the morph.</param>
        /// <exception cref="BespokeException">InvalidArgument (no such morph, not finite), InvalidState, Busy,
        /// Internal.</exception>
        public void SetTargetMorphWeight(int morph, double weight)
        {
            Check(Native.bespoke_session_set_target_morph_weight(handle, checked((uint)morph), weight));
        }

        /// <summary>
        /// Finds what the garment answers to each morph of the target avatar with: from the result on, the body goes to
        /// the morph at weight 1 and takes the garment along, with no triangle through another on the way, and the garment
        /// is fitted there, which takes about as long as the fit. The result stays as it is. A morph without an answer is
        /// told by the diagnostic MorphNotSolved, and one whose answer intersects halfway by MorphIntersects. State: Done.
        /// </summary>
        /// <exception cref="BespokeException">InvalidState, MemoryLimit, Busy, Internal.</exception>
        /// <exception cref="OperationCanceledException">It was cancelled; the stage stays Done, and what was found is
        /// kept.</exception>
        public void SolveTargetMorphs()
        {
            Check(Native.bespoke_session_solve_target_morphs(handle));
        }

        /// <summary>
        /// The garment's answer to a morph of the target avatar: a morph of the garment, as offsets from the result. With
        /// both at weight 1 the garment is verified as the result is. State: Done, after <see
        /// cref="SolveTargetMorphs"/>.
        /// </summary>
        /// <param name="morph">The number of the avatar's morph.</param>
        /// <returns>x, y, z of each vertex of the garment.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such morph), InvalidState (also where the garment has no
        /// answer), Busy, Internal.</exception>
        public unsafe float[] ReadTargetMorph(int morph)
        {
            return ReadPoints(Native.bespoke_session_read_target_morph, morph, "Morphs");
        }

        /// <summary>
        /// Optional: a mesh that follows the garment without being solved, such as a level of detail, a trim, a badge or a
        /// collision proxy. It is bound to the nearest points of the garment as it was modelled and carried to the result.
        /// Each call adds one; they are numbered from 0. Where one passes through the avatar or the garment in the result,
        /// and did not in the design, the diagnostic FollowerIntersects says so.
        /// </summary>
        /// <param name="positions">Points in the coordinate system of the garment; copied.</param>
        /// <param name="triangles">Three vertices each, from 0; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh, InvalidState, Busy, Internal.</exception>
        public unsafe void AddFollower(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "follower positions");
                NativeView corners = triangles.Pinned(t, 3, "follower triangles");
                Check(Native.bespoke_session_add_follower(handle, &points, &corners));
            }
        }

        /// <summary>Removes all followers.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearFollowers()
        {
            Check(Native.bespoke_session_clear_followers(handle));
        }

        /// <summary>
        /// The vertices of a follower where the result takes them, in the target's coordinate system. State: Done.
        /// </summary>
        /// <param name="follower">Its number.</param>
        /// <returns>x, y, z of each of its vertices.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such follower), InvalidState, Busy,
        /// Internal.</exception>
        public unsafe float[] ReadFollowerVertices(int follower)
        {
            return ReadPoints(Native.bespoke_session_read_follower_vertices, follower, "Followers");
        }

        /// <summary>
        /// Skin weights of a follower: those of the garment where it is bound to it. See <see
        /// cref="ReadGarmentSkinInfluences"/>. State: Done, with skin weights of the target avatar set.
        /// </summary>
        /// <param name="follower">Its number.</param>
        /// <param name="influences">Joints of a vertex, such as 4 or 8.</param>
        /// <param name="joints">For each vertex of it, as many joints, that with the largest weight first.</param>
        /// <param name="weights">For each vertex, as many weights, of sum 1.</param>
        /// <returns>Joints of the target rig and added joints together.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such follower), InvalidState, InvalidWeights, Busy,
        /// Internal.</exception>
        public unsafe int ReadFollowerSkinInfluences(
            int follower, int influences, out uint[] joints, out float[] weights)
        {
            AtLeastOne(influences, nameof(influences));
            int vertices = ReadFollowerVertices(follower).Length / 3;
            joints = new uint[checked(vertices * influences)];
            weights = new float[joints.Length];
            UIntPtr count;
            fixed (uint* j = joints)
            fixed (float* w = weights)
            {
                Check(Native.bespoke_session_read_follower_skin_influences(
                    handle, (uint)follower, (UIntPtr)(uint)influences, j, w, (UIntPtr)(uint)vertices, &count));
            }
            return checked((int)count);
        }

        private unsafe delegate Status ReadOne(SessionHandle session, uint index, NativeBuffer* points, UIntPtr* count);

        private unsafe float[] ReadPoints(ReadOne read, int index, string what)
        {
            if (index < 0)
            {
                throw new ArgumentOutOfRangeException(nameof(index), what + " count from 0.");
            }
            NativeBuffer nowhere = new NativeBuffer { component = Component.F32 };
            UIntPtr count;
            Check(read(handle, (uint)index, &nowhere, &count));
            float[] points = new float[checked(3 * (int)count)];
            fixed (float* first = points)
            {
                NativeBuffer buffer = new NativeBuffer
                {
                    data = first, capacity = count, component = Component.F32,
                };
                Check(read(handle, (uint)index, &buffer, &count));
            }
            return points;
        }
    }
}
