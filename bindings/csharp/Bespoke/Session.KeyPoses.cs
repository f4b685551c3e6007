// Corrections of key poses: blend shapes driven by joints that keep the garment out of the body.
using System;
using System.Collections.Generic;
using System.Text;

namespace Bespoke
{
    /// <summary>What passes through what in a key pose, and does not in the result's own; pairs of triangles.</summary>
    public sealed class PoseIntersections
    {
        internal PoseIntersections(NativePoseIntersections native)
        {
            GarmentGarment = checked((long)native.garment_garment);
            GarmentAvatar = checked((long)native.garment_avatar);
            InFolds = checked((long)native.in_folds);
        }

        /// <summary>Of the garment with itself.</summary>
        public long GarmentGarment { get; }

        /// <summary>
        /// Of the garment with the avatar or its layers, where these do not pass through themselves.
        /// </summary>
        public long GarmentAvatar { get; }

        /// <summary>
        /// Of the garment with the avatar or its layers where these do, so that nothing can lie between.
        /// </summary>
        public long InFolds { get; }
    }

    /// <summary>Offsets of the garment in a key pose, and what they are good for.</summary>
    public sealed class PoseCorrection
    {
        internal PoseCorrection(float[] offsets, PoseIntersections before, PoseIntersections after)
        {
            Offsets = offsets;
            Before = before;
            After = after;
        }

        /// <summary>
        /// x, y, z for each vertex of the garment, from the result, in the coordinate system of the target; to be added before
        /// skin weights move the vertex.
        /// </summary>
        public float[] Offsets { get; }

        /// <summary>What passes through what in that pose by the weights alone.</summary>
        public PoseIntersections Before { get; }

        /// <summary>The same with the offsets.</summary>
        public PoseIntersections After { get; }
    }

    public sealed partial class Session
    {
        /// <summary>
        /// Optional: a pose of the target rig in which the garment is to keep out of the body, such as a bent arm or a crouch.
        /// Each call adds one; they are numbered from 0. Stage: Setup or Done; in Done the result stays.
        /// </summary>
        /// <param name="name">For messages; null: none.</param>
        /// <param name="transforms">16 numbers for each joint of the target rig, column after column: how it moves what it
        /// moves from the bind pose to this pose, in the coordinate system of the target; copied.</param>
        /// <exception cref="BespokeException">InvalidArgument (another number of joints, a number that is not finite, a
        /// transform without inverse), InvalidState, Busy, Internal.</exception>
        public unsafe void AddKeyPose(string name, IReadOnlyList<double> transforms)
        {
            NotNull(transforms, nameof(transforms));
            if (transforms.Count % NativeConstants.TransformSize != 0)
            {
                throw new BespokeException(
                    Status.InvalidArgument, $"key pose: a transform has 16 numbers, and there are {transforms.Count}");
            }
            // Not empty, so that there is a pointer to it.
            double[] numbers = new double[transforms.Count + 1];
            for (int k = 0; k < transforms.Count; k++)
            {
                numbers[k] = transforms[k];
            }
            UIntPtr joints = (UIntPtr)(uint)(transforms.Count / NativeConstants.TransformSize);
            byte[] text = Encoding.UTF8.GetBytes((name ?? "") + "\0");
            fixed (double* first = numbers)
            fixed (byte* said = text)
            {
                Check(Native.bespoke_session_add_key_pose(handle, said, first, joints));
            }
        }

        /// <summary>Removes all key poses. Stage: Setup or Done.</summary>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void ClearKeyPoses()
        {
            Check(Native.bespoke_session_clear_key_poses(handle));
        }

        /// <summary>
        /// Finds the correction of each key pose: offsets of the garment in the bind pose, a blend shape at full weight in that
        /// pose and at none in the bind pose. The result stays as it is; corrections that are there already are not sought
        /// again. Stage: Done.
        /// </summary>
        /// <param name="influences">Joints a vertex, as in <see cref="ReadGarmentSkinInfluences"/>.</param>
        /// <exception cref="BespokeException">InvalidArgument, InvalidState, InvalidWeights, MemoryLimit, Busy, Internal.
        /// </exception>
        /// <exception cref="OperationCanceledException">By a request that no call has answered yet; the stage stays Done,
        /// and what was found is kept.</exception>
        public void SolvePoseCorrections(int influences)
        {
            Check(Native.bespoke_session_solve_pose_corrections(handle, (UIntPtr)checked((uint)influences)));
        }

        /// <summary>The correction of a key pose. Stage: Done, after <see cref="SolvePoseCorrections"/>.</summary>
        /// <param name="pose">Its number.</param>
        /// <returns>The offsets with counts.</returns>
        /// <exception cref="BespokeException">InvalidArgument (no such pose), InvalidState, Busy, Internal.</exception>
        public unsafe PoseCorrection ReadPoseCorrection(int pose)
        {
            uint number = checked((uint)pose);
            NativeBuffer nowhere = new NativeBuffer { component = Component.F32 };
            NativePoseIntersections before, after;
            UIntPtr count;
            Check(Native.bespoke_session_read_pose_correction(handle, number, &nowhere, &count, &before, &after));
            float[] offsets = new float[checked(3 * (int)count)];
            fixed (float* first = offsets)
            {
                NativeBuffer buffer =
                    new NativeBuffer { data = first, capacity = count, component = Component.F32 };
                Check(Native.bespoke_session_read_pose_correction(handle, number, &buffer, &count, null, null));
            }
            return new PoseCorrection(offsets, new PoseIntersections(before), new PoseIntersections(after));
        }
    }
}
