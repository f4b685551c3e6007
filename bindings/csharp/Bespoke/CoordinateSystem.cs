// A coordinate system.
namespace Bespoke
{
    /// <summary>A direction along one axis of the caller's coordinates.</summary>
    public enum Axis : uint
    {
        /// <summary>That of <see cref="CoordinateSystem"/>'s field by default.</summary>
        Default = 0,

        /// <summary>+x</summary>
        PositiveX = 1,

        /// <summary>-x</summary>
        NegativeX = 2,

        /// <summary>+y</summary>
        PositiveY = 3,

        /// <summary>-y</summary>
        NegativeY = 4,

        /// <summary>+z</summary>
        PositiveZ = 5,

        /// <summary>-z</summary>
        NegativeZ = 6,
    }

    /// <summary>How the corners of a front face follow each other for somebody who looks at its front.</summary>
    public enum Winding : uint
    {
        /// <summary>Against the hands of a clock.</summary>
        CounterClockwise = 0,

        /// <summary>With the hands of a clock.</summary>
        Clockwise = 1,
    }

    /// <summary>A coordinate system. What is not set is the default; handedness follows from the axes.</summary>
    public sealed class CoordinateSystem
    {
        /// <summary>The axis to the right. Default: +x.</summary>
        public Axis Right { get; set; }

        /// <summary>The axis upwards. Default: +y.</summary>
        public Axis Up { get; set; }

        /// <summary>The axis forwards, into the picture. Default: -z.</summary>
        public Axis Forward { get; set; }

        /// <summary>Length of the unit in metres. 0, the default, is 1.</summary>
        public double MetresPerUnit { get; set; }

        /// <summary>The winding of front faces.</summary>
        public Winding Winding { get; set; }

        /// <summary>Unity's: left-handed, y up, z forwards, metres, clockwise.</summary>
        public static CoordinateSystem Unity
        {
            get
            {
                return new CoordinateSystem
                {
                    Right = Axis.PositiveX,
                    Up = Axis.PositiveY,
                    Forward = Axis.PositiveZ,
                    MetresPerUnit = 1.0,
                    Winding = Winding.Clockwise,
                };
            }
        }

        internal unsafe NativeSpace ToNative()
        {
            return new NativeSpace
            {
                struct_size = (uint)sizeof(NativeSpace),
                right = Right,
                up = Up,
                forward = Forward,
                metres_per_unit = MetresPerUnit,
                winding = Winding,
            };
        }
    }
}
