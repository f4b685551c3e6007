// The options of a session.
namespace Bespoke
{
    /// <summary>
    /// The options of a session. 0 is the default of each property; a weight is switched off by
    /// <see cref="WeightOff"/>. Lengths are in the normalised space, in which the longest side of the skeleton's
    /// bounding box is 2.
    /// </summary>
    public sealed partial class Options
    {
        /// <summary>The value of a weight that switches its term off; 0 means the default.</summary>
        public const double WeightOff = NativeConstants.WeightOff;

        /// <summary>New options with the defaults written out. Any thread, at any time.</summary>
        /// <returns>The options.</returns>
        /// <exception cref="System.DllNotFoundException">The library is not found.</exception>
        /// <exception cref="System.BadImageFormatException">The library has another binary interface.</exception>
        public static unsafe Options ReadDefaults()
        {
            Library.Require();
            NativeOptions native = new NativeOptions { struct_size = (uint)sizeof(NativeOptions) };
            Status status = Native.bespoke_options_read_defaults(&native);
            if (status != Status.Ok)
            {
                throw new BespokeException(status, "The library does not give its default options.");
            }
            return FromNative(native);
        }
    }
}
