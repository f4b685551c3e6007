// Dress: dresses an avatar in a garment that was modelled on another body, all of them OBJ files.
//
//   Dress garment.obj source-skeleton.obj avatar.obj target-skeleton.obj dressed.obj
using System;
using System.IO;
using System.Threading;
using System.Threading.Tasks;
using Bespoke;

internal static class Dress
{
    private static int Main(string[] paths)
    {
        if (paths.Length != 5)
        {
            Console.Error.WriteLine(
                "usage: Dress garment.obj source-skeleton.obj avatar.obj target-skeleton.obj dressed.obj");
            return 2;
        }
        using (CancellationTokenSource stop = new CancellationTokenSource())
        {
            Console.CancelKeyPress += (sender, key) =>
            {
                key.Cancel = true;
                stop.Cancel();
            };
            try
            {
                Work(paths, stop.Token).GetAwaiter().GetResult();
                return 0;
            }
            catch (OperationCanceledException)
            {
                Console.Error.WriteLine("Dress: stopped; nothing was written");
                return 130;
            }
            catch (BespokeException failure)
            {
                Console.Error.WriteLine($"Dress: {failure.Message} ({failure.Status})");
                return 1;
            }
            catch (Exception failure) when (
                failure is IOException || failure is UnauthorizedAccessException || failure is DllNotFoundException ||
                failure is BadImageFormatException || failure is InvalidDataException)
            {
                Console.Error.WriteLine($"Dress: {failure.Message}");
                return 1;
            }
        }
    }

    private static async Task Work(string[] paths, CancellationToken token)
    {
        Obj garment = Obj.Read(paths[0]);
        Obj source = Obj.Read(paths[1]);
        Obj avatar = Obj.Read(paths[2]);
        Obj target = Obj.Read(paths[3]);
        using (Session session = new Session())
        {
            session.SetGarment(garment.Positions, garment.Triangles);
            session.SetSourceSkeleton(source.Positions, source.Bones);
            session.SetTargetAvatar(avatar.Positions, avatar.Triangles);
            session.SetTargetSkeleton(target.Positions, target.Bones);
            await session.RunAsync(new Printer(), token).ConfigureAwait(false);
            foreach (Diagnostic diagnostic in session.ReadDiagnostics())
            {
                if (diagnostic.Severity != Severity.Note)
                {
                    Console.Error.WriteLine($"{diagnostic.Severity}: {diagnostic.Message}");
                }
            }
            garment.Write(paths[4], session.ReadGarmentVertices());
            Report report = session.ReadReport();
            Console.WriteLine(
                $"{paths[4]}: verified, {report.GarmentIntersections} + {report.AvatarIntersections} intersections");
        }
    }

    // A line for each stage. Progress<T> would print in threads of the pool, not always in order.
    private sealed class Printer : IProgress<SessionProgress>
    {
        private Stage? last;

        public void Report(SessionProgress progress)
        {
            if (progress.Stage != last)
            {
                last = progress.Stage;
                Console.WriteLine(progress.Stage.ToString().ToLowerInvariant());
            }
        }
    }
}
