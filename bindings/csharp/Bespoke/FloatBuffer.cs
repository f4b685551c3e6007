// The caller's memory that results are written to.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    /// <summary>
    /// Room for points (x, y, z) or other floating-point numbers. An array or span of float or double becomes one by
    /// itself, its numbers one after the other; arrays of a struct, such as an engine's vectors or vertices, become one
    /// by <see cref="F32{T}(T[], int)"/> and <see cref="F64{T}(T[], int)"/>. All other bytes stay as they are. The
    /// memory is written during the call, and never kept.
    /// </summary>
    public readonly ref struct FloatBuffer
    {
        internal readonly Span<byte> Bytes;
        private readonly Shape shape;

        private FloatBuffer(Span<byte> bytes, Shape shape)
        {
            Bytes = bytes;
            this.shape = shape;
        }

        /// <summary>Numbers one after the other; null is none.</summary>
        /// <param name="numbers">Where to.</param>
        public static implicit operator FloatBuffer(float[] numbers)
        {
            return new Span<float>(numbers);
        }

        /// <summary>Numbers one after the other; null is none.</summary>
        /// <param name="numbers">Where to.</param>
        public static implicit operator FloatBuffer(double[] numbers)
        {
            return new Span<double>(numbers);
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">Where to.</param>
        public static implicit operator FloatBuffer(Span<float> numbers)
        {
            return new FloatBuffer(MemoryMarshal.AsBytes(numbers), Shape.Packed(Component.F32));
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">Where to.</param>
        public static implicit operator FloatBuffer(Span<double> numbers)
        {
            return new FloatBuffer(MemoryMarshal.AsBytes(numbers), Shape.Packed(Component.F64));
        }

        /// <summary>
        /// The float fields that lie one after the other in each element: <c>FloatBuffer.F32(vectors)</c> of an array
        /// of vectors, and with an offset the positions in an array of vertices.
        /// </summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">Where to; null is nowhere.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The buffer.</returns>
        public static FloatBuffer F32<T>(T[] elements, int offset = 0) where T : struct
        {
            return F32(new Span<T>(elements), offset);
        }

        /// <summary>The same as <see cref="F32{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">Where to.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The buffer.</returns>
        public static FloatBuffer F32<T>(Span<T> elements, int offset = 0) where T : struct
        {
            return new FloatBuffer(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.F32, offset));
        }

        /// <summary>The same as <see cref="F32{T}(T[], int)"/> of double fields.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">Where to; null is nowhere.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The buffer.</returns>
        public static FloatBuffer F64<T>(T[] elements, int offset = 0) where T : struct
        {
            return F64(new Span<T>(elements), offset);
        }

        /// <summary>The same as <see cref="F64{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">Where to.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The buffer.</returns>
        public static FloatBuffer F64<T>(Span<T> elements, int offset = 0) where T : struct
        {
            return new FloatBuffer(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.F64, offset));
        }

        internal unsafe NativeBuffer Pinned(byte* pinned, int width, string what)
        {
            return shape.Or(Component.F32).Buffer(pinned, Bytes.Length, width, what);
        }
    }
}
