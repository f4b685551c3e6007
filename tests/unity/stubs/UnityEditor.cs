// What of UnityEditor the package uses, so that it can be compiled. Nothing here does anything.
#pragma warning disable 67
using System;
using UnityEngine;

namespace UnityEditor
{
    public class EditorWindow : ScriptableObject
    {
        public static T GetWindow<T>(string title) where T : EditorWindow { return null; }
        public void Repaint() { }
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MenuItem : Attribute { public MenuItem(string itemName) { } }

    public static class EditorApplication
    {
        public delegate void CallbackFunction();
        public static CallbackFunction update;
    }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();
        public static event AssemblyReloadCallback beforeAssemblyReload;
    }

    public class SceneView : EditorWindow
    {
        public static event Action<SceneView> duringSceneGui;
        public static SceneView lastActiveSceneView { get { return null; } }
        public void LookAt(Vector3 point) { }
    }

    public enum MessageType { None, Info, Warning, Error }

    public static class EditorStyles { public static GUIStyle boldLabel { get { return null; } } }

    public static class EditorGUILayout
    {
        public static Vector2 BeginScrollView(Vector2 scroll, params GUILayoutOption[] options) { return scroll; }
        public static void EndScrollView() { }
        public static Rect BeginHorizontal(params GUILayoutOption[] options) { return default(Rect); }
        public static void EndHorizontal() { }
        public static void Space() { }
        public static void LabelField(string label, GUIStyle style, params GUILayoutOption[] options) { }
        public static UnityEngine.Object ObjectField(
            GUIContent label, UnityEngine.Object value, Type type, bool allowSceneObjects, params GUILayoutOption[] options)
        {
            return value;
        }
        public static double DoubleField(GUIContent label, double value, params GUILayoutOption[] options) { return value; }
        public static int IntField(GUIContent label, int value, params GUILayoutOption[] options) { return value; }
        public static bool Toggle(GUIContent label, bool value, params GUILayoutOption[] options) { return value; }
        public static bool Foldout(bool foldout, string content) { return foldout; }
        public static int Popup(GUIContent label, int selected, string[] shown, params GUILayoutOption[] options)
        {
            return selected;
        }
        public static void HelpBox(string message, MessageType type) { }
        public static Rect GetControlRect(params GUILayoutOption[] options) { return default(Rect); }
    }

    public static class EditorGUI
    {
        public static void ProgressBar(Rect position, float value, string text) { }

        public struct DisabledScope : IDisposable
        {
            public DisabledScope(bool disabled) { }
            public void Dispose() { }
        }
    }

    public static class EditorUtility
    {
        public static bool DisplayDialog(string title, string message, string ok) { return true; }
    }

    public static class Handles
    {
        public static Color color { get; set; }
        public static void DrawAAPolyLine(float width, params Vector3[] points) { }
    }

    public static class Selection
    {
        public static UnityEngine.Object[] objects { get; set; }
        public static GameObject[] gameObjects { get { return new GameObject[0]; } }
    }

    public static class Undo
    {
        public static void IncrementCurrentGroup() { }
        public static int GetCurrentGroup() { return 0; }
        public static void SetCurrentGroupName(string name) { }
        public static void RegisterCreatedObjectUndo(UnityEngine.Object thing, string name) { }
        public static void CollapseUndoOperations(int groupIndex) { }
    }

    public static class AssetDatabase
    {
        public static bool IsValidFolder(string path) { return false; }
        public static string CreateFolder(string parentFolder, string newFolderName) { return ""; }
        public static void CreateAsset(UnityEngine.Object asset, string path) { }
        public static string GenerateUniqueAssetPath(string path) { return path; }
    }
}
