// What is refused, and how.
using System;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using Bespoke;

internal static class Errors
{
    public static void Library()
    {
        Check.Same(Bespoke.Library.LoadedAbiVersion, Bespoke.Library.AbiVersion, "binary interface");
        Check.That(Bespoke.Library.VersionText.Split('.').Length == 3, Bespoke.Library.VersionText);
        Check.Same(Bespoke.Library.StatusName(Status.NotEnclosed), "BESPOKE_STATUS_NOT_ENCLOSED", "name");
        Check.Same(Bespoke.Library.StatusName((Status)99), "BESPOKE_STATUS_UNKNOWN", "name");
        Options defaults = Options.ReadDefaults();
        Check.That(defaults.FitWeight == 2.0 && defaults.MaxIterations == 500 && !defaults.Strict, "defaults");
        Check.That(
            defaults.BarrierWeight == 1e8 && defaults.PinWeight == 1000.0 && defaults.FitDistance == 0.1, "more");
    }

    // This process has a library that says it has another binary interface.
    public static void OtherInterface()
    {
        BadImageFormatException refusal = Check.Throws<BadImageFormatException>(() => new Session());
        Check.That(refusal.Message.Contains("99") && refusal.Message.Contains("9.9.9"), refusal.Message);
        Check.Throws<BadImageFormatException>(() => Options.ReadDefaults());
    }

    // This process has none.
    public static void NoLibrary()
    {
        DllNotFoundException refusal = Check.Throws<DllNotFoundException>(() => new Session());
        Check.That(refusal.Message.Contains("bespoke"), refusal.Message);
    }

    public static void Arguments()
    {
        Inputs inputs = Inputs.Tube();
        using (Session session = inputs.Session())
        {
            FoundByTheBinding(inputs, session);
            FoundByTheLibrary(inputs, session);
            // Nothing of that has changed the session.
            session.Run();
            Check.Same(session.Stage, Stage.Done, "stage");
            Invalid(() => session.ReadGarmentVertices(new float[3]), "1", "144");
            Check.Same(session.ReadGarmentVertices(new float[0]), 144, "vertices");
            Invalid(() => session.Verify((Precision)3), "component");
            Check.Throws<ArgumentOutOfRangeException>(() => session.ReadEnergy(-1));
        }
    }

    private static void FoundByTheBinding(Inputs inputs, Session session)
    {
        float[] positions = inputs.GarmentPositions;
        int[] triangles = inputs.GarmentTriangles;
        Invalid(() => session.SetGarment(new float[4], triangles), "positions", "4", "3");
        Invalid(() => session.SetGarment(positions, new int[7]), "triangles", "7");
        Invalid(() => session.SetSourceSkeleton(new float[6], new int[3]), "bones", "3");
        Invalid(() => session.SetVertexFitWeights(FloatView.F32(positions, 4)), "byte 4");
        Invalid(() => session.SetGarment(FloatView.F32(new long[6]), triangles), "8 bytes");
        Invalid(() => session.SetVertexFitWeights(FloatView.F32(positions, -4)), "byte -4");
        Check.Refused(Status.InvalidMesh, () => session.SetGarment(positions, new[] { 0, 1, 2, 3, -7, 5 }),
            "garment: triangle 1 has index -7");
        Check.Refused(Status.InvalidMesh, () => session.SetSourceAvatar(positions, new[] { -1, 1, 2 }),
            "source avatar: triangle 0 has index -1");
        Check.Refused(Status.InvalidSkeleton, () => session.SetTargetSkeleton(inputs.TargetJoints, new[] { 0, -1 }),
            "target skeleton: bone 0 has index -1");
        Invalid(() => session.SetNoFitVertices(new[] { 3, -2 }), "element 1", "-2");
        Check.Throws<ArgumentOutOfRangeException>(() => session.SetTargetSkinWeights(positions, 0));
        Check.Throws<ArgumentOutOfRangeException>(() => session.SetTargetSkinInfluences(triangles, positions, 0, 1));
        Check.Throws<ArgumentNullException>(() => session.SetOptions(null));
        Check.Throws<ArgumentNullException>(() => session.SetSourceCoordinateSystem(null));
        Check.Throws<ArgumentException>(() => FloatView.F32(new[] { "text" }.Select(t => new Named(t)).ToArray()));
    }

