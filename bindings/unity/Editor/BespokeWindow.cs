// The window: who wears what, how it fits, and what came of it.
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEditor;
using UnityEngine;

namespace Bespoke.Unity.Editor
{
    /// <summary>Window > Bespoke: puts garments of one character on another.</summary>
    public sealed class BespokeWindow : EditorWindow
    {
        [SerializeField] private List<SkinnedMeshRenderer> garments = new List<SkinnedMeshRenderer>();
        [SerializeField] private List<SkinnedMeshRenderer> sourceBodies = new List<SkinnedMeshRenderer>();
        [SerializeField] private List<SkinnedMeshRenderer> targetBodies = new List<SkinnedMeshRenderer>();
        [SerializeField] private Animator source;
        [SerializeField] private Animator target;
        [SerializeField] private Dials dials = new Dials();
        [SerializeField] private bool saveMeshes = true;
        [SerializeField] private bool showsMore;
        [SerializeField] private bool showsBones;
        [SerializeField] private Vector2 scroll;

        private readonly JointTable joints = new JointTable();
        private readonly FindingsList findings = new FindingsList();
        private GarmentRetarget running;
        private System.Threading.Tasks.Task work;
        private string trouble = "";

        [MenuItem("Window/Bespoke")]
        private static void Open()
        {
            GetWindow<BespokeWindow>("Bespoke");
        }

        private void OnEnable()
        {
            EditorApplication.update += Look;
            AssemblyReloadEvents.beforeAssemblyReload += StopAndWait;
            SceneView.duringSceneGui += findings.Draw;
        }

        private void OnDisable()
        {
            StopAndWait();
            EditorApplication.update -= Look;
            AssemblyReloadEvents.beforeAssemblyReload -= StopAndWait;
            SceneView.duringSceneGui -= findings.Draw;
        }

        private void OnGUI()
        {
            scroll = EditorGUILayout.BeginScrollView(scroll);
            using (new EditorGUI.DisabledScope(running != null))
            {
                Renderers("Garments, innermost first", garments);
                EditorGUILayout.Space();
                EditorGUILayout.LabelField("Made for", EditorStyles.boldLabel);
                source = (Animator)EditorGUILayout.ObjectField(Labels.SourceAnimator, source, typeof(Animator), true);
                Renderers("Body", sourceBodies);
                EditorGUILayout.Space();
                EditorGUILayout.LabelField("To be worn by", EditorStyles.boldLabel);
                target = (Animator)EditorGUILayout.ObjectField(Labels.TargetAnimator, target, typeof(Animator), true);
                Renderers("Body", targetBodies);
                EditorGUILayout.Space();
                DialFields();
                Bones();
            }
            EditorGUILayout.Space();
            Buttons();
            if (trouble.Length > 0)
            {
                EditorGUILayout.HelpBox(trouble, MessageType.Error);
            }
            findings.OnGUI();
            EditorGUILayout.EndScrollView();
        }

        private void DialFields()
        {
            dials.Fit = Positive(EditorGUILayout.DoubleField(Labels.Fit, dials.Fit));
            dials.Looseness = Math.Min(2, Positive(EditorGUILayout.DoubleField(Labels.Looseness, dials.Looseness)));
            dials.Offset = Positive(EditorGUILayout.DoubleField(Labels.Offset, dials.Offset));
            showsMore = EditorGUILayout.Foldout(showsMore, "More Options");
            if (!showsMore)
            {
                return;
            }
            dials.FitDistance = Positive(EditorGUILayout.DoubleField(Labels.FitDistance, dials.FitDistance));
            dials.WeldDistance = Math.Min(
                0.25, Positive(EditorGUILayout.DoubleField(Labels.WeldDistance, dials.WeldDistance)));
            dials.KeepCaps = EditorGUILayout.Toggle(Labels.KeepCaps, dials.KeepCaps);
            dials.Strict = EditorGUILayout.Toggle(Labels.Strict, dials.Strict);
            dials.Threads = Math.Max(0, EditorGUILayout.IntField(Labels.Threads, dials.Threads));
            saveMeshes = EditorGUILayout.Toggle(Labels.SaveMeshes, saveMeshes);
        }

        private void Bones()
        {
            showsBones = EditorGUILayout.Foldout(showsBones, "Matching Bones");
            if (!showsBones)
            {
                return;
            }
            if (GUILayout.Button(Labels.MatchBones))
            {
                Try(() => joints.Fill(Prepared()));
            }
            joints.OnGUI();
        }

        private void Buttons()
        {
            if (running == null)
            {
                if (GUILayout.Button(Labels.Dress))
                {
                    Try(Begin);
                }
                return;
            }
            double share = running.Fitting.Progress(out string words);
            EditorGUI.ProgressBar(EditorGUILayout.GetControlRect(), (float)share, words);
            if (GUILayout.Button(Labels.Stop))
            {
                running.Fitting.Cancel();
            }
        }

