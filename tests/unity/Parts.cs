// Skin weights, pairs and transforms.
using System.Collections.Generic;
using System.Linq;
using Bespoke.Unity;

internal static class Parts
{
    // Two vertices: three bones, of which one is no joint, and one.
    public static void Weights()
    {
        SkinnedPart part = new SkinnedPart
        {
            Positions = new float[6],
            BonesPerVertex = new byte[] { 3, 1 },
            BoneIndices = new[] { 2, 1, 0, 0 },
            BoneWeights = new[] { 0.5f, 0.3f, 0.2f, 1f },
            Joints = new[] { 7, -1, 4 },
            BindPoses = Enumerable.Repeat(Transform4.Identity(), 3).ToArray(),
        };
        Influences read = Influences.Of(part);
        Check.Same(read.Width, 3, "joints of a vertex");
        Check.That(read.Joints.SequenceEqual(new[] { 4, 0, 7, 7, 0, 0 }), string.Join(" ", read.Joints));
        Check.That(read.Weights.SequenceEqual(new[] { 0.5f, 0f, 0.2f, 1f, 0f, 0f }), string.Join(" ", read.Weights));

        SkinnedPart bare = new SkinnedPart { Positions = new float[3] };
        Influences both = Influences.Joined(new[] { bare, part });
        Check.That(both.Width == 3 && both.Joints.Skip(3).SequenceEqual(read.Joints), "joined");
        Check.That(both.Weights.Take(3).All(w => w == 0f), "one without a skin has no weight");
        Check.That(Influences.Joined(new[] { bare, bare }) == null, "none at all");

        Influences result = new Influences(
            2, new[] { 9, 4, 4, 0, 0, 0 }, new[] { 0.75f, 0.25f, 1f, 0f, 0f, 0f });
        result.ToEngine(out byte[] counts, out int[] bones, out float[] weights, out int[] used);
        Check.That(counts.SequenceEqual(new byte[] { 2, 1, 1 }), "bones of each vertex");
        Check.That(used.SequenceEqual(new[] { 0, 4, 9 }), "joints that are used");
        Check.That(bones.SequenceEqual(new[] { 2, 1, 1, 0 }), string.Join(" ", bones));
        Check.That(weights.SequenceEqual(new[] { 0.75f, 0.25f, 1f, 1f }), string.Join(" ", weights));
    }

    public static void Pairs()
    {
        Dictionary<string, int> source = new Dictionary<string, int> { { "Hips", 0 }, { "Head", 5 }, { "LeftHand", 8 } };
        Dictionary<string, int> target = new Dictionary<string, int> { { "Hips", 2 }, { "Head", 3 }, { "Jaw", 4 } };
        Check.That(JointPairs.Of(source, target, null).SequenceEqual(new[] { 0, 2, 5, 3 }), "by the humanoid avatars");
        Check.Same(JointPairs.Of(source, null, null).Length, 0, "one has none");
        // What the user says wins, and no joint is in two pairs.
        Dictionary<int, int> chosen = new Dictionary<int, int> { { 0, -1 }, { 7, 3 } };
        Check.That(
            JointPairs.Of(source, target, chosen).SequenceEqual(new[] { 0, -1, 7, 3 }),
            string.Join(" ", JointPairs.Of(source, target, chosen)));
    }

    public static void Transforms()
    {
        double[] m = { 0, 2, 0, 0, -1, 0.5, 0, 0, 0, 0, 3, 0, 5, 6, 7, 1 };
        Check.That(Transform4.IsIdentity(Transform4.Multiply(m, Transform4.Inverse(m)), 1e-12), "there and back");
        Check.That(Transform4.IsIdentity(Transform4.Multiply(Transform4.Inverse(m), m), 1e-12), "back and there");
        Check.That(Transform4.Apply(m, new float[] { 1, 2, 3 }).SequenceEqual(new float[] { 3, 9, 16 }), "a point");
        Check.That(Transform4.Apply(m, new float[] { 1, 2, 3 }, 0).SequenceEqual(new float[] { -2, 3, 9 }), "a direction");
        m[0] = m[1] = 0;
        Check.That(Transform4.Inverse(m) == null, "flat");
        m[0] = double.NaN;
        Check.That(Transform4.Inverse(m) == null && !Transform4.IsIdentity(m), "not finite");
    }
}
