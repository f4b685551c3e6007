// Characters of testing::engine, as an engine would hand them over.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Bespoke.Unity;

internal static class Characters
{
    public static float[] Floats(string folder, string name)
    {
        return Numbers(folder, name, 4, BitConverter.ToSingle);
    }

    public static int[] Ints(string folder, string name)
    {
        return Numbers(folder, name, 4, BitConverter.ToInt32);
    }

    // The joints, each where its bind transform says.
    public static List<FigureJoint> Joints(string folder, string name)
    {
        double[][] binds = Binds(folder, name);
        string[] lines = File.ReadAllLines(Path.Combine(folder, name + ".names"));
        return lines.Select((line, k) =>
        {
            string[] words = line.Split('\t');
            return new FigureJoint { Name = words[1], Parent = int.Parse(words[0]), ToWorld = binds[k] };
        }).ToList();
    }

    public static double[][] Binds(string folder, string name)
    {
        double[] numbers = Numbers(folder, name + ".binds", 8, BitConverter.ToDouble);
        return Enumerable.Range(0, numbers.Length / 16).Select(k => numbers.Skip(16 * k).Take(16).ToArray()).ToArray();
    }

    public static SkinnedPart Part(string folder, string name)
    {
        double[][] binds = Binds(folder, name);
        float[] positions = Floats(folder, name + ".positions");
        return new SkinnedPart
        {
            Name = name,
            Positions = positions,
            Triangles = Ints(folder, name + ".triangles"),
            BonesPerVertex = Enumerable.Repeat((byte)4, positions.Length / 3).ToArray(),
            BoneIndices = Ints(folder, name + ".joints"),
            BoneWeights = Floats(folder, name + ".weights"),
            Joints = Enumerable.Range(0, binds.Length).ToArray(),
            BindPoses = binds.Select(Transform4.Inverse).ToArray(),
        };
    }

    public static FittingTask Task(string folder)
    {
        SkinnedPart vest = Part(folder, "garment");
        vest.Frames.Add(new ShapeFrame { Name = "wide", Weight = 100, Vertices = Floats(folder, "morph") });
        FittingTask task = new FittingTask
        {
            Target = new Figure(Joints(folder, "target"), Part(folder, "target")),
        };
        task.Garments.Add(new Figure(Joints(folder, "source"), vest, Part(folder, "source")));
        return task;
    }

    private static T[] Numbers<T>(string folder, string name, int size, Func<byte[], int, T> read)
    {
        byte[] bytes = File.ReadAllBytes(Path.Combine(folder, name));
        T[] numbers = new T[bytes.Length / size];
        for (int k = 0; k < numbers.Length; k++)
        {
            numbers[k] = read(bytes, size * k);
        }
        return numbers;
    }
}
