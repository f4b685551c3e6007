// How far a session is, in the words and shares of the program `bespoke`.
using System;

namespace Bespoke.Unity
{
    /// <summary>How far a session is.</summary>
    public static class Stages
    {
        /// <summary>
        /// From 0 to 1, by what the stages of a usual run take. The fit has no end that is known before: it comes nearer to its own
        /// with each iteration.
        /// </summary>
        /// <param name="stage">The stage.</param>
        /// <param name="t">How far inflation or repose is.</param>
        /// <param name="iteration">Iterations of this stage.</param>
        /// <returns>The share.</returns>
        public static double Share(Stage stage, double t, int iteration)
        {
            switch (stage)
            {
                case Stage.Prepared:
                    return 0.1;
                case Stage.Inflate:
                    return 0.1 + 0.3 * t;
                case Stage.Repose:
                    return 0.4 + 0.2 * t;
                case Stage.Fit:
                    return 0.6 + 0.35 * (1.0 - Math.Exp(-iteration / 20.0));
                case Stage.Verify:
                    return 0.97;
                case Stage.Done:
                    return 1.0;
                default:
                    return 0.0;
            }
        }

        /// <summary>In words.</summary>
        /// <param name="stage">The stage.</param>
        /// <returns>The words.</returns>
        public static string Words(Stage stage)
        {
            switch (stage)
            {
                case Stage.Setup:
                case Stage.Prepared:
                    return "preparing";
                case Stage.Inflate:
                    return "growing the body inside";
                case Stage.Repose:
                    return "taking the body to its pose";
                case Stage.Fit:
                    return "fitting";
                case Stage.Verify:
                    return "verifying";
                case Stage.Done:
                    return "done";
                case Stage.Failed:
                    return "failed";
                case Stage.Cancelled:
                    return "stopped";
                default:
                    return "";
            }
        }
    }
}
