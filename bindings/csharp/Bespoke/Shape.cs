// How the numbers of an array lie: one after the other, or in a field of larger elements.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    internal readonly struct Shape
    {
        internal readonly Component Component;

        // Bytes from one element to the next; 0: the numbers are packed.
        private readonly int stride;

        // Bytes from the beginning of an element to its first number.
        private readonly int offset;

        private Shape(Component component, int stride, int offset)
        {
            Component = component;
            this.stride = stride;
            this.offset = offset;
        }

        internal static Shape Packed(Component component)
        {
            return new Shape(component, 0, 0);
        }

        internal static Shape Within<T>(Component component, int offset) where T : struct
        {
            return new Shape(component, MemoryMarshal.AsBytes(new ReadOnlySpan<T>(new T[1])).Length, offset);
        }

        // The same; packed numbers of this type for a view that was never set, which is an empty one.
        internal Shape Or(Component component)
        {
            return Component == 0 ? Packed(component) : this;
        }

        internal int NumberSize
        {
            get { return Component == Component.U16 ? 2 : Component == Component.F64 ? 8 : 4; }
        }

        // Elements of `width` numbers in so many bytes.
        internal int Count(int bytes, int width, string what)
        {
            long size = (long)width * NumberSize;
            if (stride == 0)
            {
                if (bytes % size != 0)
                {
                    throw new BespokeException(
                        Status.InvalidArgument,
                        $"{what}: there are {bytes / NumberSize} numbers, which is no multiple of {width}");
                }
                return (int)(bytes / size);
            }
            if (offset < 0 || offset + size > stride)
            {
                throw new BespokeException(
                    Status.InvalidArgument,
                    $"{what}: {width} numbers of {NumberSize} bytes from byte {offset} on do not fit into an " +
                    $"element of {stride} bytes");
            }
            return bytes / stride;
        }

        // Where number `place` of element `index` begins; the array has passed Count.
        internal int At(int index, int width, int place)
        {
            return (stride == 0 ? index * width * NumberSize : index * stride + offset) + place * NumberSize;
        }

        internal unsafe NativeView View(byte* pinned, int bytes, int width, string what)
        {
            int count = Count(bytes, width, what);
            return new NativeView
            {
                data = count == 0 ? null : pinned + offset,
                count = (UIntPtr)(uint)count,
                stride = (UIntPtr)(uint)stride,
                component = Component,
            };
        }

        internal unsafe NativeBuffer Buffer(byte* pinned, int bytes, int width, string what)
        {
            int count = Count(bytes, width, what);
            return new NativeBuffer
            {
                data = count == 0 ? null : pinned + offset,
                capacity = (UIntPtr)(uint)count,
                stride = (UIntPtr)(uint)stride,
                component = Component,
            };
        }
    }
}
