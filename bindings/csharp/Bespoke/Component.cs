// How a number of an array is stored.
namespace Bespoke
{
    // Of everything that can be stored in an array; callers see it by the types of their arrays.
    internal enum Component : uint
    {
        F32 = 1,
        F64 = 2,
        U16 = 3,
        U32 = 4,
    }

    /// <summary>The floating-point type of positions.</summary>
    public enum Precision : uint
    {
        /// <summary>float</summary>
        F32 = Component.F32,

        /// <summary>double</summary>
        F64 = Component.F64,
    }
}
