// The part of Component that callers see.
namespace Bespoke
{
    /// <summary>The floating-point type of positions.</summary>
    public enum Precision : uint
    {
        /// <summary>float</summary>
        F32 = Component.F32,

        /// <summary>double</summary>
        F64 = Component.F64,
    }
}
