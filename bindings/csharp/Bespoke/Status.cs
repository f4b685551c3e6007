// The outcome of a call.
namespace Bespoke
{
    /// <summary>The outcome of a call.</summary>
    public enum Status : uint
    {
        /// <summary>It did what it says.</summary>
        Ok = 0,

        /// <summary>An argument is out of range or of the wrong size.</summary>
        InvalidArgument = 1,

        /// <summary>The call does not fit the state of the session.</summary>
        InvalidState = 2,

        /// <summary>A mesh cannot be used: no vertices, an index out of range, a coordinate that is not
        /// finite.</summary>
        InvalidMesh = 3,

        /// <summary>A skeleton cannot be used, or the two skeletons do not share a topology.</summary>
        InvalidSkeleton = 4,

        /// <summary>Skin or fit weights have the wrong shape or hold bad values.</summary>
        InvalidWeights = 5,

        /// <summary>The garment intersects itself at the start, and the options are strict.</summary>
        SelfIntersection = 6,

        /// <summary>The garment does not enclose its skeleton, and no way inside it was found.</summary>
        NotEnclosed = 7,

        /// <summary>The avatar could not be inflated to its full size without an intersection.</summary>
        InflationStalled = 8,

        /// <summary>The exact verifier found an intersection in the result.</summary>
        NotVerified = 9,

        /// <summary>
        /// Somebody asked to stop. It is thrown as <see cref="System.OperationCanceledException"/>, never as
        /// <see cref="BespokeException"/>.
        /// </summary>
        Cancelled = 10,

        /// <summary>Another thread is inside a call with the same session. Nothing was done.</summary>
        Busy = 11,

        /// <summary>
        /// A defect of the library. The session refuses all further work and can only be disposed of; others go on.
        /// </summary>
        Internal = 12,

        /// <summary>The session would take more memory than <see cref="Options.MemoryLimit"/> allows.</summary>
        MemoryLimit = 13,
    }
}
