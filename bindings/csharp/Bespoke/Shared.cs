// Avatars and garments that several sessions share.
using System;

namespace Bespoke
{
    /// <summary>
    /// A body to dress, for many sessions at once in any threads: <see cref="Session.UseAvatar"/>. What they need of it
    /// alone, above all the distance field, is computed by the first of them and taken by the others; the results are
    /// those without sharing.
    /// </summary>
    /// <remarks>
    /// Sessions keep what they use, so it may be disposed of at any time; one that is forgotten is freed by the
    /// finaliser.
    /// </remarks>
    public sealed class SharedAvatar : IDisposable
    {
        internal readonly AvatarHandle Handle;

        internal SharedAvatar(AvatarHandle handle)
        {
            Handle = handle;
        }

        /// <summary>Frees the avatar; a second time does nothing. Sessions that use it go on.</summary>
        public void Dispose()
        {
            Handle.Dispose();
        }
    }

    /// <summary>
    /// A garment to fit, for many sessions at once in any threads: <see cref="Session.UseGarment"/>. Otherwise as
    /// <see cref="SharedAvatar"/>, but less is saved: most of the work depends on the avatar, too.
    /// </summary>
    public sealed class SharedGarment : IDisposable
    {
        internal readonly GarmentHandle Handle;

        internal SharedGarment(GarmentHandle handle)
        {
            Handle = handle;
        }

        /// <summary>Frees the garment; a second time does nothing. Sessions that use it go on.</summary>
        public void Dispose()
        {
            Handle.Dispose();
        }
    }

    public sealed partial class Session
    {
        /// <summary>
        /// Makes an avatar that many sessions use, of all that was set of the target: mesh, skeleton or rig, skin
        /// weights, parts, layers, morphs and coordinate system. This session itself shares it only once
        /// <see cref="UseAvatar"/> says so. State: any.
        /// </summary>
        /// <returns>The avatar, which the caller disposes of.</returns>
        /// <exception cref="BespokeException">InvalidState (no target avatar is set), Busy, Internal.</exception>
        public SharedAvatar ShareAvatar()
        {
            AvatarHandle made = AvatarHandle.Create(handle, out Status status);
            Check(status);
            return new SharedAvatar(made);
        }

        /// <summary>
        /// Makes a garment that many sessions use, of all that was set of the garment: mesh, source skeleton or rig,
        /// source avatar, the skin weights of both, fit weights, pins, rigid groups, curves, morphs, followers and the
        /// source coordinate system. State: any.
        /// </summary>
        /// <returns>The garment, which the caller disposes of.</returns>
        /// <exception cref="BespokeException">InvalidState (no garment is set), Busy, Internal.</exception>
        public SharedGarment ShareGarment()
        {
            GarmentHandle made = GarmentHandle.Create(handle, out Status status);
            Check(status);
            return new SharedGarment(made);
        }

        /// <summary>
        /// Dresses a shared avatar: it takes the place of all that was set of a target. What is set of the target
        /// afterwards holds for this session alone, and another target avatar ends the sharing. State: Setup.
        /// </summary>
        /// <param name="avatar">It may be used by other sessions meanwhile.</param>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void UseAvatar(SharedAvatar avatar)
        {
            if (avatar == null)
            {
                throw new ArgumentNullException(nameof(avatar));
            }
            Check(Native.bespoke_session_use_avatar(handle, avatar.Handle));
        }

        /// <summary>
        /// Fits a shared garment: it takes the place of all that was set of a garment and its source. What is set of
        /// them afterwards holds for this session alone, and another garment ends the sharing. State: Setup.
        /// </summary>
        /// <param name="garment">It may be used by other sessions meanwhile.</param>
        /// <exception cref="BespokeException">InvalidState, Busy, Internal.</exception>
        public void UseGarment(SharedGarment garment)
        {
            if (garment == null)
            {
                throw new ArgumentNullException(nameof(garment));
            }
            Check(Native.bespoke_session_use_garment(handle, garment.Handle));
        }
    }
}
