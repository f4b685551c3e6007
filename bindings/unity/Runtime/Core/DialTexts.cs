// What the header says of the options behind the dials: bindings/bespoke.json, which a test compares.
namespace Bespoke.Unity
{
    /// <summary>What each dial does, for tooltips.</summary>
    public static class DialTexts
    {
        /// <summary>Of <see cref="Dials.Fit"/>.</summary>
        public const string Fit =
            "Weight of the fit term, higher is tighter. Default 2. 0: no fit.";

        /// <summary>Of <see cref="Dials.Looseness"/>.</summary>
        public const string Looseness =
            "Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that " +
            "each point of the garment had on it, in proportion to the limb there [up to 2]. Default 1, as " +
            "designed. 0: tight, as without a source avatar.";

        /// <summary>Of <see cref="Dials.Offset"/>.</summary>
        public const string Offset =
            "Clearance to aim at everywhere, in addition to the designed one, in the target's unit, from 0 to " +
            "half the size of the target skeleton. What is nearer is pushed away, what is farther is drawn in. " +
            "Default 0.";

        /// <summary>Of <see cref="Dials.FitDistance"/>.</summary>
        public const string FitDistance =
            "Where a source avatar is given and no fit weights: what was designed farther away from it than this " +
            "fits less, and not at all from twice this distance on. Default 0.1. 0: the garment fits as a whole.";

        /// <summary>Of <see cref="Dials.WeldDistance"/>.</summary>
        public const string WeldDistance =
            "Weld distance: open seams of the garment whose sides are nearer than this share of its mean edge are " +
            "closed [up to 0.25]. Default 0.01. 0: only vertices at equal positions are welded.";

        /// <summary>Of <see cref="Dials.KeepCaps"/>.</summary>
        public const string KeepCaps =
            "On: triangles that close an opening where a bone leaves the garment, as at neck, waist, cuffs and " +
            "hems, stay, and the garment is refused for them. Default off: they are left out while it is fitted, " +
            "go with their rim, and are named by the findings. They are not verified: the body passes through " +
            "them.";

        /// <summary>Of <see cref="Dials.Strict"/>.</summary>
        public const string Strict =
            "On: a garment that intersects itself at the start is refused. Default off: the triangles that do so " +
            "are exempted from contact until they separate and named by the findings; none are added later. So is " +
            "a target that faces another way than the source, which is turned by default.";

        /// <summary>Of <see cref="Dials.Threads"/>.</summary>
        public const string Threads =
            "Threads of this session [1, 1024], of which at most as many are started as the process may use cores " +
            "(its affinity and its container decide). Default: all of these. The report says how many work.";
    }
}
