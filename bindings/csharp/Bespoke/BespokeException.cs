// What a call throws that the library refused.
using System;

namespace Bespoke
{
    /// <summary>
    /// A call failed. <see cref="Exception.Message"/> is a message for people that says what, where and which element.
    /// A call that failed because of its arguments or of the session's state changed nothing.
    /// </summary>
    public sealed class BespokeException : Exception
    {
        /// <summary>A failure with this status and this message.</summary>
        /// <param name="status">Why.</param>
        /// <param name="message">The message.</param>
        public BespokeException(Status status, string message) : base(message)
        {
            Status = status;
        }

        /// <summary>Why the call failed, for a program to decide by.</summary>
        public Status Status { get; }
    }
}
