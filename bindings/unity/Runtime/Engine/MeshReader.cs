// Meshes of the engine as plain arrays, and back.
using System;
using System.Collections.Generic;
using Unity.Collections;
using UnityEngine;

namespace Bespoke.Unity
{
    /// <summary>Between a Mesh and plain arrays. For the main thread.</summary>
    public static class MeshReader
    {
        /// <summary>Reads a mesh; joints and place are left to the caller.</summary>
        /// <param name="mesh">The mesh.</param>
        /// <returns>Its arrays.</returns>
        /// <exception cref="ArgumentException">It cannot be read, or is not made of triangles.</exception>
        public static SkinnedPart Read(Mesh mesh)
        {
            if (!mesh.isReadable)
            {
                throw new ArgumentException(
                    $"the mesh {mesh.name} cannot be read; switch on Read/Write in the import settings of its model");
            }
            SkinnedPart part = new SkinnedPart
            {
                Name = mesh.name,
                Positions = Flat(mesh.vertices),
                Triangles = Triangles(mesh),
                Normals = OrNull(Flat(mesh.normals)),
                Tangents = OrNull(Flat(mesh.tangents)),
                BonesPerVertex = mesh.GetBonesPerVertex().ToArray(),
                BindPoses = Array.ConvertAll(mesh.bindposes, FigureReader.Numbers),
            };
            BoneWeight1[] weights = mesh.GetAllBoneWeights().ToArray();
            part.BoneIndices = Array.ConvertAll(weights, weight => weight.boneIndex);
            part.BoneWeights = Array.ConvertAll(weights, weight => weight.weight);
            ReadFrames(mesh, part);
            return part;
        }

        /// <summary>
        /// A copy of a mesh with what a run has given: materials' submeshes, UVs and colours stay.
        /// </summary>
        /// <param name="design">The mesh of the garment, or of what goes along with it.</param>
        /// <param name="outcome">What became of it; dressed.</param>
        /// <param name="bind">For each joint of its skin, the bind transform.</param>
        /// <param name="used">The joints that are bones of the new mesh, in their order.</param>
        /// <returns>The new mesh.</returns>
        public static Mesh Write(Mesh design, Worn outcome, Func<int, double[]> bind, out int[] used)
        {
            Mesh mesh = UnityEngine.Object.Instantiate(design);
            mesh.ClearBlendShapes();
            mesh.vertices = Vectors(outcome.Positions);
            if (outcome.Normals != null)
            {
                mesh.normals = Vectors(outcome.Normals);
            }
            if (outcome.Tangents != null)
            {
                mesh.tangents = Vectors4(outcome.Tangents);
            }
            used = new int[0];
            if (outcome.Skin != null)
            {
                byte[] counts;
                int[] bones;
                float[] weights;
                outcome.Skin.ToEngine(out counts, out bones, out weights, out used);
                BoneWeight1[] each = new BoneWeight1[bones.Length];
                for (int k = 0; k < each.Length; k++)
                {
                    each[k] = new BoneWeight1 { boneIndex = bones[k], weight = weights[k] };
                }
                using (NativeArray<byte> perVertex = new NativeArray<byte>(counts, Allocator.Temp))
                using (NativeArray<BoneWeight1> all = new NativeArray<BoneWeight1>(each, Allocator.Temp))
                {
                    mesh.SetBoneWeights(perVertex, all);
                }
                mesh.bindposes = Array.ConvertAll(
                    used, joint => FigureReader.Matrix(Transform4.Inverse(bind(joint)) ?? Transform4.Identity()));
            }
            foreach (ShapeFrame frame in outcome.Frames)
            {
                mesh.AddBlendShapeFrame(
                    frame.Name, frame.Weight, Vectors(frame.Vertices),
                    frame.Normals == null ? null : Vectors(frame.Normals),
                    frame.Tangents == null ? null : Vectors(frame.Tangents));
            }
            mesh.RecalculateBounds();
            return mesh;
        }

        private static int[] Triangles(Mesh mesh)
        {
            List<int> corners = new List<int>();
            for (int k = 0; k < mesh.subMeshCount; k++)
            {
                if (mesh.GetTopology(k) != MeshTopology.Triangles)
                {
                    throw new ArgumentException(
                        $"submesh {k} of {mesh.name} is made of {mesh.GetTopology(k)}; switch off Keep Quads in the " +
                        "import settings of its model, and leave out lines and points");
                }
                corners.AddRange(mesh.GetIndices(k));
            }
            return corners.ToArray();
        }

        private static void ReadFrames(Mesh mesh, SkinnedPart part)
        {
            for (int shape = 0; shape < mesh.blendShapeCount; shape++)
            {
                for (int frame = 0; frame < mesh.GetBlendShapeFrameCount(shape); frame++)
                {
                    Vector3[] vertices = new Vector3[mesh.vertexCount];
                    Vector3[] normals = new Vector3[mesh.vertexCount];
                    Vector3[] tangents = new Vector3[mesh.vertexCount];
                    mesh.GetBlendShapeFrameVertices(shape, frame, vertices, normals, tangents);
                    part.Frames.Add(new ShapeFrame
                    {
                        Name = mesh.GetBlendShapeName(shape),
                        Weight = mesh.GetBlendShapeFrameWeight(shape, frame),
                        Vertices = Flat(vertices),
                        Normals = Flat(normals),
                        Tangents = Flat(tangents),
                    });
                }
            }
        }

        private static float[] OrNull(float[] numbers)
        {
            return numbers.Length == 0 ? null : numbers;
        }

        private static float[] Flat(Vector3[] vectors)
        {
            float[] numbers = new float[3 * vectors.Length];
            for (int k = 0; k < vectors.Length; k++)
            {
                numbers[3 * k] = vectors[k].x;
                numbers[3 * k + 1] = vectors[k].y;
                numbers[3 * k + 2] = vectors[k].z;
            }
            return numbers;
        }

        private static float[] Flat(Vector4[] vectors)
        {
            float[] numbers = new float[4 * vectors.Length];
            for (int k = 0; k < vectors.Length; k++)
            {
                numbers[4 * k] = vectors[k].x;
                numbers[4 * k + 1] = vectors[k].y;
                numbers[4 * k + 2] = vectors[k].z;
                numbers[4 * k + 3] = vectors[k].w;
            }
            return numbers;
        }

        private static Vector3[] Vectors(float[] numbers)
        {
            Vector3[] vectors = new Vector3[numbers.Length / 3];
            for (int k = 0; k < vectors.Length; k++)
            {
                vectors[k] = new Vector3(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]);
            }
            return vectors;
        }

        private static Vector4[] Vectors4(float[] numbers)
        {
            Vector4[] vectors = new Vector4[numbers.Length / 4];
            for (int k = 0; k < vectors.Length; k++)
            {
                vectors[k] = new Vector4(numbers[4 * k], numbers[4 * k + 1], numbers[4 * k + 2], numbers[4 * k + 3]);
            }
            return vectors;
        }
    }
}
