// Rigs of both bodies, and the map between them.
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Text;

namespace Bespoke
{
    public sealed partial class Session
    {
        private unsafe delegate Status SetRig(SessionHandle session, NativeJoint* joints, UIntPtr count);

        private unsafe delegate Status SetInfluences(
            SessionHandle session, NativeView* joints, NativeView* weights, UIntPtr influences, UIntPtr jointCount);

        /// <summary>
        /// In place of a source skeleton: the rig of the body on which the garment was designed, in the coordinate
        /// system of the garment. With a rig on both sides no skeletons have to correspond: which joints do follows
        /// from their names, from their places and from <see cref="SetJointPairs"/>, and can be read with <see
        /// cref="ReadJointMap"/>. A skeleton beside a rig is read as a rig without names. The later one of skeleton and
        /// rig counts.
        /// </summary>
        /// <param name="joints">The joints, at most 65535; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidSkeleton (no joints, a parent that is no joint,
        /// parents in a circle, a number that is not finite, a last row that is not 0, 0, 0, 1; that nothing
        /// corresponds is found by <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetSourceRig(IReadOnlyList<Joint> joints)
        {
            SetARig(Native.bespoke_session_set_source_rig, joints, "source rig");
        }

        /// <summary>
        /// In place of a target skeleton: the rig of the body to dress, in its coordinate system and in the pose in
        /// which it is given. Its skin weights are then on these joints. That source and target stand in different
        /// poses, such as an A-pose and a T-pose, needs nothing. All else as for <see cref="SetSourceRig"/>.
        /// </summary>
        /// <param name="joints">The joints, at most 65535; copied.</param>
        public unsafe void SetTargetRig(IReadOnlyList<Joint> joints)
        {
            SetARig(Native.bespoke_session_set_target_rig, joints, "target rig");
        }

        /// <summary>
        /// Optional: skin weights of the source avatar on the source rig. They tell which of its joints move nothing,
        /// and where the top of the head is in a rig that has no joint there.
        /// </summary>
        /// <param name="joints">For each vertex of the source avatar, <paramref name="influences"/> joints, from
        /// 0.</param>
        /// <param name="weights">For each vertex, as many weights.</param>
        /// <param name="influences">Joints of a vertex, such as 4.</param>
        /// <param name="jointCount">Joints of the source rig.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidWeights (a wrong size may be found only by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetSourceSkinInfluences(IndexView joints, FloatView weights, int influences, int jointCount)
        {
            SetTheInfluences(
                Native.bespoke_session_set_source_skin_influences, joints, weights, influences, jointCount,
                "source skin");
        }

        /// <summary>Optional: skin weights of the garment as it was modelled, on the source rig.</summary>
        /// <param name="joints">For each vertex of the garment, <paramref name="influences"/> joints, from 0.</param>
        /// <param name="weights">For each vertex, as many weights.</param>
        /// <param name="influences">Joints of a vertex, such as 4.</param>
        /// <param name="jointCount">Joints of the source rig.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidWeights (a wrong size may be found only by
        /// <see cref="Prepare"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetGarmentSkinInfluences(IndexView joints, FloatView weights, int influences, int jointCount)
        {
            SetTheInfluences(
                Native.bespoke_session_set_garment_skin_influences, joints, weights, influences, jointCount,
                "garment skin");
        }

        /// <summary>
        /// Optional: joints of the two rigs that correspond. They win over names and places. Replaces earlier pairs.
        /// </summary>
        /// <param name="pairs">A joint of the source rig and one of the target rig each, from 0; -1 (uint.MaxValue,
        /// ushort.MaxValue) as the second: nothing corresponds to it. Each joint is in one pair at most.</param>
        /// <exception cref="BespokeException">InvalidArgument (a joint that a rig does not have, or one in two pairs,
        /// is found by <see cref="Prepare"/> and <see cref="ReadJointMap"/>), InvalidState, Busy, Internal.</exception>
        public unsafe void SetJointPairs(IndexView pairs)
        {
            fixed (byte* p = &MemoryMarshal.GetReference(pairs.Bytes))
            {
                NativeView view = pairs.Pinned(p, 2, "joint pairs");
                Check(Native.bespoke_session_set_joint_pairs(handle, &view));
            }
        }

