// The words and defaults that all hosts share.
using System;
using System.IO;
using System.Linq;
using Bespoke;
using Bespoke.Unity;

internal static class Words
{
    // The dials begin where the library does, and 0 is off.
    public static void Dials(string root)
    {
        Options defaults = Options.ReadDefaults();
        Options dials = new Dials().ToOptions();
        Check.Same(dials.FitWeight, defaults.FitWeight, "fit");
        Check.Same(dials.DesignedClearance, defaults.DesignedClearance, "looseness");
        Check.Same(dials.Offset, defaults.Offset, "offset");
        Check.Same(dials.FitDistance, defaults.FitDistance, "fit distance");
        Check.Same(dials.WeldDistance, defaults.WeldDistance, "weld distance");
        Check.Same(dials.KeepCaps, defaults.KeepCaps, "caps");
        Check.Same(dials.Strict, defaults.Strict, "strict");
        Dials off = new Dials { Fit = 0, Looseness = 0, FitDistance = 0, WeldDistance = 0, Threads = -3 };
        Options none = off.ToOptions();
        double[] weights = { none.FitWeight, none.DesignedClearance, none.FitDistance, none.WeldDistance };
        Check.That(weights.All(weight => weight == Options.WeightOff), string.Join(" ", weights));
        Check.Same(none.Threads, 0u, "threads");
        using (Session session = new Session())
        {
            session.SetOptions(none);
            session.SetOptions(new Dials { Offset = 0.01, Threads = 2 }.ToOptions());
        }
        // They are the program's: `--fit`, `--looseness`, `--offset`.
        string program = File.ReadAllText(Path.Combine(root, "docs/program.md"));
        foreach (string dial in new[] { "Fit", "Looseness", "Offset" })
        {
            Check.That(typeof(Dials).GetField(dial) != null, $"{dial} is a dial");
            Check.That(program.Contains($"`--{dial.ToLowerInvariant()}`"), $"--{dial} is an option of the program");
        }
    }

    public static void AllStages()
    {
        Stage[] order = { Stage.Setup, Stage.Prepared, Stage.Inflate, Stage.Repose, Stage.Fit, Stage.Verify, Stage.Done };
        double last = 0;
        foreach (Stage stage in order)
        {
            double begin = Stages.Share(stage, 0, 0);
            double end = Stages.Share(stage, 1, 1000);
            Check.That(begin >= last - 1e-12 && end >= begin && end <= 1, $"{stage}: {begin} to {end} after {last}");
            last = end;
        }
        Check.Same(last, 1.0, "done");
        foreach (Stage stage in Enum.GetValues(typeof(Stage)))
        {
            Check.That(Stages.Words(stage) != "", $"{stage} has no words");
        }
    }

    // What Unity's own runner would run, all of it.
    public static void OfThePackage()
    {
        var tests = typeof(Bespoke.Unity.Tests.PackageTests).GetMethods()
            .Where(method => method.IsDefined(typeof(NUnit.Framework.TestAttribute), false)).ToArray();
        Check.Same(tests.Length, 2, "tests");
        foreach (var test in tests)
        {
            test.Invoke(new Bespoke.Unity.Tests.PackageTests(), null);
        }
    }

    // Every status leads to a section of the page.
    public static void Sections(string root)
    {
        string page = File.ReadAllText(Path.Combine(root, "docs/troubleshooting.md"));
        foreach (Status status in Enum.GetValues(typeof(Status)))
        {
            string anchor = Troubleshooting.Anchor(status);
            string section = Troubleshooting.Section(page, anchor);
            Check.That(status == Status.Ok || section.Length > 80, $"{anchor}: {section}");
            Check.That(!section.Contains("\n## "), $"{anchor} goes on into the next section");
        }
        Check.Same(Troubleshooting.Anchor(Status.NotEnclosed), "bespoke_status_not_enclosed", "an anchor");
        Check.That(Troubleshooting.Section(page, Troubleshooting.Warnings).Length > 80, "warnings");
        Check.Same(Troubleshooting.Section(page, "nothing-like-it"), "", "none");
    }
}
