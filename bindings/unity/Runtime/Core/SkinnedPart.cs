// A mesh as the engine keeps it: plain arrays.
using System.Collections.Generic;

namespace Bespoke.Unity
{
    /// <summary>A frame of a blend shape: what it adds to each vertex.</summary>
    public sealed class ShapeFrame
    {
        /// <summary>The name of the blend shape.</summary>
        public string Name;

        /// <summary>The weight at which the frame is reached, up to 100.</summary>
        public float Weight;

        /// <summary>Offsets of vertices: x, y, z of each.</summary>
        public float[] Vertices;

        /// <summary>Offsets of normals; null: none.</summary>
        public float[] Normals;

        /// <summary>Offsets of tangents, three numbers each; null: none.</summary>
        public float[] Tangents;
    }

    /// <summary>A mesh with its skin: what is read of a SkinnedMeshRenderer. Arrays are kept, not copied.</summary>
    public sealed class SkinnedPart
    {
        /// <summary>What it is called, for messages.</summary>
        public string Name = "";

        /// <summary>x, y, z of each vertex, in the mesh's own space.</summary>
        public float[] Positions = new float[0];

        /// <summary>Three vertices each, from 0.</summary>
        public int[] Triangles = new int[0];

        /// <summary>x, y, z of each vertex; null: none.</summary>
        public float[] Normals;

        /// <summary>x, y, z and the handedness of each vertex; null: none.</summary>
        public float[] Tangents;

        /// <summary>How many bones each vertex has, as Mesh.GetBonesPerVertex says it; empty: no skin.</summary>
        public byte[] BonesPerVertex = new byte[0];

        /// <summary>Numbers in <see cref="Joints"/>, for all vertices one after the other.</summary>
        public int[] BoneIndices = new int[0];

        /// <summary>As many weights.</summary>
        public float[] BoneWeights = new float[0];

        /// <summary>For each bone of the mesh, the joint of the figure that it is, from 0; -1: none.</summary>
        public int[] Joints = new int[0];

        /// <summary>For each bone, from the mesh's space to the bone's: Mesh.bindposes.</summary>
        public double[][] BindPoses = new double[0][];

        /// <summary>From the mesh's space to the world, as the renderer stands now.</summary>
        public double[] ToWorld = Transform4.Identity();

        /// <summary>Its blend shapes, frame after frame.</summary>
        public readonly List<ShapeFrame> Frames = new List<ShapeFrame>();

        /// <summary>Vertices.</summary>
        public int VertexCount
        {
            get { return Positions.Length / 3; }
        }

        /// <summary>Whether bones move it.</summary>
        public bool HasSkin
        {
            get { return BonesPerVertex.Length > 0 && BonesPerVertex.Length == VertexCount && Joints.Length > 0; }
        }
    }

    /// <summary>A joint of a figure: a Transform.</summary>
    public sealed class FigureJoint
    {
        /// <summary>Its name.</summary>
        public string Name = "";

        /// <summary>The joint above it, from 0; -1: none.</summary>
        public int Parent = -1;

        /// <summary>From its own space to the world, as it stands now.</summary>
        public double[] ToWorld = Transform4.Identity();
    }
}
