// The fitting itself: garments one over the other on one body. Knows nothing of the engine.
using System;
using System.Collections.Generic;
using System.Threading;
using System.Threading.Tasks;

namespace Bespoke.Unity
{
    /// <summary>All that is to be done.</summary>
    public sealed class FittingTask
    {
        /// <summary>For each garment, innermost first, the character that it was made for: the garment is its part 0, then comes
        /// what goes along with it, and the body, where there is one, is the parts after that.</summary>
        public readonly List<Figure> Garments = new List<Figure>();

        /// <summary>For each garment, how many parts go along with it without being fitted, such as levels of detail; fewer
        /// entries: none.</summary>
        public readonly List<int> Followers = new List<int>();

        /// <summary>The character to dress: its body, in the space of the result.</summary>
        public Figure Target;

        /// <summary>For each garment, joints that correspond: see <see cref="JointPairs"/>; null: names and places say it.</summary>
        public readonly List<int[]> Pairs = new List<int[]>();

        /// <summary>How it is to fit.</summary>
        public Dials Dials = new Dials();

        /// <summary>Joints of a vertex of the result.</summary>
        public int Influences = 4;

        /// <summary>How many parts go along with a garment.</summary>
        /// <param name="garment">The garment, from 0.</param>
        /// <returns>How many.</returns>
        public int FollowersOf(int garment)
        {
            return garment < Followers.Count ? Followers[garment] : 0;
        }
    }

    /// <summary>A mesh on the other body.</summary>
    public class Worn
    {
        /// <summary>x, y, z of each vertex in the space of the target; null where it is not dressed.</summary>
        public float[] Positions;

        /// <summary>x, y, z of each vertex, of length 1.</summary>
        public float[] Normals;

        /// <summary>x, y, z and handedness of each vertex; null where the garment has none.</summary>
        public float[] Tangents;

        /// <summary>Its blend shapes, in their order.</summary>
        public readonly List<ShapeFrame> Frames = new List<ShapeFrame>();

        /// <summary>Its skin on the joints of the target and, after them, the added ones; null where the body has
        /// none.</summary>
        public Influences Skin;
    }

    /// <summary>What became of one garment.</summary>
    public sealed class Outcome : Worn
    {
        /// <summary>What goes along with it, in the order of the task.</summary>
        public readonly List<Worn> Followers = new List<Worn>();

        /// <summary>Joints of its own that come along.</summary>
        public AddedJoint[] Added = new AddedJoint[0];

        /// <summary>What the library has to say.</summary>
        public Diagnostic[] Findings = new Diagnostic[0];

        /// <summary>Why it is not dressed, or with a result what is not as designed; null: all is well.</summary>
        public BespokeException Failure;

        /// <summary>Pairs of triangles that pass through each other in the result, by the exact verifier.</summary>
        public long Intersections;
    }

    /// <summary>
    /// A run over all garments. <see cref="Start"/> does it in a thread of its own, <see cref="Work"/> in the caller's. <see
    /// cref="Cancel"/>, <see cref="Progress"/> and <see cref="IsOver"/> are for any thread.
    /// </summary>
    public sealed class Fitting
    {
        private readonly CancellationTokenSource stop = new CancellationTokenSource();
        private readonly FittingTask task;
        private readonly List<Outcome> outcomes = new List<Outcome>();
        private volatile SessionProgress now;
        private volatile int done;
        private volatile bool isOver;

        /// <summary>A run that has not begun.</summary>
        /// <param name="task">What is to be done; not to be changed meanwhile.</param>
        public Fitting(FittingTask task)
        {
            this.task = task;
        }

        /// <summary>One for each garment that was tried; to be read when it is over.</summary>
        public IReadOnlyList<Outcome> Outcomes
        {
            get { return outcomes; }
        }

        /// <summary>Whether somebody has asked it to stop.</summary>
        public bool IsCancelled
        {
            get { return stop.IsCancellationRequested; }
        }

        /// <summary>Whether all is done, or stopped.</summary>
        public bool IsOver
        {
            get { return isOver; }
        }

        /// <summary>What ended it that is no answer of the library; null: nothing.</summary>
        public Exception Defect { get; private set; }

        /// <summary>How far it is.</summary>
        /// <param name="words">The garment, and what is done with it.</param>
        /// <returns>From 0 to 1.</returns>
        public double Progress(out string words)
        {
            int at = done;
            SessionProgress seen = now;
            if (at >= task.Garments.Count)
            {
                words = Stages.Words(Stage.Done);
                return 1;
            }
            Stage stage = seen == null ? Stage.Setup : seen.Stage;
            words = $"{task.Garments[at].Parts[0].Name}: {Stages.Words(stage)}";
            double part = seen == null ? 0 : Stages.Share(stage, seen.T, seen.Iteration);
            return (at + part) / task.Garments.Count;
        }

        /// <summary>Stops it within 100 ms; the garment that is being dressed has no outcome then.</summary>
        public void Cancel()
        {
            stop.Cancel();
        }

