// Whole runs: the bits of Rust, stopped, refused, without a library.
using System;
using System.Linq;
using System.Threading;
using Bespoke;
using Bespoke.Unity;

internal static class Fittings
{
    public static void AsInRust(string folder)
    {
        FittingTask task = Characters.Task(folder);
        SkinnedPart vest = task.Garments[0].Parts[0];
        vest.Normals = Enumerable.Range(0, vest.Positions.Length).Select(k => k % 3 == 1 ? 1f : 0f).ToArray();
        vest.Frames[0].Normals = Enumerable.Range(0, vest.Positions.Length).Select(k => k % 3 == 0 ? 1f : 0f).ToArray();
        Fitting run = new Fitting(task);
        run.Start().Wait();
        Check.That(run.IsOver && run.Defect == null, $"{run.Defect}");
        Check.Same(run.Progress(out string words), 1.0, "progress");
        Check.Same(words, "done", "words");
        Outcome outcome = run.Outcomes.Single();
        Check.That(outcome.Failure == null, $"{outcome.Failure}");
        Check.Same(outcome.Intersections, 0L, "intersections");
        Check.SameBits(outcome.Positions, Characters.Floats(folder, "dressed"), "the vest");
        Check.SameBits(outcome.Frames.Single().Vertices, Characters.Floats(folder, "dressed.morph"), "its blend shape");
        Check.Same(outcome.Frames[0].Weight, 100f, "the weight of the frame");
        Check.SameBits(outcome.Skin.Weights, Characters.Floats(folder, "dressed.weights"), "its skin");
        Check.That(outcome.Skin.Joints.SequenceEqual(Characters.Ints(folder, "dressed.joints")), "joints of its skin");
        Check.Same(outcome.Added.Length, 0, "joints of its own");
        for (int k = 0; k < outcome.Normals.Length; k += 3)
        {
            double length = Length(outcome.Normals, k);
            Check.That(Math.Abs(length - 1) < 1e-5, $"normal {k / 3} is {length} long");
            // The two given ones are perpendicular, so the frame turns the normal by 45 degrees.
            double turn = Length(outcome.Frames[0].Normals, k);
            Check.That(turn > 0.1 && turn < 1.3, $"the frame moves normal {k / 3} by {turn}");
        }
    }

    // A copy of the garment goes where the garment goes, with what it has, and one beside it stays beside it.
    public static void GoesAlong(string folder)
    {
        FittingTask plain = Characters.Task(folder);
        SkinnedPart vest = plain.Garments[0].Parts[0];
        SkinnedPart body = plain.Garments[0].Parts[1];
        float[] up = Enumerable.Range(0, vest.Positions.Length).Select(k => k % 3 == 1 ? 1f : 0f).ToArray();
        vest.Normals = up;
        SkinnedPart copy = Characters.Part(folder, "garment");
        copy.Name = "coarse";
        copy.Normals = up;
        copy.Frames.Add(new ShapeFrame { Name = "wide", Weight = 100, Vertices = vest.Frames[0].Vertices, Normals = up });
        FittingTask task = new FittingTask { Target = plain.Target };
        task.Garments.Add(new Figure(plain.Garments[0].Joints, vest, copy, body));
        task.Followers.Add(1);
        Fitting run = new Fitting(task);
        run.Work();
        Outcome outcome = run.Outcomes.Single();
        Check.That(outcome.Failure == null, $"{outcome.Failure}");
        Check.SameBits(outcome.Positions, Characters.Floats(folder, "dressed"), "the vest, as without");
        Worn worn = outcome.Followers.Single();
        Near(worn.Positions, outcome.Positions, 1e-4, "where the copy is");
        Check.That(worn.Skin.Joints.Length == outcome.Skin.Joints.Length, "its skin");
        Check.Same(worn.Tangents, null, "tangents that it has not");
        Check.Same(worn.Frames.Single().Weight, 100f, "the weight of its frame");
        double far = 0;
        for (int k = 0; k < worn.Normals.Length; k += 3)
        {
            double length = Length(worn.Normals, k);
            Check.That(Math.Abs(length - 1) < 1e-5, $"normal {k / 3} is {length} long");
            far += Distance(worn.Normals, outcome.Normals, k);
        }
        far /= worn.Normals.Length / 3;
        Check.That(far < 0.2, $"normals are {far} from those of the garment, in the mean");
        Check.Same(task.FollowersOf(5), 0, "of a garment that there is not");
    }

