// Progress of a session, a snapshot.
using System.Collections.Generic;

namespace Bespoke
{
    /// <summary>
    /// Progress of a session, a snapshot. Lengths are in the normalised space, in which the longest side of the
    /// skeleton's bounding box is 2.
    /// </summary>
    public sealed class SessionProgress
    {
        internal unsafe SessionProgress(NativeProgress* native)
        {
            Stage = native->stage;
            Iteration = checked((int)native->iteration);
            T = native->t;
            Energy = native->energy;
            GradientNorm = native->gradient_norm;
            MinDistance = native->min_distance;
            ActiveContacts = checked((long)native->active_contacts);
            PrepareSeconds = native->prepare_seconds;
            InflateSeconds = native->inflate_seconds;
            FitSeconds = native->fit_seconds;
            VerifySeconds = native->verify_seconds;
            double[] energies = new double[native->energy_count];
            for (int k = 0; k < energies.Length; k++)
            {
                energies[k] = native->energies[k];
            }
            Energies = energies;
        }

        /// <summary>The stage of the session.</summary>
        public Stage Stage { get; }

        /// <summary>Iterations of this stage so far.</summary>
        public int Iteration { get; }

        /// <summary>Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.</summary>
        public double T { get; }

        /// <summary>The objective: the sum of <see cref="Energies"/>.</summary>
        public double Energy { get; }

        /// <summary>Euclidean norm of the objective's gradient.</summary>
        public double GradientNorm { get; }

        /// <summary>Smallest distance of a contact pair; infinite where no pair is near.</summary>
        public double MinDistance { get; }

        /// <summary>Contact pairs closer than <see cref="Options.Dhat"/>.</summary>
        public long ActiveContacts { get; }

        /// <summary>Seconds in prepare so far.</summary>
        public double PrepareSeconds { get; }

        /// <summary>Seconds in inflate so far.</summary>
        public double InflateSeconds { get; }

        /// <summary>Seconds in fit so far.</summary>
        public double FitSeconds { get; }

        /// <summary>Seconds in the verifier so far.</summary>
        public double VerifySeconds { get; }

        /// <summary>Each term with its weight, in the order of <see cref="Session.ReadEnergy"/>.</summary>
        public IReadOnlyList<double> Energies { get; }
    }
}
