// Wavefront OBJ files: as much of them as a garment, a body or a skeleton needs.
using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Text;

// A mesh or a skeleton, and the lines that it was read from.
internal sealed class Obj
{
    private readonly string[] lines;

    private Obj(string[] lines, float[] positions, int[] triangles, int[] bones)
    {
        this.lines = lines;
        Positions = positions;
        Triangles = triangles;
        Bones = bones;
    }

    // x, y, z of each vertex.
    public float[] Positions { get; }

    // Three vertices each; polygons are fans.
    public int[] Triangles { get; }

    // Two vertices each: the segments of the lines.
    public int[] Bones { get; }

    public static Obj Read(string path)
    {
        string[] lines = File.ReadAllLines(path);
        List<float> positions = new List<float>();
        List<int> triangles = new List<int>();
        List<int> bones = new List<int>();
        for (int k = 0; k < lines.Length; k++)
        {
            string[] words = lines[k].Split(new[] { ' ', '\t' }, StringSplitOptions.RemoveEmptyEntries);
            try
            {
                switch (words.Length == 0 ? "" : words[0])
                {
                    case "v":
                        for (int axis = 1; axis <= 3; axis++)
                        {
                            positions.Add(float.Parse(words[axis], NumberStyles.Float, CultureInfo.InvariantCulture));
                        }
                        break;
                    case "f":
                        for (int corner = 3; corner < words.Length; corner++)
                        {
                            triangles.Add(Vertex(words[1], positions.Count / 3));
                            triangles.Add(Vertex(words[corner - 1], positions.Count / 3));
                            triangles.Add(Vertex(words[corner], positions.Count / 3));
                        }
                        break;
                    case "l":
                        for (int end = 2; end < words.Length; end++)
                        {
                            bones.Add(Vertex(words[end - 1], positions.Count / 3));
                            bones.Add(Vertex(words[end], positions.Count / 3));
                        }
                        break;
                }
            }
            catch (Exception reason) when (
                reason is FormatException || reason is OverflowException || reason is IndexOutOfRangeException)
            {
                throw new InvalidDataException($"{path}: line {k + 1} is not understood: {lines[k]}");
            }
        }
        return new Obj(lines, positions.ToArray(), triangles.ToArray(), bones.ToArray());
    }

    // The same file with other positions: faces, texture and materials stay.
    public void Write(string path, float[] positions)
    {
        StringBuilder text = new StringBuilder();
        int at = 0;
        foreach (string line in lines)
        {
            if (line.StartsWith("v ", StringComparison.Ordinal) || line.StartsWith("v\t", StringComparison.Ordinal))
            {
                text.Append('v');
                for (int axis = 0; axis < 3; axis++)
                {
                    // Nine digits tell one float from every other.
                    text.Append(' ').Append(positions[at++].ToString("G9", CultureInfo.InvariantCulture));
                }
                text.Append('\n');
            }
            else
            {
                text.Append(line).Append('\n');
            }
        }
        File.WriteAllText(path, text.ToString());
    }

    // A corner such as 7, 7/1 or -1, which counts from the last vertex so far.
    private static int Vertex(string word, int count)
    {
        int number = int.Parse(word.Split('/')[0], NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture);
        return number < 0 ? count + number : number - 1;
    }
}