    private static void FoundByTheLibrary(Inputs inputs, Session session)
    {
        float[] positions = inputs.GarmentPositions;
        int[] triangles = inputs.GarmentTriangles;
        Check.Refused(Status.InvalidMesh, () => session.SetGarment((float[])null, triangles), "garment");
        Check.Refused(Status.InvalidMesh, () => session.SetGarment(default(FloatView), default(IndexView)), "garment");
        Check.Refused(Status.InvalidMesh, () => session.SetGarment(positions, new[] { 0, 1, 90000 }), "90000");
        float[] bad = { 0f, float.NaN, 0f };
        Check.Refused(Status.InvalidMesh, () => session.SetTargetAvatar(bad, triangles), "target avatar");
        Invalid(() => session.SetOptions(new Options { Dhat = -1 }), "dhat");
        Invalid(() => session.SetOptions(new Options { SurfaceForm = (SurfaceForm)9 }), "9");
        Check.That(session.LastMessage.Contains("9"), session.LastMessage);
    }

    private static void Invalid(Action work, params string[] words)
    {
        Check.Refused(Status.InvalidArgument, work, words);
    }

    // A struct with a reference, which is no memory of numbers.
    private struct Named
    {
        public readonly string Name;

        public Named(string name)
        {
            Name = name;
        }
    }

    public static void States()
    {
        Inputs inputs = Inputs.Tube();
        using (Session session = new Session())
        {
            Check.Same(session.LastMessage, "", "sentence");
            Check.Refused(Status.InvalidState, () => session.Run(), "garment");
            Check.Refused(Status.InvalidState, () => session.Step(), "prepare");
            Check.Refused(Status.InvalidState, () => session.ReadGarmentVertices(), "prepare");
            Check.Refused(Status.InvalidState, () => session.Verify());
            inputs.SetOn(session);
            session.SetTargetSkeleton(inputs.TargetJoints.Take(6).ToArray(), new[] { 0, 1 });
            Check.Refused(Status.InvalidSkeleton, () => session.Prepare(), "skeleton");
            session.SetTargetSkeleton(inputs.TargetJoints, inputs.Bones);
            session.Prepare();
            Check.Refused(Status.InvalidState, () => inputs.SetOn(session));
            session.Run();
            Check.Refused(Status.InvalidState, () => session.Step(), "reset");
            session.Reset();
            Check.Same(session.Stage, Stage.Setup, "stage");
            session.SetOptions(new Options { MemoryLimit = 1000 });
            Check.Refused(Status.MemoryLimit, () => session.Run());
        }
    }

    // One thread is inside: another gets Busy at once, and does no harm.
    public static void Busy()
    {
        using (Session session = Inputs.Tube().Session())
        using (ManualResetEventSlim inside = new ManualResetEventSlim())
        {
            int refusals = 0;
            // Calls follow each other without a pause, so that some meet.
            Task other = Task.Run(() =>
            {
                while (!inside.IsSet)
                {
                    try
                    {
                        session.ReadReport();
                    }
                    catch (BespokeException refusal) when (refusal.Status == Status.Busy)
                    {
                        Check.That(refusal.Message.Contains("thread"), refusal.Message);
                        refusals++;
                    }
                }
            });
            for (int k = 0; k < 100 && Volatile.Read(ref refusals) == 0; k++)
            {
                Again(() => session.Reset());
                Again(() => session.Run());
                Check.Same(session.Stage, Stage.Done, "stage");
            }
            inside.Set();
            other.GetAwaiter().GetResult();
            Check.That(refusals > 0, "no call has met another");
        }
    }

    // The report of the other thread may be what is inside.
    private static void Again(Action work)
    {
        while (true)
        {
            try
            {
                work();
                return;
            }
            catch (BespokeException refusal) when (refusal.Status == Status.Busy)
            {
                Thread.Yield();
            }
        }
    }
}
