// What the tests dress: a small tube on a slimmer one, and the sample as tests/csharp/main.rs has written it.
using System;
using System.IO;
using Bespoke;

internal sealed class Inputs
{
    public float[] GarmentPositions;
    public int[] GarmentTriangles;
    public float[] AvatarPositions;
    public int[] AvatarTriangles;
    public float[] SourceJoints;
    public float[] TargetJoints;
    public int[] Bones;

    public static Inputs Tube()
    {
        Inputs inputs = new Inputs
        {
            SourceJoints = new[] { 0f, -1f, 0f, 0f, 0f, 0f, 0f, 1f, 0f },
            TargetJoints = new[] { 0f, -1.1f, 0f, 0f, 0f, 0f, 0f, 1.1f, 0f },
            Bones = new[] { 0, 1, 1, 2 },
        };
        MakeTube(0.3f, 0.55f, 16, 9, out inputs.GarmentPositions, out inputs.GarmentTriangles);
        MakeTube(0.2f, 0.9f, 14, 15, out inputs.AvatarPositions, out inputs.AvatarTriangles);
        return inputs;
    }

    public static Inputs Sample(string folder)
    {
        return new Inputs
        {
            GarmentPositions = Floats(folder, "garment.positions"),
            GarmentTriangles = Ints(folder, "garment.triangles"),
            AvatarPositions = Floats(folder, "avatar.positions"),
            AvatarTriangles = Ints(folder, "avatar.triangles"),
            SourceJoints = Floats(folder, "source.joints"),
            TargetJoints = Floats(folder, "target.joints"),
            Bones = Ints(folder, "bones"),
        };
    }

    // Sets all that has to be set.
    public void SetOn(Session session)
    {
        session.SetGarment(GarmentPositions, GarmentTriangles);
        session.SetTargetAvatar(AvatarPositions, AvatarTriangles);
        session.SetSourceSkeleton(SourceJoints, Bones);
        session.SetTargetSkeleton(TargetJoints, Bones);
    }

    public Session Session()
    {
        Session session = new Session();
        SetOn(session);
        return session;
    }

    public static float[] Floats(string folder, string name)
    {
        byte[] bytes = File.ReadAllBytes(Path.Combine(folder, name));
        float[] numbers = new float[bytes.Length / sizeof(float)];
        Buffer.BlockCopy(bytes, 0, numbers, 0, bytes.Length);
        return numbers;
    }

    public static int[] Ints(string folder, string name)
    {
        byte[] bytes = File.ReadAllBytes(Path.Combine(folder, name));
        int[] numbers = new int[bytes.Length / sizeof(int)];
        Buffer.BlockCopy(bytes, 0, numbers, 0, bytes.Length);
        return numbers;
    }

    // An open tube around the y axis.
    private static void MakeTube(
        float radius, float half, int around, int rings, out float[] positions, out int[] triangles)
    {
        positions = new float[3 * rings * around];
        for (int k = 0; k < rings * around; k++)
        {
            double angle = 2.0 * Math.PI * (k % around) / around;
            positions[3 * k] = (float)(radius * Math.Sin(angle));
            positions[3 * k + 1] = half * (2f * (k / around) / (rings - 1) - 1f);
            positions[3 * k + 2] = (float)(radius * Math.Cos(angle));
        }
        triangles = new int[6 * (rings - 1) * around];
        for (int k = 0; k < (rings - 1) * around; k++)
        {
            int ring = k / around * around;
            int a = ring + k % around;
            int b = ring + (k + 1) % around;
            new[] { a, b, b + around, a, b + around, a + around }.CopyTo(triangles, 6 * k);
        }
    }
}
