// The library that is loaded: its versions.
using System;

namespace Bespoke
{
    /// <summary>
    /// The native library. It is looked for as the runtime looks for "bespoke" (libbespoke.so, bespoke.dll,
    /// libbespoke.dylib) when something of it is needed first; where it is not found, that is the runtime's own
    /// <see cref="DllNotFoundException"/>. Any thread, at any time.
    /// </summary>
    public static class Library
    {
        // The number does not change while the library is loaded, and a program cannot load it twice.
        private static volatile bool isChecked;

        /// <summary>
        /// The binary interface that this binding was written for (BESPOKE_ABI_VERSION). A session is made only where
        /// the library has the same.
        /// </summary>
        public const int AbiVersion = NativeConstants.AbiVersion;

        /// <summary>The binary interface of the library that is loaded.</summary>
        /// <exception cref="DllNotFoundException">The library is not found.</exception>
        public static int LoadedAbiVersion
        {
            get { return checked((int)Native.bespoke_abi_version()); }
        }

        /// <summary>The version of the library that is loaded, such as "0.1.0".</summary>
        /// <exception cref="DllNotFoundException">The library is not found.</exception>
        public static unsafe string VersionText
        {
            get { return Utf8.Read(Native.bespoke_version_text(), 256); }
        }

        /// <summary>The name of a status in C, such as "BESPOKE_STATUS_BUSY".</summary>
        /// <param name="status">The status; "BESPOKE_STATUS_UNKNOWN" for any other number.</param>
        /// <returns>The name.</returns>
        /// <exception cref="DllNotFoundException">The library is not found.</exception>
        public static unsafe string StatusName(Status status)
        {
            return Utf8.Read(Native.bespoke_status_name(status), 256);
        }

        // Before anything else: with another binary interface, every further call would be a guess.
        internal static void Require()
        {
            if (isChecked)
            {
                return;
            }
            if (LoadedAbiVersion != AbiVersion)
            {
                throw new BadImageFormatException(
                    $"The library bespoke that was found is version {VersionText} with binary interface " +
                    $"{LoadedAbiVersion}, and this binding was written for binary interface {AbiVersion}: put the " +
                    "library that it came with in its place.");
            }
            isChecked = true;
        }
    }
}
