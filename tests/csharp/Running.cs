// Tasks, steps, progress and cancel.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using Bespoke;

internal static class Running
{
    // Machines that run tests are busy: far above what is promised, and far below a run that is not stopped.
    private static readonly TimeSpan Prompt = TimeSpan.FromSeconds(1);

    private sealed class Listener : IProgress<SessionProgress>
    {
        public readonly List<SessionProgress> Heard = new List<SessionProgress>();
        private readonly Action<SessionProgress> react;

        public Listener(Action<SessionProgress> react = null)
        {
            this.react = react;
        }

        public void Report(SessionProgress progress)
        {
            Heard.Add(progress);
            react?.Invoke(progress);
        }
    }

    // It arrives on the way, goes forwards only, not too often, and the run gives the same bits with it.
    public static void Progress(string folder)
    {
        using (Session session = Inputs.Sample(folder).Session())
        {
            session.SetOptions(new Options { MaxIterations = 40 });
            Listener listener = new Listener();
            Stopwatch clock = Stopwatch.StartNew();
            session.RunAsync(listener).GetAwaiter().GetResult();
            double seconds = clock.Elapsed.TotalSeconds;
            float[] heard = session.ReadGarmentVertices();

            Stage[] stages = listener.Heard.Select(p => p.Stage).ToArray();
            Check.That(stages.SequenceEqual(stages.OrderBy(stage => stage)), "stages go forwards");
            Check.That(stages.First() == Stage.Setup && stages.Last() == Stage.Done, "from the first to the last");
            Check.That(stages.Contains(Stage.Inflate) && stages.Contains(Stage.Fit), "what is between is seen");
            double[] t = listener.Heard.Select(p => p.T).ToArray();
            Check.That(t.SequenceEqual(t.OrderBy(x => x)) && t.Last() == 1.0, "t grows");
            Check.That(stages.Length <= 4 + 20 * seconds, $"{stages.Length} reports in {seconds} s");
            Check.That(stages.Length >= 5, $"{stages.Length} reports");

            session.Reset();
            session.Run();
            Check.SameBits(session.ReadGarmentVertices(), heard, "without progress");

            // Who throws in a report ends the call; the next one goes on.
            session.Reset();
            Listener thrower = new Listener(progress => { throw new Failed("enough"); });
            Check.Throws<Failed>(() => session.Run(thrower));
            session.Run();
            Check.SameBits(session.ReadGarmentVertices(), heard, "after a report that threw");
        }
    }

    // By hand, an iteration at a time.
    public static void Steps()
    {
        using (Session session = Inputs.Tube().Session())
        {
            session.Run();
            float[] expected = session.ReadGarmentVertices();
            session.Reset();
            session.Prepare();
            Check.Same(session.Stage, Stage.Prepared, "stage");
            int steps = 0;
            while (session.Step(1) != Stage.Done)
            {
                steps++;
                Check.That(session.ReadGarmentVertices().All(x => Math.Abs(x) < 2f), "a preview");
            }
            Check.That(steps > 5, $"{steps} steps");
            Check.SameBits(session.ReadGarmentVertices(), expected, "in steps");
            Check.Throws<ArgumentOutOfRangeException>(() => session.Step(-1));
            Check.Throws<ArgumentOutOfRangeException>(() => session.Step(0, -1));
        }
    }

