// What of UnityEngine the package uses, so that it can be compiled. Nothing here does anything.
#pragma warning disable 67, 169, 649
using System;
using System.Collections.Generic;

namespace Unity.Collections
{
    public enum Allocator { Temp }

    public struct NativeArray<T> : IDisposable where T : struct
    {
        public NativeArray(T[] array, Allocator allocator) { }
        public T[] ToArray() { return new T[0]; }
        public void Dispose() { }
    }
}

namespace UnityEngine
{
    using Unity.Collections;

    public class Object
    {
        public string name { get; set; }
        public static bool operator ==(Object a, Object b) { return ReferenceEquals(a, b); }
        public static bool operator !=(Object a, Object b) { return !ReferenceEquals(a, b); }
        public override bool Equals(object other) { return ReferenceEquals(this, other); }
        public override int GetHashCode() { return 0; }
        public static T Instantiate<T>(T original) where T : Object { return original; }
        public static void Destroy(Object thing) { }
        public static void DestroyImmediate(Object thing) { }
    }

    public class Component : Object
    {
        public Transform transform { get; private set; }
        public GameObject gameObject { get; private set; }
        public T[] GetComponentsInChildren<T>() { return new T[0]; }
        public T GetComponentInParent<T>() { return default(T); }
    }

    public class Behaviour : Component { }

    public class MonoBehaviour : Behaviour { }

    public class ScriptableObject : Object { }

    public sealed class GameObject : Object
    {
        public GameObject(string name) { }
        public Transform transform { get; private set; }
        public int layer { get; set; }
        public T AddComponent<T>() where T : Component { return null; }
        public T GetComponent<T>() { return default(T); }
        public T[] GetComponentsInChildren<T>() { return new T[0]; }
    }

    public class Transform : Component
    {
        public Transform parent { get; set; }
        public Matrix4x4 localToWorldMatrix { get; private set; }
        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
        public void SetParent(Transform parent, bool worldPositionStays) { }
    }

    public struct Quaternion { }

    public struct Vector2 { public float x, y; }

    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 operator *(Vector3 a, float d) { return a; }
        public static implicit operator Vector3(Vector4 v) { return new Vector3(v.x, v.y, v.z); }
        public static Vector3 up { get { return default(Vector3); } }
    }

    public struct Vector4
    {
        public float x, y, z, w;
        public Vector4(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    }

    public struct Matrix4x4
    {
        public float this[int index] { get { return 0; } set { } }
        public Quaternion rotation { get { return default(Quaternion); } }
        public Vector3 lossyScale { get { return default(Vector3); } }
        public Vector4 GetColumn(int index) { return default(Vector4); }
        public Vector3 MultiplyPoint3x4(Vector3 point) { return point; }
    }

    public struct Bounds { public Vector3 size { get; set; } public Vector3 center { get; set; } }

    public struct BoneWeight1 { public int boneIndex { get; set; } public float weight { get; set; } }

    public enum MeshTopology { Triangles, Quads, Lines, LineStrip, Points }

    public sealed class Mesh : Object
    {
        public bool isReadable { get; private set; }
        public int vertexCount { get; private set; }
        public Vector3[] vertices { get; set; }
        public Vector3[] normals { get; set; }
        public Vector4[] tangents { get; set; }
        public int[] triangles { get; set; }
        public Matrix4x4[] bindposes { get; set; }
        public int subMeshCount { get; set; }
        public int blendShapeCount { get; private set; }
        public Bounds bounds { get; set; }
        public MeshTopology GetTopology(int submesh) { return MeshTopology.Triangles; }
        public int[] GetIndices(int submesh) { return new int[0]; }
        public NativeArray<byte> GetBonesPerVertex() { return default(NativeArray<byte>); }
        public NativeArray<BoneWeight1> GetAllBoneWeights() { return default(NativeArray<BoneWeight1>); }
        public void SetBoneWeights(NativeArray<byte> bonesPerVertex, NativeArray<BoneWeight1> weights) { }
        public string GetBlendShapeName(int shapeIndex) { return ""; }
        public int GetBlendShapeFrameCount(int shapeIndex) { return 0; }
        public float GetBlendShapeFrameWeight(int shapeIndex, int frameIndex) { return 0; }
        public void GetBlendShapeFrameVertices(
            int shapeIndex, int frameIndex, Vector3[] deltaVertices, Vector3[] deltaNormals, Vector3[] deltaTangents) { }
        public void AddBlendShapeFrame(
            string shapeName, float frameWeight, Vector3[] deltaVertices, Vector3[] deltaNormals,
            Vector3[] deltaTangents) { }
        public void ClearBlendShapes() { }
        public void RecalculateBounds() { }
    }

    public class Material : Object { }

    public enum SkinQuality { Auto }

    namespace Rendering { public enum ShadowCastingMode { Off, On } }

    public class Renderer : Component
    {
        public Material[] sharedMaterials { get; set; }
        public Rendering.ShadowCastingMode shadowCastingMode { get; set; }
        public bool receiveShadows { get; set; }
    }

    public class SkinnedMeshRenderer : Renderer
    {
        public Mesh sharedMesh { get; set; }
        public Transform[] bones { get; set; }
        public Transform rootBone { get; set; }
        public Bounds localBounds { get; set; }
        public SkinQuality quality { get; set; }
        public float GetBlendShapeWeight(int index) { return 0; }
        public void SetBlendShapeWeight(int index, float value) { }
    }

    public enum LODFadeMode { None, CrossFade, SpeedTree }

    public struct LOD
    {
        public float screenRelativeTransitionHeight;
        public float fadeTransitionWidth;
        public Renderer[] renderers;
        public LOD(float screenRelativeTransitionHeight, Renderer[] renderers)
        {
            this.screenRelativeTransitionHeight = screenRelativeTransitionHeight;
            this.renderers = renderers;
            fadeTransitionWidth = 0;
        }
    }

    public class LODGroup : Component
    {
        public LODFadeMode fadeMode { get; set; }
        public bool animateCrossFading { get; set; }
        public LOD[] GetLODs() { return new LOD[0]; }
        public void SetLODs(LOD[] lods) { }
        public void RecalculateBounds() { }
    }

    public enum HumanBodyBones { Hips, LeftUpperLeg, RightUpperLeg, Head, LastBone }

    public sealed class Avatar : Object { public bool isValid { get; private set; } public bool isHuman { get; private set; } }

    public class Animator : Behaviour
    {
        public Avatar avatar { get; set; }
        public Transform GetBoneTransform(HumanBodyBones bone) { return null; }
    }

    public class GUIContent
    {
        public static GUIContent none;
        public GUIContent(string text) { }
        public GUIContent(string text, string tooltip) { }
    }

    public class GUIStyle { }

    public class GUILayoutOption { }

    public static class GUILayout
    {
        public static bool Button(string text, params GUILayoutOption[] options) { return false; }
        public static bool Button(GUIContent content, params GUILayoutOption[] options) { return false; }
        public static GUILayoutOption Width(float width) { return null; }
    }

    public struct Rect { }

    public struct Color
    {
        public static Color red { get { return default(Color); } }
        public static Color yellow { get { return default(Color); } }
    }

    public static class Debug
    {
        public static void Log(object message) { }
        public static void LogError(object message) { }
        public static void LogWarning(object message) { }
        public static void LogError(object message, Object context) { }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class SerializeField : Attribute { }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string tooltip) { } }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string menuName) { } }
}