        private GarmentRetarget Prepared()
        {
            return new GarmentRetarget(
                Given(garments), Given(sourceBodies), Given(targetBodies), source, target, dials, joints.Chosen);
        }

        private void Begin()
        {
            findings.Clear();
            running = Prepared();
            work = running.Fitting.Start();
        }

        // Some hundred times a second: it is drawn anew only where something runs.
        private void Look()
        {
            if (running == null)
            {
                return;
            }
            Repaint();
            if (!work.IsCompleted)
            {
                return;
            }
            GarmentRetarget done = running;
            running = null;
            Try(() => Finish(done));
        }

        private void Finish(GarmentRetarget done)
        {
            if (done.Fitting.Defect != null)
            {
                throw done.Fitting.Defect;
            }
            Undo.IncrementCurrentGroup();
            Undo.SetCurrentGroupName("Dress");
            List<GameObject> created = new List<GameObject>();
            List<UnityEngine.Object> dressed = new List<UnityEngine.Object>();
            List<SkinnedMeshRenderer> made = new List<SkinnedMeshRenderer>();
            List<SkinnedMeshRenderer> designs = Given(garments);
            for (int k = 0; k < done.Fitting.Outcomes.Count; k++)
            {
                created.Clear();
                SkinnedMeshRenderer renderer = done.Apply(k, created);
                made.Add(renderer);
                foreach (GameObject thing in created)
                {
                    Undo.RegisterCreatedObjectUndo(thing, "Dress");
                }
                if (renderer != null)
                {
                    dressed.Add(renderer.gameObject);
                    if (saveMeshes)
                    {
                        foreach (GameObject thing in created)
                        {
                            SkinnedMeshRenderer level = thing.GetComponent<SkinnedMeshRenderer>();
                            if (level != null)
                            {
                                Save(level.sharedMesh);
                            }
                        }
                    }
                }
            }
            Undo.CollapseUndoOperations(Undo.GetCurrentGroup());
            if (dressed.Count > 0)
            {
                Selection.objects = dressed.ToArray();
            }
            findings.Fill(done, designs, Given(targetBodies), made);
        }

        private static void Save(Mesh mesh)
        {
            if (!AssetDatabase.IsValidFolder("Assets/Bespoke"))
            {
                AssetDatabase.CreateFolder("Assets", "Bespoke");
            }
            string name = string.Join("_", mesh.name.Split(System.IO.Path.GetInvalidFileNameChars()));
            AssetDatabase.CreateAsset(mesh, AssetDatabase.GenerateUniqueAssetPath($"Assets/Bespoke/{name}.asset"));
        }

        // A library call that runs would be waited for by the engine, with no word.
        private void StopAndWait()
        {
            if (running == null)
            {
                return;
            }
            running.Fitting.Cancel();
            work.Wait(5000);
            running = null;
        }

        private void Try(Action action)
        {
            trouble = "";
            try
            {
                action();
            }
            catch (ArgumentException wrong)
            {
                trouble = wrong.Message;
            }
            catch (BespokeException refused)
            {
                trouble = refused.Message;
            }
            catch (DllNotFoundException missing)
            {
                trouble = "The library was not found; the package has it for Linux and, where it was built with it, for " +
                    "Windows. " + missing.Message;
            }
            catch (BadImageFormatException other)
            {
                trouble = other.Message;
            }
        }

        private static void Renderers(string label, List<SkinnedMeshRenderer> list)
        {
            EditorGUILayout.LabelField(label, EditorStyles.boldLabel);
            int removed = -1;
            for (int k = 0; k < list.Count; k++)
            {
                EditorGUILayout.BeginHorizontal();
                list[k] = (SkinnedMeshRenderer)EditorGUILayout.ObjectField(
                    GUIContent.none, list[k], typeof(SkinnedMeshRenderer), true);
                if (k > 0 && GUILayout.Button(Labels.Up, GUILayout.Width(24)))
                {
                    SkinnedMeshRenderer above = list[k - 1];
                    list[k - 1] = list[k];
                    list[k] = above;
                }
                removed = GUILayout.Button(Labels.Remove, GUILayout.Width(24)) ? k : removed;
                EditorGUILayout.EndHorizontal();
            }
            if (removed >= 0)
            {
                list.RemoveAt(removed);
            }
            if (GUILayout.Button(Labels.AddSelected))
            {
                foreach (GameObject chosen in Selection.gameObjects)
                {
                    list.AddRange(chosen.GetComponentsInChildren<SkinnedMeshRenderer>().Where(r => !list.Contains(r)));
                }
            }
        }

        private static List<SkinnedMeshRenderer> Given(List<SkinnedMeshRenderer> list)
        {
            return list.Where(renderer => renderer != null).ToList();
        }

        private static double Positive(double number)
        {
            return number > 0 ? number : 0;
        }
    }
}
