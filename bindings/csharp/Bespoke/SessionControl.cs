// Cancel and progress of one session, apart from it.
using System;

namespace Bespoke
{
    /// <summary>
    /// Cancel and progress of one session, apart from it: it may outlive the session. All methods from any thread, at
    /// any time. After <see cref="Dispose"/> they throw <see cref="ObjectDisposedException"/>.
    /// </summary>
    public sealed class SessionControl : IDisposable
    {
        private readonly ControlHandle handle;

        internal SessionControl(ControlHandle handle)
        {
            this.handle = handle;
        }

        /// <summary>The same as <see cref="Session.Cancel"/>. Without effect once the session is disposed of.</summary>
        public void Cancel()
        {
            Native.bespoke_control_cancel(handle);
        }

        /// <summary>
        /// The same as <see cref="Session.ReadProgress"/>. Once the session is disposed of, the last progress stays.
        /// </summary>
        /// <returns>Progress as of the last iteration.</returns>
        public unsafe SessionProgress ReadProgress()
        {
            NativeProgress native = new NativeProgress { struct_size = (uint)sizeof(NativeProgress) };
            Status status = Native.bespoke_control_read_progress(handle, &native);
            if (status != Status.Ok)
            {
                throw new BespokeException(status, "The library does not give the progress of the session.");
            }
            return new SessionProgress(&native);
        }

        /// <summary>Frees the control; a second time does nothing. The session runs on.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }
    }
}
