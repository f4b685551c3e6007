// Levels of detail of a garment: which renderers they are, and a group for those of the result.
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Bespoke.Unity
{
    /// <summary>
    /// Levels of detail that lie in one LODGroup, by the names that the engine's importer goes by: Coat_LOD0, Coat_LOD1. A group may
    /// hold a whole character; what is called otherwise is no level of this garment.
    /// </summary>
    internal static class Levels
    {
        private const string Ending = "_LOD";

        /// <summary>The other levels of a renderer, from fine to coarse.</summary>
        /// <param name="renderer">The one that is fitted.</param>
        /// <returns>Those that are skinned; none where it is in no group.</returns>
        public static List<SkinnedMeshRenderer> Of(SkinnedMeshRenderer renderer)
        {
            List<SkinnedMeshRenderer> others = new List<SkinnedMeshRenderer>();
            LODGroup group = renderer.GetComponentInParent<LODGroup>();
            string name = Base(renderer.name);
            if (group == null || name == null)
            {
                return others;
            }
            foreach (LOD level in group.GetLODs())
            {
                foreach (Renderer other in level.renderers)
                {
                    SkinnedMeshRenderer skinned = other as SkinnedMeshRenderer;
                    bool isLevel = skinned != null && skinned != renderer && skinned.sharedMesh != null;
                    if (isLevel && Base(skinned.name) == name && !others.Contains(skinned))
                    {
                        others.Add(skinned);
                    }
                }
            }
            return others;
        }

        /// <summary>Gives the result a group like that of the design.</summary>
        /// <param name="design">The garment, then its other levels.</param>
        /// <param name="made">What became of each.</param>
        /// <param name="holder">Where the group goes.</param>
        public static void Group(
            IReadOnlyList<SkinnedMeshRenderer> design, IReadOnlyList<SkinnedMeshRenderer> made, GameObject holder)
        {
            LODGroup group = design[0].GetComponentInParent<LODGroup>();
            List<LOD> levels = new List<LOD>();
            foreach (LOD level in group.GetLODs())
            {
                List<Renderer> shown = new List<Renderer>();
                for (int k = 0; k < design.Count; k++)
                {
                    if (Array.IndexOf(level.renderers, design[k]) >= 0)
                    {
                        shown.Add(made[k]);
                    }
                }
                if (shown.Count > 0)
                {
                    levels.Add(new LOD(level.screenRelativeTransitionHeight, shown.ToArray())
                    {
                        fadeTransitionWidth = level.fadeTransitionWidth,
                    });
                }
            }
            LODGroup copy = holder.AddComponent<LODGroup>();
            copy.fadeMode = group.fadeMode;
            copy.animateCrossFading = group.animateCrossFading;
            copy.SetLODs(levels.ToArray());
            copy.RecalculateBounds();
        }

        // The name without the number of its level; null: it has none.
        private static string Base(string name)
        {
            int at = name.LastIndexOf(Ending, StringComparison.OrdinalIgnoreCase);
            int number;
            return at > 0 && int.TryParse(name.Substring(at + Ending.Length), out number) ? name.Substring(0, at) : null;
        }
    }
}
