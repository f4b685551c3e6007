// One garment on its way to one avatar: its life, and what became of a call.
using System;
using System.Threading;

namespace Bespoke
{
    /// <summary>
    /// One garment on its way to one avatar:
    /// <see cref="SetGarment"/>, <see cref="SetSourceSkeleton"/>, <see cref="SetTargetAvatar"/>,
    /// <see cref="SetTargetSkeleton"/>, then <see cref="RunAsync"/> (or <see cref="Run"/>, or <see cref="Prepare"/> and
    /// <see cref="Step"/>), then <see cref="ReadGarmentVertices()"/>.
    /// </summary>
    /// <remarks>
    /// Threads: from any thread, but one call at a time. A second call while the first runs throws a
    /// <see cref="BespokeException"/> with <see cref="Status.Busy"/> at once, and does nothing. <see cref="Cancel"/>,
    /// <see cref="ReadProgress"/>, <see cref="Stage"/>, <see cref="LastMessage"/>, <see cref="CreateControl"/> and
    /// <see cref="Dispose"/> may be called at any time, also while another call runs. Different sessions are
    /// independent. Every call on a session that was disposed of throws <see cref="ObjectDisposedException"/>. A
    /// session that nobody disposes of is freed by the finaliser.
    /// </remarks>
    public sealed partial class Session : IDisposable
    {
        private readonly SessionHandle handle;

        // For those who stop the session whether it is alive or not.
        private readonly ControlHandle control;

        /// <summary>Makes an empty session.</summary>
        /// <exception cref="DllNotFoundException">The library is not found.</exception>
        /// <exception cref="BadImageFormatException">The library has another binary interface.</exception>
        public Session()
        {
            Library.Require();
            handle = SessionHandle.Create();
            control = ControlHandle.Create(handle);
        }

        /// <summary>
        /// Ends the session and frees all it holds; a second time does nothing. A call that runs in another thread is
        /// asked to stop and throws <see cref="ObjectDisposedException"/>; what it needs is freed when it returns.
        /// Controls stay usable.
        /// </summary>
        public void Dispose()
        {
            // In this order, so that a call which is stopped finds the session closed.
            handle.Dispose();
            CancelUnlessDisposed();
            control.Dispose();
        }

        /// <summary>
        /// Takes the session back to <see cref="Stage.Setup"/>: inputs, coordinate systems and options stay, results
        /// and a request to cancel are forgotten. It waits for work that a request to stop has left. State: any.
        /// </summary>
        public void Reset()
        {
            Check(Native.bespoke_session_reset(handle));
        }

        /// <summary>
        /// The message of the last call with this session that failed; empty where none did. At any time, also while
        /// another call runs.
        /// </summary>
        public unsafe string LastMessage
        {
            get
            {
                UIntPtr needed;
                Native.bespoke_session_last_message(handle, null, UIntPtr.Zero, &needed);
                // Another thread may have left a longer sentence meanwhile, which is cut then.
                byte[] text = new byte[checked((int)needed)];
                fixed (byte* to = text)
                {
                    Native.bespoke_session_last_message(handle, to, needed, null);
                    return Utf8.Read(to, text.Length);
                }
            }
        }

        /// <summary>
        /// Asks the session to stop. The call that runs, if it is one of those that take long, throws
        /// <see cref="OperationCanceledException"/> within 100 ms; otherwise the next one does. The request stays until
        /// <see cref="Reset"/>. What can be read afterwards is the last whole iteration. At any time, also while
        /// another call runs. Methods with a <see cref="CancellationToken"/> do this where their token is cancelled.
        /// </summary>
        public void Cancel()
        {
            Check(Native.bespoke_session_cancel(handle));
        }

        /// <summary>
        /// Makes a control: cancel and progress apart from the session, which it may outlive. At any time, also while
        /// another call runs.
        /// </summary>
        /// <returns>The control, which the caller disposes of.</returns>
        public SessionControl CreateControl()
        {
            return new SessionControl(ControlHandle.Create(handle));
        }

        private void CancelUnlessDisposed()
        {
            try
            {
                Native.bespoke_control_cancel(control);
            }
            catch (ObjectDisposedException)
            {
                // Nothing is left to stop.
            }
        }

        private void Check(Status status)
        {
            if (status == Status.Ok)
            {
                return;
            }
            if (status == Status.Busy)
            {
                // The library leaves no sentence then, for the last one is that of the other call.
                throw new BespokeException(
                    status, "Another thread is inside a call with this session; nothing was done.");
            }
            string sentence = LastMessage;
            if (status == Status.Cancelled)
            {
                throw new OperationCanceledException(sentence);
            }
            throw new BespokeException(status, sentence.Length > 0 ? sentence : Library.StatusName(status));
        }
    }
}
