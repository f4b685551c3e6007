// Diagnostics about the inputs or the result.
using System.Collections.Generic;

namespace Bespoke
{
    /// <summary>A vertex, triangle or bone of an input.</summary>
    public sealed class Element
    {
        internal Element(NativeElement native)
        {
            Subject = native.subject;
            Kind = native.kind;
            Index = checked((int)native.index);
        }

        /// <summary>The input that it belongs to; <see cref="Bespoke.Subject.Layer"/> plus k is layer k, and <see
        /// cref="Bespoke.Subject.Follower"/> plus k is follower k.</summary>
        public Subject Subject { get; }

        /// <summary>What it is.</summary>
        public ElementKind Kind { get; }

        /// <summary>The caller's index, from 0.</summary>
        public int Index { get; }

        /// <summary>The layer that it belongs to, from 0; null where it belongs to something else.</summary>
        public int? Layer
        {
            get
            {
                bool isLayer = Subject >= Subject.Layer && Subject < Subject.Follower;
                return isLayer ? (int?)(Subject - Subject.Layer) : null;
            }
        }

        /// <summary>The follower that it belongs to, from 0; null where it belongs to something else.</summary>
        public int? Follower
        {
            get { return Subject >= Subject.Follower ? (int?)(Subject - Subject.Follower) : null; }
        }
    }

    /// <summary>A diagnostic about the inputs or the result.</summary>
    public sealed class Diagnostic
    {
        internal unsafe Diagnostic(NativeDiagnostic* native)
        {
            Kind = native->kind;
            Severity = native->severity;
            Element[] elements = new Element[native->element_count];
            NativeElement* first = &native->elements.item0;
            for (int k = 0; k < elements.Length; k++)
            {
                elements[k] = new Element(first[k]);
            }
            Elements = elements;
            Distance = native->distance;
            Message = Utf8.Read(native->message, NativeConstants.MessageSize);
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
        public string Message { get; }
    }
}