        /// <summary>
        /// Which joint of the target rig corresponds to each joint of the source rig, why, and how sure that is: for an
        /// editor to show, and to mend with <see cref="SetJointPairs"/>. State: any, with rig or skeleton set on both
        /// sides.
        /// </summary>
        /// <returns>One for each joint of the source rig, in its order.</returns>
        /// <exception cref="BespokeException">InvalidArgument (a pair that suits no rig), InvalidWeights, InvalidState,
        /// Busy, Internal.</exception>
        public unsafe MappedJoint[] ReadJointMap()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_joint_map(handle, null, UIntPtr.Zero, &count));
            NativeMappedJoint[] native = new NativeMappedJoint[checked((int)count)];
            fixed (NativeMappedJoint* first = native)
            {
                Check(Native.bespoke_session_read_joint_map(handle, first, count, &count));
                // Another call between the two may have left fewer of them, or more.
                MappedJoint[] joints = new MappedJoint[Math.Min(native.Length, checked((int)count))];
                for (int k = 0; k < joints.Length; k++)
                {
                    joints[k] = new MappedJoint(first + k);
                }
                return joints;
            }
        }

        /// <summary>
        /// Skin weights of the result on the joints of the target rig, or of the target skeleton where no rig was set:
        /// those of the body beneath, smoothly continued where the garment stands off. Vertices of a rigid group have
        /// the same. State: Done, with skin weights of the target avatar set.
        /// </summary>
        /// <param name="influences">Joints of a vertex, such as 4 or 8.</param>
        /// <param name="joints">For each garment vertex, as many joints, that with the largest weight first.</param>
        /// <param name="weights">For each garment vertex, as many weights, of sum 1.</param>
        /// <returns>Joints of the target rig and added joints together.</returns>
        /// <exception cref="BespokeException">InvalidState, InvalidWeights, Cancelled, Busy, Internal.</exception>
        public unsafe int ReadGarmentSkinInfluences(int influences, out uint[] joints, out float[] weights)
        {
            AtLeastOne(influences, nameof(influences));
            int vertices = GarmentVertexCount;
            joints = new uint[checked(vertices * influences)];
            weights = new float[joints.Length];
            UIntPtr count;
            fixed (uint* j = joints)
            fixed (float* w = weights)
            {
                Check(Native.bespoke_session_read_garment_skin_influences(
                    handle, (UIntPtr)(uint)influences, j, w, (UIntPtr)(uint)vertices, &count));
            }
            return checked((int)count);
        }

        /// <summary>
        /// The garment's own joints, such as those of a skirt or a cape, in the order of their numbers, which follow on
        /// those of the target rig. State: Done, with skin weights of the target avatar set.
        /// </summary>
        /// <returns>The joints.</returns>
        /// <exception cref="BespokeException">InvalidState, InvalidWeights, Cancelled, Busy, Internal.</exception>
        public unsafe AddedJoint[] ReadAddedJoints()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_added_joints(handle, null, UIntPtr.Zero, &count));
            NativeAddedJoint[] native = new NativeAddedJoint[checked((int)count)];
            fixed (NativeAddedJoint* first = native)
            {
                Check(Native.bespoke_session_read_added_joints(handle, first, (UIntPtr)(uint)native.Length, &count));
                AddedJoint[] joints = new AddedJoint[Math.Min(native.Length, checked((int)count))];
                for (int k = 0; k < joints.Length; k++)
                {
                    joints[k] = new AddedJoint(first + k);
                }
                return joints;
            }
        }

        /// <summary>
        /// How each joint of the target rig moves from its bind pose to the pose that the result is in: 16 numbers each,
        /// column after column, all of them the identity but where there is a diagnostic PoseBlocked. State: Done, with a
        /// target rig.
        /// </summary>
        /// <returns>The numbers, joint after joint.</returns>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public unsafe double[] ReadPoseTransforms()
        {
            UIntPtr count;
            Check(Native.bespoke_session_read_pose_transforms(handle, null, UIntPtr.Zero, &count));
            double[] numbers = new double[checked((int)count * NativeConstants.TransformSize)];
            fixed (double* first = numbers)
            {
                Check(Native.bespoke_session_read_pose_transforms(handle, first, count, &count));
            }
            return numbers;
        }

        private unsafe void SetARig(SetRig set, IReadOnlyList<Joint> joints, string what)
        {
            NotNull(joints, nameof(joints));
            NativeJoint[] native = new NativeJoint[joints.Count];
            // All names, one after the other, each with its zero byte.
            List<byte> names = new List<byte>();
            int[] begins = new int[joints.Count];
            for (int k = 0; k < native.Length; k++)
            {
                Joint joint = NotNull(joints[k], nameof(joints));
                if (joint.Bind == null || joint.Bind.Length != NativeConstants.TransformSize)
                {
                    string found = joint.Bind == null ? "none" : joint.Bind.Length.ToString();
                    throw new BespokeException(
                        Status.InvalidArgument, $"{what}: the bind transform of joint {k} has 16 numbers, not {found}");
                }
                if (joint.Parent < 0)
                {
                    throw new BespokeException(
                        Status.InvalidSkeleton, $"{what}: joint {k} has parent {joint.Parent}, and joints count from 0");
                }
                native[k].parent = joint.Parent.HasValue ? (uint)joint.Parent.Value : NativeConstants.NoJoint;
                fixed (double* bind = native[k].bind)
                {
                    Marshal.Copy(joint.Bind, 0, (IntPtr)bind, NativeConstants.TransformSize);
                }
                begins[k] = names.Count;
                names.AddRange(Encoding.UTF8.GetBytes(joint.Name ?? ""));
                names.Add(0);
            }
            byte[] text = names.ToArray();
            fixed (byte* firstName = text)
            fixed (NativeJoint* first = native)
            {
                for (int k = 0; k < native.Length; k++)
                {
                    first[k].name = firstName + begins[k];
                }
                Check(set(handle, first, (UIntPtr)(uint)native.Length));
            }
        }

        private unsafe void SetTheInfluences(
            SetInfluences set, IndexView joints, FloatView weights, int influences, int jointCount, string what)
        {
            AtLeastOne(influences, nameof(influences));
            AtLeastOne(jointCount, nameof(jointCount));
            fixed (byte* j = &MemoryMarshal.GetReference(joints.Bytes))
            fixed (byte* w = &MemoryMarshal.GetReference(weights.Bytes))
            {
                NativeView indices = joints.Pinned(j, influences, what + " joints");
                NativeView numbers = weights.Pinned(w, influences, what + " weights");
                joints.RefuseNegative(influences, Status.InvalidWeights, what + " joints", "vertex", weights);
                Check(set(handle, &indices, &numbers, (UIntPtr)(uint)influences, (UIntPtr)(uint)jointCount));
            }
        }
    }
}