    // The task is cancelled, with its token; the session can be reset and then runs to the end.
    public static void CancelByToken(string folder)
    {
        using (Session session = Inputs.Sample(folder).Session())
        using (CancellationTokenSource stop = new CancellationTokenSource())
        {
            Stopwatch clock = new Stopwatch();
            Listener listener = new Listener(progress =>
            {
                if (progress.Stage == Stage.Fit && !stop.IsCancellationRequested)
                {
                    clock.Start();
                    stop.Cancel();
                }
            });
            Task task = session.RunAsync(listener, stop.Token);
            OperationCanceledException thrown = Cancelled(task);
            Check.That(clock.IsRunning && clock.Elapsed < Prompt, $"it took {clock.Elapsed}");
            Check.That(thrown.CancellationToken == stop.Token, "the exception has the token");
            Check.Same(session.Stage, Stage.Cancelled, "stage");
            Check.That(session.ReadGarmentVertices().All(x => !float.IsNaN(x)), "what was reached can be read");
            Check.Refused(Status.InvalidState, () => session.Run(), "reset");

            // A token that is cancelled already: nothing begins, and no request is left.
            session.Reset();
            Cancelled(session.RunAsync(null, stop.Token));
            Check.That(Check.Throws<OperationCanceledException>(() => session.Prepare(stop.Token)).CancellationToken ==
                stop.Token, "the exception has the token");
            Check.Throws<OperationCanceledException>(() => session.Step(1, 0, stop.Token));
            Check.Same(session.Stage, Stage.Setup, "stage");
            session.SetOptions(new Options { MaxIterations = 40 });
            session.RunAsync().GetAwaiter().GetResult();
            Check.Same(session.Stage, Stage.Done, "stage");
        }
    }

    // From another thread, at random, also while it prepares; the result of the next run has the same bits.
    public static void CancelAtAnyMoment()
    {
        using (Session session = Inputs.Tube().Session())
        {
            Stopwatch clock = Stopwatch.StartNew();
            session.Run();
            double whole = clock.Elapsed.TotalMilliseconds;
            float[] expected = session.ReadGarmentVertices();
            Random random = new Random(7);
            int stopped = 0;
            for (int round = 0; round < 40; round++)
            {
                session.Reset();
                using (CancellationTokenSource stop = new CancellationTokenSource())
                {
                    Task task = session.RunAsync(round % 2 == 0 ? new Listener() : null, stop.Token);
                    Thread.Sleep((int)(random.NextDouble() * whole));
                    stop.Cancel();
                    try
                    {
                        task.GetAwaiter().GetResult();
                        Check.Same(session.Stage, Stage.Done, "stage");
                    }
                    catch (OperationCanceledException)
                    {
                        Check.Same(task.Status, TaskStatus.Canceled, "status");
                        stopped++;
                    }
                }
            }
            Check.That(stopped > 5, $"{stopped} of 40 runs were stopped");
            session.Reset();
            session.Run();
            Check.SameBits(session.ReadGarmentVertices(), expected, "after all that");
        }
    }

    // By the session itself, and by a control.
    public static void CancelWithoutToken(string folder)
    {
        using (Session session = Inputs.Sample(folder).Session())
        using (SessionControl control = session.CreateControl())
        {
            foreach (Action cancel in new Action[] { session.Cancel, control.Cancel })
            {
                Task task = session.RunAsync();
                while (control.ReadProgress().Stage < Stage.Inflate)
                {
                    Thread.Sleep(1);
                }
                Stopwatch clock = Stopwatch.StartNew();
                cancel();
                OperationCanceledException thrown = Cancelled(task);
                Check.That(clock.Elapsed < Prompt, $"it took {clock.Elapsed}");
                Check.That(thrown.Message.Length > 0, "there is a sentence");
                Check.Same(session.Stage, Stage.Cancelled, "stage");
                session.Reset();
            }
            // A request before the call: the next one answers it, and it stays until a reset.
            session.Cancel();
            Check.Throws<OperationCanceledException>(() => session.Prepare());
            Check.Throws<OperationCanceledException>(() => session.Prepare());
            session.Reset();
            session.Prepare();
        }
    }

    // What a run throws is what its task throws.
    public static void TaskFailures()
    {
        using (Session session = new Session())
        {
            Task task = session.RunAsync();
            Check.Refused(Status.InvalidState, () => task.GetAwaiter().GetResult(), "garment");
            Check.Same(task.Status, TaskStatus.Faulted, "status");
        }
    }

    private static OperationCanceledException Cancelled(Task task)
    {
        try
        {
            task.GetAwaiter().GetResult();
        }
        catch (OperationCanceledException thrown)
        {
            Check.Same(task.Status, TaskStatus.Canceled, "status");
            return thrown;
        }
        throw new Failed("the task was not cancelled");
    }
}
