// Skin weights: as many bones a vertex as it likes, and the same number for all.
using System;

namespace Bespoke.Unity
{
    /// <summary>Skin weights with the same number of joints for each vertex, as the library takes and gives them.</summary>
    public sealed class Influences
    {
        /// <summary>Such weights.</summary>
        /// <param name="width">Joints of a vertex.</param>
        /// <param name="joints">For each vertex, as many joints.</param>
        /// <param name="weights">For each vertex, as many weights.</param>
        public Influences(int width, int[] joints, float[] weights)
        {
            Width = width;
            Joints = joints;
            Weights = weights;
        }

        /// <summary>Joints of a vertex.</summary>
        public int Width { get; }

        /// <summary>For each vertex, as many joints, from 0.</summary>
        public int[] Joints { get; }

        /// <summary>For each vertex, as many weights.</summary>
        public float[] Weights { get; }

        /// <summary>Those of a part on the joints of its figure. Bones that are no joint of it count as weight 0.</summary>
        /// <param name="part">The part.</param>
        /// <returns>The weights; null where it has none.</returns>
        public static Influences Of(SkinnedPart part)
        {
            if (!part.HasSkin)
            {
                return null;
            }
            int width = 1;
            foreach (byte count in part.BonesPerVertex)
            {
                width = Math.Max(width, count);
            }
            int[] joints = new int[checked(width * part.VertexCount)];
            float[] weights = new float[joints.Length];
            int next = 0;
            for (int vertex = 0; vertex < part.VertexCount; vertex++)
            {
                for (int k = 0; k < part.BonesPerVertex[vertex]; k++, next++)
                {
                    int bone = part.BoneIndices[next];
                    int joint = bone >= 0 && bone < part.Joints.Length ? part.Joints[bone] : -1;
                    if (joint >= 0)
                    {
                        joints[vertex * width + k] = joint;
                        weights[vertex * width + k] = part.BoneWeights[next];
                    }
                }
            }
            return new Influences(width, joints, weights);
        }

        /// <summary>Those of several parts one after the other, as wide as the widest.</summary>
        /// <param name="parts">The parts.</param>
        /// <returns>The weights; null where no part has any. Vertices of parts without have weights 0.</returns>
        public static Influences Joined(SkinnedPart[] parts)
        {
            Influences[] each = Array.ConvertAll(parts, Of);
            int width = 0;
            int vertices = 0;
            for (int k = 0; k < parts.Length; k++)
            {
                width = Math.Max(width, each[k] == null ? 0 : each[k].Width);
                vertices += parts[k].VertexCount;
            }
            if (width == 0)
            {
                return null;
            }
            Influences all = new Influences(width, new int[checked(width * vertices)], new float[width * vertices]);
            int first = 0;
            for (int k = 0; k < parts.Length; k++)
            {
                for (int vertex = 0; each[k] != null && vertex < parts[k].VertexCount; vertex++)
                {
                    int from = vertex * each[k].Width;
                    int to = (first + vertex) * width;
                    Array.Copy(each[k].Joints, from, all.Joints, to, each[k].Width);
                    Array.Copy(each[k].Weights, from, all.Weights, to, each[k].Width);
                }
                first += parts[k].VertexCount;
            }
            return all;
        }

        /// <summary>
        /// As a mesh of the engine has them: for each vertex at least one bone, weights above 0 with the largest first, and
        /// only those joints as bones that some vertex needs.
        /// </summary>
        /// <param name="bonesPerVertex">How many bones each vertex has.</param>
        /// <param name="bones">Numbers in <paramref name="used"/>.</param>
        /// <param name="weights">As many weights, of sum 1 for each vertex.</param>
        /// <param name="used">The joints that are bones of the mesh, ascending.</param>
        public void ToEngine(out byte[] bonesPerVertex, out int[] bones, out float[] weights, out int[] used)
        {
            int vertices = Joints.Length / Width;
            bool[] isUsed = new bool[0];
            int[] counts = new int[vertices];
            int total = 0;
            for (int vertex = 0; vertex < vertices; vertex++)
            {
                for (int k = 0; k < Width; k++)
                {
                    int joint = Joints[vertex * Width + k];
                    // The first is kept in any case: a vertex without a bone is none for the engine.
                    if (k > 0 && !(Weights[vertex * Width + k] > 0))
                    {
                        continue;
                    }
                    if (joint >= isUsed.Length)
                    {
                        Array.Resize(ref isUsed, joint + 1);
                    }
                    isUsed[joint] = true;
                    counts[vertex]++;
                    total++;
                }
            }
            int[] number = new int[isUsed.Length];
            int usedCount = 0;
            for (int joint = 0; joint < isUsed.Length; joint++)
            {
                number[joint] = usedCount;
                usedCount += isUsed[joint] ? 1 : 0;
            }
            used = new int[usedCount];
            for (int joint = 0; joint < isUsed.Length; joint++)
            {
                if (isUsed[joint])
                {
                    used[number[joint]] = joint;
                }
            }
            bonesPerVertex = new byte[vertices];
            bones = new int[total];
            weights = new float[total];
            int next = 0;
            for (int vertex = 0; vertex < vertices; vertex++)
            {
                bonesPerVertex[vertex] = checked((byte)counts[vertex]);
                for (int k = 0; k < Width; k++)
                {
                    float weight = Weights[vertex * Width + k];
                    if (k > 0 && !(weight > 0))
                    {
                        continue;
                    }
                    bones[next] = number[Joints[vertex * Width + k]];
                    weights[next++] = counts[vertex] == 1 ? 1f : weight;
                }
            }
        }
    }
}
