// Joints of a rig, and what corresponds to them in another.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    /// <summary>A joint of a rig.</summary>
    public sealed class Joint
    {
        /// <summary>A joint.</summary>
        /// <param name="name">Its name; null or empty: it has none.</param>
        /// <param name="parent">The joint that moves it; null for a root.</param>
        /// <param name="bind">Its bind transform; kept, not copied.</param>
        public Joint(string name, int? parent, double[] bind)
        {
            Name = name;
            Parent = parent;
            Bind = bind;
        }

        /// <summary>Its name, as the tool has it; null or empty: it has none.</summary>
        public string Name { get; set; }

        /// <summary>The joint that moves it, from 0, in any order; null for a root.</summary>
        public int? Parent { get; set; }

        /// <summary>
        /// The bind transform: from the joint's own space to that in which the mesh is given, in the pose in which the
        /// mesh is given. 16 numbers, column after column, so that numbers 12 to 14 (from 0) are the joint's place. Of
        /// Unity's Matrix4x4, in which <c>m[k]</c> counts like that, these are <c>m[0]</c> to <c>m[15]</c> of the
        /// inverse of a bind pose. Of System.Numerics, whose vectors are rows, they are M11, M12 and so on, row after
        /// row.
        /// </summary>
        public double[] Bind { get; set; }
    }

    /// <summary>A joint of the source rig and what corresponds to it in the target rig.</summary>
    public sealed class MappedJoint
    {
        internal unsafe MappedJoint(NativeMappedJoint* native)
        {
            Target = native->target == NativeConstants.NoJoint ? (int?)null : checked((int)native->target);
            Reason = (JointReason)native->reason;
            Confidence = native->confidence;
            Part = Utf8.Read(native->part, NativeConstants.PartNameSize);
        }

        /// <summary>The target rig's joint; null where there is none.</summary>
        public int? Target { get; }

        /// <summary>Why.</summary>
        public JointReason Reason { get; }

        /// <summary>From 0, a guess, to 1, sure.</summary>
        public double Confidence { get; }

        /// <summary>The part of the body, such as "left upper arm"; empty where it is none.</summary>
        public string Part { get; }
    }

    /// <summary>A joint of the garment's own, which follows on those of the target rig.</summary>
    public sealed class AddedJoint
    {
        internal unsafe AddedJoint(NativeAddedJoint* native)
        {
            Source = checked((int)native->source);
            Parent = native->parent == NativeConstants.NoJoint ? (int?)null : checked((int)native->parent);
            Bind = new double[NativeConstants.TransformSize];
            Marshal.Copy((IntPtr)native->bind, Bind, 0, NativeConstants.TransformSize);
        }

        /// <summary>The joint of the source rig that it is.</summary>
        public int Source { get; }

        /// <summary>
        /// A joint of the target rig, or an added one, which are numbered on from there; null for a root.
        /// </summary>
        public int? Parent { get; }

        /// <summary>
        /// Its bind transform in the coordinate system of the target, as in <see cref="Joint.Bind"/>.
        /// </summary>
        public double[] Bind { get; }
    }
}
