// Where a session is on its way.
namespace Bespoke
{
    /// <summary>Where a session is on its way.</summary>
    public enum Stage : uint
    {
        /// <summary>Takes inputs; nothing is computed yet.</summary>
        Setup = 0,

        /// <summary>Step 1 is done: the avatar is shrunk onto the source skeleton.</summary>
        Prepared = 1,

        /// <summary>Step 2: the avatar grows to its full size inside the garment.</summary>
        Inflate = 2,

        /// <summary>Step 3: the garment settles onto the avatar.</summary>
        Fit = 3,

        /// <summary>The exact verifier looks at the result.</summary>
        Verify = 4,

        /// <summary>The result is final and verified.</summary>
        Done = 5,

        /// <summary>A call failed for good. What the garment looked like last can be read.</summary>
        Failed = 6,

        /// <summary>Somebody asked to stop. What the garment looked like last can be read.</summary>
        Cancelled = 7,
    }
}
