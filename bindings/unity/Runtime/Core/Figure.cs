// A character: its meshes and joints in one space, in the pose in which the meshes were bound.
using System;
using System.Collections.Generic;

namespace Bespoke.Unity
{
    /// <summary>
    /// Meshes and joints of one character in one space, that of the first mesh, in the pose in which the meshes were bound to
    /// their joints. It does not matter in which pose the character stands.
    /// </summary>
    public sealed class Figure
    {
        private readonly double[][] binds;

        /// <summary>A character.</summary>
        /// <param name="joints">Its joints; parents in any order.</param>
        /// <param name="parts">Its meshes. The first gives the space.</param>
        /// <exception cref="ArgumentException">No meshes, a joint above itself, a bone or a bind pose that cannot be
        /// used.</exception>
        public Figure(IReadOnlyList<FigureJoint> joints, params SkinnedPart[] parts)
        {
            if (parts.Length == 0)
            {
                throw new ArgumentException("a character has at least one mesh");
            }
            Joints = joints;
            binds = new double[joints.Count][];
            double[][] places = Placed(parts);
            Parts = new SkinnedPart[parts.Length];
            for (int k = 0; k < parts.Length; k++)
            {
                Parts[k] = Moved(parts[k], places[k]);
            }
            FillBinds(Invert(parts[0].ToWorld, $"{parts[0].Name}: the transform of the renderer"));
        }

        /// <summary>The joints.</summary>
        public IReadOnlyList<FigureJoint> Joints { get; }

        /// <summary>The meshes, all in the space of the first. Those that were there already have their own arrays.</summary>
        public SkinnedPart[] Parts { get; }

        /// <summary>The joints as the library takes them.</summary>
        /// <returns>One for each joint.</returns>
        public Joint[] Rig()
        {
            Joint[] rig = new Joint[Joints.Count];
            for (int k = 0; k < rig.Length; k++)
            {
                int parent = Joints[k].Parent;
                rig[k] = new Joint(Joints[k].Name, parent < 0 ? (int?)null : parent, binds[k]);
            }
            return rig;
        }

        /// <summary>From a joint's own space to that of the figure, in the pose of the bind.</summary>
        /// <param name="joint">The joint, from 0.</param>
        /// <returns>16 numbers.</returns>
        public double[] Bind(int joint)
        {
            return binds[joint];
        }

        /// <summary>All meshes from <paramref name="first"/> on as one.</summary>
        /// <param name="first">The first part that counts.</param>
        /// <param name="positions">x, y, z of each vertex.</param>
        /// <param name="triangles">Three vertices each.</param>
        /// <param name="skin">Skin weights; null: none.</param>
        public void Joined(int first, out float[] positions, out int[] triangles, out Influences skin)
        {
            SkinnedPart[] parts = new SkinnedPart[Parts.Length - first];
            Array.Copy(Parts, first, parts, 0, parts.Length);
            List<float> points = new List<float>();
            List<int> corners = new List<int>();
            foreach (SkinnedPart part in parts)
            {
                int begin = points.Count / 3;
                points.AddRange(part.Positions);
                foreach (int corner in part.Triangles)
                {
                    corners.Add(begin + corner);
                }
            }
            positions = points.ToArray();
            triangles = corners.ToArray();
            skin = Influences.Joined(parts);
        }

        // Where each mesh lies in the space of the first: a joint that two of them are bound to says so, wherever it
        // stands now.
        private double[][] Placed(SkinnedPart[] parts)
        {
            double[][] places = new double[parts.Length][];
            places[0] = Transform4.Identity();
            Bound(parts[0], places[0]);
            double[] fromWorld = Invert(parts[0].ToWorld, $"{parts[0].Name}: the transform of the renderer");
            for (int left = parts.Length - 1; left > 0; left--)
            {
                // One that shares a joint comes before one that does not.
                int chosen = -1;
                double[] place = null;
                for (int k = 1; k < parts.Length && place == null; k++)
                {
                    if (places[k] == null)
                    {
                        place = Shared(parts[k]);
                        chosen = place != null || chosen < 0 ? k : chosen;
                    }
                }
                places[chosen] = place ?? Transform4.Multiply(fromWorld, parts[chosen].ToWorld);
                Bound(parts[chosen], places[chosen]);
            }
            return places;
        }

        private double[] Shared(SkinnedPart part)
        {
            for (int bone = 0; bone < Math.Min(part.Joints.Length, part.BindPoses.Length); bone++)
            {
                int joint = part.Joints[bone];
                if (joint >= 0 && binds[joint] != null)
                {
                    return Transform4.Multiply(binds[joint], part.BindPoses[bone]);
                }
            }
            return null;
        }

