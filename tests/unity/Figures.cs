// Meshes and joints of a character in one space, however its renderers stand.
using System;
using System.Collections.Generic;
using System.Linq;
using Bespoke.Unity;

internal static class Figures
{
    // The body is bound in another space than the garment, and the character stands somewhere, bent.
    public static void Placed(string folder)
    {
        SkinnedPart garment = Characters.Part(folder, "garment");
        SkinnedPart plain = Characters.Part(folder, "source");
        List<FigureJoint> joints = Characters.Joints(folder, "source");
        double[][] binds = Characters.Binds(folder, "source");
        double[] other = { 0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 7, -3, 1, 1 };
        double[] back = Transform4.Inverse(other);
        SkinnedPart body = Characters.Part(folder, "source");
        body.Positions = Transform4.Apply(other, plain.Positions);
        body.BindPoses = plain.BindPoses.Select(pose => Transform4.Multiply(pose, back)).ToArray();
        Random random = new Random(5);
        foreach (FigureJoint joint in joints)
        {
            // Wherever they stand now, their bind poses count.
            joint.ToWorld = Transform4.Multiply(Turn(random.NextDouble()), joint.ToWorld);
        }
        Figure figure = new Figure(joints, garment, body);
        Check.That(ReferenceEquals(figure.Parts[0], garment), "the first stays as it is");
        Near(figure.Parts[1].Positions, plain.Positions, 1e-5, "the body beside it");
        for (int k = 0; k < binds.Length; k++)
        {
            Near(figure.Bind(k), binds[k], 1e-9, $"bind of {joints[k].Name}");
        }
        figure.Joined(0, out float[] positions, out int[] triangles, out Influences skin);
        Check.Same(positions.Length, garment.Positions.Length + plain.Positions.Length, "numbers of both");
        Check.Same(triangles.Max(), positions.Length / 3 - 1, "the last vertex of both");
        Check.Same(skin.Joints.Length, 4 * positions.Length / 3, "joints of both");

        // Joints that no mesh is bound to stand to their parents, or to what hangs on them, as they do now.
        foreach (int unbound in new[] { 0, joints.Count - 1 })
        {
            double[] moved = Turn(0.3);
            List<FigureJoint> standing = Characters.Joints(folder, "source");
            standing.ForEach(joint => joint.ToWorld = Transform4.Multiply(moved, joint.ToWorld));
            SkinnedPart without = Characters.Part(folder, "garment");
            without.Joints[unbound] = -1;
            Near(new Figure(standing, without).Bind(unbound), binds[unbound], 1e-6, $"bind of joint {unbound}");
        }

        // Without a joint in common, where the renderers stand says how they lie to each other.
        SkinnedPart rigid = new SkinnedPart { Positions = new float[] { 1, 2, 3 }, ToWorld = Turn(0.5) };
        garment.ToWorld = Turn(0.5);
        Figure two = new Figure(Characters.Joints(folder, "source"), garment, rigid);
        Near(two.Parts[1].Positions, new float[] { 1, 2, 3 }, 1e-5, "a mesh without a skin");
        Check.That(!rigid.HasSkin && Influences.Of(rigid) == null, "it has none");
    }

    public static void Impossible()
    {
        FigureJoint joint = new FigureJoint { Name = "hips" };
        double[] flat = Transform4.Identity();
        flat[0] = 0;
        SkinnedPart part = new SkinnedPart { Name = "coat", Joints = new[] { 0 }, BindPoses = new[] { flat } };
        Refused(() => new Figure(new[] { joint }, part), "coat", "hips", "scale");
        part.BindPoses = new double[0][];
        Refused(() => new Figure(new[] { joint }, part), "coat", "1 bones and 0 bind poses");
        part.Joints = new[] { 3 };
        part.BindPoses = new[] { Transform4.Identity() };
        Refused(() => new Figure(new[] { joint }, part), "joint 3");
        Refused(() => new Figure(new[] { joint }), "at least one mesh");
        part.Joints = new[] { 0 };
        FigureJoint[] circle = { new FigureJoint { Name = "a", Parent = 1 }, new FigureJoint { Name = "b", Parent = 0 } };
        Refused(() => new Figure(circle, part), "above itself");
    }

    private static void Refused(Action work, params string[] words)
    {
        string message = Check.Throws<ArgumentException>(work).Message;
        Check.That(words.All(message.Contains), message);
    }

    private static double[] Turn(double angle)
    {
        double c = Math.Cos(angle), s = Math.Sin(angle);
        return new[] { c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 3 * angle, angle, -angle, 1 };
    }

    private static void Near(IEnumerable<float> found, IEnumerable<float> expected, double tolerance, string what)
    {
        Near(found.Select(x => (double)x).ToArray(), expected.Select(x => (double)x).ToArray(), tolerance, what);
    }

    private static void Near(double[] found, double[] expected, double tolerance, string what)
    {
        Check.Same(found.Length, expected.Length, what);
        for (int k = 0; k < found.Length; k++)
        {
            Check.That(
                Math.Abs(found[k] - expected[k]) <= tolerance, $"{what}: number {k} is {found[k]}, not {expected[k]}");
        }
    }
}
