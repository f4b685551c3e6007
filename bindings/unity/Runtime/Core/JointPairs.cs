// Joints that correspond, by the engine's humanoid avatars and by hand.
using System.Collections.Generic;

namespace Bespoke.Unity
{
    /// <summary>Joints of two figures that correspond, as the library takes them.</summary>
    public static class JointPairs
    {
        /// <summary>
        /// Pairs of joints: first what the user says, then, for joints that he says nothing of, those that stand for the same
        /// bone of a humanoid avatar on both sides. Each joint is in one pair at most.
        /// </summary>
        /// <param name="source">For each bone of the source's humanoid avatar, by its name, the joint; null: it has none.</param>
        /// <param name="target">The same of the target.</param>
        /// <param name="chosen">For joints of the source, the one of the target; -1: nothing corresponds to it.</param>
        /// <returns>A joint of the source and one of the target each; -1 as the second: none.</returns>
        public static int[] Of(
            IReadOnlyDictionary<string, int> source, IReadOnlyDictionary<string, int> target,
            IReadOnlyDictionary<int, int> chosen)
        {
            List<int> pairs = new List<int>();
            HashSet<int> sources = new HashSet<int>();
            HashSet<int> targets = new HashSet<int>();
            if (chosen != null)
            {
                foreach (KeyValuePair<int, int> pair in chosen)
                {
                    sources.Add(pair.Key);
                    if (pair.Value >= 0)
                    {
                        targets.Add(pair.Value);
                    }
                    pairs.Add(pair.Key);
                    pairs.Add(pair.Value);
                }
            }
            if (source != null && target != null)
            {
                foreach (KeyValuePair<string, int> bone in source)
                {
                    int other;
                    if (target.TryGetValue(bone.Key, out other) && !sources.Contains(bone.Value) && targets.Add(other))
                    {
                        sources.Add(bone.Value);
                        pairs.Add(bone.Value);
                        pairs.Add(other);
                    }
                }
            }
            return pairs.ToArray();
        }
    }
}