        private void Bound(SkinnedPart part, double[] place)
        {
            if (part.Joints.Length != part.BindPoses.Length)
            {
                throw new ArgumentException(
                    $"{part.Name}: {part.Joints.Length} bones and {part.BindPoses.Length} bind poses; import the mesh again");
            }
            for (int bone = 0; bone < part.Joints.Length; bone++)
            {
                int joint = part.Joints[bone];
                if (joint >= Joints.Count)
                {
                    throw new ArgumentException($"{part.Name}: bone {bone} is joint {joint}, and there are {Joints.Count}");
                }
                if (joint >= 0 && binds[joint] == null)
                {
                    string what = $"{part.Name}: the bind pose of {Joints[joint].Name}";
                    binds[joint] = Transform4.Multiply(place, Invert(part.BindPoses[bone], what));
                }
            }
        }

        private static SkinnedPart Moved(SkinnedPart part, double[] place)
        {
            // What lies there already keeps its numbers to the last bit.
            if (Transform4.IsIdentity(place))
            {
                return part;
            }
            double[] back = Transform4.Inverse(place);
            SkinnedPart moved = new SkinnedPart
            {
                Name = part.Name,
                Positions = Transform4.Apply(place, part.Positions),
                Triangles = part.Triangles,
                // The library takes normals of any length, and a placement has no shear worth mentioning.
                Normals = part.Normals == null ? null : Transform4.Apply(place, part.Normals, 0),
                Tangents = part.Tangents == null ? null : MovedTangents(place, part.Tangents),
                BonesPerVertex = part.BonesPerVertex,
                BoneIndices = part.BoneIndices,
                BoneWeights = part.BoneWeights,
                Joints = part.Joints,
                BindPoses = Array.ConvertAll(part.BindPoses, pose => Transform4.Multiply(pose, back)),
                ToWorld = Transform4.Multiply(part.ToWorld, back),
            };
            foreach (ShapeFrame frame in part.Frames)
            {
                moved.Frames.Add(new ShapeFrame
                {
                    Name = frame.Name,
                    Weight = frame.Weight,
                    Vertices = Transform4.Apply(place, frame.Vertices, 0),
                    Normals = frame.Normals == null ? null : Transform4.Apply(place, frame.Normals, 0),
                    Tangents = frame.Tangents == null ? null : Transform4.Apply(place, frame.Tangents, 0),
                });
            }
            return moved;
        }

        private static float[] MovedTangents(double[] place, float[] tangents)
        {
            float[] moved = new float[tangents.Length];
            for (int k = 0; k + 3 < tangents.Length; k += 4)
            {
                float[] one = Transform4.Apply(place, new[] { tangents[k], tangents[k + 1], tangents[k + 2] }, 0);
                one.CopyTo(moved, k);
                moved[k + 3] = tangents[k + 3];
            }
            return moved;
        }

        // Joints that no mesh is bound to stand to their neighbours as they do now.
        private void FillBinds(double[] fromWorld)
        {
            int[] order = FromRoots();
            for (int k = order.Length - 1; k >= 0; k--)
            {
                int parent = Joints[order[k]].Parent;
                if (parent >= 0 && binds[parent] == null && binds[order[k]] != null)
                {
                    double[] up = Transform4.Inverse(Joints[order[k]].ToWorld);
                    binds[parent] = up == null
                        ? null
                        : Transform4.Multiply(binds[order[k]], Transform4.Multiply(up, Joints[parent].ToWorld));
                }
            }
            foreach (int joint in order)
            {
                int parent = Joints[joint].Parent;
                if (binds[joint] != null)
                {
                    continue;
                }
                double[] up = parent < 0 ? null : Transform4.Inverse(Joints[parent].ToWorld);
                binds[joint] = up == null
                    ? Transform4.Multiply(fromWorld, Joints[joint].ToWorld)
                    : Transform4.Multiply(binds[parent], Transform4.Multiply(up, Joints[joint].ToWorld));
            }
        }

        private int[] FromRoots()
        {
            int[] order = new int[Joints.Count];
            bool[] isDone = new bool[Joints.Count];
            int done = 0;
            List<int> up = new List<int>();
            for (int k = 0; k < Joints.Count; k++)
            {
                for (int joint = k; joint >= 0 && !isDone[joint]; joint = Joints[joint].Parent)
                {
                    if (up.Count > Joints.Count)
                    {
                        throw new ArgumentException($"the joint {Joints[k].Name} is above itself");
                    }
                    up.Add(joint);
                }
                for (; up.Count > 0; up.RemoveAt(up.Count - 1))
                {
                    int joint = up[up.Count - 1];
                    if (!isDone[joint])
                    {
                        isDone[joint] = true;
                        order[done++] = joint;
                    }
                }
            }
            return order;
        }

        private static double[] Invert(double[] transform, string what)
        {
            return Transform4.Inverse(transform)
                ?? throw new ArgumentException($"{what} has no size in some direction; give it a scale that is not 0");
        }
    }
}
