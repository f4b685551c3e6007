// What the library has to say, and where.
using System.Collections.Generic;
using System.IO;
using UnityEditor;
using UnityEngine;

namespace Bespoke.Unity.Editor
{
    /// <summary>The findings of the last run. The elements of the one that is selected are drawn in the scene.</summary>
    internal sealed class FindingsList
    {
        private readonly List<Entry> findings = new List<Entry>();
        private Entry selected;

        private sealed class Entry
        {
            public string Garment;
            public string Text;
            public MessageType Type;
            public string Anchor;
            public readonly List<Vector3> Points = new List<Vector3>();
        }

        /// <summary>None.</summary>
        public void Clear()
        {
            findings.Clear();
            selected = null;
        }

        /// <summary>Those of a run.</summary>
        /// <param name="done">The run.</param>
        /// <param name="designs">The garments as they were made.</param>
        /// <param name="bodies">The body that wears them.</param>
        /// <param name="made">The new renderers; null where there is none.</param>
        public void Fill(
            GarmentRetarget done, List<SkinnedMeshRenderer> designs, List<SkinnedMeshRenderer> bodies,
            List<SkinnedMeshRenderer> made)
        {
            Clear();
            for (int k = 0; k < done.Fitting.Outcomes.Count && k < designs.Count; k++)
            {
                Outcome outcome = done.Fitting.Outcomes[k];
                if (outcome.Failure != null)
                {
                    findings.Add(new Entry
                    {
                        Garment = designs[k].name, Text = outcome.Failure.Message,
                        Type = MessageType.Error, Anchor = Troubleshooting.Anchor(outcome.Failure.Status),
                    });
                }
                foreach (Diagnostic diagnostic in outcome.Findings)
                {
                    Entry finding = new Entry
                    {
                        Garment = designs[k].name, Text = diagnostic.Message,
                        Type = diagnostic.Severity == Severity.Error ? MessageType.Error
                            : diagnostic.Severity == Severity.Warning ? MessageType.Warning : MessageType.Info,
                        Anchor = outcome.Failure != null
                            ? Troubleshooting.Anchor(outcome.Failure.Status) : Troubleshooting.Warnings,
                    };
                    foreach (Element element in diagnostic.Elements)
                    {
                        Locate(element, done.Task, outcome, k, designs[k], bodies[0], made[k], finding.Points);
                    }
                    findings.Add(finding);
                }
            }
        }

        /// <summary>The list.</summary>
        public void OnGUI()
        {
            if (findings.Count == 0)
            {
                return;
            }
            EditorGUILayout.LabelField("Findings", EditorStyles.boldLabel);
            foreach (Entry finding in findings)
            {
                EditorGUILayout.HelpBox($"{finding.Garment}: {finding.Text}", finding.Type);
                EditorGUILayout.BeginHorizontal();
                if (finding.Points.Count > 0 && GUILayout.Button(Labels.Select))
                {
                    selected = finding;
                    SceneView view = SceneView.lastActiveSceneView;
                    if (view != null)
                    {
                        view.LookAt(finding.Points[0]);
                    }
                }
                if (finding.Type != MessageType.Info && GUILayout.Button(Labels.WhatToDo))
                {
                    EditorUtility.DisplayDialog("Bespoke", Text(finding.Anchor), "Close");
                }
                EditorGUILayout.EndHorizontal();
            }
        }

        /// <summary>Draws the elements of the selected finding.</summary>
        /// <param name="view">The view.</param>
        public void Draw(SceneView view)
        {
            if (selected == null)
            {
                return;
            }
            Handles.color = selected.Type == MessageType.Error ? Color.red : Color.yellow;
            for (int k = 0; k + 2 < selected.Points.Count; k += 3)
            {
                Vector3 a = selected.Points[k], b = selected.Points[k + 1], c = selected.Points[k + 2];
                Handles.DrawAAPolyLine(4f, a, b, c, a);
            }
        }

        // Triangles as three points; a vertex is one three times. Meshes are drawn where they are in the bind pose.
        private static void Locate(
            Element element, FittingTask task, Outcome outcome, int garment, SkinnedMeshRenderer design,
            SkinnedMeshRenderer body, SkinnedMeshRenderer made, List<Vector3> points)
        {
            float[] positions;
            int[] triangles = task.Garments[garment].Parts[0].Triangles;
            Matrix4x4 toWorld;
            if (element.Subject == Subject.Garment)
            {
                bool isDressed = made != null;
                positions = isDressed ? outcome.Positions : task.Garments[garment].Parts[0].Positions;
                toWorld = (isDressed ? made : design).transform.localToWorldMatrix;
            }
            else if (element.Subject == Subject.TargetAvatar)
            {
                Influences skin;
                task.Target.Joined(0, out positions, out triangles, out skin);
                toWorld = body.transform.localToWorldMatrix;
            }
            else
            {
                return;
            }
            if (element.Kind == ElementKind.Bone)
            {
                return;
            }
            for (int corner = 0; corner < 3; corner++)
            {
                int vertex = element.Kind == ElementKind.Vertex ? element.Index : triangles[3 * element.Index + corner];
                points.Add(toWorld.MultiplyPoint3x4(
                    new Vector3(positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2])));
            }
        }

        private static string Text(string anchor)
        {
            string page = Path.GetFullPath("Packages/com.bespoke.retarget/" + Troubleshooting.Page);
            string section = File.Exists(page) ? Troubleshooting.Section(File.ReadAllText(page), anchor) : "";
            return section.Length > 0 ? section : $"See {Troubleshooting.Page}#{anchor} in the package.";
        }
    }
}
