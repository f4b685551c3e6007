// A coordinate system.
namespace Bespoke
{
    /// <summary>A coordinate system. What is not set is the default; handedness follows from the axes.</summary>
    public sealed class CoordinateSystem
    {
        /// <summary>The axis that points to the right. Default: +x.</summary>
        public Axis Right { get; set; }

        /// <summary>The axis that points up. Default: +y.</summary>
        public Axis Up { get; set; }

        /// <summary>The axis that points forward, away from the viewer. Default: -z.</summary>
        public Axis Forward { get; set; }

        /// <summary>Length of the unit in metres. 0, the default, is 1.</summary>
        public double MetresPerUnit { get; set; }

        /// <summary>The winding of front faces.</summary>
        public Winding Winding { get; set; }

        /// <summary>It is right as it is: what is given in it is neither turned nor refused for unit, axes, facing and
        /// sides.</summary>
        public bool Trusted { get; set; }

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

        internal unsafe NativeCoordinateSystem ToNative()
        {
            return new NativeCoordinateSystem
            {
                struct_size = (uint)sizeof(NativeCoordinateSystem),
                right = Right,
                up = Up,
                forward = Forward,
                metres_per_unit = MetresPerUnit,
                winding = Winding,
                trusted = Trusted ? 1u : 0u,
            };
        }
    }
}
