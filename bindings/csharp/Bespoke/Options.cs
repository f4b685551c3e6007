// What may be tuned.
namespace Bespoke
{
    /// <summary>Form of the surface term (Eq. 2 of the paper).</summary>
    public enum SurfaceForm : uint
    {
        /// <summary>Free for every similarity: scaling the garment as a whole costs nothing.</summary>
        Similarity = 0,

        /// <summary>As printed in the paper.</summary>
        Printed = 1,
    }

    /// <summary>
    /// What may be tuned. 0 is the default of each property; a weight is switched off by <see cref="WeightOff"/>.
    /// Lengths are in the normalised space, in which the longest side of the skeleton's bounding box is 2.
    /// </summary>
    public sealed class Options
    {
        /// <summary>The value of a weight that switches its term off; 0 means the default.</summary>
        public const double WeightOff = NativeConstants.WeightOff;

        /// <summary>Threads of this session. Default: as many as the machine has cores.</summary>
        public uint Threads { get; set; }

        /// <summary>Weight of the fit term, higher is tighter. Default 2. <see cref="WeightOff"/>: no fit.</summary>
        public double FitWeight { get; set; }

        /// <summary>
        /// Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point
        /// of the garment had on it. Default 1, as designed. <see cref="WeightOff"/>: tight, as without a source
        /// avatar.
        /// </summary>
        public double DesignedClearance { get; set; }

        /// <summary>Weight of the surface term, which keeps the design's shape. Default 1.</summary>
        public double SurfaceWeight { get; set; }

        /// <summary>Weight of the curvature of boundary curves. Default 1. <see cref="WeightOff"/> possible.</summary>
        public double CurvatureWeight { get; set; }

        /// <summary>Weight of the torsion of boundary curves. Default 1. <see cref="WeightOff"/> possible.</summary>
        public double TorsionWeight { get; set; }

        /// <summary>
        /// Weight of the place of cuffs, hems and collars along their bones. Default 10. <see cref="WeightOff"/>
        /// possible.
        /// </summary>
        public double PositionWeight { get; set; }

        /// <summary>Weight of the contact barrier, on squared distances. Default 1e8.</summary>
        public double BarrierWeight { get; set; }

        /// <summary>Distance at which the barrier begins. Default 0.002.</summary>
        public double Dhat { get; set; }

        /// <summary>While the avatar grows: distance to it at which the barrier begins. Default 0.01.</summary>
        public double InflationDhat { get; set; }

        /// <summary>While the avatar grows: weight of the contact barrier. Default 1e4.</summary>
        public double InflationBarrierWeight { get; set; }

        /// <summary>Edge of a voxel of the distance field. Default 0.01.</summary>
        public double Voxel { get; set; }

        /// <summary>Distance that nothing ever falls below, less than half of <see cref="Dhat"/>. Default
        /// 1e-5.</summary>
        public double SeparationFloor { get; set; }

        /// <summary>The fit ends where the relative Newton decrement falls below this. Default 1e-3.</summary>
        public double Tolerance { get; set; }

        /// <summary>Largest number of Newton iterations of each stage. Default 500.</summary>
        public uint MaxIterations { get; set; }

        /// <summary>Form of the surface term. Default <see cref="SurfaceForm.Similarity"/>.</summary>
        public SurfaceForm SurfaceForm { get; set; }

        /// <summary>
        /// Bytes that the session may take at most. Default: no limit. What a session needs is estimated from the sizes
        /// of its meshes before it begins, and looked at again as it goes on.
        /// </summary>
        public ulong MemoryLimit { get; set; }

        /// <summary>
        /// A garment that intersects itself at the start is refused. Default: the triangles that do so are let off and
        /// named by <see cref="Session.ReadDiagnostics"/>, and no others ever join them.
        /// </summary>
        public bool Strict { get; set; }

        /// <summary>
        /// Clearance to aim at everywhere, beside the designed one, in the unit of the target space. What is nearer is
        /// pushed away, what is farther is drawn in. At most half the size of the target skeleton. Default 0.
        /// </summary>
        public double Offset { get; set; }

        /// <summary>
        /// Where a source avatar is given and no fit weights: what was designed farther away from it than this fits
        /// less, and not at all from twice this distance on. Default 0.1. <see cref="WeightOff"/>: the garment fits as
        /// a whole.
        /// </summary>
        public double FitDistance { get; set; }

        /// <summary>Weight of pins. Default 1000.</summary>
        public double PinWeight { get; set; }

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
                throw new BespokeException(status, "The library does not tell its default options.");
            }
            return new Options
            {
                Threads = native.threads,
                FitWeight = native.fit_weight,
                DesignedClearance = native.designed_clearance,
                SurfaceWeight = native.surface_weight,
                CurvatureWeight = native.curvature_weight,
                TorsionWeight = native.torsion_weight,
                PositionWeight = native.position_weight,
                BarrierWeight = native.barrier_weight,
                Dhat = native.dhat,
                InflationDhat = native.inflation_dhat,
                InflationBarrierWeight = native.inflation_barrier_weight,
                Voxel = native.voxel,
                SeparationFloor = native.separation_floor,
                Tolerance = native.tolerance,
                MaxIterations = native.max_iterations,
                SurfaceForm = native.surface_form,
                MemoryLimit = native.memory_limit,
                Strict = native.strict != 0,
                Offset = native.offset,
                FitDistance = native.fit_distance,
                PinWeight = native.pin_weight,
            };
        }

        internal unsafe NativeOptions ToNative()
        {
            return new NativeOptions
            {
                struct_size = (uint)sizeof(NativeOptions),
                threads = Threads,
                fit_weight = FitWeight,
                designed_clearance = DesignedClearance,
                surface_weight = SurfaceWeight,
                curvature_weight = CurvatureWeight,
                torsion_weight = TorsionWeight,
                position_weight = PositionWeight,
                barrier_weight = BarrierWeight,
                dhat = Dhat,
                inflation_dhat = InflationDhat,
                inflation_barrier_weight = InflationBarrierWeight,
                voxel = Voxel,
                separation_floor = SeparationFloor,
                tolerance = Tolerance,
                max_iterations = MaxIterations,
                surface_form = SurfaceForm,
                memory_limit = MemoryLimit,
                strict = Strict ? 1u : 0u,
                offset = Offset,
                fit_distance = FitDistance,
                pin_weight = PinWeight,
            };
        }
    }
}
