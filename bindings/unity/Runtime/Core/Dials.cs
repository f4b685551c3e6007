// How a garment is to fit: the dials, which have the same names and defaults in all hosts.
using System;

namespace Bespoke.Unity
{
    /// <summary>
    /// How a garment is to fit. Names and defaults are those of the program `bespoke` and of docs/options.md; here 0 means 0. What is
    /// not here is at its default.
    /// </summary>
    [Serializable]
    public sealed class Dials
    {
        /// <summary>How tight: option fit_weight. 0: no fit.</summary>
        public double Fit = 2;

        /// <summary>How much of the looseness on its own body to aim at, up to 2: option designed_clearance. 0: tight.</summary>
        public double Looseness = 1;

        /// <summary>Clearance to aim at everywhere beside that, in the unit of the target: option offset.</summary>
        public double Offset;

        /// <summary>What was designed farther from its body than this fits less: option fit_distance. 0: all of it fits.</summary>
        public double FitDistance = 0.1;

        /// <summary>Open seams whose sides are nearer than this share of the mean edge are closed: option weld_distance. 0:
        /// none.</summary>
        public double WeldDistance = 0.01;

        /// <summary>Refuse a garment that is closed by caps where bones leave it: option keep_caps.</summary>
        public bool KeepCaps;

        /// <summary>Refuse a garment that intersects itself: option strict.</summary>
        public bool Strict;

        /// <summary>Threads: option threads. 0: all cores.</summary>
        public int Threads;

        /// <summary>As the library takes them.</summary>
        /// <returns>New options.</returns>
        public Options ToOptions()
        {
            return new Options
            {
                FitWeight = OrOff(Fit),
                DesignedClearance = OrOff(Looseness),
                Offset = Offset,
                FitDistance = OrOff(FitDistance),
                WeldDistance = OrOff(WeldDistance),
                KeepCaps = KeepCaps,
                Strict = Strict,
                Threads = checked((uint)Math.Max(0, Threads)),
            };
        }

        // For the library 0 is the default.
        private static double OrOff(double weight)
        {
            return weight == 0 ? Options.WeightOff : weight;
        }
    }
}
