// What to do where something fails: sections of the project's page about it, which lies in this package.
using System;
using System.Collections.Generic;
using System.Text;

namespace Bespoke.Unity
{
    /// <summary>The page docs/troubleshooting.md, which the package has in Documentation~.</summary>
    public static class Troubleshooting
    {
        /// <summary>Where the page lies in the package.</summary>
        public const string Page = "Documentation~/troubleshooting.md";

        /// <summary>The anchor of the section about warnings.</summary>
        public const string Warnings = "results-with-a-warning";

        /// <summary>The anchor of the section about a status, such as "bespoke_status_not_enclosed".</summary>
        /// <param name="status">The status.</param>
        /// <returns>The anchor.</returns>
        public static string Anchor(Status status)
        {
            StringBuilder anchor = new StringBuilder("bespoke_status");
            foreach (char letter in status.ToString())
            {
                if (char.IsUpper(letter))
                {
                    anchor.Append('_');
                }
                anchor.Append(char.ToLowerInvariant(letter));
            }
            return anchor.ToString();
        }

        /// <summary>The text below a heading.</summary>
        /// <param name="page">The whole page.</param>
        /// <param name="anchor">That of the heading.</param>
        /// <returns>Heading and text; empty where there is no such heading.</returns>
        public static string Section(string page, string anchor)
        {
            StringBuilder section = new StringBuilder();
            bool isInside = false;
            foreach (string line in page.Replace("\r", "").Split('\n'))
            {
                if (line.StartsWith("## ", StringComparison.Ordinal))
                {
                    isInside = AnchorOf(line.Substring(3)) == anchor;
                }
                if (isInside)
                {
                    section.Append(line.StartsWith("## ", StringComparison.Ordinal) ? line.Substring(3) : line).Append('\n');
                }
            }
            return section.ToString().Trim();
        }

        private static string AnchorOf(string heading)
        {
            List<char> anchor = new List<char>();
            foreach (char letter in heading.Trim())
            {
                if (letter == ' ')
                {
                    anchor.Add('-');
                }
                else if (char.IsLetterOrDigit(letter) || letter == '_' || letter == '-')
                {
                    anchor.Add(char.ToLowerInvariant(letter));
                }
            }
            return new string(anchor.ToArray());
        }
    }
}