        /// <summary>Does it in a thread of its own. It ends well in any case: see <see cref="Defect"/>.</summary>
        /// <returns>The task.</returns>
        public Task Start()
        {
            return Task.Factory.StartNew(
                () =>
                {
                    try
                    {
                        Work();
                    }
                    catch (Exception defect)
                    {
                        Defect = defect;
                        isOver = true;
                    }
                },
                CancellationToken.None, TaskCreationOptions.LongRunning | TaskCreationOptions.DenyChildAttach,
                TaskScheduler.Default);
        }

        /// <summary>Does it in this thread.</summary>
        /// <exception cref="DllNotFoundException">The library is not there.</exception>
        public void Work()
        {
            try
            {
                List<KeyValuePair<float[], int[]>> layers = new List<KeyValuePair<float[], int[]>>();
                for (int k = 0; k < task.Garments.Count; k++)
                {
                    Outcome outcome = new Outcome();
                    try
                    {
                        using (Session session = Filled(k, layers))
                        {
                            Dress(session, k, outcome);
                        }
                    }
                    catch (OperationCanceledException)
                    {
                        return;
                    }
                    catch (BespokeException failure)
                    {
                        outcome.Failure = failure;
                    }
                    outcomes.Add(outcome);
                    if (outcome.Positions != null)
                    {
                        layers.Add(new KeyValuePair<float[], int[]>(
                            outcome.Positions, task.Garments[k].Parts[0].Triangles));
                    }
                    now = null;
                    done = k + 1;
                }
            }
            finally
            {
                isOver = true;
            }
        }

        /// <summary>
        /// Which joints of the target correspond to those of the character that a garment was made for, without dressing it.
        /// </summary>
        /// <param name="task">What is to be done.</param>
        /// <param name="garment">The garment, from 0.</param>
        /// <returns>One for each joint of that character.</returns>
        /// <exception cref="BespokeException">A rig or skin that cannot be used.</exception>
        public static MappedJoint[] ReadJointMap(FittingTask task, int garment)
        {
            using (Session session = new Session())
            {
                SetFigures(session, task, garment);
                return session.ReadJointMap();
            }
        }

        private Session Filled(int garment, List<KeyValuePair<float[], int[]>> layers)
        {
            Session session = new Session();
            try
            {
                session.SetOptions(task.Dials.ToOptions());
                // What is bound to a skeleton is in its place, whatever it looks like.
                CoordinateSystem made = CoordinateSystem.Unity;
                made.Trusted = task.Garments[garment].Parts[0].HasSkin;
                session.SetSourceCoordinateSystem(made);
                session.SetTargetCoordinateSystem(CoordinateSystem.Unity);
                SetFigures(session, task, garment);
                SkinnedPart cloth = task.Garments[garment].Parts[0];
                session.SetGarment(cloth.Positions, cloth.Triangles);
                Influences skin = Influences.Of(cloth);
                if (skin != null)
                {
                    session.SetGarmentSkinInfluences(
                        skin.Joints, skin.Weights, skin.Width, task.Garments[garment].Joints.Count);
                }
                foreach (ShapeFrame frame in cloth.Frames)
                {
                    session.AddGarmentMorph(frame.Name, frame.Vertices);
                }
                for (int k = 1; k <= task.FollowersOf(garment); k++)
                {
                    SkinnedPart along = task.Garments[garment].Parts[k];
                    session.AddFollower(along.Positions, along.Triangles);
                }
                foreach (KeyValuePair<float[], int[]> layer in layers)
                {
                    session.AddLayer(layer.Key, layer.Value);
                }
                return session;
            }
            catch
            {
                session.Dispose();
                throw;
            }
        }

        private static void SetFigures(Session session, FittingTask task, int garment)
        {
            Figure made = task.Garments[garment];
            session.SetSourceRig(made.Rig());
            int body = 1 + task.FollowersOf(garment);
            if (made.Parts.Length > body)
            {
                made.Joined(body, out float[] points, out int[] corners, out Influences own);
                session.SetSourceAvatar(points, corners);
                if (own != null)
                {
                    session.SetSourceSkinInfluences(own.Joints, own.Weights, own.Width, made.Joints.Count);
                }
            }
            session.SetTargetRig(task.Target.Rig());
            task.Target.Joined(0, out float[] positions, out int[] triangles, out Influences skin);
            session.SetTargetAvatar(positions, triangles);
            if (skin != null)
            {
                session.SetTargetSkinInfluences(skin.Joints, skin.Weights, skin.Width, task.Target.Joints.Count);
            }
            if (garment < task.Pairs.Count && task.Pairs[garment] != null)
            {
                session.SetJointPairs(task.Pairs[garment]);
            }
        }

