// What goes along with a result: normals and tangents.
using System;
using System.Runtime.InteropServices;

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
    }
}
