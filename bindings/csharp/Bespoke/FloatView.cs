// Points, weights: numbers of the caller that are read during a call.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    /// <summary>
    /// Points (x, y, z) or other floating-point numbers of the caller. An array or span of float or double becomes one
    /// by itself, its numbers one after the other. Arrays of a struct, such as an engine's vectors or vertices, become
    /// one by <see cref="F32{T}(T[], int)"/> and <see cref="F64{T}(T[], int)"/>. The memory is read during the call,
    /// and never kept.
    /// </summary>
    public readonly ref struct FloatView
    {
        internal readonly ReadOnlySpan<byte> Bytes;
        private readonly Shape shape;

        private FloatView(ReadOnlySpan<byte> bytes, Shape shape)
        {
            Bytes = bytes;
            this.shape = shape;
        }

        /// <summary>Numbers one after the other; null is none.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(float[] numbers)
        {
            return new ReadOnlySpan<float>(numbers);
        }

        /// <summary>Numbers one after the other; null is none.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(double[] numbers)
        {
            return new ReadOnlySpan<double>(numbers);
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(Span<float> numbers)
        {
            return (ReadOnlySpan<float>)numbers;
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(Span<double> numbers)
        {
            return (ReadOnlySpan<double>)numbers;
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(ReadOnlySpan<float> numbers)
        {
            return new FloatView(MemoryMarshal.AsBytes(numbers), Shape.Packed(Component.F32));
        }

        /// <summary>Numbers one after the other.</summary>
        /// <param name="numbers">The numbers.</param>
        public static implicit operator FloatView(ReadOnlySpan<double> numbers)
        {
            return new FloatView(MemoryMarshal.AsBytes(numbers), Shape.Packed(Component.F64));
        }

        /// <summary>
        /// The float fields that lie one after the other in each element: <c>FloatView.F32(vectors)</c> of an array of
        /// vectors, and with an offset the positions in an array of vertices.
        /// </summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements; null is none.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The view.</returns>
        public static FloatView F32<T>(T[] elements, int offset = 0) where T : struct
        {
            return F32(new ReadOnlySpan<T>(elements), offset);
        }

        /// <summary>The same as <see cref="F32{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The view.</returns>
        public static FloatView F32<T>(ReadOnlySpan<T> elements, int offset = 0) where T : struct
        {
            return new FloatView(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.F32, offset));
        }

        /// <summary>The same as <see cref="F32{T}(T[], int)"/> of double fields.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements; null is none.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The view.</returns>
        public static FloatView F64<T>(T[] elements, int offset = 0) where T : struct
        {
            return F64(new ReadOnlySpan<T>(elements), offset);
        }

        /// <summary>The same as <see cref="F64{T}(T[], int)"/> of a span.</summary>
        /// <typeparam name="T">A struct without references, in the order in which it lies in memory.</typeparam>
        /// <param name="elements">The elements.</param>
        /// <param name="offset">Bytes from the beginning of an element to the first of its numbers.</param>
        /// <returns>The view.</returns>
        public static FloatView F64<T>(ReadOnlySpan<T> elements, int offset = 0) where T : struct
        {
            return new FloatView(MemoryMarshal.AsBytes(elements), Shape.Within<T>(Component.F64, offset));
        }

        internal unsafe NativeView Pinned(byte* pinned, int width, string what)
        {
            return shape.Or(Component.F32).View(pinned, Bytes.Length, width, what);
        }

        // Whether number `place` of element `index` is there and 0.
        internal bool IsZero(int index, int width, int place)
        {
            int at = shape.At(index, width, place);
            if (at + shape.NumberSize > Bytes.Length)
            {
                return false;
            }
            ReadOnlySpan<byte> number = Bytes.Slice(at);
            return shape.Component == Component.F64
                ? MemoryMarshal.Read<double>(number) == 0.0
                : MemoryMarshal.Read<float>(number) == 0.0f;
        }
    }
}
