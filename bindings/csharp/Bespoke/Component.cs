// How a number of an array is stored.
namespace Bespoke
{
    /// <summary>How one number of an array is stored.</summary>
    public enum Component : uint
    {
        /// <summary>float</summary>
        F32 = 1,

        /// <summary>double</summary>
        F64 = 2,

        /// <summary>ushort</summary>
        U16 = 3,

        /// <summary>uint, or int without negative numbers</summary>
        U32 = 4,
    }
}
