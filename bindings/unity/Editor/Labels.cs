// The words of the window, which are those of all hosts.
using UnityEngine;

namespace Bespoke.Unity.Editor
{
    /// <summary>Labels and tooltips.</summary>
    internal static class Labels
    {
        public static readonly GUIContent SourceAnimator = new GUIContent(
            "Animator", "Of the character that the garments were made for: a humanoid avatar says which bone is which");
        public static readonly GUIContent TargetAnimator = new GUIContent(
            "Animator", "Of the character to dress: a humanoid avatar says which bone is which");
        public static readonly GUIContent Fit = new GUIContent("Fit", DialTexts.Fit);
        public static readonly GUIContent Looseness = new GUIContent("Looseness", DialTexts.Looseness);
        public static readonly GUIContent Offset = new GUIContent("Offset", DialTexts.Offset);
        public static readonly GUIContent FitDistance = new GUIContent("Fit distance", DialTexts.FitDistance);
        public static readonly GUIContent WeldDistance = new GUIContent("Weld distance", DialTexts.WeldDistance);
        public static readonly GUIContent KeepCaps = new GUIContent("Keep caps", DialTexts.KeepCaps);
        public static readonly GUIContent Strict = new GUIContent("Strict", DialTexts.Strict);
        public static readonly GUIContent Threads = new GUIContent("Threads", DialTexts.Threads);
        public static readonly GUIContent SaveMeshes = new GUIContent(
            "Save meshes", "As assets in Assets/Bespoke, which undo leaves there. Off: in the scene");
        public static readonly GUIContent MatchBones = new GUIContent(
            "Match Bones", "Which bones correspond, by humanoid avatars, names and places");
        public static readonly GUIContent Dress = new GUIContent(
            "Dress", "Puts the garments on the other character: new objects on its bones, with no triangle through another");
        public static readonly GUIContent Stop = new GUIContent("Stop", "Ends it at once; what is dressed already stays");
        public static readonly GUIContent AddSelected = new GUIContent("Add Selected Meshes");
        public static readonly GUIContent Remove = new GUIContent("-", "Takes it off the list");
        public static readonly GUIContent Up = new GUIContent("^", "Further in");
        public static readonly GUIContent Select = new GUIContent("Select", "Shows where, in the scene");
        public static readonly GUIContent WhatToDo = new GUIContent(
            "What to Do", "What it means, how to see where it went wrong, and what to do about it");
    }
}
