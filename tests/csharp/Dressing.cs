// What goes in, in every shape, and what comes out.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.InteropServices;
using Bespoke;

internal static class Dressing
{
    // The jacket on the heavy body, all optional inputs of `make demo` set: the same bits as in Rust.
    public static void SampleIsDressed(string folder)
    {
        Inputs inputs = Inputs.Sample(folder);
        using (Session session = inputs.Session())
        {
            session.SetSourceAvatar(Inputs.Floats(folder, "source.positions"), Inputs.Ints(folder, "source.triangles"));
            int vertices = inputs.AvatarPositions.Length / 3;
            session.SetTargetSkinWeights(Inputs.Floats(folder, "skin"), vertices);
            session.SetNoFitVertices(Inputs.Ints(folder, "no_fit"));
            session.RunAsync().GetAwaiter().GetResult();
            Check.Same(session.Stage, Stage.Done, "stage");
            Check.SameBits(session.ReadGarmentVertices(), Inputs.Floats(folder, "dressed"), "the jacket");
            Intersections found = session.Verify();
            Check.Same(found.GarmentGarment + found.GarmentAvatar, 0L, "intersections");
            Report report = session.ReadReport();
            Check.That(report.IsVerified && report.T == 1.0, "the report says that it is verified");
            Check.Same(report.AvatarVertices, (long)vertices, "vertices of the avatar");
            Check.SameBits(session.ReadAvatarVertices(), inputs.AvatarPositions, "the avatar at its full size");
            uint[] covered = session.ReadCoveredTriangles();
            Check.That(covered.Length > 0 && covered.Length < inputs.AvatarTriangles.Length / 3, "a part of it is covered");
            Check.That(session.ReadCoveredTriangles(margin: 0).Length > covered.Length, "more is without a margin");
            Check.Refused(Status.InvalidArgument, () => session.ReadCoveredTriangles(0), "layer 0");
            Check.Refused(Status.InvalidArgument, () => session.ReadCoveredTriangles(openness: 2.0), "openness");
        }
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Vector
    {
        public float X, Y, Z;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Vertex
    {
        public Vector Normal;
        public Vector Position;
        public float U, V;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Vector64
    {
        public double X, Y, Z;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Vertex64
    {
        public long Id;
        public Vector64 Position;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Corners
    {
        public int A, B, C;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct Face
    {
        public byte Material;
        public ushort A, B, C;
    }

    [StructLayout(LayoutKind.Sequential)]
    private struct BoneWeight
    {
        public float Weight, OtherWeight;
        public int Joint, OtherJoint;
    }

    // Packed numbers, an engine's vectors, interleaved vertices; int, uint, ushort; arrays and spans: the same bits.
    public static void ArraysOfEveryShape()
    {
        Inputs inputs = Inputs.Tube();
        int vertices = inputs.GarmentPositions.Length / 3;
        int faces = inputs.GarmentTriangles.Length / 3;
        float[] expected = Dressed(inputs, session => { });

        Vector[] vectors = new Vector[vertices];
        inputs.GarmentPositions.CopyTo(MemoryMarshal.Cast<Vector, float>(vectors));
        Vertex[] mixed = vectors.Select(p => new Vertex { Position = p, U = 0.5f }).ToArray();
        Corners[] corners = new Corners[faces];
        inputs.GarmentTriangles.CopyTo(MemoryMarshal.Cast<Corners, int>(corners));
        Face[] material = corners.Select(c => new Face { A = (ushort)c.A, B = (ushort)c.B, C = (ushort)c.C }).ToArray();
        uint[] unsigned = inputs.GarmentTriangles.Select(index => (uint)index).ToArray();
        ushort[] small = inputs.GarmentTriangles.Select(index => (ushort)index).ToArray();
        // A few numbers before and after, which do not belong to it.
        float[] within = new float[] { 9f }.Concat(inputs.GarmentPositions).Concat(new[] { 9f, 9f }).ToArray();

        Action<Session>[] ways =
        {
            session => session.SetGarment(FloatView.F32(vectors), IndexView.I32(corners)),
            session => session.SetGarment(FloatView.F32(mixed, 12), unsigned),
            session => session.SetGarment(FloatView.F32(new ReadOnlySpan<Vertex>(mixed), 12), small),
            session => session.SetGarment(within.AsSpan(1, 3 * vertices), IndexView.U16(material, 2)),
            session => session.SetGarment(
                (ReadOnlySpan<float>)within.AsSpan(1, 3 * vertices), IndexView.U32(new ReadOnlySpan<Corners>(corners))),
            session => session.SetGarment(MemoryMarshal.Cast<Vector, float>(vectors), unsigned.AsSpan()),
        };
        for (int k = 0; k < ways.Length; k++)
        {
            Check.SameBits(Dressed(inputs, ways[k]), expected, $"way {k}");
        }

        using (Session session = inputs.Session())
        {
            session.Run();
            session.ReadGarmentVertices(FloatBuffer.F32(vectors));
            Check.SameBits(MemoryMarshal.Cast<Vector, float>(vectors).ToArray(), expected, "vectors");
            Check.Same(session.ReadGarmentVertices(FloatBuffer.F32(mixed, 12)), vertices, "vertices");
            float[] interleaved = mixed.SelectMany(v => new[] { v.Position.X, v.Position.Y, v.Position.Z }).ToArray();
            Check.SameBits(interleaved, expected, "interleaved vertices");
            Check.That(mixed.All(v => v.U == 0.5f && v.Normal.X == 0f), "what lies between stays");
            session.ReadGarmentVertices(within.AsSpan(1, 3 * vertices));
            Check.SameBits(within.Skip(1).Take(3 * vertices).ToArray(), expected, "a span");
            Check.That(within[0] == 9f && within[3 * vertices + 1] == 9f, "what lies around stays");
        }
        DoublePrecision(inputs, vertices);
    }

    private static float[] Dressed(Inputs inputs, Action<Session> replace)
    {
        using (Session session = inputs.Session())
        {
            replace(session);
            session.Run();
            return session.ReadGarmentVertices();
        }
    }

    // So far from the origin that single precision cannot tell garment and body apart.
    private static void DoublePrecision(Inputs inputs, int vertices)
    {
        Func<float[], double[]> far = points => points.Select(x => x + 1e6).ToArray();
        using (Session session = new Session())
        {
            session.SetGarment(far(inputs.GarmentPositions), inputs.GarmentTriangles);
            session.SetTargetAvatar(far(inputs.AvatarPositions), inputs.AvatarTriangles);
            session.SetSourceSkeleton(far(inputs.SourceJoints), inputs.Bones);
            Vector64[] joints = MemoryMarshal.Cast<double, Vector64>(far(inputs.TargetJoints)).ToArray();
            session.SetTargetSkeleton(FloatView.F64(joints), inputs.Bones);
            session.Run();
            Check.Same(session.GarmentVertexCount, vertices, "vertices");
            double[] found = new double[3 * vertices];
            session.ReadGarmentVertices(found);
            Check.That(found.All(x => Math.Abs(x - 1e6) < 2.0), "the garment is where the body is");
            Vertex64[] mixed = new Vertex64[vertices];
            session.ReadGarmentVertices(FloatBuffer.F64(mixed, 8));
            double[] y = found.Where((x, k) => k % 3 == 1).ToArray();
            Check.That(mixed.Select(v => v.Position.Y).SequenceEqual(y), "interleaved vertices");
            Intersections count = session.Verify(Precision.F64);
            Check.Same(count.GarmentGarment + count.GarmentAvatar, 0L, "intersections");
            Check.Refused(Status.NotVerified, () => session.ReadGarmentVertices(), "64 bits");
        }
    }

    // Every setter reaches the library, and does what it says.
    public static void EveryInput()
    {
        Inputs inputs = Inputs.Tube();
        float[] plain = Dressed(inputs, session => { });
        int vertices = plain.Length / 3;
        Func<Action<Session>, bool> differs = set => !Dressed(inputs, set).SequenceEqual(plain);

        Check.That(differs(s => s.SetOptions(new Options { FitWeight = Options.WeightOff })), "options");
        Check.That(!differs(s => s.SetOptions(Options.ReadDefaults())), "the defaults, written out");
        float[] weights = Enumerable.Range(0, vertices).Select(v => v % 2f).ToArray();
        Check.That(differs(s => s.SetVertexFitWeights(weights)), "weights");
        Check.That(differs(s => s.SetNoFitVertices(Enumerable.Range(0, 48).ToArray())), "no-fit vertices");
        Check.That(differs(s => s.SetPinnedVertices(new[] { 70 })), "pins");
        Check.That(differs(s => s.AddRigidGroup(new ushort[] { 40, 41, 56 })), "rigid group");
        Check.That(differs(s => s.AddCurve(new[] { 40, 41, 42 }, false)), "curve");
        Check.That(differs(s => s.AddLayer(plain, inputs.GarmentTriangles)), "layer");
        Check.That(differs(s => s.SetSourceAvatar(inputs.AvatarPositions, inputs.AvatarTriangles)), "source avatar");
        Check.That(!differs(s =>
        {
            s.AddLayer(plain, inputs.GarmentTriangles);
            s.ClearLayers();
            s.AddRigidGroup(new[] { 40, 41, 56 });
            s.ClearRigidGroups();
            s.AddCurve(new[] { 40, 41, 42 }, false);
            s.ClearCurves();
        }), "layers, groups and curves are forgotten");

        float[] pinned = Dressed(
            inputs, s => s.SetPinnedVertices(new[] { 0 }, new[] { 0.4f, -0.4f, 0.1f }));
        double distance = Math.Sqrt(
            Math.Pow(pinned[0] - 0.4, 2) + Math.Pow(pinned[1] + 0.4, 2) + Math.Pow(pinned[2] - 0.1, 2));
        Check.That(distance < 0.005, $"the pin is {distance} from its place");
        Skins(inputs);
    }

    // The same skin as a matrix, and as one joint with all the weight and one with none, which may be anything. It says
    // where the shrunk avatar is.
    private static void Skins(Inputs inputs)
    {
        int body = inputs.AvatarPositions.Length / 3;
        float[] matrix = new float[3 * body];
        int[] joints = new int[2 * body];
        float[] shares = new float[2 * body];
        // As engines keep them: weights and joints of a vertex in one struct.
        BoneWeight[] mixed = new BoneWeight[body];
        for (int v = 0; v < body; v++)
        {
            int joint = v < 4 * body / 5 ? 0 : 2;
            matrix[joint * body + v] = 1f;
            joints[2 * v] = joint;
            joints[2 * v + 1] = -1;
            shares[2 * v] = 1f;
            mixed[v] = new BoneWeight { Weight = 1f, Joint = joint, OtherJoint = -1 };
        }
        float[] byMatrix = Shrunk(inputs, s => s.SetTargetSkinWeights(matrix, body));
        Check.That(!byMatrix.SequenceEqual(Shrunk(inputs, s => { })), "the skin is looked at");
        float[] byInfluences = Shrunk(inputs, s => s.SetTargetSkinInfluences(joints, shares, 2, 3));
        Check.SameBits(byInfluences, byMatrix, "the skin");
        float[] byStructs = Shrunk(
            inputs, s => s.SetTargetSkinInfluences(IndexView.I32(mixed, 8), FloatView.F32(mixed), 2, 3));
        Check.SameBits(byStructs, byMatrix, "the skin, in structs");
        using (Session session = inputs.Session())
        {
            shares[11] = 0.5f;
            Check.Refused(
                Status.InvalidWeights, () => session.SetTargetSkinInfluences(joints, shares, 2, 3), "vertex 5", "-1");
        }
    }

    private static float[] Shrunk(Inputs inputs, Action<Session> set)
    {
        using (Session session = inputs.Session())
        {
            set(session);
            session.Prepare();
            return session.ReadAvatarVertices();
        }
    }

    // Every result can be read, of a session that is done.
    public static void EveryResult()
    {
        Inputs inputs = Inputs.Tube();
        using (Session session = inputs.Session())
        {
            // A duplicate triangle and a pin within the body are reported as diagnostics.
            int[] triangles = inputs.GarmentTriangles.Concat(inputs.GarmentTriangles.Take(3)).ToArray();
            session.SetGarment(inputs.GarmentPositions, triangles);
            session.SetPinnedVertices(new[] { 70 }, new[] { 0f, 0.05f, 0f });
            session.AddGarmentMorph("lost", inputs.GarmentPositions);
            session.ClearGarmentMorphs();
            session.AddGarmentMorph("as large", inputs.GarmentPositions);
            session.AddTargetMorph("lost", inputs.AvatarPositions);
            session.ClearTargetMorphs();
            session.AddTargetMorph(null, inputs.AvatarPositions.Select(x => 0.05f * x).ToArray());
            session.AddFollower(inputs.GarmentPositions, triangles);
            session.ClearFollowers();
            session.AddFollower(inputs.GarmentPositions, triangles);
            session.Run();

            int count = session.GarmentTriangleCount;
            Check.Same(count, triangles.Length / 3, "triangles");
            double[] distortion = session.ReadDistortion();
            Check.Same(distortion.Length, count, "numbers");
            Check.That(distortion.All(d => d >= 0) && distortion.Any(d => d > 0), "distortion");
            float[] single = new float[count];
            session.ReadDistortion(single);
            Check.That(single.Zip(distortion, (a, b) => a == (float)b).All(same => same), "distortion, in floats");

            Check.Refused(Status.InvalidArgument, () => session.ReadGarmentMorph(1), "garment morph 1");
            Check.Refused(Status.InvalidArgument, () => session.ReadFollowerVertices(7), "follower 7");
            float[] followed = session.ReadFollowerVertices(0);
            float[] vertices = session.ReadGarmentVertices();
            Check.That(followed.Zip(vertices, (a, b) => Math.Abs(a - b) < 1e-5f).All(same => same), "a follower");
            Check.That(session.ReadGarmentMorph(0).Any(x => Math.Abs(x) > 0.1f), "a morph");
            Check.Refused(Status.InvalidState, () => session.ReadTargetMorph(0), "solve_target_morphs");
            session.SolveTargetMorphs();
            Check.Same(session.ReadTargetMorph(0).Length, vertices.Length, "numbers of a morph");
            Check.Refused(Status.InvalidArgument, () => session.SetTargetMorphWeight(9, 1), "target morph 9");
            session.SetTargetMorphWeight(0, 0);
            Check.Refused(
                Status.InvalidState, () => session.ReadFollowerSkinInfluences(0, 4, out _, out _), "skin weights");
            float[] normals = session.ReadGarmentNormals(null);
            Check.Same(normals.Length, 3 * session.GarmentVertexCount, "numbers of normals");
            float[] tangents = Enumerable.Range(0, 4 * session.GarmentVertexCount).Select(k => k % 4 == 1 ? 1f : 0f).ToArray();
            float[] alongs = new float[tangents.Length];
            session.ReadGarmentNormals(triangles, normals, tangents, normals, alongs);
            Check.That(alongs.Any(x => x != 0) && !alongs.Any(float.IsNaN), "tangents");
            Check.Refused(
                Status.InvalidArgument,
                () => session.ReadGarmentNormals(new[] { 0, 1, 2 }, normals, default(FloatView), normals, default(FloatBuffer)),
                "triangles");

            Report report = session.ReadReport();
            Check.Same(report.GarmentVertices, (long)session.GarmentVertexCount, "vertices of the garment");
            Check.Same(report.GarmentTriangles, count - 1L, "triangles of the garment, the duplicate counted once");
            Check.Same(report.AvatarVertices, (long)session.AvatarVertexCount, "vertices of the avatar");
            Check.Same(report.AvatarTriangles, inputs.AvatarTriangles.Length / 3L, "triangles of the avatar");
            Check.That(report.IsVerified && report.IsConverged, "the result is good");
            Check.That(report.Threads > 0 && report.MemoryBytes > 0, "what it took");
            Check.That(report.Inflate.Iterations > 0 && report.Fit.Iterations > 0, "iterations");
            Check.That(report.Fit.Factorisations >= report.Fit.Iterations, "factorisations");
            Check.That(report.Prepare.Seconds > 0 && report.Fit.Seconds > 0 && report.VerifySeconds > 0, "seconds");

            Energy[] terms = Enumerable.Range(0, report.EnergyCount).Select(session.ReadEnergy).ToArray();
            Check.That(terms.Any(term => term.Name == "surface" && term.Weight == 1.0 && term.Value > 0), "terms");
            Check.Refused(Status.InvalidArgument, () => session.ReadEnergy(report.EnergyCount), "energy");
            SessionProgress progress = session.ReadProgress();
            Check.Same(progress.Energies.Count, terms.Length, "terms of the progress");
            Check.That(Math.Abs(progress.Energies.Sum() - progress.Energy) <= 1e-9 * progress.Energy, "their sum");
            Check.That(progress.Stage == Stage.Done && progress.T == 1.0 && progress.FitSeconds > 0, "progress");

            Diagnostic[] diagnostics = session.ReadDiagnostics();
            Diagnostic twice = diagnostics.Single(d => d.Kind == DiagnosticKind.DuplicateTriangle);
            Check.Same(
                string.Join(" ", twice.Elements.Select(e => $"{e.Subject} {e.Kind} {e.Index}").OrderBy(e => e)),
                $"Garment Triangle 0 Garment Triangle {count - 1}", "elements of the duplicate");
            Check.That(double.IsNaN(twice.Distance) && twice.Elements.All(e => e.Layer == null), "the duplicate");
            Diagnostic pin = diagnostics.Single(d => d.Kind == DiagnosticKind.PinNotReached);
            Check.That(pin.Severity == Severity.Warning && pin.Elements[0].Index == 70, pin.Message);
            Check.That(pin.Distance > 0.1 && pin.Message.Contains("70") && !pin.Message.Contains("\0"), pin.Message);
        }
        LayersAreNumbered();
    }

    // The message says which layer.
    private static void LayersAreNumbered()
    {
        Inputs inputs = Inputs.Tube();
        using (Session session = inputs.Session())
        {
            session.AddLayer(inputs.AvatarPositions, inputs.AvatarTriangles);
            Check.Refused(
                Status.InvalidMesh, () => session.AddLayer(new float[3], new[] { 0, 0, 1 }), "layer 1", "triangle 0");
        }
    }

    // Unity's coordinate system on both sides is a mirror image: the same garment, mirrored.
    public static void CoordinateSystems()
    {
        Inputs inputs = Inputs.Tube();
        float[] expected = Dressed(inputs, session => { });
        Func<float[], float[]> mirrored = points => points.Select((x, k) => k % 3 == 2 ? -x : x).ToArray();
        using (Session session = new Session())
        {
            session.SetSourceCoordinateSystem(CoordinateSystem.Unity);
            session.SetTargetCoordinateSystem(CoordinateSystem.Unity);
            session.SetGarment(mirrored(inputs.GarmentPositions), inputs.GarmentTriangles);
            session.SetTargetAvatar(mirrored(inputs.AvatarPositions), inputs.AvatarTriangles);
            session.SetSourceSkeleton(mirrored(inputs.SourceJoints), inputs.Bones);
            session.SetTargetSkeleton(mirrored(inputs.TargetJoints), inputs.Bones);
            session.Run();
            float[] found = mirrored(session.ReadGarmentVertices());
            double farthest = found.Zip(expected, (a, b) => Math.Abs(a - b)).Max();
            Check.That(farthest < 1e-5, $"a vertex is {farthest} away");
            session.Reset();
            CoordinateSystem bad = CoordinateSystem.Unity;
            bad.Up = Axis.NegativeX;
            Check.Refused(Status.InvalidArgument, () => session.SetTargetCoordinateSystem(bad), "target coordinate system");
        }
    }
}
