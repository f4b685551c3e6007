// Garments that are worn together: in which order, and whether they pass through each other.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    /// <summary>Of two garments of an outfit that meet, which is worn beneath the other.</summary>
    public sealed class WornPair
    {
        internal unsafe WornPair(NativeWornPair* native)
        {
            Inner = checked((int)native->inner);
            Outer = checked((int)native->outer);
            Confidence = native->confidence;
            IsOverruled = native->is_overruled != 0;
        }

        /// <summary>The garment beneath, by its number.</summary>
        public int Inner { get; }

        /// <summary>The garment above it.</summary>
        public int Outer { get; }

        /// <summary>
        /// From 0, as much speaks for the other order, to 1, nothing does; at most 0.5 where neither encloses the other and
        /// the distance from the source avatar decides.
        /// </summary>
        public double Confidence { get; }

        /// <summary>
        /// The order does not follow this pair, for with surer ones it would have gone around in a circle.
        /// </summary>
        public bool IsOverruled { get; }
    }

    public sealed partial class Session
    {
        /// <summary>
        /// Optional: a garment of an outfit as it was modelled, so that the order in which the outfit is worn can be read:
        /// <see cref="ReadOutfitOrder"/>. Each call adds one; they are numbered from 0. All of the outfit is added, also what
        /// is dressed in this session; none of it takes part in the run.
        /// </summary>
        /// <param name="positions">Points in the coordinate system of the garment and the source avatar; copied.</param>
        /// <param name="triangles">Three vertices each, from 0; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh, InvalidState, Busy, Internal.</exception>
        public unsafe void AddOutfitGarment(FloatView positions, IndexView triangles)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "outfit garment positions");
                NativeView corners = triangles.Pinned(t, 3, "outfit garment triangles");
                Check(Native.bespoke_session_add_outfit_garment(handle, &points, &corners));
            }
        }

        /// <summary>Removes all garments of the outfit.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearOutfit()
        {
            Check(Native.bespoke_session_clear_outfit(handle));
        }

        /// <summary>
        /// The order in which the garments of the outfit are worn, as their geometry tells: of two garments the inner one is
        /// that of which more lies in the other, and where neither does, that which is nearer to the source avatar, if one is
        /// set. In any stage.
        /// </summary>
        /// <returns>Their numbers, from the innermost outwards.</returns>
        /// <exception cref="BespokeException">NoThread, Busy, Internal.</exception>
        /// <exception cref="OperationCanceledException">By a request that no call has answered yet; the stage does not
        /// change.</exception>
        public unsafe uint[] ReadOutfitOrder()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_outfit_order(handle, null, UIntPtr.Zero, &count));
            uint[] order = new uint[checked((int)count)];
            fixed (uint* first = order)
            {
                Check(Native.bespoke_session_read_outfit_order(handle, first, (UIntPtr)(uint)order.Length, &count));
            }
            return order;
        }

        /// <summary>What the order is made of: the pairs of garments that meet, the surest first. In any stage.</summary>
        /// <returns>The pairs.</returns>
        /// <exception cref="BespokeException">As for <see cref="ReadOutfitOrder"/>.</exception>
        public unsafe WornPair[] ReadWornPairs()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_worn_pairs(handle, null, UIntPtr.Zero, &count));
            NativeWornPair[] native = new NativeWornPair[checked((int)count)];
            fixed (NativeWornPair* first = native)
            {
                Check(Native.bespoke_session_read_worn_pairs(handle, first, (UIntPtr)(uint)native.Length, &count));
                WornPair[] pairs = new WornPair[native.Length];
                for (int k = 0; k < pairs.Length; k++)
                {
                    pairs[k] = new WornPair(first + k);
                }
                return pairs;
            }
        }

        /// <summary>
        /// Finds the pairs of triangles of two meshes that touch or cross, such as two garments that hang beside each other, by
        /// the exact verifier. The inputs and the result of the session have no part in it. In any stage.
        /// </summary>
        /// <param name="positions">Points of a mesh.</param>
        /// <param name="triangles">Its triangles.</param>
        /// <param name="otherPositions">Points of another one in the same coordinate system; empty, together with
        /// <paramref name="otherTriangles"/>: pairs within the first.</param>
        /// <param name="otherTriangles">Its triangles.</param>
        /// <returns>Two numbers for each pair: the triangle of the first mesh and that of the other.</returns>
        /// <exception cref="BespokeException">InvalidArgument, InvalidMesh, NoThread, Busy, Internal.</exception>
        /// <exception cref="OperationCanceledException">By a request that no call has answered yet; the stage does not
        /// change.</exception>
        public unsafe uint[] FindIntersections(
            FloatView positions, IndexView triangles, FloatView otherPositions = default(FloatView),
            IndexView otherTriangles = default(IndexView))
        {
            fixed (byte* p = &MemoryMarshal.GetReference(positions.Bytes))
            fixed (byte* t = &MemoryMarshal.GetReference(triangles.Bytes))
            fixed (byte* q = &MemoryMarshal.GetReference(otherPositions.Bytes))
            fixed (byte* u = &MemoryMarshal.GetReference(otherTriangles.Bytes))
            {
                NativeView points = positions.Pinned(p, 3, "first mesh positions");
                NativeView corners = triangles.Pinned(t, 3, "first mesh triangles");
                NativeView otherPoints = otherPositions.Pinned(q, 3, "second mesh positions");
                NativeView otherCorners = otherTriangles.Pinned(u, 3, "second mesh triangles");
                bool isOne = otherPositions.Bytes.IsEmpty && otherTriangles.Bytes.IsEmpty;
                NativeView* second = isOne ? null : &otherPoints;
                NativeView* secondCorners = isOne ? null : &otherCorners;
                UIntPtr count;
                Check(Native.bespoke_session_find_intersections(
                    handle, &points, &corners, second, secondCorners, null, UIntPtr.Zero, &count));
                uint[] pairs = new uint[checked(2 * (int)count)];
                fixed (uint* first = pairs)
                {
                    Check(Native.bespoke_session_find_intersections(
                        handle, &points, &corners, second, secondCorners, first, count, &count));
                }
                return pairs;
            }
        }
    }
}
