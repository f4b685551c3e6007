// What a session has done so far.
namespace Bespoke
{
    /// <summary>The work of one stage.</summary>
    public sealed class StageReport
    {
        internal StageReport(NativeStageReport native)
        {
            Seconds = native.seconds;
            Iterations = checked((int)native.iterations);
            Factorisations = checked((int)native.factorisations);
            SymbolicFactorisations = checked((int)native.symbolic_factorisations);
        }

        /// <summary>Wall-clock seconds.</summary>
        public double Seconds { get; }

        /// <summary>Newton iterations.</summary>
        public int Iterations { get; }

        /// <summary>Numeric factorisations.</summary>
        public int Factorisations { get; }

        /// <summary>Symbolic factorisations.</summary>
        public int SymbolicFactorisations { get; }
    }

    /// <summary>
    /// Measurements of a session so far. Lengths are in the normalised space, in which the longest side of the
    /// skeleton's bounding box is 2.
    /// </summary>
    public sealed class Report
    {
        internal unsafe Report(NativeReport* native)
        {
            Threads = checked((int)native->threads);
            Prepare = new StageReport(native->prepare);
            Inflate = new StageReport(native->inflate);
            Fit = new StageReport(native->fit);
            Repose = new StageReport(native->repose);
            RigSeconds = native->rig_seconds;
            VerifySeconds = native->verify_seconds;
            FieldSeconds = native->field_seconds;
            T = native->t;
            GradientNorm = native->gradient_norm;
            GarmentDistance = native->garment_distance;
            AvatarDistance = native->avatar_distance;
            ActiveContacts = checked((long)native->active_contacts);
            GarmentIntersections = checked((long)native->garment_intersections);
            AvatarIntersections = checked((long)native->avatar_intersections);
            GarmentVertices = checked((long)native->garment_vertices);
            GarmentTriangles = checked((long)native->garment_triangles);
            AvatarVertices = checked((long)native->avatar_vertices);
            AvatarTriangles = checked((long)native->avatar_triangles);
            SubdividedAvatarVertices = checked((long)native->subdivided_avatar_vertices);
            SubdividedAvatarTriangles = checked((long)native->subdivided_avatar_triangles);
            MinSeparation = native->min_separation;
            IsVerified = native->is_verified != 0;
            IsConverged = native->is_converged != 0;
            EnergyCount = checked((int)native->energy_count);
            MemoryBytes = checked((long)native->memory_bytes);
            InitialSelfIntersections = checked((long)native->initial_self_intersections);
        }

        /// <summary>Threads that the session works with.</summary>
        public int Threads { get; }

        /// <summary>Cost of prepare.</summary>
        public StageReport Prepare { get; }

        /// <summary>Cost of inflate.</summary>
        public StageReport Inflate { get; }

        /// <summary>Cost of fit.</summary>
        public StageReport Fit { get; }

        /// <summary>
        /// Cost of repose, where the target is brought back from the pose of the design to its own; its seconds have
        /// those in which the body there was prepared.
        /// </summary>
        public StageReport Repose { get; }

        /// <summary>
        /// Wall-clock seconds in which two rigs were read and matched, and the target was posed; they are part of
        /// <see cref="Prepare"/>'s.
        /// </summary>
        public double RigSeconds { get; }

        /// <summary>Wall-clock seconds of the exact verifier.</summary>
        public double VerifySeconds { get; }

        /// <summary>Seconds until the distance field was built, in parallel with inflate.</summary>
        public double FieldSeconds { get; }

        /// <summary>Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.</summary>
        public double T { get; }

        /// <summary>Euclidean norm of the objective's gradient.</summary>
        public double GradientNorm { get; }

        /// <summary>Smallest distance of the garment to itself; infinite where no pair is near.</summary>
        public double GarmentDistance { get; }

        /// <summary>
        /// Smallest distance of the garment to the avatar and its layers; infinite where no pair is near.
        /// </summary>
        public double AvatarDistance { get; }

        /// <summary>Contact pairs closer than <see cref="Options.Dhat"/>.</summary>
        public long ActiveContacts { get; }

        /// <summary>Intersecting pairs within the garment that the verifier found.</summary>
        public long GarmentIntersections { get; }

        /// <summary>Intersecting pairs of garment and avatar, its layers included, that the verifier found.</summary>
        public long AvatarIntersections { get; }

        /// <summary>Vertices of the garment.</summary>
        public long GarmentVertices { get; }

        /// <summary>Triangles of the garment.</summary>
        public long GarmentTriangles { get; }

        /// <summary>Vertices of the target avatar, here and below without its layers.</summary>
        public long AvatarVertices { get; }

        /// <summary>Triangles of the target avatar.</summary>
        public long AvatarTriangles { get; }

        /// <summary>Vertices of the target avatar once its triangles over several bones are split.</summary>
        public long SubdividedAvatarVertices { get; }

        /// <summary>Triangles of the target avatar once those over several bones are split.</summary>
        public long SubdividedAvatarTriangles { get; }

        /// <summary>
        /// The minimum separation in force: the option's; less while something is nearer than that, more where the
        /// coordinates of the result are coarse.
        /// </summary>
        public double MinSeparation { get; }

        /// <summary>Whether the verifier has checked the result.</summary>
        public bool IsVerified { get; }

        /// <summary>Whether the fit ended by its tolerance, and not by the limit of iterations, where no step made it better, or not at all.</summary>
        public bool IsConverged { get; }

        /// <summary>Number of energy terms; see <see cref="Session.ReadEnergy"/>.</summary>
        public int EnergyCount { get; }

        /// <summary>Bytes that the session's arrays take, without what the threads and the allocator add.</summary>
        public long MemoryBytes { get; }

        /// <summary>
        /// Intersecting or touching pairs within the garment at the start, which are exempted from contact until they
        /// separate.
        /// </summary>
        public long InitialSelfIntersections { get; }
    }

    /// <summary>One term of the objective.</summary>
    public sealed class Energy
    {
        internal unsafe Energy(NativeEnergy* native)
        {
            Name = Utf8.Read(native->name, NativeConstants.EnergyNameSize);
            Value = native->value;
            Weight = native->weight;
        }

        /// <summary>Name, such as "surface".</summary>
        public string Name { get; }

        /// <summary>Value without its weight.</summary>
        public double Value { get; }

        /// <summary>Weight; the term adds weight times value to the objective.</summary>
        public double Weight { get; }
    }

    /// <summary>Pairs of triangles that touch or cross each other.</summary>
    public sealed class Intersections
    {
        internal Intersections(NativeIntersections native)
        {
            GarmentGarment = checked((long)native.garment_garment);
            Initial = checked((long)native.initial);
            GarmentAvatar = checked((long)native.garment_avatar);
        }

        /// <summary>Of the garment with itself.</summary>
        public long GarmentGarment { get; }

        /// <summary>
        /// Those of them that intersected or touched at the start, too: a garment with initial self-intersections may
        /// keep some of them.
        /// </summary>
        public long Initial { get; }

        /// <summary>Of the garment with the avatar or its layers.</summary>
        public long GarmentAvatar { get; }
    }
}