        private void Dress(Session session, int garment, Outcome outcome)
        {
            SkinnedPart cloth = task.Garments[garment].Parts[0];
            try
            {
                session.Run(new Watch(this), stop.Token);
            }
            catch (BespokeException failure)
            {
                outcome.Failure = failure;
                outcome.Findings = session.ReadDiagnostics();
                // In the pose of the design it is no garment on the character as it stands.
                if (failure.Status != Status.ImplausibleResult || IsPosed(session))
                {
                    return;
                }
            }
            outcome.Findings = session.ReadDiagnostics();
            Report report = session.ReadReport();
            outcome.Intersections = report.GarmentIntersections + report.AvatarIntersections;
            Turn(session, cloth.Normals, cloth.Tangents, out outcome.Normals, out outcome.Tangents);
            for (int k = 0; k < cloth.Frames.Count; k++)
            {
                outcome.Frames.Add(Turned(session, cloth, outcome, k));
            }
            bool hasSkin = Array.Exists(task.Target.Parts, part => part.HasSkin);
            if (hasSkin)
            {
                session.ReadGarmentSkinInfluences(task.Influences, out uint[] joints, out float[] weights);
                outcome.Skin = new Influences(task.Influences, Array.ConvertAll(joints, j => checked((int)j)), weights);
                outcome.Added = session.ReadAddedJoints();
            }
            for (int k = 0; k < task.FollowersOf(garment); k++)
            {
                outcome.Followers.Add(Carried(session, k, task.Garments[garment].Parts[1 + k], hasSkin));
            }
            outcome.Positions = session.ReadGarmentVertices();
        }

        private Worn Carried(Session session, int number, SkinnedPart design, bool hasSkin)
        {
            float[] positions = session.ReadFollowerVertices(number);
            Turns turns = new Turns(design.Triangles, design.Positions, positions);
            Worn worn = new Worn
            {
                Positions = positions,
                Normals = turns.Turned(design.Normals, 3, false),
                Tangents = turns.Turned(design.Tangents, 4, false),
            };
            foreach (ShapeFrame frame in design.Frames)
            {
                worn.Frames.Add(new ShapeFrame
                {
                    Name = frame.Name,
                    Weight = frame.Weight,
                    Vertices = turns.Turned(frame.Vertices, 3, true),
                    Normals = turns.Turned(frame.Normals, 3, false),
                    Tangents = turns.Turned(frame.Tangents, 3, false),
                });
            }
            if (hasSkin)
            {
                session.ReadFollowerSkinInfluences(number, task.Influences, out uint[] joints, out float[] weights);
                worn.Skin = new Influences(task.Influences, Array.ConvertAll(joints, j => checked((int)j)), weights);
            }
            return worn;
        }

        private static bool IsPosed(Session session)
        {
            double[] numbers = session.ReadPoseTransforms();
            double[] one = new double[16];
            for (int k = 0; k + 15 < numbers.Length; k += 16)
            {
                Array.Copy(numbers, k, one, 0, 16);
                if (!Transform4.IsIdentity(one, 0))
                {
                    return true;
                }
            }
            return false;
        }

        private static void Turn(
            Session session, float[] normals, float[] tangents, out float[] turned, out float[] turnedTangents)
        {
            turned = new float[3 * session.GarmentVertexCount];
            turnedTangents = tangents == null ? null : new float[tangents.Length];
            session.ReadGarmentNormals(default(IndexView), normals, tangents, turned, turnedTangents);
        }

        // What a frame adds to normals and tangents is what is between the turned ones with it and without.
        private static ShapeFrame Turned(Session session, SkinnedPart cloth, Outcome outcome, int k)
        {
            ShapeFrame frame = cloth.Frames[k];
            ShapeFrame turned = new ShapeFrame
            {
                Name = frame.Name, Weight = frame.Weight, Vertices = session.ReadGarmentMorph(k),
            };
            if (frame.Normals == null || cloth.Normals == null)
            {
                return turned;
            }
            float[] normals = new float[cloth.Normals.Length];
            for (int i = 0; i < normals.Length; i++)
            {
                normals[i] = cloth.Normals[i] + frame.Normals[i];
            }
            bool hasTangents = frame.Tangents != null && cloth.Tangents != null;
            float[] tangents = hasTangents ? (float[])cloth.Tangents.Clone() : null;
            for (int i = 0; hasTangents && i < frame.Tangents.Length; i++)
            {
                tangents[4 * (i / 3) + i % 3] += frame.Tangents[i];
            }
            Turn(session, normals, tangents, out float[] withIt, out float[] tangentsWithIt);
            turned.Normals = new float[normals.Length];
            for (int i = 0; i < normals.Length; i++)
            {
                turned.Normals[i] = withIt[i] - outcome.Normals[i];
            }
            if (hasTangents)
            {
                turned.Tangents = new float[frame.Tangents.Length];
                for (int i = 0; i < turned.Tangents.Length; i++)
                {
                    int at = 4 * (i / 3) + i % 3;
                    turned.Tangents[i] = tangentsWithIt[at] - outcome.Tangents[at];
                }
            }
            return turned;
        }

        private sealed class Watch : IProgress<SessionProgress>
        {
            private readonly Fitting owner;

            public Watch(Fitting owner)
            {
                this.owner = owner;
            }

            public void Report(SessionProgress progress)
            {
                owner.now = progress;
            }
        }
    }
}