    // Turned by a quarter and twice as large: normals turn, offsets turn and grow.
    public static void Turned()
    {
        float[] before = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 5, 5, 5 };
        float[] after = { 9, 0, 0, 9, 2, 0, 7, 0, 0, 9, 0, 0, 5, 5, 5 };
        Turns turns = new Turns(new[] { 0, 1, 2 }, before, after);
        // The vertex in the place of the first one, which no triangle has, turns with it; the last one is anywhere.
        float[] offsets = { 1, 0, 0, 1, 0, 0, 0, 0, 3, 1, 0, 0, 1, 0, 0 };
        Near(turns.Turned(offsets, 3, true), new float[] { 0, 2, 0, 0, 2, 0, 0, 0, 6, 0, 2, 0, 1, 0, 0 }, 1e-5, "offsets");
        float[] tangents = { 1, 0, 0, -1 };
        Near(turns.Turned(tangents, 4, false), new float[] { 0, 1, 0, -1 }, 1e-5, "a tangent");
        Check.Same(turns.Turned(null, 3, true), null, "nothing");
    }

    private static void Near(float[] found, float[] expected, double tolerance, string what)
    {
        Check.Same(found.Length, expected.Length, what);
        for (int k = 0; k < found.Length; k++)
        {
            Check.That(
                Math.Abs(found[k] - expected[k]) <= tolerance, $"{what}: number {k} is {found[k]}, not {expected[k]}");
        }
    }

    private static double Distance(float[] one, float[] other, int at)
    {
        double sum = 0;
        for (int k = at; k < at + 3; k++)
        {
            sum += (one[k] - other[k]) * (one[k] - other[k]);
        }
        return Math.Sqrt(sum);
    }

    public static void Stopped(string folder)
    {
        Fitting run = new Fitting(Characters.Task(folder));
        var task = run.Start();
        double share = 0;
        for (int k = 0; k < 3000 && share < 0.11; k++)
        {
            Thread.Sleep(10);
            share = run.Progress(out string words);
            Check.That(words == "done" || words.StartsWith("garment: "), words);
        }
        Check.That(share >= 0.11 && share < 1, $"it is under way: {share}");
        run.Cancel();
        Check.That(task.Wait(2000), "it ends at once");
        Check.That(run.IsOver && run.IsCancelled && run.Defect == null, $"{run.Defect}");
        Check.Same(run.Outcomes.Count, 0, "outcomes");
    }

    // A garment that cannot be dressed has a reason; the next one is dressed all the same.
    public static void RefusedAndOverIt(string folder)
    {
        FittingTask task = Characters.Task(folder);
        SkinnedPart far = Characters.Part(folder, "garment");
        far.Positions = far.Positions.Select(x => x + 5f).ToArray();
        task.Garments.Insert(0, new Figure(Characters.Joints(folder, "source"), far, Characters.Part(folder, "source")));
        Fitting run = new Fitting(task);
        run.Work();
        Check.Same(run.Outcomes.Count, 2, "outcomes");
        Check.That(run.Outcomes[0].Positions == null, "a garment beside the body has no result");
        Check.Same(run.Outcomes[0].Failure.Status, Status.NotEnclosed, run.Outcomes[0].Failure.Message);
        Check.SameBits(run.Outcomes[1].Positions, Characters.Floats(folder, "dressed"), "the other one");
    }

    public static void JointMap(string folder)
    {
        FittingTask task = Characters.Task(folder);
        int hips = task.Garments[0].Joints.ToList().FindIndex(joint => joint.Name == "hips");
        Check.That(hips >= 0, "there are hips");
        MappedJoint[] map = Fitting.ReadJointMap(task, 0);
        Check.Same(map.Length, task.Garments[0].Joints.Count, "joints");
        Check.Same(map[hips].Target, (int?)hips, "hips");
        task.Pairs.Add(new[] { hips, -1 });
        map = Fitting.ReadJointMap(task, 0);
        Check.Same(map[hips].Target, null, "hips that are taken away");
        Check.Same(map[hips].Reason, JointReason.Caller, "why");
    }

    public static void NoLibrary(string folder)
    {
        Fitting run = new Fitting(Characters.Task(folder));
        run.Start().Wait();
        Check.That(run.IsOver, "it is over");
        Check.Same(run.Defect.GetType(), typeof(DllNotFoundException), $"{run.Defect}");
    }

    private static double Length(float[] numbers, int k)
    {
        return Math.Sqrt(
            numbers[k] * numbers[k] + numbers[k + 1] * numbers[k + 1] + (double)numbers[k + 2] * numbers[k + 2]);
    }
}
