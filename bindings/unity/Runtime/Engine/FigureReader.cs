// Renderers and their bones as a figure.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Bespoke.Unity
{
    /// <summary>Reads the renderers of one character: their meshes in the pose of the bind, and all their bones.</summary>
    public sealed class FigureReader
    {
        private readonly List<Transform> transforms = new List<Transform>();
        private readonly Dictionary<Transform, int> numbers = new Dictionary<Transform, int>();
        private readonly Dictionary<string, int> named = new Dictionary<string, int>();

        /// <summary>Reads them. To be called in the main thread.</summary>
        /// <param name="renderers">The renderers; the first gives the space, and is a body or the garment itself. Bones of others
        /// that hang on a skeleton of their own are taken for those of the same name.</param>
        /// <exception cref="ArgumentException">A mesh that is missing, cannot be read or is not made of triangles, or a bone
        /// that is missing.</exception>
        public FigureReader(params SkinnedMeshRenderer[] renderers)
        {
            foreach (SkinnedMeshRenderer renderer in renderers)
            {
                AddBones(renderer);
            }
            List<FigureJoint> joints = new List<FigureJoint>();
            foreach (Transform bone in transforms)
            {
                joints.Add(new FigureJoint
                {
                    Name = bone.name,
                    Parent = NumberAbove(bone),
                    ToWorld = Numbers(bone.localToWorldMatrix),
                });
            }
            SkinnedPart[] parts = Array.ConvertAll(renderers, Read);
            Figure = new Figure(joints, parts);
        }

        /// <summary>Meshes and joints, for any thread.</summary>
        public Figure Figure { get; }

        /// <summary>The Transform of each joint.</summary>
        public IReadOnlyList<Transform> Transforms
        {
            get { return transforms; }
        }

        /// <summary>For each bone of a humanoid avatar, by its name, the joint that it is.</summary>
        /// <param name="animator">The character's animator; null: it has none.</param>
        /// <returns>The joints; null where it has no humanoid avatar.</returns>
        public Dictionary<string, int> Humanoid(Animator animator)
        {
            if (animator == null || animator.avatar == null || !animator.avatar.isValid || !animator.avatar.isHuman)
            {
                return null;
            }
            Dictionary<string, int> found = new Dictionary<string, int>();
            for (HumanBodyBones bone = 0; bone < HumanBodyBones.LastBone; bone++)
            {
                Transform transform = animator.GetBoneTransform(bone);
                int joint;
                if (transform != null && TryNumber(transform, out joint))
                {
                    found[bone.ToString()] = joint;
                }
            }
            return found;
        }

        internal static double[] Numbers(Matrix4x4 matrix)
        {
            double[] numbers = new double[16];
            for (int k = 0; k < 16; k++)
            {
                numbers[k] = matrix[k];
            }
            return numbers;
        }

        internal static Matrix4x4 Matrix(double[] numbers)
        {
            Matrix4x4 matrix = default(Matrix4x4);
            for (int k = 0; k < 16; k++)
            {
                matrix[k] = (float)numbers[k];
            }
            return matrix;
        }

        private void AddBones(SkinnedMeshRenderer renderer)
        {
            bool isFirst = transforms.Count == 0;
            foreach (Transform bone in renderer.bones)
            {
                // A bone and all above it, so that what no mesh is bound to is there as well.
                for (Transform above = bone; above != null && !numbers.ContainsKey(above); above = above.parent)
                {
                    if (!isFirst && named.ContainsKey(above.name))
                    {
                        break;
                    }
                    numbers.Add(above, transforms.Count);
                    if (!named.ContainsKey(above.name))
                    {
                        named.Add(above.name, transforms.Count);
                    }
                    transforms.Add(above);
                }
            }
        }

        private bool TryNumber(Transform transform, out int joint)
        {
            return numbers.TryGetValue(transform, out joint) || named.TryGetValue(transform.name, out joint);
        }

        private int NumberAbove(Transform bone)
        {
            int joint;
            return bone.parent != null && TryNumber(bone.parent, out joint) ? joint : -1;
        }

        private SkinnedPart Read(SkinnedMeshRenderer renderer)
        {
            Mesh mesh = renderer.sharedMesh;
            if (mesh == null)
            {
                throw new ArgumentException($"{renderer.name} has no mesh");
            }
            SkinnedPart part = MeshReader.Read(mesh);
            part.Name = renderer.name;
            part.ToWorld = Numbers(renderer.transform.localToWorldMatrix);
            part.Joints = Array.ConvertAll(renderer.bones, bone =>
            {
                int joint;
                return bone != null && TryNumber(bone, out joint) ? joint : -1;
            });
            return part;
        }
    }
}
