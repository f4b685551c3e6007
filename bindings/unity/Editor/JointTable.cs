// Which bones correspond, to be looked at and mended.
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Bespoke.Unity.Editor
{
    /// <summary>The table of bones of the first garment's character, and those of the wearer that correspond.</summary>
    internal sealed class JointTable
    {
        private readonly Dictionary<Transform, Transform> chosen = new Dictionary<Transform, Transform>();
        private Transform[] sources = new Transform[0];
        private Transform[] targets = new Transform[0];
        private string[] names = new string[0];
        private MappedJoint[] map = new MappedJoint[0];

        /// <summary>What the user has chosen, which wins.</summary>
        public IReadOnlyDictionary<Transform, Transform> Chosen
        {
            get { return chosen; }
        }

        /// <summary>Asks the library.</summary>
        /// <param name="retarget">All that takes part.</param>
        public void Fill(GarmentRetarget retarget)
        {
            map = Fitting.ReadJointMap(retarget.Task, 0);
            sources = new List<Transform>(retarget.SourceBones(0)).ToArray();
            targets = new List<Transform>(retarget.TargetBones).ToArray();
            names = new string[targets.Length + 1];
            names[0] = "-";
            for (int k = 0; k < targets.Length; k++)
            {
                // A slash would make a menu of its own.
                names[k + 1] = targets[k].name.Replace('/', '\u2215');
            }
        }

        /// <summary>The table, and a button that forgets what was chosen.</summary>
        public void OnGUI()
        {
            for (int k = 0; k < map.Length && k < sources.Length; k++)
            {
                if (sources[k] == null)
                {
                    continue;
                }
                Transform own;
                bool isChosen = chosen.TryGetValue(sources[k], out own);
                int found = isChosen ? System.Array.IndexOf(targets, own) : map[k].Target ?? -1;
                EditorGUILayout.BeginHorizontal();
                string part = map[k].Part.Length > 0 ? $"{map[k].Part}, " : "";
                GUIContent label = new GUIContent(
                    sources[k].name, $"{part}{map[k].Reason} (confidence {map[k].Confidence:P0})");
                int now = EditorGUILayout.Popup(label, found + 1, names) - 1;
                if (now != found)
                {
                    chosen[sources[k]] = now < 0 ? null : targets[now];
                }
                EditorGUILayout.EndHorizontal();
            }
            if (chosen.Count > 0 && GUILayout.Button("Forget Choices"))
            {
                chosen.Clear();
            }
        }
    }
}
