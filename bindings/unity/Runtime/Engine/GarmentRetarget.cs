// From renderers to renderers.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Bespoke.Unity
{
    /// <summary>
    /// Puts garments of one character on another: reads renderers, fits in a thread of its own, and makes a new renderer for each
    /// garment on the bones of the other. What is asked of renderers and transforms is for the main thread; <see cref="Fitting"/>
    /// is for any.
    /// </summary>
    public sealed class GarmentRetarget
    {
        // Each with its other levels of detail.
        private readonly SkinnedMeshRenderer[][] garments;
        private readonly FigureReader[] made;
        private readonly FigureReader target;
        private readonly SkinnedMeshRenderer body;

        /// <summary>Reads all that takes part.</summary>
        /// <param name="garments">The garments, innermost first. Other levels of detail in the LODGroup of one (Coat_LOD0,
        /// Coat_LOD1) go along with it.</param>
        /// <param name="sourceBodies">The body that they were made for; empty: it is not there, and the fit is tight.</param>
        /// <param name="targetBodies">The body to dress; at least one renderer.</param>
        /// <param name="source">The animator of the first character: its humanoid avatar says which bone is which; null: names
        /// and places do.</param>
        /// <param name="targetAnimator">The same of the second.</param>
        /// <param name="dials">How it is to fit; null: the defaults.</param>
        /// <param name="chosen">Bones of the first character and those of the second that correspond to them, which win; null as
        /// a value: nothing corresponds. Null: none are chosen.</param>
        /// <exception cref="ArgumentException">Something cannot be read, or is missing.</exception>
        public GarmentRetarget(
            IReadOnlyList<SkinnedMeshRenderer> garments, IReadOnlyList<SkinnedMeshRenderer> sourceBodies,
            IReadOnlyList<SkinnedMeshRenderer> targetBodies, Animator source = null, Animator targetAnimator = null,
            Dials dials = null, IReadOnlyDictionary<Transform, Transform> chosen = null)
        {
            if (garments.Count == 0 || targetBodies.Count == 0)
            {
                throw new ArgumentException(
                    garments.Count == 0 ? "no garment is chosen" : "no body is chosen that is to wear the garments");
            }
            this.garments = Array.ConvertAll(List(garments), WithLevels);
            body = targetBodies[0];
            target = new FigureReader(List(targetBodies));
            Task = new FittingTask { Target = target.Figure, Dials = dials ?? new Dials() };
            made = new FigureReader[garments.Count];
            Dictionary<string, int> wearer = target.Humanoid(targetAnimator);
            for (int k = 0; k < made.Length; k++)
            {
                List<SkinnedMeshRenderer> renderers = new List<SkinnedMeshRenderer>(this.garments[k]);
                renderers.AddRange(sourceBodies);
                Task.Followers.Add(this.garments[k].Length - 1);
                made[k] = new FigureReader(renderers.ToArray());
                Task.Garments.Add(made[k].Figure);
                Task.Pairs.Add(JointPairs.Of(made[k].Humanoid(source), wearer, Numbers(made[k], chosen)));
            }
            Fitting = new Fitting(Task);
        }

        /// <summary>What is to be done.</summary>
        public FittingTask Task { get; }

        /// <summary>The run.</summary>
        public Fitting Fitting { get; }

        /// <summary>Bones of the character that a garment was made for, in the order of <see cref="Fitting.ReadJointMap"/>.</summary>
        /// <param name="garment">The garment, from 0.</param>
        /// <returns>The bones.</returns>
        public IReadOnlyList<Transform> SourceBones(int garment)
        {
            return made[garment].Transforms;
        }

        /// <summary>Bones of the character to dress, by the numbers of the joint map.</summary>
        public IReadOnlyList<Transform> TargetBones
        {
            get { return target.Transforms; }
        }

        /// <summary>
        /// Makes the renderer of a garment that is dressed, beside the body that wears it, with the materials and the weights of
        /// blend shapes of the garment, and Transforms for the bones that it brings along. Its other levels of detail come with it,
        /// in a LODGroup. To be called once it is over.
        /// </summary>
        /// <param name="garment">The garment, from 0.</param>
        /// <param name="created">Every new object: the renderer's first, then bones of its own and other levels.</param>
        /// <returns>The renderer; null where the garment is not dressed.</returns>
        public SkinnedMeshRenderer Apply(int garment, List<GameObject> created)
        {
            Outcome outcome = garment < Fitting.Outcomes.Count ? Fitting.Outcomes[garment] : null;
            if (outcome == null || outcome.Positions == null)
            {
                return null;
            }
            SkinnedMeshRenderer[] designs = garments[garment];
            GameObject wearing = new GameObject(designs[0].name);
            created.Add(wearing);
            Place(wearing.transform, body.transform);
            Transform[] added = AddBones(garment, outcome, created);
            SkinnedMeshRenderer[] made = new SkinnedMeshRenderer[designs.Length];
            made[0] = Wear(designs[0], outcome, outcome, added, wearing);
            for (int k = 1; k < made.Length; k++)
            {
                GameObject level = new GameObject(designs[k].name);
                created.Add(level);
                level.transform.SetParent(wearing.transform, false);
                made[k] = Wear(designs[k], outcome.Followers[k - 1], outcome, added, level);
            }
            if (made.Length > 1)
            {
                Levels.Group(designs, made, wearing);
            }
            return made[0];
        }

        private static SkinnedMeshRenderer[] WithLevels(SkinnedMeshRenderer garment)
        {
            List<SkinnedMeshRenderer> levels = Levels.Of(garment);
            levels.Insert(0, garment);
            return levels.ToArray();
        }

        // A renderer for one mesh of an outcome, on the bones of the wearer and those that come along.
        private SkinnedMeshRenderer Wear(
            SkinnedMeshRenderer design, Worn worn, Outcome outcome, Transform[] added, GameObject wearing)
        {
            wearing.layer = design.gameObject.layer;
            SkinnedMeshRenderer renderer = wearing.AddComponent<SkinnedMeshRenderer>();
            int joints = target.Transforms.Count;
            int[] used;
            Mesh mesh = MeshReader.Write(
                design.sharedMesh, worn,
                joint => joint < joints ? target.Figure.Bind(joint) : outcome.Added[joint - joints].Bind, out used);
            mesh.name = design.sharedMesh.name + " on " + body.name;
            renderer.sharedMesh = mesh;
            renderer.sharedMaterials = design.sharedMaterials;
            renderer.bones = Array.ConvertAll(
                used, joint => joint < joints ? target.Transforms[joint] : added[joint - joints]);
            renderer.rootBone = body.rootBone;
            renderer.quality = design.quality;
            renderer.shadowCastingMode = design.shadowCastingMode;
            renderer.receiveShadows = design.receiveShadows;
            // Bounds are around the root bone; where there is none they are the mesh's.
            renderer.localBounds = Around(mesh.bounds, body);
            for (int shape = 0; shape < mesh.blendShapeCount; shape++)
            {
                renderer.SetBlendShapeWeight(shape, design.GetBlendShapeWeight(shape));
            }
            return renderer;
        }

        // A bone of the garment's own hangs on its parent as in the bind, wherever that stands now.
        private Transform[] AddBones(int garment, Outcome outcome, List<GameObject> created)
        {
            int joints = target.Transforms.Count;
            Transform[] added = new Transform[outcome.Added.Length];
            for (int k = 0; k < added.Length; k++)
            {
                AddedJoint joint = outcome.Added[k];
                GameObject bone = new GameObject(made[garment].Transforms[joint.Source].name);
                created.Add(bone);
                added[k] = bone.transform;
            }
            for (int k = 0; k < added.Length; k++)
            {
                AddedJoint joint = outcome.Added[k];
                bool isRoot = joint.Parent == null;
                int parent = isRoot ? 0 : joint.Parent.Value;
                bool isAdded = parent >= joints;
                double[] above = isRoot
                    ? Transform4.Identity()
                    : isAdded ? outcome.Added[parent - joints].Bind : target.Figure.Bind(parent);
                added[k].SetParent(
                    isRoot ? body.transform.parent : isAdded ? added[parent - joints] : target.Transforms[parent], false);
                Matrix4x4 local = FigureReader.Matrix(
                    Transform4.Multiply(Transform4.Inverse(above) ?? Transform4.Identity(), joint.Bind));
                added[k].localPosition = local.GetColumn(3);
                added[k].localRotation = local.rotation;
                added[k].localScale = local.lossyScale;
            }
            return added;
        }

        private static void Place(Transform placed, Transform beside)
        {
            placed.SetParent(beside.parent, false);
            placed.localPosition = beside.localPosition;
            placed.localRotation = beside.localRotation;
            placed.localScale = beside.localScale;
        }

        private static Bounds Around(Bounds mesh, SkinnedMeshRenderer body)
        {
            if (body.rootBone == null)
            {
                return mesh;
            }
            // As large as the body's with the garment around it.
            Bounds bounds = body.localBounds;
            Vector3 size = mesh.size;
            Vector3 room = bounds.size;
            bounds.size = new Vector3(
                Math.Max(room.x, size.x), Math.Max(room.y, size.y), Math.Max(room.z, size.z)) * 1.1f;
            return bounds;
        }

        private Dictionary<int, int> Numbers(FigureReader source, IReadOnlyDictionary<Transform, Transform> chosen)
        {
            Dictionary<int, int> numbers = new Dictionary<int, int>();
            if (chosen == null)
            {
                return numbers;
            }
            List<Transform> from = new List<Transform>(source.Transforms);
            List<Transform> to = new List<Transform>(target.Transforms);
            foreach (KeyValuePair<Transform, Transform> pair in chosen)
            {
                int joint = from.IndexOf(pair.Key);
                if (joint >= 0)
                {
                    numbers[joint] = pair.Value == null ? -1 : to.IndexOf(pair.Value);
                }
            }
            return numbers;
        }

        private static SkinnedMeshRenderer[] List(IReadOnlyList<SkinnedMeshRenderer> renderers)
        {
            SkinnedMeshRenderer[] list = new SkinnedMeshRenderer[renderers.Count];
            for (int k = 0; k < list.Length; k++)
            {
                // What was destroyed counts as missing too: that is what this comparison says, and ?? does not.
                if (renderers[k] == null)
                {
                    throw new ArgumentException($"renderer {k} of a list is missing");
                }
                list[k] = renderers[k];
            }
            return list;
        }
    }
}
