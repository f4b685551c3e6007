// Results of a session: vertices, distortion, report, diagnostics.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    public sealed partial class Session
    {
        /// <summary>The stage of the session. At any time, also while another call runs.</summary>
        public Stage Stage
        {
            get { return ReadProgress().Stage; }
        }

        /// <summary>
        /// Progress of the session as of its last iteration. At any time, also while another call runs.
        /// </summary>
        /// <returns>The progress.</returns>
        public unsafe SessionProgress ReadProgress()
        {
            NativeProgress native = new NativeProgress { struct_size = (uint)sizeof(NativeProgress) };
            Check(Native.bespoke_session_read_progress(handle, &native));
            return new SessionProgress(&native);
        }

        /// <summary>
        /// Counts the intersections of the vertices as they would be read now, with exact predicates. A session that is
        /// Done has, in the precision of its garment, no others than initial self-intersections. State: Prepared or
        /// later.
        /// </summary>
        /// <param name="precision">The precision of reading.</param>
        /// <returns>The counts.</returns>
        /// <exception cref="BespokeException">InvalidArgument, InvalidState, Busy, Internal.</exception>
        /// <exception cref="OperationCanceledException">By a request that no call has answered yet; the stage does not
        /// change.
        /// </exception>
        public unsafe Intersections Verify(Precision precision = Precision.F32)
        {
            NativeIntersections native;
            Check(Native.bespoke_session_verify(handle, (Component)precision, &native));
            return new Intersections(native);
        }

        /// <summary>
        /// The triangles of the avatar, or of a layer, that the garment covers, ascending, so that they need not be drawn while
        /// it is worn. State: Done.
        /// </summary>
        /// <param name="layer">The layer that is asked about, from 0; null: the avatar.</param>
        /// <param name="margin">So many rings of triangles are left beside those that are not covered.</param>
        /// <param name="openness">The share of directions, from 0 to 1, in which a covered triangle may be seen all the
        /// same.</param>
        /// <returns>The triangles, as they were numbered when they were set.</returns>
        /// <exception cref="BespokeException">InvalidArgument, InvalidState, Cancelled, Busy, Internal.</exception>
        public unsafe uint[] ReadCoveredTriangles(int? layer = null, int margin = 1, double openness = 0.0)
        {
            uint of = layer == null ? NativeConstants.NoLayer : checked((uint)layer.Value);
            uint rings = checked((uint)margin);
            UIntPtr count;
            Check(Native.bespoke_session_read_covered_triangles(handle, of, rings, openness, null, UIntPtr.Zero, &count));
            uint[] triangles = new uint[checked((int)count)];
            fixed (uint* first = triangles)
            {
                Check(Native.bespoke_session_read_covered_triangles(
                    handle, of, rings, openness, first, (UIntPtr)(uint)triangles.Length, &count));
            }
            Array.Resize(ref triangles, Math.Min(triangles.Length, checked((int)count)));
            return triangles;
        }

        /// <summary>Vertices of the garment. State: Prepared or later.</summary>
        public unsafe int GarmentVertexCount
        {
            get
            {
                NativeBuffer nowhere = new NativeBuffer { component = Component.F64 };
                UIntPtr count;
                Status status = Native.bespoke_session_read_garment_vertices(handle, &nowhere, &count);
                // Of a result that is good in the other precision only, there are as many.
                if (status != Status.NotVerified)
                {
                    Check(status);
                }
                return checked((int)count);
            }
        }

        /// <summary>Vertices of the target avatar, without its layers. State: Prepared or later.</summary>
        public int AvatarVertexCount
        {
            get { return ReadAvatarVertices(default(FloatBuffer)); }
        }

        /// <summary>Triangles of the garment. State: Prepared or later.</summary>
        public int GarmentTriangleCount
        {
            get { return ReadDistortion(default(FloatBuffer)); }
        }

        /// <summary>
        /// Writes the garment's current vertices, in the order in which they were set, in the target's coordinate
        /// system and unit. State: Prepared or later. With Done it is verified in this precision; otherwise it is a
        /// preview.
        /// </summary>
        /// <param name="points">Room for a point for each vertex, or more; empty: nothing is written.</param>
        /// <returns>Vertices of the garment.</returns>
        /// <exception cref="BespokeException">InvalidArgument (too small a buffer as well; nothing is written then),
        /// InvalidState, NotVerified (Done, but good in the precision only in which the garment was set; nothing is
        /// written), Busy, Internal.</exception>
        public unsafe int ReadGarmentVertices(FloatBuffer points)
        {
            fixed (byte* to = &MemoryMarshal.GetReference(points.Bytes))
            {
                NativeBuffer buffer = points.Pinned(to, 3, "garment vertices");
                UIntPtr count;
                Check(Native.bespoke_session_read_garment_vertices(handle, &buffer, &count));
                return checked((int)count);
            }
        }

        /// <summary>
        /// The same as <see cref="ReadGarmentVertices(FloatBuffer)"/> into a new array: x, y, z of each vertex.
        /// </summary>
        /// <returns>The numbers.</returns>
        public float[] ReadGarmentVertices()
        {
            float[] points = new float[checked(3 * GarmentVertexCount)];
            ReadGarmentVertices(points);
            return points;
        }

        /// <summary>
        /// Writes where the target avatar's vertices, without its layers, are now: shrunk onto the skeleton at first,
        /// as they were set at the end. All else as for <see cref="ReadGarmentVertices(FloatBuffer)"/>.
        /// </summary>
        /// <param name="points">Room for a point for each vertex, or more; empty: nothing is written.</param>
        /// <returns>Vertices of the target avatar.</returns>
        public unsafe int ReadAvatarVertices(FloatBuffer points)
        {
            fixed (byte* to = &MemoryMarshal.GetReference(points.Bytes))
            {
                NativeBuffer buffer = points.Pinned(to, 3, "avatar vertices");
                UIntPtr count;
                Check(Native.bespoke_session_read_avatar_vertices(handle, &buffer, &count));
                return checked((int)count);
            }
        }

        /// <summary>
        /// The same as <see cref="ReadAvatarVertices(FloatBuffer)"/> into a new array: x, y, z of each vertex.
        /// </summary>
        /// <returns>The numbers.</returns>
        public float[] ReadAvatarVertices()
        {
            float[] points = new float[checked(3 * AvatarVertexCount)];
            ReadAvatarVertices(points);
            return points;
        }

        /// <summary>
        /// Writes how much each garment triangle is distorted now, in the order in which the triangles were set: how
        /// differently it and its neighbours deform (Eq. 2 of the paper, in the similarity-invariant form, the mean
        /// over its edges with a neighbour), over the ratio of the garment's area to that of the design. A number
        /// without unit, 0 or above; 0 for any similarity of the garment as a whole, and for triangles without area or
        /// neighbours. State: Prepared or later; until Done it is that of a preview.
        /// </summary>
        /// <param name="values">Room for one number for each triangle, or more; empty: nothing is written.</param>
        /// <returns>Triangles of the garment.</returns>
        /// <exception cref="BespokeException">InvalidArgument (too small a buffer as well; nothing is written then),
        /// InvalidState, Busy, Internal.</exception>
        public unsafe int ReadDistortion(FloatBuffer values)
        {
            fixed (byte* to = &MemoryMarshal.GetReference(values.Bytes))
            {
                NativeBuffer buffer = values.Pinned(to, 1, "distortion");
                UIntPtr count;
                Check(Native.bespoke_session_read_distortion(handle, &buffer, &count));
                return checked((int)count);
            }
        }

        /// <summary>The same as <see cref="ReadDistortion(FloatBuffer)"/> into a new array.</summary>
        /// <returns>A number for each triangle.</returns>
        public double[] ReadDistortion()
        {
            double[] values = new double[GarmentTriangleCount];
            ReadDistortion(values);
            return values;
        }

        /// <summary>What the session has done so far. State: any.</summary>
        /// <returns>The report.</returns>
        /// <exception cref="BespokeException">Busy, Internal.</exception>
        public unsafe Report ReadReport()
        {
            NativeReport native = new NativeReport { struct_size = (uint)sizeof(NativeReport) };
            Check(Native.bespoke_session_read_report(handle, &native));
            return new Report(&native);
        }

        /// <summary>One term of the objective. State: any.</summary>
        /// <param name="index">From 0 up to <see cref="Report.EnergyCount"/>.</param>
        /// <returns>The term.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such term), Busy, Internal.</exception>
        public unsafe Energy ReadEnergy(int index)
        {
            if (index < 0)
            {
                throw new ArgumentOutOfRangeException(nameof(index), "Terms count from 0.");
            }
            NativeEnergy native = new NativeEnergy { struct_size = (uint)sizeof(NativeEnergy) };
            Check(Native.bespoke_session_read_energy(handle, (uint)index, &native));
            return new Energy(&native);
        }

        /// <summary>
        /// Diagnostics about the inputs and the result: what <see cref="Prepare"/> found, also where it failed, and
        /// what the verifier found in the end. Of one kind, the first thousand or so are listed, and the last one says
        /// how many more there are. State: any; there are none before Prepare.
        /// </summary>
        /// <returns>The diagnostics.</returns>
        /// <exception cref="BespokeException">Busy, Internal.</exception>
        public unsafe Diagnostic[] ReadDiagnostics()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_diagnostics(handle, null, UIntPtr.Zero, &count));
            NativeDiagnostic[] native = new NativeDiagnostic[checked((int)count)];
            fixed (NativeDiagnostic* first = native)
            {
                if (first != null)
                {
                    first->struct_size = (uint)sizeof(NativeDiagnostic);
                }
                Check(Native.bespoke_session_read_diagnostics(handle, first, count, &count));
                // Another call between the two may have left fewer of them, or more.
                Diagnostic[] diagnostics = new Diagnostic[Math.Min(native.Length, checked((int)count))];
                for (int k = 0; k < diagnostics.Length; k++)
                {
                    diagnostics[k] = new Diagnostic(first + k);
                }
                return diagnostics;
            }
        }
    }
}
