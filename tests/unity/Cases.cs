// The tests of the engine-free half: Cases NAME CHARACTERS ROOT runs one of them, with the files of testing::engine and the
// project's folder; Cases --list names them.
using System;
using System.Collections.Generic;

internal static class Cases
{
    private static readonly Dictionary<string, Action<string, string>> All =
        new Dictionary<string, Action<string, string>>
        {
            { "dressed_as_in_rust", (characters, root) => Fittings.AsInRust(characters) },
            { "goes_along", (characters, root) => Fittings.GoesAlong(characters) },
            { "turned", (characters, root) => Fittings.Turned() },
            { "stopped", (characters, root) => Fittings.Stopped(characters) },
            { "refused_and_over_it", (characters, root) => Fittings.RefusedAndOverIt(characters) },
            { "joint_map", (characters, root) => Fittings.JointMap(characters) },
            { "no_library", (characters, root) => Fittings.NoLibrary(characters) },
            { "figures", (characters, root) => Figures.Placed(characters) },
            { "impossible_figures", (characters, root) => Figures.Impossible() },
            { "influences", (characters, root) => Parts.Weights() },
            { "pairs", (characters, root) => Parts.Pairs() },
            { "transforms", (characters, root) => Parts.Transforms() },
            { "package_tests", (characters, root) => Words.OfThePackage() },
            { "dials", (characters, root) => Words.Dials(root) },
            { "stages", (characters, root) => Words.AllStages() },
            { "troubleshooting", (characters, root) => Words.Sections(root) },
        };

    private static int Main(string[] words)
    {
        if (words[0] == "--list")
        {
            Console.WriteLine(string.Join("\n", All.Keys));
            return 0;
        }
        All[words[0]](words[1], words[2]);
        return 0;
    }
}
