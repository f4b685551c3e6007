// The tests of the binding as its callers see it: Cases NAME FOLDER runs one of them, with the files that
// tests/csharp/main.rs has written; Cases --list names them. Compiled without -unsafe, against the assembly.
using System;
using System.Collections.Generic;

internal static class Cases
{
    private static readonly Dictionary<string, Action<string>> All = new Dictionary<string, Action<string>>
    {
        { "sample_is_dressed", Dressing.SampleIsDressed },
        { "arrays_of_every_shape", folder => Dressing.ArraysOfEveryShape() },
        { "every_input", folder => Dressing.EveryInput() },
        { "every_result", folder => Dressing.EveryResult() },
        { "coordinate_systems", folder => Dressing.CoordinateSystems() },
        { "rigs", folder => Rigs.All() },
        { "versions_and_names", folder => Errors.Library() },
        { "bad_arguments", folder => Errors.Arguments() },
        { "wrong_states", folder => Errors.States() },
        { "busy", folder => Errors.Busy() },
        { "progress", Running.Progress },
        { "steps", folder => Running.Steps() },
        { "cancel_by_token", Running.CancelByToken },
        { "cancel_at_any_moment", folder => Running.CancelAtAnyMoment() },
        { "cancel_without_token", Running.CancelWithoutToken },
        { "failure_of_a_task", folder => Running.TaskFailures() },
        { "dispose", folder => Lifetime.Dispose() },
        { "dispose_while_running", Lifetime.DisposeWhileRunning },
        { "control_outlives_session", folder => Lifetime.ControlOutlives() },
        { "finalisers", folder => Lifetime.Finalisers() },
        { "threads", folder => Lifetime.Threads() },
        { "shared", folder => Lifetime.Shared() },
        { "other_interface", folder => Errors.OtherInterface() },
        { "no_library", folder => Errors.NoLibrary() },
    };

    private static int Main(string[] words)
    {
        if (words[0] == "--list")
        {
            Console.WriteLine(string.Join("\n", All.Keys));
            return 0;
        }
        All[words[0]](words[1]);
        return 0;
    }
}
