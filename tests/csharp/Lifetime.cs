// Who owns what, and until when.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using Bespoke;

internal static class Lifetime
{
    public static void Dispose()
    {
        Session session = Inputs.Tube().Session();
        session.Run();
        session.Dispose();
        session.Dispose();
        Action[] calls =
        {
            () => Inputs.Tube().SetOn(session),
            () => session.Run(),
            () => session.RunAsync().GetAwaiter().GetResult(),
            () => session.Prepare(new CancellationTokenSource().Token),
            () => session.Step(),
            () => session.Reset(),
            () => session.Cancel(),
            () => session.Verify(),
            () => session.ReadGarmentVertices(),
            () => session.ReadDiagnostics(),
            () => session.ReadReport(),
            () => session.CreateControl(),
            () => session.Stage.ToString(),
            () => session.LastMessage.ToString(),
        };
        foreach (Action call in calls)
        {
            Check.Throws<ObjectDisposedException>(call);
        }
    }

    // The run is stopped, its task fails, and nothing is freed too early.
    public static void DisposeWhileRunning(string folder)
    {
        Inputs inputs = Inputs.Sample(folder);
        for (int round = 0; round < 6; round++)
        {
            Session session = inputs.Session();
            SessionControl control = session.CreateControl();
            Task task = session.RunAsync();
            while (control.ReadProgress().Stage < (Stage)(round % 3))
            {
                Thread.Sleep(1);
            }
            Thread.Sleep(20);
            session.Dispose();
            Check.Throws<ObjectDisposedException>(() => task.GetAwaiter().GetResult());
            Check.Same(task.Status, TaskStatus.Faulted, "status");
            control.Dispose();
        }
    }

    public static void ControlOutlives()
    {
        SessionControl control;
        using (Session session = Inputs.Tube().Session())
        {
            control = session.CreateControl();
            Check.Same(control.ReadProgress().Stage, Stage.Setup, "stage");
            session.Run();
        }
        Check.Same(control.ReadProgress().Stage, Stage.Done, "the last moment stays");
        control.Cancel();
        control.Dispose();
        control.Dispose();
        Check.Throws<ObjectDisposedException>(() => control.Cancel());
        Check.Throws<ObjectDisposedException>(() => control.ReadProgress());
    }

    // Sessions and controls that nobody disposes of, at all stages, while the collector works as hard as it can.
    public static void Finalisers()
    {
        Inputs inputs = Inputs.Tube();
        float[] expected = null;
        List<WeakReference> left = new List<WeakReference>();
        using (Timer collector = new Timer(ignored => GC.Collect(), null, 0, 1))
        {
            for (int round = 0; round < 40; round++)
            {
                expected = Leave(inputs, round % 5, expected, left);
            }
        }
        for (int k = 0; k < 5; k++)
        {
            GC.Collect();
            GC.WaitForPendingFinalizers();
        }
        // A conservative collector may take a number on the stack for one of them.
        int alive = left.Count(session => session.IsAlive);
        Check.That(alive < left.Count / 2, $"{alive} of {left.Count} sessions are still there");
    }

    private static float[] Leave(Inputs inputs, int how, float[] expected, List<WeakReference> left)
    {
        Session session = inputs.Session();
        left.Add(new WeakReference(session));
        SessionControl control = how == 1 ? session.CreateControl() : null;
        if (how == 2)
        {
            session.Prepare();
        }
        else if (how == 3)
        {
            Task task = session.RunAsync();
            control = session.CreateControl();
            session = null;
            // The task alone holds the session now.
            task.GetAwaiter().GetResult();
            Check.Same(control.ReadProgress().Stage, Stage.Done, "stage");
        }
        else if (how == 4)
        {
            session.Run();
            float[] found = session.ReadGarmentVertices();
            Check.SameBits(found, expected ?? found, "under the collector");
            return found;
        }
        return expected;
    }

    // Made in one thread, run in another, read in a third; many at a time; disposed of twice at once.
    public static void Threads()
    {
        Inputs inputs = Inputs.Tube();
        float[][] found = new float[16][];
        Parallel.For(0, found.Length, k =>
        {
            Session session = inputs.Session();
            session.SetOptions(new Options { Threads = 1 + (uint)k % 3 });
            found[k] = session.RunAsync().ContinueWith(ended => session.ReadGarmentVertices()).Result;
            Parallel.Invoke(session.Dispose, session.Dispose);
        });
        foreach (float[] other in found)
        {
            Check.SameBits(other, found[0], "in another thread");
        }
    }

    // Many sessions over one body and one garment, whose owners are gone before these run.
    public static void Shared()
    {
        Inputs inputs = Inputs.Tube();
        float[] expected;
        SharedAvatar avatar;
        SharedGarment garment;
        using (Session from = inputs.Session())
        {
            avatar = from.ShareAvatar();
            garment = from.ShareGarment();
            from.Run();
            expected = from.ReadGarmentVertices();
            Check.Throws<BespokeException>(() => from.UseAvatar(avatar));
        }
        Session[] sessions = Enumerable.Range(0, 6).Select(k => new Session()).ToArray();
        Check.Throws<BespokeException>(() => sessions[0].ShareAvatar());
        Check.Throws<BespokeException>(() => sessions[0].ShareGarment());
        Check.Throws<ArgumentNullException>(() => sessions[0].UseAvatar(null));
        Check.Throws<ArgumentNullException>(() => sessions[0].UseGarment(null));
        foreach (Session session in sessions)
        {
            session.SetOptions(new Options { Threads = 1 });
            session.UseAvatar(avatar);
            session.UseGarment(garment);
        }
        avatar.Dispose();
        avatar.Dispose();
        garment.Dispose();
        Check.Throws<ObjectDisposedException>(() => sessions[0].UseAvatar(avatar));
        Check.Throws<ObjectDisposedException>(() => sessions[0].UseGarment(garment));
        Parallel.ForEach(sessions, session =>
        {
            session.Run();
            Check.SameBits(session.ReadGarmentVertices(), expected, "of a shared avatar and garment");
            session.Dispose();
        });
    }
}
