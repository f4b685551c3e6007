// The way from the inputs to a verified result.
using System;
using System.Threading;
using System.Threading.Tasks;

namespace Bespoke
{
    public sealed partial class Session
    {
        // Time between two reports: a person sees it move, and nobody is kept busy by it.
        private const uint ReportMilliseconds = 50;

        /// <summary>
        /// Checks the inputs against each other and shrinks the avatar onto the source skeleton.
        /// <see cref="Stage.Setup"/> becomes <see cref="Stage.Prepared"/>; where it fails or is cancelled, the session
        /// stays in Setup and keeps its inputs. Diagnostics about the inputs can be read with
        /// <see cref="ReadDiagnostics"/>, also where it fails. State: Setup, with garment, both skeletons and target
        /// avatar set.
        /// </summary>
        /// <param name="token">Cancelled: so is the session.</param>
        /// <exception cref="BespokeException">InvalidState, InvalidArgument (a voxel too small for the avatar),
        /// InvalidMesh (also: too far from the origin for its precision), InvalidSkeleton (another topology),
        /// InvalidWeights (a wrong size), SelfIntersection (with the option Strict), NotEnclosed, MemoryLimit, NoThread, Busy,
        /// Internal.</exception>
        /// <exception cref="OperationCanceledException">Cancelled by the caller.</exception>
        public void Prepare(CancellationToken token = default(CancellationToken))
        {
            using (Watch(token))
            {
                Check(Native.bespoke_session_prepare(handle), token);
            }
        }

        /// <summary>
        /// Continues the run until it ends or the budget is spent, whichever is first. The budget is checked after each
        /// iteration, so a step does at least one and may take somewhat longer. At <see cref="Stage.Done"/> the result
        /// is verified; until then what can be read is a preview. State: Prepared, Inflate or Fit.
        /// </summary>
        /// <param name="maxIterations">Iterations at most; 0: no limit.</param>
        /// <param name="maxMilliseconds">Time; 0: no limit.</param>
        /// <param name="token">Cancelled: so is the session.</param>
        /// <returns>The stage afterwards.</returns>
        /// <exception cref="BespokeException">InvalidState (a session that has ended continues only after
        /// <see cref="Reset"/>), InflationStalled, NotVerified, ImplausibleResult (the stage is Done, and the result can be
        /// read), MemoryLimit, Busy, Internal.</exception>
        /// <exception cref="OperationCanceledException">Cancelled by the caller.</exception>
        public unsafe Stage Step(
            int maxIterations = 0, int maxMilliseconds = 0, CancellationToken token = default(CancellationToken))
        {
            if (maxIterations < 0)
            {
                throw new ArgumentOutOfRangeException(nameof(maxIterations), "A budget is 0, for no limit, or more.");
            }
            if (maxMilliseconds < 0)
            {
                throw new ArgumentOutOfRangeException(nameof(maxMilliseconds), "A budget is 0, for no limit, or more.");
            }
            using (Watch(token))
            {
                Stage stage = Stage.Setup;
                Check(Native.bespoke_session_step(handle, (uint)maxIterations, (uint)maxMilliseconds, &stage), token);
                return stage;
            }
        }

        /// <summary>
        /// Fits a result again: with other options, and with the fit weights and pins that were set since.
        /// <see cref="Step"/> or <see cref="Run"/> then go on from the result, in a small part of the time where little has
        /// changed. State: <see cref="Stage.Done"/>, or <see cref="Stage.Fit"/> after it.
        /// </summary>
        /// <param name="options">All of them; those that are used before the fit have to stay as they were.</param>
        /// <exception cref="BespokeException">InvalidArgument (an option out of its range or one that has to stay, which the
        /// message names), InvalidWeights, InvalidState, after all of which the result stays; MemoryLimit, Cancelled, Busy,
        /// Internal.</exception>
        public unsafe void Refit(Options options)
        {
            NativeOptions native = NotNull(options, nameof(options)).ToNative();
            Check(Native.bespoke_session_refit(handle, &native));
        }

        /// <summary>
        /// Runs the session to its end: prepares where needed, then steps. When it returns, the session is
        /// <see cref="Stage.Done"/> and the result verified. State: as for <see cref="Prepare"/> or <see cref="Step"/>.
        /// </summary>
        /// <param name="progress">Called at most some twenty times a second, in this thread, and a last time when the
        /// session is done. What it throws ends this call; another one continues from there.</param>
        /// <param name="token">Cancelled: so is the session.</param>
        /// <exception cref="BespokeException">As for both.</exception>
        /// <exception cref="OperationCanceledException">Cancelled by the caller.</exception>
        public void Run(
            IProgress<SessionProgress> progress = null, CancellationToken token = default(CancellationToken))
        {
            using (Watch(token))
            {
                if (progress == null)
                {
                    Check(Native.bespoke_session_run(handle), token);
                }
                else
                {
                    RunInSteps(progress, token);
                }
            }
        }

        /// <summary>
        /// The same as <see cref="Run"/> in a thread of its own. The task is cancelled where the token was, or by
        /// <see cref="Cancel"/>; it fails with the exceptions of Run. The library works in threads of its own: that of
        /// the task only waits.
        /// </summary>
        /// <param name="progress">Called at most some twenty times a second, in the thread of the task;
        /// <see cref="Progress{T}"/> takes it to the thread that it was made in.</param>
        /// <param name="token">Cancelled: so is the session, at once also while it prepares.</param>
        /// <returns>The task. Until it has ended, other calls of this session find it busy.</returns>
        public async Task RunAsync(
            IProgress<SessionProgress> progress = null, CancellationToken token = default(CancellationToken))
        {
            // Not a thread of the pool, which would be missed for seconds. A method that is async takes every
            // OperationCanceledException for a task that is cancelled, one without the token as well.
            await Task.Factory.StartNew(
                () => Run(progress, token),
                token,
                TaskCreationOptions.LongRunning | TaskCreationOptions.DenyChildAttach,
                TaskScheduler.Default).ConfigureAwait(false);
        }

        private unsafe void RunInSteps(IProgress<SessionProgress> progress, CancellationToken token)
        {
            SessionProgress now = ReadProgress();
            progress.Report(now);
            if (now.Stage == Stage.Setup)
            {
                Check(Native.bespoke_session_prepare(handle), token);
                progress.Report(ReadProgress());
            }
            for (Stage stage = Stage.Prepared; stage != Stage.Done;)
            {
                Check(Native.bespoke_session_step(handle, 0, ReportMilliseconds, &stage), token);
                progress.Report(ReadProgress());
            }
        }

        // Asks to stop where the token is cancelled, until it is disposed of.
        private CancellationTokenRegistration Watch(CancellationToken token)
        {
            // A request to stop stays until Reset: it is not made where nothing has begun.
            token.ThrowIfCancellationRequested();
            return token.Register(session => ((Session)session).CancelUnlessDisposed(), this, false);
        }

        // Who cancels a token expects it back in the exception.
        private void Check(Status status, CancellationToken token)
        {
            try
            {
                Check(status);
            }
            catch (OperationCanceledException cancelled) when (token.IsCancellationRequested)
            {
                throw new OperationCanceledException(cancelled.Message, token);
            }
        }
    }
}
