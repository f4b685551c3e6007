// What is worth knowing about the inputs or the result.
using System.Collections.Generic;

namespace Bespoke
{
    /// <summary>What a diagnostic is about.</summary>
    public enum DiagnosticKind : uint
    {
        /// <summary>
        /// Garment vertices in one place, as along UV seams, that move as one. The first of them are named.
        /// </summary>
        SplitVertices = 1,

        /// <summary>A garment triangle with the corners of another, which counts once. Both are named.</summary>
        DuplicateTriangle = 2,

        /// <summary>A garment triangle without area.</summary>
        DegenerateTriangle = 3,

        /// <summary>A garment edge with more than two triangles. Its vertices are named.</summary>
        NonManifoldEdge = 4,

        /// <summary>A garment vertex that no triangle uses.</summary>
        UnusedVertex = 5,

        /// <summary>A small piece of the garment, such as a button, that is held to the piece beside it.</summary>
        LoosePiece = 6,

        /// <summary>
        /// Two garment triangles that pass through each other, or touch, before anything has moved. They are let off
        /// until they have come apart.
        /// </summary>
        SelfIntersection = 7,

        /// <summary>
        /// Parts of the garment, or garment and shrunk avatar, that are very near at the start. The garment's vertices
        /// are named.
        /// </summary>
        NearContact = 8,

        /// <summary>The avatar, shrunk onto the source skeleton, passes through the garment.</summary>
        AvatarPokes = 9,

        /// <summary>
        /// The coordinates in which the result is read are coarse, and the garment keeps a wider distance for it.
        /// </summary>
        CoarseCoordinates = 10,

        /// <summary>Two triangles that intersect in the result and did not at the start.</summary>
        ResultIntersection = 11,

        /// <summary>A pinned garment vertex ended away from its place.</summary>
        PinNotReached = 12,

        /// <summary>A rigid group of garment vertices ended bent, for something stands in its way.</summary>
        RigidGroupBent = 13,
    }

    /// <summary>How much a diagnostic matters.</summary>
    public enum Severity : uint
    {
        /// <summary>Good to know.</summary>
        Note = 1,

        /// <summary>The result may be worse for it.</summary>
        Warning = 2,

        /// <summary>There is no result because of it.</summary>
        Error = 3,
    }

    /// <summary>Which of the inputs an element belongs to.</summary>
    public enum Subject : uint
    {
        /// <summary>The garment.</summary>
        Garment = 1,

        /// <summary>The body to dress.</summary>
        TargetAvatar = 2,

        /// <summary>The body that the garment was designed on.</summary>
        SourceAvatar = 3,

        /// <summary>The skeleton that the garment was designed on.</summary>
        SourceSkeleton = 4,

        /// <summary>The skeleton of the body to dress.</summary>
        TargetSkeleton = 5,

        /// <summary>
        /// The first layer that was added with <see cref="Session.AddLayer"/>; layer k, counted from 0, is this plus k.
        /// See <see cref="Element.Layer"/>.
        /// </summary>
        Layer = 256,
    }

    /// <summary>What the index of an element counts.</summary>
    public enum ElementKind : uint
    {
        /// <summary>Vertices of a mesh.</summary>
        Vertex = 1,

        /// <summary>Triangles of a mesh.</summary>
        Triangle = 2,

        /// <summary>Bones of a skeleton.</summary>
        Bone = 3,
    }

    /// <summary>A vertex, triangle or bone of an input.</summary>
    public sealed class Element
    {
        internal Element(NativeElement native)
        {
            Subject = native.subject;
            Kind = native.kind;
            Index = checked((int)native.index);
        }

        /// <summary>The input that it belongs to; <see cref="Bespoke.Subject.Layer"/> plus k is layer k.</summary>
        public Subject Subject { get; }

        /// <summary>What it is.</summary>
        public ElementKind Kind { get; }

        /// <summary>The caller's index, from 0.</summary>
        public int Index { get; }

        /// <summary>The layer that it belongs to, from 0; null where it belongs to something else.</summary>
        public int? Layer
        {
            get { return Subject >= Subject.Layer ? (int?)(Subject - Subject.Layer) : null; }
        }
    }

    /// <summary>One thing worth knowing about the inputs or the result.</summary>
    public sealed class Diagnostic
    {
        internal unsafe Diagnostic(NativeDiagnostic* native)
        {
            Kind = native->kind;
            Severity = native->severity;
            Element[] elements = new Element[native->element_count];
            NativeElement* first = &native->elements.first;
            for (int k = 0; k < elements.Length; k++)
            {
                elements[k] = new Element(first[k]);
            }
            Elements = elements;
            Distance = native->distance;
            Sentence = Utf8.Read(native->sentence, NativeConstants.SentenceSize);
        }

        /// <summary>What it is about.</summary>
        public DiagnosticKind Kind { get; }

        /// <summary>How much it matters.</summary>
        public Severity Severity { get; }

        /// <summary>The elements that it is about, for a tool to select; at most four.</summary>
        public IReadOnlyList<Element> Elements { get; }

        /// <summary>
        /// A distance in the normalised space, in which the longest side of the skeleton's bounding box is 2; NaN where
        /// it has none.
        /// </summary>
        public double Distance { get; }

        /// <summary>One sentence.</summary>
        public string Sentence { get; }
    }
}
