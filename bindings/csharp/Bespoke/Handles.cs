// Owners of what the library gave out. The runtime counts the calls that use a handle: it is destroyed once, after the
// last of them has returned, by Dispose or else by the finaliser.
using System;
using System.Runtime.InteropServices;

namespace Bespoke
{
    internal sealed unsafe class SessionHandle : SafeHandle
    {
        private SessionHandle() : base(IntPtr.Zero, true)
        {
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        internal static SessionHandle Create()
        {
            // There is an owner before there is something to own.
            SessionHandle owner = new SessionHandle();
            IntPtr made = IntPtr.Zero;
            Status status = Native.bespoke_session_create(&made);
            owner.SetHandle(made);
            if (status != Status.Ok)
            {
                throw new BespokeException(status, "The library cannot make a session.");
            }
            return owner;
        }

        protected override bool ReleaseHandle()
        {
            return Native.bespoke_session_destroy(handle) == Status.Ok;
        }
    }

    internal sealed unsafe class ControlHandle : SafeHandle
    {
        private ControlHandle() : base(IntPtr.Zero, true)
        {
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        internal static ControlHandle Create(SessionHandle session)
        {
            ControlHandle owner = new ControlHandle();
            IntPtr made = IntPtr.Zero;
            Status status = Native.bespoke_session_create_control(session, &made);
            owner.SetHandle(made);
            if (status != Status.Ok)
            {
                throw new BespokeException(status, "The library cannot make a control of the session.");
            }
            return owner;
        }

        protected override bool ReleaseHandle()
        {
            Native.bespoke_control_destroy(handle);
            return true;
        }
    }

    internal sealed unsafe class AvatarHandle : SafeHandle
    {
        private AvatarHandle() : base(IntPtr.Zero, true)
        {
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        /// <summary>Of what was set in a session, which says itself why that failed.</summary>
        internal static AvatarHandle Create(SessionHandle session, out Status status)
        {
            AvatarHandle owner = new AvatarHandle();
            IntPtr made = IntPtr.Zero;
            status = Native.bespoke_avatar_create(session, &made);
            owner.SetHandle(made);
            return owner;
        }

        protected override bool ReleaseHandle()
        {
            Native.bespoke_avatar_destroy(handle);
            return true;
        }
    }

    internal sealed unsafe class GarmentHandle : SafeHandle
    {
        private GarmentHandle() : base(IntPtr.Zero, true)
        {
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        /// <summary>Of what was set in a session, which says itself why that failed.</summary>
        internal static GarmentHandle Create(SessionHandle session, out Status status)
        {
            GarmentHandle owner = new GarmentHandle();
            IntPtr made = IntPtr.Zero;
            status = Native.bespoke_garment_create(session, &made);
            owner.SetHandle(made);
            return owner;
        }

        protected override bool ReleaseHandle()
        {
            Native.bespoke_garment_destroy(handle);
            return true;
        }
    }
}
