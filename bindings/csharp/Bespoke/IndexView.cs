// Triangles, bones, lists of vertices: indices of the caller that are read during a call.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    /// <summary>
    /// Triangles (three vertices each), bones (two joints each) or other indices of the caller, from 0. An array or
    /// span of int, uint or ushort becomes one by itself, its numbers one after the other. Arrays of a struct become
    /// one by <see cref="I32{T}(T[], int)"/>, <see cref="U32{T}(T[], int)"/> and <see cref="U16{T}(T[], int)"/>. A
    /// negative index is refused with an exception. The memory is read during the call, and never kept.
    /// </summary>
    public readonly ref struct IndexView
    {
        internal readonly ReadOnlySpan<byte> Bytes;
        private readonly Shape shape;
        private readonly bool isSigned;

        private IndexView(ReadOnlySpan<byte> bytes, Shape shape, bool isSigned)
        {
            Bytes = bytes;
            this.shape = shape;
            this.isSigned = isSigned;
        }

        /// <summary>Indices one after the other; null is none.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(int[] indices)
        {
            return new ReadOnlySpan<int>(indices);
        }

        /// <summary>Indices one after the other; null is none.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(uint[] indices)
        {
            return new ReadOnlySpan<uint>(indices);
        }

        /// <summary>Indices one after the other; null is none.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(ushort[] indices)
        {
            return new ReadOnlySpan<ushort>(indices);
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(Span<int> indices)
        {
            return (ReadOnlySpan<int>)indices;
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(Span<uint> indices)
        {
            return (ReadOnlySpan<uint>)indices;
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(Span<ushort> indices)
        {
            return (ReadOnlySpan<ushort>)indices;
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(ReadOnlySpan<int> indices)
        {
            return new IndexView(MemoryMarshal.AsBytes(indices), Shape.Packed(Component.U32), true);
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(ReadOnlySpan<uint> indices)
        {
            return new IndexView(MemoryMarshal.AsBytes(indices), Shape.Packed(Component.U32), false);
        }

        /// <summary>Indices one after the other.</summary>
        /// <param name="indices">The indices.</param>
        public static implicit operator IndexView(ReadOnlySpan<ushort> indices)
        {
            return new IndexView(MemoryMarshal.AsBytes(indices), Shape.Packed(Component.U16), false);
        }

        /// <summary>
        /// The int fields that lie one after the other in each element: <c>IndexView.I32(triangles)</c> of an array of
        /// structs of three ints.
        /// </summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements; null is none.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView I32<T>(T[] elements, int offset = 0) where T : struct
        {
            return I32(new ReadOnlySpan<T>(elements), offset);
        }

        /// <summary>The same as <see cref="I32{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView I32<T>(ReadOnlySpan<T> elements, int offset = 0) where T : struct
        {
            return new IndexView(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.U32, offset), true);
        }

        /// <summary>The same as <see cref="I32{T}(T[], int)"/> of uint fields.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements; null is none.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView U32<T>(T[] elements, int offset = 0) where T : struct
        {
            return U32(new ReadOnlySpan<T>(elements), offset);
        }

        /// <summary>The same as <see cref="U32{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView U32<T>(ReadOnlySpan<T> elements, int offset = 0) where T : struct
        {
            return new IndexView(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.U32, offset), false);
        }

        /// <summary>The same as <see cref="I32{T}(T[], int)"/> of ushort fields.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements; null is none.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView U16<T>(T[] elements, int offset = 0) where T : struct
        {
            return U16(new ReadOnlySpan<T>(elements), offset);
        }

        /// <summary>The same as <see cref="U16{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its indices.</param>
        /// <returns>The view.</returns>
        public static IndexView U16<T>(ReadOnlySpan<T> elements, int offset = 0) where T : struct
        {
            return new IndexView(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.U16, offset), false);
        }

        internal unsafe NativeView Pinned(byte* pinned, int width, string what)
        {
            return shape.Or(Component.U32).View(pinned, Bytes.Length, width, what);
        }

        // For a view that Pinned has passed. The library would take a negative index for a very large one, and name
        // that. Where there are weights, an index whose weight is 0 may be anything.
        internal void RefuseNegative(
            int width, Status status, string what, string element, FloatView weights = default(FloatView))
        {
            if (!isSigned)
            {
                return;
            }
            int count = shape.Count(Bytes.Length, width, what);
            for (int k = 0; k < count; k++)
            {
                for (int place = 0; place < width; place++)
                {
                    int index = MemoryMarshal.Read<int>(Bytes.Slice(shape.At(k, width, place)));
                    if (index < 0 && !weights.IsZero(k, width, place))
                    {
                        throw new BespokeException(
                            status, $"{what}: {element} {k} has index {index}, and indices count from 0");
                    }
                }
            }
        }
    }
}
